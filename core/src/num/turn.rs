//! Sine and cosine of half an angle, as quaternions take them: products and sums of f32 in one
//! order, and so the same bits on every target. Derivation: `core/docs/rounding.md` §27.

/// Beyond this angle the products of [`QUARTER`] are no longer exact.
const MOST_ANGLE: f32 = 8192.0;

/// π/2 in three parts, of which the first two have 12 bits (Cody and Waite 1980).
const QUARTER: [f32; 3] = [3216.0 / 2048.0, 4059.0 / 8_388_608.0, -4.371_139e-8];

/// Sine and cosine of half of an angle in radians, the root of the sum of their squared errors less
/// than 2.2 units of [`U32`](super::tolerance::U32). `None` beyond 8192, or if the angle is not a
/// number.
pub fn half_turn(angle: f32) -> Option<[f32; 2]> {
    let half = 0.5 * angle;
    // What is no number is in no range.
    if !(-0.5 * MOST_ANGLE..=0.5 * MOST_ANGLE).contains(&half) {
        return None;
    }
    let scaled = half * core::f32::consts::FRAC_2_PI;
    let quarters = (scaled + if scaled < 0.0 { -0.5 } else { 0.5 }) as i32;
    let [high, middle, low] = QUARTER.map(|part| quarters as f32 * part);
    let rest = ((half - high) - middle) - low;
    let [sine, cosine] = near_zero(rest);
    Some(match quarters & 3 {
        0 => [sine, cosine],
        1 => [cosine, -sine],
        2 => [-sine, -cosine],
        _ => [-cosine, sine],
    })
}

/// Taylor's series within π/4.
fn near_zero(x: f32) -> [f32; 2] {
    let z = x * x;
    let odd = -1.0 / 6.0 + z * (1.0 / 120.0 + z * (-1.0 / 5040.0 + z * (1.0 / 362_880.0)));
    let even = 1.0 / 24.0 + z * (-1.0 / 720.0 + z * (1.0 / 40_320.0 - z * (1.0 / 3_628_800.0)));
    [x + (x * z) * odd, 1.0 - z * (0.5 - z * even)]
}
