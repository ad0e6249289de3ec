//! Bounded intersections of half-spaces with integer planes, exactly, by trying every three planes.
//!
//! What is claimed of triboxes (Crosnier & Rossignac 1999) and other slab bounds is compared with
//! this. Nothing is known of slabs here, of directions or of corners: three planes meet in a point,
//! and the point counts if no half-space excludes it.
//!
//! Everything fits, for normals up to [`MAX_NORMAL`] and offsets up to [`MAX_OFFSET`]: a
//! determinant of three normals is below 2¹² (Hadamard: (8√3)³), a component of a point's numerator
//! below 3 · 2⁴⁰ · 128 < 2⁴⁹, an inner product with a normal below 2⁵⁴. Only where two points meet
//! are 128 bits needed.

use std::cmp::Ordering;

/// Greatest magnitude of a normal's component.
pub const MAX_NORMAL: i64 = 8;

/// Greatest magnitude of an offset.
pub const MAX_OFFSET: i64 = 1 << 40;

/// The points x with `normal`·x ≤ `offset`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct HalfSpace {
    /// Outward, of any length but zero.
    pub normal: [i64; 3],
    /// Greatest `normal`·x allowed.
    pub offset: i64,
}

impl HalfSpace {
    /// `normal`·x ≤ `offset`.
    #[must_use]
    pub const fn new(normal: [i64; 3], offset: i64) -> Self {
        Self { normal, offset }
    }

    /// Offset minus `normal`·x, times the point's denominator: negative outside, zero on the plane.
    fn slack(&self, numerator: [i64; 3], denominator: i64) -> i64 {
        self.offset * denominator - dot(self.normal, numerator)
    }
}

/// A rational number in lowest terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Ratio {
    /// Any sign.
    pub numerator: i64,
    /// Positive.
    pub denominator: i64,
}

impl Ratio {
    fn new(numerator: i64, denominator: i64) -> Self {
        let divisor = gcd(numerator, denominator);
        Self { numerator: numerator / divisor, denominator: denominator / divisor }
    }

    /// The nearest `f64` or a neighbour of it.
    #[must_use]
    pub fn to_f64(self) -> f64 {
        self.numerator as f64 / self.denominator as f64
    }
}

impl From<i64> for Ratio {
    fn from(integer: i64) -> Self {
        Self { numerator: integer, denominator: 1 }
    }
}

impl Ord for Ratio {
    fn cmp(&self, other: &Self) -> Ordering {
        let scaled = |a: i64, b: i64| i128::from(a) * i128::from(b);
        scaled(self.numerator, other.denominator).cmp(&scaled(other.numerator, self.denominator))
    }
}

impl PartialOrd for Ratio {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// An extreme point.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Vertex {
    /// Its coordinates times `denominator`; the four have no common divisor, so equal points have
    /// equal fields.
    pub numerator: [i64; 3],
    /// Positive.
    pub denominator: i64,
    /// All planes through it, ascending, at least three.
    pub planes: Vec<usize>,
}

impl Vertex {
    /// Its coordinates.
    #[must_use]
    pub fn position(&self) -> [f64; 3] {
        self.numerator.map(|x| x as f64 / self.denominator as f64)
    }

    /// One coordinate.
    #[must_use]
    pub fn coordinate(&self, axis: usize) -> Ratio {
        Ratio::new(self.numerator[axis], self.denominator)
    }
}

/// What a polytope is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Dimension {
    /// No point at all.
    Empty,
    /// One point.
    Point,
    /// Two vertices.
    Segment,
    /// Flat, three vertices or more.
    Polygon,
    /// It has a volume.
    Solid,
}

/// A bounded intersection of half-spaces.
#[derive(Clone, Debug)]
pub struct Polytope {
    planes: Vec<HalfSpace>,
    vertices: Vec<Vertex>,
    faces: Vec<Vec<usize>>,
}

impl Polytope {
    /// The intersection, which must be bounded: of another one the faces lack what lies at
    /// infinity. Half-spaces may repeat, be redundant or contradict each other. O(n³) triples,
    /// n inner products each at worst.
    ///
    /// # Panics
    /// A normal is zero or too long, or an offset too large.
    #[must_use]
    pub fn new(planes: &[HalfSpace]) -> Self {
        for plane in planes {
            let longest = plane.normal.iter().map(|x| x.abs()).max();
            assert!((Some(1)..=Some(MAX_NORMAL)).contains(&longest), "normal {:?}", plane.normal);
            assert!(plane.offset.abs() <= MAX_OFFSET, "offset {}", plane.offset);
        }
        let mut points = Vec::new();
        for (i, a) in planes.iter().enumerate() {
            for (j, b) in planes.iter().enumerate().skip(i + 1) {
                for c in &planes[j + 1..] {
                    points.extend(meet([a, b, c], planes));
                }
            }
        }
        points.sort_unstable();
        points.dedup();
        let vertices: Vec<Vertex> = points
            .into_iter()
            .map(|(numerator, denominator)| vertex(numerator, denominator, planes))
            .collect();
        let faces =
            (0..planes.len()).map(|plane| face(plane, planes[plane].normal, &vertices)).collect();
        Self { planes: planes.to_vec(), vertices, faces }
    }

    /// The half-spaces, as given.
    #[must_use]
    pub fn planes(&self) -> &[HalfSpace] {
        &self.planes
    }

    /// All extreme points, each once.
    #[must_use]
    pub fn vertices(&self) -> &[Vertex] {
        &self.vertices
    }

    /// The vertices on plane `plane`, counter-clockwise seen from outside, the lowest number first.
    /// Two or fewer of a plane that only touches: see [`is_degenerate`](Self::is_degenerate).
    #[must_use]
    pub fn face(&self, plane: usize) -> &[usize] {
        &self.faces[plane]
    }

    /// Whether the plane has no face with an area.
    #[must_use]
    pub fn is_degenerate(&self, plane: usize) -> bool {
        self.faces[plane].len() < 3
    }

    /// Whether no point is in all half-spaces.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.vertices.is_empty()
    }

    /// What it is.
    #[must_use]
    pub fn dimension(&self) -> Dimension {
        // No three extreme points lie on a line. A flat polytope has two opposite constraints that
        // hold with equality all over it.
        match self.vertices.len() {
            0 => Dimension::Empty,
            1 => Dimension::Point,
            2 => Dimension::Segment,
            count if self.faces.iter().any(|face| face.len() == count) => Dimension::Polygon,
            _ => Dimension::Solid,
        }
    }

    /// Greatest `normal`·x over the polytope; `None` if that is empty. It equals the plane's offset
    /// where the plane is tight.
    #[must_use]
    pub fn support(&self, normal: [i64; 3]) -> Option<Ratio> {
        self.vertices.iter().map(|v| Ratio::new(dot(normal, v.numerator), v.denominator)).max()
    }

    /// Least offset that plane `plane` could have without a change of the polytope; `None` if that
    /// is empty.
    #[must_use]
    pub fn tight_offset(&self, plane: usize) -> Option<Ratio> {
        self.support(self.planes[plane].normal)
    }

    /// Whether plane `plane` touches the polytope.
    #[must_use]
    pub fn is_tight(&self, plane: usize) -> bool {
        !self.faces[plane].is_empty()
    }

    /// Faces with an area, each once though planes may coincide: a plane's number and its corners.
    pub fn distinct_faces(&self) -> impl Iterator<Item = (usize, &[usize])> {
        // Loops begin at their lowest vertex, so coinciding planes have the same list, and opposite
        // ones have not.
        let first =
            |plane: usize| self.faces[..plane].iter().all(|face| *face != self.faces[plane]);
        let wanted = move |plane: &usize| !self.is_degenerate(*plane) && first(*plane);
        (0..self.faces.len()).filter(wanted).map(|plane| (plane, self.faces[plane].as_slice()))
    }

    /// Volume, good to some 15 digits of the cube of the polytope's size.
    #[must_use]
    pub fn volume(&self) -> f64 {
        let Some(origin) = self.vertices.first().map(Vertex::position) else { return 0.0 };
        self.triangles().map(|t| det(t.map(|p| minus(p, origin)))).sum::<f64>() / 6.0
    }

    /// Area of the boundary; of a polygon both sides count, as of a solid that is being flattened.
    #[must_use]
    pub fn area(&self) -> f64 {
        let doubled = |[a, b, c]: [[f64; 3]; 3]| {
            let normal = cross(minus(b, a), minus(c, a));
            normal.iter().map(|x| x * x).sum::<f64>().sqrt()
        };
        self.triangles().map(doubled).sum::<f64>() / 2.0
    }

    /// Fans of the distinct faces.
    fn triangles(&self) -> impl Iterator<Item = [[f64; 3]; 3]> {
        let at = |vertex: usize| self.vertices[vertex].position();
        self.distinct_faces().flat_map(move |(_, face)| {
            face[1..].windows(2).map(move |pair| [at(face[0]), at(pair[0]), at(pair[1])])
        })
    }

    /// Of a solid: that each edge has one face on either side, and Euler's formula. Of all else,
    /// nothing.
    ///
    /// # Errors
    /// What is wrong.
    pub fn check_graph(&self) -> Result<(), String> {
        if self.dimension() != Dimension::Solid {
            return Ok(());
        }
        let faces: Vec<&[usize]> = self.distinct_faces().map(|(_, face)| face).collect();
        let around = |face: &[usize]| -> Vec<[usize; 2]> {
            (0..face.len()).map(|k| [face[k], face[(k + 1) % face.len()]]).collect()
        };
        let mut edges: Vec<[usize; 2]> = faces.iter().flat_map(|face| around(face)).collect();
        edges.sort_unstable();
        if let Some(pair) = edges.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(format!("edge {:?} has two faces on one side", pair[0]));
        }
        if let Some(edge) = edges.iter().find(|[a, b]| edges.binary_search(&[*b, *a]).is_err()) {
            return Err(format!("edge {edge:?} has one face"));
        }
        let (v, e, f) = (self.vertices.len(), edges.len() / 2, faces.len());
        if v + f == e + 2 { Ok(()) } else { Err(format!("{v} vertices, {e} edges, {f} faces")) }
    }
}

/// The point of three planes in lowest terms, if there is one and no half-space excludes it.
fn meet([a, b, c]: [&HalfSpace; 3], planes: &[HalfSpace]) -> Option<([i64; 3], i64)> {
    let bc = cross(b.normal, c.normal);
    let denominator = dot(a.normal, bc);
    if denominator == 0 {
        return None;
    }
    let (ca, ab) = (cross(c.normal, a.normal), cross(a.normal, b.normal));
    let sign = denominator.signum();
    let numerator =
        std::array::from_fn(|k| sign * (a.offset * bc[k] + b.offset * ca[k] + c.offset * ab[k]));
    let denominator = denominator.abs();
    if planes.iter().any(|plane| plane.slack(numerator, denominator) < 0) {
        return None;
    }
    let divisor = numerator.iter().fold(denominator, |divisor, x| gcd(*x, divisor));
    Some((numerator.map(|x| x / divisor), denominator / divisor))
}

fn vertex(numerator: [i64; 3], denominator: i64, planes: &[HalfSpace]) -> Vertex {
    let through = |plane: &usize| planes[*plane].slack(numerator, denominator) == 0;
    Vertex { numerator, denominator, planes: (0..planes.len()).filter(through).collect() }
}

/// The vertices on a plane, around its normal.
fn face(plane: usize, normal: [i64; 3], vertices: &[Vertex]) -> Vec<usize> {
    let mut corners: Vec<usize> =
        (0..vertices.len()).filter(|v| vertices[*v].planes.binary_search(&plane).is_ok()).collect();
    let Some((&mut pivot, others)) = corners.split_first_mut() else { return corners };
    // Seen along an axis that the plane does not contain. The others lie within half a turn around
    // an extreme point, and no two in one direction.
    let axis = (0..3).find(|k| normal[*k] != 0).unwrap_or(0);
    let arm = |v: usize| {
        let from = |k: usize| {
            let scaled =
                |a: &Vertex, b: &Vertex| i128::from(a.numerator[k]) * i128::from(b.denominator);
            scaled(&vertices[v], &vertices[pivot]) - scaled(&vertices[pivot], &vertices[v])
        };
        [from((axis + 1) % 3), from((axis + 2) % 3)]
    };
    others.sort_by(|&a, &b| {
        let ([ax, ay], [bx, by]) = (arm(a), arm(b));
        let turn = (ay * bx).cmp(&(ax * by));
        if normal[axis] > 0 { turn } else { turn.reverse() }
    });
    corners
}

fn gcd(a: i64, b: i64) -> i64 {
    let (mut a, mut b) = (a.abs(), b.abs());
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

fn dot(a: [i64; 3], b: [i64; 3]) -> i64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross<T>(a: [T; 3], b: [T; 3]) -> [T; 3]
where
    T: Copy + std::ops::Mul<Output = T> + std::ops::Sub<Output = T>,
{
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn det([a, b, c]: [[f64; 3]; 3]) -> f64 {
    let normal = cross(b, c);
    a[0] * normal[0] + a[1] * normal[1] + a[2] * normal[2]
}

#[cfg(test)]
mod tests;
