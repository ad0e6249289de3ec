//! The bytes of a leaf's normal cone.

use super::layout::CONE_BYTES;
use crate::geom::fan::NormalCone;
use glam::Vec3;

/// Steps of the stored sine.
const STEPS: f32 = 254.0;

/// Sine of no cone: the normals do not fit any.
const UNKNOWN: u8 = u8::MAX;

impl NormalCone {
    /// Bytes of no cone.
    pub const UNKNOWN: [u8; CONE_BYTES] = [0, 0, 0, UNKNOWN];

    /// The cone, if there is one.
    pub fn read([x, y, z, sine]: [u8; CONE_BYTES]) -> Option<NormalCone> {
        let axis = [x, y, z].map(|byte| f32::from(byte.cast_signed()));
        let known = sine != UNKNOWN && axis != [0.0; 3];
        if known {
            Some(NormalCone { axis: Vec3::from_array(axis), sine: f32::from(sine) / STEPS })
        } else {
            None
        }
    }

    /// The bytes of a cone; `sine` is in steps of 1/254, already rounded up.
    pub fn write([x, y, z]: [i8; 3], sine: u8) -> [u8; CONE_BYTES] {
        [x.cast_unsigned(), y.cast_unsigned(), z.cast_unsigned(), sine]
    }
}
