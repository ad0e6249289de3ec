//! The same moves and tests for a simulator that counts instructions.
//!
//! callgrind collects inside of `counted_bounds` only, and writes its counters each time
//! `counted_stage` returns.

use std::hint::black_box;
use std::path::Path;

use meshsweep_host_tests::workload::Subject;

use crate::measure::bounds::Bounds;
use crate::measure::bounds::contenders::contenders;
use crate::measure::bounds::false_positives::poses;
use crate::measure::bounds::pose::Motion;
use crate::measure::bounds::rig::Rig;

/// The function inside of which instructions are counted; a pattern, for its full name has the
/// compiler's hash in it.
pub const COUNTED: &str = "*counted_bounds*";
/// The function after which the counters are written. Another one, for callgrind does not do both
/// at the same one.
pub const WRITTEN: &str = "*counted_stage*";

#[derive(Clone, Copy, PartialEq)]
enum Stage {
    Update,
    Test,
}

/// Moves every bound to all poses, then tests it: the counters are written after either, bound by
/// bound. The numbers of bounds and of poses.
///
/// # Errors
/// As [`measure_bounds`](crate::measure::measure_bounds).
pub fn ask(file: &Path) -> Result<[usize; 2], String> {
    let subject = Subject::load_any(file)?;
    let bounds = Bounds::new(&subject)?;
    let motions: Vec<Motion> = poses(&bounds).iter().map(Motion::of).collect();
    let mut verdicts = Vec::with_capacity(motions.len());
    let mut contenders = contenders(&bounds)?;
    for contender in &mut contenders {
        // Once before, so that growing its memory is not counted.
        contender.rig.update(&motions);
        for stage in [Stage::Update, Stage::Test] {
            counted_stage(contender.rig.as_mut(), stage, &motions, &mut verdicts);
        }
    }
    Ok([contenders.len(), motions.len()])
}

#[inline(never)]
fn counted_stage(rig: &mut dyn Rig, stage: Stage, motions: &[Motion], verdicts: &mut Vec<bool>) {
    // Not a tail call, which would leave this function before the counted one.
    black_box(counted_bounds(rig, stage, motions, verdicts));
}

#[inline(never)]
fn counted_bounds(
    rig: &mut dyn Rig,
    stage: Stage,
    motions: &[Motion],
    verdicts: &mut Vec<bool>,
) -> usize {
    match stage {
        Stage::Update => rig.update(motions),
        Stage::Test => rig.test(verdicts),
    }
    verdicts.len()
}
