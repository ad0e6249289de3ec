//! A question to a structure, and the search for its worst query.

use super::goal::{Found, Goal, Worst};
use super::search::Search;
use crate::distances::{Distances, has_sides, signed_distance};
use crate::trade::{self, Board, Shape};
use meshsweep_core::{Blob, Budget, Facing, Interval, Work};

/// A question of points, balls or segments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Question {
    /// Closest points.
    Closest,
    /// Whether anything is within a distance.
    Within,
    /// Signed distances, by a box tree or a fence.
    Signed,
    /// Winding numbers, by a box tree.
    Winding,
    /// First hits of segments, by a box tree or a hull hierarchy.
    Segment,
}

impl Question {
    /// The name of the command that asks it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Closest => "closest",
            Self::Within => "within",
            Self::Signed => "signed",
            Self::Winding => "winding",
            Self::Segment => "segment",
        }
    }

    /// Whether its answers are intervals.
    const fn has_interval(self) -> bool {
        !matches!(self, Self::Within | Self::Segment)
    }
}

/// A question, and the structure that answers it.
#[derive(Clone, Copy, Debug)]
pub struct Subject<'a> {
    /// The question.
    pub question: Question,
    /// The structure.
    pub structure: Distances<'a>,
}

impl<'a> Subject<'a> {
    /// All that a blob can be asked.
    #[must_use]
    pub fn all(blob: &Blob<'a>) -> Vec<Self> {
        use Question::{Closest, Segment, Signed, Winding, Within};
        let mut all = Vec::new();
        let mut add = |structure, questions: &[(bool, Question)]| {
            let served = questions.iter().filter(|(is_served, _)| *is_served);
            all.extend(served.map(|&(_, question)| Self { question, structure }));
        };
        if let Ok(tree) = blob.bvh() {
            let is_near = tree.serves_distances();
            let questions = [
                (is_near, Closest),
                (is_near, Within),
                (is_near && has_sides(&tree), Signed),
                (tree.serves_winding(), Winding),
                (tree.serves_segments(), Segment),
            ];
            add(Distances::Tree(tree), &questions);
        }
        if let Ok(hull) = blob.hull() {
            add(Distances::Hull(hull), &[(true, Closest), (true, Segment)]);
        }
        if let Some(hull) = blob.tight_hulls().ok().and_then(|hulls| hulls.finest()) {
            let is_near = hull.bvh().serves_distances();
            add(Distances::Tight(hull), &[(is_near, Closest), (is_near, Within)]);
        }
        if let Ok(curve) = blob.curve() {
            let is_fence = curve.check_fence().is_ok();
            add(Distances::Curve(curve), &[(true, Closest), (true, Within), (is_fence, Signed)]);
        }
        all
    }

    /// Searches the costliest query; with a limit of steps the widest interval too. See
    /// [`Climb::starts`](super::Climb::starts).
    #[must_use]
    pub fn worst(&self, budget: Budget, starts: usize) -> Vec<Worst> {
        let is_limited = budget.steps != u32::MAX && self.question.has_interval();
        let goals: &[Goal] = if is_limited { &[Goal::Work, Goal::Width] } else { &[Goal::Work] };
        goals.iter().filter_map(|&goal| self.worst_of(goal, budget, starts)).collect()
    }

    /// Searches the query of the most work or of the widest interval. `None` if no query has an
    /// answer.
    #[must_use]
    pub fn worst_of(&self, goal: Goal, budget: Budget, starts: usize) -> Option<Worst> {
        let Self { question, structure } = self;
        let search = Search::new(structure, goal, starts);
        let found = |work, width| Some(Found { work, width, instructions: None });
        match (question, structure) {
            (Question::Closest, _) => search.points(|point, scratch| {
                let near = structure.closest_point(*point, budget, scratch).ok()?;
                let width = Some(near.distance.upper - near.distance.lower);
                let instructions = instructions(self, &[*point], &budget, &near.work);
                Some(Found { work: near.work, width, instructions })
            }),
            (Question::Within, _) => search.balls(|point, share, scratch| {
                let near = structure.closest_point(point, Budget::EXACT, scratch).ok()?;
                let distance = share * near.distance.upper;
                let work = structure.any_within(point, distance, budget, scratch).ok()?.work;
                let instructions = instructions(self, &[point], &budget, &work);
                Some(Found { work, width: None, instructions })
            }),
            (Question::Signed, Distances::Tree(tree)) => search.points(|point, scratch| {
                let signed = signed_distance(tree, *point, budget, scratch).ok()?;
                let Interval { lower, upper } = signed.distance;
                found(signed.closest.work, Some(upper - lower))
            }),
            (Question::Signed, Distances::Curve(curve)) => search.points(|&[x, y, z], scratch| {
                let found = curve.signed_distance([x, y], budget, scratch).ok()?.closest;
                let width = Some(found.distance.upper - found.distance.lower);
                let instructions = instructions(self, &[[x, y, z]], &budget, &found.work);
                Some(Found { work: found.work, width, instructions })
            }),
            (Question::Winding, Distances::Tree(tree)) => search.points(|point, scratch| {
                let winding = tree.winding_number(*point, budget, scratch).ok()?;
                let Interval { lower, upper } = winding.number;
                found(winding.work, Some(upper - lower))
            }),
            (Question::Segment, Distances::Tree(tree)) => search.segments(|a, b, scratch| {
                let work = tree.first_hit(a, b, Facing::Both, budget, scratch).ok()?.work;
                let instructions = instructions(self, &[a, b], &budget, &work);
                Some(Found { work, width: None, instructions })
            }),
            (Question::Segment, Distances::Hull(hull)) => search.segments(|a, b, scratch| {
                let work = hull.first_hit(a, b, budget, scratch).ok()?.work;
                let instructions = instructions(self, &[a, b], &budget, &work);
                Some(Found { work, width: None, instructions })
            }),
            _ => None,
        }
    }
}

/// Instructions of a closest point, a first hit or a question to curves with this work, as
/// [`trade`] predicts them.
fn instructions(
    Subject { question, structure }: &Subject<'_>,
    place: &[[f32; 3]],
    budget: &Budget,
    work: &Work,
) -> Option<[f64; 2]> {
    let is_hit = *question == Question::Segment;
    let is_known = matches!(question, Question::Closest | Question::Segment);
    let (search, shape) = match structure {
        Distances::Curve(curve) => {
            let search = match question {
                Question::Within => trade::Search::CurveWithin,
                Question::Signed => trade::Search::CurveSigned,
                _ => trade::Search::Curve,
            };
            (search, Shape::of_curve(curve))
        }
        _ if !is_known => return None,
        Distances::Tree(tree) => {
            let search = match (is_hit, tree.header().is_f32()) {
                (false, false) => trade::Search::Tree,
                (false, true) => trade::Search::TreeF32,
                (true, false) => trade::Search::FirstHit,
                (true, true) => trade::Search::FirstHitF32,
            };
            (search, Shape::of_tree(tree))
        }
        Distances::Hull(hull) if is_hit => (trade::Search::FirstHitOfHull, Shape::of_hull(hull)),
        Distances::Hull(hull) => (trade::Search::Sweep, Shape::of_hull(hull)),
        Distances::Tight(hull) => (trade::Search::Tight, Shape::of_tight(hull)),
        Distances::TreeWithField(_) => return None,
    };
    let features = shape.features(place, budget, work);
    let [m4f, m0] = Board::ALL.map(|board| trade::cost(board, search));
    Some([m4f?.of(&features), m0?.of(&features)])
}
