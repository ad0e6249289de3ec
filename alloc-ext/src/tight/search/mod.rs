//! Searches for a goal: which initial hulls are tried, and how each is brought to the goal.
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
