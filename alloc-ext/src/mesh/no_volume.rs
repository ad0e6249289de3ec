//! Why a mesh bounds no volume, so that a hull of it has no void.

use super::{EdgePlace, MeshError};
use crate::counted::Counted;
use std::fmt;

/// Why a mesh bounds no volume: its first defect in the order of
/// [`require_closed_manifold`](super::require_closed_manifold), with one place of the defect.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoVolume {
    /// Edges have one triangle only.
    Open {
        /// Number of them.
        edges: usize,
        /// One of them.
        at: EdgePlace,
    },
    /// Edges have more than two triangles, for example where a wall divides the inside.
    NonManifold {
        /// Number of them.
        edges: usize,
        /// Most triangles at an edge.
        most: usize,
        /// One of them.
        at: EdgePlace,
    },
    /// Several fans meet in a vertex; [`repair`](super::repair) splits it.
    Pinched {
        /// Number of vertices.
        vertices: usize,
        /// One of them.
        at: [f32; 3],
    },
    /// Components have one side only, as a Klein bottle, which is closed, and a Möbius strip.
    OneSided {
        /// Number of them.
        components: usize,
        /// An edge where the sides change.
        at: EdgePlace,
    },
    /// Neighbours are wound against each other; [`repair`](super::repair) turns them.
    MixedWinding {
        /// Number of edges with such neighbours.
        edges: usize,
        /// One of them.
        at: EdgePlace,
    },
    /// Outermost components face inwards; [`repair`](super::repair) turns them.
    InsideOut {
        /// Number of them.
        components: usize,
        /// A corner of one.
        at: [f32; 3],
    },
    /// The volume of a closed component may be 0 within rounding.
    Flat {
        /// The component's first triangle, as the input counts.
        triangle: u32,
        /// A corner of the triangle.
        at: [f32; 3],
    },
    /// Components overlap, or one lies in another as a solid in a solid, or one crosses itself. The
    /// volume then counts places more than once.
    Overlapping,
    /// The volume may be rounding alone, because cavities leave next to none.
    Indistinct,
    /// No triangle has an area.
    NoArea,
    /// The arrays break the contract of [`Mesh`](super::Mesh).
    Invalid,
}

impl NoVolume {
    /// The first defect.
    pub(crate) fn of(error: &MeshError) -> Self {
        let named = match error {
            MeshError::Open { edge_count: edges, places, .. } => {
                places.first().map(|&at| NoVolume::Open { edges: *edges, at })
            }
            MeshError::NonManifoldEdges { count: edges, most, places } => {
                places.first().map(|&at| NoVolume::NonManifold { edges: *edges, most: *most, at })
            }
            MeshError::NonManifoldVertices { count: vertices, places } => {
                places.first().map(|&at| NoVolume::Pinched { vertices: *vertices, at })
            }
            MeshError::NonOrientable { component_count: components, places } => {
                places.first().map(|&at| NoVolume::OneSided { components: *components, at })
            }
            MeshError::InconsistentWinding { edge_count: edges, places } => {
                places.first().map(|&at| NoVolume::MixedWinding { edges: *edges, at })
            }
            MeshError::InsideOut { component_count: components, places } => {
                places.first().map(|&at| NoVolume::InsideOut { components: *components, at })
            }
            MeshError::ZeroVolume { triangle, at, .. } => {
                Some(NoVolume::Flat { triangle: *triangle, at: *at })
            }
            MeshError::NoArea { .. } => Some(NoVolume::NoArea),
            _ => None,
        };
        named.unwrap_or(NoVolume::Invalid)
    }
}

impl fmt::Display for NoVolume {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            NoVolume::Open { edges, at } => {
                write!(
                    f,
                    "the mesh is not closed: {}, {}",
                    Counted(edges, "boundary edge"),
                    Edge(at)
                )
            }
            NoVolume::NoArea => f.write_str("no triangle of the mesh has an area"),
            NoVolume::NonManifold { edges, most, at } => write!(
                f,
                "the mesh is not manifold: {} with up to {most} triangles, {}",
                Counted(edges, "edge"),
                Edge(at)
            ),
            NoVolume::Pinched { vertices, at } => {
                write!(
                    f,
                    "the mesh is not manifold: several fans meet in {}, {}",
                    Counted(vertices, "vertex"),
                    Point(at)
                )
            }
            NoVolume::OneSided { components, at } => {
                write!(
                    f,
                    "the mesh has no outside: {}, {}",
                    Counted(components, "one-sided component"),
                    Edge(at)
                )
            }
            NoVolume::MixedWinding { edges, at } => write!(
                f,
                "the mesh has no outside: triangles are wound against each other at {}, {}",
                Counted(edges, "edge"),
                Edge(at)
            ),
            NoVolume::InsideOut { components, at } => {
                write!(
                    f,
                    "the mesh is inside out: {}, {}",
                    Counted(components, "outermost component"),
                    Point(at)
                )
            }
            NoVolume::Flat { triangle, at } => {
                write!(
                    f,
                    "a component of the mesh, that of triangle {triangle}, has a volume that \
                     cannot be told from 0, {}",
                    Point(at)
                )
            }
            NoVolume::Overlapping => f.write_str(
                "the mesh overlaps itself, so that its volume counts places more than once",
            ),
            NoVolume::Indistinct => f.write_str("the mesh's volume cannot be told from 0"),
            NoVolume::Invalid => f.write_str("the mesh is not a valid one"),
        }
    }
}

/// The place of a defect at an edge.
struct Edge(EdgePlace);

impl fmt::Display for Edge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let EdgePlace { triangle, from, to } = self.0;
        write!(f, "as at triangle {triangle} from {from:?} to {to:?}")
    }
}

/// The place of a defect at a point.
struct Point([f32; 3]);

impl fmt::Display for Point {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "as at {:?}", self.0)
    }
}
