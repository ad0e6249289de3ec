//! The refinement of two models where they meet, depth first.
//!
//! A pair of triangles stands for the parts of both surfaces that the triangles, swept by their
//! radii, contain. A pair that is certainly apart is dropped. Of any other pair the larger triangle
//! is replaced by its children. So each model is refined only where the other is near. Pairs of
//! triangles of both surfaces are told exactly.

use super::model::Model;
use super::places::{Places, is_f32_enough};
use crate::geom::{Contact, Pose, Precision, SweptTriangle};
use crate::hull::format::Instance;
use crate::hull::front::{Candidate, Refinable, Visit};
use crate::hull::geometry::Geometry;
use crate::query::{
    Budget, Ended, PairVisitor, QueryError, RelativePose, ScratchEntry, SweepQueue, Work,
};

/// Two triangles, the first model's first.
pub(super) type Pair = [Instance; 2];

/// Visits every pair of triangles that meet or may meet. Returns why it missed some.
pub(super) fn descend<'a, 'b>(
    sides: (&mut Model<impl Geometry<'a>>, &mut Model<impl Geometry<'b>>),
    pose: &Pose,
    budget: &Budget,
    scratch: &mut [ScratchEntry],
    visitor: &mut impl PairVisitor<Pair>,
) -> Result<(Option<Ended>, Work), QueryError> {
    budget.check_with(scratch)?;
    let (side_a, side_b) = sides;
    let [a, b] = [&side_a.extended, &side_b.extended];
    let Some(pose) = RelativePose::new(a, b, pose)? else { return Ok((None, Work::NONE)) };
    let is_f32 = is_f32_enough(&pose, [a, b]);
    let exact = Places::<f64>::of(&pose);
    // No pair is opened twice. With this limit a search ends even if checked tables name a triangle
    // twice.
    let pairs = side_a.triangles().saturating_mul(side_b.triangles());
    let steps = budget.steps.min(pairs);
    let stack = Stack { slots: scratch, used: 0, is_short: false };
    let found = if is_f32 {
        run((side_a, side_b), &Places::<f32>::of(&pose), &exact, stack, steps, visitor)
    } else {
        run((side_a, side_b), &exact, &exact, stack, steps, visitor)
    };
    found.ok_or(QueryError::Unchecked)
}

fn run<'a, 'b, T: Precision>(
    (side_a, side_b): (&mut Model<impl Geometry<'a>>, &mut Model<impl Geometry<'b>>),
    places: &Places<T>,
    exact: &Places<f64>,
    stack: Stack<'_>,
    steps: u32,
    visitor: &mut impl PairVisitor<Pair>,
) -> Option<(Option<Ended>, Work)> {
    let is_cut = side_a.is_cut() || side_b.is_cut();
    let mut pair = [side_a.root, side_b.root];
    let fixed = places.swept(0, &pair[0]);
    let work = Work::NONE;
    let mut search = Descent {
        places,
        exact,
        stack,
        visitor,
        work,
        is_cut,
        found: Some(true),
        opened: 0,
        pair,
        fixed,
    };
    loop {
        if search.work.opened >= steps {
            return Some((Some(Ended::Steps), search.work));
        }
        let swept = [places.swept(0, &pair[0]), places.swept(1, &pair[1])];
        let [opens_a, opens_b] = pair.map(|triangle| triangle.refinable == Refinable::BySplit);
        // A root is refined at once: its number is too large for a waiting pair.
        let first = opens_a
            && (!opens_b
                || pair[0].instance == side_a.root.instance
                || swept[0].size() >= swept[1].size());
        search.opened = usize::from(!first);
        search.pair = pair;
        let left = steps.saturating_sub(search.work.opened);
        let replaced = if first {
            search.fixed = swept[1];
            side_a.open(pair[0].instance, left, &mut search)?
        } else {
            search.fixed = swept[0];
            side_b.open(pair[1].instance, left, &mut search)?
        };
        search.work.opened = search.work.opened.saturating_add(replaced);
        // The visitor has its answer. On a cut blob that answer is `Resolution`.
        if !search.found? {
            let cut = if is_cut { Some(Ended::Resolution) } else { None };
            return Some((cut, search.work));
        }
        let Some([a, b]) = search.stack.pop() else {
            let short = if search.stack.is_short { Some(Ended::Scratch) } else { None };
            return Some((short, search.work));
        };
        pair = [side_a.look(a)?, side_b.look(b)?];
    }
}

/// The pairs that wait.
struct Stack<'s> {
    slots: &'s mut [ScratchEntry],
    used: usize,
    /// Some pairs did not fit.
    is_short: bool,
}

impl Stack<'_> {
    fn push(&mut self, [a, b]: Pair) {
        match self.slots.get_mut(self.used) {
            Some(slot) if a.0 < ScratchEntry::SMALL_WORDS => {
                *slot = ScratchEntry::of_words([a.0, b.0]);
                self.used += 1;
            }
            _ => self.is_short = true,
        }
    }

    fn pop(&mut self) -> Option<Pair> {
        self.used = self.used.checked_sub(1)?;
        self.slots.get(self.used).map(|entry| entry.words().map(Instance))
    }
}

/// What is done with the children of a triangle.
struct Descent<'s, T, V> {
    places: &'s Places<T>,
    exact: &'s Places<f64>,
    stack: Stack<'s>,
    visitor: &'s mut V,
    work: Work,
    is_cut: bool,
    /// Whether to go on. `None`: a model is unchecked.
    found: Option<bool>,
    /// Which of the models is opened.
    opened: usize,
    /// The opened triangle, and the other model's.
    pair: [Candidate; 2],
    /// The other model's, in common units.
    fixed: SweptTriangle<T>,
}

impl<T: Precision, V: PairVisitor<Pair>> Visit for Descent<'_, T, V> {
    #[cfg_attr(meshsweep_wide, inline(always))]
    #[cfg_attr(not(meshsweep_wide), inline(never))]
    fn visit(&mut self, found: &[Candidate], _: &mut SweepQueue<'_>) {
        self.work.bounds = self.work.bounds.saturating_add(found.len() as u32);
        let mut near = 0u32;
        for (i, child) in found.iter().enumerate() {
            let swept = self.places.swept(self.opened, child);
            near |= u32::from(!self.places.is_apart(&swept, &self.fixed)) << i;
        }
        if near == 0 {
            return;
        }
        // Triangles that cannot be opened come last, so that they are taken first: the memory for
        // those that can be opened is what the builder counted.
        for splits in [true, false] {
            for (i, child) in found.iter().enumerate() {
                if near >> i & 1 != 0 && (child.refinable == Refinable::BySplit) == splits {
                    self.take(child);
                }
            }
        }
    }
}

impl<T: Precision, V: PairVisitor<Pair>> Descent<'_, T, V> {
    /// A pair that is not certainly apart.
    fn take(&mut self, child: &Candidate) {
        if self.found != Some(true) {
            return;
        }
        let [a, b] = &self.pair;
        let pair = if self.opened == 0 { [child, b] } else { [a, child] };
        let instances = pair.map(|triangle| triangle.instance);
        if pair.iter().any(|triangle| triangle.refinable == Refinable::BySplit) {
            self.stack.push(instances);
            return;
        }
        if self.is_cut {
            // No pair of a cut blob is certain, and none has numbers.
            self.found = Some(false);
            return;
        }
        self.work.triangles = self.work.triangles.saturating_add(1);
        let mut contact = self.places.meet(pair);
        if contact == Contact::Undecided {
            self.work.exact = self.work.exact.saturating_add(1);
            contact = self.exact.meet(pair);
        }
        if contact != Contact::Apart {
            self.found = self.visitor.pair(instances, contact);
        }
    }
}
