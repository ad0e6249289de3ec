//! Closed surfaces that are asked which of them hold a point.

use super::bounds::Bounds;
use super::enclosure::Enclosure;
use super::tree::StaticTree;
use glam::{DVec3, Vec3};

/// Any number of closed surfaces, and a tree of their boxes.
pub(crate) struct Enclosures {
    all: Vec<Enclosure>,
    tree: StaticTree,
}

impl Enclosures {
    /// Each closed surface by its triangles' corners; none may be empty.
    pub fn new(surfaces: impl IntoIterator<Item = Vec<[[f32; 3]; 3]>>) -> Self {
        let all: Vec<Enclosure> = surfaces.into_iter().map(Enclosure::new).collect();
        let wide = |p: [f32; 3]| Vec3::from(p).as_dvec3();
        let boxes: Vec<Bounds> =
            all.iter().map(|of| Bounds { low: wide(of.low), high: wide(of.high) }).collect();
        let tree = StaticTree::new(&boxes);
        Self { all, tree }
    }

    /// A corner of a surface.
    pub fn corner(&self, surface: usize) -> [f64; 3] {
        self.all[surface].triangles[0][0].map(f64::from)
    }

    /// Whether a point lies on a surface, `but` one. Exact.
    pub fn touches(&self, p: [f64; 3], but: Option<usize>) -> bool {
        let at = DVec3::from(p);
        let is_off = |i: usize| Some(i) == but || !self.all[i].touches(p);
        !self.tree.visit_meeting(&Bounds { low: at, high: at }, is_off)
    }

    /// The surfaces that hold a point, `but` one, ascending. Exact for points on none of them.
    pub fn around(&self, p: [f64; 3], but: Option<usize>) -> Vec<usize> {
        let at = DVec3::from(p);
        let mut found = Vec::new();
        self.tree.visit_meeting(&Bounds { low: at, high: at }, |i| {
            if Some(i) != but && self.all[i].holds(p) {
                found.push(i);
            }
            true
        });
        found.sort_unstable();
        found
    }
}
