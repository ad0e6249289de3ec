//! Carries proofs about rounded segments and rays over to those that the caller gave.

use meshsweep_core::{Ended, FirstHit, Interval, QueryError, Work};

/// Balls along a segment, at most.
const MAX_BALLS: usize = 64;

/// An upper bound of how far rounding moved a point of a row's segment. Rows have both points, and
/// an upper bound for each.
pub fn moved(row: &[f32]) -> f64 {
    row.iter().skip(6).take(2).fold(0.0, |most, &off| most.max(off.into()))
}

/// A segment, or the part of a ray before it is behind the model.
pub struct Way {
    pub ends: [[f32; 3]; 2],
    /// No point is farther than this from the caller's.
    pub moved: f64,
    /// The parameter at the end.
    until: f64,
    is_ray: bool,
}

impl Way {
    pub fn of_segment(ends: [[f32; 3]; 2], moved: f64) -> Self {
        Self { ends, moved, until: 1.0, is_ray: false }
    }

    /// Of a ray whose origin and direction were moved by so much. The box holds the input. If the
    /// direction may be any, or the end is too far away, points may be anywhere.
    pub fn of_ray(
        [a, way]: [[f32; 3]; 2],
        [off, off_way]: [f64; 2],
        bounds: [[f32; 3]; 2],
    ) -> Self {
        let origin = a;
        let ([a, way], [low, high]) = ([a, way].map(wide), bounds.map(wide));
        let radius = 0.5 * norm(minus(high, low));
        let centre = core::array::from_fn(|k| 0.5 * (low[k] + high[k]));
        let pace = norm(way) - off_way;
        // The factor covers the rounding of these sums.
        let until = (radius + norm(minus(centre, a)) + off) / pace * (1.0 + 1e-9);
        let end = along(a, way, until);
        let rounded = end.map(|x| x as f32);
        let rounding = norm(minus(end, wide(rounded))) + 1e-15 * (norm(a) + norm(end));
        let moved = off + until * off_way + rounding;
        let is_known = pace > 0.0 && rounded.iter().all(|x| x.is_finite());
        match is_known {
            true => Self { ends: [origin, rounded], moved, until, is_ray: true },
            false => Self { ends: [origin; 2], moved: f64::INFINITY, until: 0.0, is_ray: true },
        }
    }

    /// Whether the caller's way misses the box that holds the input. No distance is measured, so it
    /// tells that of ways that are too long for other questions.
    ///
    /// A plane between both is looked for: a side of the box, or one along the way and an axis.
    pub fn misses(&self, bounds: [[f32; 3]; 2]) -> bool {
        let ([a, b], [low, high]) = (self.ends.map(wide), bounds.map(wide));
        // The box grows by the motion of the way, and by the rounding of differences.
        let rounding = |k: usize| 1e-15 * (low[k].abs() + high[k].abs() + self.moved);
        let half: [f64; 3] =
            core::array::from_fn(|k| 0.5 * (high[k] - low[k]) + self.moved + rounding(k));
        let from: [f64; 3] = core::array::from_fn(|k| a[k] - 0.5 * (low[k] + high[k]));
        let to: [f64; 3] = core::array::from_fn(|k| b[k] - 0.5 * (low[k] + high[k]));
        let way = minus(b, a);
        // The factors cover the rounding of these sums.
        let is_beyond = |k: usize| {
            from[k].min(to[k]) > half[k] * (1.0 + 1e-14)
                || from[k].max(to[k]) < -half[k] * (1.0 + 1e-14)
        };
        let is_beside = |k: usize| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            let (one, other) = (from[i] * way[j], from[j] * way[i]);
            let reach = half[i] * way[j].abs() + half[j] * way[i].abs();
            (one - other).abs() > reach + 1e-14 * (reach + one.abs() + other.abs())
        };
        (0..3).any(|k| is_beyond(k) || is_beside(k))
    }

    /// A clear first hit of the rounded way, where only this fraction of the caller's way is proved
    /// to be clear.
    pub fn undecided(&self, mut clear: FirstHit, fraction: f64) -> FirstHit {
        let lower = ((fraction * self.until) as f32).next_down().max(0.0);
        clear.t = Interval::new(lower, if self.is_ray { f32::INFINITY } else { 1.0 });
        clear.ended = Ended::Resolution;
        clear
    }

    /// The same by balls along the way, each as large as is proved to be clear by a lower bound of
    /// the distance of its centre.
    ///
    /// # Errors
    /// Those of the distance.
    pub fn by_balls(
        &self,
        mut clear: FirstHit,
        distance: impl FnMut([f32; 3]) -> Result<(f32, Work), QueryError>,
    ) -> Result<FirstHit, QueryError> {
        let (fraction, work) = self.cleared(distance)?;
        clear.work = clear.work.and(work);
        Ok(if fraction < 1.0 { self.undecided(clear, fraction) } else { clear })
    }

    /// The fraction of the way that balls prove to be clear, and the work.
    ///
    /// # Errors
    /// Those of the distance.
    pub fn cleared(
        &self,
        mut distance: impl FnMut([f32; 3]) -> Result<(f32, Work), QueryError>,
    ) -> Result<(f64, Work), QueryError> {
        let [a, b] = self.ends.map(wide);
        let (way, rounding) = (minus(b, a), 1e-12 * (norm(a) + norm(b)));
        let (length, mut fraction, mut work) = (norm(way), 0.0, Work::NONE);
        for _ in 0..MAX_BALLS {
            let at = along(a, way, fraction);
            let centre = at.map(|x| x as f32);
            let (near, more) = distance(centre)?;
            work = work.and(more);
            let off = norm(minus(at, wide(centre))) + self.moved + rounding;
            let free = f64::from(near) - off;
            if free <= 0.0 {
                break;
            }
            if free >= (1.0 - fraction) * length {
                return Ok((1.0, work));
            }
            fraction += free / length;
        }
        Ok((fraction.min(1.0_f64.next_down()), work))
    }
}

fn wide(x: [f32; 3]) -> [f64; 3] {
    x.map(f64::from)
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    core::array::from_fn(|k| a[k] - b[k])
}

fn along(a: [f64; 3], way: [f64; 3], t: f64) -> [f64; 3] {
    core::array::from_fn(|k| a[k] + t * way[k])
}

fn norm(x: [f64; 3]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}
