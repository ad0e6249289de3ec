//! Whether a point lies inside a closed component, by exact predicates.

use super::predicates::lies_on;
use super::ray::ray_crossing;
use glam::DVec3;
use std::cell::OnceCell;

/// A closed surface that is asked which points it holds.
pub(crate) struct Enclosure {
    /// Its triangles' corners.
    pub triangles: Vec<[[f32; 3]; 3]>,
    pub low: [f32; 3],
    pub high: [f32; 3],
    /// Triangle numbers by the strips of y that they reach into; made by the first query.
    strips: OnceCell<Vec<Vec<u32>>>,
}

/// Strips of a surface. A point looks at one. With more strips long triangles have more entries.
const STRIPS: usize = 64;

impl Enclosure {
    /// `triangles` must not be empty.
    pub(crate) fn new(triangles: Vec<[[f32; 3]; 3]>) -> Self {
        let fold = |f: fn(f32, f32) -> f32, from: f32| {
            let with = |at: [f32; 3], p: &[f32; 3]| [0, 1, 2].map(|k| f(at[k], p[k]));
            triangles.iter().flatten().fold([from; 3], with)
        };
        let (low, high) = (fold(f32::min, f32::INFINITY), fold(f32::max, f32::NEG_INFINITY));
        Self { triangles, low, high, strips: OnceCell::new() }
    }

    /// Whether a point that is not on the surface lies inside. Exact; overlaps count by parity.
    pub(crate) fn holds(&self, p: [f64; 3]) -> bool {
        self.box_holds(p) && self.encloses(p)
    }

    /// Whether a point lies on the surface. Exact.
    ///
    /// Cost: the triangles of a strip.
    pub(crate) fn touches(&self, p: [f64; 3]) -> bool {
        let at = DVec3::from(p);
        let is_on = |&number: &u32| lies_on(at, &self.triangles[number as usize].map(wide));
        self.box_holds(p) && self.strips()[self.strip(p[1])].iter().any(is_on)
    }

    fn box_holds(&self, p: [f64; 3]) -> bool {
        (0..3).all(|k| f64::from(self.low[k]) <= p[k] && p[k] <= f64::from(self.high[k]))
    }

    /// Parity of the crossings of the ray from `p` along +z.
    fn encloses(&self, p: [f64; 3]) -> bool {
        let crosses = |number: &&u32| {
            ray_crossing(p, &self.triangles[**number as usize].map(|p| p.map(f64::from))) != 0
        };
        self.strips()[self.strip(p[1])].iter().filter(crosses).count() % 2 == 1
    }

    fn strips(&self) -> &[Vec<u32>] {
        self.strips.get_or_init(|| {
            let mut strips = vec![Vec::new(); STRIPS];
            for (number, [a, b, c]) in self.triangles.iter().enumerate() {
                let (low, high) = (a[1].min(b[1]).min(c[1]), a[1].max(b[1]).max(c[1]));
                strips[self.strip(low.into())..=self.strip(high.into())]
                    .iter_mut()
                    .for_each(|s| s.push(number as u32));
            }
            strips
        })
    }

    /// The strip of a y coordinate. Each step is monotonic after rounding too, so a triangle is in
    /// the strip of every y that it reaches.
    fn strip(&self, y: f64) -> usize {
        let (low, high) = (f64::from(self.low[1]), f64::from(self.high[1]));
        let along = (y - low) / (high - low).max(f64::MIN_POSITIVE);
        ((along * STRIPS as f64) as usize).min(STRIPS - 1)
    }
}

fn wide(p: [f32; 3]) -> DVec3 {
    DVec3::from(p.map(f64::from))
}
