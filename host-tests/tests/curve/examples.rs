//! What the README of the example `fence` promises is true of its zones, by the exact oracle.
//! `cargo xtask test` shows that the images print what is promised.

use meshsweep::curve::Polyline;
use meshsweep_host_tests::generate::curves::zones;
use meshsweep_host_tests::oracle::{distance_to_segments, winding_about};
use std::path::Path;

/// The start of each leg and its way from tick to tick, in 64ths of a metre.
const LEGS: [[[i32; 2]; 2]; 5] = [
    [[60 * 64, 120 * 64], [20, 0]],
    [[200 * 64, 60 * 64], [0, -20]],
    [[370 * 64, 120 * 64], [0, 16]],
    [[300 * 64, 150 * 64], [-20, 0]],
    [[200 * 64, 180 * 64], [-12, -16]],
];

/// The distance to keep, in metres.
const KEEP: f64 = 28.0;

/// How far the line of a zone is.
fn distance_to_zone([x, y]: [f32; 2], Polyline { points, .. }: &Polyline) -> f64 {
    let ends = points.iter().zip(points.iter().cycle().skip(1)).map(|(a, b)| [*a, *b]);
    distance_to_segments([x, y, 0.0], ends).lower
}

/// How far the vehicle is from the nearest line, in metres, and whether it is allowed there.
fn truth([x, y]: [f32; 2]) -> (f64, bool) {
    let zones = zones();
    let distances = zones.iter().map(|zone| distance_to_zone([x, y], zone));
    let distance = distances.fold(f64::INFINITY, f64::min);
    let is_in = |zone: usize| winding_about([x, y], &zones[zone].points) != Some(0);
    (distance, is_in(0) && !is_in(1) && !is_in(2))
}

#[test]
fn the_vehicle_brakes_where_the_line_is_as_near_as_promised_and_not_before() {
    let readme = Path::new(env!("CARGO_MANIFEST_DIR")).join("../core/examples/fence/README.md");
    let text = std::fs::read_to_string(readme).expect("there");
    let block = text.split_once("```text\n").and_then(|(_, rest)| rest.split_once("```"));
    let legs: Vec<&str> = block.expect("a block of text").0.split("leg ").skip(1).collect();
    assert_eq!(legs.len(), LEGS.len());
    for (leg, [start, step]) in legs.into_iter().zip(LEGS) {
        let place = |tick: i32| [0, 1].map(|axis| (start[axis] + tick * step[axis]) as f32 / 64.0);
        let number = |name: &str| {
            let line = leg.lines().find_map(|line| line.trim().strip_prefix(name));
            line.map(|rest| rest.parse::<i32>().expect("a number"))
        };
        let keeps = |ticks: std::ops::Range<i32>| {
            ticks.into_iter().all(|tick| {
                let (distance, is_allowed) = truth(place(tick));
                is_allowed && distance >= KEEP
            })
        };
        if let Some(ended) = number("brakes after ms: ") {
            let (distance, is_allowed) = truth(place(ended / 20));
            let promised = f64::from(number("millimetres left, for certain: ").expect("told"));
            assert!(is_allowed && keeps(0..ended / 20), "{leg}");
            assert!(distance * 1000.0 >= promised && distance < KEEP + 0.02, "{leg} {distance}");
            assert!(distance * 1000.0 < promised + 20.0, "{leg} {distance}");
            let nearest = number("the nearest line is of zone ").expect("told");
            let of_zone = distance_to_zone(place(ended / 20), &zones()[nearest as usize]);
            assert!(of_zone <= distance * (1.0 + 1e-12), "{leg} {of_zone}");
        } else if let Some(ended) = number("is flown to its end in ms: ") {
            assert!(keeps(0..ended / 20), "{leg}");
        } else {
            let ended = number("is not proved to be inside after ms: ").expect("one of three");
            assert!(!truth(place(ended / 20)).1, "{leg}");
        }
    }
}
