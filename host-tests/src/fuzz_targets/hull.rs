//! Targets for the hull hierarchy.

use super::input::Input;
use super::suite::ask_all;
use crate::generate::{Triangles, cube, groove_block, icosphere, torus};
use meshsweep::hull::{BuildOptions, build};
use meshsweep::mesh::Mesh;
use meshsweep::progress::Watch;
use meshsweep::surface::VertexBits;
use meshsweep_core::{
    Blob, Budget, ClosestPoint, Ended, Focus, Hit, Hull, OuterSearch, QueryError, RefinedHull,
    ScratchEntry, SplitChange, TriangleHit, TrianglePair, Verdict,
};
use meshsweep_suite::ask::{hull, hull_moving};
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
        let whole = Hull::open(&all[2]).expect("just built");
        let cut = meshsweep::cut::cut(&whole, 1).expect("it has a second level").to_bytes();
        all.push(cut);
        all
    })
}

fn blob((positions, triangles): &Triangles, vertex_bits: VertexBits, base_faces: usize) -> Vec<u8> {
    let mesh = Mesh::new(positions.clone(), triangles.clone());
    let options = BuildOptions { base_faces, vertex_bits, ..BuildOptions::default() };
    build(mesh.as_input(), &options, Watch::NONE).expect("generated meshes build").0.to_bytes()
}

/// Opens raw bytes, then edits of a blob; looks at everything that the opened model gives out.
pub fn open(data: &[u8]) {
    if let Ok(blob) = Blob::open(data) {
        look(&blob);
    }
    let mut input = Input(data);
    let bytes = input.blob(seeds());
    if let Ok(blob) = Blob::open(&bytes) {
        look(&blob);
    }
    ask_all::<hull::Model<'_>>(&bytes, hull::Scratch::new(), &mut input);
    ask_all::<hull_moving::Moving<'_>>(&bytes, hull_moving::Scratch::new(), &mut input);
}

/// Sections, levels, faces of every hull: all in range.
fn look(blob: &Blob<'_>) {
    assert!(blob.sections().count() <= blob.header().section_count as usize);
    let Ok(model) = blob.hull() else { return };
    for level in model.levels().take(40) {
        for face in model.faces(&level) {
            assert!(model.positions(face.corners).is_some_and(|p| p.iter().all(|v| v.is_finite())));
        }
    }
}

fn queue(input: &mut Input<'_>) -> Vec<ScratchEntry> {
    vec![ScratchEntry::EMPTY; usize::from(input.byte())]
}

/// Every record of the tables looked at so many times is more than any query needs.
fn bound(model: &Hull<'_>) -> u32 {
    let h = model.header();
    4 * (h.surface_triangles + h.splits + h.rings + h.base_triangles) + 64
}

/// Closest point on an edited blob.
pub fn closest(data: &[u8]) {
    let mut input = Input(data);
    let blob = input.blob(seeds());
    let Ok(model) = Hull::open(&blob) else { return };
    let mut queue = queue(&mut input);
    let stop = input.budget();
    for stop in [Budget::EXACT, stop] {
        if let Ok(answer) = model.closest_point(input.point(), stop, &mut queue) {
            sound(&answer);
            assert!(answer.work.total() <= bound(&model), "{:?}", answer.work);
        }
    }
    let most = bound(&model) as usize;
    let Ok(mut sweep) = model.sweep(input.point(), &mut queue) else { return };
    for stop in [stop, Budget::EXACT, stop, Budget::EXACT] {
        if sweep.move_to(input.point()).is_ok()
            && let Ok(answer) = sweep.closest_point(stop)
        {
            sound(&answer);
            assert!(answer.work.opened as usize <= 2 * most, "{:?}", answer.work);
        }
    }
    let mut given = 0;
    while let Ok(Some(answer)) = sweep.next_triangle(Budget::EXACT) {
        sound(&answer);
        if answer.ended != Ended::Exact {
            break;
        }
        given += 1;
        assert!(given <= most, "more triangles than there are");
    }
}

fn sound(answer: &ClosestPoint) {
    assert!(
        answer.distance.lower >= 0.0 && answer.distance.lower <= answer.distance.upper,
        "{answer:?}"
    );
    assert!(answer.point.iter().all(|x| x.is_finite()), "{answer:?}");
}

/// First hit and all hits on an edited blob.
pub fn segment(data: &[u8]) {
    let mut input = Input(data);
    let blob = input.blob(seeds());
    let Ok(model) = Hull::open(&blob) else { return };
    let mut queue = queue(&mut input);
    let (a, b) = (input.point(), input.point());
    let stop = Budget::EXACT.with_steps(input.u32());
    let mut hits = vec![TriangleHit::EMPTY; usize::from(input.byte() % 8)];
    for stop in [Budget::EXACT, stop] {
        if let Ok(answer) = model.first_hit(a, b, stop, &mut queue) {
            assert!(answer.t.lower >= 0.0 && answer.t.lower <= answer.t.upper, "{answer:?}");
            assert!(answer.work.total() <= bound(&model), "{:?}", answer.work);
        }
    }
    if let Ok(answer) = model.all_hits(a, b, &mut hits, Budget::EXACT, &mut queue) {
        assert!(
            answer.stored <= hits.len()
                && hits[..answer.stored].is_sorted_by(|x, y| x.hit.t <= y.hit.t)
        );
        assert!(answer.work.total() <= bound(&model), "{:?}", answer.work);
    }
}

/// Whether a triangle, and a moved edited blob, meet an edited blob, in at most so many steps:
/// every pair of triangles may have to be opened.
pub fn overlap(data: &[u8]) {
    let mut input = Input(data);
    let (first, second) = (input.blob(seeds()), input.blob(seeds()));
    let (Ok(a), Ok(b)) = (Hull::open(&first), Hull::open(&second)) else { return };
    let mut queue = queue(&mut input);
    let mut pairs = vec![TrianglePair::EMPTY; usize::from(input.byte() % 16)];
    let stop = Budget::EXACT.with_steps(u32::from(input.byte()));
    let in_range = |[first, second]: [u32; 2]| {
        let numbers = [a.header().input_triangles, b.header().input_triangles];
        assert!(first < numbers[0] && second < numbers[1], "{first} {second}");
    };
    for _ in 0..3 {
        let (pose, corners) = (input.pose(), [input.point(), input.point(), input.point()]);
        match a.overlap(&b, pose, stop, &mut queue) {
            Ok(answer) => {
                assert!(answer.work.opened <= stop.steps, "{answer:?}");
                let named = answer.witness.is_some();
                assert!(named || answer.verdict != Verdict::Yes, "{answer:?}");
                answer.witness.into_iter().for_each(in_range);
            }
            Err(error) => assert_ne!(error, QueryError::Unchecked),
        }
        match a.all_overlaps(&b, pose, &mut pairs, stop, &mut queue) {
            Ok(answer) => {
                assert!(answer.work.opened <= stop.steps, "{answer:?}");
                assert!(answer.dropped == 0 || answer.stored == pairs.len(), "{answer:?}");
                pairs[..answer.stored].iter().for_each(|pair| in_range(pair.triangles));
            }
            Err(error) => assert_ne!(error, QueryError::Unchecked),
        }
        // A triangle is paired with each triangle once: without a budget too the search ends.
        for stop in [stop, Budget::EXACT] {
            match a.meets_triangle(corners, stop, &mut queue) {
                Ok(answer) => {
                    assert!(answer.work.opened <= stop.steps, "{answer:?}");
                    assert!(answer.work.total() <= bound(&a), "{answer:?}");
                }
                Err(error) => assert_ne!(error, QueryError::Unchecked),
            }
        }
    }
}

/// Outer hits on an edited blob, from the base hull and from the hull that this leaves. The list of
/// candidates is long enough for every face, so that nothing is searched twice.
pub fn outer(data: &[u8]) {
    let mut input = Input(data);
    let blob = input.blob(seeds());
    let Ok(model) = Hull::open(&blob) else { return };
    let mut refined = Box::new(RefinedHull::<256>::new());
    let mut scratch = vec![ScratchEntry::EMPTY; 4096];
    let mut hits = [Hit::EMPTY; 4];
    let (a, b) = (input.point(), input.point());
    for search in [OuterSearch::First, OuterSearch::Outer] {
        let exact = Budget::EXACT;
        match model.outer_hits(a, b, search, &mut refined, &mut hits, exact, &mut scratch) {
            Ok(answer) => {
                assert!(answer.t.lower >= 0.0 && answer.t.lower <= answer.t.upper, "{answer:?}");
                assert!(answer.stored <= hits.len(), "{answer:?}");
                assert!(answer.work.opened <= model.header().splits, "{:?}", answer.work);
            }
            Err(error) => assert_ne!(error, QueryError::Unchecked),
        }
    }
}

/// Refinement of an edited blob for any focus, twice on the same state: it ends, keeps to its
/// memory and gives out corners in range.
pub fn refine(data: &[u8]) {
    let mut input = Input(data);
    let blob = input.blob(seeds());
    let Ok(model) = Hull::open(&blob) else { return };
    let mut refined = Box::new(RefinedHull::<48>::new());
    let mut changes = [SplitChange::EMPTY; 32];
    for _ in 0..2 {
        let (a, b) = (input.point(), input.point());
        let (radius, error) = (input.float(), input.float());
        let focus = match input.byte() % 5 {
            0 => Focus::Everywhere,
            1 => Focus::Ball { centre: a, radius },
            2 => Focus::Box { a, b },
            3 => Focus::Segment { a, b, radius },
            _ => Focus::Eye {
                position: a,
                axis: b,
                cosine: input.float(),
                error_per_distance: radius,
            },
        };
        match refined.update(&model, &focus, error, &mut changes) {
            Ok(update) => {
                assert!(update.stored <= changes.len() && refined.splits() <= 48, "{update:?}");
                assert!(update.error_left >= 0.0, "{update:?}");
                let corners = changes[..update.stored]
                    .iter()
                    .flat_map(|change| change.removed(&model).chain(change.added(&model)))
                    .chain(refined.faces(&model).map(|face| face.corners));
                for corners in corners {
                    assert!(model.positions(corners).is_some());
                }
            }
            Err(error) => assert_ne!(error, QueryError::Unchecked),
        }
    }
}
