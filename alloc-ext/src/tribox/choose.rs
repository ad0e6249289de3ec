//! The plane that splits a cell best. Crosnier & Rossignac 1999, section 4, take the plane that
//! bisects the thickest slab.

use super::cell::{Cell, Trust, Whole, section};
use super::extent::Extent;
use super::extrema::Extrema;
use super::polygons::HalfSpace;
use super::span::{Span, projections};
use crate::progress::Watch;
use meshsweep_core::internal::tribox::SLABS;

/// The measure that splits minimise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Total area of the triboxes, as in the paper.
    Area,
    /// Total volume: the volume beside a solid is the cost of its proxy.
    Volume,
}

/// Planes that are tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Planes {
    /// The plane that bisects the thickest slab, as in the paper.
    Thickest,
    /// This number for each of the nine directions, evenly between the ends of its slab.
    Nine(u32),
    /// These, and planes just beyond local extrema of the mesh, at most 16 for each direction.
    Extrema(u32),
}

impl Planes {
    /// Seven for each direction.
    pub const NINE: Planes = Planes::Nine(7);
    /// These, and planes just beyond local extrema.
    pub const EXTREMA: Planes = Planes::Extrema(7);
}

/// Choice of planes.
#[derive(Clone, Copy)]
pub(super) struct Choosing<'a> {
    pub planes: Planes,
    pub measure: Measure,
    /// Planes are at multiples of it.
    pub unit: f64,
    /// See [`SplitOptions::foresight`](super::SplitOptions::foresight).
    pub foresight: f64,
    /// Certainty of points' sides.
    pub trust: Trust,
    /// Of [`Planes::Extrema`].
    pub extrema: Option<&'a Extrema>,
    pub watch: Watch<'a>,
}

/// A plane, and the gain of a split there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Choice {
    pub slab: usize,
    pub at: f64,
    /// Measure of the cell's tribox less that of its parts'; negative if they have more.
    pub now: f64,
    /// The same; with foresight, the mean of the gains of this split and of both parts' splits.
    pub gain: f64,
}

impl Measure {
    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Measure::Area => "area",
            Measure::Volume => "volume",
        }
    }

    /// Of an extent.
    #[must_use]
    pub fn of(self, extent: Extent) -> f64 {
        match self {
            Measure::Area => extent.area,
            Measure::Volume => extent.volume,
        }
    }
}

impl Choosing<'_> {
    /// The plane of the greatest gain, the first one of several; `None` if no plane leaves
    /// something on both sides, or the watch asks to end.
    ///
    /// Where the gain is small, as at a hole in the middle of the cell, each direction's bisecting
    /// plane is tried together with the best splits of both parts.
    ///
    /// Cost: for each direction one pass over the cell's corners, and a winding number for each
    /// vertex of each plane's section; ten times that with second splits.
    pub fn best(&self, whole: &Whole<'_>, cell: &Cell) -> Option<Choice> {
        let best = self.single(whole, cell)?;
        let enough = self.foresight * self.measure.of(Extent::of(&cell.tribox));
        if best.gain >= enough || self.planes == Planes::Thickest {
            return Some(best);
        }
        let twice = (0..SLABS).filter_map(|slab| self.twice(whole, cell, slab));
        Some(twice.fold(best, |best, other| if other.gain > best.gain { other } else { best }))
    }

    /// The plane that bisects a slab, if both parts are split again: the gain of each of the three
    /// splits.
    fn twice(&self, whole: &Whole<'_>, cell: &Cell, slab: usize) -> Option<Choice> {
        let at = *self.evenly(cell, slab, 1).first()?;
        let part = |is_low: bool| whole.part(cell, &HalfSpace { slab, at, is_low }, self.trust);
        let parts = [part(true)?, part(false)?];
        let mut gain = self.measure.of(Extent::of(&cell.tribox));
        let mut splits = 1;
        gain -= parts.iter().map(|part| self.measure.of(Extent::of(&part.tribox))).sum::<f64>();
        let now = gain;
        for part in parts {
            if let Some(next) = self.single(whole, &part).filter(|next| next.gain > 0.0) {
                gain += next.gain;
                splits += 1;
            }
        }
        Some(Choice { slab, at, now, gain: gain / f64::from(splits) })
    }

    fn single(&self, whole: &Whole<'_>, cell: &Cell) -> Option<Choice> {
        let corners: Vec<[f64; SLABS]> =
            cell.polygons.corners.iter().map(|corner| projections(corner.at)).collect();
        let before = self.measure.of(Extent::of(&cell.tribox));
        let mut best: Option<Choice> = None;
        let slabs = match self.planes {
            Planes::Thickest => vec![(thickest(cell), 1)],
            Planes::Nine(count) | Planes::Extrema(count) => {
                (0..SLABS).map(|slab| (slab, count)).collect()
            }
        };
        for (slab, count) in slabs {
            if !self.watch.goes_on(0.0) {
                return None;
            }
            let planes = self.candidates(cell, slab, count);
            for (at, parts) in planes.iter().zip(self.sides(whole, cell, &corners, slab, &planes)) {
                if parts.iter().any(Span::is_empty) {
                    continue;
                }
                let after: f64 =
                    parts.iter().map(|part| self.measure.of(Extent::of_span(part))).sum();
                let gain = before - after;
                if best.is_none_or(|best| gain > best.gain) {
                    best = Some(Choice { slab, at: *at, now: gain, gain });
                }
            }
        }
        best
    }

    /// Planes of a slab that are tried, ascending: evenly, and just beyond extrema.
    fn candidates(&self, cell: &Cell, slab: usize, count: u32) -> Vec<f64> {
        let mut planes = self.evenly(cell, slab, count);
        if let Some(extrema) = self.extrema {
            let (low, high) = (f64::from(cell.tribox.low[slab]), f64::from(cell.tribox.high[slab]));
            let found = extrema.planes(&cell.tribox, slab, self.unit);
            planes.extend(found.into_iter().filter(|&at| low < at && at < high));
            planes.sort_by(f64::total_cmp);
            planes.dedup();
        }
        planes
    }

    /// Planes of a slab, evenly but on multiples of the unit, strictly inside of the cell's tribox;
    /// ascending.
    fn evenly(&self, cell: &Cell, slab: usize, count: u32) -> Vec<f64> {
        let (low, high) = (f64::from(cell.tribox.low[slab]), f64::from(cell.tribox.high[slab]));
        let part = |i: u32| f64::from(i) / f64::from(count + 1);
        let plane = |i: u32| ((low + part(i) * (high - low)) / self.unit).round() * self.unit;
        let mut planes: Vec<f64> =
            (1..=count).map(plane).filter(|&at| low < at && at < high).collect();
        planes.dedup();
        planes
    }

    /// For each of the ascending planes, bounds of the cell's parts on both sides, up to rounding.
    fn sides(
        &self,
        whole: &Whole<'_>,
        cell: &Cell,
        corners: &[[f64; SLABS]],
        slab: usize,
        planes: &[f64],
    ) -> Vec<[Span; 2]> {
        let mut layers = layers(cell, corners, slab, planes);
        let layer =
            |along: &[f64; SLABS]| planes.iter().take_while(|&&at| along[slab] > at).count();
        for &vertex in
            cell.frame.vertices.iter().filter(|&&vertex| whole.is_inside(cell, vertex, self.trust))
        {
            let along = projections(vertex);
            layers[layer(&along)].add(&along);
        }
        let mut sides = vec![[Span::EMPTY; 2]; planes.len()];
        let mut below = Span::EMPTY;
        for (side, layer) in sides.iter_mut().zip(&layers) {
            below.unite(layer);
            side[0] = below;
        }
        let mut above = Span::EMPTY;
        for (side, layer) in sides.iter_mut().zip(&layers[1..]).rev() {
            above.unite(layer);
            side[1] = above;
        }
        if whole.is_solid {
            for (side, &at) in sides.iter_mut().zip(planes) {
                for vertex in section(&cell.frame, slab, at) {
                    let along = projections(vertex);
                    if !side.iter().all(|part| part.holds(&along))
                        && whole.is_inside(cell, vertex, self.trust)
                    {
                        side.iter_mut().for_each(|part| part.add(&along));
                    }
                }
            }
        }
        sides
    }
}

fn thickest(cell: &Cell) -> usize {
    let thickness = |slab: usize| {
        let between = f64::from(cell.tribox.high[slab]) - f64::from(cell.tribox.low[slab]);
        between * if slab < 3 { 1.0 } else { std::f64::consts::FRAC_1_SQRT_2 }
    };
    (1..SLABS).fold(0, |most, slab| if thickness(slab) > thickness(most) { slab } else { most })
}

/// Bounds of the surface below the first plane, between it and the second, and so on.
fn layers(cell: &Cell, corners: &[[f64; SLABS]], slab: usize, planes: &[f64]) -> Vec<Span> {
    let mut layers = vec![Span::EMPTY; planes.len() + 1];
    let mut begin = 0;
    for &(_, end) in &cell.polygons.loops {
        let corners = &corners[begin..end as usize];
        begin = end as usize;
        let Some(mut from) = corners.last() else { continue };
        let layer =
            |along: &[f64; SLABS]| planes.iter().take_while(|&&at| along[slab] > at).count();
        let mut from_layer = layer(from);
        for to in corners {
            let to_layer = layer(to);
            layers[to_layer].add(to);
            for passed in from_layer.min(to_layer)..from_layer.max(to_layer) {
                let t = (planes[passed] - from[slab]) / (to[slab] - from[slab]);
                let mut crossing = [0.0; SLABS];
                crossing.iter_mut().zip(from).zip(to).for_each(|((x, a), b)| *x = a + t * (b - a));
                layers[passed].add(&crossing);
                layers[passed + 1].add(&crossing);
            }
            (from, from_layer) = (to, to_layer);
        }
    }
    layers
}
