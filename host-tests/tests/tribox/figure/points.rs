//! Small sets of points.

use meshsweep_host_tests::generate::Rng;

/// A few points with small integer coordinates: many coincide, lie in planes or on lines.
pub fn points(rng: &mut Rng) -> Vec<[f32; 3]> {
    let span = [2, 3, 5, 9, 65, 4097][rng.below(6)];
    let count = 1 + rng.below(12);
    let flat = rng.below(8);
    (0..count)
        .map(|_| {
            let mut point = [0; 3].map(|_: i32| rng.below(span) as f32 - (span / 2) as f32);
            if flat < 3 {
                point[flat] = 1.0;
            }
            point
        })
        .collect()
}
