//! Samples of one mesh: points with their closest points on the other mesh.

use glam::{DVec3, Vec3};
use meshsweep::bvh::blob_for;
use meshsweep::mesh::Mesh;
use meshsweep_core::{Budget, Bvh, ClosestPoint, CoherentQuery, Neighbor, ScratchEntry};

/// A point of one mesh and where the other mesh is closest.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// Of the first mesh.
    pub point: DVec3,
    /// On the other mesh, up to rounding in f64.
    pub foot: DVec3,
    /// Distance of the foot.
    pub upper: f64,
}

/// The box tree of a mesh, for a [`Sampler`] of the other one: the tree that ours takes.
///
/// # Errors
/// The builder's refusal.
pub fn tree(mesh: &Mesh, other: &Mesh) -> Result<Vec<u8>, String> {
    blob_for(mesh, other.positions.len()).map_err(|error| error.to_string())
}

/// Answers samples of one mesh from the box tree of the other.
pub struct Sampler<'a> {
    tree: Bvh<'a>,
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    coherent: CoherentQuery<'a, 128>,
    stack: Vec<ScratchEntry>,
    neighbors: Vec<Neighbor>,
    /// Samples that were taken.
    pub asked: usize,
}

impl<'a> Sampler<'a> {
    /// Of a mesh and its [`tree`].
    ///
    /// # Errors
    /// None but a fault of the builder.
    pub fn new(blob: &'a [u8], mesh: &Mesh) -> Result<Self, String> {
        let tree = Bvh::open(blob).map_err(|error| error.to_string())?;
        Ok(Self {
            stack: vec![ScratchEntry::EMPTY; tree.scratch_entries()],
            neighbors: vec![Neighbor::EMPTY; 64],
            tree,
            positions: mesh.positions.iter().map(|&p| Vec3::from(p).as_dvec3()).collect(),
            triangles: mesh.all_triangles().collect(),
            coherent: CoherentQuery::new(),
            asked: 0,
        })
    }

    /// Corners of a triangle.
    fn corners(&self, triangle: u32) -> [DVec3; 3] {
        self.triangles[triangle as usize].map(|v| self.positions[v as usize])
    }

    /// Distance of a point from a triangle.
    fn distance(&self, p: DVec3, triangle: u32) -> f64 {
        (closest_on(p, self.corners(triangle)) - p).length()
    }

    /// A sample, anywhere.
    ///
    /// # Errors
    /// None but a fault of the tree.
    pub fn sample(&mut self, p: DVec3) -> Result<Sample, String> {
        let asked = p.as_vec3().to_array();
        let answer = self.tree.closest_point(asked, Budget::EXACT, &mut self.stack);
        self.answered(p, &answer.map_err(|error| error.to_string())?)
    }

    /// The next sample of a path.
    ///
    /// # Errors
    /// None but a fault of the tree.
    pub fn sample_along(&mut self, p: DVec3) -> Result<Sample, String> {
        let asked = p.as_vec3().to_array();
        let budget = Budget::EXACT;
        let answer = self.coherent.closest_point(&self.tree, asked, budget, &mut self.stack);
        self.answered(p, &answer.map_err(|error| error.to_string())?.closest)
    }

    fn answered(&mut self, point: DVec3, answer: &ClosestPoint) -> Result<Sample, String> {
        self.asked += 1;
        let triangle = answer.triangle.ok_or("a closest point without its triangle")?;
        let foot = closest_on(point, self.corners(triangle));
        Ok(Sample { point, foot, upper: (foot - point).length() })
    }

    /// The distance of a sample's point in f64: of every triangle that may be nearer than its foot.
    ///
    /// # Errors
    /// None but a fault of the tree.
    pub fn exact(&mut self, sample: &Sample) -> Result<f64, String> {
        let asked = sample.point.as_vec3();
        let rounded = (asked.as_dvec3() - sample.point).length();
        let reach = ((sample.upper + rounded) as f32).next_up().next_up();
        let (point, budget) = (asked.to_array(), Budget::EXACT);
        let stored = loop {
            let (found, stack) = (&mut self.neighbors, &mut self.stack);
            let all = self.tree.all_within(point, reach, found, budget, stack);
            let all = all.map_err(|error| error.to_string())?;
            if all.dropped == 0 {
                break all.stored;
            }
            let wanted = self.neighbors.len() + all.dropped as usize;
            self.neighbors.resize(wanted, Neighbor::EMPTY);
        };
        let near = self.neighbors[..stored].iter();
        let distances = near.map(|near| self.distance(sample.point, near.triangle()));
        Ok(distances.fold(sample.upper, f64::min))
    }
}

/// The closest point of a triangle. Ericson, *Real-time collision detection* (2005), section 5.1.5.
/// Some corner if the triangle has no area and the formula no answer.
fn closest_on(p: DVec3, [a, b, c]: [DVec3; 3]) -> DVec3 {
    let (ab, ac) = (b - a, c - a);
    let [d1, d2] = [ab, ac].map(|along| along.dot(p - a));
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    let [d3, d4] = [ab, ac].map(|along| along.dot(p - b));
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    let [d5, d6] = [ab, ac].map(|along| along.dot(p - c));
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let (va, vb, vc) = (d3 * d6 - d5 * d4, d5 * d2 - d1 * d6, d1 * d4 - d3 * d2);
    let (forth, back) = (d4 - d3, d5 - d6);
    let foot = if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        a + ab * (d1 / (d1 - d3))
    } else if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        a + ac * (d2 / (d2 - d6))
    } else if va <= 0.0 && forth >= 0.0 && back >= 0.0 {
        b + (c - b) * (forth / (forth + back))
    } else {
        let sum = va + vb + vc;
        a + ab * (vb / sum) + ac * (vc / sum)
    };
    if foot.is_finite() { foot } else { a }
}
