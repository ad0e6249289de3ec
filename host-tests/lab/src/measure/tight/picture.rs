//! Hulls drawn over their mesh: parallel projection, the farthest triangle first.

use glam::{DMat3, DVec3};
use meshsweep::mesh::Mesh;
use plotters::prelude::*;

use super::Measured;
use super::cluster::cluster;

/// A mesh and hulls of it.
pub struct Gallery {
    title: String,
    /// The mesh, as much of it as shows.
    mesh: Vec<[DVec3; 3]>,
    hulls: Vec<(String, Vec<[DVec3; 3]>)>,
}

/// Faces of the hulls that are drawn.
const SHOWN: [usize; 3] = [50, 200, 2_000];

/// Triangles that a mesh is drawn with.
const MOST: usize = 3_000;

/// Pixels of a panel, which is square, and of its margin.
const PANEL: i32 = 560;
const MARGIN: f64 = 36.0;

/// Turns of the view about the horizontal and about the longest axis, in degrees: three sides of a
/// box show.
const TILT: [f64; 2] = [-24.0, 32.0];

impl Gallery {
    /// Of a mesh and some of the hulls that were measured.
    #[must_use]
    pub fn new(title: &str, mesh: &Mesh, measured: &[Measured]) -> Self {
        let shown = measured.iter().filter(|one| SHOWN.contains(&one.asked));
        let hulls = shown.map(|Measured { void, hull, .. }| {
            let at = |v: u32| DVec3::from_array(hull.positions[v as usize].map(f64::from));
            let void = void.map_or(String::new(), |void| format!(", {:.2} % void", 100.0 * void));
            let title = format!("{} faces{void}", hull.triangles.len());
            (title, hull.triangles.iter().map(|t| t.map(at)).collect())
        });
        Self { title: title.to_owned(), mesh: cluster(mesh, MOST), hulls: hulls.collect() }
    }
}

/// An SVG with a row for each mesh, a panel for each hull.
///
/// # Errors
/// There is nothing to draw, or plotters refuses.
pub fn svg(galleries: &[Gallery]) -> Result<String, String> {
    let columns = galleries.iter().map(|gallery| gallery.hulls.len()).max().unwrap_or(0);
    if columns == 0 {
        return Err("no hulls were measured that could be drawn".to_owned());
    }
    let mut text = String::new();
    {
        let size = [columns, galleries.len()].map(|panels| PANEL.unsigned_abs() * panels as u32);
        let root = SVGBackend::with_string(&mut text, size.into()).into_drawing_area();
        let drawn = root.fill(&WHITE).map_err(|error| error.to_string());
        drawn?;
        for (row, gallery) in (0i32..).zip(galleries) {
            let view = View::new(gallery);
            for (column, (title, hull)) in (0i32..).zip(&gallery.hulls) {
                let corner = (PANEL * column, PANEL * row);
                let draw = || {
                    view.mesh(&root, corner, &gallery.mesh)?;
                    view.hull(&root, corner, hull)?;
                    let place = (corner.0 + 16, corner.1 + 12);
                    root.draw(&Text::new(
                        format!("{}: {title}", gallery.title),
                        place,
                        ("sans-serif", 17).into_font(),
                    ))
                };
                draw().map_err(|error| error.to_string())?;
            }
        }
        root.present().map_err(|error| error.to_string())?;
    }
    Ok(text)
}

type Area<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;
/// A triangle's depth, the cosine between view and normal, its corners.
type Seen = (f64, f64, Vec<(i32, i32)>);
type Drawn = Result<(), DrawingAreaErrorKind<std::io::Error>>;

/// A direction to look along, and what of the scene is the panel.
struct View {
    /// To the right, up, and towards the eye.
    rotation: DMat3,
    centre: DVec3,
    scale: f64,
}

impl View {
    /// The shortest side of the mesh's box towards the eye, the longest to the right, and then a
    /// bit turned.
    fn new(gallery: &Gallery) -> Self {
        let bounds = |of: &mut dyn Iterator<Item = DVec3>| {
            of.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| {
                (low.min(p), high.max(p))
            })
        };
        let (low, high) = bounds(&mut gallery.mesh.iter().flatten().copied());
        let extent = (high - low).to_array();
        let mut axes = [0, 1, 2];
        axes.sort_by(|&i, &j| extent[j].total_cmp(&extent[i]));
        let [right, up, _] = axes.map(|axis| DVec3::AXES[axis]);
        let straight = DMat3::from_cols(right, up, right.cross(up)).transpose();
        let [tilt, turn] = TILT.map(f64::to_radians);
        let rotation = DMat3::from_rotation_x(-tilt) * DMat3::from_rotation_y(turn) * straight;
        let hulls = gallery.hulls.iter().flat_map(|(_, hull)| hull.iter().flatten());
        let (low, high) =
            bounds(&mut gallery.mesh.iter().flatten().chain(hulls).map(|&p| rotation * p));
        let side = (high - low).truncate().max_element();
        Self {
            rotation,
            centre: (low + high) * 0.5,
            scale: if side > 0.0 { (f64::from(PANEL) - 2.0 * MARGIN) / side } else { 1.0 },
        }
    }

    /// Triangles as they are seen, the farthest first, with the cosine between view and normal.
    fn seen(&self, triangles: &[[DVec3; 3]], corner: (i32, i32)) -> Vec<(f64, Vec<(i32, i32)>)> {
        let mut seen: Vec<Seen> = Vec::new();
        for triangle in triangles {
            let at = triangle.map(|p| self.rotation * p - self.centre);
            let facing = (at[1] - at[0]).cross(at[2] - at[0]).normalize_or_zero().z;
            let pixel = |p: DVec3| {
                let half = f64::from(PANEL) / 2.0;
                let across = (half + p.x * self.scale).round() as i32;
                (corner.0 + across, corner.1 + (half - p.y * self.scale).round() as i32)
            };
            let [a, b, c] = at.map(pixel);
            // What is no pixel wide is hidden by what is around it.
            if (b.0 - a.0) * (c.1 - a.1) != (b.1 - a.1) * (c.0 - a.0) {
                seen.push((at[0].z + at[1].z + at[2].z, facing, vec![a, b, c]));
            }
        }
        seen.sort_by(|a, b| a.0.total_cmp(&b.0));
        seen.into_iter().map(|(_, facing, corners)| (facing, corners)).collect()
    }

    /// Solid; both sides of a triangle, as the mesh may be open.
    fn mesh(&self, root: &Area<'_>, corner: (i32, i32), triangles: &[[DVec3; 3]]) -> Drawn {
        for (facing, corners) in self.seen(triangles, corner) {
            let grey = (95.0 + 135.0 * facing.abs()) as u8;
            root.draw(&Polygon::new(corners, RGBColor(grey, grey, grey).filled()))?;
        }
        Ok(())
    }

    /// Its front, as glass with edges.
    fn hull(&self, root: &Area<'_>, corner: (i32, i32), triangles: &[[DVec3; 3]]) -> Drawn {
        let glass = RGBColor(0, 114, 178);
        for (_, corners) in
            self.seen(triangles, corner).into_iter().filter(|(facing, _)| *facing > 0.0)
        {
            let outline: Vec<_> = corners.iter().chain(corners.first()).copied().collect();
            root.draw(&Polygon::new(corners, glass.mix(0.22).filled()))?;
            root.draw(&PathElement::new(outline, glass.mix(0.7)))?;
        }
        Ok(())
    }
}
