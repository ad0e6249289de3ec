//! obvhs: the 8-wide compressed tree of Ylitie, Karras & Laine (2017), for segments only.
//!
//! Tried on three meshes of 20,000 to 270,000 triangles, and the fastest taken: `very_slow_build`
//! (3 to 10 % before `medium_build`), three triangles a leaf, triangles in the order of the leaves,
//! and a test that divides only by a hit's determinant (10 to 25 % before the crate's `intersect`).
//! The crate's `intersect_embree` is faster still, but gives the parameter multiplied by the
//! determinant, which ends the search too early at a hit that need not be the first. Its binary
//! tree is slower.

use std::convert::Infallible;
use std::mem::{size_of, size_of_val};
use std::time::Duration;

use meshsweep_host_tests::workload::Subject;
use obvhs::BvhBuildParams;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::builder::build_cwbvh_from_tris;
use obvhs::cwbvh::node::CwBvhNode;
use obvhs::ray::{Ray, RayHit};
use obvhs::triangle::Triangle;

use super::engine::{Answer, Answers, Engine};
use super::workload::{HitKind, Workload};

struct Compressed {
    tree: CwBvh,
    /// In the order of the leaves.
    triangles: Vec<Triangle>,
}

/// Builds the index of any mesh.
///
/// # Errors
/// None.
pub fn build<'a>(subject: &Subject, _: &'a mut Vec<u8>) -> Result<Box<dyn Engine + 'a>, String> {
    let at = |v: u32| subject.mesh.positions[v as usize].into();
    let triangles: Vec<Triangle> = subject
        .mesh
        .triangles
        .iter()
        .map(|&[a, b, c]| Triangle { v0: at(a), v1: at(b), v2: at(c) })
        .collect();
    let tree = build_cwbvh_from_tris(
        &triangles,
        BvhBuildParams::very_slow_build(),
        &mut Duration::default(),
    );
    let triangles = tree.primitive_indices.iter().map(|&index| triangles[index as usize]).collect();
    Ok(Box::new(Compressed { tree, triangles }))
}

impl Engine for Compressed {
    fn bytes(&self) -> usize {
        size_of::<CwBvhNode>() * self.tree.nodes.len()
            + size_of_val(self.tree.primitive_indices.as_slice())
            + size_of_val(self.triangles.as_slice())
    }

    fn answers(&self, workload: Workload) -> bool {
        matches!(workload, Workload::Segments | Workload::AnyHit)
    }

    fn closest(&mut self, _: &[[f32; 3]]) -> Result<Answers, String> {
        Err("obvhs answers no closest points".to_owned())
    }

    fn hits(&mut self, segments: &[[[f32; 3]; 2]], kind: HitKind) -> Result<Answers, String> {
        let at = |ray: &Ray, index: usize| meet(&self.triangles[index], ray);
        Answers::each(segments, |segment| {
            let (ray, mut hit) = (along(segment), RayHit::none());
            Ok::<_, Infallible>(match kind {
                HitKind::First if self.tree.ray_traverse(ray, &mut hit, at) => Answer::Hit(hit.t),
                HitKind::Any if !self.tree.ray_traverse_miss(ray, at) => Answer::Meets,
                _ => Answer::Miss,
            })
        })
    }
}

/// The segment is the ray up to 1.
#[inline(always)]
fn along([a, b]: [[f32; 3]; 2]) -> Ray {
    let direction = std::array::from_fn(|k| b[k] - a[k]);
    Ray::new(a.into(), <[f32; 3]>::into(direction), 0.0, 1.0)
}

/// Parameter at which a ray meets a triangle of either facing (Möller & Trumbore 1997), infinity
/// where it does not.
#[inline(always)]
fn meet(triangle: &Triangle, ray: &Ray) -> f32 {
    const SIGN: u32 = 1 << 31;
    let from = triangle.v0 - ray.origin;
    let (ba, ac) = (triangle.v0 - triangle.v1, triangle.v2 - triangle.v0);
    let normal = ba.cross(ac);
    let across = from.cross(ray.direction);
    let determinant = -normal.dot(ray.direction);
    let size = determinant.abs();
    let facing = determinant.to_bits() & SIGN;
    let u = across.dot(ac).to_bits() ^ facing;
    let v = across.dot(ba).to_bits() ^ facing;
    let w = (size - f32::from_bits(u) - f32::from_bits(v)).to_bits();
    if determinant == 0.0 || (u | v | w) & SIGN != 0 {
        return f32::INFINITY;
    }
    let t = f32::from_bits((-normal.dot(from)).to_bits() ^ facing);
    if t >= size * ray.tmin && t <= size * ray.tmax { t / size } else { f32::INFINITY }
}
