//! PLY and STL as far as hulls and meshes of triangles need them.

use std::collections::HashMap;

/// Triangles by vertex number. Coordinates are the single-precision numbers nearest to what the
/// file has.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// Vertices.
    pub positions: Vec<[f64; 3]>,
    /// Corners.
    pub triangles: Vec<[u32; 3]>,
}

impl Surface {
    /// Of arrays in memory.
    #[must_use]
    pub fn new(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Self {
        Self {
            positions: positions.iter().map(|p| p.map(f64::from)).collect(),
            triangles: triangles.to_vec(),
        }
    }

    pub(super) fn corners(&self, triangle: [u32; 3]) -> [[f64; 3]; 3] {
        triangle.map(|v| self.positions[v as usize])
    }
}

/// Reads PLY or STL, told by their first bytes.
///
/// # Errors
/// What is wrong with the file, or not understood.
pub fn read_surface(bytes: &[u8]) -> Result<Surface, String> {
    let surface = if bytes.starts_with(b"ply") { ply(bytes)? } else { stl(bytes)? };
    let vertices = surface.positions.len();
    if surface.triangles.iter().flatten().any(|&v| v as usize >= vertices) {
        return Err("a triangle names a vertex that does not exist".into());
    }
    if surface.positions.iter().flatten().any(|x| !x.is_finite()) {
        return Err("a coordinate is not finite".into());
    }
    Ok(surface)
}

struct Element {
    name: String,
    count: usize,
    /// Type of the count if it is a list, type, name.
    properties: Vec<(Option<String>, String, String)>,
}

fn ply(bytes: &[u8]) -> Result<Surface, String> {
    let end = b"end_header";
    let at = bytes.windows(end.len()).position(|w| w == end).ok_or("no end_header")?;
    let body =
        at + bytes[at..].iter().position(|&b| b == b'\n').ok_or("nothing after the header")? + 1;
    let header = std::str::from_utf8(&bytes[..at]).map_err(|e| e.to_string())?;
    let mut elements: Vec<Element> = Vec::new();
    let mut binary = false;
    for line in header.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            ["format", "ascii", _] => binary = false,
            ["format", "binary_little_endian", _] => binary = true,
            ["format", other, _] => return Err(format!("format {other}")),
            ["element", name, count] => {
                let count = count.parse().map_err(|_| format!("count {count}"))?;
                elements.push(Element { name: name.into(), count, properties: Vec::new() });
            }
            ["property", "list", count, kind, name] => {
                let element = elements.last_mut().ok_or("a property of nothing")?;
                element.properties.push((Some(count.into()), kind.into(), name.into()));
            }
            ["property", kind, name] => {
                let element = elements.last_mut().ok_or("a property of nothing")?;
                element.properties.push((None, kind.into(), name.into()));
            }
            _ => {}
        }
    }
    let mut words = Vec::new();
    if !binary {
        let text = std::str::from_utf8(&bytes[body..]).map_err(|e| e.to_string())?;
        words = text.split_whitespace().collect();
    }
    let mut numbers = Numbers { binary, bytes: &bytes[body..], words: words.into_iter() };
    let mut surface = Surface::default();
    for element in &elements {
        for _ in 0..element.count {
            let mut position = [0.0; 3];
            for (count, kind, name) in &element.properties {
                let list = match count {
                    Some(count) => {
                        let length = numbers.next(count)? as usize;
                        (0..length).map(|_| numbers.next(kind)).collect::<Result<Vec<_>, _>>()?
                    }
                    None => vec![numbers.next(kind)?],
                };
                match (element.name.as_str(), name.as_str(), &list[..]) {
                    ("vertex", "x", [x]) => position[0] = *x,
                    ("vertex", "y", [y]) => position[1] = *y,
                    ("vertex", "z", [z]) => position[2] = *z,
                    ("face", "vertex_indices" | "vertex_index", [first, rest @ ..]) => {
                        // A polygon is its triangles about the first corner.
                        let fan =
                            rest.windows(2).map(|w| [*first as u32, w[0] as u32, w[1] as u32]);
                        surface.triangles.extend(fan);
                    }
                    _ => {}
                }
            }
            if element.name == "vertex" {
                surface.positions.push(position.map(|x| f64::from(x as f32)));
            }
        }
    }
    Ok(surface)
}

struct Numbers<'a> {
    binary: bool,
    bytes: &'a [u8],
    words: std::vec::IntoIter<&'a str>,
}

impl Numbers<'_> {
    fn next(&mut self, kind: &str) -> Result<f64, String> {
        if !self.binary {
            let word = self.words.next().ok_or("the file ends early")?;
            return match kind {
                // Straight to single precision: rounding twice is another number.
                "float" | "float32" => {
                    word.parse::<f32>().map(f64::from).map_err(|_| format!("number {word}"))
                }
                _ => word.parse().map_err(|_| format!("number {word}")),
            };
        }
        let number = match kind {
            "char" | "int8" => f64::from(i8::from_le_bytes(self.take()?)),
            "uchar" | "uint8" => f64::from(u8::from_le_bytes(self.take()?)),
            "short" | "int16" => f64::from(i16::from_le_bytes(self.take()?)),
            "ushort" | "uint16" => f64::from(u16::from_le_bytes(self.take()?)),
            "int" | "int32" => f64::from(i32::from_le_bytes(self.take()?)),
            "uint" | "uint32" => f64::from(u32::from_le_bytes(self.take()?)),
            "float" | "float32" => f64::from(f32::from_le_bytes(self.take()?)),
            "double" | "float64" => f64::from_le_bytes(self.take()?),
            _ => return Err(format!("type {kind}")),
        };
        Ok(number)
    }

    fn take<const N: usize>(&mut self) -> Result<[u8; N], String> {
        let (first, rest) = self.bytes.split_first_chunk().ok_or("the file ends early")?;
        self.bytes = rest;
        Ok(*first)
    }
}

/// Vertices at the same place are one.
fn stl(bytes: &[u8]) -> Result<Surface, String> {
    let count =
        bytes.get(80..84).and_then(|b| b.try_into().ok()).map(|b| u32::from_le_bytes(b) as usize);
    let corners: Vec<[f32; 3]> = match count {
        Some(count) if bytes.len() == 84 + 50 * count => {
            let single = |b: &[u8]| b.try_into().map(f32::from_le_bytes).unwrap_or(f32::NAN);
            let of = |facet: &[u8]| {
                [0, 1, 2].map(|c| [0, 1, 2].map(|k| single(&facet[12 + 12 * c + 4 * k..][..4])))
            };
            bytes[84..].chunks_exact(50).flat_map(of).collect()
        }
        _ => {
            let text = std::str::from_utf8(bytes).map_err(|e| e.to_string())?;
            let mut corners = Vec::new();
            for line in text.lines() {
                let words: Vec<&str> = line.split_whitespace().collect();
                if let ["vertex", x, y, z] = words[..] {
                    let [x, y, z] =
                        [x, y, z].map(|w| w.parse::<f32>().map_err(|_| format!("number {w}")));
                    corners.push([x?, y?, z?]);
                }
            }
            corners
        }
    };
    let mut number: HashMap<[u32; 3], u32> = HashMap::new();
    let mut surface = Surface::default();
    let mut ids = Vec::new();
    for corner in corners {
        // Both zeros are one place.
        let place = corner.map(|x| (x + 0.0).to_bits());
        ids.push(*number.entry(place).or_insert_with(|| {
            surface.positions.push(corner.map(f64::from));
            surface.positions.len() as u32 - 1
        }));
    }
    surface.triangles = ids.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect();
    Ok(surface)
}
