//! Proof of curves from the blob's bytes and the polylines: the stored points are the input's
//! within the error, every point of a run lies in the run's capsule, and each zone is the input's.

use super::bytes::{Cursor, check_header, entries, header_word, section, width};
use super::distance::distance;
use super::dyadic::Dyadic;
use super::enclosure::point_is_far;
use super::finding::Finding;
use super::input::is_within;
use glam::DVec3;

const CURVE: &str = "curve";

/// A polyline of the file that curves were built from.
#[derive(Clone, Debug, PartialEq)]
pub struct FilePolyline {
    /// Its points.
    pub points: Vec<[f64; 3]>,
    /// Whether the file says that the last one is joined with the first: by a zone, or because they
    /// are equal.
    pub is_closed: bool,
    /// Whether it is an exclusion zone.
    pub is_exclusion: bool,
}

/// Half a unit in the last place of an `f64` below 1, on each of three axes: reading rounded the
/// decimals by no more.
const DECIMAL: f64 = 0.5 * f64::EPSILON;

struct Curves {
    scale_exponent: i32,
    /// Local frame.
    error: f64,
    points: Vec<[f64; 3]>,
    /// First point, and whether the last point is equal to it.
    polylines: Vec<(usize, bool)>,
    depth: usize,
    /// First point, last point, radius.
    nodes: Vec<(usize, usize, f64)>,
    /// One byte for each polyline; none without exclusion zones.
    zones: Vec<u8>,
    bounds: [[f64; 3]; 2],
}

const ZONES: u32 = 27;

impl Curves {
    fn parse(bytes: &[u8]) -> Result<Self, String> {
        check_header(bytes)?;
        let float = |at: usize| header_word(bytes, at).map(|x| f64::from(f32::from_bits(x)));
        let corner = |at: usize| -> Result<[f64; 3], String> {
            Ok([float(at)?, float(at + 4)?, float(at + 8)?])
        };
        let mut cursor = Cursor(section(bytes, 21, "curves")?, "curves");
        let flags = cursor.uint(4)?;
        let (is_planar, is_f32) = (flags & 1 != 0, flags & 2 != 0);
        let step = 2f64.powi(cursor.uint(4)?.cast_signed());
        let origin =
            [cursor.uint(4)?, cursor.uint(4)?, cursor.uint(4)?].map(|x| f64::from(x.cast_signed()));
        let [count, polylines, depth] = [cursor.uint(4)?, cursor.uint(4)?, cursor.uint(4)?];
        let polyline = |record: u32| ((record & !(1 << 31)) as usize, record >> 31 != 0);
        let polylines =
            (0..polylines).map(|_| cursor.uint(4).map(polyline)).collect::<Result<_, _>>()?;
        let mut points = Vec::new();
        for _ in 0..count {
            let mut p = [0.0; 3];
            for (x, origin) in p.iter_mut().zip(origin).take(if is_planar { 2 } else { 3 }) {
                *x = match is_f32 {
                    true => f64::from(cursor.float()?),
                    false => (f64::from(cursor.uint(2)?) + origin) * step,
                };
                if !x.is_finite() {
                    return Err("a coordinate is not finite".into());
                }
            }
            points.push(p);
        }
        let mut nodes = Vec::new();
        for _ in 2..count {
            let [first, last] =
                [cursor.uint(width(count))?, cursor.uint(width(count))?].map(|i| i as usize);
            nodes.push((first, last, f64::from(f32::from_bits(cursor.uint(2)? << 16))));
        }
        cursor.end()?;
        let has_zones = entries(bytes).iter().any(|entry| entry.kind == ZONES);
        let zones = if has_zones { section(bytes, ZONES, "curve zones")?.to_vec() } else { vec![] };
        Ok(Self {
            zones,
            scale_exponent: header_word(bytes, 28)?.cast_signed(),
            error: float(88)?,
            points,
            polylines,
            depth: depth as usize,
            nodes,
            bounds: [corner(116)?, corner(128)?],
        })
    }

    /// The stored points of a polyline.
    fn run(&self, index: usize) -> Result<&[[f64; 3]], String> {
        let end = self.polylines.get(index + 1).map_or(self.points.len(), |next| next.0);
        let start = self.polylines[index].0;
        self.points.get(start..end).ok_or(format!("polyline {index} ends before it begins"))
    }

    /// Each polyline has the zone of the given one, and exclusion zones are closed. Returns the
    /// number of exclusion zones.
    fn zones(&self, given: &[FilePolyline]) -> Result<usize, String> {
        if !self.zones.is_empty() && self.zones.len() != given.len() {
            return Err(format!("{} zones of {} polylines", self.zones.len(), given.len()));
        }
        let mut exclusions = 0;
        for (index, polyline) in given.iter().enumerate() {
            let stored = self.zones.get(index).copied().unwrap_or(0);
            if stored != u8::from(polyline.is_exclusion) {
                let wanted = if polyline.is_exclusion { "an exclusion" } else { "an inclusion" };
                return Err(format!("polyline {index} is {wanted} zone, and {stored} is stored"));
            }
            exclusions += usize::from(polyline.is_exclusion);
            if polyline.is_exclusion && !self.polylines[index].1 {
                return Err(format!("polyline {index} is an exclusion zone and not closed"));
            }
        }
        Ok(exclusions)
    }

    /// The stored points are those of `given` within the error, in their order. A stored polyline
    /// may be closed where the given one is not.
    fn points(&self, given: &[FilePolyline]) -> Result<usize, String> {
        if self.polylines.first().map(|first| first.0) != Some(0)
            || self.polylines.len() != given.len()
        {
            return Err(format!("{} polylines of {}", self.polylines.len(), given.len()));
        }
        let scale = 2f64.powi(-self.scale_exponent);
        let (mut closed, mut exact) = (0, 0);
        for (index, polyline) in given.iter().enumerate() {
            let given = &polyline.points;
            let run = self.run(index)?;
            let is_closed = self.polylines[index].1;
            let repeats = usize::from(is_closed && run.len() == given.len() + 1);
            closed += repeats;
            if run.len() != given.len() + repeats {
                return Err(format!("polyline {index}: {} points of {}", run.len(), given.len()));
            }
            if polyline.is_closed && !is_closed {
                return Err(format!("polyline {index} is closed in the file, and stored open"));
            }
            // What is closed on the grid alone is closed by nobody.
            let is_joined = repeats == 1 || given.first() == given.last();
            if is_closed && !(is_joined && run.first() == run.last()) {
                return Err(format!("polyline {index} is not closed, its record says it is"));
            }
            for (k, (&stored, there)) in
                run.iter().zip(given.iter().chain(given.first())).enumerate()
            {
                let there = there.map(|x| x * scale);
                if !is_within(stored, there, [self.error, -DECIMAL, 0.0], &mut exact) {
                    return Err(format!(
                        "polyline {index}: point {k} is not within {:e} of the input's, local \
                         frame",
                        self.error
                    ));
                }
            }
        }
        let [low, high] = self.bounds;
        let outside = |p: &&[f64; 3]| (0..3).any(|k| !(low[k]..=high[k]).contains(&p[k]));
        match self.points.iter().find(outside) {
            Some(p) => Err(format!("the box leaves out the point {p:?}, local frame")),
            None => Ok(closed),
        }
    }

    /// Every run of three points or more has a node, found by the descent's rule, and its capsule
    /// holds the run. Returns the pairs of a node and a point.
    fn nodes(&self) -> Result<usize, String> {
        let (mut pairs, mut deepest, mut next) = (0, 0, 0);
        let mut open = vec![(0, self.points.len().saturating_sub(1), 1)];
        while let Some((first, last, depth)) = open.pop() {
            if last < first + 2 {
                continue;
            }
            let index = next;
            next += 1;
            let Some(&(i, j, radius)) = self.nodes.get(index) else {
                return Err(format!("no node of the points {first} to {last}"));
            };
            if (i, j) != (first, last) {
                return Err(format!("node {index} is of {i} to {j}, and not of {first} to {last}"));
            }
            let [a, b] = [i, j].map(|end| self.points[end]);
            for k in i + 1..j {
                pairs += 1;
                if !is_in_capsule(self.points[k], a, b, radius) {
                    return Err(format!("the capsule of node {index} leaves out point {k}"));
                }
            }
            deepest = deepest.max(depth);
            let begins_here = self.nodes.get(next).filter(|node| node.0 == i);
            let middle = begins_here.map_or(i + 1, |node| node.1);
            if middle <= i || middle >= j {
                return Err(format!("node {index} is split at {middle}"));
            }
            open.extend([(middle, j, depth + 1), (i, middle, depth + 1)]);
        }
        if next != self.nodes.len() {
            return Err(format!("{} nodes, and {next} on the way down", self.nodes.len()));
        }
        if deepest > self.depth {
            return Err(format!(
                "the way down has {deepest} nodes, the header says {}",
                self.depth
            ));
        }
        Ok(pairs)
    }
}

/// Whether a point is no farther from a segment than the radius, by integers if need be.
fn is_in_capsule(p: [f64; 3], a: [f64; 3], b: [f64; 3], radius: f64) -> bool {
    let [u, v, w] = [p, a, b].map(DVec3::from);
    if distance(u, [v, w, w]) < radius * (1.0 - 1e-12) - 1e-14 {
        return true;
    }
    let exact = |p: [f64; 3]| p.map(Dyadic::from);
    let most = Dyadic::from(radius);
    radius.is_finite() && !point_is_far(&exact(p), &exact(a), &exact(b), &(&most * &most))
}

/// Proves a blob's curves.
pub(crate) fn verify(bytes: &[u8], given: &[FilePolyline]) -> Finding {
    let proof = Curves::parse(bytes).and_then(|curves| {
        let closed = curves.points(given)?;
        let exclusions = curves.zones(given)?;
        let pairs = curves.nodes()?;
        let counts = [
            ("point", curves.points.len()),
            ("polyline", curves.polylines.len()),
            ("exclusion zone", exclusions),
            ("closing point", closed),
            ("enclosed point", pairs),
        ];
        let words = "every point of the input is stored within the error, every capsule holds its \
                     points, and every zone is the input's";
        Ok(Finding::proved(CURVE, words, &counts))
    });
    proof.unwrap_or_else(|error| Finding::failed(CURVE, error))
}
