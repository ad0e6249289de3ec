//! What the READMEs of `core/examples` promise is true of the meshes, by the exact oracle.
//! `cargo xtask test` shows that the images print what is promised.

use std::f64::consts::FRAC_PI_2;
use std::path::Path;

use meshsweep_core::{Pose, Solid};
use meshsweep_host_tests::generate::{Triangles, clamps, groove_block, link, table};
use meshsweep_host_tests::oracle::placed::{Tree, distance};
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
fn the_finger_is_pushed_by_its_depth_and_all_answers_are_those_of_fresh_queries_and_of_the_pad() {
    let lines = promised("haptics");
    let (positions, triangles) = groove_block();
    let deepest = distance_to_mesh([10.0, 20.0, 29.5], &positions, &triangles);
    let force = f64::from(numbers(&lines, "largest force: ")[0]);
    assert!(force <= 500.0 * deepest.upper && force + 1.5 > 500.0 * deepest.lower);
    let questions = numbers(&lines, "questions: ");
    assert_eq!(numbers(&lines, "answers with the bits of a fresh query: "), questions);
    let agree = "intervals of the field that share a distance with the tree's: ";
    assert_eq!(numbers(&lines, agree), questions);
}

/// Places of the arm of `guard` at a tick, by angles in f64: seven links, a table, a machine.
fn arm(tick: u32) -> [Pose; 9] {
    const START: [f64; 6] = [0.0, 0.05, 0.05, 0.1, 0.1, 0.1];
    const PER_TICK: [f64; 6] = [13.0, 13.0, 13.0, 7.0, 13.0, 7.0];
    let (mut angle, mut axis) = (-FRAC_PI_2, [0.0, 0.0]);
    let mut places = [Pose::IDENTITY; 9];
    places[7].translation = [-100.0, -100.0, -28.0];
    places[8].translation = [210.0, -16.0, -8.0];
    for link in 0..7 {
        if link > 0 {
            axis = [axis[0] + 60.0 * angle.cos(), axis[1] - 60.0 * angle.sin()];
            let half = START[link - 1] + PER_TICK[link - 1] * f64::from(tick) / 65536.0;
            angle += 2.0 * half.atan();
        }
        let (cosine, sine) = (angle.cos() as f32, angle.sin() as f32);
        let rotation = [[cosine, 0.0, sine], [0.0, 1.0, 0.0], [-sine, 0.0, cosine]];
        places[link] = Pose::rigid(rotation, [axis[0] as f32, 0.0, axis[1] as f32]);
    }
    places
}

#[test]
fn the_arm_goes_on_while_all_pairs_keep_their_distances_and_stops_in_time() {
    let trees = [link(), table(), groove_block()].map(|(positions, triangles)| {
        let corners = |face: &[u32; 3]| face.map(|corner| positions[corner as usize]);
        Tree::new(triangles.iter().map(corners).collect())
    });
    // How far each pair is beyond the distance that it keeps, and the pair: the least.
    let beyond = |tick: u32| {
        let tree = |model: usize| &trees[model.saturating_sub(6)];
        let places = arm(tick);
        let placed: Vec<_> = (0..9).map(|model| tree(model).at(&places[model])).collect();
        let links = (0..7).flat_map(|a| (a + 3..7).map(move |b| (a, b, 5.0)));
        let around = (1..7).flat_map(|a| (7..9).map(move |b| (a, b, 10.0)));
        let pairs = links.chain(around).filter(|pair| *pair != (1, 8, 10.0));
        assert_eq!(pairs.clone().count(), 21);
        let beyond = pairs.map(|(a, b, keep)| (distance(&placed[a], &placed[b]) - keep, a, b));
        beyond.min_by(|one, other| one.0.total_cmp(&other.0)).expect("21 pairs")
    };
    let lines = promised("guard");
    let stopped = numbers(&lines, "stopped before tick ")[0];
    // Pairs with the machine are asked with 0.75 more, two links with 1.5 more.
    for tick in [0, stopped / 2, stopped - 1] {
        assert!(beyond(tick).0 > 0.7499, "{tick}: {:?}", beyond(tick));
    }
    let then = beyond(stopped);
    assert!(then.0 > 0.0 && then.0 < 0.7501 && (then.1, then.2) == (6, 8), "{then:?}");
    assert_eq!([numbers(&lines, "model ")[0], numbers(&lines, "and model ")[0]], [6, 8]);
    // No point of a link moves more than half a millimetre in a tick.
    for tick in [0, stopped / 2, stopped - 1] {
        let way = |place: fn(&Pose, [f32; 3]) -> [f64; 3], point| {
            let [before, after] = [arm(tick)[6], arm(tick + 1)[6]].map(|at| place(&at, point));
            (0..3).map(|k| (after[k] - before[k]).powi(2)).sum::<f64>().sqrt()
        };
        let place = |pose: &Pose, point: [f32; 3]| {
            [0, 1, 2].map(|k: usize| {
                let row = pose.rotation[k].iter().zip(point);
                row.map(|(r, x)| f64::from(*r) * f64::from(x)).sum::<f64>()
                    + f64::from(pose.translation[k])
            })
        };
        for point in link().0 {
            assert!(way(place, point) < 0.5, "{tick}");
        }
    }
}
