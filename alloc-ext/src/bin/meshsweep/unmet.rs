//! Whether a hull is as tight as asked for. Lengths are in the mesh's unit.

use crate::number::{AtMost, Typed};
use meshsweep::tight::{Outcome, Report};
use std::fmt;

/// How tight a hull has to be.
#[derive(Clone, Copy, Debug)]
pub struct Tightness {
    /// Largest distance from the mesh.
    pub slack: Option<f64>,
    /// Largest void, in percent of the mesh's volume.
    pub void: Option<f64>,
    /// The option that takes a number of faces instead.
    pub by_faces: &'static str,
}

/// A hull that is looser than asked for.
#[derive(Clone, Copy, Debug)]
pub struct Unmet {
    tightness: Tightness,
    /// Slack or void of the tightest hull.
    found: f64,
    faces: usize,
    is_out_of_time: bool,
    /// The component, if each one has a hull.
    component: Option<usize>,
}

impl Tightness {
    /// The first hull of a file that is looser than asked for.
    pub fn unmet<'a>(self, reports: impl ExactSizeIterator<Item = &'a Report>) -> Option<Unmet> {
        let count = reports.len();
        reports.enumerate().find_map(|(index, report)| {
            Some(Unmet {
                tightness: self,
                found: self.excess(report)?,
                faces: report.faces,
                is_out_of_time: report.stop == Outcome::OutOfTime,
                component: (count > 1).then_some(index),
            })
        })
    }

    /// Slack or void of a hull that is too loose.
    fn excess(self, report: &Report) -> Option<f64> {
        match (self.slack, self.void) {
            (Some(asked), _) => Some(report.slack.upper).filter(|&found| found > asked),
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

impl fmt::Display for Unmet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let &Unmet { tightness, found, faces, is_out_of_time, component } = self;
        component.map_or(Ok(()), |index| write!(f, "part {index}: "))?;
        let (who, more) = if is_out_of_time {
            ("the time was up before a hull", "give more --seconds, ")
        } else {
            ("no hull that was tried", "")
        };
        let found = AtMost(found);
        let option = if let Some(asked) = tightness.slack.map(Typed) {
            write!(f, "{who} came within {asked} of the mesh: the tightest is within {found}")?;
            "--slack"
        } else {
            let asked = Typed(tightness.void.unwrap_or(0.0));
            write!(f, "{who} left {asked} % void space or less: the tightest leaves {found} %")?;
            "--void"
        };
        write!(
            f,
            ", with {faces} faces; {more}ask for a larger {option}, or choose a number of faces \
             with {}",
            tightness.by_faces
        )
    }
}
