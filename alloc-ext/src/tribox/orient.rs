//! The orientation in which a mesh's tribox has the least volume or area (Crosnier & Rossignac
//! 1999, section 3).
//!
//! The volume of the tribox is a function of the rotation with many local minima. A search begins
//! at the mesh's own frame and at random rotations, and from the best of these turns about the axes
//! by smaller and smaller angles. It looks at vertices only that are extreme in one of many
//! directions. It finds a good rotation and proves nothing: the triboxes are then those of the mesh
//! as turned, with the rounding of its vertices.
//!
//! The arithmetic is +, −, ×, ÷ and √ in one order, and no sine, so that every machine finds the
//! same bits.

use super::choose::Measure;
use super::extent::Extent;
use super::span::{Span, projections};
use crate::mesh::Mesh;
use crate::random::SplitMix;

/// Rotations that are looked at before the best are improved.
const TRIED: usize = 512;
/// Of these, the best that are improved.
const IMPROVED: usize = 16;
/// Halvings of the angle, from half a radian on.
const HALVINGS: usize = 14;
/// Most turns of one angle.
const TURNS: usize = 32;
/// Steps across each side of the cube of directions in which vertices are extreme.
const STEPS: i32 = 8;
/// Seed of the random rotations.
const SEED: u64 = 1999;

/// Twice the unit roundoff of f64, and room for the rounding of bounds.
const DOUBT: f64 = 1e-15;

/// A rotation as a blob stores it. Its numbers are exact: of a rotation, they are rounded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    /// Rows of the matrix from the mesh's frame to that of the triboxes.
    pub rows: [[f32; 3]; 3],
}

impl Turn {
    /// The rotation that leaves the mesh as it is.
    pub const NONE: Turn = Turn { rows: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] };

    /// The place of a point, each coordinate within 2^-51 of the sum of its terms' sizes.
    fn place(&self, point: [f32; 3]) -> [f64; 3] {
        self.times(point.map(f64::from))
    }

    fn times(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        self.rows.map(|row| {
            let [a, b, c] = row.map(f64::from);
            a * x + b * y + c * z
        })
    }

    /// An upper bound of how far the matrix is from a rotation: lengths change by a factor within
    /// 1 ± this.
    #[must_use]
    pub fn skew(&self) -> f64 {
        let rows = self.rows.map(|row| row.map(f64::from));
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let sum = |i: usize| {
            let off = |j: usize| (dot(rows[i], rows[j]) - if i == j { 1.0 } else { 0.0 }).abs();
            off(0) + off(1) + off(2)
        };
        sum(0).max(sum(1)).max(sum(2)) + DOUBT
    }

    /// The place that the turn takes to this one, within 2^-40 of the largest coordinate.
    pub(super) fn back(&self, place: [f32; 3]) -> [f64; 3] {
        let transposed = |p: [f64; 3]| {
            let [a, b, c] = self.rows.map(|row| row.map(f64::from));
            [0, 1, 2].map(|k| a[k] * p[0] + b[k] * p[1] + c[k] * p[2])
        };
        // The transposed matrix is the inverse up to the skew, and one step squares that.
        let near = transposed(place.map(f64::from));
        let there = self.times(near);
        let rest = transposed([0, 1, 2].map(|k| f64::from(place[k]) - there[k]));
        [0, 1, 2].map(|k| near[k] + rest[k])
    }

    /// The mesh in the triboxes' frame, its vertices rounded to f32, and how far a vertex is off at
    /// most.
    pub(super) fn mesh(&self, mesh: &Mesh) -> (Mesh, f64) {
        let mut off = 0f64;
        let turn = |&point: &[f32; 3]| {
            let place = self.place(point);
            let rounded = place.map(|x| x as f32);
            let size = place.iter().zip(point).map(|(x, p)| x.abs() + 2.0 * f64::from(p.abs()));
            let away = place.iter().zip(rounded).map(|(x, y)| (x - f64::from(y)).abs());
            // A 1-norm, which is no less than the length.
            off = off.max(away.sum::<f64>() + size.sum::<f64>() * DOUBT);
            rounded
        };
        let positions = mesh.positions.iter().map(turn).collect();
        (Mesh { positions, filed: None, ..mesh.clone() }, off)
    }
}

/// A rotation as a quaternion, the real part first; of any length.
type Quaternion = [f64; 4];

fn product(a: Quaternion, b: Quaternion) -> Quaternion {
    let ([p, q, r, s], [w, x, y, z]) = (a, b);
    let parts = [
        p * w - q * x - r * y - s * z,
        p * x + q * w + r * z - s * y,
        p * y - q * z + r * w + s * x,
        p * z + q * y - r * x + s * w,
    ];
    let length = parts.iter().map(|x| x * x).sum::<f64>().sqrt();
    parts.map(|x| x / length)
}

fn turn([w, x, y, z]: Quaternion) -> Turn {
    let s = 2.0 / (w * w + x * x + y * y + z * z);
    let rows = [
        [1.0 - s * (y * y + z * z), s * (x * y - z * w), s * (z * x + y * w)],
        [s * (x * y + z * w), 1.0 - s * (x * x + z * z), s * (y * z - x * w)],
        [s * (z * x - y * w), s * (y * z + x * w), 1.0 - s * (x * x + y * y)],
    ];
    Turn { rows: rows.map(|row| row.map(|x| x as f32)) }
}

/// The measure of the tribox of points after a rotation.
fn measured(points: &[[f32; 3]], turn: &Turn, measure: Measure) -> f64 {
    let mut span = Span::EMPTY;
    points.iter().for_each(|&point| span.add(&projections(turn.place(point))));
    measure.of(Extent::of_span(&span))
}

/// The orientation of the least measure that is found, of the tribox of all of a mesh. `None` if
/// none is less than the mesh's own.
///
/// Cost: 867 passes over the vertices, and some ten thousand triboxes of up to 1,734 points.
pub(super) fn orientation(mesh: &Mesh, measure: Measure) -> Option<Turn> {
    let used: Vec<[f32; 3]> =
        mesh.all_triangles().flatten().map(|v| mesh.positions[v as usize]).collect();
    let points = extremes(&used);
    let mut random = SplitMix::new(SEED);
    let own = [1.0, 0.0, 0.0, 0.0];
    let others = (1..TRIED).map(|_| uniform(&mut random));
    let mut tried: Vec<(f64, Quaternion)> = std::iter::once(own)
        .chain(others)
        .map(|at| (measured(&points, &turn(at), measure), at))
        .collect();
    tried.sort_by(|a, b| a.0.total_cmp(&b.0));
    let improved = tried.into_iter().take(IMPROVED).map(|from| improve(&points, measure, from));
    let best = improved.reduce(|best, other| if other.0 < best.0 { other } else { best })?;
    let best = turn(best.1);
    // All vertices decide, by the stored numbers.
    (measured(&used, &best, measure) < measured(&used, &Turn::NONE, measure)).then_some(best)
}

/// A random rotation, each as likely as any other.
fn uniform(random: &mut SplitMix) -> Quaternion {
    loop {
        let at = [(); 4].map(|()| 2.0 * random.roll() - 1.0);
        let square: f64 = at.iter().map(|x| x * x).sum();
        if (0.01..1.0).contains(&square) {
            return at;
        }
    }
}

/// Turns about the axes as long as that is better.
fn improve(
    points: &[[f32; 3]],
    measure: Measure,
    (mut least, mut best): (f64, Quaternion),
) -> (f64, Quaternion) {
    // The tangent of half the angle.
    let mut by = 0.25;
    for _ in 0..HALVINGS {
        for _ in 0..TURNS {
            let mut is_better = false;
            for (axis, sign) in (0..3).flat_map(|axis| [(axis, 1.0), (axis, -1.0)]) {
                let mut small = [1.0, 0.0, 0.0, 0.0];
                small[axis + 1] = sign * by;
                let at = product(small, best);
                let here = measured(points, &turn(at), measure);
                if here < least {
                    (least, best, is_better) = (here, at, true);
                }
            }
            if !is_better {
                break;
            }
        }
        by *= 0.5;
    }
    (least, best)
}

/// Points that are the farthest in one of some directions, without copies.
fn extremes(points: &[[f32; 3]]) -> Vec<[f32; 3]> {
    if points.len() <= 3 * (2 * STEPS as usize + 1).pow(2) {
        return distinct(points.to_vec());
    }
    let mut found = Vec::new();
    for axis in 0..3 {
        for (i, j) in (-STEPS..=STEPS).flat_map(|i| (-STEPS..=STEPS).map(move |j| (i, j))) {
            let mut way = [0.0; 3];
            (way[axis], way[(axis + 1) % 3]) = (f64::from(STEPS), f64::from(i));
            way[(axis + 2) % 3] = f64::from(j);
            let (mut low, mut high) = ((f64::INFINITY, 0), (f64::NEG_INFINITY, 0));
            for (index, point) in points.iter().enumerate() {
                let [x, y, z] = point.map(f64::from);
                let along = way[0] * x + way[1] * y + way[2] * z;
                low = if along < low.0 { (along, index) } else { low };
                high = if along > high.0 { (along, index) } else { high };
            }
            found.extend([points[low.1], points[high.1]]);
        }
    }
    distinct(found)
}

fn distinct(mut points: Vec<[f32; 3]>) -> Vec<[f32; 3]> {
    points.sort_by(|a, b| {
        a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])).then(a[2].total_cmp(&b[2]))
    });
    points.dedup();
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use meshsweep_core::Tribox;

    /// Corners of a block that was turned by a quaternion of small integers.
    fn turned_block(of: Quaternion) -> Mesh {
        let corner =
            |i: usize| [0, 1, 2].map(|k| if i >> k & 1 == 1 { [4.0, 2.0, 1.0][k] } else { 0.0 });
        let turn = turn(of);
        let positions: Vec<[f32; 3]> =
            (0..8).map(|i| turn.place(corner(i)).map(|x| x as f32)).collect();
        let faces = [[0, 1, 2], [1, 3, 2], [4, 6, 5], [5, 6, 7], [0, 4, 1], [2, 3, 6]];
        Mesh::new(positions, faces.to_vec())
    }

    #[test]
    fn the_orientation_of_a_turned_block_is_found() {
        for of in [[5.0, 1.0, 2.0, 3.0], [3.0, -4.0, 1.0, 0.5], [1.0, 1.0, 0.2, -0.1]] {
            let mesh = turned_block(of);
            for (measure, wanted) in [(Measure::Volume, 8.0), (Measure::Area, 28.0)] {
                let turn = orientation(&mesh, measure).expect("better than its own");
                let found = measured(&mesh.positions, &turn, measure);
                // Chamfers may cut the corners of a block that is not along the axes.
                assert!(found < wanted * 1.01, "{found} of {wanted}");
                assert!(turn.skew() < 5e-7, "{}", turn.skew());
            }
        }
    }

    #[test]
    fn a_block_along_the_axes_stays_and_the_same_mesh_gives_the_same_bits() {
        assert_eq!(orientation(&turned_block([1.0, 0.0, 0.0, 0.0]), Measure::Volume), None);
        let mesh = turned_block([5.0, 1.0, 2.0, 3.0]);
        let [one, two] = [(); 2].map(|()| orientation(&mesh, Measure::Volume));
        assert_eq!(one, two);
    }

    #[test]
    fn places_are_within_what_is_said_of_exact_ones() {
        let mesh = turned_block([5.0, 1.0, 2.0, 3.0]);
        let of = turn([1.0, 7.0, -2.0, 3.0]);
        let (turned, off) = of.mesh(&mesh);
        assert!(off > 0.0 && off < 1e-6, "{off}");
        for (p, q) in mesh.positions.iter().zip(&turned.positions) {
            // Products of f32 are exact in f64; three of them and a fourth number in two halves.
            for (row, x) in of.rows.iter().zip(q) {
                let terms = [0, 1, 2].map(|k| f64::from(row[k]) * f64::from(p[k]));
                let away = terms[0] + terms[1] + terms[2] - f64::from(*x);
                assert!(away.abs() <= off, "{away} {off}");
            }
        }
    }

    #[test]
    fn measures_are_those_of_the_tribox_of_the_turned_points() {
        let mesh = turned_block([5.0, 1.0, 2.0, 3.0]);
        let (turned, _) = Turn::NONE.mesh(&mesh);
        let tribox = Tribox::of_points(turned.positions).unwrap();
        let span = Span { low: tribox.low.map(f64::from), high: tribox.high.map(f64::from) };
        let here = measured(&mesh.positions, &Turn::NONE, Measure::Volume);
        assert!((Extent::of_span(&span).volume / here - 1.0).abs() < 1e-5);
    }
}
