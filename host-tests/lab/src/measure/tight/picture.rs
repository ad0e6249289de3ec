//! Hulls drawn over their mesh.

use meshsweep::mesh::Mesh;
use meshsweep_host_tests::picture::{Face, Panel, faces, svg as draw};

use super::Measured;
use super::cluster::cluster;

/// A mesh and hulls of it.
pub struct Gallery(Vec<Panel>);

/// Faces of the hulls that are drawn.
const SHOWN: [usize; 3] = [50, 200, 2_000];

/// Triangles that a mesh is drawn with.
const MOST: usize = 3_000;

impl Gallery {
    /// Of a mesh and some of the hulls that were measured.
    #[must_use]
    pub fn new(title: &str, mesh: &Mesh, measured: &[Measured]) -> Self {
        let solid: Vec<Face> = cluster(mesh, MOST).into_iter().map(Vec::from).collect();
        let shown = measured.iter().filter(|one| SHOWN.contains(&one.asked));
        let panels = shown.map(|Measured { void, hull, .. }| {
            let void = void.map_or(String::new(), |void| format!(", {:.2} % void", 100.0 * void));
            let title = format!("{title}: {} faces{void}", hull.triangles.len());
            Panel { title, solid: solid.clone(), glass: faces(hull), ..Panel::default() }
        });
        Self(panels.collect())
    }
}

/// An SVG with a row for each mesh, a panel for each hull.
///
/// # Errors
/// There is nothing to draw.
pub fn svg(galleries: Vec<Gallery>) -> Result<String, String> {
    let rows: Vec<Vec<Panel>> = galleries.into_iter().map(|gallery| gallery.0).collect();
    if rows.iter().all(Vec::is_empty) {
        return Err("no hulls were measured that could be drawn".to_owned());
    }
    Ok(draw(&rows))
}
