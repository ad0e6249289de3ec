//! The XML of a model: objects and the build.

use quick_xml::events::{BytesStart, Event};
use quick_xml::name::{Namespace, ResolveResult};
use rustc_hash::FxHashMap;

use super::super::placement::Placement;
use super::super::xml::{ENDS_EARLY, why};
use super::super::{MeshError, Unit};
use super::package::{Package, attribute, prefixed, relative};

const CORE: Namespace<'_> = Namespace("http://schemas.microsoft.com/3dmanufacturing/core/2015/02");

/// Namespaces of extensions that a model may require: they change no triangle, or are read.
const KNOWN: [&str; 3] = [
    "http://schemas.microsoft.com/3dmanufacturing/production/2015/06",
    "http://schemas.microsoft.com/3dmanufacturing/material/2015/02",
    "http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07",
];

#[derive(Default)]
pub(super) struct Object {
    pub(super) positions: Vec<[f64; 3]>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) components: Vec<Part>,
    /// What it is, if it is no solid and no surface, as `support`.
    pub(super) other: Option<String>,
    has_mesh: bool,
}

impl Object {
    /// Whether it has neither mesh nor components.
    pub(super) fn is_empty(&self) -> bool {
        !self.has_mesh && self.components.is_empty()
    }
}

/// An object, put in place.
pub(super) struct Part {
    /// The file of the object's model. `None`: the file that names the object.
    pub(super) path: Option<String>,
    pub(super) object: u32,
    pub(super) placement: Placement,
    /// Of an item: whether it is to be printed.
    pub(super) is_printed: bool,
}

pub(super) struct Model {
    pub(super) unit: Unit,
    /// Whether the model names its unit.
    pub(super) names_unit: bool,
    pub(super) objects: FxHashMap<u32, Object>,
    /// Of the build.
    pub(super) items: Vec<Part>,
}

impl Model {
    /// Other models that are named.
    pub(super) fn paths(&self) -> impl Iterator<Item = &str> {
        let components = self.objects.values().flat_map(|object| &object.components);
        components.chain(&self.items).filter_map(|part| part.path.as_deref())
    }
}

/// Why a model is refused.
enum Refused {
    Malformed(String),
    Unsupported(String),
}

impl From<String> for Refused {
    fn from(reason: String) -> Self {
        Self::Malformed(reason)
    }
}

/// Reads one model of the archive.
pub(super) fn read(package: &Package<'_>, path: &str) -> Result<Model, MeshError> {
    let (unit, objects, items) = (Unit::Mm, FxHashMap::default(), Vec::new());
    let model = Model { unit, names_unit: false, objects, items };
    let mut reading = Reading { package, model, object: None, role: None, is_complete: false };
    let mut reader = package.part(path)?;
    let mut bytes = Vec::new();
    loop {
        bytes.clear();
        let event = reader.read_resolved_event_into(&mut bytes);
        let done = match event {
            Ok((_, Event::Eof)) if reading.is_complete => return Ok(reading.model),
            Ok((_, Event::Eof)) => Err(ENDS_EARLY.to_owned().into()),
            Ok((space, event)) => reading.event(space == ResolveResult::Bound(CORE), &event),
            Err(error) => Err(why(&error).into()),
        };
        done.map_err(|refused| match (refused, reading.place(path)) {
            (Refused::Malformed(reason), place) => package.malformed(&place, reason),
            (Refused::Unsupported(what), place) => MeshError::Unsupported {
                file: package.file.to_owned(),
                what: format!("{what} of {place}"),
            },
        })?;
    }
}

/// A model as far as it is read.
struct Reading<'a> {
    package: &'a Package<'a>,
    model: Model,
    /// The object that is open, and its number.
    object: Option<(u32, Object)>,
    /// What the object that is open is, if the text that follows says so.
    role: Option<&'static str>,
    /// Its last tag was there.
    is_complete: bool,
}

impl Reading<'_> {
    /// How far it is read.
    fn place(&self, path: &str) -> String {
        let Some((id, Object { positions, triangles, .. })) = &self.object else {
            return path.to_owned();
        };
        let (vertices, triangles) = (positions.len(), triangles.len());
        format!("{path}, object {id} after {vertices} vertices and {triangles} triangles")
    }

    fn event(&mut self, is_core: bool, event: &Event<'_>) -> Result<(), Refused> {
        match event {
            Event::Start(tag) => self.element(is_core, tag, false),
            Event::Empty(tag) => self.element(is_core, tag, true),
            Event::Text(text) => {
                if let (Some(role), Some((_, object))) = (self.role.take(), &mut self.object)
                    && text.trim_ascii().eq_ignore_ascii_case("true")
                {
                    object.other = Some(role.to_owned());
                }
                Ok(())
            }
            Event::End(tag) if is_core => {
                self.role = None;
                match tag.local_name().as_ref() {
                    "object" => self.model.objects.extend(self.object.take()),
                    "model" => self.is_complete = true,
                    _ => {}
                }
                Ok(())
            }
            _ => Ok(()),
        }
    }

    fn element(&mut self, is_core: bool, tag: &BytesStart, is_empty: bool) -> Result<(), Refused> {
        let name = tag.local_name();
        let name = name.as_ref();
        if !is_core {
            return match name {
                // Its beams are a part of the object's shape.
                "beamlattice" => Err(Refused::Unsupported("the beam lattice".into())),
                "model" => Err("it is not in the namespace of 3MF".to_owned().into()),
                _ => Ok(()),
            };
        }
        if matches!(name, "object" | "component" | "item") {
            self.package.count()?;
        }
        match (name, &mut self.object) {
            ("model", _) => {
                self.model.unit = unit(tag)?;
                self.model.names_unit = attribute(tag, "unit")?.is_some();
                check_extensions(tag)?;
            }
            ("object", None) => {
                let id = number(tag, "id")?;
                if self.model.objects.contains_key(&id) {
                    return Err(format!("object {id} is there twice").into());
                }
                let kind = attribute(tag, "type")?;
                let other = kind.filter(|kind| !matches!(kind.as_str(), "model" | "surface" | ""));
                self.object = Some((id, Object { other, ..Object::default() }));
                if is_empty {
                    self.model.objects.extend(self.object.take());
                }
            }
            ("object", Some(_)) => return Err("an object is in another".to_owned().into()),
            ("mesh", Some((_, object))) => object.has_mesh = true,
            ("metadata", Some(_)) => self.role = role(tag)?,
            ("vertex", Some((_, object))) => object.positions.push(vertex(tag)?),
            ("triangle", Some((_, object))) => {
                object.triangles.push(triangle(tag, object.positions.len())?);
            }
            ("component", Some((_, object))) => object.components.push(part(tag)?),
            ("item", None) => self.model.items.push(part(tag)?),
            _ => {}
        }
        Ok(())
    }
}

/// What Cura's metadata of an object say that it is, if they are true.
fn role(tag: &BytesStart) -> Result<Option<&'static str>, String> {
    let name = attribute(tag, "name")?.unwrap_or_default();
    let roles = ["support_mesh", "anti_overhang_mesh", "cutting_mesh", "infill_mesh"];
    Ok(roles.into_iter().find(|role| name.rsplit(':').next() == Some(role)))
}

fn wanted(tag: &BytesStart, name: &str) -> Result<String, String> {
    attribute(tag, name)?.ok_or_else(|| format!("{} has no {name}", tag.local_name().as_ref()))
}

/// A whole number.
fn number(tag: &BytesStart, name: &str) -> Result<u32, String> {
    let value = wanted(tag, name)?;
    value.trim().parse().map_err(|_| format!("{name} {value:?} is no number"))
}

fn vertex(tag: &BytesStart) -> Result<[f64; 3], String> {
    let mut at = [0.0; 3];
    for (x, name) in at.iter_mut().zip(["x", "y", "z"]) {
        let value = wanted(tag, name)?;
        let number = value.trim().parse().ok().filter(|x: &f64| x.is_finite());
        *x = number.ok_or_else(|| format!("{name} {value:?} is no finite number"))?;
    }
    Ok(at)
}

fn triangle(tag: &BytesStart, vertices: usize) -> Result<[u32; 3], String> {
    let mut corners = [0; 3];
    for (corner, name) in corners.iter_mut().zip(["v1", "v2", "v3"]) {
        *corner = number(tag, name)?;
        if *corner as usize >= vertices {
            return Err(format!("the triangle names vertex {corner}"));
        }
    }
    Ok(corners)
}

fn part(tag: &BytesStart) -> Result<Part, String> {
    let placement = match attribute(tag, "transform")? {
        None => Placement::IDENTITY,
        Some(text) => {
            let numbers: Option<Vec<f64>> = text
                .split_ascii_whitespace()
                .map(|word| word.parse().ok().filter(|x: &f64| x.is_finite()))
                .collect();
            let m = numbers.and_then(|numbers| <[f64; 12]>::try_from(numbers).ok());
            let m = m.ok_or_else(|| format!("transform {text:?} has not 12 numbers"))?;
            // In rows, for points that stand before the matrix.
            Placement::of_rows([0, 1, 2].map(|i| [m[i], m[i + 3], m[i + 6], m[i + 9]]))
        }
    };
    let path = prefixed(tag, "path")?.map(|path| relative(&path));
    // Of slicers, which give it no namespace.
    let printable = attribute(tag, "printable")?.or(prefixed(tag, "printable")?);
    let is_printed = !printable.is_some_and(|it| matches!(it.trim(), "0" | "false"));
    Ok(Part { path, object: number(tag, "objectid")?, placement, is_printed })
}

fn unit(tag: &BytesStart) -> Result<Unit, String> {
    match attribute(tag, "unit")?.as_deref() {
        None | Some("millimeter") => Ok(Unit::Mm),
        Some("micron") => Ok(Unit::Um),
        Some("centimeter") => Ok(Unit::Cm),
        Some("inch") => Ok(Unit::In),
        Some("foot") => Ok(Unit::Ft),
        Some("meter") => Ok(Unit::M),
        Some(other) => Err(format!("{other:?} is no unit of 3MF")),
    }
}

/// Refuses models that require an extension which is not read.
fn check_extensions(tag: &BytesStart) -> Result<(), Refused> {
    let required = attribute(tag, "requiredextensions")?.unwrap_or_default();
    for prefix in required.split_ascii_whitespace() {
        let space = wanted(tag, &format!("xmlns:{prefix}"))?;
        if !KNOWN.contains(&space.as_str()) {
            return Err(Refused::Unsupported(format!("the extension {space}")));
        }
    }
    Ok(())
}
