//! The XML of COLLADA and of robots' descriptions as a tree, with lines for messages.

use encoding_rs::{Encoding, UTF_8, UTF_16BE, UTF_16LE};
use quick_xml::XmlVersion;
use quick_xml::events::{BytesRef, BytesStart, Event};
use quick_xml::reader::Reader;
use rustc_hash::FxHashMap;
use std::borrow::Cow;
use std::path::Path;

use super::MeshError;
use super::text::{decoded, number, quoted};
use super::xml::{ENDS_EARLY, why};

/// The file as text, in the encoding that its byte order mark or its first line tells.
pub(crate) fn text_of<'a>(file: &Path, bytes: &'a [u8]) -> Result<Cow<'a, str>, MeshError> {
    let head = bytes.get(..bytes.len().min(200)).unwrap_or_default();
    let head = String::from_utf8_lossy(head);
    let declared = head.split("?>").next().filter(|head| head.trim_start().starts_with("<?xml"));
    let label = declared.and_then(|head| head.split("encoding").nth(1)).map(|after| {
        after.trim_matches(|c: char| c == '=' || c == '"' || c == '\'' || c.is_whitespace())
    });
    let label = label.and_then(|label| label.split(['"', '\'']).next());
    let Some(label) = label else { return Ok(decoded(bytes)) };
    match Encoding::for_label(label.as_bytes()) {
        None => {
            let what = format!("the encoding {}", quoted(label));
            Err(MeshError::Unsupported { file: file.to_owned(), what })
        }
        // The first line would not be read as text, were it in two bytes a character.
        Some(of) if [UTF_8, UTF_16LE, UTF_16BE].contains(&of) => Ok(decoded(bytes)),
        Some(of) => Ok(of.decode(bytes).0),
    }
}

/// An element.
pub(crate) struct Node<'a> {
    pub(crate) name: String,
    attributes: Vec<(String, String)>,
    /// All text in it, without that of its children.
    pub(crate) text: Cow<'a, str>,
    pub(crate) children: Vec<usize>,
    parent: Option<usize>,
    pub(crate) line: usize,
}

/// The elements of a file, in its order. The first is the root.
pub(crate) struct Document<'a> {
    pub(crate) file: &'a Path,
    pub(crate) nodes: Vec<Node<'a>>,
    ids: FxHashMap<String, Vec<usize>>,
}

impl<'a> Document<'a> {
    pub(crate) fn parse(file: &'a Path, text: &'a str) -> Result<Self, MeshError> {
        let mut document = Self { file, nodes: Vec::new(), ids: FxHashMap::default() };
        let mut reader = Reader::from_str(text);
        let mut open: Vec<usize> = Vec::new();
        let (mut line, mut counted) = (1, 0);
        loop {
            let event = reader.read_event();
            let done = event.map_err(|error| why(&error)).and_then(|event| {
                match &event {
                    Event::Start(tag) | Event::Empty(tag) => {
                        let element = document.add(tag, open.last().copied(), line)?;
                        if matches!(event, Event::Start(_)) {
                            open.push(element);
                        }
                    }
                    Event::End(_) => {
                        open.pop();
                    }
                    Event::Text(text) => document.append(&open, text.clone().into_inner()),
                    Event::CData(text) => document.append(&open, text.clone().into_inner()),
                    Event::GeneralRef(of) => document.append(&open, resolved(of)?.into()),
                    Event::Eof if open.is_empty() && !document.nodes.is_empty() => return Ok(true),
                    Event::Eof if document.nodes.is_empty() => return Err("it is no XML".into()),
                    Event::Eof => return Err(ENDS_EARLY.to_owned()),
                    _ => {}
                }
                Ok(false)
            });
            let malformed = |reason| MeshError::Malformed {
                file: file.to_owned(),
                line: Some(line),
                place: "the XML".into(),
                reason,
            };
            if done.map_err(malformed)? {
                return Ok(document);
            }
            let at = usize::try_from(reader.buffer_position()).unwrap_or(text.len());
            line += line_ends(text.as_bytes(), counted, at);
            counted = at;
        }
    }

    fn add(
        &mut self,
        tag: &BytesStart<'_>,
        parent: Option<usize>,
        line: usize,
    ) -> Result<usize, String> {
        let element = self.nodes.len();
        if parent.is_none() && element > 0 {
            return Err("a second root".into());
        }
        let mut attributes = Vec::new();
        for attribute in tag.attributes() {
            let attribute = attribute.map_err(|error| error.to_string())?;
            let value = attribute.normalized_value(XmlVersion::Implicit1_0);
            let value = value.map_err(|error| error.to_string())?.into_owned();
            let key = attribute.key.as_ref().to_owned();
            if key == "id" {
                self.ids.entry(value.clone()).or_default().push(element);
            }
            attributes.push((key, value));
        }
        let name = tag.local_name().as_ref().to_owned();
        let (text, children) = (Cow::Borrowed(""), Vec::new());
        self.nodes.push(Node { name, attributes, text, children, parent, line });
        if let Some(parent) = parent {
            self.nodes[parent].children.push(element);
        }
        Ok(element)
    }

    fn append(&mut self, open: &[usize], text: Cow<'a, str>) {
        let Some(&element) = open.last() else { return };
        let of = &mut self.nodes[element].text;
        // Nearly all of it stands between tags.
        if of.is_empty() && text.trim_ascii().is_empty() {
            return;
        }
        if of.is_empty() {
            *of = text;
        } else {
            of.to_mut().push_str(&text);
        }
    }

    /// The children of a name.
    pub(crate) fn all<'b>(&'b self, of: usize, name: &'b str) -> impl Iterator<Item = usize> + 'b {
        self.nodes[of].children.iter().copied().filter(move |&child| self.nodes[child].name == name)
    }

    pub(crate) fn child(&self, of: usize, name: &str) -> Option<usize> {
        self.all(of, name).next()
    }

    /// All elements of a name, whose parent has the other name.
    pub(super) fn every<'b>(
        &'b self,
        name: &'b str,
        parent: &'b str,
    ) -> impl Iterator<Item = usize> + 'b {
        (0..self.nodes.len()).filter(move |&element| {
            let node = &self.nodes[element];
            node.name == name && node.parent.is_some_and(|of| self.nodes[of].name == parent)
        })
    }

    pub(crate) fn attribute(&self, of: usize, name: &str) -> Option<&str> {
        let found = self.nodes[of].attributes.iter().find(|(key, _)| key == name);
        found.map(|(_, value)| value.as_str())
    }

    /// A whole number, if it is there.
    pub(super) fn count(&self, of: usize, name: &str) -> Result<Option<usize>, MeshError> {
        let Some(value) = self.attribute(of, name) else { return Ok(None) };
        let count = value.trim().parse().map(Some);
        count.map_err(|_| self.malformed(of, format!("{name} {} is no number", quoted(value))))
    }

    /// The element of one of the names that the attribute names.
    pub(super) fn named(
        &self,
        of: usize,
        attribute: &str,
        names: &[&str],
    ) -> Result<usize, MeshError> {
        let url = self.attribute(of, attribute);
        let url = url.ok_or_else(|| self.malformed(of, format!("it has no {attribute}")))?.trim();
        let Some(id) = url.strip_prefix('#') else {
            return Err(self.unsupported(of, &format!("{}, of another file,", quoted(url))));
        };
        let all = self.ids.get(id).map_or(&[][..], Vec::as_slice);
        let mut found =
            all.iter().copied().filter(|&at| names.contains(&self.nodes[at].name.as_str()));
        let (names, id) = (names.join(" or "), quoted(id));
        match (found.next(), found.next()) {
            (Some(found), None) => Ok(found),
            (None, _) => Err(self.malformed(of, format!("there is no {names} of id {id}"))),
            _ => Err(self.malformed(of, format!("several {names} have the id {id}"))),
        }
    }

    /// The numbers in an element's text.
    pub(super) fn numbers(&self, of: usize) -> Result<Vec<f64>, MeshError> {
        let words = self.nodes[of].text.split_ascii_whitespace();
        words.map(|word| number(word).map_err(|reason| self.malformed(of, reason))).collect()
    }

    /// As many finite numbers as wanted.
    pub(super) fn exactly<const N: usize>(&self, of: usize) -> Result<[f64; N], MeshError> {
        let numbers = self.numbers(of)?;
        let count = numbers.len();
        let numbers = <[f64; N]>::try_from(numbers).ok();
        let numbers = numbers.filter(|numbers| numbers.iter().all(|x| x.is_finite()));
        numbers.ok_or_else(|| {
            self.malformed(of, format!("{N} finite numbers are wanted, and {count} numbers there"))
        })
    }

    pub(crate) fn malformed(&self, at: usize, reason: impl Into<String>) -> MeshError {
        MeshError::Malformed {
            file: self.file.to_owned(),
            line: Some(self.nodes[at].line),
            place: self.place(at),
            reason: reason.into(),
        }
    }

    /// Refuses what `what` says of an element.
    pub(crate) fn unsupported(&self, at: usize, what: &str) -> MeshError {
        let what = format!("{what} in line {}, {},", self.nodes[at].line, self.place(at));
        MeshError::Unsupported { file: self.file.to_owned(), what }
    }

    /// An element's name, and that of the one around it that has an id.
    pub(crate) fn place(&self, at: usize) -> String {
        let mut place = self.nodes[at].name.clone();
        let mut around = Some(at);
        while let Some(element) = around {
            let id = self.attribute(element, "id").or_else(|| self.attribute(element, "name"));
            if let Some(id) = id {
                let of = if element == at { "" } else { " of " };
                let name = if element == at { "" } else { &self.nodes[element].name };
                place += &format!("{of}{name} {}", quoted(id));
                break;
            }
            around = self.nodes[element].parent;
        }
        place
    }
}

/// How many lines end in a part of the text: with CR, LF or both.
fn line_ends(text: &[u8], from: usize, to: usize) -> usize {
    let is_end = |&at: &usize| match text.get(at) {
        Some(b'\n') => true,
        Some(b'\r') => text.get(at + 1) != Some(&b'\n'),
        _ => false,
    };
    (from..to).filter(is_end).count()
}

/// The text of a reference, as `&lt;`.
fn resolved(of: &BytesRef<'_>) -> Result<String, String> {
    if let Some(character) = of.resolve_char_ref().map_err(|error| error.to_string())? {
        return Ok(character.into());
    }
    let text = match &**of {
        "lt" => "<",
        "gt" => ">",
        "amp" => "&",
        "quot" => "\"",
        "apos" => "'",
        other => return Err(format!("the entity {} is not known", quoted(other))),
    };
    Ok(text.into())
}
