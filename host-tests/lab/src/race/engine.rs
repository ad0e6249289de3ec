//! The interface of an engine, and the engines that take part.

use std::hint::black_box;

use meshsweep_host_tests::workload::Subject;

use super::{Scope, Workload, cwbvh, hull, parry, scalar, tree};

/// An index over one mesh that answers lists of queries. A list is one call, so that the call's
/// cost is no part of a query's, a session may carry over what it knows, and a batch may be sorted.
pub trait Engine {
    /// Bytes that it keeps to answer, the triangles included.
    fn bytes(&self) -> usize;

    /// How many queries of a workload it can be asked in reasonable time; 0 if it does not answer
    /// the question at all.
    fn limit(&self, workload: Workload) -> usize;

    /// Replaces `answers` by those to `points`, in their order: [`Answer::Point`] or
    /// [`Answer::Distance`].
    ///
    /// # Errors
    /// The engine's refusal.
    fn closest(&mut self, points: &[[f32; 3]], answers: &mut Vec<Answer>) -> Result<(), String>;

    /// Replaces `answers` by those to `segments`, in their order: [`Answer::Hit`] or
    /// [`Answer::Miss`].
    ///
    /// # Errors
    /// The engine's refusal.
    fn first_hits(
        &mut self,
        segments: &[[[f32; 3]; 2]],
        answers: &mut Vec<Answer>,
    ) -> Result<(), String>;
}

/// What an engine says; each says it in the way that costs it least.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Answer {
    /// The closest point of the surface.
    Point([f32; 3]),
    /// The distance.
    Distance(f32),
    /// The parameter of the first hit, 0 at the segment's start, 1 at its end.
    Hit(f32),
    /// No hit.
    Miss,
}

/// A mesh's engine, or none if it does not take part. The blob is for one that reads its index from
/// bytes, which have to outlive it.
type Build =
    for<'a> fn(&Subject, &Scope, &'a mut Vec<u8>) -> Result<Option<Box<dyn Engine + 'a>>, String>;

/// An engine that takes part.
pub struct Entrant {
    /// The engine's name in tables.
    pub name: &'static str,
    /// What else there is to know of it, for the table of engines.
    pub remark: &'static str,
    /// Whether its instructions are counted.
    pub counted: bool,
    /// Builds its index.
    pub build: Build,
}

/// The one whom all others are compared with.
pub const REFERENCE: &str = "parry3d";

/// All engines, in the order of the tables.
pub const ENTRANTS: [Entrant; 8] = [
    Entrant {
        name: REFERENCE,
        remark: "TriMesh: project_local_point, cast_local_ray",
        counted: true,
        build: parry::build,
    },
    Entrant {
        name: "obvhs",
        remark: "CWBVH, very slow build, own triangle test; no closest points",
        counted: true,
        build: cwbvh::build,
    },
    Entrant {
        name: "tree",
        remark: "closest_point, first_hit on the box tree, 16-bit grid",
        counted: true,
        build: tree::build,
    },
    Entrant {
        name: "session",
        remark: "CoherentQuery of 128 entries on the same tree, along paths",
        counted: true,
        build: tree::build_session,
    },
    Entrant {
        name: "batch",
        remark: "closest_points on the same tree, Morton order included",
        counted: true,
        build: tree::build_batch,
    },
    Entrant {
        name: "tree single",
        remark: "the same with vertices in f32",
        counted: true,
        build: tree::build_single,
    },
    Entrant {
        name: "hull",
        remark: "closest_point, first_hit by a sweep, f64 at the end",
        counted: true,
        build: hull::build,
    },
    Entrant { name: "scalar", remark: "every triangle, f32", counted: false, build: scalar::build },
];

/// Asks one query after the other. Each answer passes through a [`black_box`], so that none is
/// computed in part or left out.
pub fn each<Q: Copy>(queries: &[Q], answers: &mut Vec<Answer>, mut ask: impl FnMut(Q) -> Answer) {
    answers.clear();
    answers.extend(queries.iter().map(|&query| black_box(ask(query))));
}

/// As [`each`], up to the first refusal.
///
/// # Errors
/// That refusal.
pub fn try_each<Q: Copy>(
    queries: &[Q],
    answers: &mut Vec<Answer>,
    mut ask: impl FnMut(Q) -> Result<Answer, String>,
) -> Result<(), String> {
    answers.clear();
    for &query in queries {
        answers.push(black_box(ask(query)?));
    }
    Ok(())
}
