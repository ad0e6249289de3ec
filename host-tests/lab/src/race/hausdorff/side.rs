//! The direction of a Hausdorff distance.

/// Whose farthest points count. The numbers are those of the questions in `cgal.cpp`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The first mesh's.
    Forward = 0,
    /// The second's.
    Backward = 1,
    /// Those of both.
    Both = 2,
}

impl Side {
    /// The meshes whose points are asked.
    pub const fn sources(self) -> &'static [usize] {
        match self {
            Self::Forward => &[0],
            Self::Backward => &[1],
            Self::Both => &[0, 1],
        }
    }

    /// In tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Forward => "first to second",
            Self::Backward => "second to first",
            Self::Both => "symmetric",
        }
    }
}
