//! The archive: parts by their names.

use flate2::bufread::DeflateDecoder;
use quick_xml::XmlVersion;
use quick_xml::events::{BytesStart, Event};
use quick_xml::name::QName;
use quick_xml::reader::NsReader;
use rawzip::{CompressionMethod, ZipArchive, ZipArchiveEntryWayfinder, ZipSliceArchive};
use rustc_hash::FxHashMap;
use std::cell::Cell;
use std::fmt::Display;
use std::io::{self, BufRead, BufReader, Read};
use std::path::Path;

use super::super::MeshError;
use super::super::text::{decoded, is_utf_16};
use super::super::xml::why;

/// Bytes that parts may have for each byte of the file. Text of triangles has a fraction of it.
const MOST_EXPANSION: u64 = 128;

/// Bytes of the file for each object, component or item, where it has more than these. One takes
/// 256 in memory, and in a file without those that say the same again a dozen.
const BYTES_OF_PART: usize = 4;
const LEAST_PARTS: usize = 1 << 16;

/// The relationship of a package to its first model.
const MODEL: &str = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";

pub(super) struct Package<'a> {
    pub(super) file: &'a Path,
    archive: ZipSliceArchive<&'a [u8]>,
    entries: FxHashMap<String, (ZipArchiveEntryWayfinder, CompressionMethod)>,
    /// Bytes that parts may still have.
    left: Cell<u64>,
    /// Objects, components and items that may still follow.
    parts_left: Cell<usize>,
}

impl<'a> Package<'a> {
    pub(super) fn open(file: &'a Path, bytes: &'a [u8]) -> Result<Self, MeshError> {
        let refuse = |error: rawzip::Error| malformed(file, "the archive", error);
        let archive = ZipArchive::from_slice(bytes).map_err(|error| {
            if bytes.starts_with(b"PK") {
                return refuse(error);
            }
            malformed(file, "the archive", "it is no ZIP archive")
        })?;
        let mut found = FxHashMap::default();
        let mut entries = archive.entries();
        while let Some(entry) = entries.next_entry().map_err(refuse)? {
            let Ok(name) = std::str::from_utf8(entry.file_path().as_bytes()) else { continue };
            if entry.flags().is_encrypted() {
                let what = format!("{name}, which is encrypted,");
                return Err(MeshError::Unsupported { file: file.to_owned(), what });
            }
            found.insert(key(name), (entry.wayfinder(), entry.compression_method()));
        }
        let left = Cell::new((bytes.len() as u64).saturating_mul(MOST_EXPANSION).max(1 << 16));
        let parts_left = Cell::new((bytes.len() / BYTES_OF_PART).max(LEAST_PARTS));
        Ok(Self { file, archive, entries: found, left, parts_left })
    }

    pub(super) fn malformed(&self, place: &str, reason: impl Display) -> MeshError {
        malformed(self.file, place, reason)
    }

    /// The XML of a part.
    pub(super) fn part(&self, path: &str) -> Result<NsReader<Box<dyn BufRead + '_>>, MeshError> {
        let refuse = |error: rawzip::Error| self.malformed(path, error);
        let found = self.entries.get(&key(path));
        let &(at, method) = found.ok_or_else(|| self.malformed(path, "not in the archive"))?;
        let entry = self.archive.get_entry(at).map_err(refuse)?;
        let content: Box<dyn Read + '_> = match method {
            CompressionMethod::STORE => Box::new(entry.data()),
            CompressionMethod::DEFLATE => Box::new(DeflateDecoder::new(entry.data())),
            _ => {
                let what = format!("{path}, compressed by method {},", method.as_u16());
                return Err(MeshError::Unsupported { file: self.file.to_owned(), what });
            }
        };
        let content = Limited { content: entry.verifying_reader(content), left: &self.left };
        let mut content = BufReader::new(content);
        let refuse = |error: io::Error| self.malformed(path, error);
        if !is_utf_16(content.fill_buf().map_err(refuse)?) {
            return Ok(NsReader::from_reader(Box::new(content) as Box<dyn BufRead + '_>));
        }
        let mut bytes = Vec::new();
        content.read_to_end(&mut bytes).map_err(refuse)?;
        let text = io::Cursor::new(decoded(&bytes).into_owned());
        Ok(NsReader::from_reader(Box::new(text)))
    }

    /// The paths of files in which slicers say what the parts of objects are.
    pub(super) fn settings(&self) -> Vec<String> {
        let is_it = |path: &&String| {
            let name = path.strip_prefix("metadata/");
            name.is_some_and(|name| {
                name.ends_with("model.config") || name == "model_settings.config"
            })
        };
        let mut paths: Vec<String> = self.entries.keys().filter(is_it).cloned().collect();
        paths.sort_unstable();
        paths
    }

    /// Counts an object, a component or an item: in memory each is many times its text.
    pub(super) fn count(&self) -> Result<(), String> {
        let left = self.parts_left.get().checked_sub(1);
        self.parts_left.set(left.ok_or("more objects, components and items than are read")?);
        Ok(())
    }

    /// The path of the first model.
    pub(super) fn root(&self) -> Result<String, MeshError> {
        let place = "_rels/.rels";
        let mut reader = self.part(place)?;
        let mut bytes = Vec::new();
        loop {
            bytes.clear();
            let event = reader.read_event_into(&mut bytes);
            match event.map_err(|error| self.malformed(place, why(&error)))? {
                Event::Start(tag) | Event::Empty(tag)
                    if tag.local_name().as_ref() == "Relationship" =>
                {
                    let get = |name| attribute(&tag, name).map_err(|e| self.malformed(place, e));
                    if get("Type")?.as_deref() == Some(MODEL) {
                        let target = get("Target")?;
                        let target = target.ok_or_else(|| self.malformed(place, "no Target"))?;
                        return Ok(relative(&target));
                    }
                }
                Event::Eof => return Err(self.malformed(place, "it names no model")),
                _ => {}
            }
        }
    }
}

fn malformed(file: &Path, place: &str, reason: impl Display) -> MeshError {
    MeshError::Malformed {
        file: file.to_owned(),
        line: None,
        place: place.to_owned(),
        reason: reason.to_string(),
    }
}

/// An attribute by its name. One with a prefix is of an extension, whatever its name.
pub(super) fn attribute(tag: &BytesStart, name: &str) -> Result<Option<String>, String> {
    find(tag, |key| key.as_ref() == name)
}

/// An attribute of an extension, by its name without prefix.
pub(super) fn prefixed(tag: &BytesStart, name: &str) -> Result<Option<String>, String> {
    find(tag, |key| key.prefix().is_some() && key.local_name().as_ref() == name)
}

fn find(tag: &BytesStart, is_it: impl Fn(QName<'_>) -> bool) -> Result<Option<String>, String> {
    for attribute in tag.attributes() {
        let attribute = attribute.map_err(|error| error.to_string())?;
        if is_it(attribute.key) {
            let value = attribute.normalized_value(XmlVersion::Implicit1_0);
            return value.map(|value| Some(value.into_owned())).map_err(|e| e.to_string());
        }
    }
    Ok(None)
}

/// The path of a part as one from the root of the archive.
pub(super) fn relative(path: &str) -> String {
    path.trim_start_matches('/').to_owned()
}

/// Names of parts differ in more than the case of their letters.
fn key(path: &str) -> String {
    path.to_ascii_lowercase()
}

/// A part, as long as the archive may expand.
struct Limited<'a, R> {
    content: R,
    left: &'a Cell<u64>,
}

impl<R: Read> Read for Limited<'_, R> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let read = self.content.read(into)?;
        match self.left.get().checked_sub(read as u64) {
            Some(left) => self.left.set(left),
            None => {
                let what = format!("the archive expands more than {MOST_EXPANSION} times");
                return Err(io::Error::other(what));
            }
        }
        Ok(read)
    }
}
