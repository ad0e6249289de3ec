//! Whether a hull is as tight as asked for.

use super::report::{Outcome, Report};
use crate::error::{BuildError, Tightness, Unmet};

impl Tightness {
    /// Refuses hulls of which one is looser than asked for.
    ///
    /// # Errors
    /// [`BuildError::Unmet`], of the first one.
    pub fn require<'a>(
        self,
        reports: impl ExactSizeIterator<Item = &'a Report>,
    ) -> Result<(), BuildError> {
        let count = reports.len();
        let unmet = reports.enumerate().find_map(|(index, report)| {
            Some(Unmet {
                tightness: self,
                found: self.excess(report)?,
                faces: report.faces,
                is_out_of_time: report.stop == Outcome::OutOfTime,
                component: (count > 1).then_some(index),
            })
        });
        unmet.map_or(Ok(()), |unmet| Err(BuildError::Unmet(unmet)))
    }

    /// Slack or void of a hull that is too loose.
    fn excess(self, report: &Report) -> Option<f64> {
        match (self.slack, self.void) {
            (Some(asked), _) => Some(report.slack_of_input().upper).filter(|&found| found > asked),
            (None, Some(asked)) => {
                let found = 100.0 * report.void.unwrap_or(f64::INFINITY);
                // The search compares volumes; this ratio of them is rounded.
                let is_above = found - asked > 4.0 * f64::EPSILON * (100.0 + asked);
                is_above.then_some(found)
            }
            (None, None) => None,
        }
    }
}
