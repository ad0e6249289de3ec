//! Levels of the progressive hull of a closed surface.
//!
//! A fine surface is thinned by rounds of collapses first, which takes a quarter of the time and
//! may make the surface grow into itself where collapses in order do not.

use super::initial_hull::InitialInput;
use crate::collapse::{Conditions, Engine, Priority, thin};
use crate::progress::Stage;
use crate::surface::compact;
use glam::DVec3;
use meshsweep_core::internal::num::exp2;

/// Positions and triangles.
type Faces = (Vec<DVec3>, Vec<[u32; 3]>);

/// Faces of level 0 for a hull of `target` faces: enough to choose from, and no more, because each
/// face costs a collapse against the mesh. `DESIGN.md`, "Moves", has what lost.
pub(crate) fn ample_faces(target: usize) -> usize {
    if target <= 200 { 875 } else { target.saturating_add(target / 2).saturating_add(800) }
}

/// Levels in the order in which they are tried: level n has [`ample_faces`] · 2^n faces. Finer
/// levels are closer to the mesh. Coarser levels pass over places where the mesh crosses itself.
const LEVELS: [i32; 7] = [0, 1, -1, 2, -2, 3, -3];

/// The [`LEVELS`] that are tried. A thinned surface that grew into itself does so at any level.
pub(super) fn tried(thins: bool) -> &'static [i32] {
    if thins { &LEVELS[..1] } else { &LEVELS }
}

/// Least faces of a level that is coarser than level 0.
const LEAST_FACES: usize = 40;

/// Faces that are collapsed between two looks at the clock.
const FACES_PER_LOOK: usize = 1000;

/// Compactness ratio of collapses in rounds. Their result is shrunk onto the mesh, so that needles
/// do little harm, while the paper's condition refuses most collapses of a fine mesh.
const THINNING_COMPACTNESS: f64 = 0.4;

/// A closed manifold surface in the local frame, on its grid.
pub(super) struct ClosedSurface<'a> {
    pub positions: &'a [DVec3],
    pub triangles: &'a [[u32; 3]],
    pub conditions: Conditions,
}

/// Levels in the mesh's frame, each with its number. The level with exactly the target faces, or as
/// few as the collapses reach, has no number.
#[derive(Default)]
pub(super) struct Levels(Vec<(Option<i32>, Faces)>);

impl Levels {
    /// Takes a level out; `None` if the surface has no such level.
    pub fn take(&mut self, level: Option<i32>) -> Option<Faces> {
        let at = self.0.iter().position(|&(other, _)| other == level)?;
        Some(self.0.remove(at).1)
    }
}

fn finest_faces(target: usize) -> usize {
    ample_faces(target).saturating_mul(8)
}

impl ClosedSurface<'_> {
    /// Whether the surface has more faces than the finest level, so that thinning changes levels.
    pub fn is_fine(&self, target: usize) -> bool {
        self.triangles.len() > finest_faces(target)
    }

    /// The levels of these numbers for a hull of `target` faces; `None` if the deadline passes
    /// first. Level 0 and the level without number may be the surface itself.
    pub fn levels(
        &self,
        &InitialInput { stored, deadline, .. }: &InitialInput<'_>,
        target: usize,
        thins: bool,
        wanted: impl IntoIterator<Item = Option<i32>>,
        on_progress: &mut dyn FnMut(Stage),
    ) -> Option<Levels> {
        let is_late = || deadline.has_passed();
        let Self { positions, triangles, conditions } = *self;
        let from = triangles.len();
        let mut show = |faces: usize| {
            on_progress(Stage::Collapsing {
                done: from.saturating_sub(faces),
                of: from.saturating_sub(target),
            });
        };
        let faces_of = |level| (ample_faces(target) as f64 * exp2(level)) as usize;
        let exists = |&(level, faces): &(Option<i32>, usize)| {
            level.is_none_or(|n| !(faces >= from && n > 0 || faces < LEAST_FACES && n < 0))
        };
        let mut counts: Vec<(Option<i32>, usize)> = wanted
            .into_iter()
            .map(|level| (level, level.map_or(target, faces_of)))
            .filter(exists)
            .collect();
        counts.sort_unstable_by_key(|&(level, faces)| (std::cmp::Reverse(faces), level));
        let thinned = (thins && self.is_fine(target)).then(|| {
            let compactness_ratio = conditions.compactness_ratio.min(THINNING_COMPACTNESS);
            let loose = Conditions { compactness_ratio, ..conditions };
            thin(positions, triangles, finest_faces(target), loose, stored.grid, |faces| {
                show(faces);
                is_late()
            })
        });
        if is_late() {
            return None;
        }
        let (positions, triangles) = thinned
            .as_ref()
            .map_or((positions, triangles), |(positions, triangles)| (positions, triangles));
        let mut engine =
            Engine::new(positions, triangles, conditions, Priority::Program, stored.grid);
        let scale = exp2(stored.scale_exponent);
        let mut levels = Levels::default();
        for (level, faces) in counts {
            // A surface that is stuck at more faces is a level as well.
            while engine.face_count() > faces && !is_late() {
                let next = engine.face_count().saturating_sub(FACES_PER_LOOK).max(faces);
                let stuck = engine.run(next, |faces| {
                    show(faces);
                    !is_late()
                });
                if stuck.is_some() {
                    break;
                }
            }
            if is_late() {
                return None;
            }
            let (local, triangles) = compact(engine.positions(), engine.faces());
            let positions = local.into_iter().map(|p| p * scale).collect();
            levels.0.push((level, (positions, triangles)));
        }
        Some(levels)
    }
}
