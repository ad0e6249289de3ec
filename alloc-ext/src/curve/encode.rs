//! Curves as a section of a blob.

use super::build::nodes;
use super::read::Polyline;
use crate::clock::Instant;
use crate::emit::Sections;
use crate::error::{BuildError, CurveError};
use crate::geom::Bounds;
use crate::progress::{Stage, Watch};
use crate::surface::{Grid, fitting_grid, split_exponent};
use glam::DVec3;
use meshsweep_core::internal::curve::format::CurvesHeader;
use meshsweep_core::internal::curve::format::layout::{
    CURVES_F32, CURVES_PLANAR, MAX_POINTS, POLYLINE_CLOSED, ZONE_EXCLUSION, ZONE_INCLUSION,
};
use meshsweep_core::internal::format::layout::VertexFormat;
use meshsweep_core::internal::geom::Aabb;
use meshsweep_core::internal::num::{exp2, up_to_f32};
use meshsweep_core::{SectionKind, Zone};
use robust::{Coord, orient2d};
use std::time::Duration;

/// How points are stored.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CurveOptions {
    /// Whether as f32, instead of on a grid of 16 bits.
    pub is_f32: bool,
}

/// What was stored.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct CurveReport {
    /// Segments, the closing ones included.
    pub segments: usize,
    /// Segments without length: points that repeat the point before. They are kept.
    pub repeated: usize,
    /// The first closed polyline of the plane that crosses itself, if it has no more than
    /// [`LOOKED_AT`](Self::LOOKED_AT) points.
    pub crossed: Option<usize>,
    /// Time of the build.
    pub time: Duration,
}

impl CurveReport {
    /// Points of a polyline up to which it is looked at whether it crosses itself.
    pub const LOOKED_AT: usize = 2000;
}

/// Whether two segments of a closed polyline cross in the plane, by exact predicates.
fn crosses_itself(polyline: &Polyline) -> bool {
    let points = &polyline.points;
    if !polyline.is_closed || points.len() > CurveReport::LOOKED_AT {
        return false;
    }
    let at = |k: usize| {
        let p = points[k % points.len()];
        Coord { x: p[0], y: p[1] }
    };
    let is_across = |[a, b]: [Coord<f64>; 2], [c, d]: [Coord<f64>; 2]| {
        let [of_c, of_d] = [orient2d(a, b, c), orient2d(a, b, d)];
        (of_c > 0.0 && of_d < 0.0) || (of_c < 0.0 && of_d > 0.0)
    };
    let segment = |k: usize| [at(k), at(k + 1)];
    (0..points.len()).any(|i| {
        let one = segment(i);
        (i + 2..points.len()).map(segment).any(|s| is_across(one, s) && is_across(s, one))
    })
}

/// Stores polylines. Segments keep the numbers of the input. If all points have z = 0, z is not
/// stored. Zones are stored if one is an exclusion zone.
///
/// Cost: points times the depth of the hierarchy, about 2·log₂ of the points.
///
/// # Errors
/// [`BuildError::Curve`] if a polyline has fewer than two points, a coordinate is not finite in
/// f32, an exclusion zone is not closed, or the points are too many or all tiny.
pub fn build(
    polylines: &[Polyline],
    options: &CurveOptions,
    watch: Watch<'_>,
) -> Result<(Sections, CurveReport), BuildError> {
    let watch = watch.during(Stage::Curve);
    watch.step(0, 1)?;
    let started = Instant::now();
    let (points, table) = joined(polylines)?;
    let largest = points.iter().fold(0f64, |most, point| most.max(point.abs().max_element()));
    if largest > 0.0 && largest < f64::from(f32::MIN_POSITIVE) {
        return Err(CurveError::TooSmall { largest }.into());
    }
    let (_, scale_exponent) = split_exponent(largest);
    let local: Vec<DVec3> = points.iter().map(|&point| point * exp2(-scale_exponent)).collect();
    let grid = (!options.is_f32).then(|| fitting_grid(&local, VertexFormat::Grid16)).flatten();
    let grid = grid.unwrap_or(Grid::F32);
    let stored: Vec<DVec3> = local.iter().map(|&p| grid.round(p).unwrap_or(p)).collect();
    let moved = local.iter().zip(&stored).fold(0f64, |most, (a, &b)| most.max((b - a).length()));
    // Reading rounded the decimals to f64, by half a unit in the last place per axis.
    let surface_error = moved * (1.0 + 1e-15) + f64::EPSILON;
    let is_planar = stored.iter().all(|point| point.z == 0.0);
    let (nodes, depth) = nodes(&stored, watch);
    watch.check()?;
    let is_f32 = grid.format == VertexFormat::F32;
    let header = CurvesHeader {
        flags: if is_planar { CURVES_PLANAR } else { 0 } | if is_f32 { CURVES_F32 } else { 0 },
        grid_exponent: grid.exponent,
        grid_origin: grid.origin,
        points: stored.len() as u32,
        polylines: table.len() as u32,
        depth,
    };
    let mut section = header.write().to_vec();
    section.extend(table.iter().flat_map(|record| record.to_le_bytes()));
    let origin = DVec3::from(grid.origin.map(f64::from));
    for &point in &stored {
        let units = point * exp2(-grid.exponent) - origin;
        for axis in 0..header.dimensions() {
            if is_f32 {
                section.extend((point[axis] as f32).to_le_bytes());
            } else {
                // Exact: the point is on the grid.
                section.extend((units[axis] as u16).to_le_bytes());
            }
        }
    }
    for node in &nodes {
        for index in [node.first, node.last] {
            section.extend(&(index as u32).to_le_bytes()[..header.index_bytes()]);
        }
        section.extend(node.radius.0.to_le_bytes());
    }
    let Bounds { low, high } = Bounds::of(&stored);
    let bounds = Aabb { min: low.as_vec3(), max: high.as_vec3() };
    let mut bodies = vec![(SectionKind::Curves, section)];
    if polylines.iter().any(|polyline| polyline.zone != Zone::Inclusion) {
        bodies.push((SectionKind::CurveZones, polylines.iter().map(zone_byte).collect()));
    }
    let sections = Sections::new(scale_exponent, up_to_f32(surface_error), 0, bounds, bodies);
    let ends = |polyline: usize| table.get(polyline + 1).map_or(points.len(), |next| start(*next));
    let repeated = (0..table.len())
        .flat_map(|polyline| points[start(table[polyline])..ends(polyline)].windows(2))
        .filter(|pair| pair[0] == pair[1])
        .count();
    let segments = points.len() - table.len();
    let crossed = if is_planar { polylines.iter().position(crosses_itself) } else { None };
    Ok((sections, CurveReport { segments, repeated, crossed, time: started.elapsed() }))
}

/// A polyline's byte in the section of zones.
fn zone_byte(polyline: &Polyline) -> u8 {
    if polyline.zone == Zone::Inclusion { ZONE_INCLUSION } else { ZONE_EXCLUSION }
}

/// First point of a polyline's record.
fn start(record: u32) -> usize {
    (record & !POLYLINE_CLOSED) as usize
}

/// The points of all polylines, and the record of each. A closed polyline ends with its first
/// point.
fn joined(polylines: &[Polyline]) -> Result<(Vec<DVec3>, Vec<u32>), CurveError> {
    let (mut points, mut table) = (Vec::new(), Vec::new());
    for (polyline, Polyline { points: given, is_closed, zone }) in polylines.iter().enumerate() {
        let finite = given.iter().flatten().all(|&x| (x as f32).is_finite());
        if given.len() < 2 || !finite {
            return Err(CurveError::Polyline { polyline });
        }
        let record = points.len() as u32;
        points.extend(given.iter().map(|&point| DVec3::from(point)));
        if *is_closed && given.first() != given.last() {
            points.push(DVec3::from(given[0]));
        }
        // The place tells whether it is closed, whatever made it so.
        let closed = given.len() > 2 && points.last() == points.get(record as usize);
        let closed = closed || *is_closed;
        if !closed && *zone != Zone::Inclusion {
            return Err(CurveError::OpenZone { polyline });
        }
        table.push(record | if closed { POLYLINE_CLOSED } else { 0 });
        if points.len() >= MAX_POINTS as usize {
            return Err(CurveError::TooMany { points: points.len() });
        }
    }
    if points.is_empty() { Err(CurveError::NoPoints) } else { Ok((points, table)) }
}
