//! The proof of a cell, by boxes that are halved until each is proved.
//!
//! *Away from the surface.* Along any unit vector n a triangle ends at one of its corners, so from
//! a point x it is at least as far as x is above the highest. Over a box with the centre c that is
//! h + n·(x − c), h the height of c. Taken along the way from a near point of the triangle to c, it
//! is the distance but for rounding, and it holds whatever rounding did to n. The distance of the
//! surface is the least of those. It is at most |x − q|, q any point of the surface, and at most
//! the distance of any triangle: both are convex, so the eight corners bound them against a linear
//! function. The side is the same all over the box, for the surface does not cross it.
//!
//! *Across the surface.* Let all of the surface within 4r of c, the box's half diagonal being r,
//! lie within δ ≤ r/2 of a plane through the nearest point, with the winding numbers 0 above and 1
//! below. A point x of the box at height t: from above the plane's slab the way down meets the
//! surface, from below the way up does, both within the ball. The nearest point of the surface is
//! in the ball, hence in the slab. So the signed distance is between t − δ and t + δ.
//!
//! *Else* the distance is at most that of the centre and r.

use super::function::Function;
use super::parse::{Claim, Field};
use super::sides::{Side, Sides};
use glam::DVec3;

/// What rounding may do to any number of a box, units: lengths below 2^21, a hundred sums and
/// products of 2^-53 each. No quotient is trusted: unit vectors and means of corners are as sound
/// if they are others.
const MARGIN: f64 = 1.0 / (1 << 24) as f64;

/// Boxes of this radius or less are not halved, units. A claim without slack stays unproved.
const SMALLEST: f64 = 0.125;

/// Boxes of one cell.
const MOST: usize = 20_000_000;

/// Why a field is not proved.
pub(super) enum Unproved {
    /// A claim is wrong, or the bytes are.
    Wrong(String),
    /// Boxes ran out.
    Open(String),
}

/// Most cells of the grid along its longest axis.
const FINEST: f64 = 48.0;

/// Triangles by the cells of a grid over the field that their boxes meet.
pub(super) struct Grid {
    /// Side of a cell, units.
    side: f64,
    cells: [usize; 3],
    /// Those whose box meets each cell.
    of: Vec<Vec<u32>>,
}

impl Grid {
    /// Of a field from 0 to this corner.
    pub(super) fn new(triangles: &[[DVec3; 3]], end: DVec3) -> Self {
        let side = end.max_element() / FINEST;
        let cells = end.to_array().map(|end| ((end / side).ceil() as usize).max(1));
        let mut of = vec![Vec::new(); cells.into_iter().product()];
        for (number, corners) in (0..).zip(triangles) {
            let first = (DVec3::INFINITY, DVec3::NEG_INFINITY);
            let (low, high) =
                corners.iter().fold(first, |(low, high), &p| (low.min(p), high.max(p)));
            let span = |k: usize| {
                let last = cells[k] - 1;
                ((low[k] / side) as usize).min(last)..=((high[k] / side) as usize).min(last)
            };
            for z in span(2) {
                for y in span(1) {
                    for x in span(0) {
                        of[(z * cells[1] + y) * cells[0] + x].push(number);
                    }
                }
            }
        }
        Self { side, cells, of }
    }

    /// Triangles that may be nearest somewhere in a box, and all within twice its diagonal of its
    /// centre: shells of cells are looked at until the next is too far.
    fn near(&self, centre: DVec3, radius: f64, triangles: &[[DVec3; 3]]) -> Vec<u32> {
        let [cx, cy, cz] = self.cells;
        let at = [0, 1, 2].map(|k| ((centre[k] / self.side) as usize).min(self.cells[k] - 1));
        // From the centre to the nearest side of its cell, less what rounding may do.
        let within = |k: usize| {
            let from = centre[k] - at[k] as f64 * self.side;
            from.min(self.side - from).max(0.0)
        };
        let within = (within(0).min(within(1)).min(within(2)) - MARGIN).max(0.0);
        let (mut found, mut least) = (Vec::<Seen>::new(), f64::INFINITY);
        for shell in 0..cx.max(cy).max(cz) {
            // What lies beyond the shells before is at least so far from the centre.
            let away = (shell as f64 - 1.0) * self.side + within;
            if away > (least + 2.0 * radius).max(4.0 * radius) {
                break;
            }
            let around = |at: usize, cells: usize| {
                at.saturating_sub(shell)..=at.saturating_add(shell).min(cells - 1)
            };
            for z in around(at[2], cz) {
                for y in around(at[1], cy) {
                    for x in around(at[0], cx) {
                        let away = [x, y, z].iter().zip(at).map(|(&n, at)| n.abs_diff(at)).max();
                        if away != Some(shell) {
                            continue;
                        }
                        for &t in &self.of[(z * cy + y) * cx + x] {
                            let seen = Seen::of(centre, t, triangles[t as usize]);
                            least = least.min(seen.distance);
                            found.push(seen);
                        }
                    }
                }
            }
        }
        let mut near = kept(&found, radius);
        near.sort_unstable();
        near.dedup();
        near
    }
}

/// A point of a triangle next to a point: the nearest one but for rounding. It is a mean of
/// corners, so it lies on the triangle whatever its shape.
fn foot(p: DVec3, [a, b, c]: [DVec3; 3]) -> DVec3 {
    let on_edge = |from: DVec3, to: DVec3| {
        let way = to - from;
        let square = way.length_squared();
        let t = if square > 0.0 { (way.dot(p - from) / square).clamp(0.0, 1.0) } else { 0.0 };
        from + way * t
    };
    let nearer = |s: DVec3, t: DVec3| {
        if p.distance_squared(t) < p.distance_squared(s) { t } else { s }
    };
    let edges = nearer(nearer(on_edge(a, b), on_edge(b, c)), on_edge(c, a));
    let normal = (b - a).cross(c - a);
    let weights = [(b, c), (c, a), (a, b)].map(|(u, v)| (u - p).cross(v - p).dot(normal));
    let sum: f64 = weights.iter().sum();
    if weights.iter().all(|&weight| weight >= 0.0) && sum > 0.0 {
        let [u, v, w] = weights.map(|weight| weight / sum);
        return nearer(edges, a * u + b * v + c * w);
    }
    edges
}

/// The triangles that may be nearest in a box of a radius, and all within four radii of its centre.
fn kept(seen: &[Seen], radius: f64) -> Vec<u32> {
    let least = seen.iter().fold(f64::INFINITY, |least, seen| least.min(seen.distance));
    let most = (least + 2.0 * radius).max(4.0 * radius) + MARGIN;
    seen.iter().filter(|seen| seen.height <= most).map(|seen| seen.triangle).collect()
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
    /// A point of the triangle, and how far it is from the centre.
    foot: DVec3,
    distance: f64,
    /// Unit vector from the foot to the centre; zero next to the triangle.
    away: DVec3,
    /// Height of the centre over the triangle along that: the distance is not less.
    height: f64,
}

impl Seen {
    fn of(centre: DVec3, triangle: u32, corners: [DVec3; 3]) -> Self {
        let foot = foot(centre, corners);
        let distance = foot.distance(centre);
        let away = if distance > MARGIN { (centre - foot) / distance } else { DVec3::ZERO };
        let heights = corners.map(|corner| away.dot(centre - corner));
        let height = heights.into_iter().fold(f64::INFINITY, f64::min).max(0.0);
        Self { triangle, foot, distance, away, height }
    }
}

/// What came of a box.
enum Found {
    Proved,
    /// Not proved. The side of the box, if the surface does not cross it.
    Open(Option<Side>),
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
        let Claim { corner, sides, function, errors } = self.field.claim(number);
        let [low, high] = errors.map(|error| error - self.moved - MARGIN);
        let half = 0.5 * sides;
        let centre = corner + half;
        let near = grid.near(centre, half.length(), triangles);
        let mut open = vec![Part { centre, half, side: None, near }];
        let mut boxes = 0;
        while let Some(part) = open.pop() {
            boxes += 1;
            let see = |&t: &u32| Seen::of(part.centre, t, triangles[t as usize]);
            let seen: Vec<Seen> = part.near.iter().map(see).collect();
            let about = About::of(&function, part.centre - corner, part.half, [low, high]);
            let Found::Open(side) = self.look(&part, &seen, &about, triangles) else { continue };
            let r = part.half.length();
            if r <= SMALLEST {
                let at = part.centre;
                let words = |what| {
                    format!("the errors of cell {number} {what} at {at:?}, in units of the field")
                };
                return Err(match self.is_refuted(&part, &seen, &about, side) {
                    true => Unproved::Wrong(words("do not hold")),
                    false => Unproved::Open(words("are not proved")),
                });
            }
            if boxes >= MOST {
                return Err(Unproved::Open(format!("cell {number} takes more than {MOST} boxes")));
            }
            open.extend(halves(&part, side, kept(&seen, r)));
        }
        Ok(boxes)
    }

    /// Whether a claim is wrong at a box's centre.
    fn is_refuted(&self, part: &Part, seen: &[Seen], about: &About, side: Option<Side>) -> bool {
        let bounds = seen.iter().fold([f64::INFINITY; 2], |[least, most], seen| {
            [least.min(seen.height), most.min(seen.distance)]
        });
        let [least, most] = bounds;
        let side = match (self.sides, side) {
            (None, _) => Side::Outside,
            (_, Some(side)) => side,
            (Some(_), None) if least <= MARGIN => return false,
            (Some(sides), None) => sides.at(part.centre),
        };
        // What was taken off the errors, and what rounding may add.
        let room = 2.0 * (self.moved + 2.0 * MARGIN);
        let [below, above] = [about.value - about.low - room, about.value + about.high + room];
        let not_in = |least: f64, most: f64| below > most || above < least;
        let inside = || match self.field.is_solid() {
            true => below > 0.0,
            false => not_in(-most, -least),
        };
        match side {
            Side::Outside => not_in(least, most),
            Side::Inside => inside(),
            Side::Both => not_in(least, most) || inside(),
        }
    }

    /// Looks for a proof of a box.
    fn look(&self, part: &Part, seen: &[Seen], about: &About, triangles: &[[DVec3; 3]]) -> Found {
        let r = part.half.length();
        let Some(nearest) = seen.iter().min_by(|s, t| s.distance.total_cmp(&t.distance)) else {
            return Found::Open(None);
        };
        let or_open =
            |is_proved: bool, side| if is_proved { Found::Proved } else { Found::Open(side) };
        let corners = triangles[nearest.triangle as usize];
        // The nearest point of the surface, then the nearest triangle: both distances are convex.
        let is_within = |sign: f64, error: f64| {
            about.excess(part.half, sign, |way| (part.centre + way).distance(nearest.foot)) <= error
                || about.excess(part.half, sign, |way| {
                    let at = part.centre + way;
                    at.distance(foot(at, corners))
                }) <= error
        };
        let outside = || about.is_above_low(part.half, seen, 1.0) && is_within(1.0, about.high);
        let Some(sides) = self.sides else { return or_open(outside(), None) };
        let is_solid = self.field.is_solid();
        let inside = || {
            if is_solid {
                // Nearer to the surface the file may be outside.
                let is_deep = |seen: &Seen| seen.height > r + self.moved + MARGIN;
                let is_file = self.moved == 0.0 || seen.iter().all(is_deep);
                return about.is_at_most_zero(part.half)
                    && (is_file || about.is_below_high_inside(part.half, seen));
            }
            is_within(-1.0, about.low) && about.is_below_high_inside(part.half, seen)
        };
        if seen.iter().all(|seen| seen.height > r + MARGIN) {
            let side = part.side.unwrap_or_else(|| sides.at(part.centre));
            let is_proved = match side {
                Side::Outside => outside(),
                Side::Inside => inside(),
                Side::Both => outside() && inside(),
            };
            return or_open(is_proved, Some(side));
        }
        let most = nearest.distance + r;
        let lower = if is_solid { 0.0 } else { -most };
        let is_near = about.greatest(part.half) - about.low <= lower
            && about.least(part.half) + about.high >= most;
        if is_near {
            return Found::Proved;
        }
        let Some((normal, delta)) = slab(r, nearest, seen, triangles) else {
            return Found::Open(None);
        };
        // Height of the centre, and of the box against the function.
        let t = normal.dot(part.centre - nearest.foot);
        let against = (about.gradient - normal).abs().dot(part.half);
        let is_low = about.value + about.rest - about.low - (t - delta) + against <= 0.0
            || (is_solid && about.is_at_most_zero(part.half));
        let is_high = (t + delta) - (about.value - about.rest + about.high) + against <= 0.0;
        if !(is_low && is_high) {
            return Found::Open(None);
        }
        let at = |way: f64| sides.at(part.centre + normal * way);
        or_open(at(2.0 * r) == Side::Outside && at(-2.0 * r) == Side::Inside, None)
    }
}

/// A plane's unit normal, and how far from the plane through the nearest point all of the surface
/// within four radii of a centre is, if that is at most half a radius. The nearest point is no
/// farther than a radius. Any unit vector would do: none has to be a triangle's own normal.
fn slab(r: f64, nearest: &Seen, seen: &[Seen], triangles: &[[DVec3; 3]]) -> Option<(DVec3, f64)> {
    let across = |triangle: u32| {
        let [a, b, c] = triangles[triangle as usize];
        let longest = (b - a).length_squared().max((c - b).length_squared());
        let longest = longest.max((a - c).length_squared());
        ((b - a).cross(c - a), longest)
    };
    let normal = across(nearest.triangle).0.try_normalize()?;
    if nearest.distance > r {
        return None;
    }
    let mut delta = 0f64;
    for s in seen.iter().filter(|s| s.height <= 4.0 * r + MARGIN) {
        let corners = triangles[s.triangle as usize];
        let height = |p: DVec3| normal.dot(p - nearest.foot).abs();
        let of_corners = corners.iter().fold(0f64, |most, &p| most.max(height(p)));
        // Of points of the triangle in the ball, none is farther than eight radii from another. A
        // normal of a triangle that is no sliver is off by less than 2^-30.
        let (own, square) = across(s.triangle);
        let of_slope = match own.try_normalize() {
            Some(own_unit) if own.length() > square / (1 << 20) as f64 => {
                let slope = normal.cross(own_unit).length() + 1.0 / (1 << 30) as f64;
                height(s.foot) + 8.0 * r * slope
            }
            _ => f64::INFINITY,
        };
        delta = delta.max(of_corners.min(of_slope));
    }
    let delta = delta + MARGIN;
    (delta <= 0.5 * r).then_some((normal, delta))
}

impl About {
    fn of(function: &Function, place: DVec3, half: DVec3, [low, high]: [f64; 2]) -> Self {
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
            least.min(s.height - against)
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

    /// The most that a convex distance is above `sign` times the function. It is given on the way
    /// from the centre to each corner.
    fn excess(&self, half: DVec3, sign: f64, distance: impl Fn(DVec3) -> f64) -> f64 {
        let corners = (0..8).map(|k| {
            let way = DVec3::new(
                if k & 1 == 0 { -half.x } else { half.x },
                if k & 2 == 0 { -half.y } else { half.y },
                if k & 4 == 0 { -half.z } else { half.z },
            );
            distance(way) - sign * self.gradient.dot(way)
        });
        corners.fold(f64::NEG_INFINITY, f64::max) - sign * self.value + self.rest
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
