//! How a model moves from one pose to another. Derivation: `core/docs/rounding.md` §19.

use super::rotation::check_rigid;
use crate::geom::{Point, Pose, cross, dot, minus, transposed};
use crate::num::greater;
use crate::num::tolerance::{SCREW_ROUNDING, U32, U64};
use crate::query::error::QueryError;

type Vector = Point<f64>;

/// A motion of a model from one pose to another. Its time runs from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    from: Pose,
    path: Path,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Path {
    /// To this pose, entries mixed.
    Straight(Pose),
    Screw(Twist),
}

/// A steady turn about an axis and a steady way along it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Twist {
    /// A unit vector.
    axis: Vector,
    /// Radians, 0 to π.
    angle: f64,
    /// Velocity of the model's origin at the time 0.
    velocity: Vector,
    /// What is missing at the end to the second pose, because matrices are no perfect rotations:
    /// rows, and the shift. It is added in proportion to the time.
    rest: ([Vector; 3], Vector),
}

impl Motion {
    /// Each point goes along a straight line from its place in `from` to its place in `to`, at a
    /// steady pace: the entries of both poses are mixed. If both have the same rotation it is a
    /// translation; else the model shrinks on the way as it turns. Nothing is checked here. A
    /// question about the motion refuses an end whose matrix is no rotation, unless that pose [is
    /// affine](Pose::is_affine).
    /// Translations are in the unit of the first model of the question.
    pub const fn straight(from: Pose, to: Pose) -> Motion {
        Motion { from, path: Path::Straight(to) }
    }

    /// A screw: the model stays rigid, turns at a steady pace about a fixed axis by half a turn at
    /// most, and goes along this axis. It begins at `from` and ends at `to`. Rounded matrices are
    /// no perfect rotations; the difference at the end is added in proportion to the time. Of
    /// exactly half a turn either direction may be taken. A longer turn is two motions.
    ///
    /// Cost: some hundred operations in f64 here, and as many for each pose on the way.
    ///
    /// # Errors
    /// [`QueryError::NotFinite`]; [`QueryError::NotRigid`] if a matrix is no rotation.
    pub fn screw(from: Pose, to: Pose) -> Result<Motion, QueryError> {
        for pose in [&from, &to] {
            if !is_finite(pose) {
                return Err(QueryError::NotFinite);
            }
            check_rigid(&Pose { is_affine: false, ..*pose })?;
        }
        let [(start, from_shift), (end, to_shift)] = [&from, &to].map(Pose::wide);
        // end · startᵀ
        let turn = end.map(|row| start.map(|other| dot(row, other)));
        let (axis, angle) = axis_and_angle(&turn);
        // The inverse of `Twist::displacement` at the time 1.
        let (along, across) = split(axis, minus(to_shift, from_shift));
        let (mean_cosine, mean_sine) = mean_turn(angle);
        let size = mean_cosine * mean_cosine + mean_sine * mean_sine;
        let velocity = combined(
            [1.0, mean_cosine / size, -mean_sine / size],
            [along, across, cross(axis, across)],
        );
        let mut twist = Twist { axis, angle, velocity, rest: ([[0.0; 3]; 3], [0.0; 3]) };
        let (rows, shift) = twist.pose_at(&from, 1.0);
        let ([r0, r1, r2], [e0, e1, e2]) = (rows, end);
        twist.rest = ([minus(e0, r0), minus(e1, r1), minus(e2, r2)], minus(to_shift, shift));
        Ok(Motion { from, path: Path::Screw(twist) })
    }

    /// The pose at a time from 0 to 1, rounded to f32. Other times continue the motion. The pose
    /// [is affine](Pose::is_affine) if entries of two different matrices were mixed. On a screw it
    /// is if `from` is, or if the matrix is no rotation up to three decimals.
    pub fn at(&self, t: f32) -> Pose {
        let pose = self.at_time(f64::from(t));
        let is_bent = matches!(self.path, Path::Screw(_)) && check_rigid(&pose).is_err();
        Pose { is_affine: pose.is_affine || is_bent, ..pose }
    }

    pub(crate) fn at_time(&self, t: f64) -> Pose {
        match &self.path {
            Path::Straight(to) => mixed(&self.from, to, t),
            Path::Screw(twist) => twist.pose(&self.from, t),
        }
    }

    pub(crate) fn is_finite(&self) -> bool {
        is_finite(&self.from)
            && match &self.path {
                Path::Straight(to) => is_finite(to),
                Path::Screw(_) => true,
            }
    }

    /// Refuses ends that are no rotations, unless a pose says that its matrix may be any.
    pub(crate) fn check_rigid(&self) -> Result<(), QueryError> {
        check_rigid(&self.from)?;
        match &self.path {
            Path::Straight(to) => check_rigid(to),
            Path::Screw(_) => Ok(()),
        }
    }

    /// Upper bounds of the path of a point of the model during the motion, and of how far it may be
    /// from its place at a pose that was rounded to f32. Both are convex functions of the point.
    /// Units of the translations.
    pub(crate) fn path_bounds(&self, point: Vector) -> (f64, f64) {
        match &self.path {
            Path::Straight(to) => straight_bounds(&self.from, to, point),
            Path::Screw(twist) => twist.path_bounds(&self.from, point),
        }
    }
}

impl Twist {
    fn pose(&self, from: &Pose, t: f64) -> Pose {
        let (rows, shift) = self.pose_at(from, t);
        let mut pose = *from;
        for (row, place) in pose.rotation.iter_mut().zip(rows) {
            row.iter_mut().zip(place).for_each(|(entry, x)| *entry = x as f32);
        }
        pose.translation.iter_mut().zip(shift).for_each(|(entry, x)| *entry = x as f32);
        pose
    }

    /// Rows of the matrix at a time, and the shift.
    fn pose_at(&self, from: &Pose, t: f64) -> ([Vector; 3], Vector) {
        let angle = self.angle * t;
        let half = libm::sin(0.5 * angle);
        let (sine, versine) = (libm::sin(angle), 2.0 * half * half);
        let turned = |v: Vector| {
            let once = cross(self.axis, v);
            combined([1.0, sine, versine], [v, once, cross(self.axis, once)])
        };
        let (rest_rows, rest_shift) = self.rest;
        let with_rest = |x: Vector, rest: Vector| combined([1.0, t, 0.0], [x, rest, [0.0; 3]]);
        // A turn turns the columns.
        let (rows, from_shift) = from.wide();
        let [r0, r1, r2] = transposed(&transposed(&rows).map(turned));
        let [d0, d1, d2] = rest_rows;
        let travel = self.displacement(angle, t);
        let shift = combined([1.0, 1.0, t], [from_shift, travel, rest_shift]);
        ([with_rest(r0, d0), with_rest(r1, d1), with_rest(r2, d2)], shift)
    }

    /// How far the model's origin has gone until the time `t`, when it has turned by `angle`: the
    /// integral of the velocity, which turns too.
    fn displacement(&self, angle: f64, t: f64) -> Vector {
        let (along, across) = split(self.axis, self.velocity);
        let (mean_cosine, mean_sine) = mean_turn(angle);
        combined([t, t * mean_cosine, t * mean_sine], [along, across, cross(self.axis, across)])
    }

    /// A point of a rigid body that turns and goes steadily has a steady speed. What is missing at
    /// the end adds its own.
    fn path_bounds(&self, from: &Pose, point: Vector) -> (f64, f64) {
        let (rotation, from_shift) = from.wide();
        let arm = rotation.map(|row| dot(row, point));
        let turning = cross(self.axis, arm).map(|x| x * self.angle);
        let speed = length(combined([1.0, 1.0, 0.0], [self.velocity, turning, [0.0; 3]]));
        // No row of a turned matrix is longer than the Frobenius norm of the first matrix.
        let stretch = libm::sqrt(rotation.iter().map(|row| dot(*row, *row)).sum());
        let (rest_rows, [p, q, r]) = self.rest;
        let [x, y, z] = rest_rows.map(|row| dot(row, point));
        let rest = length([x + p, y + q, z + r]);
        let far = stretch * length(point)
            + length(from_shift)
            + length(self.velocity)
            + rest
            + f64::from(f32::MIN_POSITIVE);
        (speed + rest + far * (64.0 * U64), 3.0 * far * f64::from(U32) * SCREW_ROUNDING)
    }
}

fn straight_bounds(from: &Pose, to: &Pose, point: Vector) -> (f64, f64) {
    let (mut travel_sq, mut rounding) = (0.0, 0.0);
    let starts = from.rotation.iter().zip(&from.translation);
    let ends = to.rotation.iter().zip(&to.translation);
    for ((row, shift), (end_row, end_shift)) in starts.zip(ends) {
        let mut travel = difference(*shift, *end_shift);
        let mut far = most(*shift, *end_shift);
        for ((a, b), x) in row.iter().zip(end_row).zip(point) {
            travel += difference(*a, *b) * x;
            far += most(*a, *b) * x.abs();
        }
        // Terms that cancel are rounded in proportion to their sizes.
        let travel = travel.abs() + far * (16.0 * U64);
        travel_sq += travel * travel;
        rounding += far * (f64::from(U32) * (1.0 + 16.0 * U64));
    }
    (libm::sqrt(travel_sq) * (1.0 + 16.0 * U64), rounding)
}

/// The entries of two poses, mixed.
fn mixed(from: &Pose, to: &Pose, t: f64) -> Pose {
    let mix = |a: f32, b: f32| (f64::from(a) + difference(a, b) * t) as f32;
    let mut pose = *from;
    let entries = pose.rotation.iter_mut().flatten().zip(to.rotation.iter().flatten());
    entries.for_each(|(x, to)| *x = mix(*x, *to));
    pose.translation.iter_mut().zip(&to.translation).for_each(|(x, to)| *x = mix(*x, *to));
    pose.is_affine |= to.is_affine || from.rotation != to.rotation;
    pose
}

/// Axis and angle of a rotation, by the largest component of its quaternion (Shepperd 1978). Any
/// axis if it turns nothing.
fn axis_and_angle(turn: &[Vector; 3]) -> (Vector, f64) {
    let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = *turn;
    // Each is four times a product of two components, in the order x, y, z, w.
    let squares = [1.0 + xx - yy - zz, 1.0 - xx + yy - zz, 1.0 - xx - yy + zz, 1.0 + xx + yy + zz];
    let [x_sq, y_sq, z_sq, w_sq] = squares;
    let (xy, yz, zx, xw, yw, zw) = (xy + yx, yz + zy, zx + xz, zy - yz, xz - zx, yx - xy);
    let largest = squares.into_iter().fold(0.0, greater);
    let [x, y, z, w] = if w_sq >= largest {
        [xw, yw, zw, w_sq]
    } else if x_sq >= largest {
        [x_sq, xy, zx, xw]
    } else if y_sq >= largest {
        [xy, y_sq, yz, yw]
    } else {
        [zx, yz, z_sq, zw]
    };
    let sine = length([x, y, z]);
    if sine == 0.0 {
        return ([1.0, 0.0, 0.0], 0.0);
    }
    // The shorter of both ways round.
    let sign = if w < 0.0 { -1.0 } else { 1.0 };
    ([x, y, z].map(|x| sign * x / sine), 2.0 * libm::atan2(sine, w.abs()))
}

fn is_finite(pose: &Pose) -> bool {
    pose.rotation.iter().flatten().chain(&pose.translation).all(|x| x.is_finite())
}

fn combined([a, b, c]: [f64; 3], [u, v, w]: [Vector; 3]) -> Vector {
    let ([ux, uy, uz], [vx, vy, vz], [wx, wy, wz]) = (u, v, w);
    [a * ux + b * vx + c * wx, a * uy + b * vy + c * wy, a * uz + b * vz + c * wz]
}

fn length(v: Vector) -> f64 {
    libm::sqrt(dot(v, v))
}

/// The parts of a vector along an axis and across it.
fn split(axis: Vector, v: Vector) -> (Vector, Vector) {
    let along = axis.map(|n| n * dot(axis, v));
    (along, minus(v, along))
}

/// The means of the cosine and of the sine on a turn from 0 to an angle: sin x / x and (1 − cos x)
/// / x.
fn mean_turn(angle: f64) -> (f64, f64) {
    (sinc(angle), libm::sin(0.5 * angle) * sinc(0.5 * angle))
}

/// sin x / x.
fn sinc(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { libm::sin(x) / x }
}

fn difference(a: f32, b: f32) -> f64 {
    f64::from(b) - f64::from(a)
}

/// The greater size, and no less than what an f32 may lose by underflow.
fn most(a: f32, b: f32) -> f64 {
    greater(f64::from(a).abs(), f64::from(b).abs()) + f64::from(f32::MIN_POSITIVE)
}
