//! An opened blob: what it holds, and which structure answers.

use crate::error::{in_python, missing, of_open};
use meshsweep::builder::Built;
use meshsweep::bvh::FastBvh;
use meshsweep::distances::{Distances, has_sides};
use meshsweep_core::{Blob, Budget, Bvh, BvhWithSdf, Curve, Sdf};
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict};
use self_cell::self_cell;

self_cell!(
    /// A blob beside its bytes: every byte is checked once.
    struct Opened {
        owner: Vec<u8>,
        #[covariant]
        dependent: Blob,
    }
);

/// An opened blob, with the report of its build if it was built here.
#[pyclass(frozen, module = "meshsweep._meshsweep")]
pub struct Model {
    opened: Opened,
    report: Vec<(&'static str, String)>,
}

/// Scratch entries beyond those that a curve needs. With them a search with a limit of steps opens
/// the nodes of the least lower bounds first.
pub const BEST_FIRST: usize = 256;

/// The same for a hull hierarchy.
pub const BESIDE_HULL: usize = 4096;

/// A budget of a relative tolerance, an absolute one, and steps; `None` is no limit.
pub fn budget((rel, abs, steps): (f32, f32, Option<u32>)) -> Budget {
    let steps = steps.unwrap_or(u32::MAX);
    Budget::EXACT.with_relative(rel).with_absolute(abs).with_steps(steps)
}

impl Model {
    /// The model of a build, with its report.
    pub fn built(built: Built) -> PyResult<Self> {
        let notes = built.report().map(|note| (note.topic.name(), in_python(&note.text)));
        let report = notes.collect();
        Self::of(built.into_bytes(), report)
    }

    /// The model of a blob's bytes.
    pub fn of(bytes: Vec<u8>, report: Vec<(&'static str, String)>) -> PyResult<Self> {
        let opened = Opened::try_new(bytes, |bytes| Blob::open(bytes)).map_err(of_open)?;
        Ok(Self { opened, report })
    }

    pub fn blob(&self) -> &Blob<'_> {
        self.opened.borrow_dependent()
    }

    pub fn raw(&self) -> &[u8] {
        self.opened.borrow_owner()
    }

    /// The box of what is stored, and how far the input may be outside of it. `None` if the box
    /// holds the vertices of the input as f32.
    fn stored_bounds(&self) -> Option<([[f32; 3]; 2], Option<f32>)> {
        let of_tree = |tree: &Bvh<'_>| (tree.bounds(), beyond(tree.surface_error()));
        let of_distances = self.distances(false).ok().map(|structure| match &structure {
            Distances::Hull(hull) => (hull.bounds(), beyond(hull.surface_error())),
            Distances::Curve(curve) => (curve.bounds(), beyond(curve.surface_error())),
            Distances::Tight(hull) => of_tree(hull.bvh()),
            Distances::TreeWithField(both) => of_tree(both.tree()),
            Distances::Tree(tree) => of_tree(tree),
        });
        let of_tree = || self.blob().bvh().ok().as_ref().map(of_tree);
        // A field's box holds the input, and is rounded.
        let of_field = || self.blob().sdf().ok().map(|field| (field.bounds(), Some(0.0)));
        of_distances.or_else(of_tree).or_else(of_field)
    }

    /// The box tree, built for this word.
    pub fn tree(&self, word: &'static str) -> PyResult<FastBvh<'_>> {
        let serves = |tree: &Bvh<'_>| match word {
            "closest" => tree.serves_distances(),
            "segment" => tree.serves_segments(),
            _ => tree.serves_winding(),
        };
        let tree = self.blob().bvh().ok().filter(serves);
        tree.map(FastBvh::new).ok_or_else(|| missing("box tree for this question", word))
    }

    /// The distance field.
    pub fn field_alone(&self) -> PyResult<Sdf<'_>> {
        self.blob().sdf().map_err(|_| missing("distance field", "sdf"))
    }

    /// The box tree with the distance field, which is asked first.
    pub fn tree_with_field(&self, word: &'static str) -> PyResult<BvhWithSdf<'_>> {
        let field = self.field_alone()?;
        Ok(BvhWithSdf::new(*self.tree(word)?, field))
    }

    /// The structure that answers distances: the box tree, else the curves, the hull hierarchy, the
    /// finest tight hull. With `field_first` the box tree and the field.
    pub fn distances(&self, field_first: bool) -> PyResult<Distances<'_>> {
        if field_first {
            return self.tree_with_field("closest").map(Distances::TreeWithField);
        }
        let blob = self.blob();
        let tight = || blob.tight_hulls().ok()?.finest();
        let distances = match blob.bvh().ok().filter(Bvh::serves_distances) {
            Some(tree) => Some(Distances::Tree(tree)),
            None => blob.curve().ok().map(Distances::Curve),
        };
        let distances = distances
            .or_else(|| blob.hull().ok().map(Distances::Hull))
            .or_else(|| tight().filter(|hull| hull.bvh().serves_distances()).map(Distances::Tight));
        distances.ok_or_else(|| missing("structure that knows distances", "closest"))
    }
}

/// How far the input may be outside of a box, of a structure with this surface error. `None`: the
/// structure holds f32 vertices.
pub fn beyond(error: f32) -> Option<f32> {
    (error != 0.0).then_some(error)
}

/// A box that was rounded to nearest, larger by `error` and rounded outward. `None`: the box of f32
/// vertices, which rounding to nearest does not move.
pub fn grown(bounds: [[f32; 3]; 2], error: Option<f32>) -> [[f32; 3]; 2] {
    let Some(error) = error else { return bounds };
    // The sum in f64, and its rounding to f32, are off by less than one step.
    let sum = |x: f32, error: f32| (f64::from(x) + f64::from(error)) as f32;
    let [low, high] = bounds;
    [
        low.map(|x| sum(x.next_down(), -error).next_down()),
        high.map(|x| sum(x.next_up(), error).next_up()),
    ]
}

#[pymethods]
impl Model {
    #[new]
    fn new(bytes: &[u8]) -> PyResult<Self> {
        Self::of(bytes.to_vec(), Vec::new())
    }

    /// The blob's bytes.
    fn bytes<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, self.raw())
    }

    /// Topics and sentences of the report.
    fn report(&self) -> Vec<(&'static str, String)> {
        self.report.clone()
    }

    /// What the blob holds.
    fn facts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let (blob, facts) = (self.blob(), PyDict::new(py));
        let (tree, curve) = (blob.bvh().ok(), blob.curve().ok());
        let serves = |of: fn(&Bvh<'_>) -> bool| tree.as_ref().is_some_and(of);
        let words = [
            ("closest", serves(|tree| tree.serves_distances())),
            ("segment", serves(|tree| tree.serves_segments())),
            ("cull", serves(|tree| tree.serves_culling())),
            ("winding", serves(|tree| tree.serves_winding())),
            ("hull", blob.hull().is_ok_and(|hull| hull.encloses())),
            ("sweep", blob.hull().is_ok_and(|hull| !hull.encloses())),
            ("deform", blob.deformable_hull().is_ok()),
            ("tight", blob.tight_hulls().is_ok()),
            ("triboxes", blob.triboxes().is_ok()),
            ("curve", curve.is_some()),
            ("sdf", blob.sdf().is_ok()),
        ];
        let words: Vec<&str> = words.iter().filter(|word| word.1).map(|word| word.0).collect();
        facts.set_item("serves", words)?;
        let segments = || curve.as_ref().map(Curve::segment_count);
        let deformable = blob.deformable_hull().ok();
        let of_frames = || deformable.as_ref().map(|hull| hull.rest().triangle_count());
        let elements = tree.as_ref().map(|tree| tree.triangle_count());
        facts.set_item("elements", elements.or_else(segments).or_else(of_frames))?;
        facts.set_item("is_curve", curve.is_some())?;
        facts.set_item("is_flat", curve.as_ref().is_some_and(Curve::is_planar))?;
        let stored = self.stored_bounds();
        facts.set_item("stored_bounds", stored.map(|(bounds, _)| bounds))?;
        facts.set_item("bounds", stored.map(|(bounds, error)| grown(bounds, error)))?;
        facts.set_item("is_closed", tree.as_ref().map(Bvh::is_closed))?;
        let is_fence = || curve.as_ref().map(|curve| curve.check_fence().is_ok());
        facts.set_item("has_sides", tree.as_ref().map(has_sides).or_else(is_fence))?;
        facts.set_item("frames", deformable.as_ref().map(|hull| hull.frames()))?;
        facts.set_item("field_kind", blob.sdf().ok().map(|field| field.kind().name()))?;
        let of_curve = || curve.as_ref().map(Curve::surface_error);
        facts.set_item("surface_error", tree.as_ref().map(Bvh::surface_error).or_else(of_curve))?;
        Ok(facts)
    }
}
