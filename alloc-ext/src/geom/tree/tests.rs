//! The tree against a look at every box.

use super::*;
use crate::random::SplitMix;

fn point(dice: &mut SplitMix) -> DVec3 {
    DVec3::new(dice.roll(), dice.roll(), dice.roll()).as_vec3().as_dvec3()
}

/// Boxes of all sizes, some of them points, moved and scaled.
fn boxes(dice: &mut SplitMix, count: usize, scale: f64, shift: DVec3) -> Vec<Bounds> {
    let mut all = Vec::new();
    for i in 0..count {
        let low = point(dice);
        let high = if i % 3 == 0 { low } else { low + point(dice) * 0.1 };
        all.push(Bounds { low: low * scale + shift, high: high * scale + shift });
    }
    all
}

#[test]
fn every_box_that_is_reached_is_visited_once_from_the_root_and_from_a_frontier() {
    let mut dice = SplitMix::new(3);
    for (count, scale, shift) in [
        (0, 1.0, 0.0),
        (1, 1.0, 0.0),
        (8, 1e-30, 0.0),
        (9, 1e30, 0.0),
        (65, 1.0, 1e6),
        (700, 40.0, -3.0),
    ] {
        let shift = DVec3::splat(shift);
        let boxes = boxes(&mut dice, count, scale, shift);
        let tree = StaticTree::new(&boxes);
        for _ in 0..200 {
            let low = point(&mut dice);
            let of = Bounds {
                low: low * scale + shift,
                high: (low + point(&mut dice) * 0.5) * scale + shift,
            };
            let through = point(&mut dice) * scale + shift;
            let normal = (point(&mut dice) - 0.5).normalize();
            let plane = Plane { normal, offset: normal.dot(through) };
            let mut near = Frontier::default();
            tree.frontier(&of, &mut near);
            for near in [near, Frontier::whole()] {
                let mut visits = vec![0; count];
                tree.visit_raising(&near, tree.probe(&of, &[plane]), |i| {
                    visits[i] += 1;
                    None
                });
                for (b, visits) in boxes.iter().zip(visits) {
                    let wanted = b.meets(&of) && b.support(normal) >= plane.offset;
                    assert!(visits == 1 || (visits == 0 && !wanted), "{visits} visits, {wanted}");
                }
            }
        }
    }
}

#[test]
fn what_is_below_a_raised_plane_is_passed_over() {
    let mut dice = SplitMix::new(4);
    let boxes = boxes(&mut dice, 5_000, 1.0, DVec3::ZERO);
    let tree = StaticTree::new(&boxes);
    let all = Bounds { low: DVec3::splat(-1.0), high: DVec3::splat(2.0) };
    let (mut visits, mut highest) = (0, f64::NEG_INFINITY);
    tree.visit_raising(&Frontier::whole(), tree.probe(&all, &[]), |i| {
        visits += 1;
        let top = boxes[i].high.z;
        (top > highest).then(|| {
            highest = top;
            Plane { normal: DVec3::Z, offset: top }
        })
    });
    assert_eq!(highest, boxes.iter().map(|b| b.high.z).fold(0.0, f64::max));
    assert!(visits < boxes.len() / 2, "{visits}");
}

#[test]
fn the_nearest_box_is_found_wherever_the_point_is() {
    let mut dice = SplitMix::new(5);
    for (count, scale) in [(0, 1.0), (1, 1.0), (9, 1e30), (700, 1e-30), (3_000, 40.0)] {
        let boxes = boxes(&mut dice, count, scale, DVec3::splat(scale));
        let tree = StaticTree::new(&boxes);
        for i in 0..200 {
            let far = if i % 2 == 0 { 2.0 } else { 1e9 };
            let p = (point(&mut dice) - 0.5) * far * scale;
            let distance_sq = |i: usize| {
                (boxes[i].low - p).max(p - boxes[i].high).max(DVec3::ZERO).length_squared()
            };
            let of = |i: usize| (i, distance_sq(i));
            let truth = (0..count).map(of).min_by(|a, b| a.1.total_cmp(&b.1));
            assert_eq!(tree.nearest(p, distance_sq), truth);
        }
    }
}

/// Triangles of a sheet with waves, oblique to all axes.
fn sheet(n: u32, scale: f64, shift: DVec3) -> Vec<[DVec3; 3]> {
    let at = |i: u32, j: u32| {
        let [u, v] = [i, j].map(|i| f64::from(i) / f64::from(n));
        let up = DVec3::new(0.6, 0.48, 0.64) * 0.02 * (9.0 * u).sin() * (7.0 * v).cos();
        let [across, along] = [DVec3::new(0.8, -0.36, -0.48), DVec3::new(0.0, 0.8, -0.6)];
        ((across * u + along * v + up) * scale + shift).as_vec3().as_dvec3()
    };
    let quads = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    quads
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect()
}

fn with_disks(triangles: &[[DVec3; 3]]) -> StaticTree {
    let normal = |i: usize| {
        let [a, b, c] = triangles[i];
        (b - a).cross(c - a)
    };
    StaticTree::of_corners(triangles).with_disks(normal, |i, points| points.extend(triangles[i]))
}

#[test]
fn every_triangle_that_reaches_all_planes_is_visited_once() {
    let mut dice = SplitMix::new(6);
    for (n, scale, shift) in
        [(0, 1.0, 0.0), (1, 1.0, 3.0), (3, 1e-30, 0.0), (9, 1e30, 0.0), (40, 40.0, -1e4)]
    {
        let shift = DVec3::splat(shift);
        let mut triangles = sheet(n, scale, shift);
        // Among them are some of another direction, and some without area.
        for i in 0..triangles.len() / 7 {
            let p = triangles[7 * i][0];
            triangles[7 * i][1] = if i % 2 == 0 { p } else { p + point(&mut dice) * scale };
        }
        let tree = with_disks(&triangles);
        for round in 0..300 {
            // Planes next to the sheet are the ones that disks decide about.
            let near = if round % 2 == 0 || triangles.is_empty() {
                (point(&mut dice) - 0.5).normalize()
            } else {
                let [a, b, c] = triangles[round % triangles.len()];
                let tilt = (point(&mut dice) - 0.5) * 1e-3;
                ((b - a).cross(c - a).normalize_or(DVec3::X) + tilt).normalize()
            };
            let through = match triangles.len() {
                0 => shift,
                count => triangles[(7 * round) % count][2],
            };
            let low = through - point(&mut dice) * scale;
            let of = Bounds { low, high: low + point(&mut dice) * 2.0 * scale };
            let wall = (point(&mut dice) - 0.5).normalize();
            let planes = [near, wall].map(|normal| Plane { normal, offset: normal.dot(through) });
            let mut visits = vec![0; triangles.len()];
            tree.visit_reached(&of, &planes, |i| {
                visits[i] += 1;
                true
            });
            for (t, visits) in triangles.iter().zip(visits) {
                let wanted = Bounds::of(t).meets(&of)
                    && planes.iter().all(|plane| t.iter().any(|&p| plane.holds(p)));
                assert!(visits == 1 || (visits == 0 && !wanted), "{visits} visits, {wanted}");
            }
        }
    }
}

#[test]
fn a_plane_next_to_an_oblique_surface_misses_its_disks_where_it_reaches_its_boxes() {
    let triangles = sheet(64, 1.0, DVec3::ZERO);
    let plain = StaticTree::of_corners(&triangles);
    let disks = with_disks(&triangles);
    let normal = DVec3::new(0.6, 0.48, 0.64);
    let highest =
        triangles.iter().flatten().map(|&p| normal.dot(p)).fold(f64::NEG_INFINITY, f64::max);
    let plane = Plane { normal, offset: highest + 0.02 };
    let probe = |tree: &StaticTree| {
        tree.probe(&Bounds { low: DVec3::splat(-2.0), high: DVec3::splat(2.0) }, &[plane])
    };
    // Nodes of the second level, each of which has hundreds of triangles below it.
    let reached = |tree: &StaticTree| {
        let probe = probe(tree);
        let (mut lanes, entries) = tree.reached(&probe, 0);
        let mut count = 0;
        while lanes != 0 {
            count += tree.reached(&probe, entries[lanes.trailing_zeros() as usize]).0.count_ones();
            lanes &= lanes - 1;
        }
        count
    };
    let (of_boxes, of_disks) = (reached(&plain), reached(&disks));
    assert!(2 * of_disks < of_boxes, "{of_disks} of {of_boxes}");
}
