//! Rays of which a point behind the mesh is known exactly, so that segments tell what they meet.

use super::Rng;

/// A ray, and the end of a segment along it.
#[derive(Clone, Copy, Debug)]
pub struct EndedRay {
    /// Where it begins.
    pub origin: [f32; 3],
    /// Where it goes.
    pub direction: [f32; 3],
    /// A place on the ray, exactly.
    pub end: [f32; 3],
    /// The ray's parameter of that place: a power of two.
    pub parameter: f64,
}

impl EndedRay {
    /// The ray, if its end is exact in f32.
    #[must_use]
    pub fn of(origin: [f32; 3], direction: [f32; 3], parameter: f64) -> Option<Self> {
        // Exact in f64: a product with a power of two, and the sum of two such numbers is compared.
        let ways = direction.map(|x| f64::from(x) * parameter);
        let ends: [f64; 3] = std::array::from_fn(|k| f64::from(origin[k]) + ways[k]);
        let is_exact = |k: usize| {
            let end = ends[k];
            f64::from(end as f32) == end
                && end - ways[k] == f64::from(origin[k])
                && end - f64::from(origin[k]) == ways[k]
        };
        let has_way = direction.iter().any(|&x| x != 0.0);
        let end = ends.map(|x| x as f32);
        let is_sound = has_way && (0..3).all(is_exact) && end.iter().all(|x| x.is_finite());
        is_sound.then_some(Self { origin, direction, end, parameter })
    }

    /// The same ray with a direction so many powers of two longer, if f32 holds it.
    #[must_use]
    pub fn longer(self, powers: i32) -> Option<Self> {
        let by = 2f64.powi(powers);
        let direction = self.direction.map(|x| (f64::from(x) * by) as f32);
        let is_exact = (0..3).all(|k| f64::from(direction[k]) == f64::from(self.direction[k]) * by);
        is_exact.then_some(Self { direction, parameter: self.parameter / by, ..self })
    }
}

/// Rays from within two reaches of the origin of coordinates, whose ends are farther than six:
/// across, along axes, through vertices along axes, away, and from afar. `reach`: the largest
/// coordinate of the mesh.
pub fn ended_rays(vertices: &[[f32; 3]], reach: f32, count: usize, rng: &mut Rng) -> Vec<EndedRay> {
    let unit = 2f32.powi(reach.log2().ceil() as i32 - 12);
    let mut whole = |most: i32| (rng.below(2 * most as usize + 1) as u32).cast_signed() - most;
    let mut found = Vec::new();
    for round in 0..count {
        let mut lattice = |most: i32| [(); 3].map(|()| whole(most) as f32 * unit);
        let (mut origin, mut direction, mut parameter) = (lattice(1 << 13), lattice(255), 256.0);
        let axis = round / 8 % 3;
        let sign = if round / 24 % 2 == 0 { 1.0 } else { -1.0 };
        match round % 8 {
            // Along an axis, and along a vertex.
            0 => direction = [0.0; 3],
            1 => {
                direction = [0.0; 3];
                let vertex = vertices[round * 7 % vertices.len()];
                let along = origin[axis];
                origin = vertex;
                origin[axis] = along;
            }
            // In a coordinate plane.
            2 => direction[(axis + 1) % 3] = 0.0,
            // From afar, through a coarse lattice.
            3 | 4 => {
                let coarse = |x: f32| (x / (unit * 1024.0)).round() * unit * 1024.0;
                let target = origin.map(|x| coarse(0.5 * x));
                direction = direction.map(|x| coarse(x * 16.0));
                direction[axis] = sign * 4096.0 * unit;
                parameter = 65_536.0;
                origin = std::array::from_fn(|k| target[k] - direction[k] * 32_768.0);
            }
            _ => {}
        }
        if round % 8 < 3 || round % 8 > 4 {
            // Long enough to leave the mesh.
            direction[axis] = sign * 255.0 * unit;
        }
        found.extend(EndedRay::of(origin, direction, parameter));
    }
    found
}
