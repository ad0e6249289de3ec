//! The independent checker proves what the builder wrote, and does not prove what was damaged
//! afterwards.

use super::scenes::{all, options};
use meshsweep::check::{Blob, check_blob, side};
use meshsweep::collapse::Priority;
use meshsweep::cut::cut;
use meshsweep::hull::BuildOptions;
use meshsweep::surface::VertexBits;
use meshsweep_core::Hull;
use meshsweep_host_tests::corrupt::{entry, put_u32, seal, swap_entries, word};
use meshsweep_host_tests::generate::{
    bracket, cube, groove_block, icosphere, rough_sphere, torus, two_parts,
};
use meshsweep_host_tests::scene::Scene;
use std::sync::LazyLock;

// Kinds of sections.
const VERTICES: u32 = 1;
const SPLITS: u32 = 3;
const RINGS: u32 = 4;
const RADII: u32 = 5;
const STARTS: u32 = 7;
const LEVELS: u32 = 10;
const GROUPS: u32 = 11;

#[test]
fn every_generated_mesh_is_proved_nested() {
    for scene in all() {
        let report = check_blob(&scene.bytes).unwrap_or_else(|e| panic!("{}: {e}", scene.name));
        assert!(
            report.planes >= 5 * report.splits && report.splits > 0,
            "{}: {report:?}",
            scene.name
        );
        assert_eq!(report.triangles, scene.triangles.len(), "{}", scene.name);
    }
}

#[test]
fn both_priorities_and_every_vertex_format_are_proved_nested() {
    let meshes = [
        ("torus", torus(2.0, 0.75, 24, 12)),
        ("rough sphere", rough_sphere(2, 0.3, 9)),
        ("groove block", groove_block()),
        ("bracket", bracket()),
        ("two parts", two_parts()),
    ];
    for (name, mesh) in meshes {
        for priority in [Priority::Program, Priority::Span] {
            for vertex_bits in [VertexBits::Grid16, VertexBits::Grid24, VertexBits::F32] {
                // By the program these two are among the scenes above. Meshes of flat faces build
                // a hundred times as long as the others, so they are here in one format.
                let is_first = (priority, vertex_bits) == (Priority::Span, VertexBits::Grid16);
                if matches!(name, "bracket" | "groove block") && !is_first {
                    continue;
                }
                let options = BuildOptions {
                    base_faces: 24,
                    priority,
                    vertex_bits,
                    ..BuildOptions::default()
                };
                let scene = Scene::hull(name, mesh.clone(), &options);
                if let Err(error) = check_blob(&scene.bytes) {
                    panic!("{name}, {priority:?}, {vertex_bits:?}: {error}");
                }
            }
        }
    }
}

#[test]
fn a_cut_blob_is_proved_at_every_level() {
    let scene = Scene::hull("rough sphere", rough_sphere(3, 0.2, 7), &options(40));
    let model = scene.model();
    assert!(model.header().levels > 3);
    for level in 0..model.header().levels {
        let bytes = cut(&model, level).expect("the level exists").to_bytes();
        check_blob(&bytes).unwrap_or_else(|e| panic!("level {level}: {e}"));
    }
}

/// The blob that the defects are sown in: f32 coordinates, indices of two bytes.
fn victim() -> Vec<u8> {
    static WHOLE: LazyLock<Vec<u8>> = LazyLock::new(|| {
        let options = BuildOptions { vertex_bits: VertexBits::F32, ..options(30) };
        let bytes = Scene::hull("rough sphere", rough_sphere(2, 0.2, 7), &options).bytes;
        assert!(check_blob(&bytes).is_ok());
        bytes
    });
    WHOLE.clone()
}

/// Bytes after an edit, with right CRCs.
fn edited(edit: impl FnOnce(&mut [u8])) -> Vec<u8> {
    let mut bytes = victim();
    edit(&mut bytes);
    seal(&mut bytes);
    bytes
}

fn refused(bytes: &[u8], because: &str) {
    let error = check_blob(bytes).expect_err(because);
    assert!(error.contains(because), "refused because {error}, and not because {because}");
}

#[test]
fn a_hull_vertex_moved_inward_by_one_ulp_is_caught() {
    let bytes = victim();
    let blob = Blob::parse(&bytes).expect("a whole blob");
    let at = entry(&bytes, VERTICES).offset as usize;
    let mut caught = 0;
    // Vertices of the base hull that were rounded onto a plane, or as near to one as the format
    // goes.
    for vertex in 0..blob.base_vertices as usize {
        for axis in 0..3 {
            let mut moved = bytes.clone();
            let offset = at + 12 * vertex + 4 * axis;
            let x = f32::from_bits(word(&bytes, offset).expect("in the section"));
            let inward = if x > 0.0 { x.next_down() } else { x.next_up() };
            put_u32(&mut moved, offset, inward.to_bits());
            seal(&mut moved);
            if let Err(error) = check_blob(&moved) {
                caught += usize::from(error.contains("lies inside the plane"));
            }
        }
    }
    assert!(caught > 0, "no vertex is so near a plane that an ulp matters");
}

#[test]
fn a_hull_vertex_moved_inward_by_a_thousandth_is_caught() {
    let blob = Blob::parse(&victim()).expect("a whole blob");
    let split_base = (0..blob.base_vertices).filter(|&v| blob.splits_with[v as usize].is_some());
    for vertex in split_base.take(20) {
        let bytes = edited(|b| {
            let at = entry(b, VERTICES).offset as usize + 12 * vertex as usize;
            for axis in 0..3 {
                let x = f32::from_bits(word(b, at + 4 * axis).expect("in the section"));
                put_u32(b, at + 4 * axis, (x * 0.9).to_bits());
            }
        });
        refused(&bytes, "lies inside the plane");
    }
}

#[test]
fn exchanged_ring_entries_are_caught() {
    let bytes = edited(|b| {
        let at = entry(b, RINGS).offset as usize;
        for k in 0..2 {
            b.swap(at + k, at + 2 + k);
        }
    });
    refused(&bytes, "split 0");
}

#[test]
fn a_moved_right_wing_is_caught() {
    let bytes = edited(|b| {
        // Record: vertex and ring start of two bytes each, right wing, reach.
        let at = entry(b, SPLITS).offset as usize + 4;
        b[at] = if b[at] % 64 == 1 { b[at] + 1 } else { b[at] - 1 };
    });
    assert!(check_blob(&bytes).is_err());
}

#[test]
fn a_shrunk_radius_is_caught_wherever_it_is() {
    let blob = Blob::parse(&victim()).expect("a whole blob");
    let covering = (0..blob.radii.len()).filter(|&index| blob.radii[index] > 2);
    let mut shrunk = 0;
    for index in covering.step_by(7) {
        let bytes = edited(|b| b[entry(b, RADII).offset as usize + index] -= 2);
        refused(&bytes, "leaves out vertex");
        shrunk += 1;
    }
    assert!(shrunk > 20, "only {shrunk} radii were shrunk");
}

#[test]
fn a_triangle_under_another_parent_is_caught() {
    let mut caught = 0;
    for split in 0..40 {
        for bit in [64, 128] {
            let bytes = edited(|b| b[entry(b, SPLITS).offset as usize + 7 * split + 4] ^= bit);
            // The parent beside may contain it too.
            if let Err(error) = check_blob(&bytes) {
                let why = ["leaves out", "its own part", "queue entries"];
                assert!(why.iter().any(|why| error.contains(why)), "{error}");
                caught += 1;
            }
        }
    }
    assert!(caught > 20, "only {caught} were caught");
}

#[test]
fn a_shrunk_group_radius_is_caught() {
    let bytes = edited(|b| {
        let at = entry(b, GROUPS).offset as usize + 6;
        b[at + 1] -= 1;
    });
    refused(&bytes, "base group 0 leaves out");
}

#[test]
fn a_shrunk_reach_is_caught() {
    let bytes = edited(|b| {
        let at = entry(b, SPLITS).offset as usize + 5;
        b[at] -= 2;
    });
    refused(&bytes, "its star radius is");
}

#[test]
fn a_wrong_start_of_source_numbers_is_caught() {
    let bytes = edited(|b| {
        let at = entry(b, STARTS).offset as usize;
        b[at + 2] ^= 1;
    });
    refused(&bytes, "does not start at");
}

#[test]
fn a_prettified_level_table_is_caught() {
    // Record: faces, splits, hull to surface, surface to hull, void.
    for (field, because) in [(2, "from the surface"), (3, "exceeds"), (4, "its void is")] {
        let bytes = edited(|b| {
            let at = entry(b, LEVELS).offset as usize + 4 * field;
            let x = f32::from_bits(word(b, at).expect("in the section"));
            put_u32(b, at, (x * 0.25).to_bits());
        });
        refused(&bytes, because);
    }
}

#[test]
fn a_queue_capacity_that_is_too_small_is_caught() {
    let bytes = edited(|b| put_u32(b, 140, 3));
    refused(&bytes, "queue entries");
}

#[test]
fn a_wrong_checksum_is_caught() {
    let mut bytes = victim();
    let at = entry(&bytes, RADII).offset as usize;
    bytes[at] ^= 1;
    refused(&bytes, "CRC");
    let mut bytes = victim();
    swap_entries(&mut bytes, 0, 1);
    refused(&bytes, "CRC");
}

#[test]
fn signs_agree_with_robust_predicates() {
    let scene = Scene::hull("cube", cube(3), &options(12));
    let blob = Blob::parse(&scene.bytes).expect("a whole blob");
    let coord = |[x, y, z]: [f64; 3]| robust::Coord3D { x, y, z };
    for t in &blob.surface {
        let corners = t.map(|v| blob.vertices[v as usize]);
        for &p in &blob.vertices {
            let [a, b, c] = corners.map(coord);
            // `robust` counts a point below the plane as positive.
            let other = -robust::orient3d(a, b, c, coord(p));
            assert_eq!(
                f64::from(side(corners, p).0),
                if other == 0.0 { 0.0 } else { other.signum() }
            );
        }
    }
}

#[test]
fn same_mesh_and_options_give_the_same_bytes() {
    for mesh in [icosphere(2), torus(2.0, 0.75, 24, 12), bracket()] {
        let one = Scene::hull("one", mesh.clone(), &options(40));
        let other = Scene::hull("other", mesh, &options(40));
        assert!(one.bytes == other.bytes);
    }
}

#[test]
fn levels_rise_in_faces_and_fall_in_void() {
    for scene in all() {
        let model = Hull::open(&scene.bytes).expect("opens");
        let levels: Vec<_> = model.levels().collect();
        assert!(
            levels.is_sorted_by(|x, y| x.faces < y.faces && x.splits <= y.splits),
            "{}",
            scene.name
        );
        assert!(levels.is_sorted_by(|x, y| x.void_ratio >= y.void_ratio), "{}", scene.name);
        assert_eq!(
            levels.last().map(|l| l.faces as usize),
            Some(scene.triangles.len()),
            "{}",
            scene.name
        );
    }
}

#[test]
fn an_error_that_no_removed_triangle_has_is_caught() {
    let bytes = edited(|b| {
        let (splits, count) = (entry(b, SPLITS), word(b, 64).expect("the count of splits"));
        let record = splits.bytes as usize / count as usize;
        let error = splits.offset as usize + 3 * record + record - 1;
        assert!((1..254).contains(&b[error]));
        b[error] += 1;
    });
    refused(&bytes, "its error is");
}
