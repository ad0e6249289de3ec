//! Why a mesh bounds no volume that the void of a hull could be measured against.

use crate::counted::Counted;
use crate::mesh::{EdgePlace, MeshError};
use std::fmt;

/// Why a mesh has no volume that the void of a hull can be measured against: the first of its
/// defects in the order of [`require_closed_manifold`], with one place where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoVolume {
    /// Edges have one triangle only.
    Open {
        /// How many.
        edges: usize,
        /// One of them.
        at: EdgePlace,
    },
    /// Edges have more than two triangles, as where a wall divides the inside.
    NonManifold {
        /// How many.
        edges: usize,
        /// Most triangles at an edge.
        most: usize,
        /// One of them.
        at: EdgePlace,
    },
    /// Several fans meet in a vertex; [`repair`](crate::mesh::repair) splits it.
    Pinched {
        /// How many vertices.
        vertices: usize,
        /// One of them.
        at: [f32; 3],
    },
    /// Parts have one side only, as a Klein bottle, which is closed, and a Möbius strip.
    OneSided {
        /// How many.
        parts: usize,
        /// Where sides change.
        at: EdgePlace,
    },
    /// Neighbours are wound against each other; [`repair`](crate::mesh::repair) turns them.
    MixedWinding {
        /// How many edges have such neighbours.
        edges: usize,
        /// One of them.
        at: EdgePlace,
    },
    /// Outermost parts face inwards; [`repair`](crate::mesh::repair) turns them.
    InsideOut {
        /// How many.
        parts: usize,
        /// A corner of one.
        at: [f32; 3],
    },
    /// A closed part whose volume cannot be told from 0.
    Flat {
        /// Its first triangle, as the input counts.
        triangle: u32,
        /// A corner of that.
        at: [f32; 3],
    },
    /// Parts overlap or lie in each other as solid in solid, or one crosses itself: then a volume
    /// counts what is there more than once.
    Overlapping,
    /// Rounding may be all that there is: cavities leave next to nothing.
    Indistinct,
    /// An array breaks what [`Mesh`] promises.
    Invalid,
}

impl NoVolume {
    /// What was found first.
    pub(super) fn of(error: &MeshError) -> Self {
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
            MeshError::NonOrientable { part_count: parts, places } => {
                places.first().map(|&at| NoVolume::OneSided { parts: *parts, at })
            }
            MeshError::InconsistentWinding { edge_count: edges, places } => {
                places.first().map(|&at| NoVolume::MixedWinding { edges: *edges, at })
            }
            MeshError::InsideOut { part_count: parts, places } => {
                places.first().map(|&at| NoVolume::InsideOut { parts: *parts, at })
            }
            MeshError::ZeroVolume { triangle, at, .. } => {
                Some(NoVolume::Flat { triangle: *triangle, at: *at })
            }
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
            NoVolume::OneSided { parts, at } => {
                write!(
                    f,
                    "the mesh has no outside: {}, {}",
                    Counted(parts, "one-sided part"),
                    Edge(at)
                )
            }
            NoVolume::MixedWinding { edges, at } => write!(
                f,
                "the mesh has no outside: triangles are wound against each other at {}, {}",
                Counted(edges, "edge"),
                Edge(at)
            ),
            NoVolume::InsideOut { parts, at } => {
                write!(
                    f,
                    "the mesh is inside out: {}, {}",
                    Counted(parts, "outermost part"),
                    Point(at)
                )
            }
            NoVolume::Flat { triangle, at } => {
                write!(
                    f,
                    "a part of the mesh, that of triangle {triangle}, has a volume that cannot be told from 0, {}",
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

/// One of several edges, or the only one.
struct Edge(EdgePlace);

impl fmt::Display for Edge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let EdgePlace { triangle, from, to } = self.0;
        write!(f, "as at triangle {triangle} from {from:?} to {to:?}")
    }
}

/// One of several places, or the only one.
struct Point([f32; 3]);

impl fmt::Display for Point {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "as at {:?}", self.0)
    }
}
