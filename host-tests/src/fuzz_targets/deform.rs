//! The target for hulls that deform.

use super::input::Input;
use super::suite::ask_all;
use crate::generate::{Triangles, cube, icosphere, torus};
use meshsweep::hull::{BuildOptions, Levels, build};
use meshsweep::mesh::{KeyFrame, Mesh};
use meshsweep::progress::Watch;
use meshsweep_core::{
    Blob, Budget, ClosestPoint, DeformableHull, MovedVertex, QueryError, ScratchEntry,
};
use meshsweep_suite::ask::deform;
use std::sync::OnceLock;

/// Small valid blobs: without key frames, with one, and with several.
///
/// # Panics
/// If one of them cannot be built.
pub fn deform_seeds() -> &'static [Vec<u8>] {
    static SEEDS: OnceLock<Vec<Vec<u8>>> = OnceLock::new();
    SEEDS.get_or_init(|| {
        vec![blob(&cube(1), 0), blob(&icosphere(1), 1), blob(&torus(2.0, 0.75, 10, 6), 3)]
    })
}

fn blob((positions, triangles): &Triangles, frames: usize) -> Vec<u8> {
    let bent = |frame: usize| {
        let by = (frame + 1) as f32 * 0.25;
        let positions = positions.iter().map(|&[x, y, z]| [x - by * z, y * by, z + by * x * y]);
        KeyFrame { positions: positions.collect(), rounding: 0.0 }
    };
    let frames: Vec<KeyFrame> = (0..frames).map(bent).collect();
    let mesh = Mesh::new(positions.clone(), triangles.clone());
    let options =
        BuildOptions { levels: Levels::Deform(&frames), base_faces: 8, ..BuildOptions::default() };
    build(mesh.as_input(), &options, Watch::NONE).expect("generated meshes build").0.to_bytes()
}

/// Opens raw bytes, then edits of a blob; asks for the closest point at a frame, and after two
/// updates with any places.
///
/// # Panics
/// If an answer is out of range or took too long.
pub fn deform(data: &[u8]) {
    let _ = DeformableHull::open(data);
    let mut input = Input(data);
    let bytes = input.blob(deform_seeds());
    let opened = DeformableHull::open(&bytes);
    if let Ok(blob) = Blob::open(&bytes) {
        assert_eq!(blob.deformable_hull().is_ok(), opened.is_ok(), "{opened:?}");
    }
    let Ok(hull) = opened else { return };
    let mut scratch = vec![ScratchEntry::EMPTY; usize::from(input.byte())];
    let budget = Budget::EXACT.with_relative(input.float()).with_steps(input.u32());
    let h = *hull.rest().header();
    let most = 4 * (h.surface_triangles + h.splits + h.rings + h.base_triangles) + 64;
    let check = |answer: Result<ClosestPoint, QueryError>| match answer {
        Ok(near) => {
            let interval = near.distance;
            assert!(interval.lower >= 0.0 && interval.lower <= interval.upper, "{near:?}");
            assert!(near.point.iter().all(|x| x.is_finite()), "{near:?}");
            assert!(near.work.total() <= most, "{near:?}");
        }
        Err(error) => assert_ne!(error, QueryError::Unchecked),
    };
    for frame in [input.float(), 0.0, 0.5, hull.frames() as f32 - 1.25] {
        match hull.at_frame(frame) {
            Ok(at) => check(at.closest_point(input.point(), budget, &mut scratch)),
            Err(error) => assert_eq!(error, QueryError::NoFrame { frames: hull.frames() }),
        }
    }
    let mut memory = vec![MovedVertex::EMPTY; hull.vertex_records()];
    let mut moved = hull.moved(&mut memory).expect("enough records");
    for _ in 0..2 {
        // Enough hostile places among many ordinary ones.
        let places: Vec<[f32; 3]> = (0..8).map(|_| input.point()).collect();
        let updated = moved.update(|vertex| match places.get(vertex as usize) {
            Some(&place) => place,
            None => [0.25 * (vertex % 5) as f32, 0.01 * vertex as f32, 0.5],
        });
        let answer = moved.closest_point(input.point(), budget, &mut scratch);
        match updated {
            Ok(()) => check(answer),
            Err(_) => assert!(answer.is_err(), "{answer:?}"),
        }
    }
    ask_all::<DeformableHull<'_>>(&bytes, deform::Scratch::new(), &mut input);
}
