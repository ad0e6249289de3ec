//! Arguments that are structures. Each field is as in `meshsweep.h`.

use meshsweep_core::{Budget, Facing, Focus, KeptPair, Motion, Pose};

use crate::error::Error;
use crate::memory::AnyBits;

/// `msw_budget`: all zeros is exact.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "meshsweep.h says it")]
pub struct BudgetC {
    pub relative: f32,
    pub absolute: f32,
    /// 0: no limit.
    pub steps: u32,
}

/// `msw_pose`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "meshsweep.h says it")]
pub struct PoseC {
    pub rotation: [[f32; 3]; 3],
    pub translation: [f32; 3],
    /// 1: any matrix. All else is a rotation.
    pub is_affine: u32,
}

/// `msw_motion`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "meshsweep.h says it")]
pub struct MotionC {
    pub kind: i32,
    pub from: PoseC,
    pub to: PoseC,
}

/// `msw_kept_pair`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "meshsweep.h says it")]
pub struct KeptPairC {
    pub models: [u32; 2],
    pub distance: f32,
}

/// `msw_hint`: a word of zeros is no hint.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "meshsweep.h says it")]
pub struct HintC {
    pub word: u32,
}

/// `msw_focus`: all zeros is the whole hull.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "meshsweep.h says it")]
pub struct FocusC {
    pub kind: i32,
    pub a: [f32; 3],
    pub b: [f32; 3],
    pub radius: f32,
    pub cosine: f32,
    pub error_per_distance: f32,
}

// SAFETY: integers and floats.
unsafe impl AnyBits for BudgetC {}
// SAFETY: an integer.
unsafe impl AnyBits for HintC {}
// SAFETY: floats and an integer.
unsafe impl AnyBits for PoseC {}
// SAFETY: floats and integers.
unsafe impl AnyBits for MotionC {}
// SAFETY: integers and a float.
unsafe impl AnyBits for KeptPairC {}
// SAFETY: integers and floats.
unsafe impl AnyBits for FocusC {}

impl BudgetC {
    /// In the place of a NULL pointer.
    pub const EXACT: BudgetC = BudgetC { relative: 0.0, absolute: 0.0, steps: 0 };

    /// The budget.
    pub fn budget(self) -> Budget {
        let BudgetC { relative, absolute, steps } = self;
        let steps = if steps == 0 { u32::MAX } else { steps };
        Budget::EXACT.with_relative(relative).with_absolute(absolute).with_steps(steps)
    }
}

impl PoseC {
    /// In the place of a NULL pointer.
    pub const IDENTITY: PoseC = PoseC::of(Pose::IDENTITY);

    /// The pose. A question refuses one that is no rotation, unless it says that it may be any: all
    /// zeros, as nobody filled in.
    pub const fn pose(self) -> Pose {
        let PoseC { rotation, translation, is_affine } = self;
        Pose { rotation, translation, is_affine: is_affine == 1 }
    }

    /// As C has it.
    pub const fn of(Pose { rotation, translation, is_affine }: Pose) -> PoseC {
        PoseC { rotation, translation, is_affine: is_affine as u32 }
    }
}

impl MotionC {
    /// The motion.
    pub fn motion(self) -> Result<Motion, Error> {
        let (from, to) = (self.from.pose(), self.to.pose());
        match self.kind {
            0 => Ok(Motion::straight(from, to)),
            1 => Ok(Motion::screw(from, to)?),
            _ => Err(Error::Value),
        }
    }
}

impl KeptPairC {
    /// The pair.
    pub fn kept(self) -> Result<KeptPair, Error> {
        let [Ok(a), Ok(b)] = self.models.map(u16::try_from) else { return Err(Error::NoModel) };
        Ok(KeptPair { models: [a, b], distance: self.distance })
    }
}

impl FocusC {
    /// In the place of a NULL pointer.
    pub const EVERYWHERE: FocusC = FocusC {
        kind: 0,
        a: [0.0; 3],
        b: [0.0; 3],
        radius: 0.0,
        cosine: 0.0,
        error_per_distance: 0.0,
    };

    /// The focus.
    pub fn focus(self) -> Result<Focus, Error> {
        let FocusC { kind, a, b, radius, cosine, error_per_distance } = self;
        Ok(match kind {
            0 => Focus::Everywhere,
            1 => Focus::Ball { centre: a, radius },
            2 => Focus::Box { a, b },
            3 => Focus::Segment { a, b, radius },
            4 => Focus::Eye { position: a, axis: b, cosine, error_per_distance },
            _ => return Err(Error::Value),
        })
    }
}

/// `MSW_FACING_…`.
pub fn facing(code: i32) -> Result<Facing, Error> {
    match code {
        0 => Ok(Facing::Both),
        1 => Ok(Facing::Front),
        2 => Ok(Facing::Back),
        _ => Err(Error::Value),
    }
}
