//! The JSON of a glTF file, with names for what is missing.

use serde_json::Value;
use std::path::Path;

use super::super::MeshError;
use super::super::placement::Placement;

/// Extensions that a file may require: they change no triangle, or are read.
const HARMLESS: [&str; 6] = [
    "KHR_mesh_quantization",
    "KHR_texture_",
    "KHR_materials_",
    "KHR_lights_punctual",
    "EXT_texture_",
    "MSFT_texture_dds",
];

/// How far the last row of an affine matrix may be off, where a program multiplied matrices.
const NOISE: f64 = 1e-6;

/// How far a quaternion's length may be off 1: as far as two decimals put it.
const LENGTH_OFF: f64 = 0.005;
/// How far single precision puts it.
const LENGTH_NOISE: f64 = 1e-6;

/// The file's JSON.
#[derive(Clone, Copy)]
pub(super) struct Source<'a> {
    pub(super) file: &'a Path,
    pub(super) root: &'a Value,
}

impl<'a> Source<'a> {
    pub(super) fn malformed(&self, place: &str, reason: impl Into<String>) -> MeshError {
        let (place, reason) = (place.into(), reason.into());
        MeshError::Malformed { file: self.file.to_owned(), line: None, place, reason }
    }

    pub(super) fn unsupported(&self, what: String) -> MeshError {
        MeshError::Unsupported { file: self.file.to_owned(), what }
    }

    pub(super) fn check_version(&self) -> Result<(), MeshError> {
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
    pub(super) fn refuse_extension(&self, of: &Value, names: &[&str]) -> Result<(), MeshError> {
        let used = names.iter().find(|name| of["extensions"].get(*name).is_some());
        used.map_or(Ok(()), |name| Err(self.unsupported(format!("the extension {name}"))))
    }

    pub(super) fn list(&self, key: &str) -> &'a [Value] {
        list(self.root, key)
    }

    /// The element of a list of the root that `of` names, and its number, if it names one.
    pub(super) fn named(
        &self,
        of: &Value,
        key: &str,
        lists: &str,
        place: &str,
    ) -> Result<Option<(usize, &'a Value)>, MeshError> {
        let Some(index) = of.get(key) else { return Ok(None) };
        self.element(index, lists, place).map(Some)
    }

    pub(super) fn element(
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
    pub(super) fn count(&self, of: &Value, key: &str, place: &str) -> Result<usize, MeshError> {
        let Some(value) = of.get(key) else { return Ok(0) };
        let count = value.as_u64().and_then(|n| usize::try_from(n).ok());
        count.ok_or_else(|| self.malformed(place, format!("{key} is no whole number")))
    }

    /// `N` numbers, if they are there.
    pub(super) fn numbers<const N: usize>(
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

    /// Where a node is in its parent, and the length of its quaternion if that is not 1.
    pub(super) fn placement(
        &self,
        node: &Value,
        place: &str,
    ) -> Result<(Placement, Option<f64>), MeshError> {
        if let Some(m) = self.numbers::<16>(node, "matrix", place)? {
            let last = [m[3], m[7], m[11], m[15] - 1.0];
            if last.iter().any(|x| x.abs() > NOISE) {
                return Err(self.malformed(place, "the last row of its matrix is not 0 0 0 1"));
            }
            // In columns.
            let rows = [0, 1, 2].map(|i| [m[i], m[i + 4], m[i + 8], m[i + 12]]);
            return Ok((Placement::of_rows(rows), None));
        }
        let translation = self.numbers(node, "translation", place)?;
        let rotation: Option<[f64; 4]> = self.numbers(node, "rotation", place)?;
        let length = rotation.map_or(1.0, |q| q.iter().map(|x| x * x).sum::<f64>().sqrt());
        if (length - 1.0).abs() > LENGTH_OFF {
            let reason = format!("its rotation is no unit quaternion, its length is {length:.6}");
            return Err(self.malformed(place, reason));
        }
        let is_rounded = (length - 1.0).abs() > LENGTH_NOISE;
        let scale = self.numbers(node, "scale", place)?;
        let placement = Placement::of_parts(
            translation.unwrap_or_default(),
            rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]),
            scale.unwrap_or([1.0; 3]),
        );
        Ok((placement, is_rounded.then_some(length)))
    }
}

/// A list, empty if it is not there.
pub(super) fn list<'a>(of: &'a Value, key: &str) -> &'a [Value] {
    of.get(key).and_then(Value::as_array).map_or(&[], Vec::as_slice)
}
