//! What the fuzzers run, as plain functions: a driver test calls the same bodies with seeded bytes.
//!
//! Input bytes are edits of a valid blob, whose CRCs are then computed again, followed by the queries' floats. A blob that
//! opens must be safe to ask anything: no panic, and no more work than its tables have records.

use crate::corrupt::seal;
use crate::generate::{Rng, Triangles, cube, groove_block, icosphere, torus};
use meshsweep_alloc::hull::{BuildOptions, build};
use meshsweep_alloc::mesh::Mesh;
use meshsweep_alloc::precision::VertexBits;
use meshsweep_core::query::{
    ClosestPoint, Hit, QueryError, Search, Stop, all_hits, closest_point, first_hit, outer_hits,
};
use meshsweep_core::refine::{Face, Front, hull_faces};
use meshsweep_core::{Model, QueueEntry};
use std::sync::OnceLock;

/// Small valid blobs of every vertex format, one of them cut.
///
/// # Panics
/// If one of them cannot be built.
pub fn seeds() -> &'static [Vec<u8>] {
    static SEEDS: OnceLock<Vec<Vec<u8>>> = OnceLock::new();
    SEEDS.get_or_init(|| {
        let mut all = vec![
            blob(&cube(1), VertexBits::Auto, 4),
            blob(&icosphere(1), VertexBits::F32, 8),
            blob(&icosphere(2), VertexBits::Grid16, 20),
            blob(&torus(2.0, 0.75, 10, 6), VertexBits::Grid24, 12),
            blob(&groove_block(), VertexBits::Auto, 40),
        ];
        let whole = Model::open(&all[2]).expect("just built");
        let cut = meshsweep_alloc::emit::cut(&whole, 1).expect("it has a second level").to_bytes();
        all.push(cut);
        all
    })
}

fn blob((positions, triangles): &Triangles, vertex_bits: VertexBits, base_faces: usize) -> Vec<u8> {
    let mesh = Mesh::new(positions.clone(), triangles.clone());
    let options = BuildOptions { base_faces, vertex_bits, ..BuildOptions::default() };
    build(&mesh, 0.0, mesh.triangles.len(), &options, |_| ()).expect("generated meshes build").bytes
}

/// Reads numbers off the fuzzer's bytes; zeros when they are used up.
struct Input<'a>(&'a [u8]);

impl Input<'_> {
    fn byte(&mut self) -> u8 {
        let Some((&first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        first
    }

    fn u32(&mut self) -> u32 {
        u32::from_le_bytes(std::array::from_fn(|_| self.byte()))
    }

    fn float(&mut self) -> f32 {
        match self.byte() % 8 {
            // Any bits, NaN and infinity among them.
            0 => f32::from_bits(self.u32()),
            1 => 0.0,
            2 => (f32::from(self.byte()) - 128.0) * 1e30,
            _ => (f32::from(self.byte()) - 128.0) / 32.0,
        }
    }

    fn point(&mut self) -> [f32; 3] {
        std::array::from_fn(|_| self.float())
    }

    /// A blob with up to fifteen edits, with right CRCs.
    fn blob(&mut self) -> Vec<u8> {
        let seeds = seeds();
        let mut blob = seeds[usize::from(self.byte()) % seeds.len()].clone();
        for _ in 0..self.byte() % 16 {
            let kind = self.byte();
            let at =
                if kind & 0x80 == 0 { self.u32() as usize % blob.len() } else { self.u32() as usize % 400 };
            let at = at.min(blob.len() - 1);
            match kind % 6 {
                0 => blob[at] ^= 1 << (self.byte() % 8),
                1 => blob[at] = self.byte(),
                2 => blob[at] = blob[at].wrapping_add(1),
                3 => blob[at] = 0xFF,
                4 => {
                    let from = self.u32() as usize % blob.len();
                    blob[at] = blob[from];
                }
                _ => {
                    let word =
                        [0, 1, 0x7F80_0000, 0x7FC0_0000, 0x7FFF_FFFF, u32::MAX][usize::from(self.byte()) % 6];
                    crate::corrupt::put_u32(&mut blob, at & !3, word);
                }
            }
        }
        seal(&mut blob);
        blob
    }
}

/// Opens raw bytes, then edits of a blob; looks at everything that the opened model gives out.
pub fn open(data: &[u8]) {
    if let Ok(model) = Model::open(data) {
        look(&model);
    }
    let blob = Input(data).blob();
    if let Ok(model) = Model::open(&blob) {
        look(&model);
    }
}

/// Sections, levels, faces of every hull: all in range.
fn look(model: &Model<'_>) {
    assert!(model.sections().count() <= model.header().section_count as usize);
    for level in model.levels().take(40) {
        for face in hull_faces(model, &level) {
            assert!(model.positions(face.corners).is_some_and(|p| p.iter().all(|v| v.is_finite())));
        }
    }
}

fn queue(input: &mut Input<'_>) -> Vec<QueueEntry> {
    vec![QueueEntry::EMPTY; usize::from(input.byte())]
}

/// Every record of the tables looked at so many times is more than any query needs.
fn bound(model: &Model<'_>) -> u32 {
    let h = model.header();
    4 * (h.nodes + h.surface_triangles + h.splits + h.rings + h.base_triangles) + 64
}

/// Closest point on an edited blob.
pub fn closest(data: &[u8]) {
    let mut input = Input(data);
    let blob = input.blob();
    let Ok(model) = Model::open(&blob) else { return };
    let mut queue = queue(&mut input);
    let stop = Stop { relative: input.float(), absolute: input.float(), steps: input.u32() };
    for stop in [Stop::EXACT, stop] {
        if let Ok(answer) = closest_point(&model, input.point(), &stop, &mut queue) {
            sound(&answer);
            assert!(answer.work.total() <= bound(&model), "{:?}", answer.work);
        }
    }
}

fn sound(answer: &ClosestPoint) {
    assert!(answer.lower >= 0.0 && answer.lower <= answer.upper, "{answer:?}");
    assert!(answer.point.iter().all(|x| x.is_finite()), "{answer:?}");
}

/// First hit and all hits on an edited blob.
pub fn segment(data: &[u8]) {
    let mut input = Input(data);
    let blob = input.blob();
    let Ok(model) = Model::open(&blob) else { return };
    let mut queue = queue(&mut input);
    let (a, b) = (input.point(), input.point());
    let stop = Stop { steps: input.u32(), ..Stop::EXACT };
    let mut hits = vec![Hit::EMPTY; usize::from(input.byte() % 8)];
    for stop in [Stop::EXACT, stop] {
        if let Ok(answer) = first_hit(&model, a, b, &stop, &mut queue) {
            assert!(answer.lower >= 0.0 && answer.lower <= answer.upper, "{answer:?}");
            assert!(answer.work.total() <= bound(&model), "{:?}", answer.work);
        }
    }
    if let Ok(answer) = all_hits(&model, a, b, &mut queue, &mut hits) {
        assert!(answer.stored <= hits.len() && hits[..answer.stored].is_sorted_by(|x, y| x.t <= y.t));
        assert!(answer.work.total() <= bound(&model), "{:?}", answer.work);
    }
}

/// Outer hits on an edited blob. The candidate list is long enough for every face, so that nothing is searched twice.
pub fn outer(data: &[u8]) {
    let mut input = Input(data);
    let blob = input.blob();
    let Ok(model) = Model::open(&blob) else { return };
    let words = usize::from(input.byte() % 8);
    let (mut performed, mut swept) = (vec![u32::MAX; words], vec![u32::MAX; words]);
    let mut candidates = vec![Face::EMPTY; 4096];
    let mut hits = [Hit::EMPTY; 4];
    let (a, b) = (input.point(), input.point());
    for search in [Search::First, Search::Outer] {
        let mut front = Front::new(&mut performed, &mut swept, &mut candidates);
        match outer_hits(&model, a, b, search, &mut front, &mut hits) {
            Ok(answer) => {
                assert!(answer.lower >= 0.0 && answer.lower <= answer.upper, "{answer:?}");
                assert!(answer.stored <= hits.len(), "{answer:?}");
                assert!(answer.work.splits <= model.header().splits, "{:?}", answer.work);
            }
            Err(error) => assert_ne!(error, QueryError::Model),
        }
    }
}

/// Seeded bytes for a driver that has no fuzzer.
#[must_use]
pub fn random_input(rng: &mut Rng) -> Vec<u8> {
    let length = 8 + rng.below(120);
    let mut data: Vec<u8> = (0..length).map(|_| rng.next_u64() as u8).collect();
    // Few edits leave more blobs that open.
    if rng.below(4) > 0 {
        data[1] %= 3;
    }
    data
}
