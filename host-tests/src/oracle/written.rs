//! Whether a surface holds a mesh as its text is written: decimals in integers, without rounding,
//! and no code that the library has.
//!
//! A decimal whose nearest `f64` is an `f32` counts as that `f32`, as for `Mesh::rounding`.

use super::exact::{Vector, cross, dot, meet_exactly, minus};
use num_bigint::BigInt;
use num_traits::{Signed, Zero};

/// `mantissa · 2^two · 10^ten`.
#[derive(Clone, Debug)]
struct Number {
    mantissa: BigInt,
    two: i32,
    ten: i32,
}

impl Number {
    fn of(x: f64) -> Self {
        let (mantissa, two) = super::exact::parts(x);
        Self { mantissa, two, ten: 0 }
    }

    fn written(text: &str) -> Self {
        let nearest: f64 = text.parse().expect("a number");
        if f64::from(nearest as f32) == nearest {
            return Self::of(nearest);
        }
        let (digits, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
        let (whole, part) = digits.split_once('.').unwrap_or((digits, ""));
        let exponent: i32 = exponent.parse().expect("an exponent");
        let mantissa = format!("{whole}{part}").parse().expect("digits");
        let places = i32::try_from(part.len()).expect("a number");
        Self { mantissa, two: 0, ten: exponent - places }
    }

    /// As a multiple of `2^two · 10^ten`, which are not above its own.
    fn over(&self, two: i32, ten: i32) -> BigInt {
        let tens = BigInt::from(10).pow((self.ten - ten).unsigned_abs());
        (&self.mantissa << (self.two - two).unsigned_abs()) * tens
    }
}

/// A mesh as an OBJ file is written, and a surface around it, in integers of one unit.
#[derive(Debug)]
pub struct Around {
    points: Vec<Vector>,
    triangles: Vec<[u32; 3]>,
    faces: Vec<[Vector; 3]>,
}

impl Around {
    /// Of an OBJ text of `v` and triangular `f` lines, and of a surface of `f32` coordinates.
    #[must_use]
    pub fn new(obj: &str, positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Self {
        let lines = |kind: &'static str| {
            obj.lines().filter_map(move |line| line.strip_prefix(kind)?.strip_prefix(' '))
        };
        let three = |line: &str| -> [String; 3] {
            let words: Vec<String> = line.split_whitespace().map(str::to_owned).collect();
            words.try_into().expect("three words")
        };
        let inner: Vec<[Number; 3]> =
            lines("v").map(|line| three(line).map(|word| Number::written(&word))).collect();
        let number = |word: String| word.parse::<u32>().expect("a vertex") - 1;
        let of = lines("f").map(|line| three(line).map(number)).collect();
        let outer = positions.iter().map(|p| p.map(|x| Number::of(f64::from(x))));
        let outer: Vec<[Number; 3]> = outer.collect();
        let all = || inner.iter().chain(&outer).flatten();
        let two = all().map(|n| n.two).min().unwrap_or(0);
        let ten = all().map(|n| n.ten).min().unwrap_or(0);
        let whole = |p: &[Number; 3]| p.each_ref().map(|n| n.over(two, ten));
        let outer: Vec<Vector> = outer.iter().map(whole).collect();
        Self {
            points: inner.iter().map(whole).collect(),
            triangles: of,
            faces: triangles.iter().map(|t| t.map(|v| outer[v as usize].clone())).collect(),
        }
    }

    /// Whether the surface encloses every triangle of the file, as it is written: it winds around
    /// each vertex and has no point in common with any triangle.
    ///
    /// # Errors
    /// A vertex or a triangle that is not enclosed.
    pub fn encloses(&self) -> Result<(), String> {
        self.holds_vertices()?;
        let boxes: Vec<[Vector; 2]> = self.faces.iter().map(bounds).collect();
        for (number, triangle) in self.triangles.iter().enumerate() {
            let corners = triangle.map(|v| self.points[v as usize].clone());
            let near = bounds(&corners);
            for (face, of) in self.faces.iter().zip(&boxes) {
                if overlap(&near, of) && meet_exactly(&corners, face) {
                    return Err(format!("triangle {number} meets a face"));
                }
            }
        }
        Ok(())
    }

    /// Whether the surface winds around every vertex of the file and the middle of every triangle.
    /// Parts of it may cross.
    ///
    /// # Errors
    /// A vertex or a triangle that is outside.
    pub fn holds_points(&self) -> Result<(), String> {
        self.holds_vertices()?;
        let three = BigInt::from(3);
        let faces: Vec<[Vector; 3]> = self
            .faces
            .iter()
            .map(|f| f.each_ref().map(|p| p.each_ref().map(|x| x * &three)))
            .collect();
        for (number, triangle) in self.triangles.iter().enumerate() {
            let [a, b, c] = triangle.map(|v| &self.points[v as usize]);
            let middle = [0, 1, 2].map(|k| &a[k] + &b[k] + &c[k]);
            if winding(&middle, &faces)? < 1 {
                return Err(format!("the middle of triangle {number} is outside"));
            }
        }
        Ok(())
    }

    fn holds_vertices(&self) -> Result<(), String> {
        let mut used = vec![false; self.points.len()];
        self.triangles.iter().flatten().for_each(|&v| used[v as usize] = true);
        for (number, point) in self.points.iter().enumerate().filter(|(v, _)| used[*v]) {
            if winding(point, &self.faces)? < 1 {
                return Err(format!("vertex {number} is outside"));
            }
        }
        Ok(())
    }
}

fn bounds(corners: &[Vector; 3]) -> [Vector; 2] {
    let of = |k: usize| corners.iter().map(move |p| &p[k]);
    [
        [0, 1, 2].map(|k| of(k).min().expect("three corners").clone()),
        [0, 1, 2].map(|k| of(k).max().expect("three corners").clone()),
    ]
}

fn overlap([a, b]: &[Vector; 2], [c, d]: &[Vector; 2]) -> bool {
    (0..3).all(|k| a[k] <= d[k] && c[k] <= b[k])
}

/// Crossings of the ray along +z from a point that is moved by an infinitesimal step along x and
/// one infinitely smaller along y: outwards count 1, inwards −1. An error if the point is on a
/// face.
fn winding(p: &Vector, faces: &[[Vector; 3]]) -> Result<i32, String> {
    let mut turns = 0;
    for face in faces {
        let [a, b, c] = face;
        let is_far =
            |k: usize| face.iter().all(|q| q[k] < p[k]) || face.iter().all(|q| q[k] > p[k]);
        if is_far(0) || is_far(1) {
            continue;
        }
        let sides = [turn(a, b, p), turn(b, c, p), turn(c, a, p)];
        if sides[0] == 0 || sides.iter().any(|&side| side != sides[0]) {
            continue;
        }
        let height = dot(&cross(&minus(b, a), &minus(c, a)), &minus(p, a));
        if height.is_zero() {
            return Err("a point is on a face".to_owned());
        }
        // Seen from above, a face that turns to the left faces up.
        if height.is_positive() != (sides[0] > 0) {
            turns += sides[0];
        }
    }
    Ok(turns)
}

/// Which way one turns from `u` over `v` to the moved point, seen along −z.
fn turn(u: &Vector, v: &Vector, p: &Vector) -> i32 {
    let [x, y] = [0, 1].map(|k| &v[k] - &u[k]);
    let flat = &x * (&p[1] - &u[1]) - &y * (&p[0] - &u[0]);
    let sign = |n: &BigInt| i32::from(n.is_positive()) - i32::from(n.is_negative());
    [sign(&flat), -sign(&y), sign(&x)].into_iter().find(|&sign| sign != 0).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    const OCTAHEDRON: [[f32; 3]; 6] = [
        [1.0, 0.0, 0.0],
        [-1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, -1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.0, 0.0, -1.0],
    ];
    const FACES: [[u32; 3]; 8] =
        [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];

    fn around(points: [&str; 3]) -> Around {
        let vertices: String = points.iter().map(|p| format!("v {p}\n")).collect();
        Around::new(&format!("{vertices}f 1 2 3\n"), &OCTAHEDRON, &FACES)
    }

    #[test]
    fn the_oracle_tells_inside_from_outside_in_the_last_decimal() {
        let inside = ["0 0 0", "0 0 0.9999999999999", "-0.1 0.1e0 -7E-1"];
        assert_eq!(around(inside).encloses(), Ok(()));
        assert_eq!(around(inside).holds_points(), Ok(()));
        assert!(around(["0 0 0", "0 0 1.25", "0.1 0.1 0"]).encloses().is_err());
        // Not on the decimal that its nearest f64 has, but on the face.
        assert!(around(["0.1 0.2 0.7", "0 0 0.1", "0 0.1 0"]).encloses().is_err());
        assert!(around(["0.1 0.2 0.70000000000000000001", "0 0 0", "0 0.1 0"]).encloses().is_err());
        let below = ["0.1 0.2 0.69999999999999999999", "0 0 0", "0 0.1 0"];
        assert_eq!(around(below).encloses(), Ok(()));
    }

    #[test]
    fn the_oracle_sees_a_triangle_that_leaves_between_its_vertices() {
        let (mut positions, mut faces) = (OCTAHEDRON.to_vec(), FACES.to_vec());
        positions.extend(OCTAHEDRON.map(|[x, y, z]| [x + 4.0, y, z]));
        faces.extend(FACES.map(|t| t.map(|v| v + 6)));
        let text = "v 0 0 0.1\nv 4 0 0.1\nv 0 0.1 0\nf 1 2 3\n";
        assert!(Around::new(text, &positions, &faces).encloses().is_err());
        assert!(Around::new(text, &positions, &faces).holds_points().is_err());
    }
}
