//! The wide kernels of triangle fans give the bits of the scalar ones.

use glam::Vec3;
use meshsweep_core::internal::geom::fan::{
    ABOVE_ZERO, Edges, FanRay, LANES, Lanes, Nearness, PIECES, PointFan, Ring8, WIDTH, lanes_below,
    point_lanes, point_leaf, ray_leaf, ray_leaf8,
};
use meshsweep_core::internal::num::tolerance::STILL;
use meshsweep_host_tests::generate::Rng;

/// What a leaf holds: triangle `i` is `(centre, ring[i], ring[i + 1])`, its centre the second from
/// `turn` on.
struct Patch {
    centres: [Vec3; 2],
    ring: Vec<Vec3>,
    turn: usize,
}

impl Patch {
    fn count(&self) -> usize {
        self.ring.len() - 1
    }

    fn vertices(&self) -> Vec<Vec3> {
        self.centres.iter().chain(&self.ring).copied().collect()
    }

    fn centre(&self, lane: usize) -> usize {
        usize::from(lane >= self.turn)
    }
}

fn vector(rng: &mut Rng, size: f32) -> Vec3 {
    Vec3::from_array(rng.point_in([-size; 3], [size; 3]))
}

/// Patches on a grid and of any f32, some of them with vertices that coincide, lie on a line or in
/// a plane.
fn patch(rng: &mut Rng) -> Patch {
    let size = [4.0, 300.0, 60_000.0, 1e-3, 1.0][rng.below(5)];
    let at = vector(rng, 30_000.0);
    let grid = rng.below(3) > 0;
    let shape = rng.below(5);
    let along = vector(rng, size);
    let vertex = |rng: &mut Rng| {
        let mut v = at + vector(rng, size);
        match shape {
            0 => v.z = at.z,
            1 => v = at + along * rng.range(-1.0, 1.0),
            2 => v = at + along * rng.range(-1.0, 1.0) + vector(rng, 1e-4 * size),
            _ => {}
        }
        if grid { v.round() } else { v }
    };
    let centres = [vertex(rng), vertex(rng)];
    let count = 1 + rng.below(WIDTH);
    let mut ring: Vec<Vec3> = (0..=count).map(|_| vertex(rng)).collect();
    // Triangles without area, and centres on the ring.
    for i in 0..ring.len() {
        match rng.below(12) {
            0 => ring[i] = ring[i / 2],
            1 => ring[i] = centres[i % 2],
            _ => {}
        }
    }
    let turn = if count > 1 && rng.below(2) == 0 { 1 + rng.below(count - 1) } else { WIDTH };
    Patch { centres, ring, turn }
}

fn points(patch: &Patch, rng: &mut Rng) -> Vec<Vec3> {
    let vertices = patch.vertices();
    let pick = |rng: &mut Rng| vertices[rng.below(vertices.len())];
    (0..12)
        .map(|kind| {
            let (v, w) = (pick(rng), pick(rng));
            match kind % 6 {
                0 => v,
                1 => (v + w) * 0.5,
                2 => (v + w + pick(rng)) * (1.0 / 3.0),
                3 => {
                    let size = 10f32.powf(rng.range(-3.0, 5.0));
                    v + vector(rng, size)
                }
                4 => v + vector(rng, 1e10),
                _ => v.round() + Vec3::new(rng.below(3) as f32, rng.below(3) as f32, 0.5),
            }
        })
        .collect()
}

#[test]
fn points_get_the_same_bits_from_eight_lanes() {
    let rng = &mut Rng::new(1);
    let mut left_out = 0;
    let mut at_centre = 0;
    for _ in 0..20_000 {
        let patch = patch(rng);
        for p in points(&patch, rng) {
            let s = patch.centres.map(|centre| p - centre);
            let spoke = |i: usize, which: usize| patch.ring[i] - patch.centres[which];
            let mut scalar: Vec<Nearness> = Vec::new();
            point_leaf(patch.count(), patch.turn, s, spoke, |lane, near| {
                assert_eq!(lane, scalar.len());
                scalar.push(near);
            });
            assert_eq!(scalar.len(), patch.count());
            // Lanes that are not used may hold anything.
            let anything = [[f32::NAN; WIDTH]; 3];
            let mut rows = [anything; 3];
            for lane in 0..patch.count() {
                let which = patch.centre(lane);
                let sides =
                    [spoke(lane, which), spoke(lane + 1, which), s[which]].map(|v| v.to_array());
                for (rows, side) in rows.iter_mut().zip(sides) {
                    rows.iter_mut().zip(side).for_each(|(row, x)| row[lane] = x);
                }
            }
            let used = lanes_below(patch.count()).expect("at most eight");
            for (piece, used) in (0..PIECES).zip(used) {
                let register = |row: [f32; WIDTH]| {
                    Lanes::new(std::array::from_fn(|lane| row[piece * LANES + lane]))
                };
                let [e, g, s] = rows.map(|rows| rows.map(register));
                let edges = Edges { e, g, s };
                let wide = point_lanes(&edges, used, None).expect("no limit");
                let lanes = [wide.distance_sq, wide.lower_bound_sq, wide.v, wide.w];
                let lanes = lanes.map(Lanes::to_array);
                let here = || (piece * LANES..(piece + 1) * LANES).enumerate();
                for (lane, number) in here().filter(|&(_, number)| number < patch.count()) {
                    let near = scalar[number];
                    assert_eq!(
                        [near.distance_sq, near.lower_bound_sq, near.v, near.w].map(f32::to_bits),
                        lanes.map(|lanes| lanes[lane].to_bits()),
                        "lane {number}: {near:?}, from {p:?}: {:?} {:?}",
                        patch.centres,
                        patch.ring
                    );
                }
                for (lane, _) in here().filter(|&(_, number)| number >= patch.count()) {
                    assert_eq!([lanes[0][lane], lanes[1][lane]], [2f32.powi(127); 2]);
                }
                // A register is left out if and only if planes across the ways to the centres part
                // each of its triangles from the point by more than the limit.
                for limit in [0.25, 0.999, 1.0, 1.5].map(|x| x * scalar[0].distance_sq) {
                    let beyond =
                        here().filter(|&(_, number)| number < patch.count()).all(|(_, number)| {
                            let which = patch.centre(number);
                            let away = p - patch.centres[which];
                            let fan = PointFan::new(away);
                            let [a, b] = [number, number + 1].map(|i| fan.spoke(spoke(i, which)));
                            // Boards compare with `culled_below`, which has no product of squares.
                            let [of_a, of_b] = [a, b].map(|spoke| spoke.edge.dot(away));
                            let culled_below = fan.culled_below(limit);
                            if of_a.max(of_b) < culled_below && culled_below <= ABOVE_ZERO {
                                // Its closest point is the centre, which is not beyond the limit.
                                assert_eq!(scalar[number].distance_sq, fan.centre().distance_sq);
                                at_centre += 1;
                            } else if of_a.max(of_b) < culled_below {
                                let size = a.edge.length() + b.edge.length() + away.length();
                                let distance = scalar[number].distance_sq.sqrt();
                                assert!(distance > limit.sqrt() - 1e-5 * size, "from {p:?}");
                                left_out += 1;
                            }
                            let centre_sq = away.dot(away);
                            let least = centre_sq - of_a.max(of_b).max(0.0);
                            least > 0.0 && least * least > limit * centre_sq
                        });
                    assert_eq!(point_lanes(&edges, used, Some(limit)).is_none(), beyond);
                }
            }
        }
    }
    assert!(left_out > 10_000, "spokes leave out {left_out} triangles");
    assert!(at_centre > 10_000, "{at_centre} triangles are told by their centre");
}

/// A ray through two points, as the queries make it.
fn ray(from: Vec3, to: Vec3, surface: f32, vertices: &[Vec3]) -> FanRay {
    let d = to - from;
    let inverse = d.to_array().map(|x| 1.0 / if x.abs() > STILL { x } else { STILL.copysign(x) });
    let far = vertices.iter().fold(Vec3::ZERO, |far, &v| far.max((v - from).abs()));
    FanRay::new(from.to_array(), d.to_array(), inverse, 1.0, surface, far.x + far.y + far.z)
}

#[test]
fn segments_get_the_same_triangles_from_eight_lanes() {
    let rng = &mut Rng::new(2);
    let (mut flagged, mut looked_at) = (0, 0);
    for _ in 0..20_000 {
        let patch = patch(rng);
        let vertices = patch.vertices();
        for target in points(&patch, rng) {
            let v = vertices[rng.below(vertices.len())];
            let size = 10f32.powf(rng.range(-2.0, 5.0));
            let from = match rng.below(4) {
                // Along edges and diagonals.
                0 => v + (v - target),
                1 => target + Vec3::X * size,
                2 => target,
                _ => target + vector(rng, size),
            };
            let surface = [0.0, 0.87, 1e-4][rng.below(3)];
            let ray = ray(from, target, surface, &vertices);
            let shadows = patch.ring.iter().map(|&vertex| ray.shadow(vertex));
            let lanes =
                ray_leaf(&ray, patch.turn, patch.centres.map(|centre| ray.shadow(centre)), shadows);
            let mut ring = Ring8 {
                here: [[f32::NAN; WIDTH]; 3],
                next: [[f32::NAN; WIDTH]; 3],
                centres: [[0.0; 3]; 2],
            };
            for (k, axis) in ray.axes().into_iter().enumerate() {
                for lane in 0..patch.count() {
                    ring.here[k][lane] = patch.ring[lane][axis];
                    ring.next[k][lane] = patch.ring[lane + 1][axis];
                }
                for which in 0..2 {
                    ring.centres[which][k] = patch.centres[which][axis];
                }
            }
            let wide = ray_leaf8(&ray, &ring, patch.turn, patch.count()).expect("as many as lanes");
            assert_eq!(lanes, wide, "{from:?} {target:?}: {:?} {:?}", patch.centres, patch.ring);
            // What is settled as met was flagged.
            for lane in 0..patch.count() {
                let corners =
                    [patch.centres[patch.centre(lane)], patch.ring[lane], patch.ring[lane + 1]];
                let crossing = ray.crossing(corners.map(|v| ray.shadow(v)), 0.0);
                if crossing.is_some_and(|crossing| crossing.stored | crossing.certain) {
                    assert!(
                        lanes >> lane & 1 != 0,
                        "lane {lane}, {from:?} {target:?}: {corners:?}"
                    );
                }
            }
            flagged += lanes.count_ones();
            looked_at += patch.count();
        }
    }
    let flagged = flagged as usize;
    assert!(flagged > looked_at / 10 && flagged < looked_at * 9 / 10, "{flagged} of {looked_at}");
}
