//! Solids drawn in parallel projection, the farthest face first: README's picture.
//!
//! ```text
//! panels (solid, glass) ─ View (turn, scale) ─ seen (order, shade) ─ SVG paths
//! ```
//! Coordinates are whole numbers, and sines come from `libm`: the same text on every machine.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use glam::{DMat3, DVec3};
use meshsweep::mesh::Mesh;
use meshsweep::progress::Watch;
use meshsweep::tight::hull_mesh;
use meshsweep::tribox::{self, TriboxOptions};
use meshsweep_core::{TightHulls, Triboxes};

use crate::workload::Subject;

/// A convex face: its corners, counter-clockwise seen from outside.
type Face = Vec<DVec3>;

/// One drawing of the row.
struct Panel {
    /// Printed above it.
    title: String,
    /// Drawn grey. It is closed, so only fronts show.
    solid: Vec<Face>,
    /// Drawn over it: fronts as blue glass with edges.
    glass: Vec<Face>,
}

/// Units of a panel, which is square, and of its margin. A unit is half a pixel.
const PANEL: i32 = 1120;
const MARGIN: f64 = 72.0;

/// Turns of the view about the horizontal and about the longest axis, in degrees: three sides of a
/// box show.
const TILT: [f64; 2] = [-24.0, 32.0];

/// Grey of a face seen from the side, and the step by which it brightens towards the eye. Few
/// steps: faces that follow each other in one grey share a path.
const DARK: f64 = 96.0;
const STEPS: f64 = 20.0;
const STEP: f64 = 7.0;

/// Triboxes of README's picture.
const TRIBOXES: u32 = 16;

/// README's picture: a part, its tight hull, its triboxes.
///
/// # Errors
/// A fixture that is missing or refused.
pub fn part(fixtures: &Path) -> Result<String, String> {
    let subject = Subject::load(&fixtures.join("bracket.stl"))?;
    let bytes = fs::read(fixtures.join("hulls.msw")).map_err(|error| error.to_string())?;
    let hulls = TightHulls::open(&bytes).map_err(|error| error.to_string())?;
    let hull = hull_mesh(&hulls.get(0).ok_or("no hull in hulls.msw")?);
    let options = TriboxOptions::new(TRIBOXES);
    let built = tribox::build(subject.mesh.as_input(), &options, Watch::NONE);
    let bytes = built.map_err(|error| error.to_string())?.0.to_bytes();
    let triboxes = Triboxes::open(&bytes).map_err(|error| error.to_string())?;
    let mut walls = Vec::new();
    for (_, tribox) in triboxes.leaves() {
        let boundary = tribox.boundary();
        let corner = |p: [f32; 3]| DVec3::from_array(p.map(f64::from));
        let faces = (0..18).map(|face| boundary.corners(face).map(corner).collect::<Face>());
        walls.extend(faces.filter(|face| face.len() > 2));
    }
    let count = subject.mesh.triangles.len();
    let panels = [
        (format!("{count} triangles"), Vec::new()),
        (format!("a tight hull of {} faces", hull.triangles.len()), faces(&hull)),
        (format!("{TRIBOXES} triboxes"), walls),
    ];
    Ok(svg(&panels.map(|(title, glass)| Panel { title, solid: faces(&subject.mesh), glass })))
}

/// The triangles of a mesh.
fn faces(mesh: &Mesh) -> Vec<Face> {
    let at = |v: u32| DVec3::from_array(mesh.positions[v as usize].map(f64::from));
    mesh.triangles.iter().map(|t| t.map(at).to_vec()).collect()
}

/// An SVG with a row of panels, which share one view.
fn svg(panels: &[Panel]) -> String {
    let (width, height) = (PANEL as usize * panels.len(), PANEL);
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{}\" \
         height=\"{}\" stroke-linejoin=\"round\" font-family=\"sans-serif\" font-size=\"34\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n",
        width / 2,
        height / 2
    );
    let view = View::new(panels);
    for (column, panel) in (0i32..).zip(panels) {
        let _ = writeln!(out, "<g transform=\"translate({} 0)\">", PANEL * column);
        view.solid(&mut out, &panel.solid);
        view.glass(&mut out, &panel.glass);
        let _ = writeln!(out, "<text x=\"32\" y=\"52\">{}</text>\n</g>", panel.title);
    }
    out.push_str("</svg>\n");
    out
}

/// A direction to look along, and the part of the scene that the panel shows.
struct View {
    /// To the right, up, and towards the eye.
    rotation: DMat3,
    centre: DVec3,
    scale: f64,
}

/// A face on the panel: the cosine between view and normal, and the corners.
struct Seen {
    facing: f64,
    corners: Vec<[i32; 2]>,
}

impl View {
    /// The shortest side of the first panel's box towards the eye, the longest to the right, and
    /// then a bit turned.
    fn new(panels: &[Panel]) -> Self {
        let points = |panel: &Panel| {
            let all = [&panel.solid, &panel.glass];
            all.into_iter().flatten().flatten().copied().collect::<Vec<DVec3>>()
        };
        let bounds = |points: &[DVec3]| {
            points.iter().fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], &p| {
                [low.min(p), high.max(p)]
            })
        };
        let [low, high] = bounds(&panels.first().map(points).unwrap_or_default());
        let extent = (high - low).to_array();
        let mut axes = [0, 1, 2];
        axes.sort_by(|&i, &j| extent[j].total_cmp(&extent[i]));
        let [right, up, _] = axes.map(|axis| DVec3::AXES[axis]);
        let straight = DMat3::from_cols(right, up, right.cross(up)).transpose();
        let [tilt, turn] = TILT.map(f64::to_radians);
        let rotation = DMat3::from_rotation_x(-tilt) * DMat3::from_rotation_y(turn) * straight;
        let turned: Vec<DVec3> =
            panels.iter().flat_map(points).map(|point| rotation * point).collect();
        let [low, high] = bounds(&turned);
        let side = (high - low).truncate().max_element();
        let scale = if side > 0.0 { (f64::from(PANEL) - 2.0 * MARGIN) / side } else { 1.0 };
        Self { rotation, centre: 0.5 * (low + high), scale }
    }

    /// Faces as they are seen, the farthest first. Faces of no width are left out: others hide
    /// them.
    fn seen(&self, faces: &[Face]) -> Vec<Seen> {
        let half = f64::from(PANEL) / 2.0;
        let mut seen: Vec<(f64, Seen)> = Vec::new();
        for face in faces {
            let at: Vec<DVec3> = face.iter().map(|&p| self.rotation * p - self.centre).collect();
            // Newell's normal: corners may coincide.
            let next = at.iter().cycle().skip(1);
            let normal = at.iter().zip(next).fold(DVec3::ZERO, |sum, (a, b)| sum + a.cross(*b));
            let corners: Vec<[i32; 2]> = at
                .iter()
                .map(|p| {
                    [half + p.x * self.scale, half - p.y * self.scale].map(|x| x.round() as i32)
                })
                .collect();
            let next = corners.iter().cycle().skip(1);
            let area: i64 = corners
                .iter()
                .zip(next)
                .map(|([a, b], [c, d])| {
                    i64::from(*a) * i64::from(*d) - i64::from(*b) * i64::from(*c)
                })
                .sum();
            if area != 0 {
                let depth = at.iter().map(|p| p.z).sum::<f64>() / at.len() as f64;
                seen.push((depth, Seen { facing: normal.normalize_or_zero().z, corners }));
            }
        }
        seen.sort_by(|a, b| a.0.total_cmp(&b.0));
        seen.into_iter().map(|(_, seen)| seen).collect()
    }

    /// Faces that follow each other in one grey share a path. A stroke of the same grey hides the
    /// seams.
    fn solid(&self, out: &mut String, faces: &[Face]) {
        let mut last = None;
        for Seen { facing, corners } in self.seen(faces) {
            if facing <= 0.0 {
                continue;
            }
            let grey = (DARK + STEP * (STEPS * facing.abs()).round()) as u8;
            if last != Some(grey) {
                let end = if last.is_some() { "\"/>\n" } else { "" };
                let color = format!("#{grey:02x}{grey:02x}{grey:02x}");
                let _ = write!(out, "{end}<path fill=\"{color}\" stroke=\"{color}\" d=\"");
                last = Some(grey);
            }
            outline(out, &corners);
        }
        if last.is_some() {
            out.push_str("\"/>\n");
        }
    }

    /// Fronts with edges, each over those behind.
    fn glass(&self, out: &mut String, faces: &[Face]) {
        if faces.is_empty() {
            return;
        }
        out.push_str(
            "<g fill=\"#0072b2\" fill-opacity=\"0.22\" stroke=\"#0072b2\" stroke-opacity=\".7\" \
             stroke-width=\"2\">\n",
        );
        for Seen { corners, .. } in self.seen(faces).iter().filter(|seen| seen.facing > 0.0) {
            out.push_str("<path d=\"");
            outline(out, corners);
            out.push_str("\"/>\n");
        }
        out.push_str("</g>\n");
    }
}

/// A closed loop, after its first corner in steps.
fn outline(out: &mut String, corners: &[[i32; 2]]) {
    let mut last = [0, 0];
    for (index, &[x, y]) in corners.iter().enumerate() {
        let (letter, [dx, dy]) =
            if index == 0 { ('M', [x, y]) } else { ('l', [x - last[0], y - last[1]]) };
        let _ = write!(out, "{letter}{dx} {dy}");
        last = [x, y];
    }
    out.push('z');
}

#[cfg(test)]
mod tests {
    use super::{Panel, faces, svg};
    use crate::generate::cube;
    use meshsweep::mesh::Mesh;

    #[test]
    fn a_cube_shows_three_sides_of_glass() {
        let (positions, triangles) = cube(1);
        let mesh = Mesh::new(positions, triangles);
        let panel = Panel { title: String::new(), solid: Vec::new(), glass: faces(&mesh) };
        let text = svg(&[panel]);
        assert_eq!(text.matches("<path").count(), 6);
        assert!(text.starts_with("<svg") && text.ends_with("</svg>\n"));
    }
}
