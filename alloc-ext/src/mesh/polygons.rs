//! The faces of a file as triangles, with a count of the faces that are none.

use std::fmt;

use super::ears;
use crate::counted::Counted;

/// Faces of a file with more than three corners. A face of n corners is n − 2 triangles.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Polygons {
    /// All of them.
    pub split: usize,
    /// Those that were split by ears: their first corner does not see all of them.
    pub by_ears: usize,
    /// Those that no triangles are proved to be, so that they were split into the fan about their
    /// first corner: they cross themselves, seen along the axis nearest to their normal.
    pub unsound: NamedFaces,
    /// Those that were split so because they are not convex, and have more than 10,000 corners.
    pub too_large: NamedFaces,
}

/// A number of faces, and the first of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct NamedFaces {
    /// Number of faces.
    pub count: usize,
    /// The first.
    pub first: Option<FacePlace>,
}

/// A face of the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FacePlace {
    /// Number of the face, as errors of its format count.
    pub face: usize,
    /// Line of the file, from 1, if it has lines.
    pub line: Option<usize>,
}

impl NamedFaces {
    fn add(&mut self, place: FacePlace) {
        self.count += 1;
        self.first.get_or_insert(place);
    }

    pub(super) fn add_all(&mut self, others: Self) {
        self.count += others.count;
        self.first = self.first.or(others.first);
    }
}

impl fmt::Display for FacePlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "face {}", self.face)?;
        self.line.map_or(Ok(()), |line| write!(f, ", line {line}"))
    }
}

impl NamedFaces {
    /// A sentence of a report, if there are any: the count, the noun, what of them, the first.
    pub(super) fn said(&self, noun: &'static str, what: &str) -> Option<String> {
        let more = if self.count > 1 { " …" } else { "" };
        self.first.map(|first| format!("{} {what}: {first}{more}", Counted(self.count, noun)))
    }
}

impl Polygons {
    /// A sentence for each kind of doubt.
    pub(super) fn doubts(&self) -> impl Iterator<Item = String> {
        let unsound = "too warped or crossing itself, split about its first corner";
        let too_large = format!(
            "not convex and of more than {} corners, split about its first corner",
            ears::MOST_CORNERS
        );
        let unsound = self.unsound.said("polygon", unsound);
        unsound.into_iter().chain(self.too_large.said("polygon", &too_large))
    }

    /// Counts those of another part of the file.
    pub(super) fn add(&mut self, others: &Self) {
        self.split += others.split;
        self.by_ears += others.by_ears;
        self.unsound.add_all(others.unsound);
        self.too_large.add_all(others.too_large);
    }

    /// Counts a polygon of four or more corners. Its triangles, if they are not its fan.
    pub(super) fn ears(
        &mut self,
        corners: &[[f64; 3]],
        place: FacePlace,
    ) -> Option<Vec<[usize; 3]>> {
        self.split += 1;
        match ears::split(corners) {
            ears::Split::Fan => None,
            ears::Split::Ears(ears) => {
                self.by_ears += 1;
                Some(ears)
            }
            ears::Split::Unsound => {
                self.unsound.add(place);
                None
            }
            ears::Split::TooLarge => {
                self.too_large.add(place);
                None
            }
        }
    }
}

/// Faces as they are read. Vertices may follow later in the file.
#[derive(Default)]
pub(super) struct Faces {
    /// Of each polygon the fan about its first corner.
    pub triangles: Vec<[u32; 3]>,
    /// Faces of fewer than three corners, which are left out.
    pub small: NamedFaces,
    polygons: Vec<Polygon>,
}

/// Faces as triangles; the fields are those of a [`RawMesh`](super::RawMesh).
pub(super) struct Split {
    pub triangles: Vec<[u32; 3]>,
    pub polygons: Polygons,
    pub fans: Vec<(usize, [u32; 3])>,
}

struct Polygon {
    first_triangle: usize,
    corner_count: u32,
    face: u32,
    /// 0 if the file has none.
    line: u32,
}

impl Faces {
    pub fn add(&mut self, corners: &[u32], place: FacePlace) {
        let [first, rest @ ..] = corners else { return self.small.add(place) };
        if rest.len() < 2 {
            return self.small.add(place);
        }
        if rest.len() > 2 {
            self.polygons.push(Polygon {
                first_triangle: self.triangles.len(),
                corner_count: corners.len() as u32,
                face: place.face as u32,
                line: place.line.unwrap_or(0) as u32,
            });
        }
        self.triangles.extend(rest.windows(2).map(|pair| [*first, pair[0], pair[1]]));
    }

    /// The triangles of all faces. A face with a corner that is none of `positions` keeps its fan,
    /// which the checks of all formats refuse.
    pub fn finish(mut self, positions: &[[f64; 3]]) -> Split {
        let mut fans = Vec::new();
        let mut polygons = Polygons::default();
        let mut corners: Vec<u32> = Vec::new();
        let mut at: Vec<[f64; 3]> = Vec::new();
        for Polygon { first_triangle, corner_count, face, line } in self.polygons {
            let triangles = &mut self.triangles[first_triangle..][..corner_count as usize - 2];
            corners.clear();
            corners.extend(&triangles[0][..2]);
            corners.extend(triangles.iter().map(|triangle| triangle[2]));
            at.clear();
            at.extend(corners.iter().filter_map(|&v| positions.get(v as usize)));
            if at.len() < corners.len() {
                continue;
            }
            let line = (line > 0).then_some(line as usize);
            let place = FacePlace { face: face as usize, line };
            if let Some(ears) = polygons.ears(&at, place) {
                for ((number, triangle), ear) in (first_triangle..).zip(triangles).zip(ears) {
                    fans.push((number, *triangle));
                    *triangle = ear.map(|corner| corners[corner]);
                }
            }
        }
        Split { triangles: self.triangles, polygons, fans }
    }
}
