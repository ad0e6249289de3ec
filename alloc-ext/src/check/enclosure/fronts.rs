//! Proof that faces of a surface tell sides: it winds 0 times around every point just in front of
//! them.

use super::contact::{Touch, touch};
use super::surface::{Corners, Surface};
use super::winding::Winding;
use super::{area_free, near, sharing_apart};
use std::collections::BTreeMap;

/// Mean number of faces of a strip of y or z. Pairs of faces are looked for in strips, so that
/// large surfaces do not take the square of their faces.
const STRIP: usize = 2000;

/// Proves it of the faces that are not `sideless`:
/// 1. through every edge as many faces run in one direction as in the other;
/// 2. they share with all faces no more than common corners and edges, single points, and parts of
///    edges of both;
/// 3. patches are faces connected across edges that no third face touches: in front of one face of
///    each patch is a point with winding number 0 of the surface, and of the file's surface, which
///    has `turned` faces reversed;
/// 4. a component that is turned in part has no edge of more than two faces, and its box meets no
///    other component's box, unless both are sideless.
///
/// By 2, nothing but single points touches the interior of a face, and nothing separates the fronts
/// of two faces of a patch. So 3 holds in front of the whole patch. Faces without area bound
/// nothing.
///
/// # Errors
/// What does not hold, in words.
pub(crate) fn check_fronts(
    surface: &Surface,
    turned: &[bool],
    sideless: &[bool],
) -> Result<(), String> {
    let mut uses: BTreeMap<[u32; 2], [Vec<usize>; 2]> = BTreeMap::new();
    for (number, &[a, b, c]) in surface.triangles.iter().enumerate() {
        for (k, [u, v]) in [[a, b], [b, c], [c, a]].into_iter().enumerate() {
            let edge = uses.entry([u.min(v), u.max(v)]).or_default();
            edge[usize::from(u > v)].push(3 * number + k);
        }
    }
    if let Some((edge, _)) = uses.iter().find(|(_, [up, down])| up.len() != down.len()) {
        return Err(format!("the surface is not closed at the edge {edge:?}"));
    }
    let faces: Vec<Corners> = surface.triangles.iter().map(|&t| surface.corners(t)).collect();
    let has_area: Vec<bool> = faces.iter().map(|face| !area_free(face)).collect();
    let told: Vec<bool> = has_area.iter().zip(sideless).map(|(&area, &not)| area && !not).collect();
    let touched = touched_edges(surface, &faces, &has_area, &told)?;
    let mut patches: Vec<usize> = (0..faces.len()).collect();
    for [up, down] in uses.values() {
        if let (&[g], &[h]) = (&up[..], &down[..])
            && [g, h].iter().all(|&half_edge| !touched[half_edge] && told[half_edge / 3])
        {
            let (g, h) = (root(&mut patches, g / 3), root(&mut patches, h / 3));
            patches[g.max(h)] = g.min(h);
        }
    }
    let mut members: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for face in (0..faces.len()).filter(|&face| told[face]) {
        members.entry(root(&mut patches, face)).or_default().push(face);
    }
    let mut crowded = vec![false; faces.len()];
    for [up, down] in uses.values().filter(|[up, down]| up.len() + down.len() > 2) {
        up.iter().chain(down).for_each(|half_edge| crowded[half_edge / 3] = true);
    }
    let (winding, filed) = (Winding::new(surface), as_filed(surface, turned, &told, &crowded)?);
    for patch in members.values() {
        let Some(point) = patch.iter().find_map(|&face| in_front(&winding, &faces, face)) else {
            return Err(format!("no point in front of face {} is clear of others", patch[0]));
        };
        let around = winding.around(point)?;
        if around != 0 {
            return Err(format!("the surface winds {around} times around {point:?}, in front"));
        }
        let around = filed.around(point)?;
        if around != 0 {
            return Err(format!("the file winds {around} times around {point:?}, in front"));
        }
    }
    Ok(())
}

/// The surface as the file winds it, without the components that are turned in part: these have no
/// winding number, and must be alone.
///
/// # Errors
/// A component that is turned in part and is not alone, in words.
pub(crate) fn as_filed(
    surface: &Surface,
    turned: &[bool],
    told: &[bool],
    crowded: &[bool],
) -> Result<Winding, String> {
    let mut parents: Vec<usize> = (0..surface.positions.len()).collect();
    for &[a, b, c] in &surface.triangles {
        for v in [b, c] {
            let (a, v) = (root(&mut parents, a as usize), root(&mut parents, v as usize));
            parents[v.max(a)] = v.min(a);
        }
    }
    let component: Vec<usize> =
        surface.triangles.iter().map(|t| root(&mut parents, t[0] as usize)).collect();
    let mut of: BTreeMap<usize, Component> = BTreeMap::new();
    for (face, at) in component.iter().enumerate() {
        of.entry(*at).or_default().add(surface.corners(surface.triangles[face]), turned[face]);
        let of = of.entry(*at).or_default();
        of.is_told |= told[face];
        of.is_crowded |= crowded[face];
    }
    for (at, mixed) in of.iter().filter(|(_, of)| of.is_mixed()) {
        if mixed.is_crowded && mixed.is_told {
            return Err(format!(
                "the component with a corner at {:?} is turned in part, and more than two of its \
                 faces share an edge",
                mixed.low
            ));
        }
        let beside = |(other, of): (&usize, &Component)| other != at && of.meets(mixed);
        let other =
            of.iter().find(|&(other, of)| beside((other, of)) && (of.is_told || mixed.is_told));
        if let Some((_, other)) = other {
            return Err(format!(
                "the component with a corner at {:?} is turned in part, and is not alone: another \
                 has a corner at {:?}",
                mixed.low, other.low
            ));
        }
    }
    let mut filed = Surface { positions: surface.positions.clone(), triangles: Vec::new() };
    for (face, &[a, b, c]) in surface.triangles.iter().enumerate() {
        if !of[&component[face]].is_mixed() {
            filed.triangles.push(if turned[face] { [a, c, b] } else { [a, b, c] });
        }
    }
    Ok(Winding::new(&filed))
}

/// What is known of a component: its box, and its faces.
struct Component {
    low: [f64; 3],
    high: [f64; 3],
    has_turned: bool,
    has_others: bool,
    is_told: bool,
    /// More than two of its faces share an edge.
    is_crowded: bool,
}

impl Default for Component {
    fn default() -> Self {
        let (low, high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        Self { low, high, has_turned: false, has_others: false, is_told: false, is_crowded: false }
    }
}

impl Component {
    fn add(&mut self, corners: Corners, is_turned: bool) {
        for p in corners {
            self.low = [0, 1, 2].map(|k| self.low[k].min(p[k]));
            self.high = [0, 1, 2].map(|k| self.high[k].max(p[k]));
        }
        self.has_turned |= is_turned;
        self.has_others |= !is_turned;
    }

    fn is_mixed(&self) -> bool {
        self.has_turned && self.has_others
    }

    fn meets(&self, other: &Self) -> bool {
        (0..3).all(|k| self.low[k] <= other.high[k] && other.low[k] <= self.high[k])
    }
}

fn root(parents: &mut [usize], mut face: usize) -> usize {
    while parents[face] != face {
        parents[face] = parents[parents[face]];
        face = parents[face];
    }
    face
}

/// Half lengths that are tried, as parts of the largest coordinate. Too long: the segment meets
/// other faces, and no proof is found. Too short: rounding puts its end on the face.
const SAMPLE_PARTS: [f64; 2] = [1e-9, 1e-13];

/// A point in front of a face, and the segment from there through the face to its back meets no
/// other.
fn in_front(winding: &Winding, faces: &[Corners], face: usize) -> Option<[f64; 3]> {
    let [a, b, c] = faces[face];
    let middle = [0, 1, 2].map(|k| (a[k] + b[k] + c[k]) / 3.0);
    let (u, v) = ([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k]));
    let normal = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| u[i] * v[j] - u[j] * v[i]);
    let largest = normal.iter().fold(0f64, |most, x| most.max(x.abs()));
    let size = middle.iter().chain(&u).fold(0f64, |most, x| most.max(x.abs()));
    if largest == 0.0 {
        return None;
    }
    SAMPLE_PARTS.into_iter().find_map(|part| {
        let ends = [1.0, -1.0]
            .map(|to| [0, 1, 2].map(|k| middle[k] + to * part * size * (normal[k] / largest)));
        (winding.met_by(ends) == [face] && crate::check::exact::side(faces[face], ends[0]).0 > 0)
            .then_some(ends[0])
    })
}

/// For each edge, by face and corner, whether a face that shares no corner with it, or one, touches
/// it along a part.
fn touched_edges(
    surface: &Surface,
    faces: &[Corners],
    has_area: &[bool],
    told: &[bool],
) -> Result<Vec<bool>, String> {
    let extent = |axis: usize| {
        let xs = || faces.iter().flatten().map(|p| p[axis]);
        xs().fold(f64::NEG_INFINITY, f64::max) - xs().fold(f64::INFINITY, f64::min)
    };
    // Within a strip pairs are found along x.
    let axis = if extent(1) > extent(2) { 1 } else { 2 };
    let ends = |face: &Corners| {
        let ys = face.map(|p| p[axis]);
        (
            ys.into_iter().fold(f64::INFINITY, f64::min),
            ys.into_iter().fold(f64::NEG_INFINITY, f64::max),
        )
    };
    let (low, high) = faces
        .iter()
        .map(ends)
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (l, h)| (low.min(l), high.max(h)));
    let count = (faces.len() / STRIP).max(1);
    // Rounding keeps the order, so two faces with a common y are in a common strip.
    let strip = |y: f64| (((y - low) / (high - low) * count as f64) as usize).min(count - 1);
    let mut strips = vec![Vec::new(); count];
    for (number, face) in faces.iter().enumerate().filter(|(number, _)| has_area[*number]) {
        let (from, to) = ends(face);
        strips[strip(from)..=strip(to)].iter_mut().for_each(|strip| strip.push(number));
    }
    let mut touched = vec![false; 3 * faces.len()];
    for numbers in strips {
        let here: Vec<Corners> = numbers.iter().map(|&number| faces[number]).collect();
        for (i, j) in near(&here, &here, 0.0).into_iter().filter(|(i, j)| i < j) {
            let [a, b] = [numbers[i], numbers[j]];
            if !told[a] && !told[b] {
                continue;
            }
            let (s, t) = (&faces[a], &faces[b]);
            if sharing_apart(s, surface.triangles[a], t, surface.triangles[b]) {
                continue;
            }
            match touch(s, t) {
                Some(Touch::Point) => {}
                Some(Touch::Edges(of)) => {
                    for (face, edges) in [a, b].into_iter().zip(of) {
                        (0..3).for_each(|k| touched[3 * face + k] |= edges[k]);
                    }
                }
                None => return Err(format!("faces {a} and {b} cross, as at {:?}", s[0])),
            }
        }
    }
    Ok(touched)
}
