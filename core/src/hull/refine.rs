//! The refined hull follows a focus: splits that it needs are performed, splits that it no longer
//! needs are undone (Guéziec 2000, 4.2; Platis & Theoharis 2003, 3.2.2, who do not coarsen).
//!
//! A split is needed if its error exceeds the wanted one where the ball of its vertex and star
//! radius meets the focus. Whether a split is needed does not depend on the others. So while memory
//! is left, the splits that are performed are the least set in which every needed split of an
//! existing vertex is performed, whatever the order, and one pass over the existing vertices finds
//! them: new vertices come at the end of the list.
//!
//! If the memory gets full, a floor rises: splits of no greater need are left out and undone. It
//! falls again when there is room.

use super::focus::{Focus, FocusQuery};
use super::refined_hull::{ErasedHull, Refined, RefinedHull, erased};
use crate::hull::format::{Hull, SplitIdx, VertIdx};
use crate::num::up_to_f32;
use crate::query::QueryError;

/// What an update did, and what it left undone.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Refinement {
    /// Faces of the refined hull.
    pub faces: u32,
    /// Splits performed.
    pub performed: u32,
    /// Splits undone.
    pub undone: u32,
    /// The largest error among the splits that are needed and do not fit in the memory, input
    /// units, rounded up. 0 if all needed splits are performed.
    pub error_left: f32,
    /// Changes in the slice.
    pub stored: usize,
    /// Changes that did not fit. The slice keeps the first ones.
    pub dropped: u32,
}

/// A split that an update performed or undid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct SplitChange {
    /// The split.
    split: SplitIdx,
    /// Whether it was performed. Else it was undone.
    is_performed: bool,
}

impl SplitChange {
    /// Any value, for filling arrays.
    pub const EMPTY: SplitChange = SplitChange { split: SplitIdx(0), is_performed: false };

    /// Number of the split.
    pub fn split(&self) -> u32 {
        self.split.0
    }

    /// Whether the split was performed. Else it was undone.
    pub fn is_performed(&self) -> bool {
        self.is_performed
    }

    /// Corners of the faces that the change removed.
    pub fn removed(&self, hull: &Hull<'_>) -> impl Iterator<Item = [VertIdx; 3]> {
        star(hull, self.split, !self.is_performed)
    }

    /// Corners of the faces that the change added.
    pub fn added(&self, hull: &Hull<'_>) -> impl Iterator<Item = [VertIdx; 3]> {
        star(hull, self.split, self.is_performed)
    }
}

/// The fine or the coarse triangles of a split that stand for a part of the surface.
fn star<'a>(
    hull: &Hull<'a>,
    split: SplitIdx,
    fine: bool,
) -> impl Iterator<Item = [VertIdx; 3]> + use<'a> {
    let (hull, split) = (*hull, hull.split(split));
    let count = split.map_or(0, |s| if fine { s.fine_len() } else { s.ring_len() });
    (0..count).filter_map(move |i| {
        let split = split?;
        let has_part = |slot: usize| {
            u32::try_from(slot)
                .is_ok_and(|slot| hull.has_part(split.first_triangle.wrapping_add(slot)))
        };
        if fine {
            return if has_part(i) { split.fine(i) } else { None };
        }
        // A coarse triangle stands for the parts of its children.
        let ring_len = split.ring_len();
        let by_wings = (split.right_parent == i && has_part(ring_len))
            || (split.left_parent == i && has_part(ring_len + 1));
        if has_part(i) || by_wings { split.coarse(i) } else { None }
    })
}

impl<'t, const SPLITS: usize> RefinedHull<'t, SPLITS> {
    /// Refines the hull around a focus and coarsens it elsewhere.
    ///
    /// If [`Refinement::error_left`] is 0, every face that meets the focus is a triangle of the
    /// surface, or its part of the surface is no farther from the face than `error` (input units).
    /// For an eye the bound is the larger of `error` and the error at the face's distance. A face
    /// without a part of the surface has no bound. On a cut blob the finest faces keep the error of
    /// the last level.
    ///
    /// A performed split is kept while a focus and an error larger by an eighth need it, so that
    /// small motions change little. If `SPLITS` are too few, the splits of the greatest need are
    /// performed. Splits of equal need are then performed all or none, so memory may stay free, and
    /// each update may try them again.
    ///
    /// `changes` gets the splits that were undone and performed, in the order in which that was
    /// done. A caller that removes and adds the faces of each change, one after the other, has the
    /// faces of the hull, if nothing but updates with this hull changed the state: a
    /// [`reset`](Self::reset), [`Hull::outer_hits`] and an update with another hull leave no
    /// record. If some were [`dropped`](Refinement::dropped), take [`faces`](Self::faces) instead.
    /// An empty slice is fine.
    ///
    /// Cost: some hundred instructions for each vertex of the base hull and each performed split,
    /// and some thousand for each change. An update that runs out of memory, or has memory again,
    /// takes that several times.
    ///
    /// ```
    /// use meshsweep_core::{SplitChange, Focus, Hull, RefinedHull};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/bracket.msw"));
    /// let part = Hull::open(bytes)?;
    /// let mut refined = RefinedHull::<128>::new();
    /// let near = Focus::Ball { centre: [0.0, 0.0, 10.0], radius: 5.0 };
    /// let mut changes = [SplitChange::EMPTY; 64];
    /// let update = refined.update(&part, &near, 0.5, &mut changes)?;
    /// assert_eq!(refined.faces(&part).count(), update.faces as usize);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::NotFinite`], [`QueryError::OutOfDomain`]; [`QueryError::Tolerance`] if a
    /// distance or an error is negative, NaN or infinite. The hull stays as it was.
    pub fn update(
        &mut self,
        hull: &Hull<'t>,
        focus: &Focus,
        error: f32,
        changes: &mut [SplitChange],
    ) -> Result<Refinement, QueryError> {
        update(erased(&mut self.state), hull, focus, error, changes)
    }
}

impl<'t> ErasedHull<'t> {
    /// As [`RefinedHull::update`].
    ///
    /// # Errors
    /// Those of [`RefinedHull::update`].
    pub fn update(
        &mut self,
        hull: &Hull<'t>,
        focus: &Focus,
        error: f32,
        changes: &mut [SplitChange],
    ) -> Result<Refinement, QueryError> {
        update(&mut self.state, hull, focus, error, changes)
    }
}

fn update(
    state: &mut Refined,
    hull: &Hull<'_>,
    focus: &Focus,
    error: f32,
    changes: &mut [SplitChange],
) -> Result<Refinement, QueryError> {
    if !hull.has_hull() {
        return Err(QueryError::NO_HULL);
    }
    let query = FocusQuery::new(hull, focus, error)?;
    state.begin(hull);
    let mut update =
        Update { state, hull, query, changes, stored: 0, dropped: 0, performed: 0, undone: 0 };
    let left = update.run().ok_or(QueryError::Unchecked)?;
    let Update { stored, dropped, performed, undone, .. } = update;
    Ok(Refinement {
        faces: state.face_count(hull),
        performed,
        undone,
        error_left: up_to_f32(f64::from(left) * hull.scale()),
        stored,
        dropped,
    })
}

/// One update at work.
struct Update<'a, 't> {
    state: &'a mut Refined,
    hull: &'a Hull<'t>,
    query: FocusQuery,
    changes: &'a mut [SplitChange],
    stored: usize,
    dropped: u32,
    performed: u32,
    undone: u32,
}

/// How a pass over the existing vertices ended.
enum Pass {
    /// The memory is too short for a split of this need.
    Full(f32),
    /// All needs above the floor are met. The error and the need of the splits left out.
    Done(Left),
}

/// The largest error and the largest need of splits that a focus needs and a pass leaves out; 0
/// without.
#[derive(Clone, Copy, Default)]
struct Left {
    error: f32,
    need: f32,
}

impl Update<'_, '_> {
    /// The error that is left. `None`: the hull is unchecked.
    fn run(&mut self) -> Option<f32> {
        let mut was_full = false;
        self.coarsen(KEPT)?;
        loop {
            match self.refine()? {
                Pass::Full(need) => {
                    // First go the splits that are kept without need. After that each step leaves
                    // out one needed split at least, so the loop ends.
                    if was_full {
                        let least = self.least_need(need)?;
                        // Needs are finite, so the greatest floor leaves out all.
                        self.state.floor = least.max(self.state.floor * FLOOR_STEP).min(f32::MAX);
                    }
                    was_full = true;
                    self.coarsen(1.0)?;
                }
                Pass::Done(left) if left.need > 0.0 && !was_full && self.has_room() => {
                    // Below a need that is left, so that each such pass performs a split.
                    let floor = self.state.floor.min(left.need) / FLOOR_STEP;
                    self.state.floor = if floor < LEAST_FLOOR { 0.0 } else { floor };
                }
                Pass::Done(left) => {
                    if left.need == 0.0 {
                        self.state.floor = 0.0;
                    }
                    return Some(left.error);
                }
            }
        }
    }

    /// Whether half of the memory is free. A step of the floor frees about a third of the splits,
    /// because the number of faces falls with the square of the error. So a floor that has risen
    /// mostly stays, and few splits are performed and undone in turns.
    fn has_room(&self) -> bool {
        self.state.splits.len() <= self.state.splits.capacity() / 2
    }

    /// Performs the needed splits of all existing vertices.
    fn refine(&mut self) -> Option<Pass> {
        let mut left = Left::default();
        for vertex in 0..self.hull.header().base_vertices {
            let vertex = VertIdx(vertex);
            if let Some(split) = self.hull.split_of(vertex)
                && !self.state.splits.contains(split)
                && let Some(full) = self.meet(vertex, split, &mut left)?
            {
                return Some(full);
            }
        }
        let mut position = 0;
        while let Some(maker) = self.state.splits.get(position) {
            for which in 0..2 {
                let vertex = self.hull.brought_by(maker, which);
                if !self.state.splits.is_replaced(position, which)
                    && let Some(split) = self.hull.split_of(vertex)
                    && let Some(full) = self.meet(vertex, split, &mut left)?
                {
                    return Some(full);
                }
            }
            position += 1;
        }
        Some(Pass::Done(left))
    }

    /// Performs the split of an existing vertex if it is needed. The inner `Some` ends the pass.
    #[inline(always)]
    fn meet(&mut self, vertex: VertIdx, split: SplitIdx, left: &mut Left) -> Option<Option<Pass>> {
        let [star_radius, error] = self.hull.star_radius_and_error(split)?;
        if !self.query.is_above(error) {
            return Some(None);
        }
        let need = self.query.need(self.hull.position(vertex)?, star_radius, error);
        if need > self.state.floor {
            return Some(if self.perform(split)? { None } else { Some(Pass::Full(need)) });
        }
        if need > 0.0 {
            *left = Left { error: left.error.max(error), need: left.need.max(need) };
        }
        Some(None)
    }

    #[inline(never)]
    fn perform(&mut self, split: SplitIdx) -> Option<bool> {
        let before = self.state.splits.len();
        let fits = self.state.perform_with_required(self.hull, split)?;
        for position in before..self.state.splits.len() {
            let split = self.state.splits.get(position)?;
            self.performed = self.performed.saturating_add(1);
            self.note(SplitChange { split, is_performed: true });
        }
        Some(fits)
    }

    /// Undoes the splits that nothing needs, the last first: a split comes after those that it
    /// requires. A focus and an error larger by the factor keep a split.
    fn coarsen(&mut self, kept: f32) -> Option<()> {
        let before = self.undone;
        for position in (0..self.state.splits.len()).rev() {
            if self.state.splits.is_required(position)
                || self.need_at(position, kept)? > self.state.floor
            {
                continue;
            }
            let split = self.state.splits.get(position)?;
            self.state.undo(self.hull, position)?;
            self.undone = self.undone.saturating_add(1);
            self.note(SplitChange { split, is_performed: false });
        }
        if self.undone != before {
            self.state.splits.close_gaps();
        }
        Some(())
    }

    /// The least need above 0 of the performed splits and of one more.
    fn least_need(&self, more: f32) -> Option<f32> {
        let mut least = more;
        for position in 0..self.state.splits.len() {
            let need = self.need_at(position, 1.0)?;
            if need > 0.0 {
                least = least.min(need);
            }
        }
        Some(least)
    }

    /// The need of the split at a position, to a focus and an error larger by a factor.
    #[inline]
    fn need_at(&self, position: usize, factor: f32) -> Option<f32> {
        let split = self.state.splits.get(position)?;
        let [star_radius, error] = self.hull.star_radius_and_error(split)?;
        if !self.query.is_above(error * factor) {
            return Some(0.0);
        }
        let vertex = self.hull.position(self.hull.replaced_by(split)?)?;
        Some(self.query.need(vertex, star_radius * factor, error * factor))
    }

    fn note(&mut self, change: SplitChange) {
        match self.changes.get_mut(self.stored) {
            Some(slot) => {
                *slot = change;
                self.stored += 1;
            }
            None => self.dropped = self.dropped.saturating_add(1),
        }
    }
}

/// A performed split is kept while its ball and its error, larger by this factor, need it. A
/// smaller factor undoes and repeats more while a focus moves to and fro. A larger one keeps more
/// faces.
const KEPT: f32 = 1.125;

/// A floor rises by at least this factor, and falls by it: two steps of stored errors.
const FLOOR_STEP: f32 = 1.25;

/// A floor below the least stored error other than 0 is none.
const LEAST_FLOOR: f32 = 1.0 / (1u32 << 30) as f32;
