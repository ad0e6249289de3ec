//! COLLADA 1.4 and 1.5, in which the visual meshes of robots come.
//!
//! Crates for it name no line in their errors, and do not tell what they leave out.

mod geometry;
mod transform;

use rustc_hash::{FxHashMap, FxHashSet};
use std::path::Path;
use std::rc::Rc;

use self::geometry::Geometry;
use super::copies::Copies;
use super::document::{self, Document};
use super::placement::Placement;
use super::text::{number, quoted};
use super::{MeshError, RawMesh, Unit};

/// Reads the triangles and polygons of all nodes of the scene, each where its ancestors put it; of
/// all visual scenes if the file names none, and of all meshes if there is none. Lines are left
/// out. Controllers (skins and morphs) are refused by name.
///
/// A unit that is none of [`Unit`] is scaled to metres. `up_axis` turns nothing: RViz and Gazebo
/// take coordinates as they are written, and robots' meshes are written for them.
pub(super) fn read(file: &Path, bytes: &[u8]) -> Result<RawMesh, MeshError> {
    let text = document::text_of(file, bytes)?;
    let document = Document::parse(file, &text)?;
    check_version(&document)?;
    let mut copies = Copies::new(file, bytes.len());
    let asset = document.child(0, "asset");
    let length = asset.and_then(|asset| document.child(asset, "unit"));
    let (unit, scale) = unit(&document, length)?;
    if let Some(axis) = asset.and_then(|asset| document.child(asset, "up_axis")) {
        let name = document.nodes[axis].text.trim();
        if !matches!(name, "X_UP" | "Y_UP" | "Z_UP") {
            return Err(document.malformed(axis, format!("{} is no axis", quoted(name))));
        }
        if name != "Z_UP" {
            let what = "that turns nothing, coordinates stay as written";
            copies.raw.left_out.remark("up_axis", what, || name.to_owned());
        }
    }
    let most_depth = document.nodes.iter().filter(|node| node.name == "node").count();
    let known = FxHashMap::default();
    let without_geometry = FxHashSet::default();
    let mut scene =
        Scene { document: &document, copies, known, faces: 0, most_depth, without_geometry };
    scene.place_all(&scale)?;
    let unit_by_default = length.is_none();
    let raw = scene.copies.raw;
    Ok(RawMesh { unit: Some(unit), unit_by_default, decimal: true, ..raw })
}

fn check_version(document: &Document<'_>) -> Result<(), MeshError> {
    if document.nodes[0].name != "COLLADA" {
        return Err(document.malformed(0, "the root is not COLLADA"));
    }
    let version = document.attribute(0, "version").unwrap_or_default();
    if !["1.4", "1.5"].iter().any(|known| version.starts_with(known)) {
        return Err(document.unsupported(0, &format!("version {} of COLLADA", quoted(version))));
    }
    Ok(())
}

/// The unit, and how coordinates are put into it.
fn unit(document: &Document<'_>, length: Option<usize>) -> Result<(Unit, Placement), MeshError> {
    let metres = |of: usize| {
        let value = document.attribute(of, "meter").unwrap_or("1");
        let metres = number(value.trim()).ok().filter(|x| *x > 0.0 && x.is_finite());
        metres
            .ok_or_else(|| document.malformed(of, format!("meter {} is no length", quoted(value))))
    };
    let own = length.map_or(Ok(1.0), metres)?;
    for other in document.every("unit", "asset") {
        if metres(other)? != own {
            return Err(document.unsupported(other, "a second unit"));
        }
    }
    // Some programs write the nearest number of single precision.
    let is_it = |unit: &Unit| unit.metres() as f32 == own as f32;
    if let Some(unit) = Unit::ALL.into_iter().find(is_it) {
        return Ok((unit, Placement::IDENTITY));
    }
    let rows = [[own, 0.0, 0.0, 0.0], [0.0, own, 0.0, 0.0], [0.0, 0.0, own, 0.0]];
    Ok((Unit::M, Placement::of_rows(rows)))
}

/// The nodes that are placed so far.
struct Scene<'a> {
    document: &'a Document<'a>,
    copies: Copies,
    /// Geometries that were read, by their elements.
    known: FxHashMap<usize, Rc<Geometry>>,
    /// Faces that were read.
    faces: usize,
    /// Number of nodes: the depth of none is larger, unless it contains itself.
    most_depth: usize,
    /// Nodes that are known to place nothing.
    without_geometry: FxHashSet<usize>,
}

impl Scene<'_> {
    fn place_all(&mut self, scale: &Placement) -> Result<(), MeshError> {
        let document = self.document;
        let mut scenes: Vec<usize> = Vec::new();
        if let Some(scene) = document.child(0, "scene") {
            for instance in document.all(scene, "instance_visual_scene") {
                scenes.push(document.named(instance, "url", &["visual_scene"])?);
            }
        }
        let all: Vec<usize> = document.every("visual_scene", "library_visual_scenes").collect();
        if scenes.is_empty() {
            scenes.clone_from(&all);
        }
        for &other in all.iter().filter(|other| !scenes.contains(other)) {
            let what = "that is not shown left out";
            self.copies.raw.left_out.remark("visual scene", what, || document.place(other));
        }
        for &scene in &scenes {
            let nodes: Vec<usize> = document.all(scene, "node").collect();
            for node in nodes {
                self.place(node, scale)?;
            }
        }
        let geometries: Vec<usize> = document.every("geometry", "library_geometries").collect();
        for geometry in geometries {
            if scenes.is_empty() {
                self.add(geometry, scale)?;
            } else if !self.known.contains_key(&geometry) {
                let what = "that no node places left out";
                self.copies.raw.left_out.remark("geometry", what, || document.place(geometry));
            }
        }
        Ok(())
    }

    /// Places a node and all below it.
    fn place(&mut self, root: usize, parent: &Placement) -> Result<(), MeshError> {
        let document = self.document;
        // Depth, to notice nodes that contain themselves.
        let mut open = vec![(root, parent.clone(), 0)];
        while let Some((node, parent, depth)) = open.pop() {
            self.copies.count()?;
            if depth > self.most_depth {
                return Err(document.malformed(node, "it contains itself"));
            }
            // That of a camera places nothing.
            if transform::is_unread(document, node) && !self.holds_geometry(node) {
                continue;
            }
            let placement = parent.after(&transform::placement(document, node)?);
            let mut below = Vec::new();
            for &child in &document.nodes[node].children {
                match document.nodes[child].name.as_str() {
                    "instance_geometry" => {
                        let geometry = document.named(child, "url", &["geometry"])?;
                        self.add(geometry, &placement)?;
                    }
                    "instance_controller" => return Err(self.refuse_controller(child)),
                    "instance_node" => below.push(document.named(child, "url", &["node"])?),
                    "node" => below.push(child),
                    _ => {}
                }
            }
            // The first child is placed first.
            open.extend(below.into_iter().rev().map(|of| (of, placement.clone(), depth + 1)));
        }
        Ok(())
    }

    /// Whether a node or one below it places a geometry or a controller.
    fn holds_geometry(&mut self, root: usize) -> bool {
        let document = self.document;
        let mut open = vec![root];
        let mut seen: FxHashSet<usize> = FxHashSet::default();
        while let Some(node) = open.pop() {
            if self.without_geometry.contains(&node) || !seen.insert(node) {
                continue;
            }
            for &child in &document.nodes[node].children {
                match document.nodes[child].name.as_str() {
                    "instance_geometry" | "instance_controller" => return true,
                    // One that names nothing is refused elsewhere.
                    "instance_node" => match document.named(child, "url", &["node"]) {
                        Ok(node) => open.push(node),
                        Err(_) => return true,
                    },
                    "node" => open.push(child),
                    _ => {}
                }
            }
        }
        self.without_geometry.extend(seen);
        false
    }

    fn refuse_controller(&self, instance: usize) -> MeshError {
        let document = self.document;
        let controller = match document.named(instance, "url", &["controller"]) {
            Ok(controller) => controller,
            Err(error) => return error,
        };
        let kinds = ["skin", "morph"];
        let kind = kinds.into_iter().find(|kind| document.child(controller, kind).is_some());
        let what = format!("the {}", kind.unwrap_or("controller"));
        document.unsupported(controller, &what)
    }

    /// Adds a copy of a geometry.
    fn add(&mut self, of: usize, placement: &Placement) -> Result<(), MeshError> {
        self.copies.count()?;
        let geometry = match self.known.get(&of) {
            Some(known) => Rc::clone(known),
            None => {
                let read = Rc::new(geometry::read(self.document, of, self.faces)?);
                self.faces += read.face_count;
                self.copies.raw.polygons.add(&read.polygons);
                self.copies.raw.left_out.add(&read.left_out);
                self.known.insert(of, Rc::clone(&read));
                read
            }
        };
        let before = self.copies.raw.triangles.len();
        let first = self.copies.put(&geometry.positions, placement)?;
        self.copies.join(&geometry.triangles, first, placement)?;
        let mirrors = placement.mirrors();
        let fans = geometry.fans.iter().map(|&(number, fan)| {
            let [a, b, c] = fan.map(|v| v + first);
            (before + number, if mirrors { [a, c, b] } else { [a, b, c] })
        });
        self.copies.raw.fans.extend(fans);
        Ok(())
    }
}
