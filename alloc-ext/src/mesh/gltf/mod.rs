//! glTF 2.0, as text with buffers beside it or as one binary file.
//!
//! Read here and not by the crate `gltf`: its accessors panic on damaged files, and it costs twelve
//! seconds to compile for the ten fields that a mesh needs.

mod buffers;

use serde_json::Value;
use std::path::Path;

use self::buffers::Buffers;
use super::copies::Copies;
use super::placement::Placement;
use super::strip::strip;
use super::{MeshError, RawMesh, Unit};

/// Extensions that a file may require: they change no triangle, or are read.
const HARMLESS: [&str; 6] = [
    "KHR_mesh_quantization",
    "KHR_texture_",
    "KHR_materials_",
    "KHR_lights_punctual",
    "EXT_texture_",
    "MSFT_texture_dds",
];

/// Reads the triangles of all nodes of all scenes, or of all nodes if there is no scene, each where
/// its ancestors put it. Points and lines are left out. Skins, morphs and compressed meshes are
/// refused by name.
pub(super) fn read(file: &Path, bytes: &[u8]) -> Result<RawMesh, MeshError> {
    let (json, binary) = buffers::split(file, bytes)?;
    let root: Value = serde_json::from_slice(json).map_err(|error| MeshError::Malformed {
        file: file.to_owned(),
        line: binary.is_none().then(|| error.line()),
        place: "the JSON".into(),
        reason: error.to_string(),
    })?;
    let source = Source { file, root: &root };
    source.check_version()?;
    let mut scene = Scene {
        source,
        copies: Copies::new(file, bytes.len()),
        buffers: Buffers::new(source, binary),
        is_placed: vec![false; source.list("nodes").len()],
    };
    for node in scene.roots()? {
        scene.place(node)?;
    }
    Ok(RawMesh { unit: Some(Unit::M), ..scene.copies.raw })
}

/// The file's JSON.
#[derive(Clone, Copy)]
struct Source<'a> {
    file: &'a Path,
    root: &'a Value,
}

impl<'a> Source<'a> {
    fn malformed(&self, place: &str, reason: impl Into<String>) -> MeshError {
        let (place, reason) = (place.into(), reason.into());
        MeshError::Malformed { file: self.file.to_owned(), line: None, place, reason }
    }

    fn unsupported(&self, what: String) -> MeshError {
        MeshError::Unsupported { file: self.file.to_owned(), what }
    }

    fn check_version(&self) -> Result<(), MeshError> {
        let version = self.root["asset"]["version"].as_str();
        let version =
            version.ok_or_else(|| self.malformed("the header", "asset has no version"))?;
        if !version.starts_with("2.") {
            return Err(self.unsupported(format!("glTF {version}")));
        }
        let required = list(self.root, "extensionsRequired").iter().filter_map(Value::as_str);
        let mut others =
            required.filter(|name| !HARMLESS.iter().any(|known| name.starts_with(known)));
        others.next().map_or(Ok(()), |name| Err(self.unsupported(format!("the extension {name}"))))
    }

    /// Refuses an object that an extension would change.
    fn refuse_extension(&self, of: &Value, names: &[&str]) -> Result<(), MeshError> {
        let used = names.iter().find(|name| of["extensions"].get(*name).is_some());
        used.map_or(Ok(()), |name| Err(self.unsupported(format!("the extension {name}"))))
    }

    fn list(&self, key: &str) -> &'a [Value] {
        list(self.root, key)
    }

    /// The element of a list of the root that `of` names, and its number, if it names one.
    fn named(
        &self,
        of: &Value,
        key: &str,
        lists: &str,
        place: &str,
    ) -> Result<Option<(usize, &'a Value)>, MeshError> {
        let Some(index) = of.get(key) else { return Ok(None) };
        self.element(index, lists, place).map(Some)
    }

    fn element(
        &self,
        index: &Value,
        lists: &str,
        place: &str,
    ) -> Result<(usize, &'a Value), MeshError> {
        let number = index.as_u64().and_then(|i| usize::try_from(i).ok());
        let found = number.and_then(|i| Some((i, self.list(lists).get(i)?)));
        found.ok_or_else(|| {
            let count = self.list(lists).len();
            self.malformed(place, format!("it names {index} of {count} {lists}"))
        })
    }

    /// A whole number, 0 if it is not there.
    fn count(&self, of: &Value, key: &str, place: &str) -> Result<usize, MeshError> {
        let Some(value) = of.get(key) else { return Ok(0) };
        let count = value.as_u64().and_then(|n| usize::try_from(n).ok());
        count.ok_or_else(|| self.malformed(place, format!("{key} is no whole number")))
    }

    /// `N` numbers, if they are there.
    fn numbers<const N: usize>(
        &self,
        of: &Value,
        key: &str,
        place: &str,
    ) -> Result<Option<[f64; N]>, MeshError> {
        let Some(value) = of.get(key) else { return Ok(None) };
        let numbers: Option<Vec<f64>> =
            value.as_array().and_then(|all| all.iter().map(Value::as_f64).collect());
        let numbers = numbers.and_then(|numbers| <[f64; N]>::try_from(numbers).ok());
        let numbers =
            numbers.ok_or_else(|| self.malformed(place, format!("{key} has not {N} numbers")))?;
        Ok(Some(numbers))
    }

    /// Where a node is in its parent.
    fn placement(&self, node: &Value, place: &str) -> Result<Placement, MeshError> {
        if let Some(m) = self.numbers::<16>(node, "matrix", place)? {
            // In columns.
            return Ok(Placement::of_rows(
                [0, 1, 2].map(|i| [m[i], m[i + 4], m[i + 8], m[i + 12]]),
            ));
        }
        let translation = self.numbers(node, "translation", place)?;
        let rotation = self.numbers(node, "rotation", place)?;
        let scale = self.numbers(node, "scale", place)?;
        Ok(Placement::of_parts(
            translation.unwrap_or_default(),
            rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]),
            scale.unwrap_or([1.0; 3]),
        ))
    }
}

/// The nodes that are placed so far.
struct Scene<'a> {
    source: Source<'a>,
    copies: Copies,
    buffers: Buffers<'a>,
    is_placed: Vec<bool>,
}

impl Scene<'_> {
    /// The roots of all scenes, each once.
    fn roots(&self) -> Result<Vec<usize>, MeshError> {
        let source = self.source;
        let nodes = source.list("nodes");
        if source.list("scenes").is_empty() {
            let mut is_child = vec![false; nodes.len()];
            for child in nodes.iter().flat_map(|node| list(node, "children")) {
                is_child[source.element(child, "nodes", "a node")?.0] = true;
            }
            return Ok((0..nodes.len()).filter(|&node| !is_child[node]).collect());
        }
        let mut roots = Vec::new();
        let mut is_root = vec![false; nodes.len()];
        for (i, scene) in source.list("scenes").iter().enumerate() {
            for node in list(scene, "nodes") {
                let (node, _) = source.element(node, "nodes", &format!("scene {i}"))?;
                if !std::mem::replace(&mut is_root[node], true) {
                    roots.push(node);
                }
            }
        }
        Ok(roots)
    }

    /// Places a root and all below it.
    fn place(&mut self, root: usize) -> Result<(), MeshError> {
        let source = self.source;
        let mut open = vec![(root, Placement::IDENTITY)];
        while let Some((number, parent)) = open.pop() {
            let place = format!("node {number}");
            let node = &source.list("nodes")[number];
            if std::mem::replace(&mut self.is_placed[number], true) {
                return Err(source.malformed(&place, "it has two parents, or is its own ancestor"));
            }
            source.refuse_extension(node, &["EXT_mesh_gpu_instancing"])?;
            let placement = parent.after(&source.placement(node, &place)?);
            if let Some((mesh, value)) = source.named(node, "mesh", "meshes", &place)? {
                let has_weights = |of: &Value| {
                    list(of, "weights").iter().any(|weight| weight.as_f64() != Some(0.0))
                };
                if node.get("skin").is_some() {
                    return Err(source.unsupported(format!("the skin of {place}")));
                }
                if has_weights(node) || has_weights(value) {
                    return Err(source.unsupported(format!("the morph of {place}")));
                }
                self.add_mesh(mesh, value, &placement)?;
            }
            // The first child is placed first.
            for child in list(node, "children").iter().rev() {
                open.push((source.element(child, "nodes", &place)?.0, placement.clone()));
            }
        }
        Ok(())
    }

    fn add_mesh(
        &mut self,
        number: usize,
        mesh: &Value,
        placement: &Placement,
    ) -> Result<(), MeshError> {
        let source = self.source;
        // Primitives may share their vertices.
        let mut shared: Vec<(usize, u32, usize)> = Vec::new();
        for (i, primitive) in list(mesh, "primitives").iter().enumerate() {
            let place = format!("mesh {number}, primitive {i}");
            self.copies.count()?;
            source.refuse_extension(primitive, &["KHR_draco_mesh_compression"])?;
            let mode = match primitive.get("mode") {
                Some(mode) => mode.as_u64().unwrap_or(u64::MAX),
                None => TRIANGLES,
            };
            match mode {
                0..=3 => {
                    self.copies.raw.left_out.lines_and_points += 1;
                    continue;
                }
                TRIANGLES | STRIP | FAN => {}
                _ => return Err(source.malformed(&place, "its mode is none of 0 to 6")),
            }
            let at = source.named(&primitive["attributes"], "POSITION", "accessors", &place)?;
            let (accessor, at) = at.ok_or_else(|| source.malformed(&place, "no POSITION"))?;
            let known = shared.iter().find(|(of, ..)| *of == accessor);
            let (first, count) = match known {
                Some(&(_, first, count)) => (first, count),
                None => {
                    let positions = self.buffers.positions(accessor, at)?;
                    let first = self.copies.put(&positions, placement)?;
                    shared.push((accessor, first, positions.len()));
                    (first, positions.len())
                }
            };
            let corners = match source.named(primitive, "indices", "accessors", &place)? {
                Some((accessor, indices)) => self.buffers.indices(accessor, indices)?,
                None => (0..count as u32).collect(),
            };
            if let Some(v) = corners.iter().find(|&&v| v as usize >= count) {
                let reason = format!("its indices name vertex {v} of {count}");
                return Err(source.malformed(&place, reason));
            }
            let mut triangles = Vec::new();
            match (mode, corners.as_slice()) {
                (STRIP, corners) => {
                    self.copies.raw.left_out.stitches += strip(corners, &mut triangles);
                }
                (FAN, [first, rest @ ..]) => {
                    triangles.extend(rest.windows(2).map(|pair| [pair[0], pair[1], *first]));
                }
                (_, corners) => {
                    let (whole, rest) = corners.as_chunks::<3>();
                    if !rest.is_empty() {
                        let count = corners.len();
                        let reason = format!("{count} corners are no multiple of three");
                        return Err(source.malformed(&place, reason));
                    }
                    triangles.extend_from_slice(whole);
                }
            }
            self.copies.join(&triangles, first, placement)?;
        }
        Ok(())
    }
}

const TRIANGLES: u64 = 4;
const STRIP: u64 = 5;
const FAN: u64 = 6;

/// A list, empty if it is not there.
fn list<'a>(of: &'a Value, key: &str) -> &'a [Value] {
    of.get(key).and_then(Value::as_array).map_or(&[], Vec::as_slice)
}
