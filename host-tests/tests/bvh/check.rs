//! The independent checker proves box trees that the builder wrote, and does not prove what was
//! damaged afterwards.

use meshsweep::bvh::{TreeOptions, build};
use meshsweep::check::{TreeProof, check_tree};
use meshsweep::mesh::Mesh;
use meshsweep::progress::Watch;
use meshsweep_host_tests::corrupt::{Entry, entry, put_u32, seal, word};
use meshsweep_host_tests::generate::{
    Triangles, bracket, cube, groove_block, icosphere, inverted, needle_comb, rough_sphere, scaled,
    torus, transformed, two_parts,
};
use std::sync::OnceLock;

// Kinds of sections.
const HEADER: u32 = 12;
const LINKS: u32 = 13;
const FRAMES: u32 = 14;
const BOXES: u32 = 15;
const FANS: u32 = 16;
const SOURCE: u32 = 17;
const MOMENTS: u32 = 24;

fn scene((positions, triangles): Triangles, options: &TreeOptions) -> (Vec<u8>, Mesh) {
    let mesh = Mesh::new(positions, triangles);
    let (tables, _) = build(mesh.as_input(), options, Watch::NONE).expect("builds");
    (tables.to_bytes(), mesh)
}

fn kinds() -> [TreeOptions; 4] {
    let all = TreeOptions::default().with_segments(true).with_winding(true);
    let closest = all.with_segments(false);
    let segments = all.with_closest(false);
    [all, closest, segments, all.with_f32(true)]
}

fn prove(name: &str, mesh: &Triangles, options: &TreeOptions) -> TreeProof {
    let (bytes, mesh) = scene(mesh.clone(), options);
    check_tree(&bytes, &mesh).unwrap_or_else(|e| panic!("{name}, {options:?}: {e}"))
}

#[test]
fn every_generated_mesh_is_proved_contained() {
    let meshes = [
        ("cube", cube(3)),
        ("icosphere", icosphere(3)),
        ("torus", torus(2.0, 0.75, 40, 24)),
        ("rough sphere", rough_sphere(3, 0.3, 9)),
        ("groove block", groove_block()),
        ("needle comb", needle_comb()),
        ("bracket", bracket()),
        ("two parts", two_parts()),
        (
            "far from its origin",
            transformed(
                &bracket(),
                [[0.1, 0.0, 0.0], [0.0, 0.1, 0.0], [0.0, 0.0, 0.1]],
                [900.0, -7.0, 0.5],
            ),
        ),
        (
            "flat",
            transformed(&cube(4), [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.0]], [0.0; 3]),
        ),
        (
            "a line",
            transformed(&cube(2), [[1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 0.0]], [0.0; 3]),
        ),
        ("small", scaled(&torus(2.0, 0.75, 12, 8), 1.0e-30)),
        ("large", scaled(&torus(2.0, 0.75, 12, 8), 1.0e30)),
    ];
    for (name, mesh) in meshes {
        for options in kinds() {
            let proof = prove(name, &mesh, &options);
            assert_eq!(proof.triangles, mesh.1.len(), "{name}");
            assert!(proof.contained >= 3 * proof.vertices, "{name}: {proof:?}");
            assert_eq!(proof.frames > 0, options.closest, "{name}: {proof:?}");
            assert_eq!(proof.moments > 0, options.winding, "{name}: {proof:?}");
        }
    }
}

#[test]
fn a_soup_with_repeats_and_degenerate_triangles_loses_none() {
    let (positions, mut triangles) = rough_sphere(2, 0.2, 3);
    triangles.extend_from_within(..40);
    triangles.extend([[0, 0, 1], [2, 2, 2], [3, 4, 3]]);
    // An edge with three triangles, and one that runs the wrong way.
    triangles.extend([[0, 1, 9], [1, 0, 11]]);
    let soup = (positions, triangles);
    for options in kinds() {
        assert_eq!(prove("soup", &soup, &options).triangles, soup.1.len());
    }
}

#[test]
fn one_triangle_and_one_point_are_trees() {
    let triangle = (vec![[0.0, 0.0, 0.0], [1.0, 0.5, 0.0], [0.0, 1.0, 0.25]], vec![[0, 1, 2]]);
    let point = (vec![[0.3, -7.0, 2.0]], vec![[0, 0, 0]]);
    for mesh in [triangle, point] {
        for options in kinds() {
            assert_eq!(prove("one", &mesh, &options).triangles, 1);
        }
    }
}

/// A blob that the checker proves, and its mesh.
fn sound() -> &'static (Vec<u8>, Mesh) {
    static SOUND: OnceLock<(Vec<u8>, Mesh)> = OnceLock::new();
    SOUND.get_or_init(|| {
        let (bytes, mesh) = scene(bracket(), &kinds()[0]);
        check_tree(&bytes, &mesh).expect("sound before");
        (bytes, mesh)
    })
}

/// Changes a blob and reseals it; the checker's complaint.
fn damaged(kind: u32, damage: impl Fn(&mut [u8], Entry)) -> String {
    let (bytes, mesh) = sound();
    let mut bytes = bytes.clone();
    let entry = entry(&bytes, kind);
    damage(&mut bytes, entry);
    assert!(check_tree(&bytes, mesh).expect_err("a CRC").contains("CRC"));
    seal(&mut bytes);
    check_tree(&bytes, mesh).expect_err("it was damaged")
}

fn section(bytes: &mut [u8], entry: Entry) -> &mut [u8] {
    &mut bytes[entry.offset as usize..][..entry.bytes as usize]
}

/// Draws in one plane of the root's first box by `steps`.
fn shrink(bytes: &mut [u8], entry: Entry, row: usize, steps: i16) {
    let byte = &mut section(bytes, entry)[8 * row];
    *byte = (i16::from(*byte) + steps) as u8;
}

#[test]
fn a_box_one_step_smaller_is_noticed() {
    // High planes of frames are counted down.
    let kinds = [(FRAMES, 1, "box 0 of node 0"), (BOXES, -1, "axis-aligned box 0 of node 0")];
    for (kind, inward, words) in kinds {
        for axis in 0..3 {
            for (row, steps) in [(2 * axis, 1), (2 * axis + 1, inward)] {
                let complaint = damaged(kind, |bytes, entry| shrink(bytes, entry, row, steps));
                assert!(complaint.contains(words), "{complaint}");
            }
        }
    }
}

#[test]
fn a_frame_that_makes_distances_longer_is_noticed() {
    for diagonal in [0, 4, 8] {
        let complaint = damaged(FRAMES, |bytes, entry| {
            let entries = &mut section(bytes, entry)[48..];
            entries[2 * diagonal..][..2].copy_from_slice(&8193i16.to_le_bytes());
        });
        assert!(complaint.contains("frame 0 makes a distance longer"), "{complaint}");
    }
}

#[test]
fn a_moved_vertex_is_noticed() {
    let complaint = damaged(FANS, |bytes, entry| {
        let fans = section(bytes, entry);
        fans[0] ^= 2;
    });
    assert!(
        complaint.contains("leaves out a vertex") || complaint.contains("is not the input's"),
        "{complaint}"
    );
}

#[test]
fn a_wrong_source_number_is_noticed() {
    let complaint = damaged(SOURCE, |bytes, entry| {
        let least = word(bytes, entry.offset as usize).expect("there");
        put_u32(bytes, entry.offset as usize, least + 1);
    });
    // One more may be another triangle, or none.
    let noticed = ["is not the input's", "of an input of"];
    assert!(noticed.iter().any(|words| complaint.contains(words)), "{complaint}");
}

#[test]
fn a_node_with_two_parents_is_noticed() {
    let complaint = damaged(LINKS, |bytes, entry| {
        let (from, links) = (entry.offset as usize, entry.bytes as usize / 20);
        let inner =
            |bytes: &[u8], node: usize| word(bytes, from + 20 * node).expect("there") >> 24 & 15;
        let later = (1..links).find(|&node| inner(bytes, node) > 0).expect("a node with nodes");
        let first = word(bytes, from + 20 * later).expect("there");
        put_u32(bytes, from + 20 * later, first & 0xFF00_0000 | 1);
    });
    assert!(complaint.contains("single parent"), "{complaint}");
}

#[test]
fn a_flipped_triangle_is_noticed() {
    // The winding of a second fan is one bit of its tag.
    let complaint = damaged(LINKS, |bytes, entry| {
        let tags = (0..entry.bytes as usize / 20).flat_map(|node| 20 * node + 12..20 * node + 20);
        let links = section(bytes, entry);
        let tag = tags.into_iter().find(|&at| links[at] & 0x70 != 0).expect("a patch of two fans");
        links[tag] ^= 0x80;
    });
    assert!(complaint.contains("is not the input's"), "{complaint}");
}

#[test]
fn claims_of_the_header_that_do_not_hold_are_noticed() {
    let with_word = |at: usize, change: fn(u32) -> u32| {
        damaged(HEADER, |bytes, entry| {
            let at = entry.offset as usize + at;
            let value = word(bytes, at).expect("there");
            put_u32(bytes, at, change(value));
        })
    };
    let complaint = with_word(36, |_| 8);
    assert!(complaint.contains("stack entries"), "{complaint}");
    let complaint = with_word(40, |bits| (f32::from_bits(bits) * 0.999).to_bits());
    assert!(complaint.contains("is not the input's"), "{complaint}");
    let complaint = with_word(44, |bits| (f32::from_bits(bits) * 0.999).to_bits());
    assert!(complaint.contains("star radius"), "{complaint}");
    // The closed flag is the second byte.
    let complaint = with_word(0, |word| word ^ 0x100);
    assert!(complaint.contains("closed"), "{complaint}");
    // The box's least corner along x.
    let complaint = with_word(48, |word| word + 1);
    assert!(complaint.contains("the header's box"), "{complaint}");
}

#[test]
fn sides_that_are_promised_of_a_surface_inside_out_are_noticed() {
    let (mut bytes, mesh) = scene(inverted(&cube(2)), &TreeOptions::default());
    check_tree(&bytes, &mesh).expect("nothing is promised");
    let at = entry(&bytes, HEADER).offset as usize;
    let flags = word(&bytes, at).expect("there");
    assert_eq!(flags >> 8, 0b101, "closed, and sides are lost");
    put_u32(&mut bytes, at, 0b001 << 8);
    seal(&mut bytes);
    let refused = check_tree(&bytes, &mesh).expect_err("promised");
    assert!(refused.starts_with("sides are promised, but the surface winds -1 times"), "{refused}");
}

#[test]
fn a_moment_that_says_too_little_is_noticed() {
    // Offsets in the record, and what is said when the number is nearer to 0 by a hundredth.
    for (at, words) in [
        (12, "a corner is outside"),
        (16, "an error of"),
        (28, "an error of"),
        (48, "a spread of"),
        (56, "a boundary of"),
    ] {
        let complaint = damaged(MOMENTS, |bytes, entry| {
            // Of the second node: the moments of the whole, which is closed, are nearly 0.
            let word = &mut section(bytes, entry)[60 + at..][..4];
            let x = f32::from_le_bytes([word[0], word[1], word[2], word[3]]);
            assert!(x != 0.0);
            word.copy_from_slice(&(x * (1.0 - 1e-2)).to_le_bytes());
        });
        assert!(complaint.contains("moments of node") && complaint.contains(words), "{complaint}");
    }
}
