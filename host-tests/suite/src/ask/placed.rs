//! One question to one blob at many places, as bytes that a board finds in its memory.
//!
//! The host chooses the places. The simulator counts the question on the host, and the emulator on
//! a board.

use core::mem::size_of;

use meshsweep_core::{
    Blob, Budget, Bvh, BvhWithSdf, ClosestPoint, CoherentQuery, Curve, CurveClosest, CurveSegment,
    CurveSignedDistance, Decided, DistanceBounds, Facing, FieldDistance, FirstHit, Focus, Hint,
    Hit, Hull, OuterHits, OuterSearch, Pose, QueryError, RefinedHull, Refinement, ScratchEntry,
    Separation, SplitChange, TriboxBound, UnitDistance,
};

use super::{Refused, timed};
use crate::fold::Fold;
use crate::observer::Observer;

/// The question at each place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Question {
    /// The box tree's closest point.
    Tree(Budget),
    /// The closest point of a fresh sweep.
    Sweep(Budget),
    /// The closest point of one sweep that moves from place to place.
    KeptSweep(Budget),
    /// The hull refined for a ball of a radius, to an error; both in input units.
    Refine(f32, f32),
    /// The box tree's closest point, from the leaf of the place before.
    Hinted(Budget),
    /// The box tree's closest point, by a front that is kept from place to place.
    Coherent(Budget),
    /// The distance of the mesh inside the finest tight hull.
    Tight(Budget),
    /// A lower bound of the distance from triboxes.
    Triboxes(Budget),
    /// The box tree's closest point in f64.
    Precise(Budget),
    /// Whether the box tree is within a distance of the other blob's at a pose. Four places are a
    /// pose: the rows of its matrix, then its translation.
    PairOfTrees(f32),
    /// Whether the triboxes prove that the model is farther than a distance from the other blob's.
    PairOfTriboxes(f32),
    /// The box tree's first hit. Two places are a segment.
    FirstHit(Budget),
    /// The hull hierarchy's first hit, likewise.
    FirstHitOfHull(Budget),
    /// The distance of a field.
    Field,
    /// The same in whole units. The numbers of a place are whole.
    FieldInUnits,
    /// Whether the box tree is within a distance.
    Within(f32),
    /// The same of box tree and field.
    WithinOfBoth(f32),
    /// The closest point of box tree and field.
    ClosestOfBoth(Budget),
    /// Bounds of the distance from box tree and field.
    BoundsOfBoth(Budget),
    /// The closest point of curves.
    Curve(Budget),
    /// The same by one search that moves from place to place.
    KeptCurve(Budget),
    /// Whether curves are within a distance, in at most so many steps.
    CurveWithin(f32, u32),
    /// The signed distance of a fence. The z of a place is not asked.
    CurveSigned(Budget),
    /// The first hit from outside on the refined hull, each from the base hull. Two places are a
    /// segment.
    OuterHit,
}

impl Question {
    fn words(self) -> [u32; 4] {
        let of = |kind: u32, budget: Budget| {
            [kind, budget.relative.to_bits(), budget.absolute.to_bits(), budget.steps]
        };
        match self {
            Self::Tree(budget) => of(0, budget),
            Self::Sweep(budget) => of(1, budget),
            Self::KeptSweep(budget) => of(2, budget),
            Self::Refine(radius, error) => [3, radius.to_bits(), error.to_bits(), 0],
            Self::Hinted(budget) => of(4, budget),
            Self::Coherent(budget) => of(5, budget),
            Self::Tight(budget) => of(6, budget),
            Self::Triboxes(budget) => of(7, budget),
            Self::Precise(budget) => of(8, budget),
            Self::PairOfTrees(distance) => [9, distance.to_bits(), 0, 0],
            Self::PairOfTriboxes(distance) => [10, distance.to_bits(), 0, 0],
            Self::FirstHit(budget) => of(11, budget),
            Self::FirstHitOfHull(budget) => of(12, budget),
            Self::Field => [13, 0, 0, 0],
            Self::FieldInUnits => [14, 0, 0, 0],
            Self::Within(distance) => [15, distance.to_bits(), 0, 0],
            Self::WithinOfBoth(distance) => [16, distance.to_bits(), 0, 0],
            Self::ClosestOfBoth(budget) => of(17, budget),
            Self::BoundsOfBoth(budget) => of(18, budget),
            Self::Curve(budget) => of(19, budget),
            Self::KeptCurve(budget) => of(20, budget),
            Self::CurveWithin(distance, steps) => [21, distance.to_bits(), 0, steps],
            Self::CurveSigned(budget) => of(22, budget),
            Self::OuterHit => [23, 0, 0, 0],
        }
    }

    /// Places that one query takes.
    #[must_use]
    pub const fn places(self) -> usize {
        match self {
            Self::PairOfTrees(_) | Self::PairOfTriboxes(_) => 4,
            Self::FirstHit(_) | Self::FirstHitOfHull(_) | Self::OuterHit => 2,
            _ => 1,
        }
    }

    fn of_words([kind, first, second, steps]: [u32; 4]) -> Option<Self> {
        let (first, second) = (f32::from_bits(first), f32::from_bits(second));
        let budget = Budget::EXACT.with_relative(first).with_absolute(second).with_steps(steps);
        Some(match kind {
            0 => Self::Tree(budget),
            1 => Self::Sweep(budget),
            2 => Self::KeptSweep(budget),
            3 => Self::Refine(first, second),
            4 => Self::Hinted(budget),
            5 => Self::Coherent(budget),
            6 => Self::Tight(budget),
            7 => Self::Triboxes(budget),
            8 => Self::Precise(budget),
            9 => Self::PairOfTrees(first),
            10 => Self::PairOfTriboxes(first),
            11 => Self::FirstHit(budget),
            12 => Self::FirstHitOfHull(budget),
            13 => Self::Field,
            14 => Self::FieldInUnits,
            15 => Self::Within(first),
            16 => Self::WithinOfBoth(first),
            17 => Self::ClosestOfBoth(budget),
            18 => Self::BoundsOfBoth(budget),
            19 => Self::Curve(budget),
            20 => Self::KeptCurve(budget),
            21 => Self::CurveWithin(first, steps),
            22 => Self::CurveSigned(budget),
            23 => Self::OuterHit,
            _ => return None,
        })
    }
}

/// A question, its blobs and the places.
#[derive(Clone, Copy, Debug)]
pub struct Placed<'t> {
    /// The question.
    pub question: Question,
    /// The blob.
    pub blob: &'t [u8],
    /// The blob of the model that moves, for a question about two; else no bytes.
    pub other: &'t [u8],
    places: &'t [[u8; 12]],
}

/// Bytes of the header: the question in four words, the lengths of the blobs, the number of places.
pub const HEADER: usize = 28;

/// The header of two blobs of `bytes` bytes and of some places. The blobs follow, then three f32 a
/// place, little-endian.
#[must_use]
pub fn header(question: Question, bytes: [u32; 2], places: u32) -> [u8; HEADER] {
    let ([kind, first, second, steps], [blob, other]) = (question.words(), bytes);
    let mut header = [0; HEADER];
    let (words, _) = header.as_chunks_mut();
    for (to, word) in words.iter_mut().zip([kind, first, second, steps, blob, other, places]) {
        *to = word.to_le_bytes();
    }
    header
}

impl<'t> Placed<'t> {
    /// Reads what the host wrote; what follows the last place is no part of it.
    #[must_use]
    pub fn read(bytes: &'t [u8]) -> Option<Self> {
        let (header, rest) = bytes.split_first_chunk::<HEADER>()?;
        let mut words = header.as_chunks().0.iter().map(|word| u32::from_le_bytes(*word));
        let mut next = || words.next();
        let question = Question::of_words([next()?, next()?, next()?, next()?])?;
        let (blob, rest) = rest.split_at_checked(next()? as usize)?;
        let (other, rest) = rest.split_at_checked(next()? as usize)?;
        let places = rest.as_chunks().0.get(..next()? as usize)?;
        Some(Self { question, blob, other, places })
    }

    /// The places.
    pub fn places(&self) -> impl Iterator<Item = [f32; 3]> + use<'t> {
        self.places.iter().map(place)
    }
}

/// Entries of a sweep: 4 KiB. With fewer a fresh one answers too, more slowly.
const ENTRIES: usize = 512;

/// Splits of the refined hull: 8 KiB.
const SPLITS: usize = 500;

/// Entries of scratch beside the refined hull. With fewer it answers too, more slowly.
const BESIDE: usize = 64;

/// Entries of a coherent query's front.
const FRONT: usize = 128;

/// What the questions need beside the blob.
#[derive(Debug)]
pub struct Memory<'t> {
    entries: [ScratchEntry; ENTRIES],
    refined: RefinedHull<'t, SPLITS>,
    changes: [SplitChange; 64],
    coherent: CoherentQuery<'t, FRONT>,
}

impl Memory<'_> {
    /// Memory that no question has used.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            entries: [ScratchEntry::EMPTY; ENTRIES],
            refined: RefinedHull::new(),
            changes: [SplitChange::EMPTY; 64],
            coherent: CoherentQuery::new(),
        }
    }
}

impl Default for Memory<'_> {
    fn default() -> Self {
        Self::new()
    }
}

/// The answer at a place.
#[derive(Clone, Copy, Debug)]
pub enum Answer {
    /// A closest point.
    Closest(ClosestPoint),
    /// A lower bound from triboxes.
    Bound(TriboxBound),
    /// An update of the refined hull.
    Refined(Refinement),
    /// Whether two box trees are within a distance.
    Within(Decided<[u32; 2]>),
    /// Whether triboxes are farther than a distance.
    Farther(Separation),
    /// A first hit.
    Hit(FirstHit),
    /// A first hit from outside.
    Outer(OuterHits),
    /// The distance of a field.
    Field(FieldDistance),
    /// The same in whole units.
    Units(UnitDistance),
    /// Whether a structure is within a distance of a point.
    Decided(Decided<u32>),
    /// Bounds of a distance.
    Bounds(DistanceBounds),
    /// A closest point of curves.
    Curve(CurveClosest),
    /// Whether curves are within a distance.
    OfCurve(Decided<CurveSegment>),
    /// A signed distance of a fence.
    Fence(CurveSignedDistance),
    /// A refusal.
    Refused(QueryError),
}

impl Answer {
    /// Folds the bits of the answer.
    pub fn told(&self, fold: &mut Fold) {
        match self {
            Self::Closest(answer) => super::closest_point(fold, answer),
            Self::Bound(bound) => super::triboxes::bound(fold, bound),
            Self::Refined(update) => {
                for word in [update.faces, update.performed, update.undone, update.dropped] {
                    fold.word(word);
                }
                fold.f32(update.error_left);
            }
            Self::Within(answer) => super::verdict(fold, answer.verdict),
            Self::Farther(answer) => {
                fold.word(u32::from(answer.is_apart()));
                super::how(fold, answer.ended);
            }
            Self::Hit(hit) => super::segment_hit(fold, hit),
            Self::Outer(outer) => {
                fold.f32(outer.t.lower);
                fold.f32(outer.t.upper);
                fold.word(u32::from(outer.starts_inside));
                super::how(fold, outer.ended);
            }
            Self::Field(found) => super::sdf::field_distance(fold, found),
            Self::Units(found) => super::sdf::unit_distance(fold, *found),
            Self::Decided(answer) => super::verdict(fold, answer.verdict),
            Self::Bounds(found) => super::both::distance_bounds(fold, found),
            Self::Curve(found) => super::curve::closest_point(fold, found),
            Self::OfCurve(found) => super::curve::of_verdict(fold, found),
            Self::Fence(found) => super::curve::signed_distance(fold, found),
            Self::Refused(error) => super::refusal(fold, *error),
        }
    }
}

/// Asks at the first `queries` places, and tells each answer. Returns the bytes of RAM that the
/// question needs beside the stack.
///
/// # Errors
/// The blob is refused, or asks for more scratch than there is.
pub fn ask<'t>(
    placed: &Placed<'t>,
    queries: usize,
    memory: &mut Memory<'t>,
    observer: &mut impl Observer,
    mut told: impl FnMut(&Answer),
) -> Result<usize, Refused> {
    let blob = Blob::open(placed.blob).map_err(Refused::of)?;
    let other = || Blob::open(placed.other).map_err(Refused::of);
    let places = placed.places.iter().take(queries).map(place);
    let poses = placed.places.as_chunks::<4>().0.iter().take(queries).map(pose);
    let segments = placed.places.as_chunks::<2>().0.iter().take(queries);
    let segments = segments.map(|ends| ends.each_ref().map(place));
    let asking = Asking { places, observer, told: &mut told };
    match placed.question {
        Question::PairOfTrees(distance) => {
            let (first, second, exact) = (tree(&blob)?, tree(&other()?)?, Budget::EXACT);
            let ask =
                |pose, stack: &mut [_]| first.within_of(&second, pose, distance, exact, stack);
            let (asking, wanted) = (asking.at(poses), Bvh::DISTANCE_ENTRIES);
            by_entries(&mut memory.entries, wanted, asking, ask, Answer::Within)
        }
        Question::PairOfTriboxes(distance) => {
            let triboxes = |blob: &Blob<'t>| blob.triboxes().map_err(|_| Refused::NO_SECTION);
            let (first, second, exact) = (triboxes(&blob)?, triboxes(&other()?)?, Budget::EXACT);
            let ask =
                |pose, stack: &mut [_]| first.within_of(&second, pose, distance, exact, stack);
            let wanted = first.separation_entries(&second);
            by_entries(&mut memory.entries, wanted, asking.at(poses), ask, Answer::Farther)
        }
        Question::Tree(budget) => {
            let tree = tree(&blob)?;
            let entries = tree.scratch_entries_for(budget);
            let ask = |place, stack: &mut [_]| tree.closest_point(place, budget, stack);
            by_entries(&mut memory.entries, entries, asking, ask, Answer::Closest)
        }
        Question::Precise(budget) => {
            let tree = tree(&blob)?;
            let ask = |place, stack: &mut [_]| tree.closest_point_precise(place, budget, stack);
            let entries = tree.scratch_entries();
            by_entries(&mut memory.entries, entries, asking, ask, Answer::Closest)
        }
        Question::Hinted(budget) => {
            let (tree, mut hint) = (tree(&blob)?, Hint::NONE);
            let entries = tree.scratch_entries_for(budget);
            let ask =
                |place, stack: &mut [_]| tree.closest_point_from(place, &mut hint, budget, stack);
            by_entries(&mut memory.entries, entries, asking, ask, Answer::Closest)
        }
        Question::Coherent(budget) => {
            let (tree, Memory { entries, coherent, .. }) = (tree(&blob)?, memory);
            let ask = |place, stack: &mut [_]| coherent.closest_point(&tree, place, budget, stack);
            let wanted = tree.scratch_entries_for(budget);
            let used =
                by_entries(entries, wanted, asking, ask, |near| Answer::Closest(near.closest))?;
            Ok(used.saturating_add(size_of::<CoherentQuery<'_, FRONT>>()))
        }
        Question::Tight(budget) => {
            let hulls = blob.tight_hulls().map_err(|_| Refused::NO_SECTION)?;
            let hull = hulls.finest().ok_or(Refused::NO_SECTION)?;
            let ask = |place, stack: &mut [_]| hull.closest_point(place, budget, stack);
            let entries = hull.scratch_entries();
            by_entries(&mut memory.entries, entries, asking, ask, Answer::Closest)
        }
        Question::Triboxes(budget) => {
            let triboxes = blob.triboxes().map_err(|_| Refused::NO_SECTION)?;
            let ask = |place, stack: &mut [_]| triboxes.distance(place, budget, stack);
            let entries = triboxes.scratch_entries();
            by_entries(&mut memory.entries, entries, asking, ask, Answer::Bound)
        }
        Question::Sweep(budget) => {
            let hull = hull(&blob)?;
            let ask = |place, queue: &mut [_]| hull.closest_point(place, budget, queue);
            by_entries(&mut memory.entries, ENTRIES, asking, ask, Answer::Closest)
        }
        Question::FirstHit(budget) => {
            let tree = tree(&blob)?;
            let entries = tree.scratch_entries_for(budget);
            let ask =
                |[a, b]: [_; 2], stack: &mut [_]| tree.first_hit(a, b, Facing::Both, budget, stack);
            by_entries(&mut memory.entries, entries, asking.at(segments), ask, Answer::Hit)
        }
        Question::FirstHitOfHull(budget) => {
            let hull = hull(&blob)?;
            let ask = |[a, b]: [_; 2], queue: &mut [_]| hull.first_hit(a, b, budget, queue);
            let entries = hull.scratch_entries();
            by_entries(&mut memory.entries, entries, asking.at(segments), ask, Answer::Hit)
        }
        Question::OuterHit => outer_hits(&hull(&blob)?, memory, asking.at(segments)),
        Question::Field => {
            let field = blob.sdf().map_err(|_| Refused::NO_SECTION)?;
            asking.each(|place| field.distance(place), Answer::Field);
            Ok(0)
        }
        Question::FieldInUnits => {
            let field = blob.sdf().map_err(|_| Refused::NO_SECTION)?;
            let wholes = asking.places.clone().map(|[x, y, z]| [x as i32, y as i32, z as i32]);
            asking.at(wholes).each(|whole| field.distance_in_units(whole), Answer::Units);
            Ok(0)
        }
        Question::Within(distance) => {
            let (tree, exact) = (tree(&blob)?, Budget::EXACT);
            let entries = tree.scratch_entries();
            let ask = |place, stack: &mut [_]| tree.within(place, distance, exact, stack);
            by_entries(&mut memory.entries, entries, asking, ask, Answer::Decided)
        }
        Question::WithinOfBoth(distance) => {
            let (both, exact) = (both(&blob)?, Budget::EXACT);
            let entries = both.tree().scratch_entries();
            let ask = |place, stack: &mut [_]| both.within(place, distance, exact, stack);
            by_entries(&mut memory.entries, entries, asking, ask, Answer::Decided)
        }
        Question::ClosestOfBoth(budget) => {
            let both = both(&blob)?;
            let entries = both.tree().scratch_entries_for(budget);
            let ask = |place, stack: &mut [_]| both.closest_point(place, budget, stack);
            by_entries(&mut memory.entries, entries, asking, ask, Answer::Closest)
        }
        Question::BoundsOfBoth(budget) => {
            let both = both(&blob)?;
            let entries = both.tree().scratch_entries_for(budget);
            let ask = |place, stack: &mut [_]| both.distance_bounds(place, budget, stack);
            by_entries(&mut memory.entries, entries, asking, ask, Answer::Bounds)
        }
        Question::Curve(budget) => {
            let curve = curve(&blob)?;
            let ask = |place, queue: &mut [_]| curve.closest_point(place, budget, queue);
            let entries = curve.scratch_entries();
            by_entries(&mut memory.entries, entries, asking, ask, Answer::Curve)
        }
        Question::CurveWithin(distance, steps) => {
            let (curve, budget) = (curve(&blob)?, Budget::EXACT.with_steps(steps));
            let ask = |place, queue: &mut [_]| curve.within(place, distance, budget, queue);
            let entries = curve.scratch_entries();
            by_entries(&mut memory.entries, entries, asking, ask, Answer::OfCurve)
        }
        Question::CurveSigned(budget) => {
            let curve = curve(&blob)?;
            let ask =
                |[x, y, _]: [_; 3], queue: &mut [_]| curve.signed_distance([x, y], budget, queue);
            let entries = curve.scratch_entries();
            by_entries(&mut memory.entries, entries, asking, ask, Answer::Fence)
        }
        Question::KeptCurve(budget) => kept_curve(&curve(&blob)?, budget, memory, asking),
        Question::KeptSweep(budget) => kept_sweep(&hull(&blob)?, budget, memory, asking),
        Question::Refine(radius, error) => refine(&hull(&blob)?, (radius, error), memory, asking),
    }
}

/// Where a question is asked, and who is told of the core's work and of the answers.
struct Asking<'a, P, C, T> {
    places: P,
    observer: &'a mut C,
    told: &'a mut T,
}

impl<'a, P, C, T> Asking<'a, P, C, T> {
    /// The same at other places.
    fn at<Q>(self, places: Q) -> Asking<'a, Q, C, T> {
        Asking { places, observer: self.observer, told: self.told }
    }
}

impl<P, C, T> Asking<'_, P, C, T>
where
    P: Iterator,
    C: Observer,
    T: FnMut(&Answer),
{
    #[inline(always)]
    fn each<A>(
        self,
        mut ask: impl FnMut(P::Item) -> Result<A, QueryError>,
        answer: impl Fn(A) -> Answer,
    ) {
        for place in self.places {
            let found = timed(self.observer, || ask(place));
            (self.told)(&found.map_or_else(Answer::Refused, &answer));
        }
    }
}

fn tree<'t>(blob: &Blob<'t>) -> Result<Bvh<'t>, Refused> {
    blob.bvh().map_err(|_| Refused::NO_SECTION)
}

fn both<'t>(blob: &Blob<'t>) -> Result<BvhWithSdf<'t>, Refused> {
    blob.bvh_with_sdf().map_err(|_| Refused::NO_SECTION)
}

fn hull<'t>(blob: &Blob<'t>) -> Result<Hull<'t>, Refused> {
    blob.hull().map_err(|_| Refused::NO_SECTION)
}

fn curve<'t>(blob: &Blob<'t>) -> Result<Curve<'t>, Refused> {
    blob.curve().map_err(|_| Refused::NO_SECTION)
}

const fn bytes(entries: usize) -> usize {
    entries.saturating_mul(size_of::<ScratchEntry>())
}

/// A question that takes no memory but scratch. Not inlined, so that the stack that is measured is
/// its own.
#[inline(never)]
fn by_entries<P, A>(
    entries: &mut [ScratchEntry],
    wanted: usize,
    asking: Asking<'_, impl Iterator<Item = P>, impl Observer, impl FnMut(&Answer)>,
    mut ask: impl FnMut(P, &mut [ScratchEntry]) -> Result<A, QueryError>,
    answer: impl Fn(A) -> Answer,
) -> Result<usize, Refused> {
    let stack = entries.get_mut(..wanted).ok_or(Refused::MEMORY)?;
    asking.each(|place| ask(place, stack), answer);
    Ok(bytes(wanted))
}

#[inline(never)]
fn kept_sweep(
    hull: &Hull<'_>,
    budget: Budget,
    memory: &mut Memory<'_>,
    asking: Asking<'_, impl Iterator<Item = [f32; 3]> + Clone, impl Observer, impl FnMut(&Answer)>,
) -> Result<usize, Refused> {
    let begin = asking.places.clone().next().unwrap_or_default();
    let mut sweep = hull.sweep(begin, &mut memory.entries).map_err(|_| Refused::MEMORY)?;
    let ask = |place| {
        sweep.move_to(place)?;
        sweep.closest_point(budget)
    };
    asking.each(ask, Answer::Closest);
    Ok(bytes(ENTRIES))
}

#[inline(never)]
fn kept_curve(
    curve: &Curve<'_>,
    budget: Budget,
    memory: &mut Memory<'_>,
    asking: Asking<'_, impl Iterator<Item = [f32; 3]> + Clone, impl Observer, impl FnMut(&Answer)>,
) -> Result<usize, Refused> {
    let begin = asking.places.clone().next().unwrap_or_default();
    let mut sweep = curve.sweep(begin, &mut memory.entries).map_err(|_| Refused::MEMORY)?;
    let ask = |place| {
        sweep.move_to(place)?;
        sweep.closest_point(budget)
    };
    asking.each(ask, Answer::Curve);
    Ok(bytes(ENTRIES))
}

#[inline(never)]
fn refine<'t>(
    hull: &Hull<'t>,
    (radius, error): (f32, f32),
    memory: &mut Memory<'t>,
    asking: Asking<'_, impl Iterator<Item = [f32; 3]>, impl Observer, impl FnMut(&Answer)>,
) -> Result<usize, Refused> {
    let Memory { refined, changes, .. } = memory;
    let ask = |centre| refined.update(hull, &Focus::Ball { centre, radius }, error, changes);
    asking.each(ask, Answer::Refined);
    Ok(size_of::<RefinedHull<'_, SPLITS>>())
}

#[inline(never)]
fn outer_hits<'t>(
    hull: &Hull<'t>,
    memory: &mut Memory<'t>,
    asking: Asking<'_, impl Iterator<Item = [[f32; 3]; 2]>, impl Observer, impl FnMut(&Answer)>,
) -> Result<usize, Refused> {
    let Memory { entries, refined, .. } = memory;
    let scratch = entries.get_mut(..BESIDE).ok_or(Refused::MEMORY)?;
    let mut hits = [Hit::EMPTY; 1];
    let ask = |[a, b]: [_; 2]| {
        refined.reset();
        hull.outer_hits(a, b, OuterSearch::First, refined, &mut hits, Budget::EXACT, scratch)
    };
    asking.each(ask, Answer::Outer);
    Ok(size_of::<RefinedHull<'_, SPLITS>>() + bytes(BESIDE))
}

fn place(bytes: &[u8; 12]) -> [f32; 3] {
    let mut place = [0.0; 3];
    for (to, word) in place.iter_mut().zip(bytes.as_chunks().0) {
        *to = f32::from_le_bytes(*word);
    }
    place
}

fn pose(rows: &[[u8; 12]; 4]) -> Pose {
    let [a, b, c, translation] = rows.each_ref().map(place);
    Pose::rigid([a, b, c], translation)
}
