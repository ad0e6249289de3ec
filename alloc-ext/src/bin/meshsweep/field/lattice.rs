//! The regular grid of samples around a mesh.

use crate::args::Margin;

/// Samples at `origin + index · step`. The first and the last sample of each axis lie on faces of
/// the enlarged box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice {
    pub size: [usize; 3],
    pub origin: [f64; 3],
    pub step: [f64; 3],
}

impl Lattice {
    /// A lattice around a box in the mesh's unit. The only sample of an axis lies in the middle.
    /// `None` if the lattice leaves the range of f32.
    pub fn around([low, high]: [[f64; 3]; 2], size: [usize; 3], margin: Margin) -> Option<Lattice> {
        let longest = (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max);
        let margin = match margin {
            Margin::Length(length) => length,
            Margin::Fraction(fraction) => fraction * longest,
        };
        let extent = |k: usize| high[k] - low[k] + 2.0 * margin;
        let step =
            core::array::from_fn(
                |k| if size[k] > 1 { extent(k) / (size[k] - 1) as f64 } else { 0.0 },
            );
        let origin = core::array::from_fn(|k| {
            if size[k] > 1 { low[k] - margin } else { (low[k] + high[k]) / 2.0 }
        });
        let lattice = Lattice { size, origin, step };
        let last = lattice.point(size.map(|count| count - 1));
        lattice.point([0; 3]).iter().chain(&last).all(|x| x.is_finite()).then_some(lattice)
    }

    /// The position of a sample, rounded to f32.
    pub fn point(&self, index: [usize; 3]) -> [f32; 3] {
        core::array::from_fn(|k| (self.origin[k] + index[k] as f64 * self.step[k]) as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOX: [[f64; 3]; 2] = [[0.0, 0.0, 0.0], [10.0, 5.0, 0.0]];

    #[test]
    fn the_first_and_last_samples_are_a_margin_outside_the_box() {
        let lattice = Lattice::around(BOX, [13, 5, 3], Margin::Fraction(0.1)).unwrap();
        assert_eq!(lattice.point([0; 3]), [-1.0, -1.0, -1.0]);
        assert_eq!(lattice.point([12, 4, 2]), [11.0, 6.0, 1.0]);
        assert_eq!(lattice.step, [1.0, 1.75, 1.0]);
    }

    #[test]
    fn one_sample_is_in_the_middle_and_a_grid_beyond_f32_is_none() {
        let lattice = Lattice::around(BOX, [1; 3], Margin::Length(3.0)).unwrap();
        assert_eq!(lattice.point([0; 3]), [5.0, 2.5, 0.0]);
        assert_eq!(
            Lattice::around(BOX, [2; 3], Margin::Length(3.4e38)).map(|l| l.size),
            Some([2; 3])
        );
        assert_eq!(Lattice::around([[0.0; 3], [3.4e38; 3]], [2; 3], Margin::Fraction(0.5)), None);
    }
}
