//! The hull hierarchy of a mesh that deforms: between key frames, and by free motion. No interval
//! loses the distance to the moved mesh, which is found by brute force in f64.

use super::scenes::options;
use glam::DVec3;
use meshsweep::check::check_blob;
use meshsweep::hull::{self, Levels};
use meshsweep::mesh::{KeyFrame, Mesh};
use meshsweep::progress::Watch;
use meshsweep_core::{
    Blob, Budget, BuildFor, ClosestPoint, DeformableHull, Ended, MovedHull, MovedVertex, OpenError,
    QueryError, ScratchEntry, SectionKind,
};
use meshsweep_host_tests::corrupt::{entry, put_u32, seal};
use meshsweep_host_tests::generate::{Rng, Triangles, cube, icosphere, rough_sphere, torus};
use meshsweep_host_tests::oracle::distance_to_wide_mesh;
use std::f64::consts::PI;
use std::ops::Range;

/// Frames of a motion.
const FRAMES: usize = 1000;

pub fn build(mesh: &Triangles, frames: &[Vec<[f32; 3]>]) -> Vec<u8> {
    build_levels(mesh, frames, |frames| Levels::Deform(frames))
}

pub fn build_levels(
    (positions, triangles): &Triangles,
    frames: &[Vec<[f32; 3]>],
    levels: fn(&[KeyFrame]) -> Levels<'_>,
) -> Vec<u8> {
    let mesh = Mesh::new(positions.clone(), triangles.clone());
    let key = |positions: &Vec<[f32; 3]>| KeyFrame { positions: positions.clone(), rounding: 0.0 };
    let frames: Vec<KeyFrame> = frames.iter().map(key).collect();
    let options = options(40).with_levels(levels(&frames));
    hull::build(mesh.as_input(), &options, Watch::NONE).expect("it builds").0.to_bytes()
}

/// The hull hierarchy of a sphere that does not deform.
fn rigid() -> Vec<u8> {
    let (positions, triangles) = icosphere(1);
    let mesh = Mesh::new(positions, triangles);
    hull::build(mesh.as_input(), &options(40), Watch::NONE).expect("it builds").0.to_bytes()
}

/// A strong motion, of a mesh about the origin of about one unit: it bends about y, twists about z,
/// and turns the upper half by 180° until `t` = 1.
pub fn motion(positions: &[[f32; 3]], t: f64) -> Vec<[f32; 3]> {
    let turned = |x: f64, y: f64, angle: f64| {
        let (sin, cos) = angle.sin_cos();
        (cos * x - sin * y, sin * x + cos * y)
    };
    let moved = |p: &[f32; 3]| {
        let [x, y, z] = p.map(f64::from);
        let upper = (2.0 * z + 0.5).clamp(0.0, 1.0);
        let (x, y) = turned(x, y, t * (PI * upper + 0.7 * z));
        let (z, x) = turned(z, x, t * 1.2 * z);
        [x + 0.3 * t * (3.0 * z).sin(), y * (1.0 + 0.5 * t), z].map(|x| x as f32)
    };
    positions.iter().map(moved).collect()
}

pub fn wide(positions: &[[f32; 3]]) -> Vec<DVec3> {
    positions.iter().map(|p| DVec3::from(p.map(f64::from))).collect()
}

/// Fails unless the interval contains the distance. `size`: that of the model and the question.
pub fn holds(answer: &ClosestPoint, p: [f32; 3], positions: &[DVec3], triangles: &[[u32; 3]]) {
    let size = positions.iter().fold(0f64, |most, p| most.max(p.abs().max_element()));
    let slack = 1e-8 * 1e-5 * (size + f64::from(p.iter().fold(0f32, |m, x| m.max(x.abs()))));
    let truth = distance_to_wide_mesh(p, positions, triangles);
    let (lower, upper) = (f64::from(answer.distance.lower), f64::from(answer.distance.upper));
    assert!(lower <= truth + slack && truth - slack <= upper, "{p:?}: {truth:e}: {answer:?}");
}

/// A point anywhere about the mesh, or beside one of its vertices.
pub fn point(positions: &[DVec3], rng: &mut Rng, near: bool) -> [f32; 3] {
    let size = positions.iter().fold(0f64, |most, p| most.max(p.abs().max_element()));
    let mut coordinate = |reach: f64| (2.0 * rng.unit_f64() - 1.0) * reach;
    let off = DVec3::new(coordinate(1.0), coordinate(1.0), coordinate(1.0));
    let at = if near {
        let index = ((coordinate(0.5) + 0.5) * positions.len() as f64) as usize;
        positions[index.min(positions.len() - 1)] + off * (0.02 * size)
    } else {
        off * (1.5 * size)
    };
    at.to_array().map(|x| x as f32)
}

fn scratch(hull: &DeformableHull<'_>) -> Vec<ScratchEntry> {
    vec![ScratchEntry::EMPTY; hull.rest().scratch_entries()]
}

pub fn memory(hull: &DeformableHull<'_>) -> Vec<MovedVertex> {
    vec![MovedVertex::EMPTY; hull.vertex_records()]
}

pub fn place(moved: &mut MovedHull<'_, '_>, positions: &[[f32; 3]]) {
    moved.update(|vertex| positions[vertex as usize]).expect("in the domain");
}

#[test]
fn no_interval_of_a_thousand_free_poses_loses_the_distance() {
    let meshes = [torus(0.8, 0.3, 24, 12), icosphere(3), rough_sphere(2, 0.3, 5), cube(6)];
    for (index, mesh) in meshes.iter().enumerate() {
        let built = build(mesh, &[]);
        let hull = DeformableHull::open(&built).expect("just built");
        let (mut memory, mut scratch) = (memory(&hull), scratch(&hull));
        let mut moved = hull.moved(&mut memory).expect("enough records");
        let mut rng = Rng::new(31 + index as u64);
        for frame in 0..FRAMES {
            let positions = motion(&mesh.0, 2.0 * frame as f64 / FRAMES as f64);
            place(&mut moved, &positions);
            let positions = wide(&positions);
            for near in [false, true, true] {
                let p = point(&positions, &mut rng, near);
                let answer = moved.closest_point(p, Budget::EXACT, &mut scratch).expect("finite");
                assert_eq!(answer.ended, Ended::Exact);
                holds(&answer, p, &positions, &mesh.1);
                let early = Budget::EXACT.with_steps(frame as u32 % 50);
                let answer = moved.closest_point(p, early, &mut scratch).expect("finite");
                holds(&answer, p, &positions, &mesh.1);
            }
        }
    }
}

#[test]
fn no_interval_between_key_frames_loses_the_distance() {
    let meshes = [torus(0.8, 0.3, 24, 12), rough_sphere(3, 0.3, 6)];
    for (index, mesh) in meshes.iter().enumerate() {
        let keys: Vec<_> = (1..6).map(|key| motion(&mesh.0, f64::from(key) / 3.0)).collect();
        let built = build(mesh, &keys);
        let hull = DeformableHull::open(&built).expect("just built");
        assert_eq!(hull.frames(), 6);
        let mut scratch = scratch(&hull);
        let mut rng = Rng::new(41 + index as u64);
        for step in 0..=FRAMES {
            let frame = 5.0 * step as f32 / FRAMES as f32;
            let at = hull.at_frame(frame).expect("a frame");
            let positions = between(&mesh.0, &keys, frame);
            for near in [false, true, true] {
                let p = point(&positions, &mut rng, near);
                let answer = at.closest_point(p, Budget::EXACT, &mut scratch).expect("finite");
                assert_eq!(answer.ended, Ended::Exact);
                holds(&answer, p, &positions, &mesh.1);
                let early = Budget::EXACT.with_steps(step as u32 % 50);
                let answer = at.closest_point(p, early, &mut scratch).expect("finite");
                holds(&answer, p, &positions, &mesh.1);
            }
        }
    }
}

/// The mesh between the keys, of which `rest` is the first.
pub fn between(rest: &[[f32; 3]], keys: &[Vec<[f32; 3]>], frame: f32) -> Vec<DVec3> {
    let key = |index: usize| wide(if index == 0 { rest } else { &keys[index - 1] });
    let before = frame as usize;
    let part = f64::from(frame) - before as f64;
    if part == 0.0 {
        return key(before);
    }
    let ends = key(before).into_iter().zip(key(before + 1));
    ends.map(|(a, b)| a * (1.0 - part) + b * part).collect()
}

/// The counterexample to radii of nearest points that each key chooses anew: a bar that turns end
/// for end is the same set of points in both keys, and a point half-way between.
#[test]
fn a_bar_that_turns_end_for_end_stays_covered() {
    let (mut bar, triangles) = cube(8);
    bar.iter_mut().for_each(|[x, ..]| *x *= 10.0);
    let turned = bar.iter().map(|&[x, y, z]| [-x, -y, z]).collect();
    let mesh = (bar, triangles);
    let keys = [turned];
    let built = build(&mesh, &keys);
    let hull = DeformableHull::open(&built).expect("just built");
    let mut scratch = scratch(&hull);
    let mut rng = Rng::new(51);
    for step in 0..=200 {
        let frame = step as f32 / 200.0;
        let positions = between(&mesh.0, &keys, frame);
        let at = hull.at_frame(frame).expect("a frame");
        for near in [false, true, true, true] {
            let p = point(&positions, &mut rng, near);
            for budget in [Budget::EXACT, Budget::EXACT.with_steps(12)] {
                let answer = at.closest_point(p, budget, &mut scratch).expect("finite");
                holds(&answer, p, &positions, &mesh.1);
            }
        }
    }
}

#[test]
fn exact_intervals_are_narrow() {
    let mesh = torus(0.8, 0.3, 24, 12);
    let keys = [motion(&mesh.0, 1.0)];
    let built = build(&mesh, &keys);
    let hull = DeformableHull::open(&built).expect("just built");
    let (mut memory, mut scratch) = (memory(&hull), scratch(&hull));
    let mut moved = hull.moved(&mut memory).expect("enough records");
    place(&mut moved, &keys[0]);
    let mut rng = Rng::new(61);
    for _ in 0..500 {
        let p = point(&wide(&keys[0]), &mut rng, false);
        let free = moved.closest_point(p, Budget::EXACT, &mut scratch).expect("finite");
        let at = hull.at_frame(1.0).expect("a key");
        let key = at.closest_point(p, Budget::EXACT, &mut scratch).expect("finite");
        let at = hull.at_frame(0.5).expect("a frame");
        let half = at.closest_point(p, Budget::EXACT, &mut scratch).expect("finite");
        for (answer, allowed) in [(free, 4e-7), (key, 4e-7), (half, 6e-6)] {
            let width = answer.distance.upper - answer.distance.lower;
            assert!(width <= allowed * (1.0 + answer.distance.upper), "{answer:?}");
        }
        assert_eq!(free.distance, key.distance, "a key and the same free motion");
        assert!((free.point[0] - key.point[0]).abs() < 1e-6);
    }
}

#[test]
fn identity_answers_as_the_hull_at_rest() {
    let mesh = rough_sphere(3, 0.2, 9);
    let built = build(&mesh, std::slice::from_ref(&mesh.0));
    let hull = DeformableHull::open(&built).expect("just built");
    let (mut memory, mut scratch) = (memory(&hull), scratch(&hull));
    let mut moved = hull.moved(&mut memory).expect("enough records");
    let mut rng = Rng::new(71);
    let positions = wide(&mesh.0);
    for step in 0..200 {
        if step == 100 {
            place(&mut moved, &mesh.0);
        }
        let p = point(&positions, &mut rng, step % 2 == 0);
        let rest = hull.rest().closest_point(p, Budget::EXACT, &mut scratch).expect("finite");
        let free = moved.closest_point(p, Budget::EXACT, &mut scratch).expect("finite");
        assert_eq!((rest.distance, rest.triangle), (free.distance, free.triangle));
        for frame in [0.0, 1.0] {
            let at = hull.at_frame(frame).expect("a key");
            let key = at.closest_point(p, Budget::EXACT, &mut scratch).expect("finite");
            assert_eq!((rest.distance, rest.triangle), (key.distance, key.triangle));
        }
        let at = hull.at_frame(0.3).expect("a frame");
        let key = at.closest_point(p, Budget::EXACT, &mut scratch).expect("finite");
        holds(&key, p, &positions, &mesh.1);
    }
}

#[test]
fn tiny_and_huge_meshes_deform_as_others() {
    for scale in [1e-30f32, 1e30] {
        let (unit, triangles) = torus(0.8, 0.3, 16, 8);
        let scaled =
            |positions: &[[f32; 3]]| positions.iter().map(|p| p.map(|x| x * scale)).collect();
        let rest: Vec<[f32; 3]> = scaled(&unit);
        let keys: [Vec<[f32; 3]>; 1] = [scaled(&motion(&unit, 1.0))];
        let mesh = (rest, triangles);
        let built = build(&mesh, &keys);
        let hull = DeformableHull::open(&built).expect("just built");
        let (mut memory, mut scratch) = (memory(&hull), scratch(&hull));
        let mut moved = hull.moved(&mut memory).expect("enough records");
        let mut rng = Rng::new(81);
        for step in 0..=50 {
            let frame = step as f32 / 50.0;
            let at = hull.at_frame(frame).expect("a frame");
            let positions = between(&mesh.0, &keys, frame);
            let p = point(&positions, &mut rng, true);
            let answer = at.closest_point(p, Budget::EXACT, &mut scratch).expect("finite");
            holds(&answer, p, &positions, &mesh.1);
            let free = scaled(&motion(&unit, f64::from(frame)));
            place(&mut moved, &free);
            let answer = moved.closest_point(p, Budget::EXACT, &mut scratch).expect("finite");
            holds(&answer, p, &wide(&free), &mesh.1);
        }
    }
}

#[test]
fn a_refused_update_leaves_no_pose() {
    let mesh = icosphere(1);
    let built = build(&mesh, &[]);
    let hull = DeformableHull::open(&built).expect("just built");
    let (mut memory, mut scratch) = (memory(&hull), scratch(&hull));
    let mut moved = hull.moved(&mut memory).expect("enough records");
    let mut ask = |moved: &MovedHull<'_, '_>| {
        moved.closest_point([3.0, 0.0, 0.0], Budget::EXACT, &mut scratch).map(|near| near.distance)
    };
    let rest = ask(&moved).expect("at rest");
    for wrong in [f32::NAN, f32::INFINITY, 64.0 * 2.0] {
        let refused = moved.update(|vertex| match vertex {
            7 => [0.0, wrong, 0.0],
            _ => mesh.0[vertex as usize],
        });
        assert_eq!(refused, Err(QueryError::VertexOutOfDomain { vertex: 7 }));
        assert_eq!(ask(&moved), Err(QueryError::NoPose));
    }
    moved.reset().expect("an opened model");
    assert_eq!(ask(&moved), Ok(rest));
    // One record too few.
    let needed = hull.vertex_records();
    let refused = hull.moved(&mut memory[1..]).map(|_| ());
    let [needed, found] = [needed, needed - 1].map(|count| count as u32);
    assert_eq!(refused, Err(QueryError::VertexRecords { needed, found }));
    for frame in [-0.5, 0.5, 1.0, f32::NAN, f32::INFINITY] {
        assert_eq!(hull.at_frame(frame).map(|_| ()), Err(QueryError::NoFrame { frames: 1 }));
    }
}

#[test]
fn far_points_and_a_mesh_that_shrinks_to_a_point_are_answered() {
    let mesh = icosphere(2);
    let built = build(&mesh, &[]);
    let hull = DeformableHull::open(&built).expect("just built");
    let (mut memory, mut scratch) = (memory(&hull), scratch(&hull));
    let mut moved = hull.moved(&mut memory).expect("enough records");
    let poses: [Vec<[f32; 3]>; 3] = [
        vec![[0.25, 0.5, 0.75]; mesh.0.len()],
        mesh.0.iter().map(|&[x, y, _]| [x, y, 0.0]).collect(),
        mesh.0.iter().map(|p| p.map(|x| 60.0 * x)).collect(),
    ];
    for positions in poses {
        place(&mut moved, &positions);
        let wide = wide(&positions);
        for far in [0.1, 3.0, 70.0, 1e5, 1e9, 1e20] {
            let p = [0.3 * far, -far, 0.7];
            let answer = moved.closest_point(p, Budget::EXACT, &mut scratch).expect("finite");
            holds(&answer, p, &wide, &mesh.1);
        }
    }
}

#[test]
fn the_checker_proves_the_radii_of_keys() {
    let mesh = rough_sphere(2, 0.3, 3);
    let keys = [motion(&mesh.0, 0.5), motion(&mesh.0, 1.5)];
    let mut bytes = build(&mesh, &keys);
    let report = check_blob(&bytes).expect("as built");
    assert!(report.key_pairs > 1000, "{report:?}");
    // The greatest radius of the last key, halved.
    let radii = section(&bytes, SectionKind::KeyFrames).end;
    let count = {
        let hull = DeformableHull::open(&bytes).expect("as built").rest();
        let h = hull.header();
        (h.base_triangles + h.rings + 2 * h.splits) as usize
    };
    let last = &mut bytes[radii - count..radii];
    let most = last.iter_mut().filter(|code| **code < 255).max().expect("some radius");
    *most -= 8;
    seal(&mut bytes);
    DeformableHull::open(&bytes).expect("radii are claims");
    let error = check_blob(&bytes).expect_err("a radius is too small");
    assert!(error.contains("key 2"), "{error}");
}

/// Where the bytes of a section lie.
pub fn section(bytes: &[u8], kind: SectionKind) -> Range<usize> {
    let entry = entry(bytes, kind as u32);
    let start = entry.offset as usize;
    start..start + entry.bytes as usize
}

fn small() -> Vec<u8> {
    let mesh = icosphere(1);
    let keys = [motion(&mesh.0, 0.5), motion(&mesh.0, 1.0)];
    build(&mesh, &keys)
}

/// Opens a small blob after an edit of a section, its CRCs right. The edit gets the section's
/// offset.
fn edited(kind: SectionKind, edit: impl FnOnce(&mut Vec<u8>, usize)) -> Result<(), OpenError> {
    let mut bytes = small();
    let offset = section(&bytes, kind).start;
    edit(&mut bytes, offset);
    seal(&mut bytes);
    assert_eq!(Blob::open(&bytes).map(|_| ()), DeformableHull::open(&bytes).map(|_| ()));
    DeformableHull::open(&bytes).map(|_| ())
}

#[test]
fn open_refuses_what_the_new_sections_must_not_hold() {
    use SectionKind::{KeyFrames, VertexNumbers};
    let record = |section, index| Err(OpenError::Record { section, index });
    assert_eq!(edited(KeyFrames, |_, _| ()), Ok(()));
    // Number 42 of 42 vertices.
    assert_eq!(edited(VertexNumbers, |b, at| b[at + 4] = 42), record(VertexNumbers, 0));
    let nan = f32::NAN.to_bits();
    for (what, bits) in [(4, nan), (4, (-1f32).to_bits()), (8, nan), (20, 200f32.to_bits())] {
        let refused = edited(KeyFrames, |b, at| put_u32(b, at + what, bits));
        assert_eq!(refused, record(KeyFrames, 1), "{what}");
    }
    // A vertex of the second key.
    let vertex = |b: &mut Vec<u8>, at: usize, bits: u32| put_u32(b, at + 4 + 2 * 28, bits);
    for bits in [nan, f32::INFINITY.to_bits(), 100f32.to_bits()] {
        assert_eq!(edited(KeyFrames, |b, at| vertex(b, at, bits)), record(KeyFrames, 1));
    }
    for count in [0, 1, 3, 1 << 16, u32::MAX] {
        let refused = edited(KeyFrames, |b, at| put_u32(b, at, count));
        assert!(matches!(refused, Err(OpenError::Section { .. })), "{count}: {refused:?}");
    }
    for count in [300, u32::MAX] {
        let refused = edited(VertexNumbers, |b, at| put_u32(b, at, count));
        assert!(matches!(refused, Err(OpenError::Section { .. })), "{count}: {refused:?}");
    }
    let hull = rigid();
    let missing = OpenError::MissingSection { section: VertexNumbers };
    assert_eq!(DeformableHull::open(&hull).map(|_| ()), Err(missing));
    let refused = Blob::open(&hull).expect("a hull").deformable_hull().map(|_| ());
    assert_eq!(refused, Err(QueryError::NotServed { build_for: BuildFor::Deform }));
}

#[test]
fn every_damaged_byte_is_refused_or_safe_to_ask() {
    let whole = small();
    let mut rng = Rng::new(91);
    for kind in [SectionKind::VertexNumbers, SectionKind::KeyFrames] {
        for at in section(&whole, kind) {
            let mut bytes = whole.clone();
            bytes[at] ^= 1 << rng.below(8);
            assert!(DeformableHull::open(&bytes).is_err(), "its CRC is wrong");
            seal(&mut bytes);
            let Ok(hull) = DeformableHull::open(&bytes) else { continue };
            let mut scratch = [ScratchEntry::EMPTY; 24];
            for frame in [0.25, 1.0, 1.75] {
                let at = hull.at_frame(frame).expect("a frame");
                let p = [0.1, 0.2, 0.3];
                let near = at.closest_point(p, Budget::EXACT, &mut scratch).expect("opened");
                assert!(near.distance.lower <= near.distance.upper, "{near:?}");
            }
        }
    }
}

#[test]
fn a_blob_without_new_sections_keeps_its_minor_version() {
    let minor = |bytes: &[u8]| u16::from_le_bytes([bytes[10], bytes[11]]);
    assert_eq!((minor(&rigid()), minor(&build(&icosphere(1), &[]))), (0, 1));
}
