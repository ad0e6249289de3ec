//! Searches for a goal: which initial hulls are tried, and how each is brought to the goal. The
//! initial hulls are made in `tight/initial/`, the edits in `tight/moves/`.
//!
//! | file | what lies there |
//! | --- | --- |
//! | `faces.rs` | the tightest hull of a number of faces |
//! | `void.rs` | the fewest faces for a void |
//! | `slack.rs` | the fewest faces for a slack |
//! | `hull_search.rs` | [`HullSearch`]: the inputs and the state of a search |
//! | `candidate.rs` | [`CandidateHull`]: a hull that reached its goal or not; which of two is better |
//! | `descent.rs` | brings a hull down to fewer faces in stages |
//! | `polish.rs` | exchanges, flips and kicks in rounds |
//!
//! | word | meaning |
//! | --- | --- |
//! | shell | the surface of a hull while it is edited |
//! | star | the faces around a vertex or an edge, which one edit replaces |
//! | settle | move a vertex to the place of least volume that keeps the invariant |
//! | kick | move a vertex in a random direction and settle its neighbours; kept if the volume falls |
//! | exchange | split an edge where the hull is loose, collapse one where it is not |
//! | void | volume of the hull beyond that of the mesh, as a fraction of the mesh's volume |
//! | slack | the largest distance of a point of the hull from the mesh |
//! | floor | the volume that gains are measured against: the mesh's, or 0 if it bounds none |

mod candidate;
mod descent;
mod faces;
mod hull_search;
mod polish;
mod slack;
mod void;

pub(crate) use candidate::CandidateHull;
pub(crate) use hull_search::HullSearch;

use super::options::Goal;
use crate::error::BuildError;
use faces::Target;

impl<'a> HullSearch<'a, '_> {
    /// The best hull found for the goal of the options.
    pub fn run(&mut self) -> Result<CandidateHull<'a>, BuildError> {
        match self.options.goal {
            Goal::Faces(faces) => self.of_faces(Target { faces, descends: true }),
            Goal::Void(void) => self.fewest_faces_by_void(void),
            Goal::Slack(slack) => self.fewest_faces_by_slack(slack),
        }
    }
}
