//! The questions, and how many of them.

use meshsweep_host_tests::workload::Subject;
use meshsweep_host_tests::workload::{Points, field, orbit, points, segments, surface_path};

use crate::measure::rival::Rival;

/// A kind of list of queries.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Workload {
    /// Closest points of random points in a box twice the mesh's.
    Far,
    /// Closest points of random points near the surface: a Gaussian of 1 % of the diagonal on each
    /// axis.
    Near,
    /// Closest points along [`surface_path`].
    Path,
    /// Closest points along [`orbit`].
    Orbit,
    /// Closest points of a grid's nodes, row by row.
    Field,
    /// First hits of segments across a box twice the mesh's.
    Segments,
    /// Whether each of the same segments meets the mesh.
    AnyHit,
}

impl Workload {
    /// All, in the order of the tables.
    pub const ALL: [Self; 7] =
        [Self::Far, Self::Near, Self::Path, Self::Orbit, Self::Field, Self::Segments, Self::AnyHit];

    /// Its name in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Far => "far",
            Self::Near => "near",
            Self::Path => "path",
            Self::Orbit => "orbit",
            Self::Field => "field",
            Self::Segments => "segments",
            Self::AnyHit => "any hit",
        }
    }

    /// Its queries on a mesh. `guide` keeps the path at the surface.
    #[must_use]
    pub(super) fn queries(self, subject: &Subject, guide: &Rival, scale: Scale) -> Queries {
        match self {
            Self::Far => Queries::Points(points(subject, Points::Far, scale.random)),
            Self::Near => Queries::Points(points(subject, Points::Near, scale.random)),
            Self::Path => {
                Queries::Points(surface_path(subject, scale.coherent, |p| guide.closest(p)))
            }
            Self::Orbit => Queries::Points(orbit(subject, scale.coherent)),
            Self::Field => Queries::Points(field(subject, scale.side)),
            Self::Segments => Queries::Segments(segments(subject, scale.random), HitKind::First),
            Self::AnyHit => Queries::Segments(segments(subject, scale.random), HitKind::Any),
        }
    }
}

/// How many queries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Scale {
    /// Of each random workload.
    pub random: usize,
    /// Of each coherent one.
    pub coherent: usize,
    /// Nodes of the field along each axis.
    pub side: usize,
    /// At least so many of each workload are compared with every triangle in f64.
    pub checked: usize,
}

impl Scale {
    /// For numbers to quote.
    pub const FULL: Self = Self { random: 20_000, coherent: 40_000, side: 64, checked: 200 };
    /// For a look.
    pub const QUICK: Self = Self { random: 4_000, coherent: 8_000, side: 24, checked: 60 };
}

/// Which hit of a segment is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HitKind {
    /// The parameter of the first.
    First,
    /// Whether there is one.
    Any,
}

/// A list of queries of one kind.
#[derive(Clone, Debug)]
pub(super) enum Queries {
    Points(Vec<[f32; 3]>),
    Segments(Vec<[[f32; 3]; 2]>, HitKind),
}

impl Queries {
    pub fn len(&self) -> usize {
        match self {
            Self::Points(points) => points.len(),
            Self::Segments(segments, _) => segments.len(),
        }
    }

    /// Every `stride`-th.
    pub fn thinned(&self, stride: usize) -> Self {
        match self {
            Self::Points(points) => Self::Points(points.iter().copied().step_by(stride).collect()),
            Self::Segments(segments, kind) => {
                Self::Segments(segments.iter().copied().step_by(stride).collect(), *kind)
            }
        }
    }
}
