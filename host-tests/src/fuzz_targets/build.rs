//! The target for the builder.

use super::input::Input;
use crate::generate::{Triangles, cube, groove_block, icosphere, torus};
use meshsweep::builder::For;
use meshsweep::check::{Against, Outcome, verify, verify_repair};
use meshsweep::load::Source;
use meshsweep::mesh::RawMesh;
use meshsweep::surface::VertexBits;
use meshsweep::{BuildError, Builder};

/// What a blob is built for. Curves and deforming hulls are left out: they are not built from such
/// a mesh.
const SERVED: [&[For]; 7] = [
    &[For::Closest],
    &[For::Segment],
    &[For::Closest, For::Segment, For::Cull, For::Winding],
    &[For::Hull],
    &[For::Sweep],
    &[For::Triboxes],
    &[For::Tight],
];

/// Builds a blob of a mesh with up to fifteen edits. It is refused, or the checker proves every
/// claim of the blob.
///
/// # Panics
/// If a claim of the blob is not proved.
pub fn build(data: &[u8]) {
    let mut input = Input(data);
    let served = SERVED[usize::from(input.byte()) % SERVED.len()];
    let mesh = mesh(&mut input);
    let bits = if input.byte() % 2 == 0 { VertexBits::F32 } else { VertexBits::Auto };
    let builder = Builder::new()
        .serve_all(served.iter().copied())
        .vertex_bits(bits)
        .triboxes(served.contains(&For::Triboxes).then_some(1 + u32::from(input.byte() % 32)))
        .effort(served.contains(&For::Tight).then_some(0.0));
    let built = match builder.build(mesh.clone()) {
        Ok(built) => built,
        Err(error) => {
            let is_defect = matches!(error, BuildError::Reopen(_) | BuildError::Cancelled);
            assert!(!is_defect, "{error}");
            return;
        }
    };
    let loaded =
        Source::of(mesh.clone(), None).and_then(|source| source.repaired()).expect("just built");
    let of_repair = verify_repair(&mesh, loaded.input());
    assert_eq!(of_repair.outcome, Outcome::Proved, "{of_repair:?}");
    for finding in verify(built.bytes(), Against::Mesh(loaded.input(), &[])) {
        assert_eq!(finding.outcome, Outcome::Proved, "{finding:?}");
    }
}

/// One of some small meshes or a triangle of any corners, with edits of coordinates and of corners.
fn mesh(input: &mut Input<'_>) -> RawMesh {
    let (mut positions, mut triangles): Triangles = match input.byte() % 5 {
        0 => cube(1),
        1 => icosphere(0),
        2 => torus(2.0, 0.75, 5, 4),
        3 => groove_block(),
        _ => (vec![input.point(), input.point(), input.point()], vec![[0, 1, 2]]),
    };
    let scale = [1.0, 1.0, 1e-30, 1e30][usize::from(input.byte()) % 4];
    for x in positions.iter_mut().flatten() {
        *x *= scale;
    }
    for _ in 0..input.byte() % 16 {
        let vertex = usize::from(input.byte()) % positions.len();
        let triangle = usize::from(input.byte()) % triangles.len();
        let other = u32::from(input.byte()) % (positions.len() as u32 + 1);
        match input.byte() % 6 {
            0 => positions[vertex] = input.point(),
            1 => positions[vertex] = input.point().map(|x| x * scale),
            // A needle, a coincident or a coplanar corner.
            2 => positions[vertex] = positions[other as usize % positions.len()],
            3 => triangles[triangle][vertex % 3] = other,
            4 => triangles.push([vertex as u32, triangles[triangle][0], other]),
            _ => drop(triangles.swap_remove(triangle)),
        }
        if triangles.is_empty() {
            break;
        }
    }
    RawMesh::from_f32(&positions, &triangles)
}
