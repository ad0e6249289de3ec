//! The picture of `README.md`: a part, its tight hull, its triboxes. Parallel projection as SVG.

use std::collections::HashMap;
use std::fmt::Write;
use std::fs;
use std::path::Path;

use glam::DVec3;
use meshsweep::mesh::Mesh;
use meshsweep::{tight, tribox};
use meshsweep_core::{Blob, Tribox, Triboxes};

use crate::generate::bracket;

/// Pixels of a panel, which is square, of its margin and of the line with its title.
const PANEL: f64 = 300.0;
const MARGIN: f64 = 12.0;
const TITLE: f64 = 26.0;

/// From the part to the eye.
const TO_EYE: DVec3 = DVec3::new(0.62, -0.62, 0.48);

/// From the part to the light.
const TO_LIGHT: DVec3 = DVec3::new(0.35, -0.5, 0.8);

/// Triboxes that are drawn.
const TRIBOXES: u32 = 16;

/// The picture, from the bracket's generator and the hulls in `folder`, which is `fixtures`.
///
/// # Errors
/// `hulls.msw` is missing or damaged.
pub fn part(folder: &Path) -> Result<String, String> {
    let failed = |error: &dyn std::fmt::Display| format!("the picture: {error}");
    let (positions, triangles) = bracket();
    let mesh = Mesh::new(positions, triangles);
    let bytes = fs::read(folder.join("hulls.msw")).map_err(|error| failed(&error))?;
    let blob = Blob::open(&bytes).map_err(|error| failed(&error))?;
    let hulls = blob.tight_hulls().map_err(|error| failed(&error))?;
    let hull = hulls.get(0).ok_or("the picture: hulls.msw is empty")?;
    let (sections, _) = tribox::store(mesh.as_input(), TRIBOXES).map_err(|error| failed(&error))?;
    let boxed = sections.to_bytes();
    let triboxes = Triboxes::open(&boxed).map_err(|error| failed(&error))?;
    let leaves: Vec<Tribox> = triboxes.leaves().map(|(_, tribox)| tribox).collect();
    let faces = hull.record().faces;
    Ok(svg(
        &mesh,
        &[
            (format!("a part: {} triangles", mesh.triangles.len()), None),
            (format!("a tight hull: {faces} faces"), Some(&tight::hull_mesh(&hull))),
            (format!("{} triboxes", leaves.len()), Some(&tribox::surface(&leaves))),
        ],
    ))
}

/// Draws `part.svg` in `folder` anew.
///
/// # Errors
/// As of [`part`], or the file cannot be written.
pub fn write(folder: &Path) -> Result<(), String> {
    let file = folder.join("part.svg");
    fs::write(&file, part(folder)?)
        .map_err(|error| format!("cannot write {}: {error}", file.display()))
}

/// A panel for each title: the solid part, and a mesh around it as glass.
fn svg(part: &Mesh, panels: &[(String, Option<&Mesh>)]) -> String {
    let view = View::of(panels.iter().map(|&(_, glass)| glass).chain([Some(part)]));
    let (width, height) = (PANEL * panels.len() as f64, PANEL + TITLE);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"sans-serif\" font-size=\"15\" text-anchor=\"middle\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n\
         <defs><g id=\"part\" fill-rule=\"evenodd\" stroke-width=\".6\">\n"
    );
    for face in view.front(part) {
        let grey = (120.0 + 120.0 * face.normal.dot(TO_LIGHT).max(0.0)) as u8;
        let colour = format!("#{grey:02x}{grey:02x}{grey:02x}");
        let path = face.path;
        text += &format!("<path d=\"{path}\" fill=\"{colour}\" stroke=\"{colour}\"/>\n");
    }
    text += "</g></defs>\n";
    for (column, (title, glass)) in panels.iter().enumerate() {
        let left = PANEL * column as f64;
        text += &format!("<g transform=\"translate({left} 0)\"><use href=\"#part\"/>\n");
        text +=
            "<g fill=\"#0072b2\" fill-opacity=\".18\" stroke=\"#0072b2\" stroke-width=\".8\">\n";
        for face in glass.iter().flat_map(|glass| view.front(glass)) {
            text += &format!("<path d=\"{}\"/>\n", face.path);
        }
        let (x, y) = (PANEL / 2.0, PANEL + 12.0);
        text += &format!("</g><text x=\"{x}\" y=\"{y}\">{title}</text></g>\n");
    }
    text + "</svg>\n"
}

/// A flat face as it is drawn.
struct Face {
    area: f64,
    normal: DVec3,
    path: String,
}

struct View {
    right: DVec3,
    up: DVec3,
    /// Upper left corner of the scene, and pixels for a unit.
    left: f64,
    top: f64,
    scale: f64,
}

impl View {
    /// All meshes fit into a panel.
    fn of<'m>(meshes: impl Iterator<Item = Option<&'m Mesh>>) -> Self {
        let right = DVec3::Z.cross(TO_EYE).normalize();
        let up = TO_EYE.normalize().cross(right);
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for position in meshes.flatten().flat_map(|mesh| &mesh.positions) {
            let p = DVec3::from_array(position.map(f64::from));
            for (axis, at) in [p.dot(right), p.dot(up)].into_iter().enumerate() {
                (low[axis], high[axis]) = (low[axis].min(at), high[axis].max(at));
            }
        }
        let side = (high[0] - low[0]).max(high[1] - low[1]);
        let scale = (PANEL - 2.0 * MARGIN) / side;
        let middle = |axis: usize| (low[axis] + high[axis]) / 2.0;
        let half = PANEL / 2.0 / scale;
        Self { right, up, left: middle(0) - half, top: middle(1) + half, scale }
    }

    /// The flat faces towards the eye. The small ones come first, because the walls of a bore lie
    /// behind the faces that it pierces.
    fn front(&self, mesh: &Mesh) -> Vec<Face> {
        let mut faces: Vec<Face> = flat_faces(mesh)
            .into_iter()
            .map(|face| (face.iter().map(|t| normal(mesh, *t)).sum::<DVec3>(), face))
            .filter(|(sum, _)| sum.dot(TO_EYE) > 0.0)
            .map(|(sum, face)| Face {
                area: sum.length(),
                normal: sum.normalize(),
                path: self.path(mesh, &face),
            })
            .collect();
        faces.sort_by(|a, b| a.area.total_cmp(&b.area));
        faces
    }

    /// The outline of a face and its holes.
    fn path(&self, mesh: &Mesh, face: &[[u32; 3]]) -> String {
        let edges = face.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
        let all: Vec<(u32, u32)> = edges.collect();
        let mut next: HashMap<u32, u32> =
            all.iter().copied().filter(|&(a, b)| !all.contains(&(b, a))).collect();
        let mut text = String::new();
        while let Some(&start) = next.keys().min() {
            let mut at = start;
            let mut verb = 'M';
            while let Some(to) = next.remove(&at) {
                let p = DVec3::from_array(mesh.positions[at as usize].map(f64::from));
                let x = (p.dot(self.right) - self.left) * self.scale;
                let y = (self.top - p.dot(self.up)) * self.scale;
                let _ = write!(text, "{verb}{x:.1} {y:.1}");
                (at, verb) = (to, 'L');
            }
            text.push('Z');
        }
        text
    }
}

/// Twice the area along the normal.
fn normal(mesh: &Mesh, triangle: [u32; 3]) -> DVec3 {
    let [a, b, c] = triangle.map(|v| DVec3::from_array(mesh.positions[v as usize].map(f64::from)));
    (b - a).cross(c - a)
}

/// Triangles that share edges and a plane, together.
fn flat_faces(mesh: &Mesh) -> Vec<Vec<[u32; 3]>> {
    let mut at_edge = HashMap::new();
    for (index, &[a, b, c]) in mesh.triangles.iter().enumerate() {
        at_edge.extend([((a, b), index), ((b, c), index), ((c, a), index)]);
    }
    let mut is_taken = vec![false; mesh.triangles.len()];
    let mut faces = Vec::new();
    for first in 0..mesh.triangles.len() {
        let (mut face, mut waiting) = (Vec::new(), vec![first]);
        while let Some(index) = waiting.pop() {
            if std::mem::replace(&mut is_taken[index], true) {
                continue;
            }
            let triangle @ [a, b, c] = mesh.triangles[index];
            face.push(triangle);
            let own = normal(mesh, triangle).normalize_or_zero();
            let neighbours = [(b, a), (c, b), (a, c)].into_iter().filter_map(|e| at_edge.get(&e));
            waiting.extend(neighbours.filter(|&&other| {
                own.dot(normal(mesh, mesh.triangles[other]).normalize_or_zero()) > 1.0 - 1e-9
            }));
        }
        if !face.is_empty() {
            faces.push(face);
        }
    }
    faces
}
