//! The meshes of a COLLADA file.

use super::super::document::Document;
use super::super::polygons::{FacePlace, Faces, Polygons, Split};
use super::super::strip::strip;
use super::super::text::{finite, quoted};
use super::super::{LeftOut, MeshError};

/// A mesh in its own frame.
pub(super) struct Geometry {
    pub(super) positions: Vec<[f64; 3]>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) fans: Vec<(usize, [u32; 3])>,
    pub(super) polygons: Polygons,
    pub(super) left_out: LeftOut,
    /// Number of its faces.
    pub(super) face_count: usize,
}

/// Reads a `geometry`, whose first face has the number `face`.
pub(super) fn read(document: &Document<'_>, of: usize, face: usize) -> Result<Geometry, MeshError> {
    let mut reading = Reading {
        document,
        positions: Vec::new(),
        vertices: Vec::new(),
        faces: Faces::default(),
        left_out: LeftOut::default(),
        next_face: face,
    };
    for &kind in &document.nodes[of].children {
        match document.nodes[kind].name.as_str() {
            "mesh" => reading.mesh(kind)?,
            "spline" => reading.left_out.lines_and_points += 1,
            "asset" | "extra" => {}
            name => return Err(document.unsupported(kind, &format!("the {name}"))),
        }
    }
    let Reading { positions, faces, mut left_out, next_face, .. } = reading;
    left_out.small_faces = faces.small;
    let Split { triangles, polygons, fans } = faces.finish(&positions);
    let face_count = next_face - face;
    Ok(Geometry { positions, triangles, fans, polygons, left_out, face_count })
}

struct Reading<'a, 'b> {
    document: &'a Document<'b>,
    positions: Vec<[f64; 3]>,
    /// Elements that list vertices, with the number of the first and their count.
    vertices: Vec<(usize, [usize; 2])>,
    faces: Faces,
    left_out: LeftOut,
    next_face: usize,
}

/// The numbers of an element's corners.
struct Corners {
    /// Inputs that each corner names.
    step: usize,
    /// Which of them is the vertex.
    offset: usize,
    /// The number of the first vertex, and the count.
    vertices: [usize; 2],
}

impl Reading<'_, '_> {
    fn mesh(&mut self, mesh: usize) -> Result<(), MeshError> {
        let document = self.document;
        for &element in &document.nodes[mesh].children {
            match document.nodes[element].name.as_str() {
                "source" | "vertices" | "extra" => {}
                "lines" | "linestrips" => self.left_out.lines_and_points += 1,
                "triangles" => self.triangles(element)?,
                "polylist" => self.polylist(element)?,
                "polygons" | "tristrips" | "trifans" => self.lists(element)?,
                name => return Err(document.unsupported(element, &format!("the {name}"))),
            }
        }
        Ok(())
    }

    /// Triangles in one list.
    fn triangles(&mut self, element: usize) -> Result<(), MeshError> {
        let document = self.document;
        let mut all = Vec::new();
        let wanted = self.corners(element)?;
        for p in document.all(element, "p") {
            all.extend(self.list(p, wanted.as_ref())?);
        }
        let (triangles, rest) = all.as_chunks::<3>();
        self.check_count(element, triangles.len(), "triangles")?;
        if !rest.is_empty() {
            let reason = format!("{} corners are no multiple of three", all.len());
            return Err(document.malformed(element, reason));
        }
        self.faces.triangles.extend_from_slice(triangles);
        self.next_face += triangles.len();
        Ok(())
    }

    /// Polygons in one list, with their numbers of corners in another.
    fn polylist(&mut self, element: usize) -> Result<(), MeshError> {
        let document = self.document;
        let mut sizes = Vec::new();
        for vcount in document.all(element, "vcount") {
            for word in document.nodes[vcount].text.split_ascii_whitespace() {
                let size = word.parse::<usize>().map_err(|_| {
                    document.malformed(vcount, format!("{} is no number of corners", quoted(word)))
                })?;
                sizes.push(size);
            }
        }
        self.check_count(element, sizes.len(), "polygons")?;
        let mut all = Vec::new();
        let wanted = self.corners(element)?;
        for p in document.all(element, "p") {
            all.extend(self.list(p, wanted.as_ref())?);
        }
        let total = sizes.iter().fold(0usize, |sum, &size| sum.saturating_add(size));
        if total != all.len() {
            let reason = format!("its vcount wants {total} corners, and {} are there", all.len());
            return Err(document.malformed(element, reason));
        }
        let line = Some(document.nodes[element].line);
        let mut rest = all.as_slice();
        for size in sizes {
            let (corners, after) = rest.split_at(size);
            rest = after;
            self.faces.add(corners, FacePlace { face: self.next_face, line });
            self.next_face += 1;
        }
        Ok(())
    }

    /// Polygons, strips or fans, each in a list of its own.
    fn lists(&mut self, element: usize) -> Result<(), MeshError> {
        let document = self.document;
        let name = document.nodes[element].name.as_str();
        if let Some(holed) = document.child(element, "ph") {
            return Err(document.unsupported(holed, "a polygon with holes"));
        }
        self.check_count(element, document.all(element, "p").count(), name)?;
        let wanted = self.corners(element)?;
        for p in document.all(element, "p") {
            let corners = self.list(p, wanted.as_ref())?;
            let triangles = &mut self.faces.triangles;
            match (name, corners.as_slice()) {
                ("tristrips", corners) => self.left_out.stitches += strip(corners, triangles),
                ("trifans", [first, rest @ ..]) => {
                    triangles.extend(rest.windows(2).map(|pair| [*first, pair[0], pair[1]]));
                }
                (_, corners) => {
                    let line = Some(document.nodes[p].line);
                    self.faces.add(corners, FacePlace { face: self.next_face, line });
                }
            }
            self.next_face += 1;
        }
        Ok(())
    }

    /// Refuses a number of parts that is not the announced one.
    fn check_count(&self, element: usize, found: usize, what: &str) -> Result<(), MeshError> {
        match self.document.count(element, "count")? {
            Some(count) if count != found => {
                let reason = format!("it announces {count} {what}, and {found} are there");
                Err(self.document.malformed(element, reason))
            }
            _ => Ok(()),
        }
    }

    /// How an element names its vertices, if it has any.
    fn corners(&mut self, element: usize) -> Result<Option<Corners>, MeshError> {
        let document = self.document;
        if document.child(element, "p").is_none() {
            return Ok(None);
        }
        let (mut step, mut vertex) = (0, None);
        for input in document.all(element, "input") {
            let offset = document.count(input, "offset")?.unwrap_or(0);
            // Each input has a number at each corner.
            if offset >= document.nodes[element].children.len() {
                return Err(document.malformed(input, format!("offset {offset} is too large")));
            }
            step = step.max(offset + 1);
            if document.attribute(input, "semantic") == Some("VERTEX")
                && vertex.replace((input, offset)).is_some()
            {
                return Err(document.malformed(element, "it has two inputs VERTEX"));
            }
        }
        let (input, offset) =
            vertex.ok_or_else(|| document.malformed(element, "it has no input VERTEX"))?;
        let vertices = document.named(input, "source", &["vertices", "source"])?;
        let range = match self.vertices.iter().find(|(of, _)| *of == vertices) {
            Some(&(_, range)) => range,
            None => {
                let first = self.positions.len();
                self.add_positions(vertices)?;
                let range = [first, self.positions.len() - first];
                self.vertices.push((vertices, range));
                range
            }
        };
        Ok(Some(Corners { step, offset, vertices: range }))
    }

    /// The vertices that a list names.
    fn list(&self, p: usize, corners: Option<&Corners>) -> Result<Vec<u32>, MeshError> {
        let document = self.document;
        let Some(&Corners { step, offset, vertices: [first, count] }) = corners else {
            return Ok(Vec::new());
        };
        let mut found = Vec::new();
        let mut total = 0;
        for word in document.nodes[p].text.split_ascii_whitespace() {
            if total % step == offset {
                let index: i64 = word.parse().map_err(|_| {
                    document.malformed(p, format!("{} does not name a vertex", quoted(word)))
                })?;
                let vertex = usize::try_from(index).ok().filter(|&vertex| vertex < count);
                let Some(vertex) = vertex.and_then(|v| u32::try_from(first + v).ok()) else {
                    let reason = format!("corner {} names vertex {index} of {count}", total / step);
                    return Err(document.malformed(p, reason));
                };
                found.push(vertex);
            }
            total += 1;
        }
        if total % step != 0 {
            let reason = format!("{total} numbers are no multiple of the {step} of a corner");
            return Err(document.malformed(p, reason));
        }
        Ok(found)
    }

    /// Reads the positions that `vertices` lists, or the source itself.
    fn add_positions(&mut self, vertices: usize) -> Result<(), MeshError> {
        let document = self.document;
        let source = if document.nodes[vertices].name == "vertices" {
            let is_position =
                |&input: &usize| document.attribute(input, "semantic") == Some("POSITION");
            let input = document.all(vertices, "input").find(is_position);
            let input =
                input.ok_or_else(|| document.malformed(vertices, "it has no input POSITION"))?;
            document.named(input, "source", &["source"])?
        } else {
            vertices
        };
        let common = document.child(source, "technique_common");
        let accessor = common.and_then(|common| document.child(common, "accessor"));
        let accessor = accessor.ok_or_else(|| document.malformed(source, "it has no accessor"))?;
        let array = document.named(accessor, "source", &["float_array", "int_array"])?;
        let numbers = document.numbers(array)?;
        if let Some(count) = document.count(array, "count")?
            && count != numbers.len()
        {
            let reason = format!("it announces {count} numbers, and {} are there", numbers.len());
            return Err(document.malformed(array, reason));
        }
        let step = document.count(accessor, "stride")?.unwrap_or(1);
        let axes = self.axes(accessor, step)?;
        let begin = document.count(accessor, "offset")?.unwrap_or(0);
        let count = document.count(accessor, "count")?;
        let count = count.ok_or_else(|| document.malformed(accessor, "it has no count"))?;
        if axes.iter().any(|&axis| axis >= step) {
            return Err(document.malformed(accessor, format!("stride {step} is less than a point")));
        }
        let end = step.checked_mul(count).and_then(|length| length.checked_add(begin));
        // The last point need not fill its step.
        let used = axes.iter().fold(0, |most, &axis| most.max(axis + 1));
        let end = end.and_then(|end| end.checked_sub(if count > 0 { step - used } else { 0 }));
        if end.is_none_or(|end| end > numbers.len()) {
            let reason = format!("{count} points reach beyond its {} numbers", numbers.len());
            return Err(document.malformed(accessor, reason));
        }
        let line = document.nodes[array].line;
        self.positions.reserve(count);
        for vertex in 0..count {
            let at = axes.map(|axis| numbers[begin + vertex * step + axis]);
            self.positions.push(finite(document.file, line, vertex, at)?);
        }
        Ok(())
    }

    /// Which numbers of a point are X, Y and Z.
    fn axes(&self, accessor: usize, step: usize) -> Result<[usize; 3], MeshError> {
        let document = self.document;
        let names: Vec<&str> = document
            .all(accessor, "param")
            .map(|param| document.attribute(param, "name").unwrap_or_default())
            .collect();
        // Some programs leave the names out, or all of it.
        let count = if names.is_empty() { step } else { names.len() };
        if count == 3 && names.iter().all(|name| name.is_empty()) {
            return Ok([0, 1, 2]);
        }
        let axis = |axis: &str| names.iter().position(|name| name.eq_ignore_ascii_case(axis));
        match [axis("X"), axis("Y"), axis("Z")] {
            [Some(x), Some(y), Some(z)] => Ok([x, y, z]),
            _ => Err(document.malformed(accessor, "its params are not X, Y and Z")),
        }
    }
}
