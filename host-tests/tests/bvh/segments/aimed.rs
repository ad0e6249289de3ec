//! Segments of every kind that rounding has trouble with: no wrong clear, no wrong proof.

use super::scenes::all;
use super::truth::{Asker, Tally};
use meshsweep_host_tests::generate::Rng;
use meshsweep_host_tests::generate::corpus::add;
use meshsweep_host_tests::scene::Scene;

type Point = [f32; 3];

fn middle(p: Point, q: Point) -> Point {
    std::array::from_fn(|k| 0.5 * p[k] + 0.5 * q[k])
}

fn prove(count: usize, seed: u64, segment: impl Fn(&Scene, &mut Rng) -> [Point; 2]) -> Tally {
    let mut asker = Asker::new();
    let mut sum = Tally::default();
    for scene in all() {
        let rng = &mut Rng::new(seed);
        for _ in 0..count {
            let [a, b] = segment(scene, rng);
            for tally in asker.prove(scene, a, b) {
                sum.hits += tally.hits;
                sum.clear += tally.clear;
                sum.open += tally.open;
            }
        }
    }
    println!("{sum:?}");
    sum
}

#[test]
fn through_the_model_at_random() {
    let sum = prove(60, 1, |scene, rng| [scene.around(2.0, rng), scene.around(2.0, rng)]);
    assert!(sum.hits > 500 && sum.clear > 500, "{sum:?}");
}

#[test]
fn through_points_of_triangles() {
    let sum = prove(60, 2, |scene, rng| {
        let (on, d) = (scene.on_surface(rng), rng.direction());
        let by = scene.size() * rng.range(0.0, 2.0);
        [add(on, d, by), add(on, d, -by)]
    });
    assert!(sum.hits > 1500, "{sum:?}");
}

#[test]
fn through_vertices_and_edges() {
    prove(80, 3, |scene, rng| {
        let corners = scene.corners(rng.below(scene.triangles.len()) as u32);
        let target = if rng.below(2) == 0 { corners[0] } else { middle(corners[1], corners[2]) };
        let d = rng.direction();
        let by = scene.size() * rng.range(0.0, 2.0);
        [add(target, d, by), add(target, d, -by)]
    });
}

#[test]
fn along_edges_and_in_planes() {
    prove(80, 4, |scene, rng| {
        let [u, v, w] = scene.corners(rng.below(scene.triangles.len()) as u32);
        let beyond = |p: Point, q: Point| std::array::from_fn(|k| 2.0 * q[k] - p[k]);
        match rng.below(5) {
            0 => [u, v],
            1 => [beyond(v, u), beyond(u, v)],
            2 => [beyond(middle(u, v), w), middle(u, v)],
            3 => [middle(u, v), middle(v, w)],
            _ => [beyond(v, u), beyond(v, w)],
        }
    });
}

#[test]
fn from_vertex_to_vertex() {
    prove(60, 5, |scene, rng| [scene.vertex(rng), scene.vertex(rng)]);
}

#[test]
fn parallel_to_an_axis() {
    prove(80, 6, |scene, rng| {
        let target = if rng.below(2) == 0 { scene.vertex(rng) } else { scene.on_surface(rng) };
        let (mut a, mut b) = (target, target);
        let (axis, size) = (rng.below(3), scene.size());
        a[axis] += size * rng.range(-2.0, 2.0);
        b[axis] += size * rng.range(-2.0, 2.0);
        [a, b]
    });
}

#[test]
fn of_no_length() {
    prove(60, 7, |scene, rng| {
        let on = match rng.below(3) {
            0 => scene.vertex(rng),
            1 => scene.on_surface(rng),
            _ => scene.around(1.0, rng),
        };
        [on, on]
    });
}

#[test]
fn shorter_than_a_rounding() {
    prove(60, 8, |scene, rng| {
        let on = if rng.below(2) == 0 { scene.vertex(rng) } else { scene.on_surface(rng) };
        let by = scene.size() * 10f32.powf(rng.range(-30.0, -4.0));
        [add(on, rng.direction(), by), add(on, rng.direction(), by)]
    });
}

#[test]
fn from_a_million_sizes_away() {
    prove(60, 9, |scene, rng| {
        let target = if rng.below(2) == 0 { scene.vertex(rng) } else { scene.on_surface(rng) };
        let (d, size) = (rng.direction(), scene.size());
        let far = size * 10f32.powf(rng.range(1.0, 5.5));
        let a = add(target, d, far);
        match rng.below(3) {
            0 => [a, add(target, d, -far)],
            1 => [a, target],
            _ => [add(target, d, -0.1 * size), a],
        }
    });
}

#[test]
fn to_an_end_on_the_surface() {
    prove(80, 10, |scene, rng| {
        let on = if rng.below(2) == 0 { scene.vertex(rng) } else { scene.on_surface(rng) };
        let other = add(on, rng.direction(), scene.size() * 10f32.powf(rng.range(-3.0, 1.5)));
        if rng.below(2) == 0 { [on, other] } else { [other, on] }
    });
}

/// Nearly in a coordinate plane through a vertex: one component is tiny, on both sides of the
/// plane.
#[test]
fn nearly_along_a_coordinate_plane() {
    prove(120, 11, |scene, rng| {
        let target = if rng.below(2) == 0 { scene.vertex(rng) } else { scene.on_surface(rng) };
        let (d, size, axis) = (rng.direction(), scene.size(), rng.below(3));
        let (mut a, mut b) = (add(target, d, size), add(target, d, -size * rng.unit_f32()));
        let tiny = size * 10f32.powf(rng.range(-18.0, -2.0));
        a[axis] = target[axis] + tiny * rng.unit_f32();
        b[axis] = target[axis] - tiny * rng.unit_f32();
        [a, b]
    });
}

/// The model is one point, nearly 2^24 of its grid units from its origin, and lies on the segment
/// exactly.
#[test]
fn through_a_point_far_from_its_origin() {
    let mut asker = Asker::new();
    for at in [16_711_680.0, 16_760_832.0] {
        let scene = Scene::both("far point", (vec![[at, at, 0.0]; 3], vec![[0, 1, 2]]));
        let ways = (1..10).flat_map(|x| (1..10).map(move |y| [x as f32, y as f32, 7.0]));
        for [x, y, z] in ways {
            let far = (1u32 << 24) as f32;
            asker.prove(&scene, [at + x, at + y, z], [at - far * x, at - far * y, -far * z]);
        }
    }
}
