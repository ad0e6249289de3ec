//! What slicers write about the parts of objects, beside the model: which are no part of the solid.
//!
//! PrusaSlicer and SuperSlicer name ranges of an object's triangles in
//! `Metadata/Slic3r_PE_model.config`, Bambu Studio and OrcaSlicer components of an object in
//! `Metadata/model_settings.config`.

use quick_xml::events::{BytesStart, Event};
use rustc_hash::FxHashMap;
use std::ops::RangeInclusive;

use super::super::MeshError;
use super::super::xml::why;
use super::package::{Package, attribute};

#[derive(Default)]
pub(super) struct Settings {
    /// Of an object of the first model, triangles that are none of its surface, and what they are.
    ranges: FxHashMap<u32, Vec<(RangeInclusive<usize>, String)>>,
    /// Of an object and one of its components, what it is.
    components: FxHashMap<(u32, u32), String>,
}

impl Settings {
    pub(super) fn read(package: &Package<'_>) -> Result<Self, MeshError> {
        let mut settings = Self::default();
        for path in package.settings() {
            let mut reader = package.part(&path)?;
            let (mut object, mut volume) = (None, None);
            let mut bytes = Vec::new();
            loop {
                bytes.clear();
                let event = reader.read_event_into(&mut bytes);
                let done = match event.map_err(|error| package.malformed(&path, why(&error)))? {
                    Event::Start(tag) | Event::Empty(tag) => {
                        settings.element(&tag, &mut object, &mut volume)
                    }
                    Event::Eof => break,
                    _ => Ok(()),
                };
                done.map_err(|reason| package.malformed(&path, reason))?;
            }
        }
        Ok(settings)
    }

    fn element(
        &mut self,
        tag: &BytesStart<'_>,
        object: &mut Option<u32>,
        volume: &mut Option<RangeInclusive<usize>>,
    ) -> Result<(), String> {
        let number = |name: &str| -> Result<Option<usize>, String> {
            Ok(attribute(tag, name)?.and_then(|value| value.trim().parse().ok()))
        };
        match (tag.local_name().as_ref(), *object) {
            ("object", _) => {
                (*object, *volume) = (number("id")?.and_then(|id| u32::try_from(id).ok()), None);
            }
            ("volume", _) => {
                let range = number("firstid")?.zip(number("lastid")?);
                *volume = range.map(|(first, last)| first..=last);
            }
            ("metadata", Some(object)) => {
                let (key, value) = (attribute(tag, "key")?, attribute(tag, "value")?);
                let Some((range, value)) = volume.clone().zip(value) else { return Ok(()) };
                let kind = match key.as_deref() {
                    Some("volume_type") if value != "ModelPart" => value,
                    // As it was written once.
                    Some("modifier") if value == "1" => "ParameterModifier".to_owned(),
                    _ => return Ok(()),
                };
                let ranges = self.ranges.entry(object).or_default();
                if ranges.iter().all(|(other, _)| *other != range) {
                    ranges.push((range, kind));
                }
            }
            ("part", Some(object)) => {
                let part = number("id")?.and_then(|id| u32::try_from(id).ok());
                let kind = attribute(tag, "subtype")?.filter(|kind| kind != "normal_part");
                self.components.extend(part.zip(kind).map(|(part, kind)| ((object, part), kind)));
            }
            _ => {}
        }
        Ok(())
    }

    /// Triangles of an object that are none of its surface, and what they are.
    pub(super) fn ranges(&self, object: u32) -> &[(RangeInclusive<usize>, String)] {
        self.ranges.get(&object).map_or(&[], Vec::as_slice)
    }

    /// What a component of an object is, if it is no part of its solid.
    pub(super) fn component(&self, object: u32, component: u32) -> Option<&str> {
        self.components.get(&(object, component)).map(String::as_str)
    }
}
