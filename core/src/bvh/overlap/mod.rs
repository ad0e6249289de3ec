//! Two box trees, one of them moved: whether their surfaces meet, and where.
//!
//! | file | owns |
//! | --- | --- |
//! | `query` | the two questions |
//! | `axis_intervals` | the boxes of two nodes as intervals along these directions |
//! | `leaf_pair` | the triangles of two leaves |
//! | `descent` | the descent of both trees |

mod axis_intervals;
mod descent;
mod leaf_pair;
mod query;
