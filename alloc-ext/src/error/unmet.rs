//! Whether a hull is as tight as asked for. Lengths are in the mesh's unit.

use crate::number::{AtMost, Typed};
use std::fmt;

/// How tight a hull has to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tightness {
    /// Largest distance from the mesh.
    pub slack: Option<f64>,
    /// Largest void, in percent of the mesh's volume.
    pub void: Option<f64>,
}

/// A hull that is looser than asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unmet {
    /// What was asked for.
    pub tightness: Tightness,
    /// Slack or void of the tightest hull.
    pub found: f64,
    /// Its faces.
    pub faces: usize,
    /// Whether the time was up before.
    pub is_out_of_time: bool,
    /// The component, if each one has a hull.
    pub component: Option<usize>,
}

impl fmt::Display for Unmet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let &Unmet { tightness, found, faces, is_out_of_time, component } = self;
        component.map_or(Ok(()), |index| write!(f, "part {index}: "))?;
        let (who, more) = if is_out_of_time {
            ("the time was up before a hull", "give more time, ")
        } else {
            ("no hull that was tried", "")
        };
        let found = AtMost(found);
        let goal = if let Some(asked) = tightness.slack.map(Typed) {
            write!(f, "{who} came within {asked} of the mesh: the tightest is within {found}")?;
            "slack"
        } else {
            let asked = Typed(tightness.void.unwrap_or(0.0));
            write!(f, "{who} left {asked} % void space or less: the tightest leaves {found} %")?;
            "void"
        };
        write!(f, ", with {faces} faces; {more}ask for a larger {goal}, or for a number of faces")
    }
}
