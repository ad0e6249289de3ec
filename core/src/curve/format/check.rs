//! Opening the curves of a blob, and the check.

use super::layout::{
    CURVES_BYTES, CURVES_F32, CURVES_PLANAR, MAX_CURVE_DEPTH, MAX_POINTS, POLYLINE_BYTES,
    POLYLINE_CLOSED, ZONE_EXCLUSION, ZONE_INCLUSION,
};
use super::view::{Curve, CurvesHeader, Node, Run};
use crate::format::Contradiction;
use crate::format::layout::SectionKind;
use crate::format::{Bytes, OpenError, SectionTable};
use crate::geom::Aabb;
use crate::num::exp2;
use crate::query::Frame;

/// Largest coordinate of the grid, so that it is exact in f32.
const MAX_GRID: i32 = 1 << 24;

impl<'a> Curve<'a> {
    /// Opens the curves of a blob where they lie, and checks all of them: CRC, every point, every
    /// node. Any bytes are safe to open. It reads no other sections, so that the code that checks
    /// them is not linked.
    ///
    /// Cost: linear in the points; no allocation; once per start. Alignment of `bytes` does not
    /// matter.
    ///
    /// # Errors
    /// [`OpenError`]; [`OpenError::MissingSection`] if the blob was built without curves.
    #[inline(never)]
    pub fn open(bytes: &'a [u8]) -> Result<Curve<'a>, OpenError> {
        let table = SectionTable::open(bytes)?;
        table.check_crcs(SectionKind::is_curve)?;
        let curve = Curve::locate(&table)?;
        curve.check()?;
        Ok(curve)
    }

    /// The curves of bytes that were checked before.
    pub(crate) fn view(bytes: &'a [u8]) -> Result<Curve<'a>, OpenError> {
        Curve::locate(&SectionTable::view(bytes)?)
    }

    fn locate(table: &SectionTable<'a>) -> Result<Curve<'a>, OpenError> {
        let blob = &table.header;
        let malformed = table.malformed(SectionKind::Curves);
        let data = table.bytes(SectionKind::Curves);
        let (head, rest) = data.split_at_checked(CURVES_BYTES).ok_or(malformed)?;
        let header = CurvesHeader::read(Bytes(head))?;
        if header.flags & !(CURVES_PLANAR | CURVES_F32) != 0 {
            return Err(OpenError::Reserved);
        }
        let wrong = |what: Contradiction| Err(OpenError::Counts { what });
        let CurvesHeader { points, polylines, .. } = header;
        if points >= MAX_POINTS || polylines == 0 || polylines > points / 2 {
            return wrong(Contradiction::CurvePoints);
        }
        if header.depth as usize > MAX_CURVE_DEPTH {
            return wrong(Contradiction::CurveNodes);
        }
        let least = |origin: i32| (-MAX_GRID..=MAX_GRID - 0xFFFF).contains(&origin);
        let fits =
            (-60..=0).contains(&header.grid_exponent) && header.grid_origin.into_iter().all(least);
        if !(header.is_f32() || fits) {
            return wrong(Contradiction::CurveGrid);
        }
        // The queries rely on the scale and on lengths of the local frame.
        let length = |x: f32| x.abs() <= 16.0;
        let sound = (-200..=200).contains(&blob.scale_exponent)
            && blob.surface_error >= 0.0
            && length(blob.surface_error)
            && blob.surface_box.iter().flatten().all(|&x| length(x));
        if !sound {
            return wrong(Contradiction::CurveRange);
        }
        let slices = || {
            let (table, rest) =
                rest.split_at_checked((polylines as usize).checked_mul(POLYLINE_BYTES)?)?;
            let (places, nodes) =
                rest.split_at_checked((points as usize).checked_mul(header.point_bytes())?)?;
            let whole = (header.nodes() as usize).checked_mul(header.node_bytes())?;
            (nodes.len() == whole).then_some((table, places, nodes))
        };
        let zones = table.bytes(SectionKind::CurveZones);
        if !zones.is_empty() && zones.len() != polylines as usize {
            return Err(table.malformed(SectionKind::CurveZones));
        }
        let (table, places, nodes) = slices().ok_or(malformed)?;
        Ok(Curve {
            header,
            frame: Frame::of(blob),
            bounds: Aabb::of(blob.surface_box),
            unit: exp2(header.grid_exponent.clamp(-60, 0)) as f32,
            polylines: table.as_chunks().0,
            points: Bytes(places),
            nodes: Bytes(nodes),
            zones,
        })
    }

    fn check(&self) -> Result<(), OpenError> {
        let bad = |index: u32| OpenError::Record { section: SectionKind::Curves, index };
        for index in 0..self.header.points {
            let point = self.point(index).ok_or(bad(index))?;
            let Aabb { min, max } = self.bounds;
            // NaN is in no box.
            if !(point.cmpge(min).all() && point.cmple(max).all()) {
                return Err(bad(index));
            }
        }
        self.check_polylines()?;
        self.check_zones()?;
        self.check_nodes()
    }

    /// Zones are of known kinds, and exclusion zones are closed.
    fn check_zones(&self) -> Result<(), OpenError> {
        for (index, &zone) in (0..).zip(self.zones) {
            let is_sound = match zone {
                ZONE_INCLUSION => true,
                ZONE_EXCLUSION => self.is_closed(index) == Some(true),
                _ => false,
            };
            if !is_sound {
                return Err(OpenError::Record { section: SectionKind::CurveZones, index });
            }
        }
        Ok(())
    }

    /// Polylines follow each other, each has two points at least, and closed ones end where they
    /// began.
    fn check_polylines(&self) -> Result<(), OpenError> {
        let bad = |index: u32| OpenError::Record { section: SectionKind::Curves, index };
        let words = || self.polylines.iter().map(|record| u32::from_le_bytes(*record));
        let starts = words().map(|word| word & !POLYLINE_CLOSED);
        let ends = starts.clone().skip(1).chain([self.header.points]);
        let mut before = 0;
        for (index, (word, (start, end))) in (0..).zip(words().zip(starts.zip(ends))) {
            let last = end.wrapping_sub(1);
            let closed = word & POLYLINE_CLOSED != 0;
            if start != before
                || start >= last
                || last >= self.header.points
                || (closed && self.point(start) != self.point(last))
            {
                return Err(bad(index));
            }
            before = end;
        }
        Ok(())
    }

    /// Node 0 covers all points. Every other node stores the run that its parent's split gives it,
    /// and nodes follow in the order of a descent, left before right.
    fn check_nodes(&self) -> Result<(), OpenError> {
        let bad = |index: u32| OpenError::Record { section: SectionKind::Curves, index };
        // Last points of the nodes above, and of the node itself.
        let mut path = [0u32; MAX_CURVE_DEPTH];
        let mut depth = 0usize;
        let mut deepest = 0;
        for index in 0..self.header.nodes() {
            let node = self.node(index).ok_or(bad(index))?;
            let is_root = index == 0;
            if is_root && (node.first, node.last) != (0, self.header.points.wrapping_sub(1)) {
                return Err(bad(index));
            }
            while let Some(&above) = depth.checked_sub(1).and_then(|top| path.get(top))
                && above <= node.first
            {
                depth -= 1;
            }
            *path.get_mut(depth).ok_or(bad(index))? = node.last;
            depth += 1;
            deepest = deepest.max(depth);
            let runs = self.children(index).ok_or(bad(index))?;
            let sound = |run: &Run| {
                // The record of a run that has a node.
                let stored = |node: Node| {
                    (node.first, node.last) == (run.first, run.last) && node.radius == run.radius
                };
                run.first < run.last
                    && (run.last - run.first == 1 || self.node(run.item).is_some_and(stored))
            };
            let finite = node.radius >= 0.0 && node.radius <= 64.0;
            if !(finite && runs.iter().all(sound)) {
                return Err(bad(index));
            }
        }
        if deepest == self.header.depth as usize {
            Ok(())
        } else {
            Err(OpenError::Counts { what: Contradiction::CurveDepth })
        }
    }
}
