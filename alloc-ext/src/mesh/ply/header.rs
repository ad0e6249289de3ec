//! The header of a PLY file.

use std::path::Path;

use super::super::MeshError;
use super::super::text::quoted;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    Little,
    Big,
}

/// The type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
    /// A word, or a text in quotes; only in text.
    String,
}

impl Scalar {
    fn of(word: &str) -> Option<Self> {
        Some(match word.to_ascii_lowercase().as_str() {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "int64" => Self::I64,
            "uint64" => Self::U64,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            "string" => Self::String,
            _ => return None,
        })
    }

    pub(super) fn bytes(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::I64 | Self::U64 | Self::F64 => 8,
            Self::String => 0,
        }
    }

    pub(super) fn is_whole(self) -> bool {
        !matches!(self, Self::F32 | Self::F64 | Self::String)
    }
}

pub(super) struct Property {
    pub(super) name: String,
    /// The type of its length, if it is a list.
    pub(super) length: Option<Scalar>,
    pub(super) scalar: Scalar,
}

impl Property {
    /// Fewest bytes that it takes in a binary file: a list may be empty.
    pub(super) fn least_bytes(&self) -> usize {
        self.length.unwrap_or(self.scalar).bytes()
    }

    pub(super) fn has_strings(&self) -> bool {
        self.scalar == Scalar::String
    }
}

pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: usize,
    pub(super) properties: Vec<Property>,
}

pub(super) struct Header<'a> {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// What follows the header.
    pub(super) body: &'a [u8],
    /// Number of the header's lines.
    pub(super) lines: usize,
}

/// Reads the header. Its lines end with CR, LF or both. Comments, `obj_info` and blank lines may be
/// anywhere.
pub(super) fn read<'a>(file: &Path, bytes: &'a [u8]) -> Result<Header<'a>, MeshError> {
    let malformed = |line: Option<usize>, reason: String| MeshError::Malformed {
        file: file.to_owned(),
        line,
        place: "the header".into(),
        reason,
    };
    let mut lines = Lines { rest: bytes, only_cr: false };
    let first = lines.next().unwrap_or_default();
    if !first.trim_ascii().eq_ignore_ascii_case(b"ply") {
        return Err(malformed(Some(1), "it does not begin with ply".into()));
    }
    let first_end = &bytes[first.len()..];
    lines.only_cr = first_end.starts_with(b"\r") && !first_end.starts_with(b"\r\n");
    let mut encoding = None;
    let mut elements: Vec<Element> = Vec::new();
    let mut number = 1;
    while let Some(line) = lines.next() {
        number += 1;
        let line = String::from_utf8_lossy(line);
        let words: Vec<&str> = line.split_ascii_whitespace().collect();
        let statement = words.first().map_or(String::new(), |word| word.to_ascii_lowercase());
        let refuse = |reason: String| Err(malformed(Some(number), reason));
        match (statement.as_str(), &words[..]) {
            ("" | "comment" | "obj_info", _) => {}
            ("format", [_, of, version @ ..]) => {
                if version.first().is_some_and(|version| !version.starts_with("1.")) {
                    return refuse(format!("version {} is not known", quoted(version[0])));
                }
                encoding = Some(match of.to_ascii_lowercase().as_str() {
                    "ascii" => Encoding::Text,
                    "binary_little_endian" => Encoding::Little,
                    "binary_big_endian" => Encoding::Big,
                    _ => return refuse(format!("{} is no format of PLY", quoted(of))),
                });
            }
            ("element", [_, name, count]) => {
                let Ok(count) = count.parse() else {
                    return refuse(format!("{} is no number of elements", quoted(count)));
                };
                if elements.iter().any(|other| other.name == **name) {
                    return refuse(format!("element {name} is there twice"));
                }
                let (name, properties) = ((*name).to_owned(), Vec::new());
                elements.push(Element { name, count, properties });
            }
            ("property", [_, types @ .., name]) if !types.is_empty() => {
                let types: Option<Vec<Scalar>> = match types {
                    [list, types @ ..] if list.eq_ignore_ascii_case("list") => {
                        types.iter().map(|word| Scalar::of(word)).collect()
                    }
                    [of] => Scalar::of(of).map(|of| vec![of]),
                    _ => None,
                };
                let is_list = words[1].eq_ignore_ascii_case("list");
                let (length, scalar) = match types.as_deref() {
                    Some(&[length, scalar]) if is_list && length.is_whole() => {
                        (Some(length), scalar)
                    }
                    Some(&[scalar]) if !is_list => (None, scalar),
                    _ => return refuse(format!("property {name} is of no type of PLY")),
                };
                let Some(element) = elements.last_mut() else {
                    return refuse(format!("property {name} belongs to no element"));
                };
                if element.properties.iter().any(|other| other.name == **name) {
                    return refuse(format!("property {name} of {} is there twice", element.name));
                }
                element.properties.push(Property { name: (*name).to_owned(), length, scalar });
            }
            ("end_header", _) => {
                let encoding = encoding.ok_or_else(|| malformed(None, "no format".into()))?;
                return Ok(Header { encoding, elements, body: lines.rest, lines: number });
            }
            _ => return refuse(format!("{} is no statement of PLY", quoted(line.trim()))),
        }
    }
    Err(malformed(None, "it ends without end_header".into()))
}

/// The lines of the header.
struct Lines<'a> {
    rest: &'a [u8],
    /// Lines end with CR. Then an LF after the last one is of the body.
    only_cr: bool,
}

impl<'a> Iterator for Lines<'a> {
    type Item = &'a [u8];

    fn next(&mut self) -> Option<&'a [u8]> {
        let end = self.rest.iter().position(|b| b"\r\n".contains(b))?;
        let (line, rest) = self.rest.split_at(end);
        let ended =
            if self.only_cr { rest.strip_prefix(b"\r") } else { rest.strip_prefix(b"\r\n") };
        self.rest = ended.unwrap_or(&rest[1..]);
        Some(line)
    }
}
