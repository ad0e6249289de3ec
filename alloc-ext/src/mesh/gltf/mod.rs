//! glTF 2.0, as text with buffers beside it or as one binary file.
//!
//! The crate `gltf` is not used: its accessors panic on damaged files, and a mesh needs ten fields
//! of its whole schema.

mod buffers;
mod source;

use rustc_hash::FxHashMap;
use serde_json::Value;
use std::path::Path;

use self::buffers::Buffers;
use self::source::{Source, list};
use super::copies::Copies;
use super::placement::Placement;
use super::strip::strip;
use super::{MeshError, RawMesh, Unit};

/// Reads the triangles of all nodes of all scenes, or of all nodes if there is no scene, each where
/// its ancestors put it; of all meshes if there is no node either. Nodes and meshes that no scene
/// reaches are counted. Points and lines are left out. Skins, morphs and compressed meshes are
/// refused by name. A quaternion that is not of length 1 within rounding is named.
pub(super) fn read(file: &Path, bytes: &[u8]) -> Result<RawMesh, MeshError> {
    let buffers::Chunks { json, binary, left_out } = buffers::split(file, bytes)?;
    // A chunk is filled with blanks. Older programs wrote zeros, and some texts begin with a mark.
    let json = json.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(json);
    let filled = json.iter().rposition(|&b| b != 0).map_or(0, |last| last + 1);
    let json = &json[..filled];
    let root: Value = serde_json::from_slice(json).map_err(|error| MeshError::Malformed {
        file: file.to_owned(),
        line: binary.is_none().then(|| error.line()),
        place: "the JSON".into(),
        reason: why_no_json(json, &error),
    })?;
    let source = Source { file, root: &root };
    source.check_version()?;
    let mut scene = Scene {
        source,
        copies: Copies::new(file, bytes.len()),
        buffers: Buffers::new(source, binary),
        is_placed: vec![false; source.list("nodes").len()],
    };
    scene.copies.raw.left_out = left_out;
    for node in scene.roots()? {
        scene.place(node)?;
    }
    scene.finish()?;
    Ok(RawMesh { unit: Some(Unit::M), ..scene.copies.raw })
}

/// Why a text is no JSON; the line is named elsewhere.
fn why_no_json(json: &[u8], error: &serde_json::Error) -> String {
    if !json.trim_ascii_start().starts_with(b"{") {
        return "it is no object of JSON".into();
    }
    if error.is_eof() {
        return "it ends early".into();
    }
    let said = error.to_string();
    let place = format!(" at line {} column {}", error.line(), error.column());
    format!("{}, column {}", said.strip_suffix(&place).unwrap_or(&said), error.column())
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

    /// Places meshes without nodes, and names nodes and meshes that are not placed.
    fn finish(&mut self) -> Result<(), MeshError> {
        let source = self.source;
        let has_scenes = !source.list("scenes").is_empty();
        let mut is_named = vec![false; source.list("meshes").len()];
        for (number, node) in source.list("nodes").iter().enumerate() {
            let place = format!("node {number}");
            if !has_scenes && !self.is_placed[number] {
                return Err(source.malformed(&place, "it is its own ancestor, or below one"));
            }
            let Some((mesh, _)) = source.named(node, "mesh", "meshes", &place)? else { continue };
            is_named[mesh] = true;
            if !self.is_placed[number] {
                let first = || format!("{place}, mesh {mesh}");
                let what = "with a mesh that no scene reaches left out";
                self.copies.raw.left_out.remark("node", what, first);
            }
        }
        let has_nodes = has_scenes || !self.is_placed.is_empty();
        for (number, mesh) in source.list("meshes").iter().enumerate() {
            if !has_nodes {
                self.add_mesh(number, mesh, &Placement::IDENTITY)?;
            } else if !is_named[number] {
                let what = "that no node places left out";
                self.copies.raw.left_out.remark("mesh", what, || format!("mesh {number}"));
            }
        }
        Ok(())
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
            let (own, length) = source.placement(node, &place)?;
            if let Some(length) = length {
                let what = "of a length other than 1, used as written";
                let first = || format!("{place}, {length:.6}");
                self.copies.raw.left_out.remark("quaternion", what, first);
            }
            let placement = parent.after(&own);
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
        let mut shared: FxHashMap<usize, (u32, usize)> = FxHashMap::default();
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
            let (first, count) = match shared.get(&accessor) {
                Some(&known) => known,
                None => {
                    let positions = self.buffers.positions(accessor, at)?;
                    let first = self.copies.put(&positions, placement)?;
                    shared.insert(accessor, (first, positions.len()));
                    (first, positions.len())
                }
            };
            let corners = match source.named(primitive, "indices", "accessors", &place)? {
                Some((accessor, indices)) => self.buffers.indices(accessor, indices)?,
                None => (0..count as u32).collect(),
            };
            self.copies.count_corners(corners.len())?;
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
