//! 3MF: a ZIP archive of XML.
//!
//! The archive and the XML are read by crates. The model is read here: crates for it do not bound
//! what an archive expands to, and name no triangle in their errors.

mod model;
mod package;

use rustc_hash::FxHashMap;
use std::path::Path;

use self::model::{Model, Part};
use self::package::Package;
use super::copies::Copies;
use super::placement::Placement;
use super::{MeshError, RawMesh};

/// Reads the objects that the build lists, each where its item and its components put it. Parts
/// that name other files of the archive are followed.
pub(super) fn read(file: &Path, bytes: &[u8]) -> Result<RawMesh, MeshError> {
    let package = Package::open(file, bytes)?;
    let root = package.root()?;
    let mut models: FxHashMap<String, Model> = FxHashMap::default();
    let mut wanted = vec![root.clone()];
    while let Some(path) = wanted.pop() {
        if models.contains_key(&path) {
            continue;
        }
        let model = model::read(&package, &path)?;
        wanted.extend(model.paths().map(str::to_owned));
        models.insert(path, model);
    }
    let unit = models[&root].unit;
    if let Some((path, _)) = models.iter().find(|(_, model)| model.unit != unit) {
        return Err(package.malformed(path, "its unit is not that of the first model"));
    }
    if models[&root].items.is_empty() {
        return Err(package.malformed(&root, "the build lists no item"));
    }
    let mut copies = Copies::new(file, bytes.len());
    let all: usize = models.values().map(|model| model.objects.len()).sum();
    for (i, item) in models[&root].items.iter().enumerate() {
        let place = format!("item {i} of the build");
        // Depth, to notice components that contain themselves.
        let mut open: Vec<(&str, &Part, Placement, usize)> =
            vec![(&root, item, Placement::IDENTITY, 0)];
        while let Some((path, part, parent, depth)) = open.pop() {
            copies.count()?;
            let path = part.path.as_deref().unwrap_or(path);
            let object = models.get(path).and_then(|model| model.objects.get(&part.object));
            let object = object.ok_or_else(|| {
                package.malformed(&place, format!("{path} has no object {}", part.object))
            })?;
            if depth > all {
                return Err(package.malformed(&place, "an object contains itself"));
            }
            let placement = parent.after(&part.placement);
            if object.is_empty() {
                let what = format!("{path}, object {}, without mesh and components,", part.object);
                return Err(MeshError::Unsupported { file: file.to_owned(), what });
            }
            let first = copies.put(&object.positions, &placement)?;
            copies.join(&object.triangles, first, &placement)?;
            // The first component is placed first.
            let components = object.components.iter().rev();
            open.extend(components.map(|part| (path, part, placement.clone(), depth + 1)));
        }
    }
    let unit_by_default = !models[&root].names_unit;
    Ok(RawMesh { unit: Some(unit), unit_by_default, decimal: true, ..copies.raw })
}
