//! Where the links are: seven of them in a plane, six joints between them.

use meshsweep_core::{Pose, QueryError, RoundedPose};

/// Links. They are models 0 to 6 of the scene.
pub const LINKS: usize = 7;
pub const TABLE: u16 = 7;
pub const MACHINE: u16 = 8;

/// From axis to axis of a link, mm.
const LENGTH: f32 = 60.0;
/// A link is within this of its first axis, mm.
pub const RADIUS: f32 = 67.0;
/// What an encoder of 16 bits does not tell, rad.
const ENCODER: f32 = 1e-4;

/// Tangents of half the joints' angles at the start, and 65,536ths more each tick. So no sine is
/// needed.
const START: [f32; LINKS - 1] = [0.0, 0.05, 0.05, 0.1, 0.1, 0.1];
const PER_TICK: [u32; LINKS - 1] = [13, 13, 13, 7, 13, 7];

/// Turned about y by twice the angle of this tangent, then moved along x.
fn turned(half: f32, along: f32) -> Result<RoundedPose, QueryError> {
    Pose::of_quaternion([0.0, half, 0.0, 1.0], [along, 0.0, 0.0])
}

/// From each link's frame to the world. Each pose knows how far it may be off: by rounding and by
/// the encoders.
pub fn places(tick: u32) -> Result<[RoundedPose; LINKS], QueryError> {
    let base = turned(-1.0, 0.0)?; // It points up.
    let mut places = [base; LINKS];
    let mut parent = base;
    let joints = START.iter().zip(&PER_TICK);
    for (place, (start, per_tick)) in places.iter_mut().skip(1).zip(joints) {
        let joint = turned(start + (per_tick * tick) as f32 / 65536.0, LENGTH)?;
        let joint = RoundedPose::within(joint.pose, joint.turn + ENCODER, joint.shift);
        parent = joint.then(&parent);
        *place = parent;
    }
    Ok(places)
}
