//! An opened blob, and its questions about points and segments.

use crate::curve::BEST_FIRST;
use crate::error::{MeshsweepError, QueryError, missing, of_open};
use crate::record::{Put, ended};
use crate::rows::{Lists, Records, Rows, ask, ask_many, in_blocks, rows};
use meshsweep::builder::Built;
use meshsweep::bvh::{BATCH, FastBvh, closest_points_until_refused};
use meshsweep::distances::{Distances, has_sides, signed_distance};
use meshsweep::hull::{enclosing_input, mesh_of, sticks_out_note};
use meshsweep::mesh::Mesh;
use meshsweep::tight::hull_mesh;
use meshsweep_core::{Blob, Budget, Bvh, Curve, Facing, Neighbor, ScratchEntry, TriangleHit};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
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

/// Room for triangles at first.
pub const ROOM: usize = 64;

/// Scratch memory of so many entries.
pub fn scratch(entries: usize) -> Vec<ScratchEntry> {
    vec![ScratchEntry::EMPTY; entries]
}

/// A budget of tolerances and steps; `None` is no limit.
pub fn budget(rel: f32, abs: f32, steps: Option<u32>) -> Budget {
    let steps = steps.unwrap_or(u32::MAX);
    Budget::EXACT.with_relative(rel).with_absolute(abs).with_steps(steps)
}

/// Vertices and triangles of a mesh.
type Arrays<'py> = (Bound<'py, PyArray2<f32>>, Bound<'py, PyArray2<u32>>);

fn arrays<'py>(py: Python<'py>, mesh: &Mesh) -> PyResult<Arrays<'py>> {
    let positions = PyArray1::from_vec(py, mesh.positions.as_flattened().to_vec());
    let triangles = PyArray1::from_vec(py, mesh.triangles.as_flattened().to_vec());
    Ok((
        positions.reshape([mesh.positions.len(), 3])?,
        triangles.reshape([mesh.triangles.len(), 3])?,
    ))
}

impl Model {
    /// The model of a build, with its report.
    pub fn built(built: Built) -> PyResult<Self> {
        let report = built.report().map(|note| (note.topic.name(), note.text.clone())).collect();
        Self::of(built.into_bytes(), report)
    }

    fn of(bytes: Vec<u8>, report: Vec<(&'static str, String)>) -> PyResult<Self> {
        let opened = Opened::try_new(bytes, |bytes| Blob::open(bytes)).map_err(of_open)?;
        Ok(Self { opened, report })
    }

    pub fn blob(&self) -> &Blob<'_> {
        self.opened.borrow_dependent()
    }

    pub fn raw(&self) -> &[u8] {
        self.opened.borrow_owner()
    }

    /// The box of what is stored, and how far the input may be beside that.
    fn stored_bounds(&self) -> Option<([[f32; 3]; 2], f32)> {
        let of_tree = |tree: &Bvh<'_>| (tree.bounds(), tree.surface_error());
        let of_distances = self.distances().ok().map(|structure| match &structure {
            Distances::Hull(hull) => (hull.bounds(), hull.surface_error()),
            Distances::Curve(curve) => (curve.bounds(), curve.surface_error()),
            Distances::Tight(hull) => of_tree(hull.bvh()),
            Distances::TreeWithField(both) => of_tree(both.tree()),
            Distances::Tree(tree) => of_tree(tree),
        });
        let of_tree = || self.blob().bvh().ok().as_ref().map(of_tree);
        let of_field = || self.blob().sdf().ok().map(|field| (field.bounds(), f32::MIN_POSITIVE));
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

    /// Whatever answers distances: the box tree, else the curves, the hull hierarchy, the finest
    /// tight hull.
    fn distances(&self) -> PyResult<Distances<'_>> {
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

/// The box, rounded to nearest, with so much around it: rounded outward.
fn grown(bounds: [[f32; 3]; 2], error: f32) -> [[f32; 3]; 2] {
    if error == 0.0 {
        // The vertices are in f32, and rounding to nearest keeps their order with the box.
        return bounds;
    }
    // The sum in f64, and its rounding to f32, are off by less than one step.
    let sum = |x: f32, error: f32| (f64::from(x) + f64::from(error)) as f32;
    let [low, high] = bounds;
    [
        low.map(|x| sum(x.next_down(), -error).next_down()),
        high.map(|x| sum(x.next_up(), error).next_up()),
    ]
}

/// Scratch memory that a structure is asked with.
fn scratch_of(structure: &Distances<'_>) -> Vec<ScratchEntry> {
    let more = if matches!(structure, Distances::Curve(_)) { BEST_FIRST } else { 0 };
    scratch(structure.scratch_entries() + more)
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
        facts.set_item("is_curve", curve.is_some())?;
        facts.set_item("is_flat", curve.as_ref().is_some_and(Curve::is_planar))?;
        let stored = self.stored_bounds();
        facts.set_item("stored_bounds", stored.map(|(bounds, _)| bounds))?;
        facts.set_item("bounds", stored.map(|(bounds, error)| grown(bounds, error)))?;
        facts.set_item("is_closed", tree.as_ref().map(Bvh::is_closed))?;
        let is_fence = || curve.as_ref().map(|curve| curve.check_fence().is_ok());
        facts.set_item("has_sides", tree.as_ref().map(has_sides).or_else(is_fence))?;
        let of_curve = || curve.as_ref().map(Curve::surface_error);
        facts.set_item("surface_error", tree.as_ref().map(Bvh::surface_error).or_else(of_curve))?;
        Ok(facts)
    }

    fn closest_point<'py>(
        &self,
        py: Python<'py>,
        points: Rows<'py>,
        limits: (f32, f32, Option<u32>),
        size: usize,
    ) -> PyResult<Records<'py>> {
        let (structure, budget) = (self.distances()?, budget(limits.0, limits.1, limits.2));
        let Distances::Tree(tree) = structure else {
            return ask(py, &points, size, || {
                let mut scratch = scratch_of(&structure);
                move |[x, y, z], mut put| {
                    let found = structure.closest_point([x, y, z], budget, &mut scratch)?;
                    put.closest(&found);
                    Ok(())
                }
            });
        };
        let rows = rows::<3>(&points)?;
        let mut records = vec![0; rows.len() * size];
        // Blocks of whole batches: then the work depends on no time.
        in_blocks(py, rows.len(), BATCH, |block| {
            let records = &mut records[block.start * size..];
            let begin = block.start;
            let (found, refused) = closest_points_until_refused(&tree, &rows[block], &budget);
            for (found, record) in found.into_iter().zip(records.chunks_mut(size)) {
                Put::new(record).closest(&found.into());
            }
            refused.map_or(Ok(()), |refused| Err((begin + refused.index, refused.error)))
        })?;
        Ok(PyArray1::from_vec(py, records))
    }

    /// With the side of the nearest triangle, else that of the winding number; `by_nearest_alone`
    /// leaves that out.
    fn signed_distance<'py>(
        &self,
        py: Python<'py>,
        points: Rows<'py>,
        steps: Option<u32>,
        by_nearest_alone: bool,
        size: usize,
    ) -> PyResult<Records<'py>> {
        let (tree, budget) = (self.tree("closest")?, budget(0.0, 0.0, steps));
        ask(py, &points, size, || {
            let mut scratch = scratch(tree.scratch_entries());
            move |[x, y, z], mut put| {
                let found = match by_nearest_alone {
                    true => tree.signed_distance([x, y, z], budget, &mut scratch),
                    false => signed_distance(&tree, [x, y, z], budget, &mut scratch),
                }?;
                let near = found.closest;
                put.interval(found.distance).side(found.side).floats(&near.point);
                put.number(near.triangle).ended(near.ended).count(near.work.total());
                Ok(())
            }
        })
    }

    /// Rows have a point and a distance.
    fn within<'py>(
        &self,
        py: Python<'py>,
        rows: Rows<'py>,
        steps: Option<u32>,
        size: usize,
    ) -> PyResult<Records<'py>> {
        let (structure, budget) = (self.distances()?, budget(0.0, 0.0, steps));
        ask(py, &rows, size, || {
            let mut scratch = scratch_of(&structure);
            let is_curve = matches!(structure, Distances::Curve(_));
            move |[x, y, z, distance], mut put| {
                let found = structure.any_within([x, y, z], distance, budget, &mut scratch)?;
                put.verdict(found.verdict);
                put.element(found.element, is_curve);
                put.ended(ended(found.verdict)).count(found.work.total());
                Ok(())
            }
        })
    }

    fn nearest<'py>(
        &self,
        py: Python<'py>,
        points: Rows<'py>,
        count: usize,
        size: usize,
    ) -> PyResult<Records<'py>> {
        let tree = self.tree("closest")?;
        let count = count.min(tree.triangle_count() as usize);
        ask(py, &points, size * count, || {
            let mut scratch = scratch(tree.scratch_entries());
            let mut room = vec![Neighbor::EMPTY; count];
            move |[x, y, z], mut put| {
                tree.nearest([x, y, z], &mut room, Budget::EXACT, &mut scratch)?;
                for near in &room {
                    put.interval(near.distance()).floats(&near.point());
                    put.number(Some(near.triangle()));
                }
                Ok(())
            }
        })
    }

    fn all_within<'py>(
        &self,
        py: Python<'py>,
        points: Rows<'py>,
        distance: f32,
        size: usize,
    ) -> PyResult<Lists<'py>> {
        let tree = self.tree("closest")?;
        ask_many(py, &points, size, || {
            let mut scratch = scratch(tree.scratch_entries());
            let mut room = vec![Neighbor::EMPTY; ROOM];
            move |[x, y, z], records| {
                let budget = Budget::EXACT;
                let mut ask = |room: &mut Vec<_>| {
                    tree.all_within([x, y, z], distance, room, budget, &mut scratch)
                };
                let mut all = ask(&mut room)?;
                if all.dropped > 0 {
                    room.resize(all.stored + all.dropped as usize, Neighbor::EMPTY);
                    all = ask(&mut room)?;
                }
                for (index, near) in room.iter().take(all.stored).enumerate() {
                    let begin = records.len();
                    records.resize(begin + size, 0);
                    let mut put = Put::new(&mut records[begin..]);
                    put.interval(near.distance()).floats(&near.point());
                    put.number(Some(near.triangle())).byte(u8::from(index < all.certain));
                }
                // With memory for all and without a limit of steps none is missing.
                Ok(true)
            }
        })
    }

    fn winding_number<'py>(
        &self,
        py: Python<'py>,
        points: Rows<'py>,
        size: usize,
    ) -> PyResult<Records<'py>> {
        let tree = self.tree("winding")?;
        ask(py, &points, size, || {
            let mut scratch = scratch(tree.scratch_entries());
            move |[x, y, z], mut put| {
                let found = tree.winding_number([x, y, z], Budget::EXACT, &mut scratch)?;
                put.interval(found.number).side(found.side).ended(found.ended);
                put.count(found.work.total());
                Ok(())
            }
        })
    }

    /// Rows have both ends; of rays the origin and the direction.
    fn first_hit<'py>(
        &self,
        py: Python<'py>,
        rows: Rows<'py>,
        is_ray: bool,
        facing: u8,
        steps: Option<u32>,
        size: usize,
    ) -> PyResult<Records<'py>> {
        let (facing, budget) = (facing_of(facing)?, budget(0.0, 0.0, steps));
        let tree = self.tree("segment")?;
        ask(py, &rows, size, || {
            let mut scratch = scratch(tree.scratch_entries());
            move |[ax, ay, az, bx, by, bz], mut put| {
                let (a, b) = ([ax, ay, az], [bx, by, bz]);
                let found = match is_ray {
                    true => tree.first_hit_of_ray(a, b, facing, budget, &mut scratch),
                    false => tree.first_hit(a, b, facing, budget, &mut scratch),
                }?;
                put.first_hit(&found);
                Ok(())
            }
        })
    }

    fn all_hits<'py>(
        &self,
        py: Python<'py>,
        rows: Rows<'py>,
        is_ray: bool,
        facing: u8,
        size: usize,
    ) -> PyResult<Lists<'py>> {
        let (facing, tree) = (facing_of(facing)?, self.tree("segment")?);
        ask_many(py, &rows, size, || {
            let mut scratch = scratch(tree.scratch_entries());
            let mut room = vec![TriangleHit::EMPTY; ROOM];
            move |[ax, ay, az, bx, by, bz], records| {
                let (a, b, budget) = ([ax, ay, az], [bx, by, bz], Budget::EXACT);
                let mut ask = |room: &mut Vec<_>| match is_ray {
                    true => tree.all_hits_of_ray(a, b, facing, room, budget, &mut scratch),
                    false => tree.all_hits(a, b, facing, room, budget, &mut scratch),
                };
                let mut all = ask(&mut room)?;
                if all.dropped > 0 {
                    room.resize(all.stored + all.dropped as usize, TriangleHit::EMPTY);
                    all = ask(&mut room)?;
                }
                for TriangleHit { hit, is_certain } in room.iter().take(all.stored) {
                    let begin = records.len();
                    records.resize(begin + size, 0);
                    let mut put = Put::new(&mut records[begin..]);
                    put.byte(if *is_certain { 1 } else { 2 }).floats(&[hit.t]);
                    put.floats(&hit.point).number(hit.triangle);
                }
                Ok(all.is_complete)
            }
        })
    }

    /// Distance, side and gradient by the distance field.
    fn field<'py>(
        &self,
        py: Python<'py>,
        points: Rows<'py>,
        size: usize,
    ) -> PyResult<Records<'py>> {
        let field = self.blob().sdf().map_err(|_| missing("distance field", "sdf"))?;
        ask(py, &points, size, || {
            move |[x, y, z], mut put: Put<'_>| {
                let (found, gradient) = field.distance_and_gradient([x, y, z])?;
                put.interval(found.distance).side(found.side).floats(&gradient);
                Ok(())
            }
        })
    }

    /// Tight hulls, coarse to fine: vertices, triangles, and how far they may be from the mesh.
    fn tight_hulls<'py>(&self, py: Python<'py>) -> PyResult<Vec<(Arrays<'py>, f64)>> {
        let hulls = self.blob().tight_hulls().map_err(|_| missing("tight hulls", "tight"))?;
        let hulls = (0..hulls.count()).filter_map(|index| hulls.get(index));
        hulls
            .map(|hull| {
                let off = f64::from(hull.record().slack) + f64::from(hull.bvh().surface_error());
                Ok((arrays(py, &hull_mesh(&hull))?, off))
            })
            .collect()
    }

    /// Level `index` of the hull hierarchy, 0 the coarsest: a mesh that encloses the input.
    fn hull_level<'py>(&self, py: Python<'py>, index: u32) -> PyResult<Arrays<'py>> {
        let hull = self.blob().hull().ok().filter(|hull| hull.encloses());
        let hull = hull.ok_or_else(|| missing("hulls that enclose", "hull"))?;
        let levels = hull.header().levels;
        let level = hull.level(index).ok_or_else(|| {
            pyo3::exceptions::PyIndexError::new_err(format!("there are {levels} levels"))
        })?;
        let stored = mesh_of(&hull, hull.faces(&level));
        let enclosing = enclosing_input(&hull, &stored).ok_or_else(|| {
            let note = sticks_out_note(f64::from(hull.surface_error()));
            MeshsweepError::new_err(note.unwrap_or_default())
        });
        arrays(py, &enclosing?)
    }

    /// Number of levels of the hull hierarchy; 0 without one.
    fn hull_levels(&self) -> u32 {
        self.blob().hull().map_or(0, |hull| hull.header().levels)
    }
}

fn facing_of(code: u8) -> PyResult<Facing> {
    match code {
        0 => Ok(Facing::Both),
        1 => Ok(Facing::Front),
        2 => Ok(Facing::Back),
        _ => Err(QueryError::new_err(format!("facing: {code} is none of 0, 1 and 2"))),
    }
}
