//! Checks the invariants of fans and leaves.

use std::fmt;

use super::{Fan, FanLeaf, MAX_LEAF_TRIANGLES};

/// The first violation that [`validate()`] found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FanFault {
    /// A leaf, or a fan of it, has no triangle or more than [`MAX_LEAF_TRIANGLES`].
    Size {
        /// The leaf's index.
        leaf: usize,
        /// Its triangles.
        found: usize,
    },
    /// A fan's ring does not have one vertex more than the fan has triangles.
    Ring {
        /// The leaf's index.
        leaf: usize,
    },
    /// A first fan is reversed.
    Reversed {
        /// The leaf's index.
        leaf: usize,
    },
    /// A second fan's ring does not start where the first's ends.
    Apart {
        /// The leaf's index.
        leaf: usize,
    },
    /// A fan names other vertices than the mesh, or the same in the other winding, or a triangle
    /// that is not there.
    Corners {
        /// The triangle's number.
        triangle: u32,
    },
    /// A triangle is in no fan or in several.
    Cover {
        /// The triangle's number.
        triangle: u32,
        /// How often it was found.
        found: u32,
    },
}

impl fmt::Display for FanFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Size { leaf, found } => {
                write!(f, "leaf {leaf} has {found} triangles, not 1 to {MAX_LEAF_TRIANGLES}")
            }
            Self::Ring { leaf } => {
                write!(f, "leaf {leaf} has a ring that does not fit its triangles")
            }
            Self::Reversed { leaf } => write!(f, "the first fan of leaf {leaf} is reversed"),
            Self::Apart { leaf } => {
                write!(f, "the fans of leaf {leaf} share no vertex at their rings' ends")
            }
            Self::Corners { triangle } => {
                write!(f, "triangle {triangle} has other corners in its fan than in the mesh")
            }
            Self::Cover { triangle, found } => {
                write!(f, "triangle {triangle} is in {found} fans, not 1")
            }
        }
    }
}

impl std::error::Error for FanFault {}

/// Checks the invariants of [`Fan`] and [`FanLeaf`], and that every triangle is in exactly one fan.
///
/// Cost: linear.
///
/// # Errors
/// The first violation.
pub fn validate(leaves: &[FanLeaf], triangles: &[[u32; 3]]) -> Result<(), FanFault> {
    let mut found = vec![0u32; triangles.len()];
    for (index, leaf) in leaves.iter().enumerate() {
        let size = leaf.triangle_count();
        if size > MAX_LEAF_TRIANGLES || leaf.fans().any(|fan| fan.triangles.is_empty()) {
            return Err(FanFault::Size { leaf: index, found: size });
        }
        if leaf.fans().any(|fan| fan.ring.len() != fan.triangles.len() + 1) {
            return Err(FanFault::Ring { leaf: index });
        }
        if leaf.first.reversed {
            return Err(FanFault::Reversed { leaf: index });
        }
        if leaf.second.as_ref().is_some_and(|second| second.ring.first() != leaf.first.ring.last())
        {
            return Err(FanFault::Apart { leaf: index });
        }
        for fan in leaf.fans() {
            for (i, &triangle) in fan.triangles.iter().enumerate() {
                if !triangles
                    .get(triangle as usize)
                    .is_some_and(|corners| same_triangle(corners, fan, i))
                {
                    return Err(FanFault::Corners { triangle });
                }
                found[triangle as usize] += 1;
            }
        }
    }
    match (0u32..).zip(found).find(|&(_, found)| found != 1) {
        Some((triangle, found)) => Err(FanFault::Cover { triangle, found }),
        None => Ok(()),
    }
}

/// True if triangle `i` of `fan` has these corners, in this winding, whichever comes first.
fn same_triangle(&[a, b, c]: &[u32; 3], fan: &Fan, i: usize) -> bool {
    let [from, to] =
        if fan.reversed { [fan.ring[i + 1], fan.ring[i]] } else { [fan.ring[i], fan.ring[i + 1]] };
    let in_fan = [fan.centre, from, to];
    [[a, b, c], [b, c, a], [c, a, b]].contains(&in_fan)
}
