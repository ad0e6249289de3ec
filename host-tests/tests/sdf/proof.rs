//! `verify` proves what the builder made, and nothing narrower or moved.

use meshsweep::check::{Against, Outcome, verify};
use meshsweep::mesh::Mesh;
use meshsweep::progress::Watch;
use meshsweep::sdf::{SdfOptions, build};
use meshsweep_core::internal::sdf::format::layout::field;
use meshsweep_core::{SdfKind, SdfLayout, SectionKind};
use meshsweep_host_tests::corrupt::edited;
use meshsweep_host_tests::generate::{
    Rng, Triangles, block, bracket, cube, fields, icosphere, joined, plate, rough_sphere, scaled,
};

fn mesh((positions, triangles): Triangles) -> Mesh {
    Mesh::new(positions, triangles)
}

fn built(mesh: &Mesh, kind: SdfKind, layout: SdfLayout, bytes: u32) -> Vec<u8> {
    let options = SdfOptions::default().with_bytes(bytes).with_kind(Some(kind));
    let options = options.with_layout(Some(layout));
    build(mesh.as_input(), &options, Watch::NONE).expect("builds").0.to_bytes()
}

/// All kinds and layouts.
fn all() -> impl Iterator<Item = (SdfKind, SdfLayout)> {
    SdfKind::ALL.into_iter().flat_map(|kind| SdfLayout::ALL.map(|layout| (kind, layout)))
}

fn outcome(bytes: &[u8], mesh: &Mesh) -> Outcome {
    let [finding] = &verify(bytes, Against::Mesh(mesh.as_input(), &[]))[..] else {
        panic!("one finding");
    };
    finding.outcome
}

#[test]
fn fields_of_the_builder_are_proved() {
    let overlapping = joined(&cube(2), &block([0.5; 3], [1.5; 3]));
    for (name, of) in [
        ("bracket", bracket()),
        ("ball", icosphere(2)),
        ("plate", plate([0.1, 0.2], 0.01)),
        ("solids that overlap", overlapping),
        ("tiny", scaled(&icosphere(1), 1e-30)),
        ("huge", scaled(&cube(1), 1e30)),
    ] {
        let mesh = mesh(of);
        for (kind, layout) in all() {
            let bytes = built(&mesh, kind, layout, 400);
            assert_eq!(outcome(&bytes, &mesh), Outcome::Proved, "{name} {kind:?} {layout:?}");
        }
    }
}

#[test]
fn an_open_mesh_is_proved_without_sides_alone() {
    let (positions, mut triangles) = icosphere(2);
    triangles.truncate(200);
    let open = Mesh::new(positions.clone(), triangles);
    // The field of the whole ball tells sides, which the part has not.
    let whole = mesh(icosphere(2));
    for layout in SdfLayout::ALL {
        let unsigned = built(&open, SdfKind::Surface, layout, 512);
        assert_eq!(outcome(&unsigned, &open), Outcome::Proved);
        let signed = built(&whole, SdfKind::Signed, layout, 512);
        assert_eq!(outcome(&signed, &open), Outcome::Failed);
    }
}

#[test]
fn errors_that_are_smaller_and_codes_that_are_others_are_not_proved() {
    let mesh = mesh(rough_sphere(2, 0.3, 5));
    for (kind, layout) in all() {
        let bytes = built(&mesh, kind, layout, 512);
        let changed = |edit: &dyn Fn(&mut [u8])| {
            let mut found = None;
            let told: Result<(), ()> = edited(bytes.clone(), SectionKind::Sdf, edit, |bytes| {
                found = Some(outcome(bytes, &mesh));
                Ok(())
            });
            assert_eq!(told, Ok(()));
            found.expect("asked")
        };
        assert_eq!(changed(&|_| ()), Outcome::Proved);
        // An eighth less of each error. Of a tree one book is in two halves.
        let books: &[&[usize]] = if layout == SdfLayout::Tree {
            &[&[field::BOOKS, field::HIGH]]
        } else {
            &[&[field::BOOKS], &[field::HIGH]]
        };
        for book in books {
            let less = changed(&|section| {
                for &half in *book {
                    for error in section[half..][..32].as_chunks_mut::<2>().0 {
                        let narrow = u16::from_le_bytes(*error) / 8 * 7;
                        *error = narrow.to_le_bytes();
                    }
                }
            });
            assert_ne!(less, Outcome::Proved, "{kind:?} {layout:?}");
        }
        let moved = changed(&|section| {
            let base = i32::from_le_bytes(section[field::BASE..][..4].try_into().expect("four"));
            section[field::BASE..][..4].copy_from_slice(&(base + 4000).to_le_bytes());
        });
        assert_eq!(moved, Outcome::Failed, "{kind:?}");
        let nearer = changed(&|section| {
            let x = f32::from_le_bytes(section[..4].try_into().expect("four")) + 3.0;
            section[..4].copy_from_slice(&x.to_le_bytes());
        });
        assert_eq!(nearer, Outcome::Failed, "{kind:?}");
    }
}

/// A field with a unit of 1 whose cells claim nothing, but one: distances of 1490 and more.
fn claiming(kind: SdfKind, cells: [u8; 3], at: [usize; 3], low: u16) -> Vec<u8> {
    let mut header = fields::header(&mut Rng::new(1), kind, cells, 1.0);
    (header.origin, header.base, header.step) = ([-0.5; 3], 1500, 1);
    header.low = [u16::MAX; 16];
    header.low[0] = low;
    header.high = [u16::MAX; 16];
    let [corners, count] = header.counts();
    let [x, y, _] = cells.map(usize::from);
    let mut section = header.write().to_vec();
    section.resize(section.len() + corners, 0);
    section.resize(section.len() + count, 1);
    section[96 + corners + at[0] + x * (at[1] + y * at[2])] = 0;
    fields::blob(section)
}

#[test]
fn a_field_that_passes_over_a_needle_is_refuted() {
    // It runs through the centre of cell (4, 7, 10). Its computed normal leads far off it.
    let needle = [
        [0.375, 0.625, 0.875],
        [2.759_096_3e-16, 3.380_982_3e-16, 5.776_904_5e-16],
        [10_947.0, 18_245.0, 25_543.0],
        [9216.0, 11_860.0, 21_504.0],
        [9226.0, 11_860.0, 21_504.0],
        [9216.0, 11_860.0, 21_514.0],
    ];
    let mesh = Mesh::new(needle.to_vec(), vec![[0, 1, 2], [3, 4, 5]]);
    let wrong = claiming(SdfKind::Surface, [6, 9, 13], [4, 7, 10], 10);
    assert_eq!(outcome(&wrong, &mesh), Outcome::Failed);
    let right = claiming(SdfKind::Surface, [6, 9, 13], [4, 7, 10], 1501);
    assert_eq!(outcome(&right, &mesh), Outcome::Proved);
}

#[test]
fn a_claim_without_slack_is_not_called_wrong() {
    let mesh =
        Mesh::new(vec![[100.0; 3], [200.0, 100.0, 100.0], [100.0, 200.0, 100.0]], vec![[0, 1, 2]]);
    // F − low is 0 at the triangle: true, and no proof by numbers that round.
    let tight = claiming(SdfKind::Surface, [1, 1, 1], [0, 0, 0], 1500);
    assert_eq!(outcome(&tight, &mesh), Outcome::NotProved);
}

#[test]
fn a_mesh_that_leaves_the_field_is_refused() {
    let field = claiming(SdfKind::Surface, [1, 1, 1], [0, 0, 0], u16::MAX);
    let plate = |z: f32| {
        let at = [[100.0, 100.0, z], [200.0, 100.0, z], [100.0, 200.0, z]];
        Mesh::new(at.to_vec(), vec![[0, 1, 2]])
    };
    assert_eq!(outcome(&field, &plate(2047.5)), Outcome::Proved);
    assert_eq!(outcome(&field, &plate(2048.5)), Outcome::Failed);
    assert_eq!(outcome(&field, &plate(-0.5)), Outcome::Failed);
}
