//! Whether hulls are as tight as asked for, by what was measured of them.

use super::super::describe::{AtMost, Given};
use super::super::failure::Failure;
use meshsweep::wrap::{Outcome, Report};
use std::fmt;
use std::path::Path;

/// A hull that is looser than asked for. Lengths are in the mesh's unit.
#[derive(Clone, Copy, Debug)]
pub struct Unmet {
    bound: Bound,
    faces: usize,
    is_late: bool,
    /// The option that takes a number of faces instead.
    by_faces: &'static str,
    /// Which part's, if each has one of its own.
    part: Option<usize>,
}

/// What was asked for as it was given, and what was found instead.
#[derive(Clone, Copy, Debug)]
enum Bound {
    Slack {
        asked: f64,
        found: f64,
    },
    /// Percentages.
    Void {
        asked: f64,
        found: f64,
    },
}

/// How tight a hull has to be.
#[derive(Clone, Copy, Debug)]
pub struct Tightness {
    /// Distance from the mesh.
    pub slack: Option<f64>,
    /// Percentage of the mesh's volume.
    pub void: Option<f64>,
    /// The option that takes a number of faces instead.
    pub by_faces: &'static str,
}

/// That each hull of a file is as tight as asked for.
pub fn require_met<'a>(
    file: &Path,
    asked: &Tightness,
    reports: impl ExactSizeIterator<Item = &'a Report>,
) -> Result<(), Failure> {
    let parts = reports.len();
    let unmet = |(index, report): (usize, &Report)| {
        let bound = bound(asked, report)?;
        let part = (parts > 1).then_some(index);
        let is_late = report.stop == Outcome::OutOfTime;
        let unmet = Unmet { bound, faces: report.faces, is_late, by_faces: asked.by_faces, part };
        Some(Failure::Unmet { file: file.to_owned(), unmet })
    };
    reports.enumerate().find_map(unmet).map_or(Ok(()), Err)
}

fn bound(asked: &Tightness, report: &Report) -> Option<Bound> {
    match (asked.slack, asked.void) {
        (Some(asked), _) if report.slack.upper > asked => {
            Some(Bound::Slack { asked, found: report.slack.upper })
        }
        (_, Some(asked)) => {
            let found = 100.0 * report.void.unwrap_or(f64::INFINITY);
            // The search compares volumes, of which this is a rounded ratio.
            let is_above = found - asked > 4.0 * f64::EPSILON * (100.0 + asked);
            is_above.then_some(Bound::Void { asked, found })
        }
        _ => None,
    }
}

impl fmt::Display for Unmet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let &Unmet { bound, faces, is_late, by_faces, part } = self;
        part.map_or(Ok(()), |part| write!(f, "part {part}: "))?;
        f.write_str(if is_late {
            "the time was up before a hull"
        } else {
            "no hull that was tried"
        })?;
        let option = match bound {
            Bound::Slack { asked, found } => {
                let (asked, found) = (Given(asked), AtMost(found));
                write!(
                    f,
                    " came within {asked} of the mesh: the tightest is within {found}, with {faces} faces"
                )?;
                "--slack"
            }
            Bound::Void { asked, found } => {
                let (asked, found) = (Given(asked), AtMost(found));
                write!(
                    f,
                    " left {asked} % void space or less: the tightest leaves {found} %, with {faces} faces"
                )?;
                "--void"
            }
        };
        f.write_str(if is_late { "; give more --seconds, " } else { "; " })?;
        write!(f, "ask for a larger {option}, or choose a number of faces with {by_faces}")
    }
}
