//! Every bound of one mesh.

use glam::DVec3;
use meshsweep_host_tests::workload::Subject;
use meshsweep_host_tests::workload::sphere::Sphere;

use super::clip::Solid;
use super::convex_hull::ConvexHull;
use super::dop::{Dop, Slabs};
use super::oriented_box::OrientedBox;

/// The bounds.
pub struct Bounds {
    /// The convex hull.
    pub hull: ConvexHull,
    /// Polytopes of fixed directions, and their solids.
    pub slabs: Vec<(Slabs, Dop, Solid)>,
    /// The smallest enclosing sphere.
    pub sphere: Sphere,
    /// The box on a face of the hull.
    pub oriented: OrientedBox,
}

impl Bounds {
    /// Bounds a mesh.
    ///
    /// # Errors
    /// The mesh is flat.
    pub fn new(subject: &Subject) -> Result<Self, String> {
        let points: Vec<DVec3> =
            subject.mesh.positions.iter().map(|p| DVec3::from_array(p.map(f64::from))).collect();
        let hull = ConvexHull::new(&points)
            .ok_or("the mesh is flat: it has no convex hull with a volume")?;
        let sphere = Sphere::enclosing(&hull.points);
        let slabs = Slabs::all()
            .into_iter()
            .map(|slabs| {
                let dop = Dop::of(&slabs, hull.points.iter().copied());
                let solid = dop.solid(&slabs, sphere.centre, sphere.radius);
                (slabs, dop, solid)
            })
            .collect();
        let oriented = OrientedBox::on_a_face(&hull);
        Ok(Self { hull, slabs, sphere, oriented })
    }
}
