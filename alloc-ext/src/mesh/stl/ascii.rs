//! ASCII STL: all solids of the file, word by word, for some programs break lines elsewhere.

use std::path::Path;

use super::super::polygons::{FacePlace, Polygons};
use super::super::text::{Words, lines, lowercase, number, point, quoted, why_no_number};
use super::super::{MeshError, RawMesh};
use super::binary::HEADER_BYTES;
use super::soup::raw;

/// Reads the facets of all solids. A facet of more than three vertices is split. Between solids any
/// line is a comment, and a line that begins with `;`, `//` or `#` is one everywhere.
///
/// A file of `size` bytes that ends before `endsolid` is refused: it may be cut.
pub(super) fn read(file: &Path, size: usize, text: &str) -> Result<RawMesh, MeshError> {
    let mut words = Words::new(lines(text));
    let mut facets = Facets::new(file);
    // Numbers that may follow, of a normal or a colour.
    let mut numbers = 0;
    while let Some(word) = words.next() {
        let line = words.line;
        facets.line = line;
        if numbers > 0 {
            // Of any size: they mean nothing here.
            if word.parse::<f64>().is_ok() || number(word).is_ok() {
                numbers -= 1;
                continue;
            }
            if word.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)) {
                return Err(facets.malformed(&why_no_number(word)));
            }
        }
        numbers = 0;
        let mut keyword = lowercase(word);
        if matches!(&*keyword, "end" | "outer") {
            let next = lowercase(words.peek().unwrap_or_default());
            if matches!(&*next, "loop" | "facet" | "solid") {
                keyword.to_mut().push_str(&next);
                words.next();
            }
        }
        match &*keyword {
            "solid" => {
                facets.begin_solid()?;
                words.skip_to(after_name(words.rest()));
            }
            "facet" => {
                facets.begin_facet()?;
                numbers = 3;
            }
            "normal" if facets.facet.is_some() => numbers = 3,
            "outer" | "outerloop" => facets.begin_loop()?,
            "vertex" => {
                let at = point(file, line, facets.vertex, &mut words)?;
                facets.vertex(at)?;
            }
            "endloop" => facets.end_loop()?,
            "endfacet" => facets.end_facet()?,
            "color" | "colour" => numbers = 4,
            // The name may follow without a blank.
            _ if keyword.starts_with("endsolid") => {
                facets.end_solid()?;
                words.skip_to(after_last_name(words.rest()));
            }
            _ if !facets.is_in_solid
                || ["#", ";", "//"].iter().any(|mark| word.starts_with(mark)) =>
            {
                words.skip_to("");
            }
            // A cut file may end in a word.
            _ if words.next().is_none() => break,
            _ => return Err(facets.malformed(&format!("{} is no word of STL", quoted(word)))),
        }
    }
    facets.finish(size)
}

/// The rest of a line after a solid's name. A name is all of the line, unless the solid itself
/// follows on it.
fn after_name(line: &str) -> &str {
    let mut rest = line.trim_ascii_start();
    while !rest.is_empty() {
        let mut words = rest.split_ascii_whitespace().map(str::to_ascii_lowercase);
        let word = words.next().unwrap_or_default();
        let is_facet = word == "facet" && words.next().is_some_and(|next| next == "normal");
        if is_facet || word.starts_with("endsolid") {
            return rest;
        }
        rest = rest[word.len()..].trim_ascii_start();
    }
    rest
}

/// The rest of a line after the name at a solid's end: from the last `solid` before a facet on.
fn after_last_name(line: &str) -> &str {
    let mut rest = line.trim_ascii_start();
    let mut next_solid = "";
    while !rest.is_empty() {
        let word = rest.split_ascii_whitespace().next().unwrap_or_default();
        if word.eq_ignore_ascii_case("solid") {
            next_solid = rest;
        } else if word.eq_ignore_ascii_case("facet") {
            return next_solid;
        }
        rest = rest[word.len()..].trim_ascii_start();
    }
    rest
}

/// The facets as far as they are read.
struct Facets<'a> {
    file: &'a Path,
    line: usize,
    /// Number of the next facet, and of the next vertex.
    number: usize,
    vertex: usize,
    /// Number of the solid's first facet.
    first: usize,
    /// A solid or a facet was there.
    is_stl: bool,
    is_in_solid: bool,
    /// The corners of the facet that is open.
    facet: Option<Vec<[f64; 3]>>,
    loops: Loop,
    positions: Vec<[f64; 3]>,
    polygons: Polygons,
    fans: Vec<(usize, [u32; 3])>,
}

/// How far a facet's loop is.
#[derive(PartialEq)]
enum Loop {
    NotBegun,
    Open,
    Ended,
}

impl<'a> Facets<'a> {
    fn new(file: &'a Path) -> Self {
        Self {
            file,
            line: 1,
            number: 0,
            vertex: 0,
            first: 0,
            is_stl: false,
            is_in_solid: false,
            facet: None,
            loops: Loop::NotBegun,
            positions: Vec::new(),
            polygons: Polygons::default(),
            fans: Vec::new(),
        }
    }

    fn malformed(&self, reason: &str) -> MeshError {
        MeshError::Malformed {
            file: self.file.to_owned(),
            line: Some(self.line),
            place: format!("facet {}", self.number),
            reason: reason.into(),
        }
    }

    fn begin_solid(&mut self) -> Result<(), MeshError> {
        if self.facet.is_some() {
            return Err(self.malformed("a solid starts inside a facet"));
        }
        // A line before the solid may begin with the word too.
        if std::mem::replace(&mut self.is_in_solid, true) && self.number > self.first {
            return Err(self.malformed("a solid starts, and the one before has no endsolid"));
        }
        self.is_stl = true;
        self.first = self.number;
        Ok(())
    }

    fn end_solid(&mut self) -> Result<(), MeshError> {
        if self.facet.is_some() {
            return Err(self.malformed("the solid ends inside a facet"));
        }
        self.is_in_solid = false;
        Ok(())
    }

    fn begin_facet(&mut self) -> Result<(), MeshError> {
        if self.facet.is_some() {
            return Err(self.malformed("a facet starts inside another"));
        }
        self.facet = Some(Vec::with_capacity(3));
        self.loops = Loop::NotBegun;
        (self.is_stl, self.is_in_solid) = (true, true);
        Ok(())
    }

    fn begin_loop(&mut self) -> Result<(), MeshError> {
        if self.facet.is_none() {
            return Err(self.malformed("a loop outside any facet"));
        }
        if self.loops != Loop::NotBegun {
            return Err(self.malformed("a facet of several loops, or of a hole"));
        }
        self.loops = Loop::Open;
        Ok(())
    }

    fn vertex(&mut self, at: [f64; 3]) -> Result<(), MeshError> {
        let is_ended = self.loops == Loop::Ended;
        match &mut self.facet {
            Some(corners) if !is_ended => corners.push(at),
            Some(_) => return Err(self.malformed("a vertex after the facet's loop")),
            None => return Err(self.malformed("a vertex outside any facet")),
        }
        self.vertex += 1;
        Ok(())
    }

    fn end_loop(&mut self) -> Result<(), MeshError> {
        if self.facet.is_none() {
            return Err(self.malformed("a loop ends outside any facet"));
        }
        self.loops = Loop::Ended;
        Ok(())
    }

    fn end_facet(&mut self) -> Result<(), MeshError> {
        let corners = self.facet.take().unwrap_or_default();
        let [first, rest @ ..] = corners.as_slice() else {
            return Err(self.malformed("fewer than three vertices"));
        };
        if rest.len() < 2 {
            return Err(self.malformed("fewer than three vertices"));
        }
        let place = FacePlace { face: self.number, line: Some(self.line) };
        let is_polygon = rest.len() > 2;
        match is_polygon.then(|| self.polygons.ears(&corners, place)).flatten() {
            Some(ears) => {
                let number = self.positions.len() / 3;
                self.fans.extend((number..).zip(ears.iter().map(|e| e.map(|k| k as u32))));
                self.positions.extend(ears.iter().flatten().map(|&k| corners[k]));
            }
            None => {
                let fan = rest.windows(2).flat_map(|pair| [*first, pair[0], pair[1]]);
                self.positions.extend(fan);
            }
        }
        self.number += 1;
        Ok(())
    }

    /// The mesh of a file of `size` bytes.
    fn finish(self, size: usize) -> Result<RawMesh, MeshError> {
        if self.facet.is_some() {
            return Err(self.malformed("the file ends inside a facet"));
        }
        if self.is_in_solid {
            return Err(self.malformed("the file ends without endsolid"));
        }
        if !self.is_stl && size < HEADER_BYTES {
            return Err(super::binary::too_short(self.file, size));
        }
        if !self.is_stl {
            return Err(MeshError::Malformed {
                file: self.file.to_owned(),
                line: None,
                place: "the text".into(),
                reason: "no solid and no facet is there: the file is neither ASCII nor binary STL"
                    .into(),
            });
        }
        let Self { file, positions, polygons, fans, .. } = self;
        Ok(RawMesh { fans, ..raw(file, positions, polygons, true) })
    }
}
