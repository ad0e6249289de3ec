//! What the READMEs of `core/examples` promise is true of the meshes, by the exact oracle.
//! `cargo xtask test` shows that the images print what is promised.

use std::path::Path;

use meshsweep_core::{Solid, TightHulls};
use meshsweep_host_tests::generate::{Triangles, clamps, groove_block, link};
use meshsweep_host_tests::oracle::{distance_of_meshes, distance_to_mesh};

const STILL: [[f32; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// The lines that an example's README promises.
fn promised(name: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../core/examples");
    let text = std::fs::read_to_string(folder.join(name).join("README.md")).expect("there");
    let block = text.split_once("```text\n").and_then(|(_, rest)| rest.split_once("```"));
    block.expect("a block of text").0.to_owned()
}

/// The numbers of the lines that begin so, in order.
fn numbers(lines: &str, beginning: &str) -> Vec<u32> {
    let rests = lines.lines().filter_map(|line| line.trim().strip_prefix(beginning));
    rests.map(|rest| rest.split(' ').next().and_then(|n| n.parse().ok()).expect("n")).collect()
}

#[test]
fn the_probe_stops_at_the_distance_that_it_promises_and_not_too_near() {
    let lines = promised("probe");
    let [heights, from, to] = ["stopped at a height of ", "the part is from ", "to "]
        .map(|beginning| numbers(&lines, beginning));
    assert_eq!((heights.len(), from.len(), to.len()), (2, 2, 2));
    let (positions, triangles) = groove_block();
    for run in 0..2 {
        let tip = [20.0, 20.0, heights[run] as f32 / 1000.0];
        let truth = distance_to_mesh(tip, &positions, &triangles);
        // Printed heights are cut to a micrometre.
        assert!(truth.lower > 2.0, "{truth:?}");
        assert!(truth.upper * 1000.0 + 1.0 > f64::from(from[run]), "{truth:?}");
        assert!(truth.lower * 1000.0 - 1.0 < f64::from(to[run]), "{truth:?}");
    }
    // The exact answer lets it go on until 2.01 are left at both edges of the slot.
    let truth = f64::from(heights[1]) / 1000.0 - 30.0;
    assert!((truth.mul_add(truth, 4.0).sqrt() - 2.01).abs() < 0.005);
    let cut_short = numbers(&lines, "cut short by the budget: ");
    assert_eq!([cut_short[0], 0], [numbers(&lines, "questions: ")[0], cut_short[1]]);
}

/// The head of `keep_out` at a place: the cutter's axis as a thin triangle, and the nose.
fn head(place: [f32; 3]) -> [Triangles; 2] {
    let at = |corner: [f32; 3]| [0, 1, 2].map(|axis| corner[axis] + place[axis]);
    let cutter = [[0.0; 3], [0.0, 0.0, 20.0], [0.0, 0.0, 20.0]].map(at).to_vec();
    let nose = Solid::box_corners([-12.0, -12.0, 20.0], [12.0, 12.0, 80.0]).map(at).to_vec();
    let quads =
        [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
    let faces = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    [(cutter, vec![[0, 1, 2]]), (nose, faces)]
}

/// Distance of the head from the clamps.
fn head_distance(place: [f32; 3], (positions, triangles): &Triangles) -> f64 {
    let [cutter, nose] = head(place).map(|(corners, faces)| {
        distance_of_meshes((positions, triangles), (&corners, &faces), &STILL, [0.0; 3]).lower
    });
    nose.min(cutter - 3.0)
}

#[test]
fn the_head_is_refused_exactly_the_moves_that_do_not_keep_the_distance() {
    let (lines, clamps) = (promised("keep_out"), clamps());
    let moves: [[f32; 3]; 8] = [
        [50.0, 8.0, 5.0],
        [40.0, 8.0, 5.0],
        [44.0, 8.0, 5.0],
        [44.0, 8.0, 60.0],
        [20.0, 8.0, 60.0],
        [20.0, 8.0, 33.0],
        [20.0, 8.0, 32.0],
        [90.0, 8.0, 33.0],
    ];
    let mut place = [50.0, 8.0, 60.0];
    let mut refused = numbers(&lines, "thousandths of it that are clear: ").into_iter();
    for (number, to) in moves.into_iter().enumerate() {
        let on_the_way = |part: u32| {
            let t = part as f32 / 1000.0;
            [0, 1, 2].map(|axis| place[axis] + t * (to[axis] - place[axis]))
        };
        // Every fortieth of the way: 2 mm at most.
        let nearest = (0..=40).map(|k| head_distance(on_the_way(25 * k), &clamps));
        let nearest = nearest.fold(f64::INFINITY, f64::min);
        if lines.contains(&format!("move {} is made\n", number + 1)) {
            assert!(nearest > 1.0, "move {}: {nearest}", number + 1);
            place = to;
        } else {
            assert!(nearest <= 1.0 + 1e-6, "move {}: {nearest}", number + 1);
            let clear = refused.next().expect("told");
            assert!(head_distance(on_the_way(clear), &clamps) > 1.0 - 1e-6);
            assert!(head_distance(on_the_way(clear + 1), &clamps) <= 1.0 + 1e-3);
        }
    }
    assert_eq!(refused.next(), None);
}

#[test]
fn the_finger_is_pushed_by_its_depth_and_all_answers_are_those_of_fresh_queries() {
    let lines = promised("haptics");
    let (positions, triangles) = groove_block();
    let deepest = distance_to_mesh([10.0, 20.0, 29.5], &positions, &triangles);
    let force = f64::from(numbers(&lines, "largest force: ")[0]);
    assert!(force <= 500.0 * deepest.upper && force + 1.5 > 500.0 * deepest.lower);
    let same = numbers(&lines, "answers with the bits of a fresh query: ");
    assert_eq!(same, numbers(&lines, "questions: "));
}

/// Distance of the arm of `guard` in a pose from the link in its way.
fn arm_distance(number: u32) -> f64 {
    let (positions, triangles) = link();
    let fixed: Vec<_> = positions.iter().map(|[x, y, z]| [x + 40.0, *y, z - 50.0]).collect();
    let turned = |half: f32| {
        let cosine = (1.0 - half * half) / (1.0 + half * half);
        (cosine, 2.0 * half / (1.0 + half * half))
    };
    let half = 0.25 - number as f32 / 256.0;
    let (upper, forearm) = (turned(half), turned(1.5 * half));
    let elbow = [60.0 * upper.0, 0.0, 60.0 * upper.1];
    let distances = [(upper, [0.0; 3]), (forearm, elbow)].map(|((cosine, sine), place)| {
        let rotation = [[cosine, 0.0, -sine], [0.0, 1.0, 0.0], [sine, 0.0, cosine]];
        let moved = (&positions[..], &triangles[..]);
        distance_of_meshes((&fixed, &triangles), moved, &rotation, place).lower
    });
    distances[0].min(distances[1])
}

#[test]
fn the_arm_goes_on_while_the_links_themselves_keep_the_distance_and_stops_in_time() {
    let hulls = include_bytes!("../../../core/examples/guard/src/link.msw");
    let hull = TightHulls::open(hulls).expect("opens").finest().expect("there");
    assert_eq!((hull.record().faces, link().1.len()), (40, 284));
    let stopped = numbers(&promised("guard"), "stopped before pose ")[0];
    for number in [0, stopped / 2, stopped - 1] {
        assert!(arm_distance(number) > 6.5, "{number}");
    }
    // The hull is some millimetres wider than the link.
    let then = arm_distance(stopped);
    assert!(then > 5.0 && then < 6.5 + 3.0, "{then}");
}
