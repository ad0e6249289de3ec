//! `verify` proves what the builder made, and nothing narrower or moved.

use meshsweep::check::{Against, Outcome, verify};
use meshsweep::mesh::Mesh;
use meshsweep::progress::Watch;
use meshsweep::sdf::{SdfOptions, build};
use meshsweep_core::internal::sdf::format::layout::field;
use meshsweep_core::{SdfKind, SectionKind};
use meshsweep_host_tests::corrupt::edited;
use meshsweep_host_tests::generate::{
    Triangles, block, bracket, cube, icosphere, joined, plate, scaled,
};

fn mesh((positions, triangles): Triangles) -> Mesh {
    Mesh::new(positions, triangles)
}

fn built(mesh: &Mesh, kind: SdfKind, bytes: u32) -> Vec<u8> {
    let options = SdfOptions::default().with_bytes(bytes).with_kind(Some(kind));
    build(mesh.as_input(), &options, Watch::NONE).expect("builds").0.to_bytes()
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
        for kind in SdfKind::ALL {
            let bytes = built(&mesh, kind, 400);
            assert_eq!(outcome(&bytes, &mesh), Outcome::Proved, "{name} {kind:?}");
        }
    }
}

#[test]
fn an_open_mesh_is_proved_without_sides_alone() {
    let (positions, mut triangles) = icosphere(2);
    triangles.truncate(200);
    let open = Mesh::new(positions.clone(), triangles);
    assert_eq!(outcome(&built(&open, SdfKind::Surface, 512), &open), Outcome::Proved);
    // The field of the whole ball tells sides, which the part has not.
    let whole = mesh(icosphere(2));
    assert_eq!(outcome(&built(&whole, SdfKind::Signed, 512), &open), Outcome::Failed);
}

#[test]
fn errors_that_are_smaller_and_codes_that_are_others_are_not_proved() {
    let mesh = mesh(bracket());
    for kind in SdfKind::ALL {
        let bytes = built(&mesh, kind, 512);
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
        // A sixteenth less of each error.
        for book in [field::LOW, field::HIGH] {
            let less = changed(&|section| {
                for error in section[book..][..32].as_chunks_mut::<2>().0 {
                    let narrow = u16::from_le_bytes(*error) / 16 * 15;
                    *error = narrow.to_le_bytes();
                }
            });
            assert_eq!(less, Outcome::Failed, "{kind:?}");
        }
        let moved = changed(&|section| {
            let base = i32::from_le_bytes(section[field::BASE..][..4].try_into().expect("four"));
            section[field::BASE..][..4].copy_from_slice(&(base + 400).to_le_bytes());
        });
        assert_eq!(moved, Outcome::Failed, "{kind:?}");
        let nearer = changed(&|section| {
            let x = f32::from_le_bytes(section[..4].try_into().expect("four")) + 0.5;
            section[..4].copy_from_slice(&x.to_le_bytes());
        });
        assert_eq!(nearer, Outcome::Failed, "{kind:?}");
    }
}
