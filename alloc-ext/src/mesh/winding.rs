//! Consistent winding by propagation across edges with two triangles.

use super::edges::{BOUNDARY, NON_MANIFOLD, ends};

/// Components of a mesh that are connected across manifold edges, and the consistent winding of
/// each.
pub(super) struct Components {
    /// Per triangle its component. Components are numbered in file order.
    pub part: Vec<u32>,
    /// Per triangle whether it must be rewound to agree with the majority of its component.
    pub rewind: Vec<bool>,
    /// Per component its kind.
    pub kinds: Vec<ComponentKind>,
}

/// Kind of surface of a component.
#[derive(Clone, Copy, Debug)]
pub(super) struct ComponentKind {
    /// Each of its edges has exactly two triangles.
    pub closed: bool,
    /// A half-edge at which any winding fails, if the component is one-sided.
    pub conflict: Option<u32>,
    /// Number of triangles.
    pub triangle_count: usize,
}

/// Walks each component from its first triangle. On a tie between the two windings the first
/// triangle's stays. A one-sided component is left as it is.
pub(super) fn propagate(triangles: &[[u32; 3]], twins: &[u32]) -> Components {
    const NONE: u32 = u32::MAX;
    let mut part = vec![NONE; triangles.len()];
    let mut rewind = vec![false; triangles.len()];
    let mut kinds = Vec::new();
    let mut members: Vec<u32> = Vec::new();
    for first in 0..triangles.len() as u32 {
        if part[first as usize] != NONE {
            continue;
        }
        let number = kinds.len() as u32;
        let mut kind = ComponentKind { closed: true, conflict: None, triangle_count: 0 };
        part[first as usize] = number;
        members.clear();
        members.push(first);
        let mut done = 0;
        let mut rewound = 0;
        while let Some(&triangle) = members.get(done) {
            done += 1;
            for half_edge in 3 * triangle..3 * triangle + 3 {
                let twin = twins[half_edge as usize];
                if twin == BOUNDARY || twin == NON_MANIFOLD {
                    kind.closed = false;
                    continue;
                }
                let other = twin / 3;
                let against = ends(triangles, half_edge)[0] == ends(triangles, twin)[0];
                let wanted = rewind[triangle as usize] ^ against;
                if part[other as usize] == NONE {
                    part[other as usize] = number;
                    rewind[other as usize] = wanted;
                    rewound += usize::from(wanted);
                    members.push(other);
                } else if rewind[other as usize] != wanted {
                    kind.conflict.get_or_insert(half_edge);
                }
            }
        }
        kind.triangle_count = members.len();
        if kind.conflict.is_some() {
            members.iter().for_each(|&t| rewind[t as usize] = false);
        } else if 2 * rewound > members.len() {
            members.iter().for_each(|&t| rewind[t as usize] ^= true);
        }
        kinds.push(kind);
    }
    Components { part, rewind, kinds }
}
