//! The numbers behind glTF's accessors.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use rustc_hash::FxHashMap;
use serde_json::Value;
use std::path::{Component, Path};
use std::rc::Rc;

use super::super::{LeftOut, MeshError};
use super::source::Source;

const MAGIC: &[u8] = b"glTF";

/// The parts of a file.
pub(super) struct Chunks<'a> {
    pub(super) json: &'a [u8],
    /// Of a binary file; nothing if it has none.
    pub(super) binary: Option<&'a [u8]>,
    /// Bytes after the end, and a length in the header that is not the file's.
    pub(super) left_out: LeftOut,
}

/// The JSON of a file, and the binary chunk if the file is binary and has one.
pub(super) fn split<'a>(file: &Path, bytes: &'a [u8]) -> Result<Chunks<'a>, MeshError> {
    let malformed = |reason: &str| MeshError::Malformed {
        file: file.to_owned(),
        line: None,
        place: "the header".into(),
        reason: reason.into(),
    };
    let Some(after_magic) = bytes.strip_prefix(MAGIC) else {
        return Ok(Chunks { json: bytes, binary: None, left_out: LeftOut::default() });
    };
    let Some((version, rest)) = word(after_magic) else {
        return Err(malformed("it ends early"));
    };
    if version != 2 {
        let what = format!("binary glTF {version}");
        return Err(MeshError::Unsupported { file: file.to_owned(), what });
    }
    let Some((length, mut rest)) = word(rest) else {
        return Err(malformed("it ends early"));
    };
    let mut chunk = |kind: &[u8; 4]| -> Result<Option<&'a [u8]>, MeshError> {
        // Some old programs did not fill chunks to a multiple of four bytes, or the next one begins
        // behind the filling that they did not count.
        let filling = (0..4).find(|&skipped| {
            let head = rest.get(skipped..).and_then(word);
            head.is_some_and(|(_, after)| after.starts_with(kind))
        });
        let Some((size, after)) = filling.and_then(|skipped| word(&rest[skipped..])) else {
            return Ok(None);
        };
        let Some((content, after)) = after[kind.len()..].split_at_checked(size) else {
            return Err(MeshError::Truncated {
                file: file.to_owned(),
                what: "byte".into(),
                wanted: size as u64,
                found: (after.len() - kind.len()) as u64,
            });
        };
        rest = after;
        Ok(Some(content))
    };
    let json = chunk(b"JSON")?.ok_or_else(|| malformed("no chunk of JSON"))?;
    let binary = chunk(b"BIN\0")?;
    if binary.is_none() && bytes.len() < length {
        return Err(MeshError::Truncated {
            file: file.to_owned(),
            what: "byte".into(),
            wanted: length as u64,
            found: bytes.len() as u64,
        });
    }
    let mut left_out = LeftOut::default();
    let end = bytes.len() - rest.len();
    if length < end || length > bytes.len() {
        let first = || format!("{length}, and the file has {} bytes", bytes.len());
        left_out.remark("length", "in the header that is not the file's", first);
    }
    // Chunks of other kinds may follow.
    left_out.bytes_after_end = bytes.len().saturating_sub(length.max(end));
    Ok(Chunks { json, binary: Some(binary.unwrap_or_default()), left_out })
}

fn word(bytes: &[u8]) -> Option<(usize, &[u8])> {
    let (word, rest) = bytes.split_first_chunk::<4>()?;
    Some((usize::try_from(u32::from_le_bytes(*word)).ok()?, rest))
}

/// The file's buffers, each read when it is wanted.
pub(super) struct Buffers<'a> {
    source: Source<'a>,
    binary: Option<&'a [u8]>,
    /// By the number of a buffer in the text, else by the name of the file, which several may
    /// share.
    read: FxHashMap<(Option<usize>, &'a str), Rc<Vec<u8>>>,
}

/// Most elements of a sparse accessor that begins with zeros: no bytes of the file bound them.
const MOST_ZEROS: usize = 1 << 24;

/// Types of components.
const I8: u64 = 5120;
const U8: u64 = 5121;
const I16: u64 = 5122;
const U16: u64 = 5123;
const U32: u64 = 5125;
const F32: u64 = 5126;

impl<'a> Buffers<'a> {
    pub(super) fn new(source: Source<'a>, binary: Option<&'a [u8]>) -> Self {
        Self { source, binary, read: FxHashMap::default() }
    }

    /// Positions of vertices.
    pub(super) fn positions(
        &mut self,
        number: usize,
        accessor: &'a Value,
    ) -> Result<Vec<[f64; 3]>, MeshError> {
        let place = format!("accessor {number}");
        let kind = self.kind(accessor, "VEC3", &[I8, U8, I16, U16, F32], &place)?;
        if kind != F32 && accessor["normalized"].as_bool() == Some(true) {
            // A quotient would be rounded, which no placement tells.
            return Err(self.source.unsupported(format!("{place}, of normalized positions,")));
        }
        let step = size(kind);
        let read = |element: &[u8]| [0, 1, 2].map(|axis| number_at(&element[axis * step..], kind));
        let positions = self.values(accessor, 3 * step, &place, read)?;
        let bad = positions.iter().position(|at: &[f64; 3]| !at.iter().all(|x| x.is_finite()));
        bad.map_or(Ok(()), |vertex| {
            let reason = format!("vertex {vertex} is at {:?}", positions[vertex]);
            Err(self.source.malformed(&place, reason))
        })?;
        Ok(positions)
    }

    /// Numbers of vertices.
    pub(super) fn indices(
        &mut self,
        number: usize,
        accessor: &'a Value,
    ) -> Result<Vec<u32>, MeshError> {
        let place = format!("accessor {number}");
        let kind = self.kind(accessor, "SCALAR", &[U8, U16, U32], &place)?;
        // Exact: all are whole and below 2³².
        self.values(accessor, size(kind), &place, |element| number_at(element, kind) as u32)
    }

    /// The type of the components, if it is wanted.
    fn kind(
        &self,
        accessor: &Value,
        shape: &str,
        kinds: &[u64],
        place: &str,
    ) -> Result<u64, MeshError> {
        match Self::kind_of(accessor, kinds) {
            Some(kind) if accessor["type"].as_str() == Some(shape) => Ok(kind),
            _ => Err(self.source.malformed(place, format!("its type is none of {shape}"))),
        }
    }

    fn kind_of(of: &Value, kinds: &[u64]) -> Option<u64> {
        of["componentType"].as_u64().filter(|kind| kinds.contains(kind))
    }

    /// The elements of an accessor, of so many bytes each, with those that a sparse one replaces.
    fn values<T: Clone + Default>(
        &mut self,
        accessor: &'a Value,
        bytes: usize,
        place: &str,
        read: impl Fn(&[u8]) -> T,
    ) -> Result<Vec<T>, MeshError> {
        let source = self.source;
        let wanted = |of: &Value, place: &str| match of.get("count") {
            Some(_) => source.count(of, "count", place),
            None => Err(source.malformed(place, "it has no count")),
        };
        let count = wanted(accessor, place)?;
        let Some(sparse) = accessor.get("sparse") else {
            return self.elements(accessor, count, bytes, place, read);
        };
        let mut values = if accessor.get("bufferView").is_some() {
            self.elements(accessor, count, bytes, place, &read)?
        } else if count <= MOST_ZEROS {
            vec![T::default(); count]
        } else {
            let reason =
                format!("it has {count} elements of a sparse accessor; {MOST_ZEROS} are read");
            return Err(source.malformed(place, reason));
        };
        let [numbers, others] = [&sparse["indices"], &sparse["values"]];
        let place = format!("{place}, sparse");
        let replaced = wanted(sparse, &place)?;
        let kind = Self::kind_of(numbers, &[U8, U16, U32]);
        let kind =
            kind.ok_or_else(|| source.malformed(&place, "its indices are of no whole type"))?;
        let numbers = self.elements(numbers, replaced, size(kind), &place, |element| {
            number_at(element, kind) as usize
        })?;
        let others = self.elements(others, replaced, bytes, &place, read)?;
        let mut last = None;
        for (number, value) in numbers.into_iter().zip(others) {
            if last.is_some_and(|last| last >= number) {
                return Err(source.malformed(&place, "its indices do not increase"));
            }
            last = Some(number);
            let Some(at) = values.get_mut(number) else {
                let reason = format!("its indices name element {number} of {count}");
                return Err(source.malformed(&place, reason));
            };
            *at = value;
        }
        Ok(values)
    }

    /// So many elements of a view, of so many bytes each.
    fn elements<T>(
        &mut self,
        accessor: &'a Value,
        count: usize,
        bytes: usize,
        place: &str,
        read: impl Fn(&[u8]) -> T,
    ) -> Result<Vec<T>, MeshError> {
        let source = self.source;
        let view = source.named(accessor, "bufferView", "bufferViews", place)?;
        let (_, view) = view.ok_or_else(|| source.malformed(place, "no bufferView"))?;
        source.refuse_extension(view, &["EXT_meshopt_compression", "KHR_meshopt_compression"])?;
        let buffer = source.named(view, "buffer", "buffers", place)?;
        let (number, buffer) = buffer.ok_or_else(|| source.malformed(place, "no buffer"))?;
        let data = self.buffer(number, buffer)?;
        let data = data.bytes();
        let step = match source.count(view, "byteStride", place)? {
            0 => bytes,
            stride if stride >= bytes => stride,
            _ => return Err(source.malformed(place, "byteStride is less than an element")),
        };
        let begin = source.count(view, "byteOffset", place)?;
        let end = begin.checked_add(source.count(view, "byteLength", place)?);
        let begin = begin.checked_add(source.count(accessor, "byteOffset", place)?);
        // The last element need not fill its step.
        let length = match count {
            0 => Some(0),
            _ => step.checked_mul(count - 1).and_then(|length| length.checked_add(bytes)),
        };
        let wanted = begin.zip(length).and_then(|(begin, length)| begin.checked_add(length));
        let room = data.len().min(end.unwrap_or(usize::MAX));
        match (begin, wanted) {
            (Some(begin), Some(wanted)) if wanted <= room => {
                let element = |i: usize| read(&data[begin + i * step..][..bytes]);
                Ok((0..count).map(element).collect())
            }
            _ => Err(source.malformed(place, format!("{count} elements reach beyond its buffer"))),
        }
    }

    /// The content of a buffer.
    fn buffer(&mut self, number: usize, buffer: &'a Value) -> Result<Data<'a>, MeshError> {
        let source = self.source;
        let place = format!("buffer {number}");
        let Some(uri) = buffer.get("uri").and_then(Value::as_str) else {
            let binary = self.binary.filter(|_| number == 0);
            let data = binary.ok_or_else(|| source.malformed(&place, "no uri"))?;
            return Ok(Data::Chunk(data));
        };
        // The text of a buffer is as long as its content: too long for a key.
        let key = if uri.starts_with("data:") { (Some(number), "") } else { (None, uri) };
        if let Some(data) = self.read.get(&key) {
            return Ok(Data::Read(Rc::clone(data)));
        }
        let data = match uri.strip_prefix("data:") {
            Some(data) => {
                let code = data.split_once(";base64,").map(|(_, code)| code);
                let data = code.and_then(|code| STANDARD.decode(code).ok());
                data.ok_or_else(|| source.malformed(&place, "its uri is no base64"))?
            }
            None => neighbour(source, uri, &place)?,
        };
        let data = Rc::new(data);
        self.read.insert(key, Rc::clone(&data));
        Ok(Data::Read(data))
    }
}

/// The content of a buffer.
enum Data<'a> {
    Chunk(&'a [u8]),
    Read(Rc<Vec<u8>>),
}

impl Data<'_> {
    fn bytes(&self) -> &[u8] {
        match self {
            Self::Chunk(data) => data,
            Self::Read(data) => data,
        }
    }
}

/// The content of a file beside the mesh.
fn neighbour(source: Source<'_>, uri: &str, place: &str) -> Result<Vec<u8>, MeshError> {
    let name = unescaped(uri);
    let name = name.as_deref().map(Path::new).filter(|name| {
        !uri.is_empty()
            && !uri.contains(':')
            && name.file_name().is_some()
            && name
                .components()
                .all(|part| matches!(part, Component::Normal(_) | Component::CurDir))
    });
    let name =
        name.ok_or_else(|| source.malformed(place, format!("{uri:?} is no file beside it")))?;
    let beside = source.file.with_file_name(name);
    let refused = |reason: String| MeshError::Unreadable { file: beside.clone(), reason };
    match std::fs::metadata(&beside) {
        Ok(found) if found.is_file() => {
            std::fs::read(&beside).map_err(|error| refused(error.to_string()))
        }
        Ok(_) => Err(refused("no file".into())),
        Err(error) => Err(refused(error.to_string())),
    }
}

/// A uri without its escapes, as `%20`.
fn unescaped(uri: &str) -> Option<String> {
    let mut parts = uri.split('%');
    let mut bytes = parts.next()?.as_bytes().to_vec();
    for part in parts {
        bytes.push(u8::from_str_radix(part.get(..2)?, 16).ok()?);
        bytes.extend(&part.as_bytes()[2..]);
    }
    String::from_utf8(bytes).ok()
}

fn size(kind: u64) -> usize {
    match kind {
        I8 | U8 => 1,
        I16 | U16 => 2,
        _ => 4,
    }
}

/// The number at the start of an element, which is long enough.
fn number_at(element: &[u8], kind: u64) -> f64 {
    let at = |i: usize| element.get(i).copied().unwrap_or_default();
    let two = [at(0), at(1)];
    let four = [at(0), at(1), at(2), at(3)];
    match kind {
        I8 => i8::from_le_bytes([at(0)]).into(),
        U8 => at(0).into(),
        I16 => i16::from_le_bytes(two).into(),
        U16 => u16::from_le_bytes(two).into(),
        U32 => u32::from_le_bytes(four).into(),
        _ => f32::from_le_bytes(four).into(),
    }
}
