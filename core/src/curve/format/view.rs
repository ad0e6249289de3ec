//! Checked views of polygonal curves and of the hierarchy over them (Guéziec 2000, section 3.1).
//!
//! The points of all polylines follow each other. Node 0 covers all of them. A node covers the
//! points `first ..= last` and splits them at a point that both children hold; runs of two points
//! are segments and have no node. A segment between two polylines is a *gap*: no part of a curve.
//!
//! If [`Curve::open`] returned `Ok`, then every node but the root is the child of exactly one node,
//! runs are as said, no more than `depth` nodes lie above a segment, and every point lies in the
//! box of the blob. Accessors return `Option` all the same. No path can panic.

use super::layout::{
    CURVES_BYTES, CURVES_F32, CURVES_PLANAR, POLYLINE_BYTES, POLYLINE_CLOSED, ZONE_EXCLUSION, field,
};
use crate::format::layout::{SectionKind, index_bytes};
use crate::format::{Bytes, OpenError};
use crate::geom::Aabb;
use crate::num::{Radius16, Real, down_to_f32};
use crate::query::Frame;
use glam::Vec3;

/// The header of the curves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CurvesHeader {
    /// [`CURVES_PLANAR`], [`CURVES_F32`].
    pub flags: u32,
    /// Grid: local coordinate = (stored + origin) × 2^this.
    pub grid_exponent: i32,
    /// Grid: added to the stored integers.
    pub grid_origin: [i32; 3],
    /// Points of all polylines.
    pub points: u32,
    /// Polylines.
    pub polylines: u32,
    /// Most nodes on the way from the root to a segment, both ends counted.
    pub depth: u32,
}

impl CurvesHeader {
    pub(crate) fn read(bytes: Bytes<'_>) -> Result<CurvesHeader, OpenError> {
        let short = OpenError::Record { section: SectionKind::Curves, index: 0 };
        let word = |at: usize| bytes.u32(at).ok_or(short);
        Ok(CurvesHeader {
            flags: word(field::FLAGS)?,
            grid_exponent: word(field::GRID_EXPONENT)?.cast_signed(),
            grid_origin: [
                word(field::GRID_ORIGIN)?.cast_signed(),
                word(field::GRID_ORIGIN + 4)?.cast_signed(),
                word(field::GRID_ORIGIN + 8)?.cast_signed(),
            ],
            points: word(field::POINTS)?,
            polylines: word(field::POLYLINES)?,
            depth: word(field::DEPTH)?,
        })
    }

    /// Writes the header.
    pub fn write(&self) -> [u8; CURVES_BYTES] {
        let [x, y, z] = self.grid_origin.map(i32::cast_unsigned);
        let exponent = self.grid_exponent.cast_unsigned();
        let words = [self.flags, exponent, x, y, z, self.points, self.polylines, self.depth];
        let mut out = [0u8; CURVES_BYTES];
        out.iter_mut()
            .zip(words.into_iter().flat_map(u32::to_le_bytes))
            .for_each(|(slot, byte)| *slot = byte);
        out
    }

    /// Coordinates of a stored point.
    pub fn dimensions(&self) -> usize {
        if self.flags & CURVES_PLANAR != 0 { 2 } else { 3 }
    }

    /// Whether coordinates are f32.
    pub fn is_f32(&self) -> bool {
        self.flags & CURVES_F32 != 0
    }

    /// Bytes of a point.
    pub fn point_bytes(&self) -> usize {
        self.dimensions() * if self.is_f32() { 4 } else { 2 }
    }

    /// Bytes of the number of a point.
    pub fn index_bytes(&self) -> usize {
        index_bytes(self.points as usize)
    }

    /// Bytes of a node.
    pub fn node_bytes(&self) -> usize {
        2 * self.index_bytes() + 2
    }

    /// Nodes: one for each point that is not an end of all.
    pub fn nodes(&self) -> u32 {
        self.points.saturating_sub(2)
    }
}

/// A segment of a curve. Both numbers count from 0, in the order of the input file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct CurveSegment {
    /// The polyline.
    pub polyline: u32,
    /// The segment of the polyline. It begins at the polyline's point of this number. The last
    /// segment of a closed polyline ends at its first point.
    pub segment: u32,
}

/// Which side of a closed polyline is allowed, as autopilots mark the polygons of a geofence.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Zone {
    /// Its inside.
    #[default]
    Inclusion,
    /// Its outside.
    Exclusion,
}

/// Points that follow each other, and the capsule that holds the segments between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Run {
    /// The number of the node; for a segment, nodes + first point.
    pub(crate) item: u32,
    pub(crate) first: u32,
    pub(crate) last: u32,
    pub(crate) radius: f32,
}

/// A node as stored.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Node {
    pub(crate) first: u32,
    pub(crate) last: u32,
    pub(crate) radius: f32,
}

/// The polygonal curves of a blob: fences, tool paths. Copies are cheap: it borrows the bytes.
#[derive(Clone, Copy, Debug)]
pub struct Curve<'a> {
    pub(crate) header: CurvesHeader,
    pub(crate) frame: Frame,
    pub(crate) bounds: Aabb,
    /// Local units of the grid's unit.
    pub(crate) unit: f32,
    pub(crate) polylines: &'a [[u8; POLYLINE_BYTES]],
    pub(crate) points: Bytes<'a>,
    pub(crate) nodes: Bytes<'a>,
    /// One byte for each polyline; none if all are inclusion zones.
    pub(crate) zones: &'a [u8],
}

impl Curve<'_> {
    /// Number of polylines, at least one.
    pub fn polyline_count(&self) -> u32 {
        self.header.polylines
    }

    /// Number of segments of all polylines, at least one.
    pub fn segment_count(&self) -> u32 {
        self.header.points.saturating_sub(self.header.polylines)
    }

    /// Whether all points have z = 0. Queries have three coordinates all the same.
    pub fn is_planar(&self) -> bool {
        self.header.flags & CURVES_PLANAR != 0
    }

    /// Whether the last point of a polyline is its first. `None`: there is no such polyline.
    pub fn is_closed(&self, polyline: u32) -> Option<bool> {
        let record = self.polylines.get(polyline as usize)?;
        Some(u32::from_le_bytes(*record) & POLYLINE_CLOSED != 0)
    }

    /// Which side of a polyline is allowed, if it is closed. `None`: there is no such polyline.
    pub fn zone(&self, polyline: u32) -> Option<Zone> {
        if polyline >= self.header.polylines {
            return None;
        }
        match self.zones.get(polyline as usize) {
            Some(&ZONE_EXCLUSION) => Some(Zone::Exclusion),
            _ => Some(Zone::Inclusion),
        }
    }

    /// With this many scratch entries no question ends for lack of memory.
    pub fn scratch_entries(&self) -> usize {
        (self.header.depth as usize).max(1)
    }

    /// No point of the input curve is farther than this from the stored one, nor the other way
    /// round, input units.
    pub fn surface_error(&self) -> f32 {
        self.frame.upper(0.0)
    }

    /// Least and greatest corner of the box of all points, input units.
    pub fn bounds(&self) -> [[f32; 3]; 2] {
        self.bounds.corners().map(|corner| self.frame.point(Vec3::from_array(corner).as_dvec3()))
    }

    #[doc(hidden)]
    pub fn header(&self) -> &CurvesHeader {
        &self.header
    }

    /// A point, local frame.
    // One look at the flags and one record a point: a check of each coordinate costs as much as the
    // distance.
    #[inline(always)]
    pub(crate) fn point(&self, index: u32) -> Option<Vec3> {
        let [ox, oy, oz] = self.header.grid_origin;
        let place = |stored: [u8; 2], origin: i32| {
            origin.wrapping_add(i32::from(u16::from_le_bytes(stored))) as f32
        };
        let (x, y, z) = match self.header.flags & (CURVES_PLANAR | CURVES_F32) {
            0 => {
                let &[x, y, z] = self.points.record(index)?;
                (place(x, ox), place(y, oy), place(z, oz))
            }
            CURVES_PLANAR => {
                let &[x, y] = self.points.record(index)?;
                (place(x, ox), place(y, oy), 0.0)
            }
            CURVES_F32 => {
                let &[x, y, z] = self.points.record(index)?;
                return Some(Vec3::from_array([x, y, z].map(f32::from_le_bytes)));
            }
            _ => {
                let &[x, y] = self.points.record(index)?;
                return Some(Vec3::new(f32::from_le_bytes(x), f32::from_le_bytes(y), 0.0));
            }
        };
        // Exact: the integers are below 2^24, the unit is a power of two.
        Some(Vec3::new(x, y, z) * self.unit)
    }

    /// The coordinate of a point along an axis of the plane, 0 or 1, as an integer. The order of
    /// these integers is that of the coordinates.
    #[inline(always)]
    pub(crate) fn order(&self, index: u32, axis: usize) -> Option<i32> {
        let at = (index as usize).checked_mul(self.header.point_bytes())?;
        if self.header.is_f32() {
            self.points.f32(at.checked_add(4 * axis)?).map(|x| Real(x).order())
        } else {
            self.points.u16(at.checked_add(2 * axis)?).map(i32::from)
        }
    }

    /// The greatest of these integers whose coordinate is not above `x`, local frame, or any above
    /// all points.
    pub(crate) fn order_of(&self, x: f64, axis: usize) -> i32 {
        if self.header.is_f32() {
            return Real(down_to_f32(x)).order();
        }
        // A power of two: exact.
        let x = x / f64::from(self.unit);
        let whole = x as i32;
        let floor = whole.saturating_sub(i32::from(f64::from(whole) > x));
        let [ox, oy, _] = self.header.grid_origin;
        floor.saturating_sub(if axis == 0 { ox } else { oy })
    }

    #[inline(always)]
    pub(crate) fn node(&self, index: u32) -> Option<Node> {
        let short = |bytes| u32::from(u16::from_le_bytes(bytes));
        let (first, last, radius) = match self.header.index_bytes() {
            1 => {
                let &[[first, last], radius] = self.nodes.record(index)?;
                (u32::from(first), u32::from(last), radius)
            }
            2 => {
                let &[first, last, radius] = self.nodes.record(index)?;
                (short(first), short(last), radius)
            }
            width => return self.long_node(index, width),
        };
        Some(Node { first, last, radius: Radius16(u16::from_le_bytes(radius)).get() })
    }

    /// A node of more than 65,535 points.
    // A call: three bytes that are put together in line make the compiler put the numbers of all
    // widths together, byte by byte.
    #[inline(never)]
    fn long_node(&self, index: u32, width: usize) -> Option<Node> {
        let at = (index as usize).checked_mul(self.header.node_bytes())?;
        let second = at.checked_add(width)?;
        Some(Node {
            first: self.nodes.index(at, width)?,
            last: self.nodes.index(second, width)?,
            radius: Radius16(self.nodes.u16(second.checked_add(width)?)?).get(),
        })
    }

    /// The two runs that a node splits its points into.
    #[inline(always)]
    pub(crate) fn children(&self, index: u32) -> Option<[Run; 2]> {
        let Node { first, last, .. } = self.node(index)?;
        let after = index.checked_add(1)?;
        // The next record is that of the left run, or if the left run is a segment, another's.
        let (split, left) = match self.node(after) {
            Some(left) if left.first == first => (left.last, left.radius),
            _ => (first.checked_add(1)?, 0.0),
        };
        let nodes = self.header.nodes();
        let mut runs = [
            Run { item: nodes.checked_add(first)?, first, last: split, radius: left },
            Run { item: nodes.checked_add(split)?, first: split, last, radius: 0.0 },
        ];
        let [left, right] = &mut runs;
        if split.checked_sub(first)? > 1 {
            left.item = after;
        }
        if last.checked_sub(split)? > 1 {
            // The left run has as many nodes as points between its ends.
            right.item = index.checked_add(split.checked_sub(first)?)?;
            right.radius = self.node(right.item)?.radius;
        }
        Some(runs)
    }

    /// The first point of a polyline.
    fn start(record: &[u8; POLYLINE_BYTES]) -> u32 {
        u32::from_le_bytes(*record) & !POLYLINE_CLOSED
    }

    /// The first and the last point of a polyline. `None`: there is no such polyline.
    pub(crate) fn ends(&self, polyline: usize) -> Option<[u32; 2]> {
        let first = Self::start(self.polylines.get(polyline)?);
        let after = polyline.checked_add(1).and_then(|next| self.polylines.get(next));
        let last = after.map_or(self.header.points, Self::start).checked_sub(1)?;
        Some([first, last])
    }

    /// The polyline of a point.
    pub(crate) fn polyline_of(&self, point: u32) -> Option<usize> {
        self.polylines.partition_point(|record| Self::start(record) <= point).checked_sub(1)
    }

    /// The segment that begins at a point. `None` for a gap.
    pub(crate) fn segment_at(&self, point: u32) -> Option<CurveSegment> {
        let polyline = self.polyline_of(point)?;
        let [first, last] = self.ends(polyline)?;
        let segment =
            CurveSegment { polyline: polyline as u32, segment: point.checked_sub(first)? };
        (point < last).then_some(segment)
    }
}
