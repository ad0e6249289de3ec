//! The matrix that turns a mesh to the frame of its triboxes.

/// Most that the matrix may differ from a rotation: by the format.
const MOST: f64 = 1.0 / 524_288.0;

/// A matrix that is nearly a rotation. Its numbers are exact.
pub(super) struct Turn {
    rows: [[f64; 3]; 3],
    /// Lengths change by a factor within 1 ± this.
    skew: f64,
}

impl Turn {
    /// From its rows.
    pub(super) fn new(rows: [[f64; 3]; 3]) -> Result<Self, String> {
        let mut skew = 0f64;
        for a in rows {
            // The row's own place has 1 where the others have 0.
            let sum: f64 = rows
                .iter()
                .map(|b| (0..3).map(|k| a[k] * b[k]).sum::<f64>())
                .fold(0.0, |sum, x| sum + x.abs());
            let own: f64 = a.iter().map(|x| x * x).sum();
            skew = skew.max(sum - own + (own - 1.0).abs());
        }
        let [a, b, c] = rows;
        let volume = a[0] * (b[1] * c[2] - b[2] * c[1])
            + a[1] * (b[2] * c[0] - b[0] * c[2])
            + a[2] * (b[0] * c[1] - b[1] * c[0]);
        if !(skew <= MOST && volume > 0.0) {
            return Err("the matrix that turns them is no rotation".into());
        }
        Ok(Self { rows, skew: skew + 1e-15 })
    }

    /// Turns places, and adds to `moved` what rounding and the matrix add to what they moved
    /// before.
    pub(super) fn apply(&self, places: &mut [[f64; 3]], moved: &mut f64) {
        let mut size = 0f64;
        for place in places.iter_mut() {
            let [x, y, z] = *place;
            size = size.max(x.abs() + y.abs() + z.abs());
            *place = self.rows.map(|[a, b, c]| a * x + b * y + c * z);
        }
        // Five roundings of each coordinate, of terms whose sum is at most the 1-norm; √3 of these.
        *moved = (*moved * (1.0 + self.skew) + 10.0 * f64::EPSILON * size).next_up();
    }

    /// What a distance of the mesh's frame is in that of the triboxes, at least.
    pub(super) fn shortest(&self, distance: f64) -> f64 {
        distance * (1.0 - self.skew)
    }
}
