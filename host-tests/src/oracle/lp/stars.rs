//! Programs as edge collapse poses them: the planes of an edge's star, in its own frame.

use glam::{DMat3, DVec3};
use meshsweep::lp::HalfSpace;

use super::Program;
use super::random::Random;

/// The shape of a star. The edge runs along x from −½ to ½; z is up, out of the solid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Star {
    /// Heights at random: up to a quarter of the edge's length.
    Noisy,
    /// A paraboloid with a little noise, as on a scanned surface.
    Smooth,
    /// All in one plane, up to the rounding of the coordinates.
    Flat,
    /// All in one plane, all normals equal to the last bit.
    Aligned,
    /// Two flat faces that meet along the edge.
    Crease,
    /// Two flat faces that meet across the edge, in its first vertex.
    Ridge,
    /// Three flat faces that meet in the edge's first vertex.
    Corner,
}

impl Star {
    /// Every kind.
    pub const ALL: [Self; 7] = [
        Self::Noisy,
        Self::Smooth,
        Self::Flat,
        Self::Aligned,
        Self::Crease,
        Self::Ridge,
        Self::Corner,
    ];

    /// The program of one random star of this kind.
    #[must_use]
    pub fn program(self, random: &mut Random) -> Program {
        let left = 3 + random.below(3);
        let right = 3 + random.below(3);
        let mut points = ring(random, left, right);
        for point in &mut points {
            point.z = self.height(random, *point);
        }
        self.place(random, &mut points);
        let middle = (points[0] + points[1]) / 2.0;
        let faces: Vec<[DVec3; 3]> =
            triangles(left, right).into_iter().map(|face| face.map(|v| points[v])).collect();
        of_faces(&faces, middle)
    }

    fn height(self, random: &mut Random, point: DVec3) -> f64 {
        match self {
            Self::Noisy => random.within(-0.25, 0.25),
            Self::Smooth => -0.2 * point.length_squared() + random.within(-0.01, 0.01),
            Self::Flat | Self::Aligned => 0.0,
            Self::Crease => -point.y.abs(),
            Self::Ridge => -(point.x + 0.5).max(0.0),
            Self::Corner => -(point.x + 0.5).max(point.y.abs() - 0.2 * (point.x + 0.5)).max(0.0),
        }
    }

    /// Turns the star, moves it off the origin and rounds it to single precision, as a mesh file
    /// would hold it.
    fn place(self, random: &mut Random, points: &mut [DVec3]) {
        if self == Self::Aligned {
            return;
        }
        let axis = random.direction();
        let turn = DMat3::from_axis_angle(axis, random.within(0.0, core::f64::consts::TAU));
        let shift = random.direction() * 10.0;
        for point in points {
            *point = (turn * *point + shift).as_vec3().as_dvec3();
        }
    }
}

/// The program of the star of an edge with this middle; faces without area have no plane. The
/// objective is the sum of the area vectors, scaled to length 1.
#[must_use]
pub fn of_faces(faces: &[[DVec3; 3]], middle: DVec3) -> Program {
    let corners = faces.iter().flatten();
    let radius = corners.map(|p| p.distance(middle)).fold(0.0, f64::max);
    let (mut objective, mut constraints) = (DVec3::ZERO, Vec::new());
    for face in faces {
        let [a, b, c] = face.map(|p| (p - middle) / radius);
        let area = (b - a).cross(c - a);
        objective += area;
        if let Some(normal) = area.try_normalize() {
            constraints.push(HalfSpace { normal, offset: normal.dot(a) });
        }
    }
    Program { objective: objective.normalize_or_zero(), constraints }
}

/// The edge's vertices, then the ring around them in order: `left` points about the first, `right`
/// about the second.
fn ring(random: &mut Random, left: usize, right: usize) -> Vec<DVec3> {
    let count = left + right;
    let mut points = vec![DVec3::new(-0.5, 0.0, 0.0), DVec3::new(0.5, 0.0, 0.0)];
    for step in 0..count {
        let (part, whole, start) =
            if step < left { (step, left, 0.25) } else { (step - left, right, 0.75) };
        let turn = start + 0.5 * (part as f64 + random.within(-0.2, 0.2)) / whole as f64;
        let (sin, cos) = (turn * core::f64::consts::TAU).sin_cos();
        points.push(DVec3::new(1.3 * cos, random.within(0.8, 1.0) * sin, 0.0));
    }
    points
}

fn triangles(left: usize, right: usize) -> Vec<[usize; 3]> {
    let count = left + right;
    let mut triangles = vec![[0, 1, 2], [1, 0, 2 + left]];
    for step in 0..count {
        triangles.push([usize::from(step >= left), 2 + step, 2 + (step + 1) % count]);
    }
    triangles
}
