//! Numbers: directed rounding, the stored radius, and every tolerance.

mod each;
#[cfg(test)]
pub(crate) mod noise;
mod order;
mod radius;
mod real;
mod round;
mod sqrt;
pub mod tolerance;
mod truncated;
mod turn;

pub use each::each;
pub use order::{above_zero, greater, lesser};
pub use radius::{Radius8, Radius16};
pub use real::{Real, bit_length, difference, dot, float, floored, reals};
pub(crate) use round::exp2_f32;
pub use round::{down_to_f32, exp2, sum_down, sum_up, two_sum, up_to_f32};
pub use sqrt::{sqrt_above, sqrt_approx, sqrt_below, sqrt_up};
pub use truncated::truncated;
pub use turn::half_turn;

/// Whether the target is not known to have instructions for f32. Then integers decide first.
pub const SOFT_FLOAT: bool = cfg!(meshsweep_soft_float);

/// Whether the target is not known to have instructions for f64. Then f32 decides first.
pub const SOFT_DOUBLE: bool = cfg!(meshsweep_soft_double);
