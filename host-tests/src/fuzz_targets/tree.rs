//! Targets for the box tree.

use super::input::Input;
use super::suite::ask_all;
use crate::corrupt::Asker;
use crate::generate::{Triangles, cube, icosphere, inverted, rough_sphere, torus};
use meshsweep::bvh::{TreeOptions, build};
use meshsweep::emit;
use meshsweep::hull::{self, BuildOptions};
use meshsweep::mesh::{Mesh, RawMesh, repair};
use meshsweep::progress::Watch;
use meshsweep_core::{Blob, Budget, Bvh, CoherentQuery};
use meshsweep_suite::ask::{apart, tree};
use std::sync::OnceLock;

/// Small valid blobs with a box tree: on the grid and exact, with either kind of boxes alone,
/// closed and open, one that holds a hull hierarchy too, one with turned triangles.
///
/// # Panics
/// If one of them cannot be built.
pub fn tree_seeds() -> &'static [Vec<u8>] {
    static SEEDS: OnceLock<Vec<Vec<u8>>> = OnceLock::new();
    SEEDS.get_or_init(|| {
        let all = TreeOptions::default().with_cull(true).with_winding(true);
        let mut open = rough_sphere(2, 0.4, 5);
        open.1.truncate(200);
        open.1.extend([[0, 1, 2], [2, 1, 0], [3, 3, 4], [5, 5, 5]]);
        vec![
            blob(&cube(1), &all),
            blob(&torus(2.0, 0.75, 10, 6), &all.with_f32(true)),
            blob(&icosphere(2), &all.with_segments(false)),
            blob(&icosphere(1), &all.with_closest(false).with_cull(false).with_winding(false)),
            blob(&open, &all),
            blob(&(vec![[0.25, -1.0, 0.5]], vec![[0, 0, 0]]), &all),
            with_hull(&icosphere(1), &all),
            as_filed(&inverted(&icosphere(1)), &all.with_winding(false)),
        ]
    })
}

fn blob((positions, triangles): &Triangles, options: &TreeOptions) -> Vec<u8> {
    let mesh = Mesh::new(positions.clone(), triangles.clone());
    build(mesh.as_input(), options, Watch::NONE).expect("builds").0.to_bytes()
}

/// Of the mesh as repair makes it: turned triangles are stored as the file winds them.
fn as_filed((positions, triangles): &Triangles, options: &TreeOptions) -> Vec<u8> {
    let (mesh, _) = repair(RawMesh::from_f32(positions, triangles)).expect("a sound mesh");
    build(mesh.as_input(), options, Watch::NONE).expect("builds").0.to_bytes()
}

fn with_hull((positions, triangles): &Triangles, options: &TreeOptions) -> Vec<u8> {
    let mesh = Mesh::new(positions.clone(), triangles.clone());
    let coarse = BuildOptions { base_faces: 8, ..BuildOptions::default() };
    let built = hull::build(mesh.as_input(), &coarse, Watch::NONE);
    emit::assemble([
        &built.expect("a sphere has hulls").0,
        &build(mesh.as_input(), options, Watch::NONE).expect("builds").0,
    ])
}

/// Opens raw bytes, then edits of a blob; looks at everything that the opened tree gives out.
pub fn tree_open(data: &[u8]) {
    if let Ok(tree) = Bvh::open(data) {
        look(&tree);
    }
    let mut input = Input(data);
    let blob = input.blob(tree_seeds());
    let tree = Bvh::open(&blob);
    if let Ok(tree) = &tree {
        look(tree);
    }
    // A blob that opens as a whole has a tree that opens.
    if Blob::open(&blob).is_ok() {
        assert!(tree.is_ok(), "{tree:?}");
    }
    ask_all::<Bvh<'_>>(&blob, tree::Scratch::new(), &mut input);
    ask_all::<apart::Apart<'_>>(&blob, apart::Scratch::new(), &mut input);
}

/// Every node, leaf and number is in range.
fn look(tree: &Bvh<'_>) {
    let header = tree.header();
    let (mut leaves, mut triangles) = (0, 0);
    for node in 0..header.nodes {
        let links = tree.links(node).expect("a node");
        assert!((1..=8).contains(&links.count));
        for lane in 0..links.count {
            let child = tree.child(node, lane).expect("a child");
            if child.is_leaf() {
                let patch = tree.leaf(node, lane).expect("a leaf");
                for triangle in 0..child.shape.triangles() {
                    assert!(patch.corners(triangle).iter().all(|corner| corner.is_finite()));
                }
                assert_eq!(links.triangle(lane), triangles);
                triangles += child.shape.triangles() as u32;
                leaves += 1;
            } else {
                assert!(child.at > node && child.at < header.nodes);
            }
        }
    }
    assert_eq!((leaves, triangles), (header.leaves, header.triangles));
    assert!((0..triangles).all(|t| tree.source(t).is_some_and(|s| s < tree.input_triangles())));
    assert!(tree.source(triangles).is_none());
}

/// Every question about points on an edited blob.
pub fn tree_closest(data: &[u8]) {
    let mut input = Input(data);
    let blob = input.blob(tree_seeds());
    let Ok(tree) = Bvh::open(&blob) else { return };
    let mut asker = Asker::new(usize::from(input.byte()), usize::from(input.byte() % 16));
    let stop = input.budget();
    // A hint of another tree is as good as any.
    let other = &tree_seeds()[usize::from(input.byte()) % tree_seeds().len()];
    if let Ok(other) = Bvh::open(other) {
        asker.point(&other, input.point(), input.float(), &stop);
    }
    for _ in 0..3 {
        asker.point(&tree, input.point(), input.float(), &stop);
    }
}

/// Every question about segments on an edited blob, one of them of no length, and what faces their
/// ends.
pub fn tree_segment(data: &[u8]) {
    let mut input = Input(data);
    let blob = input.blob(tree_seeds());
    let Ok(tree) = Bvh::open(&blob) else { return };
    let mut asker = Asker::new(usize::from(input.byte()), usize::from(input.byte() % 16));
    let [a, b, c] = [input.point(), input.point(), input.point()];
    for [from, to] in [[a, b], [b, c], [c, c]] {
        asker.segment(&tree, from, to);
        asker.solid(&tree, [from, to], input.float(), &input.budget());
        asker.sight(&tree, from);
    }
}

/// A coherent query on an edited blob: small steps, jumps, another tree in between.
pub fn tree_coherent(data: &[u8]) {
    let mut input = Input(data);
    let blob = input.blob(tree_seeds());
    let Ok(tree) = Bvh::open(&blob) else { return };
    let other = Bvh::open(&tree_seeds()[0]).expect("a seed");
    let mut asker = Asker::new(usize::from(input.byte()), 0);
    let stop = input.budget();
    let mut path = Vec::new();
    for _ in 0..4 {
        let (mut here, step) = (input.point(), input.point());
        let scale = [0.0, 1e-6, 1e-4, 1e-2][usize::from(input.byte()) % 4];
        for _ in 0..12 {
            path.push(here);
            here = std::array::from_fn(|axis| here[axis] + scale * step[axis]);
        }
    }
    fn follow<const N: usize>(
        asker: &mut Asker,
        trees: [&Bvh<'_>; 2],
        path: &[[f32; 3]],
        stop: &Budget,
    ) {
        let [tree, other] = trees;
        let mut query = CoherentQuery::<N>::new();
        for stop in [&Budget::EXACT, stop] {
            asker.path(&mut query, tree, path.iter().copied(), stop);
            asker.path(&mut query, other, path.iter().copied().take(4), stop);
        }
    }
    let trees = [&tree, &other];
    follow::<0>(&mut asker, trees, &path, &stop);
    follow::<5>(&mut asker, trees, &path, &stop);
    follow::<128>(&mut asker, trees, &path, &stop);
}

/// Two edited blobs under motions that may be anything.
pub fn tree_overlap(data: &[u8]) {
    let mut input = Input(data);
    let (first, second) = (input.blob(tree_seeds()), input.blob(tree_seeds()));
    let (Ok(a), Ok(b)) = (Bvh::open(&first), Bvh::open(&second)) else { return };
    let asker = Asker::new(usize::from(input.byte() % 160), usize::from(input.byte() % 16));
    let steps = u32::from(input.byte());
    for _ in 0..3 {
        let pose = input.pose();
        asker.two_models(&a, &b, &pose, steps);
        asker.two_models(&b, &a, &pose, steps);
    }
}
