//! 3MF: a ZIP archive of XML.
//!
//! The archive and the XML are read by crates. The model is read here: crates for it do not bound
//! what an archive expands to, and name no triangle in their errors.

mod model;
mod package;
mod settings;

use rustc_hash::{FxHashMap, FxHashSet};
use std::path::Path;

use self::model::{Model, Part};
use self::package::Package;
use self::settings::Settings;
use super::copies::Copies;
use super::placement::Placement;
use super::text::quoted;
use super::{MeshError, RawMesh};

/// Reads the objects that the build lists, each where its item and its components put it. Parts
/// that name other files of the archive are followed. Supports, items that are not to be printed,
/// negative parts, modifiers and objects that no item builds are left out and counted.
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
    let settings = Settings::read(&package)?;
    let mut copies = Copies::new(file, bytes.len());
    let all: usize = models.values().map(|model| model.objects.len()).sum();
    for (i, item) in models[&root].items.iter().enumerate() {
        let place = format!("item {i} of the build");
        if !item.is_printed {
            let what = "not to be printed left out";
            copies.raw.left_out.remark("item", what, || format!("{place}, object {}", item.object));
            continue;
        }
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
            let name = || format!("{place}, {path}, object {}", part.object);
            if let Some(kind) = &object.other {
                copies.raw.left_out.remark("object", &left_out(kind), name);
                continue;
            }
            let placement = parent.after(&part.placement);
            if object.is_empty() {
                let what = format!("{path}, object {}, without mesh and components,", part.object);
                return Err(MeshError::Unsupported { file: file.to_owned(), what });
            }
            let others = if path == root { settings.ranges(part.object) } else { &[] };
            let is_other = |t: usize| others.iter().any(|(range, _)| range.contains(&t));
            for (range, kind) in others {
                let (first, last) = range.clone().into_inner();
                let name = || format!("{}, triangles {first} to {last}", name());
                if range.is_empty() || last >= object.triangles.len() {
                    let count = object.triangles.len();
                    return Err(package.malformed(&name(), format!("it has {count} triangles")));
                }
                copies.raw.left_out.remark("part", &left_out(kind), name);
            }
            let triangles: Vec<[u32; 3]> = object
                .triangles
                .iter()
                .enumerate()
                .filter_map(|(t, triangle)| (!is_other(t)).then_some(*triangle))
                .collect();
            let first = copies.put(&object.positions, &placement)?;
            copies.join(&triangles, first, &placement)?;
            // The first component is placed first.
            for component in object.components.iter().rev() {
                let kind = settings.component(part.object, component.object);
                match kind.filter(|_| path == root) {
                    Some(kind) => {
                        let name = || format!("{}, component {}", name(), component.object);
                        copies.raw.left_out.remark("part", &left_out(kind), name);
                    }
                    None => open.push((path, component, placement.clone(), depth + 1)),
                }
            }
        }
    }
    for (path, object) in not_built(&models, &root) {
        let what = "that no item builds left out";
        copies.raw.left_out.remark("object", what, || format!("{path}, object {object}"));
    }
    let unit_by_default = !models[&root].names_unit;
    Ok(RawMesh { unit: Some(unit), unit_by_default, decimal: true, ..copies.raw })
}

/// The objects that no item of the build reaches, printed or not.
fn not_built<'a>(models: &'a FxHashMap<String, Model>, root: &'a str) -> Vec<(&'a str, u32)> {
    let mut reached: FxHashSet<(&str, u32)> = FxHashSet::default();
    let mut open: Vec<(&str, &Part)> = models[root].items.iter().map(|item| (root, item)).collect();
    while let Some((path, part)) = open.pop() {
        let path = part.path.as_deref().unwrap_or(path);
        if reached.insert((path, part.object))
            && let Some(object) = models.get(path).and_then(|model| model.objects.get(&part.object))
        {
            open.extend(object.components.iter().map(|component| (path, component)));
        }
    }
    let all = models.iter().flat_map(|(path, model)| model.objects.keys().map(|id| (&**path, *id)));
    let mut others: Vec<_> = all.filter(|object| !reached.contains(object)).collect();
    others.sort_unstable();
    others
}

/// What a remark says of a part that is neither solid nor surface.
fn left_out(kind: &str) -> String {
    format!("of type {} left out", quoted(kind))
}
