//! The hull hierarchy's sections read anew: records of one to four byte indices.

use crate::check::bytes::{Cursor, check_header, header_word, section as bytes_of, width, word};
use glam::DVec3;

/// A vertex split.
#[derive(Clone, Debug)]
pub struct Split {
    /// The vertex that is replaced.
    pub vertex: u32,
    /// Vertices around it.
    pub ring: Vec<u32>,
    /// Position of the right wing.
    pub right: usize,
    /// Whether the triangles at the right and at the left wing are children of the coarse triangle
    /// before the wing, not of the one after it.
    pub before: [bool; 2],
    /// Claimed greatest distance of the ring and the new vertices from it.
    pub star_radius: f64,
    pub error: f64,
}

/// A record of the level table.
#[derive(Clone, Copy, Debug)]
pub struct Level {
    /// Triangles of the hull.
    pub faces: u32,
    /// Splits that make it.
    pub splits: u32,
    /// Claimed greatest distance from the hull to the surface.
    pub hull_to_surface: f32,
    /// And from the surface to the triangles that stand for it.
    pub surface_to_hull: f32,
    /// Void over the surface's volume.
    pub void_ratio: f32,
}

/// All that a blob holds, in the local frame.
#[derive(Clone, Debug)]
pub struct Blob {
    /// Input coordinate = local coordinate × 2^this.
    pub(super) scale_exponent: i32,
    /// Triangles of the input file.
    pub(super) input_triangles: u32,
    /// Claimed Hausdorff distance of input and surface.
    pub(super) surface_error: f64,
    /// Whether finer levels were cut off.
    pub is_cut: bool,
    /// Whether its levels claim to enclose the surface.
    pub(super) encloses: bool,
    /// Vertices of the base hull.
    pub base_vertices: u32,
    /// Coordinates, exact.
    pub vertices: Vec<[f64; 3]>,
    /// Triangles of the base hull.
    pub base: Vec<[u32; 3]>,
    /// Bounds of sixteen base triangles each.
    pub groups: Vec<([u32; 3], f64)>,
    /// Splits, coarse to fine.
    pub splits: Vec<Split>,
    /// The split of each vertex.
    pub splits_with: Vec<Option<u32>>,
    /// Radius codes, one byte each.
    pub radii: Vec<u8>,
    /// Triangles of the surface that come before the splits 0, 8, 16 and so on.
    pub source_starts: Vec<u32>,
    /// Numbers of the surface's triangles in the input file.
    pub source: Vec<u32>,
    /// Triangles of the surface, those that no split removes, in the order of their numbers.
    pub surface: Vec<[u32; 3]>,
    /// Levels.
    pub levels: Vec<Level>,
    /// Box of all vertices: least, greatest.
    pub hull_box: [[f64; 3]; 2],
    /// Box of the surface.
    pub surface_box: [[f64; 3]; 2],
    /// Queue entries that a sweep may need, as claimed.
    pub queue_capacity: u32,
    /// Longest chain of splits, as claimed.
    pub dependency_depth: u32,
}

fn bfloat(code: u32) -> f64 {
    f64::from(f32::from_bits(code << 16))
}

/// A radius of one byte: 1 is 2^-29, eight steps for each octave; 0 is zero, 255 infinity.
pub(super) fn small_radius(code: u8) -> f64 {
    match code {
        0 => 0.0,
        255 => f64::INFINITY,
        _ => {
            let steps = i32::from(code) - 1;
            (1.0 + f64::from(steps % 8) / 8.0) * 2f64.powi(steps / 8 - 29)
        }
    }
}

impl Blob {
    /// Reads all sections and follows no reference.
    ///
    /// # Errors
    /// A section is missing, damaged or of the wrong length.
    pub fn parse(bytes: &[u8]) -> Result<Blob, String> {
        check_header(bytes)?;
        let at = |offset: usize| header_word(bytes, offset);
        let section = |kind: u32, name: &'static str| -> Result<Cursor<'_>, String> {
            Ok(Cursor(bytes_of(bytes, kind, name)?, name))
        };
        let corner = |offset: usize| -> Result<[f64; 3], String> {
            let mut p = [0.0; 3];
            for (k, x) in p.iter_mut().enumerate() {
                *x = f64::from(f32::from_bits(at(offset + 4 * k)?));
            }
            Ok(p)
        };
        let counts = [at(52)?, at(56)?, at(60)?, at(64)?, at(68)?, at(76)?, at(80)?];
        let [vertices, base_vertices, base, splits, rings, surface, levels] = counts;
        if vertices != base_vertices + 2 * splits {
            return Err("vertices are not those of the base and two for each split".into());
        }
        let (wv, ws, wr, wt) = (width(vertices), width(splits), width(rings), width(surface));
        let (is_cut, encloses) = (at(24)? & 1 != 0, at(24)? & 2 == 0);
        let numbers =
            |kind: u32, name: &'static str, count: u32, width: usize| -> Result<Vec<u32>, String> {
                let mut cursor = section(kind, name)?;
                let read = (0..count).map(|_| cursor.uint(width)).collect::<Result<_, _>>()?;
                cursor.end()?;
                Ok(read)
            };
        let triples =
            |kind: u32, name: &'static str, count: u32| -> Result<Vec<[u32; 3]>, String> {
                let mut cursor = section(kind, name)?;
                let read = (0..count).map(|_| cursor.triple(wv)).collect::<Result<_, _>>()?;
                cursor.end()?;
                Ok(read)
            };

        let mut cursor = section(11, "base groups")?;
        let mut groups = Vec::new();
        for _ in 0..base.div_ceil(16) {
            groups.push((cursor.triple(wv)?, bfloat(cursor.uint(2)?)));
        }
        cursor.end()?;

        let mut cursor = section(6, "splits with")?;
        let none = u32::MAX >> (32 - 8 * ws);
        let mut splits_with = Vec::new();
        for _ in 0..vertices {
            splits_with.push(Some(cursor.uint(ws)?).filter(|&s| s != none));
        }
        cursor.end()?;

        let mut cursor = section(10, "levels")?;
        let mut read_levels = Vec::new();
        for _ in 0..levels {
            read_levels.push(Level {
                faces: cursor.uint(4)?,
                splits: cursor.uint(4)?,
                hull_to_surface: cursor.float()?,
                surface_to_hull: cursor.float()?,
                void_ratio: cursor.float()?,
            });
        }
        cursor.end()?;

        let radii = section(5, "radii")?.0.to_vec();
        if radii.len() as u64 != u64::from(base) + u64::from(rings) + 2 * u64::from(splits) {
            return Err("radii: not one for each triangle".into());
        }
        let starts = if is_cut { 0 } else { splits.div_ceil(8) };
        let mut blob = Blob {
            scale_exponent: at(28)?.cast_signed(),
            input_triangles: at(84)?,
            surface_error: f64::from(f32::from_bits(at(88)?)),
            is_cut,
            encloses,
            base_vertices,
            vertices: read_vertices(bytes, section(1, "vertices")?, vertices)?,
            base: triples(2, "base triangles", base)?,
            groups,
            splits: read_splits(
                section(3, "splits")?,
                section(4, "rings")?,
                [splits, rings],
                [wv, wr],
            )?,
            splits_with,
            radii,
            source_starts: numbers(7, "source starts", starts, wt)?,
            source: numbers(9, "source", surface, width(at(84)?))?,
            surface: Vec::new(),
            levels: read_levels,
            hull_box: [corner(92)?, corner(104)?],
            surface_box: [corner(116)?, corner(128)?],
            queue_capacity: at(140)?,
            dependency_depth: at(144)?,
        };
        if !is_cut {
            let named = blob.triangles().into_iter().zip(0..);
            let finals = named.filter(|&(t, index)| blob.is_final(t) && blob.has_part(index));
            blob.surface = finals.map(|(t, _)| t).collect();
        }
        Ok(blob)
    }

    /// Whether no split removes a triangle.
    pub(super) fn is_final(&self, triangle: [u32; 3]) -> bool {
        triangle.iter().all(|&v| self.splits_with.get(v as usize).is_none_or(Option::is_none))
    }

    /// Whether a triangle claims to stand for a part of the surface. Its number is that of its
    /// radius.
    pub(super) fn has_part(&self, triangle: usize) -> bool {
        self.encloses || self.radii.get(triangle) != Some(&255)
    }

    /// The triangles of all levels, in the order of their radii.
    pub(super) fn triangles(&self) -> Vec<[u32; 3]> {
        let fine = (0..self.splits.len()).flat_map(|index| self.fine(index));
        self.base.iter().copied().chain(fine).collect()
    }

    /// Coordinates of three vertices.
    pub(super) fn corners(&self, triangle: [u32; 3]) -> [[f64; 3]; 3] {
        triangle.map(|v| self.vertices[v as usize])
    }

    /// The same as vectors.
    pub(super) fn places(&self, triangle: [u32; 3]) -> [DVec3; 3] {
        self.corners(triangle).map(DVec3::from)
    }

    /// Triangles that a split brings, in the order of their radii.
    pub(super) fn fine(&self, index: usize) -> Vec<[u32; 3]> {
        let Split { ring, right, .. } = &self.splits[index];
        let origin = self.base_vertices + 2 * index as u32;
        let destination = origin + 1;
        let mut fine: Vec<[u32; 3]> = (0..ring.len())
            .map(|i| {
                [if i < *right { origin } else { destination }, ring[i], ring[(i + 1) % ring.len()]]
            })
            .collect();
        fine.extend([[origin, ring[*right], destination], [origin, destination, ring[0]]]);
        fine
    }
}

fn read_vertices(
    bytes: &[u8],
    mut cursor: Cursor<'_>,
    count: u32,
) -> Result<Vec<[f64; 3]>, String> {
    let at = |offset: usize| word(bytes, offset).unwrap_or(0);
    let width = match at(32) & 0xFF {
        0 => 0,
        1 => 2,
        2 => 3,
        other => return Err(format!("vertex format {other}")),
    };
    let step = 2f64.powi(at(36).cast_signed());
    let mut vertices = Vec::new();
    for _ in 0..count {
        let mut p = [0.0; 3];
        for (k, x) in p.iter_mut().enumerate() {
            *x = if width == 0 {
                f64::from(cursor.float()?)
            } else {
                // Both parts are integers below 2^25: exact.
                (f64::from(cursor.uint(width)?) + f64::from(at(40 + 4 * k).cast_signed())) * step
            };
            if !x.is_finite() {
                return Err("a coordinate is not finite".into());
            }
        }
        vertices.push(p);
    }
    cursor.end()?;
    Ok(vertices)
}

fn read_splits(
    mut records: Cursor<'_>,
    mut rings: Cursor<'_>,
    [splits, ring_entries]: [u32; 2],
    [wv, wr]: [usize; 2],
) -> Result<Vec<Split>, String> {
    let mut heads = Vec::new();
    for _ in 0..splits {
        let (vertex, start) = (records.uint(wv)?, records.uint(wr)?);
        let (wings, star_radius) =
            (records.uint(1)? as usize, small_radius(records.uint(1)? as u8));
        heads.push((vertex, start, wings, [star_radius, small_radius(records.uint(1)? as u8)]));
    }
    records.end()?;
    let mut read = Vec::new();
    for (i, &(vertex, start, wings, [star_radius, error])) in heads.iter().enumerate() {
        let end = heads.get(i + 1).map_or(ring_entries, |next| next.1);
        let length =
            end.checked_sub(start).ok_or(format!("split {i}: its ring ends before it begins"))?;
        let ring: Vec<u32> = (0..length).map(|_| rings.uint(wv)).collect::<Result<_, _>>()?;
        let (right, before) = (wings % 64, [wings & 64 != 0, wings & 128 != 0]);
        if right == 0 || right >= ring.len() {
            return Err(format!("split {i}: its right wing is not in its ring"));
        }
        read.push(Split { vertex, ring, right, before, star_radius, error });
    }
    rings.end()?;
    Ok(read)
}
