//! Area and volume of a tribox.

use super::span::{Span, Wide};
use glam::DVec3;
use meshsweep_core::Tribox;
use meshsweep_core::internal::tribox::BoundaryOf;
use meshsweep_core::internal::tribox::FACES;

/// Area and volume, squared and cubed input units; within 1e-12 of the area and volume of its box.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extent {
    /// Area of the boundary; of a flat tribox both sides count.
    pub area: f64,
    /// Volume inside.
    pub volume: f64,
}

impl Extent {
    /// Of a tribox; 0 for an empty one. Cost: a boundary and some hundred products.
    #[must_use]
    pub fn of(tribox: &Tribox) -> Extent {
        if tribox.is_empty() {
            Extent::default()
        } else {
            Extent::of_boundary(&Span::tight(tribox).boundary())
        }
    }

    pub(super) fn of_span(span: &Span) -> Extent {
        if span.is_empty() { Extent::default() } else { Extent::of_boundary(&span.boundary()) }
    }

    fn of_boundary(boundary: &BoundaryOf<Wide>) -> Extent {
        let point = |v: [Wide; 3]| DVec3::from(v.map(|x| x.0));
        let origin = point(boundary.vertices[0]);
        let mut extent = Extent::default();
        for face in 0..FACES {
            let mut corners = boundary.corners(face).map(|v| point(v) - origin);
            let Some(first) = corners.next() else { continue };
            let mut last = DVec3::ZERO;
            let mut twice = DVec3::ZERO;
            for corner in corners {
                let here = corner - first;
                twice += last.cross(here);
                last = here;
            }
            extent.area += 0.5 * twice.length();
            extent.volume += twice.dot(first) / 6.0;
        }
        Extent { volume: extent.volume.max(0.0), ..extent }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(points: &[[f32; 3]]) -> Extent {
        Extent::of(&Tribox::of_points(points.iter().copied()).unwrap())
    }

    #[test]
    fn a_cube_and_a_cuboctahedron_have_their_textbook_extents() {
        let corner = |i: u8| [i & 1, i >> 1 & 1, i >> 2 & 1].map(|bit| 2.0 * f32::from(bit) - 1.0);
        let cube = of(&(0..8).map(corner).collect::<Vec<_>>());
        assert_eq!(cube, Extent { area: 24.0, volume: 8.0 });
        // All diagonals at 1: the rhombic dodecahedron, of edge √3/2.
        let octahedron = [
            [1.0, 0.0, 0.0],
            [-1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, -1.0, 0.0],
            [0.0, 0.0, 1.0],
            [0.0, 0.0, -1.0],
        ];
        let dodecahedron = of(&octahedron);
        assert!((dodecahedron.volume - 2.0).abs() < 1e-12, "{dodecahedron:?}");
        assert!((dodecahedron.area - 6.0 * 2f64.sqrt()).abs() < 1e-12, "{dodecahedron:?}");
    }

    #[test]
    fn a_point_has_none_and_a_square_has_two_sides() {
        assert_eq!(of(&[[3.0, 4.0, 5.0]]), Extent::default());
        let square = of(&[[0.0, 0.0, 1.0], [2.0, 0.0, 1.0], [2.0, 2.0, 1.0], [0.0, 2.0, 1.0]]);
        assert_eq!(square, Extent { area: 8.0, volume: 0.0 });
        assert_eq!(Extent::of(&Tribox::EMPTY), Extent::default());
    }
}
