//! The options of a robot.

use std::path::PathBuf;

/// How a robot's description is read, and which distances its links keep.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct RobotOptions {
    /// A file whose `disable_collisions` name pairs to leave out. Pairs that it disables for the
    /// reason `Never` are kept.
    pub srdf: Option<PathBuf>,
    /// Folders of packages, by their names.
    pub packages: Vec<(String, PathBuf)>,
    /// The distance that all other pairs keep, in metres.
    pub keep: f64,
    /// Pairs of links that keep a distance of their own, in metres. Of two for one pair the last
    /// counts. They are never left out.
    pub keep_pairs: Vec<([String; 2], f64)>,
    /// How many random places are tried to find the pairs that are always too near: those that meet
    /// are left out, others are refused. 0: none is tried, all are kept.
    pub samples: u32,
}

impl Default for RobotOptions {
    fn default() -> Self {
        Self { srdf: None, packages: Vec::new(), keep: 0.0, keep_pairs: Vec::new(), samples: 1000 }
    }
}
