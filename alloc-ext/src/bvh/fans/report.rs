//! Counts of a decomposition.

use std::fmt;

use crate::counted::Counted;

use super::{Fan, FanLeaf, MAX_LEAF_TRIANGLES};

/// Counts of fans and leaves. Displayed as a few lines of text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FanReport {
    /// Triangles in all fans.
    pub triangles: usize,
    /// Fans.
    pub fans: usize,
    /// Fans of a single triangle, which the paper calls degenerate.
    pub degenerate: usize,
    /// Fans of 1, 2, … [`MAX_LEAF_TRIANGLES`] triangles.
    pub fan_sizes: [usize; MAX_LEAF_TRIANGLES],
    /// Leaves.
    pub leaves: usize,
    /// Leaves of 1, 2, … [`MAX_LEAF_TRIANGLES`] triangles.
    pub leaf_sizes: [usize; MAX_LEAF_TRIANGLES],
    /// Vertices that the leaves store, each as often as it is stored.
    pub stored_vertices: usize,
}

impl FanReport {
    /// Counts `fans` and `leaves`, which need not belong together: pass the fans of
    /// [`decompose`](super::decompose()) to compare with the paper, or those of the leaves (by
    /// [`FanLeaf::fans`]) to see the stored fans. Linear.
    ///
    /// # Panics
    /// If a fan or a leaf has no triangle or more than [`MAX_LEAF_TRIANGLES`].
    pub fn new<'a>(fans: impl IntoIterator<Item = &'a Fan>, leaves: &[FanLeaf]) -> Self {
        let mut report = Self { leaves: leaves.len(), ..Self::default() };
        for fan in fans {
            report.fans += 1;
            report.triangles += fan.triangles.len();
            report.fan_sizes[fan.triangles.len() - 1] += 1;
        }
        report.degenerate = report.fan_sizes[0];
        for leaf in leaves {
            report.leaf_sizes[leaf.triangle_count() - 1] += 1;
            report.stored_vertices += leaf.vertex_count();
        }
        report
    }

    /// Mean number of triangles in a fan; 0 if there is none.
    #[must_use]
    pub fn triangles_per_fan(&self) -> f64 {
        mean(self.triangles, self.fans)
    }

    /// Mean number of triangles in a leaf; 0 if there is none.
    #[must_use]
    pub fn triangles_per_leaf(&self) -> f64 {
        mean(self.leaf_triangles(), self.leaves)
    }

    /// Mean number of stored vertices for a triangle of a leaf; 0 if there is none. 10/8 is the
    /// least possible.
    #[must_use]
    pub fn vertices_per_triangle(&self) -> f64 {
        mean(self.stored_vertices, self.leaf_triangles())
    }

    fn leaf_triangles(&self) -> usize {
        self.leaf_sizes.iter().enumerate().map(|(i, count)| (i + 1) * count).sum()
    }
}

fn mean(sum: usize, count: usize) -> f64 {
    if count == 0 { 0.0 } else { sum as f64 / count as f64 }
}

impl fmt::Display for FanReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{} in {}, {:.3} a fan, {} alone; by size {:?}",
            Counted(self.triangles, "triangle"),
            Counted(self.fans, "fan"),
            self.triangles_per_fan(),
            self.degenerate,
            self.fan_sizes
        )?;
        write!(
            f,
            "{}, {:.3} triangles a leaf, {:.3} stored vertices a triangle; by size {:?}",
            Counted(self.leaves, "leaf"),
            self.triangles_per_leaf(),
            self.vertices_per_triangle(),
            self.leaf_sizes
        )
    }
}
