//! Every question refuses in the same way: a tolerance that no interval can meet, scratch memory
//! without entries, and a tree without the boxes that the question needs. The questions are the
//! suite's rows.

use meshsweep::bvh::{TreeOptions, build};
use meshsweep::mesh::Mesh;
use meshsweep::progress::Watch;
use meshsweep_core::{Budget, BuildFor, Bvh, QueryError, ScratchEntry, Work};
use meshsweep_host_tests::generate::cube;
use meshsweep_suite::ask::{apart, tree};
use meshsweep_suite::fold::Fold;
use meshsweep_suite::place::{Bounds, Place, Placer};
use meshsweep_suite::questions::Question;
use meshsweep_suite::{Kind, Observer, Subject};

fn blob(options: &TreeOptions) -> Vec<u8> {
    let mesh = Mesh::new(cube(1).0, cube(1).1);
    build(mesh.as_input(), options, Watch::NONE).expect("builds").0.to_bytes()
}

/// A tree that serves every question.
fn all() -> TreeOptions {
    TreeOptions::default().with_cull(true).with_winding(true)
}

/// Queries are placed in the model, around it, and so far away that its box answers.
const AROUND: [Bounds; 3] = [[[-0.1; 3], [0.1; 3]], [[-2.0; 3], [2.0; 3]], [[-1e20; 3], [1e20; 3]]];

/// Where a question is asked. A solid, a segment or a second model is not so far away.
fn places_of(question: &Question) -> &'static [Bounds] {
    if question.needs == "closest" { &AROUND } else { &AROUND[..2] }
}

/// Enough scratch for any question.
const ENTRIES: usize = Bvh::OVERLAP_ENTRIES;

/// Changes the terms of one call of a query.
struct OnTerms<F> {
    change: F,
    entries: usize,
    /// The number of the call.
    call: usize,
    /// Calls so far that have terms.
    begun: usize,
    answers: Vec<Result<(), QueryError>>,
}

impl<F: Fn(Budget) -> Budget> Observer for OnTerms<F> {
    fn terms<'s>(
        &mut self,
        budget: Budget,
        scratch: &'s mut [ScratchEntry],
    ) -> (Budget, &'s mut [ScratchEntry]) {
        self.begun += 1;
        if self.begun != self.call + 1 {
            return (budget, scratch);
        }
        let entries = self.entries.min(scratch.len());
        ((self.change)(budget), &mut scratch[..entries])
    }

    fn answered(&mut self, answer: Result<Work, QueryError>) {
        self.answers.push(answer.map(drop));
    }
}

/// Asks one query.
fn ask(tree: &Bvh<'_>, kind: Kind, around: Bounds, observer: &mut impl Observer) {
    let (place, fold) = (&mut Placer::new(kind.seed(), around), &mut Fold::new());
    if <Bvh<'_> as Subject<'_>>::suits(kind) {
        tree.ask(kind, place, &mut tree::Scratch::new(), observer, fold);
    } else {
        apart::Apart(*tree).ask(kind, place, &mut apart::Scratch::new(), observer, fold);
    }
}

/// What each call of a query answers with these terms, when the calls before it are asked as ever.
/// A call that has no terms is left out.
fn answers(
    (tree, kind, around): (&Bvh<'_>, Kind, Bounds),
    change: impl Fn(Budget) -> Budget + Copy,
    entries: usize,
) -> Vec<Result<(), QueryError>> {
    let mut all = Vec::new();
    loop {
        let mut observer =
            OnTerms { change, entries, call: all.len(), begun: 0, answers: Vec::new() };
        ask(tree, kind, around, &mut observer);
        if observer.begun <= observer.call {
            return all;
        }
        all.push(observer.answers[observer.call]);
    }
}

/// Every call of every question gives the same with these terms.
fn every_call_gives(
    expected: Result<(), QueryError>,
    change: impl Fn(Budget) -> Budget + Copy,
    entries: usize,
) {
    let bytes = blob(&all());
    let tree = Bvh::open(&bytes).expect("opens");
    for (question, kind) in questions() {
        for &around in places_of(question) {
            let found = answers((&tree, kind, around), change, entries);
            // Only culling takes no scratch.
            assert_eq!(found.is_empty(), kind == Kind::Cull, "{kind:?}");
            for answer in found {
                assert_eq!(answer, expected, "{} {kind:?} {around:?}", question.name);
            }
        }
    }
    for around in AROUND {
        let mut scratch = vec![ScratchEntry::EMPTY; entries];
        let (point, budget) = (Placer::new(1, around).far(), change(Budget::EXACT));
        let none = tree.nearest(point, &mut [], budget, &mut scratch);
        assert_eq!(none.map(drop), expected, "nearest of none {point:?}");
        let by_winding = tree.signed_distance_by_winding(point, budget, &mut scratch);
        assert_eq!(by_winding.map(drop), expected, "side by the winding number {point:?}");
    }
}

/// Kinds of queries to a box tree, each with its row.
fn questions() -> impl Iterator<Item = (&'static Question, Kind)> {
    Kind::ALL.into_iter().filter_map(|kind| Some((Question::of_tree_kind(kind)?, kind)))
}

#[test]
fn every_kind_of_query_to_a_box_tree_has_a_row() {
    for kind in Kind::ALL {
        let is_asked = <Bvh<'_> as Subject<'_>>::suits(kind) || apart::Apart::suits(kind);
        let is_question = !matches!(kind, Kind::Arith | Kind::Contents);
        assert_eq!(Question::of_tree_kind(kind).is_some(), is_asked && is_question, "{kind:?}");
    }
}

#[test]
fn every_question_refuses_a_tolerance_that_no_interval_meets() {
    let refused = Err(QueryError::Tolerance);
    for bad in [-1.0, -f32::MIN_POSITIVE, f32::NAN, -f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        every_call_gives(refused, |budget| budget.with_relative(bad), ENTRIES);
        every_call_gives(refused, |budget| budget.with_absolute(bad), ENTRIES);
    }
    for good in [0.0, -0.0, f32::MIN_POSITIVE, 0.5, f32::MAX] {
        let change = |budget: Budget| budget.with_relative(good).with_absolute(good);
        every_call_gives(Ok(()), change, ENTRIES);
    }
}

#[test]
fn every_question_refuses_scratch_memory_without_entries() {
    every_call_gives(Err(QueryError::NoScratch), |budget| budget, 0);
}

#[test]
fn every_question_names_the_boxes_that_its_tree_lacks() {
    let build_for = |needs| match needs {
        "closest" => BuildFor::Closest,
        "segment" => BuildFor::Segment,
        "winding" => BuildFor::Winding,
        "cull" => BuildFor::Cull,
        _ => panic!("no box tree is built for {needs}"),
    };
    let few = TreeOptions::default();
    for (options, lacks) in [
        (few.with_closest(false), &["closest", "winding", "cull"][..]),
        (few.with_segments(false), &["segment", "winding", "cull"]),
        (few, &["winding", "cull"]),
        (all(), &[]),
    ] {
        let bytes = blob(&options);
        let tree = Bvh::open(&bytes).expect("opens");
        for (question, kind) in questions() {
            // A depth needs distances too, and names them first.
            let is_depth = kind == Kind::Penetration && lacks.contains(&"closest");
            let needs = if is_depth { "closest" } else { question.needs };
            let refusal = QueryError::NotServed { build_for: build_for(needs) };
            let expected = if lacks.contains(&needs) { Err(refusal) } else { Ok(()) };
            for &around in places_of(question) {
                let change = |budget| budget;
                let mut to =
                    OnTerms { change, entries: ENTRIES, call: 0, begun: 0, answers: Vec::new() };
                ask(&tree, kind, around, &mut to);
                assert_eq!(to.answers[0], expected, "{} {kind:?} {lacks:?}", question.name);
            }
        }
        let none = tree.nearest([0.1; 3], &mut [], Budget::EXACT, &mut [ScratchEntry::EMPTY; 64]);
        assert_eq!(none.is_err(), lacks.contains(&"closest"), "nearest of none {none:?}");
    }
}
