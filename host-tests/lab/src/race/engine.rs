//! The interface of an engine, and the engines that take part.

use std::hint::black_box;

use meshsweep_host_tests::workload::Subject;

use super::workload::{HitKind, Workload};
use super::{cwbvh, embree, fcpw, parry, tree};

/// An index over one mesh that answers lists of queries. A list is one call, so that the call's
/// cost is no part of a query's, a coherent query may carry over what it knows, and a batch may be
/// sorted.
pub trait Engine {
    /// Bytes that it keeps to answer, the triangles included.
    fn bytes(&self) -> usize;

    /// Seconds of its build, for an engine in another process.
    fn own_build_seconds(&self) -> Option<f64> {
        None
    }

    /// Seconds of the last list, for an engine in another process.
    fn own_seconds(&self) -> Option<f64> {
        None
    }

    /// Whether it takes part in a workload.
    fn answers(&self, workload: Workload) -> bool;

    /// Replaces `answers` by those to `points`, in their order: [`Answer::Point`].
    ///
    /// # Errors
    /// The engine's refusal.
    fn closest(&mut self, points: &[[f32; 3]], answers: &mut Vec<Answer>) -> Result<(), String>;

    /// Replaces `answers` by those to `segments`, in their order: [`Answer::Hit`] of first hits,
    /// [`Answer::Meets`] or [`Answer::Undecided`] of any, [`Answer::Miss`] of both.
    ///
    /// # Errors
    /// The engine's refusal.
    fn hits(
        &mut self,
        segments: &[[[f32; 3]; 2]],
        kind: HitKind,
        answers: &mut Vec<Answer>,
    ) -> Result<(), String>;
}

/// What an engine says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Answer {
    /// The closest point of the surface.
    Point([f32; 3]),
    /// The parameter of the first hit, 0 at the segment's start, 1 at its end.
    Hit(f32),
    /// There is a hit.
    Meets,
    /// No hit.
    Miss,
    /// Neither is proved.
    Undecided,
}

/// A mesh's engine. The blob is for one that reads its index from bytes, which have to outlive it.
type Build = for<'a> fn(&Subject, &'a mut Vec<u8>) -> Result<Box<dyn Engine + 'a>, String>;

/// An engine that takes part.
pub struct Entrant {
    /// The engine's name in tables.
    pub name: &'static str,
    /// What else there is to know of it, for the table of engines.
    pub remark: &'static str,
    /// Why it cannot take part on this machine, if it cannot.
    pub missing: fn() -> Option<String>,
    /// Builds its index.
    pub build: Build,
}

/// The one whom all others are compared with.
pub const REFERENCE: &str = "parry3d";

/// All engines, in the order of the tables.
pub const ENTRANTS: [Entrant; 9] = [
    Entrant {
        name: REFERENCE,
        remark: "TriMesh: project_local_point, cast_local_ray, intersects_local_ray",
        missing: || None,
        build: parry::build,
    },
    Entrant {
        name: "obvhs",
        remark: "CWBVH, very slow build, own triangle test: ray_traverse, ray_traverse_miss",
        missing: || None,
        build: cwbvh::build,
    },
    Entrant {
        name: "embree",
        remark: "Debian's, C++, SIMD, robust: rtcPointQuery, rtcIntersect1, rtcOccluded1",
        missing: embree::missing,
        build: embree::build,
    },
    Entrant {
        name: "fcpw",
        remark: "C++, SIMD of 8 lanes: findClosestPoint; bytes unknown",
        missing: fcpw::missing,
        build: fcpw::build,
    },
    Entrant {
        name: "tree",
        remark: "closest_point, first_hit, any_hit on the box tree, 16-bit grid, AVX2 if there",
        missing: || None,
        build: tree::build,
    },
    Entrant {
        name: "tree compiled",
        remark: "the same without FastBvh: by the instructions that the program is compiled for",
        missing: || None,
        build: tree::build_compiled,
    },
    Entrant {
        name: "coherent",
        remark: "CoherentQuery of 128 entries on the same tree, along paths",
        missing: || None,
        build: tree::build_coherent,
    },
    Entrant {
        name: "batch",
        remark: "closest_points on the same tree, Morton order included",
        missing: || None,
        build: tree::build_batch,
    },
    Entrant {
        name: "tree single",
        remark: "the same with vertices in f32",
        missing: || None,
        build: tree::build_single,
    },
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
