//! On which side of a closed mesh a point lies.
//!
//! | file | owns |
//! | --- | --- |
//! | `signed_distance` | the question: what a sign means, and how it is found |
//! | `search` | the descents of one question, and their steps |
//! | `survey` | the closest point and the sides of all triangles that may be the closest |
//! | `viewed_side` | which side one triangle shows |
//! | `pseudonormal` | the sum about the feature that all candidates share |

mod pseudonormal;
mod search;
mod signed_distance;
mod survey;
mod viewed_side;
