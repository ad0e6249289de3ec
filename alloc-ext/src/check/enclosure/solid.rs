//! Proof that a surface bounds a solid: it winds 0 or 1 times around every point that is not on it.

use super::surface::{Corners, Surface};
use super::winding::Winding;
use super::{area_free, near, sharing_apart};
use crate::check::dyadic::Dyadic;
use crate::check::manifold::Manifold;
use crate::check::vector::{cross, dot, minus};
use std::collections::HashMap;

/// Mean number of faces of a strip of y or z. Pairs of faces are looked for in strips, so that
/// large surfaces do not take the square of their faces.
const STRIP: usize = 2000;

/// Proves that the surface is a closed manifold whose faces share no points but common corners and
/// edges, and that its components lie in each other as solids and cavities.
///
/// # Errors
/// What does not hold, in words.
pub(crate) fn check_solid(surface: &Surface) -> Result<(), String> {
    let mut connectivity = Manifold::default();
    for &face in &surface.triangles {
        connectivity.add(face)?;
    }
    connectivity.closed_manifold()?;
    embedded(surface)?;
    let components = components(surface);
    let windings: Vec<Winding> = components.iter().map(Winding::new).collect();
    let faces_out = components.iter().map(faces_out).collect::<Result<Vec<bool>, _>>()?;
    for (i, component) in components.iter().enumerate() {
        let corner = component.corners(component.triangles[0])[0];
        let mut around = 0;
        for (_, other) in windings.iter().enumerate().filter(|(j, _)| *j != i) {
            around += other.around(corner)?;
        }
        if around != i64::from(!faces_out[i]) {
            return Err(format!("the surface winds {around} times around {corner:?} from outside"));
        }
    }
    Ok(())
}

fn embedded(surface: &Surface) -> Result<(), String> {
    let faces: Vec<Corners> = surface.triangles.iter().map(|&t| surface.corners(t)).collect();
    if let Some(face) = faces.iter().position(area_free) {
        return Err(format!("face {face} has no area"));
    }
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
    for (number, face) in faces.iter().enumerate() {
        let (from, to) = ends(face);
        strips[strip(from)..=strip(to)].iter_mut().for_each(|strip| strip.push(number));
    }
    for numbers in strips {
        let here: Vec<Corners> = numbers.iter().map(|&number| faces[number]).collect();
        for (i, j) in near(&here, &here, 0.0).into_iter().filter(|(i, j)| i < j) {
            let [a, b] = [numbers[i], numbers[j]];
            if !sharing_apart(&faces[a], surface.triangles[a], &faces[b], surface.triangles[b]) {
                return Err(format!("faces {a} and {b} meet, as at {:?}", faces[a][0]));
            }
        }
    }
    Ok(())
}

/// The connected components, each as loose triangles that share no vertex.
fn components(surface: &Surface) -> Vec<Surface> {
    let mut parent: Vec<usize> = (0..surface.positions.len()).collect();
    fn root(parent: &mut [usize], mut vertex: usize) -> usize {
        while parent[vertex] != vertex {
            parent[vertex] = parent[parent[vertex]];
            vertex = parent[vertex];
        }
        vertex
    }
    for &[a, b, c] in &surface.triangles {
        for other in [b, c] {
            let (one, other) = (root(&mut parent, a as usize), root(&mut parent, other as usize));
            parent[one] = other;
        }
    }
    let (mut number, mut components) = (HashMap::new(), Vec::<Surface>::new());
    for &triangle in &surface.triangles {
        let root = root(&mut parent, triangle[0] as usize);
        let component = *number.entry(root).or_insert_with(|| {
            components.push(Surface::default());
            components.len() - 1
        });
        let of = &mut components[component];
        let first = of.positions.len() as u32;
        of.positions.extend(surface.corners(triangle));
        of.triangles.push([first, first + 1, first + 2]);
    }
    components
}

/// Whether a closed surface faces outwards, by its volume: in `f64`, and exactly if that does not
/// tell.
///
/// Each product carries five roundings, and the sum six for each face.
fn faces_out(surface: &Surface) -> Result<bool, String> {
    let corners = |t: &[u32; 3]| surface.corners(*t);
    let origin = surface.positions[0];
    let (mut volume, mut size) = (0.0, 0.0);
    for face in surface.triangles.iter().map(corners) {
        let [a, b, c] = face.map(|p| [0, 1, 2].map(|k| p[k] - origin[k]));
        for (i, j, k, sign) in [
            (0, 1, 2, 1.0),
            (1, 2, 0, 1.0),
            (2, 0, 1, 1.0),
            (0, 2, 1, -1.0),
            (1, 0, 2, -1.0),
            (2, 1, 0, -1.0),
        ] {
            let product: f64 = a[i] * b[j] * c[k];
            volume += sign * product;
            size += product.abs();
        }
    }
    let rounding = (6.0 * surface.triangles.len() as f64 + 16.0) * f64::EPSILON * size;
    if volume.abs() > rounding {
        return Ok(volume > 0.0);
    }
    let exact = |p: [f64; 3]| p.map(Dyadic::from);
    let (origin, mut volume) = (exact(origin), Dyadic::from(0.0));
    for face in surface.triangles.iter().map(corners) {
        let [a, b, c] = face.map(|p| minus(&exact(p), &origin));
        volume = &volume + &dot(&a, &cross(&b, &c));
    }
    match volume.sign() {
        0 => Err("a component has no volume".to_owned()),
        sign => Ok(sign > 0),
    }
}
