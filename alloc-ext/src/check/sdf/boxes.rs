//! The proof of a cell, by boxes that are halved until each is proved.
//!
//! *Away from the surface.* The distance of a triangle is convex, so over a box with the centre c it
//! is at least d + n·(x − c), n the unit vector from the triangle's nearest point to c. The distance
//! of the surface is the least of those. It is at most |x − q|, q any point of the surface: convex
//! too, so the eight corners bound it against a linear function. The side is the same all over the
//! box, for the surface does not cross it.
//!
//! *Across the surface.* Let all of the surface within 4r of c, the box's half diagonal being r, lie
//! within δ ≤ r/2 of a plane through the nearest point, with the winding numbers 0 above and 1
//! below. A point x of the box at height t: from above the plane's slab the way down meets the
//! surface, from below the way up does, both within the ball. The nearest point of the surface is
//! in the ball, hence in the slab. So the signed distance is between t − δ and t + δ.
//!
//! *Else* the distance is at most d + r.

use super::parse::{CELL, Field, Trilinear};
use super::sides::{Side, Sides};
use glam::DVec3;

/// What rounding may do to any number of a box, units: lengths below 2^21, a hundred roundings of
/// 2^-53 each.
const MARGIN: f64 = 1.0 / (1 << 24) as f64;

/// Boxes of no larger radius than this part of a cell's are not halved: a claim without slack is
/// not proved.
const SMALLEST: f64 = 1.0 / 16_384.0;

/// Boxes of one cell.
const MOST: usize = 20_000_000;

/// Why a field is not proved.
pub(super) enum Unproved {
    /// A claim is wrong, or the bytes are.
    Wrong(String),
    /// Boxes ran out.
    Open(String),
}

/// Triangles by the cells that they come near.
pub(super) struct Grid {
    cells: [usize; 3],
    /// Those whose box meets each cell.
    of: Vec<Vec<u32>>,
}

impl Grid {
    pub(super) fn new(triangles: &[[DVec3; 3]], cells: [usize; 3]) -> Self {
        let mut of = vec![Vec::new(); cells.into_iter().product()];
        for (number, corners) in (0..).zip(triangles) {
            let first = (DVec3::INFINITY, DVec3::NEG_INFINITY);
            let (low, high) =
                corners.iter().fold(first, |(low, high), &p| (low.min(p), high.max(p)));
            let span = |k: usize| {
                let last = cells[k] - 1;
                ((low[k] / CELL) as usize).min(last)..=((high[k] / CELL) as usize).min(last)
            };
            for z in span(2) {
                for y in span(1) {
                    for x in span(0) {
                        of[(z * cells[1] + y) * cells[0] + x].push(number);
                    }
                }
            }
        }
        Self { cells, of }
    }

    /// Triangles that may be nearest somewhere in a cell, and all within twice its diagonal of its
    /// centre: shells of cells are looked at until the next is too far.
    fn near(&self, number: usize, centre: DVec3, triangles: &[[DVec3; 3]]) -> Vec<u32> {
        let [cx, cy, cz] = self.cells;
        let at = [number % cx, number / cx % cy, number / (cx * cy)].map(|n| n as isize);
        let radius = 0.5 * 3f64.sqrt() * CELL;
        let (mut found, mut least) = (Vec::<(u32, f64)>::new(), f64::INFINITY);
        for shell in 0..cx.max(cy).max(cz) as isize {
            // What lies beyond the shells before is at least so far from the centre.
            let away = (shell as f64 - 0.5) * CELL;
            if away > (least + 2.0 * radius).max(4.0 * radius) {
                break;
            }
            for z in at[2] - shell..=at[2] + shell {
                for y in at[1] - shell..=at[1] + shell {
                    for x in at[0] - shell..=at[0] + shell {
                        let farthest = (z - at[2]).abs().max((y - at[1]).abs());
                        let is_in = |n: isize, cells: usize| (0..cells as isize).contains(&n);
                        if farthest.max((x - at[0]).abs()) != shell
                            || !(is_in(x, cx) && is_in(y, cy) && is_in(z, cz))
                        {
                            continue;
                        }
                        for &t in &self.of[((z as usize * cy) + y as usize) * cx + x as usize] {
                            let d = foot(centre, triangles[t as usize]).distance(centre);
                            least = least.min(d);
                            found.push((t, d));
                        }
                    }
                }
            }
        }
        let most = (least + 2.0 * radius).max(4.0 * radius) + MARGIN;
        let mut near: Vec<u32> =
            found.iter().filter(|(_, d)| *d <= most).map(|(t, _)| *t).collect();
        near.sort_unstable();
        near.dedup();
        near
    }
}

/// The point of a triangle that is nearest to a point: the foot on its plane if that lies inside of
/// three half-planes, else the nearest point of an edge.
fn foot(p: DVec3, [a, b, c]: [DVec3; 3]) -> DVec3 {
    let normal = (b - a).cross(c - a);
    let square = normal.length_squared();
    let inside = |from: DVec3, to: DVec3| (to - from).cross(normal).dot(p - from) <= 0.0;
    if square > 0.0 && inside(a, b) && inside(b, c) && inside(c, a) {
        return p - normal * (normal.dot(p - a) / square);
    }
    let on_edge = |from: DVec3, to: DVec3| {
        let way = to - from;
        let square = way.length_squared();
        let t = if square > 0.0 { (way.dot(p - from) / square).clamp(0.0, 1.0) } else { 0.0 };
        from + way * t
    };
    let [x, y, z] = [on_edge(a, b), on_edge(b, c), on_edge(c, a)];
    let nearer = |s: DVec3, t: DVec3| {
        if p.distance_squared(t) < p.distance_squared(s) { t } else { s }
    };
    nearer(nearer(x, y), z)
}

/// A box: centre, half sides, and its side if the surface does not cross it.
struct Part {
    centre: DVec3,
    half: DVec3,
    side: Option<Side>,
    near: Vec<u32>,
}

/// A triangle seen from a box's centre.
struct Seen {
    triangle: u32,
    foot: DVec3,
    /// Unit vector from the foot to the centre; zero at the surface.
    away: DVec3,
    distance: f64,
}

/// The function of a cell about a box's centre, with its errors.
struct About {
    value: f64,
    gradient: DVec3,
    rest: f64,
    low: f64,
    high: f64,
}

/// A cell of a field.
pub(super) struct Cell<'a> {
    pub(super) field: &'a Field,
    pub(super) sides: Option<&'a Sides>,
    /// How far the file's surface may be from the mesh's.
    pub(super) moved: f64,
}

impl Cell<'_> {
    /// Proves it. Returns the number of boxes.
    pub(super) fn prove(
        &self,
        number: usize,
        triangles: &[[DVec3; 3]],
        grid: &Grid,
    ) -> Result<usize, Unproved> {
        let (corner, function, [low, high]) = self.field.cell(number);
        let [low, high] = [low, high].map(|error| error - self.moved - MARGIN);
        let half = DVec3::splat(0.5 * CELL);
        let centre = corner + half;
        let near = grid.near(number, centre, triangles);
        let mut open = vec![Part { centre, half, side: None, near }];
        let mut boxes = 0;
        while let Some(part) = open.pop() {
            boxes += 1;
            let seen: Vec<Seen> = part
                .near
                .iter()
                .map(|&triangle| {
                    let foot = foot(part.centre, triangles[triangle as usize]);
                    let (away, distance) = (part.centre - foot, foot.distance(part.centre));
                    let away = if distance > MARGIN { away / distance } else { DVec3::ZERO };
                    Seen { triangle, foot, away, distance }
                })
                .collect();
            let about = About::of(&function, part.centre - corner, part.half, [low, high]);
            let side = match self.side(&part, &seen, &about, triangles) {
                Ok(side) => side,
                Err(()) => continue,
            };
            let r = part.half.length();
            if r <= SMALLEST * CELL {
                let at = part.centre;
                return Err(Unproved::Wrong(format!(
                    "the errors of cell {number} are not proved at {at:?}, in units of the field"
                )));
            }
            if boxes >= MOST {
                return Err(Unproved::Open(format!("cell {number} takes more than {MOST} boxes")));
            }
            let least = seen.iter().fold(f64::INFINITY, |least, seen| least.min(seen.distance));
            let most = (least + 2.0 * r).max(4.0 * r) + MARGIN;
            let near: Vec<u32> =
                seen.iter().filter(|s| s.distance <= most).map(|s| s.triangle).collect();
            open.extend(halves(&part, side, near));
        }
        Ok(boxes)
    }

    /// Proves a box, which is `Err(())`; else the side of all of it, if it has one.
    fn side(
        &self,
        part: &Part,
        seen: &[Seen],
        about: &About,
        triangles: &[[DVec3; 3]],
    ) -> Result<Option<Side>, ()> {
        let r = part.half.length();
        let Some(nearest) = seen.iter().min_by(|s, t| s.distance.total_cmp(&t.distance)) else {
            return Ok(None);
        };
        let done = |is_proved: bool, side: Option<Side>| if is_proved { Err(()) } else { Ok(side) };
        let Some(sides) = self.sides else {
            let is_proved = about.is_above_low(part.half, seen, 1.0)
                && about.is_below_high(part.half, part.centre, nearest.foot, 1.0);
            return done(is_proved, None);
        };
        let is_solid = self.field.is_solid();
        let outside = || {
            about.is_above_low(part.half, seen, 1.0)
                && about.is_below_high(part.half, part.centre, nearest.foot, 1.0)
        };
        let inside = || {
            if is_solid {
                return about.is_at_most_zero(part.half);
            }
            about.is_above_low_inside(part.half, part.centre, nearest.foot)
                && about.is_below_high_inside(part.half, seen)
        };
        if nearest.distance > r + MARGIN {
            let side = part.side.unwrap_or_else(|| sides.at(part.centre));
            let is_proved = match side {
                Side::Outside => outside(),
                Side::Inside => inside(),
                Side::Both => outside() && inside(),
            };
            return done(is_proved, Some(side));
        }
        let most = nearest.distance + r;
        let lipschitz = {
            let lower = if is_solid { 0.0 } else { -most };
            about.greatest(part.half) - about.low <= lower
                && about.least(part.half) + about.high >= most
        };
        if lipschitz {
            return Err(());
        }
        let Some((normal, delta)) = slab(r, nearest, seen, triangles) else {
            return Ok(None);
        };
        // Height of the centre, and of the box against the function.
        let t = normal.dot(part.centre - nearest.foot);
        let is_low = about.value + about.rest - about.low - (t - delta)
            + (about.gradient - normal).abs().dot(part.half)
            <= 0.0
            || (is_solid && about.is_at_most_zero(part.half));
        let is_high = (t + delta) - (about.value - about.rest + about.high)
            + (about.gradient - normal).abs().dot(part.half)
            <= 0.0;
        if !(is_low && is_high) {
            return Ok(None);
        }
        let at = |way: f64| sides.at(part.centre + normal * way);
        done(at(2.0 * r) == Side::Outside && at(-2.0 * r) == Side::Inside, None)
    }
}

/// A plane's unit normal, and how far from the plane through the nearest point all of the surface
/// within four radii of a centre is, if that is at most half a radius.
fn slab(r: f64, nearest: &Seen, seen: &[Seen], triangles: &[[DVec3; 3]]) -> Option<(DVec3, f64)> {
    let normal_of = |triangle: u32| {
        let [a, b, c] = triangles[triangle as usize];
        (b - a).cross(c - a).try_normalize()
    };
    let normal = normal_of(nearest.triangle)?;
    let mut delta = 0f64;
    for s in seen.iter().filter(|s| s.distance <= 4.0 * r + MARGIN) {
        let corners = triangles[s.triangle as usize];
        let height = |p: DVec3| normal.dot(p - nearest.foot).abs();
        let of_corners = corners.iter().fold(0f64, |most, &p| most.max(height(p)));
        // Of points of the triangle in the ball, none is farther than eight radii from another.
        let slope = normal_of(s.triangle).map_or(1.0, |own| normal.cross(own).length());
        delta = delta.max(of_corners.min(height(s.foot) + 8.0 * r * slope));
    }
    let delta = delta + MARGIN;
    (delta <= 0.5 * r).then_some((normal, delta))
}

impl About {
    fn of(function: &Trilinear, place: DVec3, half: DVec3, [low, high]: [f64; 2]) -> Self {
        let (value, gradient, rest) = function.about(place, half);
        Self { value, gradient, rest, low, high }
    }

    /// The greatest value in the box.
    fn greatest(&self, half: DVec3) -> f64 {
        self.value + self.rest + self.gradient.abs().dot(half)
    }

    /// The least value in the box.
    fn least(&self, half: DVec3) -> f64 {
        self.value - self.rest - self.gradient.abs().dot(half)
    }

    fn is_at_most_zero(&self, half: DVec3) -> bool {
        self.greatest(half) - self.low <= 0.0
    }

    /// The least that `sign` times the function is above or below the distance of all triangles.
    fn margin(&self, half: DVec3, seen: &[Seen], sign: f64) -> f64 {
        seen.iter().fold(f64::INFINITY, |least, s| {
            let against = (s.away - self.gradient * sign).abs().dot(half);
            least.min(s.distance - against)
        }) - sign * self.value
            - self.rest
    }

    /// Function less the error below is at most the distance.
    fn is_above_low(&self, half: DVec3, seen: &[Seen], sign: f64) -> bool {
        self.margin(half, seen, sign) + self.low >= 0.0
    }

    /// Minus the distance is at most the function and the error above.
    fn is_below_high_inside(&self, half: DVec3, seen: &[Seen]) -> bool {
        self.margin(half, seen, -1.0) + self.high >= 0.0
    }

    /// The most that the distance from a point of the surface is above `sign` times the function.
    fn excess(&self, half: DVec3, centre: DVec3, foot: DVec3, sign: f64) -> f64 {
        let corners = (0..8).map(|k| {
            let way = DVec3::new(
                if k & 1 == 0 { -half.x } else { half.x },
                if k & 2 == 0 { -half.y } else { half.y },
                if k & 4 == 0 { -half.z } else { half.z },
            );
            (centre + way).distance(foot) - sign * self.gradient.dot(way)
        });
        corners.fold(f64::NEG_INFINITY, f64::max) - sign * self.value + self.rest
    }

    /// The distance is at most the function and the error above.
    fn is_below_high(&self, half: DVec3, centre: DVec3, foot: DVec3, sign: f64) -> bool {
        self.excess(half, centre, foot, sign) <= self.high
    }

    /// Function less the error below is at most minus the distance.
    fn is_above_low_inside(&self, half: DVec3, centre: DVec3, foot: DVec3) -> bool {
        self.excess(half, centre, foot, -1.0) <= self.low
    }
}

/// Both halves of a box along its longest side.
fn halves(part: &Part, side: Option<Side>, near: Vec<u32>) -> [Part; 2] {
    let axis = (0..3).max_by(|&i, &j| part.half[i].total_cmp(&part.half[j])).unwrap_or(0);
    let mut half = part.half;
    half[axis] *= 0.5;
    let mut way = DVec3::ZERO;
    way[axis] = half[axis];
    let other = near.clone();
    [
        Part { centre: part.centre - way, half, side, near },
        Part { centre: part.centre + way, half, side, near: other },
    ]
}
