//! The arm: its links, its joints, and where its meshes are, in f64.
//!
//! The constants are those of the `kinematics.py` that lies beside the meshes: a UR5, a table and a
//! machine.

use std::f64::consts::{FRAC_PI_2, PI};

use meshsweep_core::Pose;
use meshsweep_suite::ask::robot::MODELS;

/// The meshes, by the names of their files, as [`PAIRS`](meshsweep_suite::ask::robot::PAIRS) counts
/// them.
pub const NAMES: [&str; MODELS] =
    ["base", "shoulder", "upperarm", "forearm", "wrist1", "wrist2", "wrist3", "table", "machine"];

/// Joints that turn about their z axis.
pub const JOINTS: usize = 6;

/// A rigid motion: rows of the matrix, and what is added.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// Rows of the matrix.
    pub rows: [[f64; 3]; 3],
    /// Added to the turned point.
    pub shift: [f64; 3],
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

impl Motion {
    /// From an origin of a URDF: a place, and angles about the fixed axes x, y and z.
    fn origin(shift: [f64; 3], [roll, pitch, yaw]: [f64; 3]) -> Self {
        let ((sr, cr), (sp, cp), (sy, cy)) = (roll.sin_cos(), pitch.sin_cos(), yaw.sin_cos());
        let rows = [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ];
        Self { rows, shift }
    }

    /// First `other`, then this.
    #[must_use]
    pub fn after(&self, other: &Self) -> Self {
        let column = |k: usize| [0, 1, 2].map(|row: usize| other.rows[row][k]);
        let rows = self.rows.map(|row| [0, 1, 2].map(|k| dot(row, column(k))));
        let shift = [0, 1, 2].map(|k| dot(self.rows[k], other.shift) + self.shift[k]);
        Self { rows, shift }
    }

    /// The way back of a rigid motion.
    #[must_use]
    pub fn back(&self) -> Self {
        let rows = [0, 1, 2].map(|k| [0, 1, 2].map(|row: usize| self.rows[row][k]));
        Self { rows, shift: rows.map(|row| -dot(row, self.shift)) }
    }

    /// As the library takes it: rounded to f32.
    #[must_use]
    pub fn pose(&self) -> Pose {
        Pose::rigid(self.rows.map(|row| row.map(|x| x as f32)), self.shift.map(|x| x as f32))
    }
}

/// Where all models are at these angles.
#[must_use]
#[allow(clippy::approx_constant, reason = "the digits of the robot's own description")]
pub fn placed(angles: [f64; JOINTS]) -> [Motion; MODELS] {
    const TURN: f64 = 1.570_796_327;
    let joints = [
        Motion::origin([0.0, 0.0, 0.089159], [0.0; 3]),
        Motion::origin([0.0; 3], [TURN, 0.0, 0.0]),
        Motion::origin([-0.425, 0.0, 0.0], [0.0; 3]),
        Motion::origin([-0.39225, 0.0, 0.10915], [0.0; 3]),
        Motion::origin([0.0, -0.09465, -1.941_303_950_897_609e-11], [TURN, 0.0, 0.0]),
        Motion::origin(
            [0.0, 0.0823, -1.688_001_216_681_175e-11],
            [1.570_796_326_589_793, 3.141_592_653_589_793, 3.141_592_653_589_793],
        ),
    ];
    let meshes = [
        Motion::origin([0.0; 3], [0.0, 0.0, PI]),
        Motion::origin([0.0; 3], [0.0, 0.0, PI]),
        Motion::origin([0.0, 0.0, 0.13585], [FRAC_PI_2, 0.0, -FRAC_PI_2]),
        Motion::origin([0.0, 0.0, 0.0165], [FRAC_PI_2, 0.0, -FRAC_PI_2]),
        Motion::origin([0.0, 0.0, -0.093], [FRAC_PI_2, 0.0, 0.0]),
        Motion::origin([0.0, 0.0, -0.095], [0.0; 3]),
        Motion::origin([0.0, 0.0, -0.0818], [FRAC_PI_2, 0.0, 0.0]),
    ];
    let still = Motion::origin([0.0; 3], [0.0; 3]);
    let machine = Motion::origin([-0.85, -0.12, 0.0], [0.0; 3]);
    let mut all = [still, still, still, still, still, still, still, still, machine];
    let mut frame = still;
    for (link, mesh) in meshes.iter().enumerate() {
        if link > 0 {
            let turn = Motion::origin([0.0; 3], [0.0, 0.0, angles[link - 1]]);
            frame = frame.after(&joints[link - 1]).after(&turn);
        }
        all[link] = frame.after(mesh);
    }
    all
}

/// The angles of a file: a line of headings, then a line for each place.
///
/// # Errors
/// The first line that does not hold six numbers.
pub fn angles(text: &str) -> Result<Vec<[f64; JOINTS]>, String> {
    let lines = text.lines().skip(1).filter(|line| !line.is_empty());
    lines
        .map(|line| {
            let numbers: Option<Vec<f64>> =
                line.split(',').map(|word| word.trim().parse().ok()).collect();
            let found = numbers.and_then(|numbers| <[f64; JOINTS]>::try_from(numbers).ok());
            found.ok_or_else(|| format!("`{line}` are not {JOINTS} angles"))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::{angles, placed};

    #[test]
    fn a_stretched_arm_lies_along_the_negative_x_axis() {
        let all = placed([0.0; 6]);
        let wrist = all[6].shift;
        assert!((wrist[0] + 0.425 + 0.39225).abs() < 1e-9, "{wrist:?}");
        // The way back undoes the motion.
        let still = all[6].back().after(&all[6]);
        assert!(still.shift.iter().all(|x| x.abs() < 1e-15), "{still:?}");
    }

    #[test]
    fn lines_of_other_than_six_angles_are_refused() {
        assert_eq!(angles("q\n1,2,3,4,5,6\n"), Ok(vec![[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]]));
        assert!(angles("q\n1,2,3,4,5\n").is_err());
        assert!(angles("q\n1,2,3,4,5,x\n").is_err());
    }
}
