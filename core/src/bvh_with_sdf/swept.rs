//! Spheres and capsules, at rest or moving.
//!
//! A look-up at a point proves that a ball about it is clear of the surface: the lower end of its
//! distance is the ball's radius. A sphere of radius r is clear by more than d if the ball of its
//! centre is larger than r + d. So is a capsule if the balls of places on its axis, each less r +
//! d, cover the axis: the distance falls by no more than the way (figure). A sphere that moves is a
//! capsule at rest. A capsule that moves is covered by capsules at rest, each thicker by what an
//! end moves in its share of the time.
//!
//! ```text
//!          _____ . _____
//!        /       |       \ __         The ball of the middle, less r + d, reaches x.
//!  a ---|--------m--------x--|--- b   The next look-up is at x.
//!        \ _____ | _____ / --
//! ```
//!
//! What the balls do not prove is the tree's to answer.

use super::pair::BvhWithSdf;
use crate::num::tolerance::{SWEPT_LENGTH, SWEPT_PLACE, U32};
use crate::num::{greater, lesser, sqrt_approx, sum_down, sum_up};
use crate::query::{
    Budget, Decided, FirstHit, Interval, QueryError, ScratchEntry, Solid, Verdict, Work,
};

/// Look-ups from the middle of an axis to one end, at most. Where this is not enough, the capsule
/// comes so near to the surface that the tree has to answer anyway.
const MOST_PLACES: u32 = 6;

/// Shares of the time of a capsule that moves, at the first attempt and at the second.
const SHARES: [u8; 2] = [1, 4];

/// Part of a step along an axis that is kept, for a difference, a product and a quotient.
const STEP_KEPT: f32 = 1.0 - 16.0 * U32;

/// What a look-up tells of the ball of a given radius about a point.
enum Ball {
    /// The surface is within the radius.
    Meets,
    /// The surface is farther, by more than this.
    Clear {
        by: f32,
    },
    Undecided,
}

type Place = [f32; 3];

impl BvhWithSdf<'_> {
    /// Whether a point of `solid` is at most `distance` from the surface. See
    /// [`Bvh::solid_within`](crate::Bvh::solid_within), which answers where the field does not.
    ///
    /// The field decides spheres and capsules, solids of one corner and of two. A `Yes` of the
    /// field has no witness. The work of the field is 0.
    ///
    /// Cost: one look-up for a sphere, at most 13 for a capsule; and the tree's question if they do
    /// not decide.
    ///
    /// # Errors
    /// Those of [`Bvh::solid_within`](crate::Bvh::solid_within); the field also answers beyond the
    /// tree's domain.
    #[inline(never)]
    pub fn solid_within(
        &self,
        solid: &Solid<'_>,
        distance: f32,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<Decided<u32>, QueryError> {
        budget.check_about(distance, scratch)?;
        self.check_segments()?;
        let radius = solid.radius();
        // No sum of two lengths is below the greatest f32 if it exceeds f32's range.
        let least = lesser(sum_down(radius, distance), f32::MAX);
        let radius = Interval::new(least, sum_up(radius, distance));
        let met = match solid.corners() {
            [centre] => match self.ball(*centre, &radius) {
                Ball::Meets => Some(true),
                Ball::Clear { .. } => Some(false),
                Ball::Undecided => None,
            },
            [a, b] => self.capsule([*a, *b], &radius),
            _ => None,
        };
        let verdict = match met {
            Some(true) => Verdict::Yes,
            Some(false) => Verdict::No,
            None => return self.tree().solid_within(solid, distance, budget, scratch),
        };
        Ok(Decided { verdict, witness: None, work: Work::NONE })
    }

    /// Where a solid that moves first meets the surface. See
    /// [`Bvh::solid_first_contact`](crate::Bvh::solid_first_contact), which answers unless the
    /// field proves that the whole motion of a sphere or a capsule is clear.
    ///
    /// Cost: at most 13 look-ups for a sphere and 65 for a capsule; and the tree's question if they
    /// do not prove it.
    ///
    /// # Errors
    /// Those of [`Bvh::solid_first_contact`](crate::Bvh::solid_first_contact); the field also
    /// answers beyond the tree's domain.
    #[inline(never)]
    pub fn solid_first_contact(
        &self,
        from: &Solid<'_>,
        to: &Solid<'_>,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<FirstHit, QueryError> {
        budget.check_with(scratch)?;
        self.check_segments()?;
        let radius = greater(from.radius(), to.radius());
        let is_clear = match (from.corners(), to.corners()) {
            ([start], [end]) => self.is_clear([*start, *end], radius),
            ([a, b], [c, d]) => SHARES
                .into_iter()
                .any(|shares| self.is_clear_moving([[*a, *b], [*c, *d]], radius, shares)),
            _ => false,
        };
        if is_clear {
            return Ok(FirstHit::CLEAR);
        }
        self.tree().solid_first_contact(from, to, budget, scratch)
    }

    /// Whether a capsule that moves is proved to be clear, by so many shares of the time.
    fn is_clear_moving(&self, [start, end]: [[Place; 2]; 2], radius: f32, shares: u8) -> bool {
        let ([a, b], [c, d]) = (start, end);
        let moved = greater(self.length(minus(c, a)), self.length(minus(d, b)));
        let share = 1.0 / f32::from(shares);
        // In the middle of its share an end is as far from both of its ends.
        let error = greater(place_error([a, c]), place_error([b, d]));
        let radius = sum_up(sum_up(radius, 0.5 * share * moved), error);
        (0..shares).all(|number| {
            let t = (f32::from(number) + 0.5) * share;
            self.is_clear([along(a, minus(c, a), t), along(b, minus(d, b), t)], radius)
        })
    }

    /// Whether a capsule is proved to be clear.
    #[inline(never)]
    fn is_clear(&self, ends: [Place; 2], radius: f32) -> bool {
        // Nothing is below.
        let radius = Interval::new(f32::NEG_INFINITY, radius);
        self.capsule(ends, &radius) == Some(false)
    }

    /// Whether the surface is within a radius of a segment, if the field decides. The radius is
    /// rounded down and up.
    #[inline(never)]
    fn capsule(&self, ends: [Place; 2], radius: &Interval) -> Option<bool> {
        let error = place_error(ends);
        let radius = &Interval::new(sum_down(radius.lower, -error), sum_up(radius.upper, error));
        let [[a, b, c], [x, y, z]] = ends;
        // A sum of halves does not overflow.
        let halves = |a: f32, b: f32| 0.5 * a + 0.5 * b;
        let middle = [halves(a, x), halves(b, y), halves(c, z)];
        let first = match self.ball(middle, radius) {
            Ball::Clear { by } => by,
            Ball::Meets => return Some(true),
            Ball::Undecided => return None,
        };
        for end in ends {
            let way = minus(end, middle);
            let length = self.length(way);
            let mut t = first / length * STEP_KEPT;
            for _ in 0..MOST_PLACES {
                if t >= 1.0 {
                    break;
                }
                match self.ball(along(middle, way, t), radius) {
                    // If t is a NaN, the next look-up is undecided, or the loop runs out.
                    Ball::Clear { by } => t = sum_down(t, by / length * STEP_KEPT),
                    Ball::Meets => return Some(true),
                    Ball::Undecided => return None,
                }
            }
            let is_covered = t >= 1.0;
            if !is_covered {
                return None;
            }
        }
        Some(false)
    }

    #[inline(always)]
    fn ball(&self, centre: Place, radius: &Interval) -> Ball {
        let Interval { lower, upper } = self.known(centre);
        if lower > radius.upper {
            Ball::Clear { by: lower - radius.upper }
        } else if upper <= radius.lower {
            Ball::Meets
        } else {
            Ball::Undecided
        }
    }

    /// Upper bound of a length in input units, a normal number. The squares are of units of the
    /// field, for those of input units may leave f32's range.
    fn length(&self, [x, y, z]: Place) -> f32 {
        let scale = self.field().per_unit();
        let [x, y, z] = [x * scale, y * scale, z * scale];
        let units = sqrt_approx(x * x + y * y + z * z) * SWEPT_LENGTH;
        units * (self.field().unit() * (1.0 + 4.0 * U32)) + f32::MIN_POSITIVE
    }
}

/// How far places between two points may be from their computed places.
fn place_error([[a, b, c], [x, y, z]]: [Place; 2]) -> f32 {
    let sum = (a.abs() + x.abs()) + (b.abs() + y.abs()) + (c.abs() + z.abs());
    sum * (SWEPT_PLACE * U32) + f32::MIN_POSITIVE
}

fn minus([a, b, c]: Place, [x, y, z]: Place) -> Place {
    [a - x, b - y, c - z]
}

fn along([a, b, c]: Place, [x, y, z]: Place, t: f32) -> Place {
    [a + x * t, b + y * t, c + z * t]
}
