//! The target for tight hulls of blobs.

use super::input::Input;
use super::suite::ask_all;
use crate::generate::{Triangles, cube, icosphere, rough_sphere, torus};
use meshsweep::bvh::{TreeOptions, build};
use meshsweep::emit::assemble;
use meshsweep::mesh::Mesh;
use meshsweep::progress::Watch;
use meshsweep::surface::VertexBits;
use meshsweep::tight::{self, ChainOptions};
use meshsweep_core::{Blob, Budget, Ended, QueryError, ScratchEntry, TightHull, TightHulls};
use meshsweep_suite::ask::tight::{Hulls, Scratch};
use std::sync::OnceLock;

/// Small valid blobs of tight hulls: one and several, closed and open, on a grid and not, one
/// beside a box tree.
///
/// # Panics
/// If one of them cannot be built.
pub fn tight_seeds() -> &'static [Vec<u8>] {
    static SEEDS: OnceLock<Vec<Vec<u8>>> = OnceLock::new();
    SEEDS.get_or_init(|| {
        let options = |faces: &[usize]| ChainOptions::of_faces(faces).with_effort(0.0);
        let mut open = rough_sphere(1, 0.4, 5);
        open.1.truncate(50);
        vec![
            blob(&cube(1), &options(&[64]), false),
            blob(&torus(2.0, 0.75, 10, 6), &options(&[64, 76]), false),
            blob(&open, &options(&[64]).with_vertex_bits(VertexBits::F32), false),
            blob(&icosphere(1), &options(&[64, 70]), true),
        ]
    })
}

fn blob(
    (positions, triangles): &Triangles,
    options: &ChainOptions,
    beside_a_tree: bool,
) -> Vec<u8> {
    let mesh = Mesh::new(positions.clone(), triangles.clone());
    let (tables, _) = tight::build(mesh.as_input(), options, Watch::NONE).expect("room around it");
    let tree = beside_a_tree
        .then(|| build(mesh.as_input(), &TreeOptions::default(), Watch::NONE).expect("builds").0);
    assemble([tree.as_ref(), Some(&tables)].into_iter().flatten())
}

/// Looks at all hulls and asks each everything, at ordinary places and at hostile ones.
///
/// # Panics
/// If an answer is out of range or took too long.
pub fn ask_tight(hulls: &TightHulls<'_>) {
    assert_eq!(hulls.records().count() as u32, hulls.count());
    assert!(hulls.get(hulls.count()).is_none());
    for index in 0..hulls.count() {
        let hull = hulls.get(index).expect("a hull");
        let record = hull.record();
        let fine = |slack: f32| (0.0..=record.slack).contains(&slack);
        assert!((0..record.faces).all(|face| hull.slack(face).is_some_and(fine)));
        assert!(hull.slack(record.faces).is_none());
        for p in [[0.1, 0.2, 0.3], [5.0, -3.0, 1.0], [1e36, -1e36, 1e36], [1e-40, 0.0, -0.0]] {
            ask(&hull, p, 0.5, &Budget::EXACT, 64);
            ask(
                &hull,
                p,
                1e30,
                &Budget::EXACT.with_steps(2).with_relative(0.1).with_absolute(1.0),
                1,
            );
        }
    }
}

fn ask(hull: &TightHull<'_>, p: [f32; 3], distance: f32, stop: &Budget, entries: usize) {
    let mut stack = vec![ScratchEntry::EMPTY; entries];
    let closest = hull.closest_point(p, *stop, &mut stack);
    let within = hull.within(p, distance, *stop, &mut stack);
    match (closest, within) {
        (Ok(closest), Ok(within)) => {
            assert!(
                closest.distance.lower >= 0.0 && closest.distance.lower <= closest.distance.upper,
                "{closest:?}"
            );
            assert!(closest.triangle.is_none() && closest.ended != Ended::Exact);
            assert!(within.witness.is_none(), "{within:?}");
            // A side may be asked from nearer by, from several places.
            let most =
                64 * (u64::from(hull.bvh().header().nodes) + u64::from(hull.record().faces) + 1);
            assert!(
                u64::from(closest.work.total()) <= most
                    && u64::from(within.work.total()) <= 2 * most
            );
        }
        (first, second) => {
            for error in [first.err(), second.err()].into_iter().flatten() {
                assert_ne!(error, QueryError::Unchecked);
            }
        }
    }
}

/// Opens raw bytes, then an edit of a blob, and asks about any point.
pub fn tight(data: &[u8]) {
    if let Ok(hulls) = TightHulls::open(data) {
        ask_tight(&hulls);
    }
    let mut input = Input(data);
    let bytes = input.blob(tight_seeds());
    let opened = TightHulls::open(&bytes);
    // The same bytes as a blob: all of them are checked, the hulls among them. An edit may have
    // made a section of an unknown kind of them.
    if let Ok(blob) = Blob::open(&bytes) {
        assert_eq!(blob.tight_hulls().is_ok(), opened.is_ok(), "{opened:?}");
    }
    let Ok(hulls) = opened else { return };
    ask_tight(&hulls);
    let stop = input.budget();
    if let Some(hull) = hulls.finest() {
        ask(&hull, input.point(), input.float(), &stop, usize::from(input.byte()));
    }
    ask_all::<Hulls<'_>>(&bytes, Scratch::new(), &mut input);
}
