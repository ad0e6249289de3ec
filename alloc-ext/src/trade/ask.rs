//! The answers of a setting, the work that they took, and the time of this machine.

use super::cost::{Features, Search, Shape};
use super::field::{steps, to_surface};
use super::setting::{How, Question, Setting};
use crate::builder::Recipe;
use crate::clock::Instant;
use crate::distances::Distances;
use meshsweep_core::{
    Blob, Budget, BuildFor, ClosestPoint, CoherentQuery, Curve, Ended, Facing, FirstHit, Hint,
    Hull, Interval, OuterSearch, QueryError, RefinedHull, ScratchEntry, Sdf, Side, Verdict, Work,
};
use std::hint::black_box;

/// Entries of a coherent query's front.
const FRONT: usize = 128;

/// What one query answered.
#[derive(Clone, Copy, Debug)]
pub(super) struct Answer {
    /// The distance, or the free length of a segment, is no less.
    pub lower: f64,
    /// It is no more; infinite if the structure has no upper bound.
    pub upper: f64,
    /// Whether a segment is proved neither clear nor to meet the mesh, or a verdict or a side is
    /// undecided.
    pub is_undecided: bool,
    /// What the cost of a search is predicted from. `None`: there was none, the field was enough.
    pub features: Option<Features>,
    /// Another search that was asked too: the field before a box tree, or the sweep about a segment
    /// that starts inside the refined hull's box.
    pub beside: Option<(Search, Features)>,
}

/// What all queries answered.
#[derive(Clone, Debug)]
pub(super) struct Asked {
    pub answers: Vec<Answer>,
    /// Of a mean query on this machine.
    pub nanoseconds: f64,
    /// Bytes of scratch, and of memory that is kept between queries.
    pub scratch: usize,
}

/// The interval of the distance of each point, lower and upper end. The upper end is infinite if
/// the structure has none. The setting's question is [`Question::ClosestPoint`].
///
/// # Errors
/// A blob without the setting's structure, or a point that is refused.
pub fn intervals(
    setting: &Setting,
    bytes: &[u8],
    points: &[[f32; 3]],
) -> Result<Vec<[f32; 2]>, QueryError> {
    let asked = ask(setting, bytes, points)?;
    Ok(asked
        .answers
        .iter()
        .map(|answer| [answer.lower, answer.upper].map(|end| end as f32))
        .collect())
}

/// Asks a blob of a setting's structure twice: for the answers, and for the time.
///
/// # Errors
/// A blob without the structure, or a point that is refused.
pub(super) fn ask(
    setting: &Setting,
    bytes: &[u8],
    points: &[[f32; 3]],
) -> Result<Asked, QueryError> {
    let blob = Blob::open(bytes).map_err(|_| QueryError::Unchecked)?;
    let budget = setting.budget;
    if setting.question == Question::FirstHit {
        return first_hits(setting, &blob, points.as_chunks().0);
    }
    let points = points.as_chunks::<1>().0;
    let is_of_curves = matches!(setting.question, Question::Within(_) | Question::Signed);
    match setting.recipe {
        Recipe::Curve(_) => of_curves(setting, &blob.curve()?, points),
        _ if is_of_curves => Err(QueryError::NotServed { build_for: BuildFor::Curve }),
        Recipe::Tree(_) | Recipe::SegmentTree(_) => {
            let tree = blob.bvh()?;
            let mut stack = entries(setting, tree.scratch_entries_for(budget));
            let scratch = size_of_val(stack.as_slice());
            let of = Of { budget, shape: Shape::of_tree(&tree), scratch };
            match setting.how {
                How::Fresh => {
                    let asked = first(points, &of, |[p]| {
                        let hint = &mut Hint::NONE.clone();
                        tree.closest_point_in_order(p, hint, budget, &mut stack).map(of_closest)
                    })?;
                    timed(asked, points, |[p]| {
                        tree.closest_point(p, budget, &mut stack).map(of_closest)
                    })
                }
                How::Hinted => {
                    let mut hint = Hint::NONE;
                    let asked = first(points, &of, |[p]| {
                        let near = tree.closest_point_in_order(p, &mut hint, budget, &mut stack);
                        near.map(of_closest)
                    })?;
                    timed(asked, points, |[p]| {
                        let near = tree.closest_point_from(p, &mut hint, budget, &mut stack);
                        near.map(of_closest)
                    })
                }
                How::Precise => twice(points, &of, |[p]| {
                    tree.closest_point_precise(p, budget, &mut stack).map(of_closest)
                }),
                How::Coherent => {
                    let mut kept = CoherentQuery::<FRONT>::new();
                    let of = Of { scratch: scratch + size_of_val(&kept), ..of };
                    twice(points, &of, |[p]| {
                        let near = kept.closest_point(&tree, p, budget, &mut stack);
                        near.map(|near| of_closest(near.closest))
                    })
                }
            }
        }
        Recipe::Sweep(_) | Recipe::Hull(_) | Recipe::CutLevel(_) => {
            let hull = blob.hull()?;
            let enough = match setting.how {
                How::Coherent => Setting::SWEEP_ENTRIES,
                _ => hull.scratch_entries(),
            };
            let mut queue = entries(setting, enough);
            let scratch = size_of_val(queue.as_slice());
            let of = Of { budget, shape: Shape::of_hull(&hull), scratch };
            if setting.how != How::Coherent {
                return plain(Distances::Hull(hull), points, &of, &mut queue);
            }
            let begin = points.first().map_or([0.0; 3], |&[begin]| begin);
            let mut sweep = hull.sweep(begin, &mut queue)?;
            twice(points, &of, |[p]| {
                sweep.move_to(p)?;
                sweep.closest_point(budget).map(of_closest)
            })
        }
        Recipe::Tight(_) => {
            let hull = blob.tight_hulls()?.finest().ok_or(QueryError::Unchecked)?;
            let mut stack = entries(setting, hull.scratch_entries());
            let scratch = size_of_val(stack.as_slice());
            let of = Of { budget, shape: Shape::of_tight(&hull), scratch };
            plain(Distances::Tight(hull), points, &of, &mut stack)
        }
        Recipe::Triboxes(_) => {
            let triboxes = blob.triboxes()?;
            let mut stack = entries(setting, triboxes.scratch_entries());
            let scratch = size_of_val(stack.as_slice());
            let of = Of { budget, shape: Shape::of_triboxes(&triboxes), scratch };
            twice(points, &of, |[p]| {
                let bound = triboxes.distance(p, budget, &mut stack)?;
                let ends = [f64::from(bound.lower), f64::INFINITY];
                Ok(Told::new(ends, bound.work))
            })
        }
        Recipe::Sdf(_) => {
            let field = blob.sdf()?;
            let of = Of { budget, shape: Shape::of_field(&field), scratch: 0 };
            let mut asked = twice(points, &of, |[p]| {
                let found = to_surface(&field, field.distance(p)?.distance);
                let ends = [f64::from(found.lower), f64::from(found.upper)];
                Ok(Told::new(ends, Work::NONE))
            })?;
            for (answer, place) in asked.answers.iter_mut().zip(points) {
                answer.features = Some(of.shape.features(place, &budget, &look_up(&field, place)));
            }
            Ok(asked)
        }
        Recipe::TreeWithSdf(_) => {
            let both = blob.bvh_with_sdf()?;
            let mut stack = entries(setting, both.tree().scratch_entries_for(budget));
            let scratch = size_of_val(stack.as_slice());
            let of = Of { budget, shape: Shape::of_tree(both.tree()), scratch };
            let mut asked = twice(points, &of, |[p]| {
                let found = both.distance_bounds(p, budget, &mut stack)?;
                let ends = [f64::from(found.distance.lower), f64::from(found.distance.upper)];
                Ok(Told::new(ends, found.work))
            })?;
            let shape = Shape::of_field(both.field());
            for (answer, place) in asked.answers.iter_mut().zip(points) {
                let work = look_up(both.field(), place);
                let look_up = Search::of_field(both.field());
                answer.beside = Some((look_up, shape.features(place, &budget, &work)));
                let was_asked = |features: &Features| features[OPENED] > 0.0;
                answer.features = answer.features.filter(was_asked);
            }
            Ok(asked)
        }
    }
}

/// The work of a look-up, as costs count it: an entry of a tree is a node.
fn look_up(field: &Sdf<'_>, [point]: &[[f32; 3]; 1]) -> Work {
    let mut work = Work::NONE;
    work.bounds = steps(field, *point);
    work
}

/// The feature that counts opened nodes.
const OPENED: usize = 5;

fn entries(setting: &Setting, enough: usize) -> Vec<ScratchEntry> {
    vec![ScratchEntry::EMPTY; setting.entries.unwrap_or(enough).min(enough).max(1)]
}

/// Questions to curves, asked twice likewise.
fn of_curves(
    setting: &Setting,
    curve: &Curve<'_>,
    points: &[[[f32; 3]; 1]],
) -> Result<Asked, QueryError> {
    let Setting { question, budget, how, .. } = *setting;
    let is_kept = how == How::Coherent;
    let enough = if is_kept { curve.sweep_entries() } else { curve.scratch_entries() };
    let mut queue = entries(setting, enough);
    let of = Of { budget, shape: Shape::of_curve(curve), scratch: size_of_val(queue.as_slice()) };
    let told = |distance: Interval, is_undecided, work| {
        let ends = [distance.lower, distance.upper].map(f64::from);
        Told { is_undecided, ..Told::new(ends, work) }
    };
    match question {
        Question::Within(distance) => twice(points, &of, |[p]| {
            let found = curve.within(p, distance, budget, &mut queue)?;
            let end = f64::from(distance);
            let ends = match found.verdict {
                Verdict::Yes => [0.0, end],
                Verdict::No => [end, f64::INFINITY],
                _ => [0.0, f64::INFINITY],
            };
            let is_undecided = matches!(found.verdict, Verdict::Undecided(_));
            Ok(Told { is_undecided, ..Told::new(ends, found.work) })
        }),
        Question::Signed => twice(points, &of, |[[x, y, _]]| {
            let found = curve.signed_distance([x, y], budget, &mut queue)?;
            let is_undecided = matches!(found.side, Side::Undecided(_));
            // Of a side that is decided the truth has no sign.
            let distance = if is_undecided { found.distance } else { found.closest.distance };
            Ok(told(distance, is_undecided, found.closest.work))
        }),
        _ if is_kept => {
            let begin = points.first().map_or([0.0; 3], |&[begin]| begin);
            let mut sweep = curve.sweep(begin, &mut queue)?;
            twice(points, &of, |[p]| {
                sweep.move_to(p)?;
                let found = sweep.closest_point(budget)?;
                Ok(told(found.distance, false, found.work))
            })
        }
        _ => twice(points, &of, |[p]| {
            let found = curve.closest_point(p, budget, &mut queue)?;
            Ok(told(found.distance, false, found.work))
        }),
    }
}

/// First hits of segments, asked twice likewise.
fn first_hits(
    setting: &Setting,
    blob: &Blob<'_>,
    segments: &[[[f32; 3]; 2]],
) -> Result<Asked, QueryError> {
    let budget = setting.budget;
    match setting.recipe {
        Recipe::Hull(_) => outer_hits(setting, &blob.hull()?, segments),
        Recipe::Sweep(_) | Recipe::CutLevel(_) => {
            let hull = blob.hull()?;
            let mut queue = entries(setting, hull.scratch_entries());
            let scratch = size_of_val(queue.as_slice());
            let of = Of { budget, shape: Shape::of_hull(&hull), scratch };
            twice(segments, &of, |[a, b]| {
                Ok(of_hit([a, b], &hull.first_hit(a, b, budget, &mut queue)?))
            })
        }
        _ => {
            let tree = blob.bvh()?;
            let mut stack = entries(setting, tree.scratch_entries_for(budget));
            let scratch = size_of_val(stack.as_slice());
            let of = Of { budget, shape: Shape::of_tree(&tree), scratch };
            twice(segments, &of, |[a, b]| {
                let hit = tree.first_hit(a, b, Facing::Both, budget, &mut stack)?;
                Ok(of_hit([a, b], &hit))
            })
        }
    }
}

/// First hits on the refined hull, asked twice likewise. A segment that starts inside its box is
/// asked again of the sweep.
fn outer_hits(
    setting: &Setting,
    hull: &Hull<'_>,
    segments: &[[[f32; 3]; 2]],
) -> Result<Asked, QueryError> {
    let budget = setting.budget;
    let mut refined = RefinedHull::<{ Setting::SPLITS }>::new();
    let mut beside = entries(setting, Setting::BESIDE_SPLITS);
    let mut queue = vec![ScratchEntry::EMPTY; hull.scratch_entries()];
    // Both searches may have the same scratch, one after the other.
    let scratch = size_of_val(beside.as_slice()).max(size_of_val(queue.as_slice()));
    let scratch = size_of_val(&refined) + scratch;
    let of = Of { budget, shape: Shape::of_hull(hull), scratch };
    twice(segments, &of, |[a, b]| {
        refined.reset();
        let (first, none) = (OuterSearch::First, &mut []);
        let outer = hull.outer_hits(a, b, first, &mut refined, none, budget, &mut beside)?;
        if outer.starts_inside {
            let swept = hull.first_hit(a, b, budget, &mut queue)?;
            let beside = Some((Search::FirstHitOfHull, swept.work));
            return Ok(Told { work: outer.work, beside, ..of_hit([a, b], &swept) });
        }
        let is_undecided = outer.t.lower.is_finite() && outer.ended != Ended::Exact;
        let told = Told::new(free_length([a, b], outer.t), outer.work);
        Ok(Told { is_undecided, ..told })
    })
}

fn of_closest(near: ClosestPoint) -> Told {
    Told::new([near.distance.lower, near.distance.upper].map(f64::from), near.work)
}

fn of_hit(ends: [[f32; 3]; 2], hit: &FirstHit) -> Told {
    let is_hit = hit.hit.is_some() && hit.ended == Ended::Exact;
    let is_undecided = !hit.is_clear() && !is_hit;
    Told { is_undecided, ..Told::new(free_length(ends, hit.t), hit.work) }
}

/// The free length. That of a clear segment is its length, and no hit that is not known is later.
fn free_length([a, b]: [[f32; 3]; 2], t: Interval) -> [f64; 2] {
    let [a, b] = [a, b].map(|end| glam::Vec3::from(end).as_dvec3());
    let length = a.distance(b);
    [t.lower, t.upper].map(|t| f64::from(t).min(1.0) * length)
}

fn plain(
    structure: Distances<'_>,
    points: &[[[f32; 3]; 1]],
    of: &Of,
    scratch: &mut [ScratchEntry],
) -> Result<Asked, QueryError> {
    twice(points, of, |[p]| {
        let near = structure.closest_point(p, of.budget, scratch)?;
        let ends = [near.distance.lower, near.distance.upper].map(f64::from);
        Ok(Told::new(ends, near.work))
    })
}

/// Parts that all queries of a setting share.
#[derive(Clone, Copy)]
struct Of {
    budget: Budget,
    shape: Shape,
    scratch: usize,
}

/// What one query told.
struct Told {
    /// Of the interval.
    ends: [f64; 2],
    work: Work,
    is_undecided: bool,
    /// Another search that was asked too.
    beside: Option<(Search, Work)>,
}

impl Told {
    const fn new(ends: [f64; 2], work: Work) -> Self {
        Self { ends, work, is_undecided: false, beside: None }
    }
}

type Found = Result<Told, QueryError>;

/// For the answers and for the time alike.
fn twice<const N: usize>(
    places: &[[[f32; 3]; N]],
    of: &Of,
    mut one: impl FnMut([[f32; 3]; N]) -> Found,
) -> Result<Asked, QueryError> {
    timed(first(places, of, &mut one)?, places, one)
}

/// For the answers: a box tree is searched in the order of boards, so that the work is theirs.
fn first<const N: usize>(
    places: &[[[f32; 3]; N]],
    of: &Of,
    mut one: impl FnMut([[f32; 3]; N]) -> Found,
) -> Result<Asked, QueryError> {
    let answers = places.iter().map(|&place| {
        let Told { ends: [lower, upper], work, is_undecided, beside } = one(place)?;
        let features = |work: Work| of.shape.features(&place, &of.budget, &work);
        let beside = beside.map(|(search, work)| (search, features(work)));
        Ok(Answer { lower, upper, is_undecided, features: Some(features(work)), beside })
    });
    let answers = answers.collect::<Result<Vec<_>, QueryError>>()?;
    Ok(Asked { answers, nanoseconds: 0.0, scratch: of.scratch })
}

/// For the time: a box tree is searched as this machine does it best.
fn timed<const N: usize>(
    asked: Asked,
    places: &[[[f32; 3]; N]],
    mut one: impl FnMut([[f32; 3]; N]) -> Found,
) -> Result<Asked, QueryError> {
    let begun = Instant::now();
    for &place in places {
        black_box(one(black_box(place))?);
    }
    let nanoseconds = begun.elapsed().as_nanos() as f64 / places.len().max(1) as f64;
    Ok(Asked { nanoseconds, ..asked })
}
