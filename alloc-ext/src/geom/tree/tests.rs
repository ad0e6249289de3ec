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
