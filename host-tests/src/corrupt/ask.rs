//! Asks an opened box tree everything, and holds the answers to what is true of any bytes.
//!
//! A blob that was changed on purpose may open: then its boxes may leave something out and its
//! answers may be wrong. But every question ends, within work that the tree's counts bound, without
//! a panic, and what it gives is in range.

use meshsweep_core::{
    Budget, Bvh, ClosestPoint, CoherentPair, CoherentQuery, Eye, Facing, Hint, Hit, Motion,
    Neighbor, PlacedModel, Pose, QueryError, Scene, ScratchEntry, Side, Solid, TriangleHit,
    TrianglePair, Verdict, Work,
};
use meshsweep_suite::Kind;
use meshsweep_suite::questions::Question;

/// The caller's memory, of any length.
#[derive(Debug)]
pub struct Asker {
    stack: Vec<ScratchEntry>,
    near: Vec<Neighbor>,
    hits: Vec<TriangleHit>,
    hint: Hint,
    /// Whether the records of the trees were checked: else their answers may be anything.
    is_checked: bool,
}

impl Asker {
    /// So many entries for each stack, so many places for each list of answers.
    #[must_use]
    pub fn new(entries: usize, places: usize) -> Self {
        Self {
            stack: vec![ScratchEntry::EMPTY; entries],
            near: vec![Neighbor::EMPTY; places],
            hits: vec![TriangleHit::EMPTY; places],
            hint: Hint::NONE,
            is_checked: true,
        }
    }

    /// The same, of trees whose records were not checked. Of these only
    /// [`two_models`](Self::two_models) may be asked.
    #[must_use]
    pub fn of_unchecked(self) -> Self {
        Self { is_checked: false, ..self }
    }

    /// The answer. Only a tree whose records were not checked may be at fault.
    fn told<T>(&self, result: Result<T, QueryError>) -> Option<T> {
        if self.is_checked { answered(result) } else { result.ok() }
    }

    /// Something is true of the answers of checked trees.
    fn holds(&self, is_true: bool, answer: &impl std::fmt::Debug) {
        assert!(is_true || !self.is_checked, "{answer:?}");
    }

    /// Every question about a point. The hint is left from the tree that was asked before,
    /// whichever that was.
    ///
    /// # Panics
    /// If an answer is out of range or took too long.
    pub fn point(&mut self, tree: &Bvh<'_>, point: [f32; 3], distance: f32, stop: &Budget) {
        let Self { stack, near, hint, .. } = self;
        for stop in [stop, &Budget::EXACT] {
            if let Some(answer) = answered(tree.closest_point(point, *stop, stack)) {
                closest(tree, &answer, most(tree, Kind::ClosestFar));
            }
            if let Some(answer) = answered(tree.closest_point_from(point, hint, *stop, stack)) {
                // The triangles of the hint's leaf are looked at once more.
                closest(tree, &answer, most(tree, Kind::ClosestPath) + 16);
            }
            if let Some(answer) = answered(tree.closest_point_precise(point, *stop, stack)) {
                closest(tree, &answer, most(tree, Kind::ClosestPrecise));
            }
            if let Some(answer) = answered(tree.within(point, distance, *stop, stack)) {
                ends(answer.work, most(tree, Kind::Within));
                let named = answer.witness.is_some_and(|number| number < tree.input_triangles());
                assert_eq!(answer.verdict == Verdict::Yes, named, "{answer:?}");
            }
            if let Some(answer) = answered(tree.nearest(point, near, *stop, stack)) {
                ends(answer.work, most(tree, Kind::Nearest));
                assert!(answer.rest_lower >= 0.0, "{answer:?}");
                found(tree, &near[..answer.stored]);
            }
            if let Some(answer) = answered(tree.all_within(point, distance, near, *stop, stack)) {
                ends(answer.work, most(tree, Kind::AllWithin));
                assert!(answer.certain <= answer.stored, "{answer:?}");
                assert!(
                    answer.stored as u64 + u64::from(answer.dropped)
                        <= u64::from(tree.header().triangles)
                );
                found(tree, &near[..answer.stored]);
            }
            if let Some(answer) = answered(tree.winding_number(point, *stop, stack)) {
                ends(answer.work, most(tree, Kind::Winding));
                assert!(answer.number.lower <= answer.number.upper, "{answer:?}");
            }
            if let Some(answer) = answered(tree.signed_distance(point, *stop, stack)) {
                let mut near = answer.closest;
                near.work = Work::default();
                closest(tree, &near, 0);
                ends(answer.closest.work, most(tree, Kind::Signed));
                assert!(answer.distance.lower <= answer.distance.upper, "{answer:?}");
                assert!(
                    tree.header().is_closed() || matches!(answer.side, Side::Undecided(_)),
                    "{answer:?}"
                );
            }
        }
    }

    /// Every question about a segment.
    ///
    /// # Panics
    /// If an answer is out of range or took too long.
    pub fn segment(&mut self, tree: &Bvh<'_>, a: [f32; 3], b: [f32; 3]) {
        let Self { stack, hits, .. } = self;
        for facing in [Facing::Both, Facing::Front, Facing::Back] {
            if let Some(answer) = answered(tree.first_hit(a, b, facing, Budget::EXACT, stack)) {
                ends(answer.work, most(tree, Kind::FirstHit));
                assert!(answer.t.lower >= 0.0 && answer.t.lower <= answer.t.upper, "{answer:?}");
                answer.hit.iter().for_each(|hit| met(tree, hit));
            }
            if let Some(answer) = answered(tree.any_hit(a, b, facing, Budget::EXACT, stack)) {
                ends(answer.work, most(tree, Kind::AnyHit));
            }
            if let Some(answer) = answered(tree.all_hits(a, b, facing, hits, Budget::EXACT, stack))
            {
                ends(answer.work, most(tree, Kind::AllHits));
                let hits = &hits[..answer.stored];
                hits.iter().for_each(|listed| met(tree, &listed.hit));
                assert!(hits.is_sorted_by(|x, y| x.hit.t <= y.hit.t), "{hits:?}");
            }
        }
    }

    /// Every question about a solid, at rest and moving.
    ///
    /// # Panics
    /// If an answer is out of range or took too long.
    pub fn solid(&mut self, tree: &Bvh<'_>, corners: [[f32; 3]; 2], radius: f32, stop: &Budget) {
        let stack = &mut self.stack[..];
        let bound = most(tree, Kind::Solid);
        let numbered = |triangle: u32| assert!(triangle < tree.input_triangles(), "{triangle}");
        let [a, b] = corners;
        let moved = [b, a];
        let solids = [Solid::new(&corners[..1], radius), Solid::new(&corners, radius)];
        for solid in solids.into_iter().flatten() {
            for stop in [stop, &Budget::EXACT] {
                if let Some(answer) = answered(tree.solid_distance(&solid, *stop, stack)) {
                    ends(answer.work, bound);
                    numbered(answer.triangle);
                    let (lower, upper) = (answer.distance.lower, answer.distance.upper);
                    assert!(0.0 <= lower && lower <= upper, "{answer:?}");
                    assert!(answer.points.iter().flatten().all(|x| x.is_finite()), "{answer:?}");
                }
                if let Some(answer) = answered(tree.solid_within(&solid, radius, *stop, stack)) {
                    ends(answer.work, bound);
                    answer.witness.into_iter().for_each(numbered);
                }
                let to = Solid::new(&moved[..solid.corners().len()], radius);
                let Ok(to) = to else { continue };
                if let Some(answer) = answered(tree.solid_first_contact(&solid, &to, *stop, stack))
                {
                    ends(answer.work, most(tree, Kind::Contact));
                    assert!(
                        answer.t.lower >= 0.0 && answer.t.lower <= answer.t.upper,
                        "{answer:?}"
                    );
                    answer.hit.iter().for_each(|hit| met(tree, hit));
                }
            }
        }
    }

    /// A coherent query of `N` entries along a path; its answers are those of the plain query
    /// unless that was cut short.
    ///
    /// # Panics
    /// If an answer is out of range or took too long.
    pub fn path<'t, const N: usize>(
        &mut self,
        query: &mut CoherentQuery<'t, N>,
        tree: &Bvh<'t>,
        path: impl IntoIterator<Item = [f32; 3]>,
        stop: &Budget,
    ) {
        for point in path {
            if let Some(answer) = answered(query.closest_point(tree, point, *stop, &mut self.stack))
            {
                closest(tree, &answer.closest, most(tree, Kind::CoherentQuery));
                assert!(answer.safe_radius >= 0.0, "{answer:?}");
            }
        }
    }
}

impl Asker {
    /// Whether and where two trees meet, and how far apart they are, in at most so many steps:
    /// every pair of nodes may have to be opened.
    ///
    /// # Panics
    /// If an answer is out of range or took too long.
    pub fn two_models(&self, a: &Bvh<'_>, b: &Bvh<'_>, pose: &Pose, steps: u32) {
        let mut stack = vec![ScratchEntry::EMPTY; self.stack.len()];
        let mut pairs = vec![TrianglePair::EMPTY; self.near.len()];
        let in_range = |[first, second]: [u32; 2]| {
            let is_one = first < a.input_triangles() && second < b.input_triangles();
            self.holds(is_one, &[first, second]);
        };
        if let Some(answer) =
            self.told(a.overlap(b, *pose, Budget::EXACT.with_steps(steps), &mut stack))
        {
            assert!(answer.work.opened <= steps, "{answer:?}");
            let named = answer.witness.is_some();
            self.holds(named || answer.verdict != Verdict::Yes, &answer);
            answer.witness.into_iter().for_each(in_range);
        }
        if let Some(answer) = self.told(a.all_overlaps(
            b,
            *pose,
            &mut pairs,
            Budget::EXACT.with_steps(steps),
            &mut stack,
        )) {
            assert!(answer.work.opened <= steps, "{answer:?}");
            self.holds(answer.dropped == 0 || answer.stored == pairs.len(), &answer);
            pairs[..answer.stored].iter().for_each(|pair| in_range(pair.triangles));
        }
        let budget = Budget::EXACT.with_steps(steps);
        let models = [(a, Pose::IDENTITY), (b, *pose)]
            .map(|(tree, pose)| self.told(PlacedModel::new(*tree, pose)));
        if let [Some(one), Some(other)] = models
            && let models = [one.with_least_ball(), other]
            && let scene = Scene::new(&models)
            && let Some(answer) = self.told(scene.nearest_pair(|_, _| true, budget, &mut stack))
        {
            assert!(answer.work.opened <= steps, "{answer:?}");
            self.holds(answer.models == Some([0, 1]), &answer);
            self.holds(answer.distance.lower <= answer.distance.upper, &answer);
            in_range(answer.triangles);
            self.told(scene.within(answer.distance.lower, |_, _| true, budget, &mut stack));
        }
        let mut pair = CoherentPair::<64>::new();
        for _ in 0..2 {
            if let Some(answer) = self.told(pair.distance(a, b, *pose, budget, &mut stack)) {
                assert!(answer.work.opened <= steps, "{answer:?}");
                self.holds(answer.distance.lower <= answer.distance.upper, &answer);
                in_range(answer.triangles);
                let half = 0.5 * answer.distance.lower;
                self.told(pair.within(a, b, *pose, half, budget, &mut stack));
            }
        }
        if let Some(answer) = self.told(a.penetration(b, *pose, budget, &mut stack)) {
            assert!(answer.work.opened <= steps, "{answer:?}");
            self.holds(answer.depth.lower <= answer.depth.upper, &answer);
        }
        if let Some(answer) = self.told(a.distance_to(b, *pose, budget, &mut stack)) {
            assert!(answer.work.opened <= steps, "{answer:?}");
            in_range(answer.triangles);
            self.holds(answer.distance.lower <= answer.distance.upper, &answer);
            self.holds(answer.points.iter().flatten().all(|x| x.is_finite()), &answer);
            let half = 0.5 * answer.distance.lower;
            let end = Pose { translation: answer.points[0], ..*pose };
            let motion = Motion::screw(*pose, end).unwrap_or(Motion::straight(*pose, end));
            let motion = a.first_contact_of(b, &motion, half, budget, &mut stack);
            if let Some(answer) = self.told(motion) {
                assert!(answer.work.opened <= steps, "{answer:?}");
                in_range(answer.triangles);
                self.holds(answer.clear_until >= 0.0, &answer);
            }
            if let Some(answer) = self.told(a.within_of(b, *pose, half, budget, &mut stack)) {
                assert!(answer.work.opened <= steps, "{answer:?}");
                // An edited box may not hold its triangles, so two searches may contradict each
                // other.
                answer.witness.into_iter().for_each(in_range);
            }
        }
    }

    /// Whether two trees are within a distance, by every question that has one, whatever others
    /// answer.
    ///
    /// # Panics
    /// If an answer took too long.
    pub fn two_models_within(&self, [a, b]: [&Bvh<'_>; 2], pose: &Pose, distance: f32, steps: u32) {
        let mut stack = vec![ScratchEntry::EMPTY; self.stack.len()];
        let budget = Budget::EXACT.with_steps(steps);
        let ends = |work: Option<Work>| {
            assert!(work.is_none_or(|work| work.opened <= steps), "{work:?}");
        };
        let within = a.within_of(b, *pose, distance, budget, &mut stack);
        ends(self.told(within).map(|answer| answer.work));
        let motion = Motion::straight(*pose, Pose::IDENTITY);
        let contact = a.first_contact_of(b, &motion, distance, budget, &mut stack);
        ends(self.told(contact).map(|answer| answer.work));
        // So few groups of pairs that some have no room.
        let mut pair = CoherentPair::<16>::new();
        for _ in 0..2 {
            self.told(pair.distance(a, b, *pose, budget, &mut stack));
            let within = pair.within(a, b, *pose, distance, budget, &mut stack);
            ends(self.told(within).map(|answer| answer.work));
        }
        let models = [(a, Pose::IDENTITY), (b, *pose)]
            .map(|(tree, pose)| self.told(PlacedModel::new(*tree, pose)));
        if let [Some(one), Some(other)] = models {
            let models = [one.with_least_ball(), other];
            self.told(Scene::new(&models).within(distance, |_, _| true, budget, &mut stack));
        }
    }

    /// What faces an eye.
    ///
    /// # Panics
    /// If an answer is out of range.
    pub fn sight(&self, tree: &Bvh<'_>, eye: [f32; 3]) {
        for sight in [Eye::At(eye), Eye::Along(eye)] {
            let mut triangles = vec![u32::MAX; self.near.len()];
            if let Some(seen) = answered(tree.front_facing(sight, &mut triangles)) {
                assert!(
                    triangles[..seen.stored].iter().all(|&t| t < tree.input_triangles()),
                    "{seen:?}"
                );
                let all = seen.stored as u32 + seen.dropped + seen.culled;
                assert_eq!(
                    (seen.leaves, all),
                    (tree.header().leaves, tree.header().triangles),
                    "{seen:?}"
                );
            }
        }
    }
}

/// More than a query can cost, whose row in the suite says how many descents it takes.
fn most(tree: &Bvh<'_>, kind: Kind) -> u32 {
    let descents = Question::of_tree_kind(kind).and_then(|question| question.descents);
    descents.expect("a row of one tree") * descent(tree)
}

/// More than one descent can cost: every node opened, every box tested, every triangle looked at.
fn descent(tree: &Bvh<'_>) -> u32 {
    let header = tree.header();
    9 * header.nodes + header.triangles + 16
}

/// The answer. A query is refused for what is wrong with it, never for what is wrong with an opened
/// tree.
fn answered<T>(result: Result<T, QueryError>) -> Option<T> {
    if let Err(error) = &result {
        assert_ne!(*error, QueryError::Unchecked);
    }
    result.ok()
}

fn ends(work: Work, most: u32) {
    assert!(work.total() <= most, "{work:?}, where {most} are enough");
}

fn closest(tree: &Bvh<'_>, answer: &ClosestPoint, most: u32) {
    ends(answer.work, most);
    assert!(
        answer.distance.lower >= 0.0 && answer.distance.lower <= answer.distance.upper,
        "{answer:?}"
    );
    assert!(answer.point.iter().all(|x| !x.is_nan()), "{answer:?}");
    assert!(answer.triangle.is_none_or(|triangle| triangle < tree.input_triangles()), "{answer:?}");
}

fn found(tree: &Bvh<'_>, near: &[Neighbor]) {
    for one in near {
        assert!(
            one.distance().lower >= 0.0 && one.distance().lower <= one.distance().upper,
            "{one:?}"
        );
        assert!(one.triangle() < tree.input_triangles(), "{one:?}");
    }
}

fn met(tree: &Bvh<'_>, hit: &Hit) {
    assert!((0.0..=1.0).contains(&hit.t), "{hit:?}");
    assert!(hit.triangle.is_none_or(|triangle| triangle < tree.input_triangles()), "{hit:?}");
}
