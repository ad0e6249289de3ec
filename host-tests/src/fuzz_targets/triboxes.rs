//! The target for tribox hierarchies of blobs.

use super::input::Input;
use super::suite::ask_all;
use crate::generate::{Triangles, cube, groove_block, icosphere, rough_sphere, torus, transformed};
use meshsweep::bvh::{TreeOptions, build};
use meshsweep::emit::assemble;
use meshsweep::mesh::Mesh;
use meshsweep::progress::Watch;
use meshsweep::tribox::{self, Measure, TriboxOptions};
use meshsweep_core::{Blob, Budget, Ended, NodePair, Pose, QueryError, ScratchEntry, Triboxes};
use meshsweep_suite::ask::triboxes;
use std::sync::OnceLock;

/// Small valid blobs of triboxes: one and several, closed and open, one beside a box tree, one
/// turned.
///
/// # Panics
/// If one of them cannot be built.
pub fn triboxes_seeds() -> &'static [Vec<u8>] {
    static SEEDS: OnceLock<Vec<Vec<u8>>> = OnceLock::new();
    SEEDS.get_or_init(|| {
        let mut open = rough_sphere(1, 0.4, 5);
        open.1.truncate(50);
        let rotation = [[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]];
        let turned = transformed(&groove_block(), rotation, [0.1, 0.2, 0.3]);
        vec![
            blob(&cube(1), &TriboxOptions::new(1), false),
            blob(&torus(2.0, 0.75, 10, 6), &TriboxOptions::new(12), false),
            blob(&open, &TriboxOptions::new(5), false),
            blob(&icosphere(1), &TriboxOptions::new(4), true),
            blob(&turned, &TriboxOptions::new(4).with_orient(Some(Measure::Volume)), false),
        ]
    })
}

fn blob(
    (positions, triangles): &Triangles,
    options: &TriboxOptions,
    beside_a_tree: bool,
) -> Vec<u8> {
    let mesh = Mesh::new(positions.clone(), triangles.clone());
    let (tables, _) = tribox::build(mesh.as_input(), options, Watch::NONE).expect("in the domain");
    let tree = beside_a_tree
        .then(|| build(mesh.as_input(), &TreeOptions::default(), Watch::NONE).expect("builds").0);
    assemble([tree.as_ref(), Some(&tables)].into_iter().flatten())
}

/// Looks at everything of two opened hierarchies and asks everything, at ordinary places and at
/// hostile ones.
///
/// # Panics
/// If an answer is out of range or took too long.
pub fn ask_triboxes(a: &Triboxes<'_>, b: &Triboxes<'_>) {
    look(a);
    for translation in [[0.1, -0.2, 0.3], [5.0, 0.0, 1.0], [1e36, -1e36, 1e30], [1e-40; 3]] {
        let rotation = [[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]];
        ask(a, b, &Pose::affine(rotation, translation), a.separation_entries(b));
        ask(b, a, &Pose { translation, ..Pose::IDENTITY }, 3);
    }
    for p in [[0.1, 0.2, 0.3], [5.0, -3.0, 1.0], [1e36, -1e36, 1e36], [1e-40, 0.0, -0.0]] {
        bounds(a, p, [-1.0, 0.5, 0.2], a.depth() as usize + 2);
        bounds(a, p, p, 1);
    }
}

/// Every node and level is in range, and the leaves of every level are as many as it says.
fn look(triboxes: &Triboxes<'_>) {
    let count = triboxes.node_count();
    for node in 0..count {
        let tribox = triboxes.node(node).expect("a node");
        assert!(!tribox.is_empty() && tribox.tightened() == tribox, "{tribox:?}");
        assert!(tribox.boundary().vertices.iter().flatten().all(|x| x.is_finite()));
        assert!(triboxes.error(node).is_some_and(|error| error >= 0.0));
        for child in triboxes.children(node).into_iter().flatten() {
            assert!(child > node && child < count && triboxes.parent(child) == Some(node));
            assert!(tribox.contains(&triboxes.node(child).expect("a child")));
        }
    }
    assert!(triboxes.node(count).is_none() && triboxes.children(count).is_none());
    for level in triboxes.levels() {
        assert_eq!(triboxes.coarser(level.triboxes).leaves().count(), level.triboxes as usize);
    }
    for leaves in [0, 1, 2, 3, u32::MAX] {
        let coarser = triboxes.coarser(leaves);
        assert_eq!(coarser.leaves().count() as u32, leaves.clamp(1, triboxes.leaf_count()));
    }
}

fn ask(a: &Triboxes<'_>, b: &Triboxes<'_>, pose: &Pose, entries: usize) {
    let mut stack = vec![ScratchEntry::EMPTY; entries];
    let mut pairs = [NodePair::EMPTY; 8];
    let all = a.candidates(b, *pose, &mut pairs, Budget::EXACT, &mut stack);
    let one = a.separation(b, *pose, Budget::EXACT, &mut stack);
    if let Ok(one) = one {
        let mut most = 0.0;
        for distance in [0.0, 1e-30, 0.5, 1e30] {
            let found = a.within_of(b, *pose, distance, Budget::EXACT, &mut stack);
            let found = found.expect("the distance is one");
            // What is farther than a distance is farther than each lesser one.
            assert!(!found.is_apart() || one.is_apart() && most == 0.0);
            most = if found.is_apart() { most } else { distance.max(f32::MIN_POSITIVE) };
        }
    }
    match (all, one) {
        (Ok(all), Ok(one)) => {
            assert_eq!(all.is_apart(), one.is_apart());
            assert!(one.work.bounds <= all.work.bounds);
            assert!(
                u64::from(all.work.bounds) <= u64::from(a.node_count()) * u64::from(b.node_count())
            );
            let fine = |pair: &NodePair| {
                u32::from(pair.a) < a.node_count() && u32::from(pair.b) < b.node_count()
            };
            assert!(pairs[..all.stored].iter().all(fine) && one.may_meet.iter().all(fine));
            assert!(all.ended == Ended::Exact || entries < a.separation_entries(b));
        }
        (Err(first), Err(second)) => {
            assert!(first == second && first != QueryError::Unchecked, "{first}")
        }
        (all, one) => panic!("{all:?} {one:?}"),
    }
}

fn bounds(triboxes: &Triboxes<'_>, p: [f32; 3], q: [f32; 3], entries: usize) {
    let mut stack = vec![ScratchEntry::EMPTY; entries];
    for answer in [
        triboxes.distance(p, Budget::EXACT, &mut stack),
        triboxes.clip(p, q, Budget::EXACT, &mut stack),
    ] {
        match answer {
            Ok(answer) => {
                assert!(
                    answer.lower >= 0.0
                        && answer.node.is_none_or(|node| node < triboxes.node_count())
                );
                assert!(answer.work.bounds <= triboxes.node_count());
                assert!(answer.ended == Ended::Exact || entries < triboxes.scratch_entries());
            }
            Err(error) => assert_ne!(error, QueryError::Unchecked),
        }
    }
}

/// Opens raw bytes, then edits of two blobs, and asks about any points, segments and poses.
pub fn triboxes(data: &[u8]) {
    if let Ok(opened) = Triboxes::open(data) {
        ask_triboxes(&opened, &opened);
    }
    let mut input = Input(data);
    let (first, second) = (input.blob(triboxes_seeds()), input.blob(triboxes_seeds()));
    let opened = Triboxes::open(&first);
    // The same bytes as a blob: all of them are checked, the triboxes among them. An edit may have
    // made a section of an unknown kind of them.
    if let Ok(blob) = Blob::open(&first) {
        assert_eq!(blob.triboxes().is_ok(), opened.is_ok(), "{opened:?}");
    }
    let (Ok(a), Ok(b)) = (opened, Triboxes::open(&second)) else { return };
    ask_triboxes(&a, &b);
    let entries = 1 + usize::from(input.byte());
    let pose = Pose::affine([(); 3].map(|()| input.point()), input.point());
    ask(&a, &b, &pose, entries);
    bounds(&a, input.point(), input.point(), entries);
    ask_all::<Triboxes<'_>>(&first, triboxes::Scratch::new(), &mut input);
}
