//! The search of a closest point.
//!
//! | file | owns |
//! | --- | --- |
//! | `closest` | the search, in any order of leaves |
//! | `blocks` | its descent on targets with vector registers |
//! | `waiting`, `waiting_search` | without floating point: triangles wait for the kernel |

#[cfg(meshsweep_wide)]
pub(in crate::bvh) mod blocks;
pub(in crate::bvh) mod closest;
#[cfg(not(meshsweep_wide))]
mod waiting;
#[cfg(not(meshsweep_wide))]
mod waiting_search;
