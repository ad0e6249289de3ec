//! The proof of a cell's errors, by branch and bound over boxes.
//!
//! A cell begins with errors that are wanted. Its box is accepted if bounds of the difference
//! between distance and function ([`super::bound`]) show that the errors suffice; else its parts,
//! eight of a cube, are looked at. A box of the least size widens the errors to what its bounds
//! need. So the errors always hold; how good they are depends on the wanted ones.

use super::bound::{flat, greatest, least, most, most_of_facet};
use super::function::{Function, Linear};
use super::region::{MARGIN, Near, Region, TIE, parts};
use super::truth::{Side, Truth};
use glam::DVec3;
use meshsweep_core::SdfKind;

/// Most boxes of a cell: then boxes count as if they were of the least size. Cells that need so
/// many are wide for another reason.
const MOST_BOXES: usize = 200_000;

/// Wanted errors are above those of the samples, at least by this part of the diagonal. Samples
/// miss what lies between them, and a proof without slack never ends.
pub(super) const SLACK_OF_DIAGONAL: f64 = 1e-4;

/// Boxes of no larger radius than this part of the diagonal are not halved.
pub(super) const FLOOR_OF_DIAGONAL: f64 = 3e-4;

/// Errors of a cell, units: F − low ≤ s ≤ F + high.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Errors {
    pub low: f64,
    pub high: f64,
}

/// The proof of a cell.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Proof {
    pub errors: Errors,
    /// Boxes that were looked at.
    pub boxes: usize,
    /// Whether the errors are larger than the wanted ones.
    pub is_widened: bool,
    /// Whether some of its points have no certain side.
    pub is_undecided: bool,
}

/// The errors of a box that bounds show to suffice.
fn needed(
    truth: &Truth<'_>,
    linear: &Linear,
    region: &Region,
    nears: &[Near],
    side: Option<Side>,
    wanted: Errors,
) -> Errors {
    let negative = linear.negative();
    let facets = &truth.facets;
    let above = || {
        let found = most(linear, region, nears, wanted.high);
        if found > wanted.high { found.min(most_of_facet(linear, region, facets)) } else { found }
    };
    // Of the distance inside, which is negative.
    let below = || {
        let found = most(&negative, region, nears, wanted.low);
        if found > wanted.low { found.min(most_of_facet(&negative, region, facets)) } else { found }
    };
    let to_zero = || greatest(linear, region);
    match (truth.kind, side) {
        (SdfKind::Surface, _) | (_, Some(Side::Outside)) => {
            let low = (-least(linear, region, nears)).min(to_zero());
            Errors { low, high: above() }
        }
        // The mesh holds this box inside, but the input may have it outside: the distance above
        // counts too.
        (SdfKind::Solid, Some(Side::Inside))
            if truth.off > 0.0 && region.least <= region.radius + truth.off + MARGIN =>
        {
            Errors { low: to_zero(), high: -least(&negative, region, nears) }
        }
        (SdfKind::Solid, Some(Side::Inside)) => Errors { low: to_zero(), high: f64::NEG_INFINITY },
        (SdfKind::Solid, Some(Side::Undecided)) => Errors { low: to_zero(), high: above() },
        (_, Some(Side::Inside)) => Errors { low: below(), high: -least(&negative, region, nears) },
        (_, Some(Side::Undecided)) => Errors { low: below(), high: above() },
        (kind, None) => {
            let low = if kind == SdfKind::Solid { to_zero() } else { f64::INFINITY };
            let mut errors = Errors { low, high: f64::INFINITY };
            let is_enough = |e: &Errors| e.low <= wanted.low && e.high <= wanted.high;
            if let Some([least, most]) = flat(linear, region, facets, nears) {
                errors = Errors { low: errors.low.min(-least), high: errors.high.min(most) };
            }
            if !is_enough(&errors) {
                // The side is not known, so the distance bounds both signs.
                if errors.high > wanted.high {
                    errors.high = errors.high.min(above());
                }
                if errors.low > wanted.low && kind == SdfKind::Signed {
                    errors.low = errors.low.min(below());
                }
            }
            errors
        }
    }
}

/// The proof of one cell in progress.
pub(super) struct Prover<'a, F> {
    truth: &'a Truth<'a>,
    function: F,
    /// The cell's least corner.
    corner: DVec3,
    /// Boxes of no larger radius are not halved.
    floor: f64,
    nears: Vec<Near>,
    proof: Proof,
}

impl<'a, F: Function> Prover<'a, F> {
    /// Proves the errors of a cell, which are the wanted ones or larger. The cell's least corner
    /// and its sides are in units.
    pub fn cell(
        truth: &'a Truth<'a>,
        function: F,
        [corner, sides]: [DVec3; 2],
        wanted: Errors,
        floor: f64,
    ) -> Proof {
        let mut prover = Self {
            truth,
            function,
            corner,
            floor,
            nears: Vec::new(),
            proof: Proof { errors: wanted, ..Proof::default() },
        };
        let half = 0.5 * sides;
        let mut region = truth.facets.gather([corner + half, half], true, &mut prover.nears);
        prover.visit(&mut region, 0, None);
        let Errors { low, high } = prover.proof.errors;
        prover.proof.is_widened = low > wanted.low || high > wanted.high;
        prover.proof
    }

    fn visit(&mut self, region: &mut Region, start: usize, of_parent: Option<Side>) {
        self.proof.boxes += 1;
        let Self { truth, function, corner, nears, .. } = self;
        let side = of_parent.or_else(|| {
            let ties = nears[start..].iter().filter(|near| near.height <= region.distance + TIE);
            (region.least > region.radius).then(|| truth.side(region.centre, ties.copied()))
        });
        let wanted = self.proof.errors;
        let is_enough = |found: &Errors| found.low <= wanted.low && found.high <= wanted.high;
        let linear = function.about(region.centre - *corner, region.half);
        let mut found = needed(truth, &linear, region, &nears[start..], side, wanted);
        // The function whose lower bound groups limit, and whether that bound fails. Distances
        // inside are negative.
        let (towards, by_least): (_, fn(&Errors, &Errors) -> bool) = match (side, truth.kind) {
            (Some(Side::Outside), _) => (linear, |found, wanted| found.low > wanted.low),
            (Some(Side::Inside), SdfKind::Signed) => {
                (linear.negative(), |found, wanted| found.high > wanted.high)
            }
            _ => (linear, |_, _| false),
        };
        while by_least(&found, &wanted) && truth.facets.open_least(region, &towards, start, nears) {
            found = needed(truth, &linear, region, &nears[start..], side, wanted);
        }
        let is_last = region.radius <= self.floor || self.proof.boxes >= MOST_BOXES;
        if is_enough(&found) || is_last {
            let errors = &mut self.proof.errors;
            errors.low = errors.low.max(found.low);
            errors.high = errors.high.max(found.high);
            self.proof.is_undecided |= side == Some(Side::Undecided);
            return;
        }
        let (half, parts) = parts(region.centre, region.half);
        for centre in parts {
            let end = self.nears.len();
            let boxed = [centre, half];
            let mut part = self.truth.facets.narrow(region, start..end, boxed, &mut self.nears);
            self.visit(&mut part, end, side);
            self.nears.truncate(end);
        }
    }
}
