//! How a robot's description is read.

use std::path::PathBuf;

/// How a robot's description is read, and which distances its links keep.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct RobotOptions {
    /// A file whose `disable_collisions` name pairs to leave out.
    pub srdf: Option<PathBuf>,
    /// Folders of packages, by their names.
    pub packages: Vec<(String, PathBuf)>,
    /// The distance to keep, in metres.
    pub keep: f64,
    /// Pairs of links that keep a distance of their own.
    pub keep_pairs: Vec<([String; 2], f64)>,
    /// Random places at which pairs are tried that may meet at all places. 0: none is left out for
    /// that.
    pub samples: u32,
}

impl Default for RobotOptions {
    fn default() -> Self {
        Self { srdf: None, packages: Vec::new(), keep: 0.0, keep_pairs: Vec::new(), samples: 1000 }
    }
}
