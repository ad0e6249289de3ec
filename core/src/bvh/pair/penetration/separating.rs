//! The upper end of the depth: separating translations.
//!
//! From afar: the second model is moved along a direction until the boxes are apart. In place: it
//! is moved by a short way, and the solids are proved apart there. From both places it goes
//! straight back to its pose. Until the first contact the solids are apart. The translation from
//! the pose to that place separates them.
//!
//! The way from afar crosses all walls: it finds no place inside a hole or a slot. Short ways do.

use super::deepest::{AXES, DIAGONALS, Deepest, moved, normalized};
use super::pair_queries::PairQueries;
use crate::bvh::pair::advance::longest_path;
use crate::bvh::tree::input_box::corners_of_input;
use crate::geom::{Pose, dot};
use crate::num::tolerance::{PARTED, U32, U64};
use crate::num::{greater, lesser, up_to_f32};
use crate::query::{Budget, Motion, QueryError, Relation};

type Vector = [f64; 3];

/// Fractions of the motion by which the pose is moved back from the contact, until the surfaces at
/// the pose, rounded to f32, are proved apart.
const BACK: [f32; 5] = [1.0 / 4194304.0, 1.0 / 262144.0, 1.0 / 16384.0, 1.0 / 1024.0, 1.0 / 64.0];

/// Directions that are tried from afar: the first ones, and the axes.
const FROM_AFAR: usize = 9;

/// The first travel that is tried in place, as a fraction of the lower end.
const FIRST_TRAVEL: f64 = 1.125;

/// The first travel is at least this fraction of the best translation from afar. If solids only
/// touch, the lower end is 0.
const LEAST_TRAVEL: f64 = 1.0 / 1_048_576.0;

/// Each way is longer than the last one by this factor. So a hole whose play is at least half of
/// the depth has a way that ends in it.
const LONGER: f64 = 1.5;

/// A way across the surfaces at the contact, as a part of the best translation.
const ACROSS: f64 = 0.9375;

/// A pose at which the solids are apart.
#[derive(Clone, Copy)]
pub(super) struct Separating {
    pub(super) apart: Option<Pose>,
    /// The length of the translation there, input units, rounded up.
    pub(super) length: f64,
    /// From the first model to the second at the contact.
    contact: Vector,
}

/// The shortest separating translation that was found.
pub(super) fn search(
    queries: &mut PairQueries<'_, '_>,
    deepest: &Deepest,
    budget: &Budget,
) -> Result<Separating, QueryError> {
    let mut best = Separating { apart: None, length: f64::INFINITY, contact: [0.0; 3] };
    let [a, b] = deepest.deeper.map(normalized);
    let ([ax, ay, az], [bx, by, bz]) = (a, b);
    // The deepest point leaves the first solid through its nearest wall (-a), the second one
    // through its nearest wall (b), or both; then the axes.
    let directions = [normalized([bx - ax, by - ay, bz - az]), a.map(|x| -x), b];
    let directions = directions.into_iter().chain(AXES).chain(DIAGONALS);
    let lower = deepest.proved();
    for direction in directions.clone().take(FROM_AFAR) {
        best.try_from_afar(queries, direction)?;
        if best.meets_tolerance(lower, budget) {
            queries.met_tolerance = best.length > lower;
            return Ok(best);
        }
    }
    let mut travel = greater(lower * FIRST_TRAVEL, best.length * LEAST_TRAVEL);
    while travel < best.length {
        for direction in directions.clone() {
            best.try_in_place(queries, direction, travel)?;
        }
        if best.meets_tolerance(lower, budget) {
            queries.met_tolerance = best.length > lower;
            return Ok(best);
        }
        travel *= LONGER;
    }
    // Across the surfaces at the contact.
    for _ in 0..3 {
        let before = best.length;
        let across = normalized(best.contact);
        best.try_from_afar(queries, across)?;
        best.try_in_place(queries, across, before * ACROSS)?;
        if best.length >= before {
            break;
        }
    }
    Ok(best)
}

impl Separating {
    /// Whether the depth is known as well as the budget asks.
    fn meets_tolerance(&self, lower: f64, budget: &Budget) -> bool {
        let relative = lower * (1.0 + f64::from(budget.relative));
        self.length <= greater(relative, lower + f64::from(budget.absolute))
    }

    /// Looks for a translation along a unit vector that comes back from where the boxes are apart.
    fn try_from_afar(
        &mut self,
        queries: &mut PairQueries<'_, '_>,
        direction: Vector,
    ) -> Result<(), QueryError> {
        if direction == [0.0; 3] || queries.is_spent() {
            return Ok(());
        }
        match beside(queries, direction) {
            Some(start) => self.come_back(queries, start),
            None => Ok(()),
        }
    }

    /// Looks for a translation along a unit vector that is no longer than a way, if that is shorter
    /// than the best one.
    fn try_in_place(
        &mut self,
        queries: &mut PairQueries<'_, '_>,
        direction: Vector,
        travel: f64,
    ) -> Result<(), QueryError> {
        let Some(start) = shifted(&queries.pose, direction, travel) else { return Ok(()) };
        let is_shorter = length_between(&start, &queries.pose) < self.length;
        if !is_shorter || direction == [0.0; 3] || queries.is_spent() {
            return Ok(());
        }
        // The surfaces do not meet, and neither lies inside the other.
        if queries.is_clear(&start, 0.0)? && queries.relation(&start)? == Relation::Apart {
            return self.come_back(queries, start);
        }
        Ok(())
    }

    /// Goes straight back to the pose from one at which the solids are apart.
    fn come_back(
        &mut self,
        queries: &mut PairQueries<'_, '_>,
        start: Pose,
    ) -> Result<(), QueryError> {
        let pose = queries.pose;
        let motion = Motion::straight(start, pose);
        let met = queries.first_contact(&motion)?;
        if met.is_clear() {
            (self.apart, self.length) = (Some(pose), 0.0);
            return Ok(());
        }
        let [_, b] = queries.trees;
        let (_, rounding) = longest_path(b, &motion);
        for back in BACK {
            let at = motion.at(greater(met.clear_until - back, 0.0));
            let length = length_between(&at, &pose);
            if length >= self.length {
                return Ok(());
            }
            // The surfaces are farther apart here than f32 moved any point of the pose. So the
            // rounded pose is clear too.
            if queries.is_clear(&at, up_to_f32(rounding))? {
                let [from, to] = met.points.map(|point| point.map(f64::from));
                let ([x, y, z], [u, v, w]) = (from, to);
                let contact = [u - x, v - y, w - z];
                *self = Separating { apart: Some(at), length, contact };
                return Ok(());
            }
        }
        let length = length_between(&start, &pose);
        if length < self.length {
            *self = Separating { apart: Some(start), length, contact: [0.0; 3] };
        }
        Ok(())
    }
}

/// The pose moved along a unit vector until the boxes are apart along it. `None` if no f32
/// translation reaches there.
fn beside(queries: &PairQueries<'_, '_>, direction: Vector) -> Option<Pose> {
    let [a, b] = queries.trees;
    let mut most = f64::NEG_INFINITY;
    let mut size = 0.0;
    for corner in corners_of_input(a) {
        most = greater(most, dot(direction, corner));
        size = greater(size, dot(corner.map(f64::abs), [1.0; 3]));
    }
    // Where the second model begins along the direction, as computed, and the size of the numbers
    // that were rounded.
    let begins = |pose: &Pose| {
        corners_of_input(b).fold((f64::INFINITY, size), |(least, size), corner| {
            let place = pose.carry(corner);
            let numbers = dot(corner.map(f64::abs), [2.0; 3])
                + dot(pose.translation.map(|x| f64::from(x).abs()), [1.0; 3]);
            (lesser(least, dot(direction, place)), greater(size, numbers))
        })
    };
    let (least, size) = begins(&queries.pose);
    let gap = greater(most - least, 0.0);
    let mut room = size * (8.0 * f64::from(U32));
    for _ in 0..4 {
        let start = shifted(&queries.pose, direction, gap + room)?;
        let (least, size) = begins(&start);
        if least - most > PARTED * U64 * size {
            return Some(start);
        }
        room *= 4.0;
    }
    None
}

/// The pose moved along a unit vector. `None` if f32 has no such translation.
fn shifted(pose: &Pose, direction: Vector, travel: f64) -> Option<Pose> {
    Some(Pose { translation: moved(pose.translation, direction, travel)?, ..*pose })
}

/// How far the translations of two poses are from each other, rounded up.
fn length_between(one: &Pose, other: &Pose) -> f64 {
    let mut squares = 0.0;
    for (x, y) in one.translation.iter().zip(&other.translation) {
        let travel = f64::from(*x) - f64::from(*y);
        squares += travel * travel;
    }
    libm::sqrt(squares) * (1.0 + 8.0 * U64)
}
