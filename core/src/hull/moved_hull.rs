//! The hull hierarchy under any motion of the mesh's vertices (Guéziec 2000, 5.3).
//!
//! The tables stay where they are. One record for each vertex of each level lies in the caller's
//! memory. One pass goes from the finest split to the coarsest. It moves each coarse vertex by a
//! displacement between those of the two vertices that its split adds, and it bounds two things:
//! - `spread`: the difference of its displacement and those of the mesh's vertices below it;
//! - `farthest`: its distance from the mesh's vertices below it.
//!
//! Each mesh vertex of a triangle's part of the surface lies below one of the triangle's corners.
//! So the triangle covers its part after the motion if its radius grows by the largest spread of
//! its corners and the largest difference of their displacements; and also if its radius is the
//! largest `farthest` of its corners. The first is small for small motions, the second does not
//! grow when a part turns. Proof: `core/docs/rounding.md` §17.

use super::closest_point;
use super::format::{DeformableHull, Hull, SplitIdx, VertIdx};
use super::geometry::{self, Geometry};
use crate::geom::{Aabb, RealVector};
use crate::num::tolerance::{
    DEFORM_DIAMETER, DEFORM_DOMAIN, DISPLACEMENT, LENGTH_UP, U32, VERTEX_UNDERFLOW,
};
use crate::num::{Radius16, Real, exp2, greater, lesser, sqrt_up, up_to_f32};
use crate::query::{Budget, ClosestPoint, QueryError, ScratchEntry};
use glam::Vec3;

/// Sixteen bytes of a [`MovedHull`]'s memory, for one vertex of one level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MovedVertex {
    position: [f32; 3],
    /// [`Radius16`] both, local frame.
    spread: u16,
    farthest: u16,
}

impl MovedVertex {
    /// Any value, for filling arrays.
    pub const EMPTY: MovedVertex = MovedVertex { position: [0.0; 3], spread: 0, farthest: 0 };

    fn position(&self) -> Vec3 {
        Vec3::from_array(self.position)
    }

    fn spread(&self) -> f32 {
        Radius16(self.spread).get()
    }

    fn farthest(&self) -> f32 {
        Radius16(self.farthest).get()
    }
}

/// The hull hierarchy of a mesh whose vertices move freely. It lives in the caller's memory, and
/// questions about it ask for the mesh as the last update left it.
///
/// The triangles of coarse levels cover their parts of the surface, but they need not enclose it.
#[derive(Debug)]
pub struct MovedHull<'a, 'v> {
    model: DeformableHull<'a>,
    vertices: &'v mut [MovedVertex],
    vertex_box: Aabb,
    surface_error: f64,
    has_pose: bool,
    /// Motion of the surface since the radii were computed, local frame. Every radius grows by it.
    used: f32,
}

impl<'a> DeformableHull<'a> {
    /// A hull whose vertices the caller moves, at rest for now.
    ///
    /// `memory`: [`vertex_records`](Self::vertex_records) at least. `build` prints the number.
    ///
    /// ```
    /// use meshsweep_core::{Budget, DeformableHull, MovedVertex, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/bend.msw"));
    /// let part = DeformableHull::open(bytes)?;
    /// let (mut memory, mut scratch) = ([MovedVertex::EMPTY; 512], Scratch::<256>::new());
    /// let mut moved = part.moved(&mut memory)?;
    /// let simulated = vec![[0.0, 0.0, 1.0]; part.input_vertices() as usize];
    /// moved.update(|vertex| simulated[vertex as usize])?;
    /// let near = moved.closest_point([0.0, 0.0, 9.0], Budget::EXACT, &mut scratch)?;
    /// assert!(near.distance.lower <= 8.0 && near.distance.upper >= 8.0);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError::VertexRecords`].
    pub fn moved<'v>(
        &self,
        memory: &'v mut [MovedVertex],
    ) -> Result<MovedHull<'a, 'v>, QueryError> {
        let (needed, found) = (self.vertex_records(), memory.len());
        let Some(vertices) = memory.get_mut(..needed) else {
            let [needed, found] = [needed, found].map(|count| count as u32);
            return Err(QueryError::VertexRecords { needed, found });
        };
        let vertex_box = self.rest().hull_box();
        let surface_error = f64::from(self.rest().header().surface_error);
        let (has_pose, used) = (false, 0.0);
        let mut moved =
            MovedHull { model: *self, vertices, vertex_box, surface_error, has_pose, used };
        moved.reset()?;
        Ok(moved)
    }
}

impl<'a> MovedHull<'a, '_> {
    /// Moves the vertices of the mesh. `place` gets the number of a vertex in the input file, from
    /// 0, and returns its place in input units. Numbers come in the order of the blob. Vertices
    /// that were welded move as the first of them, and `place` is not asked for the others. Of a
    /// blob built `--for sweep,deform` it is asked more than once for a vertex that was copied, and
    /// must answer alike.
    ///
    /// A rigid motion of the whole mesh makes bounds loose: leave it out here, and carry the points
    /// of questions into the part's frame.
    ///
    /// Cost: one pass over all vertices, four or five square roots for each split.
    ///
    /// # Errors
    /// [`QueryError::VertexOutOfDomain`]. Questions then answer [`QueryError::NoPose`] until the
    /// next update.
    pub fn update(&mut self, place: impl FnMut(u32) -> [f32; 3]) -> Result<(), QueryError> {
        self.place::<false>(place)?;
        self.settle().ok_or(QueryError::Unchecked)
    }

    /// The same as [`update`](Self::update), but the bounds of coarse levels stay as they are until
    /// the vertices have moved by more than `slack` (input units) since these bounds were computed.
    ///
    /// Meanwhile each bound grows by the motion so far: the sum, over the updates, of the largest
    /// displacement of a vertex. So a complete answer is as narrow as after
    /// [`update`](Self::update), and takes more steps. An answer that ends early is wider by the
    /// motion. A slack of 0 is used up by any motion.
    ///
    /// Cost: one pass over the vertices of the mesh. When the slack is used up, that of
    /// [`update`](Self::update). Source: Guéziec 2000, 5.3, volumes for a few steps.
    ///
    /// ```
    /// use meshsweep_core::{Budget, DeformableHull, MovedVertex, Scratch};
    /// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/bend.msw"));
    /// let part = DeformableHull::open(bytes)?;
    /// let (mut memory, mut scratch) = ([MovedVertex::EMPTY; 512], Scratch::<256>::new());
    /// let mut moved = part.moved(&mut memory)?;
    /// moved.update(|_| [0.0, 0.0, 1.0])?;
    /// moved.update_within(0.5, |_| [0.0, 0.0, 1.25])?;
    /// assert!(moved.motion() >= 0.25 && moved.motion() < 0.3);
    /// let near = moved.closest_point([0.0, 0.0, 9.25], Budget::EXACT, &mut scratch)?;
    /// assert!(near.distance.lower <= 8.0 && near.distance.upper >= 8.0);
    /// moved.update_within(0.5, |_| [0.0, 0.0, 1.75])?;
    /// assert_eq!(moved.motion(), 0.0, "the slack was used up");
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`update`](Self::update); [`QueryError::Tolerance`] of a slack that is negative or
    /// not finite, which changes nothing.
    pub fn update_within(
        &mut self,
        slack: f32,
        place: impl FnMut(u32) -> [f32; 3],
    ) -> Result<(), QueryError> {
        self.follow(slack, place).map(|_| ())
    }

    /// The hull hierarchy whose vertices move.
    pub fn deformable(&self) -> &DeformableHull<'a> {
        &self.model
    }

    /// Motion of the vertices that the bounds of coarse levels allow for, input units, rounded up:
    /// 0 after [`update`](Self::update).
    pub fn motion(&self) -> f32 {
        up_to_f32(f64::from(self.used) * self.model.tables().scale())
    }

    /// [`update_within`](Self::update_within), and how far a vertex moved at most, local frame;
    /// infinite if that is not known.
    pub(super) fn follow(
        &mut self,
        slack: f32,
        place: impl FnMut(u32) -> [f32; 3],
    ) -> Result<f64, QueryError> {
        if !(slack >= 0.0 && slack.is_finite()) {
            return Err(QueryError::Tolerance);
        }
        let slack = f64::from(slack) * exp2(-self.model.tables().header().scale_exponent);
        let (had_pose, before) = (self.has_pose, self.vertex_box);
        let motion = self.place::<true>(place)?;
        let used = (Real(self.used) + motion) * Real(LENGTH_UP);
        if had_pose && f64::from(used.0) <= slack {
            self.used = used.0;
            let (low, high) = grown([before.min, before.max], self.vertex_box.min);
            let (min, max) = grown([low, high], self.vertex_box.max);
            self.vertex_box = Aabb { min, max };
            self.has_pose = true;
        } else {
            self.settle().ok_or(QueryError::Unchecked)?;
        }
        Ok(if had_pose { f64::from(motion.0) } else { f64::INFINITY })
    }

    /// Puts the vertices of the mesh where they are now. With `MEASURES` it returns an upper bound
    /// of the largest displacement since the last time, local frame. The box is that of the mesh.
    fn place<const MEASURES: bool>(
        &mut self,
        mut place: impl FnMut(u32) -> [f32; 3],
    ) -> Result<Real, QueryError> {
        self.has_pose = false;
        let model = self.model;
        let hull = model.rest();
        let inverse = exp2(-hull.header().scale_exponent);
        let short = inverse as f32;
        let (mut rank, mut is_exact, mut most) = (0, true, Real(0.0));
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for (index, record) in (0..).zip(self.vertices.iter_mut()) {
            if hull.split_of(VertIdx(index)).is_some() {
                continue;
            }
            let vertex = model.number(rank).ok_or(QueryError::Unchecked)?;
            rank += 1;
            // Exact, but for underflow. In f64 it has the same bits.
            let given = place(vertex);
            let position = given.map(|x| {
                if short.is_normal() {
                    (Real(x) * Real(short)).0
                } else {
                    (f64::from(x) * inverse) as f32
                }
            });
            if !position.iter().all(|x| is_usual(*x)) {
                if !position.iter().all(|x| x.abs() < DEFORM_DOMAIN) {
                    return Err(QueryError::VertexOutOfDomain { vertex });
                }
                let mut both = given.iter().zip(&position);
                is_exact &= both.all(|(given, x)| *given == 0.0 || is_usual(*x));
            }
            let placed = MovedVertex { position, spread: 0, farthest: 0 };
            if MEASURES {
                let way = RealVector::from(placed.position()) - record.position().into();
                most = greater(most, way.dot(way));
            }
            *record = placed;
            (low, high) = grown([low, high], record.position());
        }
        self.surface_error = if is_exact { 0.0 } else { VERTEX_UNDERFLOW };
        self.vertex_box = Aabb { min: low, max: high };
        let [motion] = if MEASURES { sqrt_up([most.0]) } else { [0.0] };
        Ok(Real(motion) * Real(LENGTH_UP))
    }

    /// Moves the mesh back to where it was built.
    ///
    /// # Errors
    /// Never, for a hull that was opened.
    pub fn reset(&mut self) -> Result<(), QueryError> {
        self.has_pose = false;
        let hull = self.model.rest();
        for (index, record) in (0..).zip(self.vertices.iter_mut()) {
            let position = hull.position(VertIdx(index)).ok_or(QueryError::Unchecked)?.to_array();
            *record = MovedVertex { position, spread: 0, farthest: 0 };
        }
        self.surface_error = f64::from(hull.header().surface_error);
        self.vertex_box = hull.hull_box();
        self.settle().ok_or(QueryError::Unchecked)
    }

    /// Moves the coarse vertices after those of the mesh, fine to coarse.
    #[inline(never)]
    fn settle(&mut self) -> Option<()> {
        let hull = self.model.rest();
        let Aabb { min: mut low, max: mut high } = self.vertex_box;
        for split in (0..hull.header().splits).rev().map(SplitIdx) {
            let whole = hull.replaced_by(split)?;
            let parts = [hull.brought_by(split, 0), hull.brought_by(split, 1)];
            let [o, d] = [*self.record(parts[0])?, *self.record(parts[1])?];
            let [rest, rest_o, rest_d] = hull.positions([whole, parts[0], parts[1]])?;
            let [at_o, at_d] = [o.position(), d.position()].map(RealVector::from);
            let [rest, rest_o, rest_d] = [rest, rest_o, rest_d].map(RealVector::from);
            let (by_o, by_d) = (at_o - rest_o, at_d - rest_d);
            let between = by_d - by_o;
            let position = rest + by_o + between * fraction(between, d.spread() - o.spread());
            (low, high) = grown([low, high], position.into());
            let (to_o, to_d) = (at_o - position, at_d - position);
            let (off_o, off_d) = (to_o - (rest_o - rest), to_d - (rest_d - rest));
            let squares = [to_o, to_d, off_o, off_d].map(|vector| vector.dot(vector).0);
            let [to_o, to_d, off_o, off_d] = sqrt_up(squares).map(Real);
            let farthest = greater(Real(o.farthest()) + to_o, Real(d.farthest()) + to_d);
            let spread = greater(
                Real(o.spread()) + off_o + rounding(to_o),
                Real(d.spread()) + off_d + rounding(to_d),
            );
            let [spread, farthest] =
                [spread, farthest].map(|x| Radius16::round_up_f32((x * Real(LENGTH_UP)).0).0);
            let record = self.vertices.get_mut(whole.usize())?;
            *record = MovedVertex { position: Vec3::from(position).to_array(), spread, farthest };
        }
        self.vertex_box = Aabb { min: low, max: high };
        (self.has_pose, self.used) = (true, 0.0);
        Some(())
    }

    /// Coordinates of a vertex of any level as the last update left it, input units, rounded to
    /// f32.
    pub fn vertex(&self, vertex: VertIdx) -> Option<[f32; 3]> {
        geometry::vertex(self, vertex)
    }

    fn record(&self, vertex: VertIdx) -> Option<&MovedVertex> {
        self.vertices.get(vertex.usize())
    }

    /// Closest point of the moved surface to `point` (input units), with an interval that contains
    /// the distance to the mesh whose vertices are where the last update put them.
    ///
    /// `triangle` is the number in the input file. All else as for [`Hull::closest_point`];
    /// [`Hull::scratch_entries`] are enough. At rest the interval is that of the input file's mesh.
    ///
    /// Cost: that of the hull at rest, and more the more the motion bends and stretches; see
    /// `core/docs/measured.md`.
    ///
    /// # Errors
    /// Those of [`Hull::closest_point`]; [`QueryError::NoPose`] after an update that failed.
    #[inline(never)]
    pub fn closest_point(
        &self,
        point: [f32; 3],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<ClosestPoint, QueryError> {
        budget.check_with(scratch)?;
        let Budget { relative, absolute, steps } = budget;
        self.check()?;
        closest_point::closest_point(&self, point, [relative, absolute], steps, scratch)
    }
}

/// Whether a coordinate is below the domain, and a normal number, so that it lost no digits.
#[inline(always)]
fn is_usual(x: f32) -> bool {
    const LEAST: u32 = f32::MIN_POSITIVE.to_bits() << 1;
    const DOMAIN: u32 = DEFORM_DOMAIN.to_bits() << 1;
    (x.to_bits() << 1).wrapping_sub(LEAST) < DOMAIN - LEAST
}

/// The fraction of the way between two displacements at which the spread is least: the centre of
/// the smallest ball around two balls. Any fraction is sound.
#[inline(always)]
fn fraction(between: RealVector, spreads: f32) -> Real {
    // Both are of the surface, as most are.
    if spreads == 0.0 {
        return Real(0.5);
    }
    let [length] = sqrt_up([between.dot(between).0]);
    Real((0.5 + 0.5 * spreads / length).clamp(0.0, 1.0))
}

/// Rounding of a difference of displacements, from the moved distance of the two vertices.
#[inline(always)]
fn rounding(vector: Real) -> Real {
    Real(DISPLACEMENT * U32) * vector
}

/// A box that holds a further point.
#[inline(always)]
fn grown([low, high]: [Vec3; 2], point: Vec3) -> (Vec3, Vec3) {
    let each = |pick: fn(Real, Real) -> Real, a: Vec3| {
        let of = |a: f32, b: f32| pick(Real(a), Real(b)).0;
        Vec3::new(of(a.x, point.x), of(a.y, point.y), of(a.z, point.z))
    };
    (each(lesser, low), each(greater, high))
}

impl MovedHull<'_, '_> {
    #[inline(always)]
    fn records(&self, [a, b, c]: [VertIdx; 3]) -> Option<[MovedVertex; 3]> {
        let at = |vertex: VertIdx| self.vertices.get(vertex.usize()).copied();
        Some([at(a)?, at(b)?, at(c)?])
    }

    /// A radius of the last settlement, grown by the motion since then.
    #[inline(always)]
    fn widened(&self, radius: Real) -> f32 {
        if self.used == 0.0 {
            return radius.0;
        }
        ((radius + Real(self.used)) * Real(LENGTH_UP)).0
    }
}

impl<'a> Geometry<'a> for MovedHull<'a, '_> {
    #[inline(always)]
    fn tables(&self) -> &Hull<'a> {
        self.model.tables()
    }

    fn check(&self) -> Result<(), QueryError> {
        if self.has_pose { Ok(()) } else { Err(QueryError::NoPose) }
    }

    fn triangle(
        &self,
        corners: [VertIdx; 3],
        number: u32,
        is_surface: bool,
    ) -> Option<([Vec3; 3], f32)> {
        let records = self.records(corners)?;
        let at = records.map(|record| record.position());
        if is_surface {
            let closes_hole = !self.tables().has_part(number);
            return Some((at, if closes_hole { f32::INFINITY } else { 0.0 }));
        }
        let [r, s, t] = records.map(|record| Real(record.farthest()));
        let farthest = greater(r, greater(s, t));
        let [r, s, t] = records.map(|record| Real(record.spread()));
        let spread = Real(self.tables().radius(number)?) + greater(r, greater(s, t));
        if spread >= farthest {
            // A triangle without a part of the surface keeps its infinite radius.
            let radius =
                if self.tables().has_part(number) { farthest } else { Real(f32::INFINITY) };
            return Some((at, self.widened(radius)));
        }
        let [a, b, c] = at.map(RealVector::from);
        let [rest_a, rest_b, rest_c] = self.tables().positions(corners)?.map(RealVector::from);
        let (ab, bc, ca) = (b - a, c - b, a - c);
        let greatest =
            |[ab, bc, ca]: [RealVector; 3]| greater(ab.dot(ab), greater(bc.dot(bc), ca.dot(ca))).0;
        let off = [ab - (rest_b - rest_a), bc - (rest_c - rest_b), ca - (rest_a - rest_c)];
        let [off, vector] = sqrt_up([greatest(off), greatest([ab, bc, ca])]).map(Real);
        let grown = (spread + off + rounding(vector)) * Real(LENGTH_UP);
        Some((at, self.widened(lesser(farthest, grown))))
    }

    fn place(&self, vertex: VertIdx) -> Option<Vec3> {
        Some(self.record(vertex)?.position())
    }

    /// The swept triangle of a group is not known after a motion: it holds the whole model, if it
    /// stands for a part of it.
    fn group(&self, index: u32) -> Option<([Vec3; 3], f32)> {
        let (corners, radius) = self.tables().base_group(index)?;
        let corners = self.records(corners)?.map(|record| record.position());
        Some((corners, greater(radius, DEFORM_DIAMETER)))
    }

    fn vertex_box(&self) -> Aabb {
        self.vertex_box
    }

    fn surface_error(&self) -> f64 {
        self.surface_error
    }
}
