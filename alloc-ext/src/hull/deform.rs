//! What a hull hierarchy needs to deform: the numbers of its vertices in the input file, and key
//! frames.
//!
//! At a key frame a coarse vertex moves by the mean displacement of the two vertices that its split
//! brings. For each triangle and each vertex of its part of the surface one point of the triangle
//! is fixed: the nearest at rest. The radius of a key is the largest distance of these pairs. Proof
//! that it may be interpolated: `core/docs/rounding.md` §17.

use super::tables::Tables;
use crate::collapse::{History, VertexOrder};
use crate::error::BuildError;
use crate::mesh::{KeyFrame, Mesh};
use crate::surface::Stored;
use glam::DVec3;
use meshsweep_core::internal::format::layout::index_bytes;
use meshsweep_core::internal::geom::point_triangle;
use meshsweep_core::internal::num::tolerance::{DEFORM_DOMAIN, FIXED_POINT, U64};
use meshsweep_core::internal::num::{Radius8, exp2, up_to_f32};

/// The body of the section of vertex numbers. `places`: the vertex of the mesh that has the place
/// of each label of the surface.
pub fn vertex_numbers(
    tables: &Tables,
    order: &VertexOrder,
    (mesh, places): (&Mesh, &[u32]),
) -> Vec<u8> {
    let of_surface = order.label.iter().zip(&tables.splits_with).filter(|(_, with)| with.is_none());
    let numbers: Vec<u32> =
        of_surface.map(|(&label, _)| mesh.vertex_source[places[label as usize] as usize]).collect();
    let above = numbers.iter().max().map_or(0, |&most| most + 1);
    let mut body = above.to_le_bytes().to_vec();
    let width = index_bytes(above as usize);
    numbers.iter().for_each(|number| body.extend(&number.to_le_bytes()[..width]));
    body
}

/// One key frame.
#[derive(Clone, Debug)]
struct KeyTrack {
    /// Places by label, as stored.
    positions: Vec<DVec3>,
    /// Largest distance of a vertex between file and blob, rounded up.
    error: f64,
    /// By instance.
    radius: Vec<f64>,
}

/// The key frames but the first.
#[derive(Clone, Debug)]
pub struct KeyTracks(Vec<KeyTrack>);

impl KeyTracks {
    /// Places of all vertices; radii are 0 until [`cover`](Self::cover) raises them. A vertex of the
    /// surface has the place of a vertex of the mesh, by `places`.
    ///
    /// # Errors
    /// [`BuildError::FrameTooFar`].
    pub fn new(
        history: &History,
        stored: &Stored,
        (mesh, places): (&Mesh, &[u32]),
        frames: &[KeyFrame],
    ) -> Result<Self, BuildError> {
        let track = |(index, frame): (usize, &KeyFrame)| {
            let scale = exp2(-stored.scale_exponent);
            let mut error = 0f64;
            let mut positions = Vec::with_capacity(history.positions.len());
            for vertex in places.iter().map(|&vertex| vertex as usize) {
                let exact = DVec3::from(frame.positions[vertex].map(f64::from)) * scale;
                let single = exact.as_vec3();
                let fits = single.abs().max_element() < DEFORM_DOMAIN;
                if !fits {
                    let vertex = mesh.vertex_source[vertex];
                    return Err(BuildError::FrameTooFar { frame: index + 1, vertex });
                }
                error = error.max(single.as_dvec3().distance(exact) * (1.0 + 1e-15));
                positions.push(single.as_dvec3());
            }
            for collapse in &history.collapses {
                let rest = |label: u32| history.positions[label as usize];
                let motion = |label: u32| positions[label as usize] - rest(label);
                let mean = (motion(collapse.origin) + motion(collapse.destination)) * 0.5;
                // Collapses make labels in turn.
                positions.push((rest(collapse.vertex) + mean).as_vec3().as_dvec3());
            }
            let error = error + frame.rounding * scale;
            Ok(KeyTrack { positions, error, radius: vec![0.0; history.instances()] })
        };
        frames.iter().enumerate().map(track).collect::<Result<_, _>>().map(Self)
    }

    /// Raises the radii of an instance, so that the triangle covers its part of the surface, whose
    /// vertices are `below`. `rest`: places at rest. All vertices are labels.
    pub fn cover(&mut self, rest: &[DVec3], instance: u32, below: &[u32], corners: [u32; 3]) {
        if self.0.is_empty() {
            return;
        }
        let at_rest = corners.map(|label| rest[label as usize]);
        for &vertex in below {
            // A corner stays on itself.
            if corners.contains(&vertex) {
                continue;
            }
            let fixed = fixed_point(rest[vertex as usize], at_rest);
            for track in &mut self.0 {
                let at = |label: u32| track.positions[label as usize];
                let distance = distance_up(at(vertex), corners.map(at), fixed);
                let radius = &mut track.radius[instance as usize];
                *radius = radius.max(distance);
            }
        }
    }

    /// Instances that stand for no part of the surface at rest, whose radii are infinite, stand for
    /// none in any frame.
    pub fn leave_out(&mut self, at_rest: &[f64]) {
        for track in &mut self.0 {
            for (radius, at_rest) in track.radius.iter_mut().zip(at_rest) {
                *radius = if at_rest.is_finite() { *radius } else { f64::INFINITY };
            }
        }
    }

    /// The body of the section of key frames; empty without any.
    pub fn section(&self, history: &History, order: &VertexOrder) -> Vec<u8> {
        let Self(tracks) = self;
        if tracks.is_empty() {
            return Vec::new();
        }
        let mut body = (tracks.len() as u32).to_le_bytes().to_vec();
        let mut put = |x: f32| body.extend(x.to_le_bytes());
        for track in tracks {
            put(up_to_f32(track.error * (1.0 + 1e-15)));
            let first = (DVec3::INFINITY, DVec3::NEG_INFINITY);
            let (low, high) =
                track.positions.iter().fold(first, |(low, high), &p| (low.min(p), high.max(p)));
            [low, high].iter().flat_map(|corner| corner.as_vec3().to_array()).for_each(&mut put);
        }
        // Base triangles first, then those of each split, coarse to fine.
        let splits = (0..history.collapses.len()).rev();
        let fine = splits.flat_map(|collapse| history.fine(collapse));
        let instances: Vec<u32> = history.base_instances.iter().chain(fine).copied().collect();
        for track in tracks {
            for &label in &order.label {
                let place = track.positions[label as usize].as_vec3();
                place.to_array().iter().for_each(|x| body.extend(x.to_le_bytes()));
            }
            let radius = |&i: &u32| Radius8::round_up(track.radius[i as usize]).0;
            body.extend(instances.iter().map(radius));
        }
        body
    }
}

/// Barycentric coordinates of the point of a triangle that is nearest to `p`, of its second and
/// third corner.
fn fixed_point(p: DVec3, [a, b, c]: [DVec3; 3]) -> [f64; 2] {
    // As the radius at rest: a corner is at distance zero.
    if p == a {
        return [0.0, 0.0];
    }
    if p == b {
        return [1.0, 0.0];
    }
    if p == c {
        return [0.0, 1.0];
    }
    let nearest = point_triangle(p, a, b, c);
    [nearest.u, nearest.v]
}

/// Upper bound of the distance from `p` to a point of a triangle.
fn distance_up(p: DVec3, [a, b, c]: [DVec3; 3], [u, v]: [f64; 2]) -> f64 {
    let (ap, ab, ac) = (p - a, b - a, c - a);
    let norms = ap.abs().element_sum() + ab.abs().element_sum() + ac.abs().element_sum();
    (ap - ab * u - ac * v).length() + FIXED_POINT * U64 * norms
}
