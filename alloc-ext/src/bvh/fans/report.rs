//! What a decomposition came to, in numbers.

use std::fmt;

use crate::counted::Counted;

use super::{Fan, FanLeaf, MAX_PATCH};

/// Counts of fans and patches. Displayed as a few lines of text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FanReport {
    /// Triangles in all fans.
    pub triangles: usize,
    /// Fans.
    pub fans: usize,
    /// Fans of a single triangle, which the paper calls degenerate.
    pub degenerate: usize,
    /// Fans of 1, 2, … [`MAX_PATCH`] triangles.
    pub fan_sizes: [usize; MAX_PATCH],
    /// Patches.
    pub patches: usize,
    /// Patches of 1, 2, … [`MAX_PATCH`] triangles.
    pub patch_sizes: [usize; MAX_PATCH],
    /// Vertices that the patches store, each as often as it is stored.
    pub stored_vertices: usize,
}

impl FanReport {
    /// Counts `fans` and `patches`, which need not belong together: pass the fans of
    /// [`decompose`](super::decompose()) to compare with the paper, or those of the patches (by
    /// [`FanLeaf::fans`]) to see what is stored. Linear.
    ///
    /// # Panics
    /// If a fan or a patch has no triangle or more than [`MAX_PATCH`].
    pub fn new<'a>(fans: impl IntoIterator<Item = &'a Fan>, patches: &[FanLeaf]) -> Self {
        let mut report = Self { patches: patches.len(), ..Self::default() };
        for fan in fans {
            report.fans += 1;
            report.triangles += fan.triangles.len();
            report.fan_sizes[fan.triangles.len() - 1] += 1;
        }
        report.degenerate = report.fan_sizes[0];
        for patch in patches {
            report.patch_sizes[patch.triangle_count() - 1] += 1;
            report.stored_vertices += patch.vertex_count();
        }
        report
    }

    /// Mean number of triangles in a fan; 0 if there is none.
    #[must_use]
    pub fn triangles_per_fan(&self) -> f64 {
        mean(self.triangles, self.fans)
    }

    /// Mean number of triangles in a patch; 0 if there is none.
    #[must_use]
    pub fn triangles_per_patch(&self) -> f64 {
        mean(self.patched_triangles(), self.patches)
    }

    /// Mean number of stored vertices for a triangle of a patch; 0 if there is none. 10/8 is the
    /// least possible.
    #[must_use]
    pub fn vertices_per_triangle(&self) -> f64 {
        mean(self.stored_vertices, self.patched_triangles())
    }

    fn patched_triangles(&self) -> usize {
        self.patch_sizes.iter().enumerate().map(|(i, count)| (i + 1) * count).sum()
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
            "{}, {:.3} triangles a patch, {:.3} stored vertices a triangle; by size {:?}",
            Counted(self.patches, "patch"),
            self.triangles_per_patch(),
            self.vertices_per_triangle(),
            self.patch_sizes
        )
    }
}
