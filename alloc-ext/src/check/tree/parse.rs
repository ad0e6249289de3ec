//! The box tree's sections read anew.

use std::ops::Range;

use crate::check::bytes::{check_header, header_word, section, word};
use crate::check::input::Stored;

/// A leaf: vertices as stored, centres first.
#[derive(Clone, Debug)]
pub(super) struct Leaf {
    /// Grid units, exact.
    pub(super) vertices: Vec<[f64; 3]>,
    centres: usize,
    /// First triangle of the second fan.
    turn: Option<usize>,
    /// Whether the second fan runs against the input's winding.
    reversed: bool,
    /// Number of its first triangle in the blob.
    pub(super) first_triangle: usize,
}

impl Leaf {
    /// Triangles.
    pub(super) fn triangles(&self) -> usize {
        self.vertices.len() - self.centres - 1
    }

    /// Corners of a triangle by their places in `vertices`: the centre first, in the input's
    /// winding.
    pub(super) fn corners(&self, triangle: usize) -> [usize; 3] {
        let second = self.turn.is_some_and(|turn| triangle >= turn);
        let (here, next) = (self.centres + triangle, self.centres + triangle + 1);
        match second && self.reversed {
            true => [1, next, here],
            false => [usize::from(second), here, next],
        }
    }
}

/// A node: children are nodes, then leaves.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub(super) nodes: Range<usize>,
    pub(super) leaves: Range<usize>,
}

impl Node {
    pub(super) fn children(&self) -> usize {
        self.nodes.len() + self.leaves.len()
    }
}

/// Boxes of a node's children: along an axis a point p lies at `row · (p − origin)`, and plane b at
/// `(b − 128) · step`.
#[derive(Clone, Debug)]
pub(super) struct Boxes {
    /// By child, by axis: least, greatest.
    pub(super) bounds: [[[u8; 2]; 3]; 8],
    /// In units of 2^-13.
    pub(super) rows: [[i16; 3]; 3],
    pub(super) origin: [f64; 3],
    /// Grid units.
    pub(super) step: [f64; 3],
}

/// Axis-aligned boxes: plane b of an axis lies at `origin + (b − 128) · step`.
#[derive(Clone, Debug)]
pub(super) struct Slabs {
    pub(super) bounds: [[[u8; 2]; 3]; 8],
    pub(super) origin: [f32; 3],
    pub(super) step: [f32; 3],
}

/// Moments of a node, grid units.
#[derive(Clone, Debug)]
pub(super) struct Moments {
    pub(super) centre: [f32; 3],
    pub(super) radius: f32,
    pub(super) area: [f32; 3],
    /// xx, xy, xz, yy, yz.
    pub(super) first: [f32; 5],
    pub(super) spread: f32,
    pub(super) area_error: f32,
    pub(super) boundary: f32,
}

/// All that the sections hold.
#[derive(Clone, Debug)]
pub(super) struct TreeBlob {
    pub(super) scale_exponent: i32,
    pub(super) input_triangles: u32,
    pub(super) closed: bool,
    pub(super) sides_lost: bool,
    pub(super) grid_exponent: i32,
    /// Box of all vertices, grid units.
    pub(super) bounds: [[f64; 3]; 2],
    pub(super) stack_entries: usize,
    /// Local frame.
    pub(super) surface_error: f64,
    /// Grid units.
    pub(super) star_radius: f64,
    pub(super) nodes: Vec<Node>,
    pub(super) leaves: Vec<Leaf>,
    /// Empty or one for each node.
    pub(super) frames: Vec<Boxes>,
    /// Empty or one for each node.
    pub(super) slabs: Vec<Slabs>,
    /// Empty or one for each node.
    pub(super) moments: Vec<Moments>,
    /// For each triangle whether sides are those of the triangle turned.
    pub(super) turned: Vec<bool>,
    /// For each triangle whether it tells no side.
    pub(super) sideless: Vec<bool>,
    /// Empty or one for each leaf: an axis, and the sine of its angle in units of 1/254; 255 is
    /// unknown.
    pub(super) cones: Vec<([i8; 3], u8)>,
    /// The blob's box of the surface, local frame; none if it is that of a hull hierarchy.
    pub(super) surface_box: Option<[[f64; 3]; 2]>,
    /// For each triangle its number in the input.
    pub(super) source: Vec<u32>,
}

fn float(record: &[u8], at: usize) -> f32 {
    word(record, at).map_or(f32::NAN, f32::from_bits)
}

fn floats(record: &[u8], at: usize) -> [f32; 3] {
    [0, 4, 8].map(|k| float(record, at + k))
}

/// Six rows of eight bytes: least and greatest by axis.
fn bounds(record: &[u8]) -> [[[u8; 2]; 3]; 8] {
    std::array::from_fn(|lane| {
        std::array::from_fn(|axis| [record[16 * axis + lane], record[16 * axis + 8 + lane]])
    })
}

/// Records of a section that has one for each node, or none.
fn records<'a>(
    body: &'a [u8],
    bytes: usize,
    nodes: usize,
    name: &str,
) -> Result<Vec<&'a [u8]>, String> {
    if body.is_empty() || body.len() == bytes * nodes {
        Ok(body.chunks_exact(bytes).collect())
    } else {
        Err(format!("{name}: not one for each of {nodes}"))
    }
}

impl TreeBlob {
    /// Reads all sections. Leaves are found through the links, so that vertices and triangles that
    /// no node names are an error.
    pub(super) fn parse(bytes: &[u8]) -> Result<Self, String> {
        check_header(bytes)?;
        let at = |offset: usize| header_word(bytes, offset);
        let head = section(bytes, 12, "the tree's header")?;
        if head.len() != 64 {
            return Err("no box tree".into());
        }
        let count = |offset: usize| word(head, offset).unwrap_or(0) as usize;
        let short = |offset: usize| u16::from_le_bytes([head[offset], head[offset + 1]]);
        let origin =
            [8, 12, 16].map(|offset| f64::from(word(head, offset).unwrap_or(0).cast_signed()));
        let corner = |from: usize| [0, 1, 2].map(|k| f64::from(short(from + 2 * k)) + origin[k]);
        let [nodes, leaf_count, vertices, triangles] = [20, 24, 28, 32].map(count);
        let links = section(bytes, 13, "links")?;
        if links.len() != 20 * nodes {
            return Err("not one link record for each node".into());
        }
        let fans = Fans { body: section(bytes, 16, "fans")?, single: head[1] & 2 != 0, origin };
        let padding = if fans.single { 96 } else { 48 };
        if fans.body.len() != vertices * fans.vertex_bytes() + padding {
            return Err("fans: not one record for each vertex".into());
        }
        let mut read = Vec::new();
        let mut leaves: Vec<Leaf> = Vec::new();
        let mut found = (0, 0);
        for (index, record) in links.chunks_exact(20).enumerate() {
            let (head, first_vertex) = (word(record, 0).unwrap_or(0), word(record, 4));
            let [inner, all] = [head >> 24 & 15, head >> 28].map(|count| count as usize);
            if !(1..=8).contains(&all)
                || inner > all
                || record[12..12 + inner].iter().any(|&tag| tag != 0)
            {
                return Err(format!("node {index}: {inner} nodes of {all} children"));
            }
            if inner < all && (first_vertex, word(record, 8)) != (Some(found.0), Some(found.1)) {
                return Err(format!("node {index}: its leaves do not follow those before"));
            }
            let from = leaves.len();
            for &tag in &record[12 + inner..12 + all] {
                let leaf = fans
                    .leaf(tag, found)
                    .ok_or(format!("node {index}: a leaf of shape {tag:#x}"))?;
                found.0 += leaf.vertices.len() as u32;
                found.1 += leaf.triangles() as u32;
                leaves.push(leaf);
            }
            let first = (head & 0xFF_FFFF) as usize;
            read.push(Node { nodes: first..first + inner, leaves: from..leaves.len() });
        }
        if (found.0 as usize, found.1 as usize, leaves.len()) != (vertices, triangles, leaf_count) {
            return Err("leaves, vertices or triangles that no node names".into());
        }
        let frames = records(section(bytes, 14, "frames")?, 76, nodes, "frames")?;
        let slabs = records(section(bytes, 15, "boxes")?, 72, nodes, "boxes")?;
        let moments = records(section(bytes, 24, "moments")?, 60, nodes, "moments")?;
        let cones = records(section(bytes, 18, "normal cones")?, 4, leaf_count, "normal cones")?;
        let bits = |kind: u32, flag: u8, may_be_all: bool, what: &str| {
            let (all, is_flagged) = (section(bytes, kind, what)?, head[1] & flag != 0);
            match all.is_empty() && may_be_all {
                true => Ok(vec![is_flagged; triangles]),
                false => bits(all, is_flagged, triangles).map_err(|why| format!("{what}: {why}")),
            }
        };
        let turned = bits(25, 8, true, "turned triangles")?;
        let sideless = bits(26, 16, false, "sideless triangles")?;
        let local = |offset: usize| -> Result<[f64; 3], String> {
            let [x, y, z] = [0, 4, 8].map(|k| at(offset + k).map(f32::from_bits).map(f64::from));
            Ok([x?, y?, z?])
        };
        let surface_box = match at(60)? {
            0 => Some([local(116)?, local(128)?]),
            _ => None,
        };
        let tree = Self {
            scale_exponent: at(28)?.cast_signed(),
            input_triangles: at(84)?,
            closed: head[1] & 1 != 0,
            sides_lost: head[1] & 4 != 0,
            grid_exponent: word(head, 4).unwrap_or(0).cast_signed(),
            bounds: [corner(48), corner(54)],
            stack_entries: count(36),
            surface_error: f64::from(float(head, 40)),
            star_radius: f64::from(float(head, 44)),
            nodes: read,
            leaves,
            moments: moments
                .into_iter()
                .map(|record| Moments {
                    centre: floats(record, 0),
                    radius: float(record, 12),
                    area: floats(record, 16),
                    first: [28, 32, 36, 40, 44].map(|at| float(record, at)),
                    spread: float(record, 48),
                    area_error: float(record, 52),
                    boundary: float(record, 56),
                })
                .collect(),
            frames: frames
                .into_iter()
                .map(|record| {
                    let short = |at: usize| [record[at], record[at + 1]];
                    let row =
                        |at: usize| [at, at + 2, at + 4].map(|at| i16::from_le_bytes(short(at)));
                    let place = |x: [u8; 2], k: usize| f64::from(u16::from_le_bytes(x)) + origin[k];
                    let upward = bounds(record);
                    Boxes {
                        // High planes are counted down.
                        bounds: upward.map(|axes| axes.map(|[low, high]| [low, 255 - high])),
                        rows: [48, 54, 60].map(row),
                        origin: std::array::from_fn(|k| place(short(66 + 2 * k), k)),
                        step: [72, 73, 74].map(|at| 2f64.powi(i32::from(record[at]))),
                    }
                })
                .collect(),
            slabs: slabs
                .into_iter()
                .map(|record| Slabs {
                    bounds: bounds(record),
                    origin: floats(record, 48),
                    step: floats(record, 60),
                })
                .collect(),
            cones: cones
                .into_iter()
                .map(|record| ([0, 1, 2].map(|k| record[k].cast_signed()), record[3]))
                .collect(),
            surface_box,
            turned,
            sideless,
            source: source(section(bytes, 17, "source numbers")?, triangles)?,
        };
        tree.finite()
    }

    /// Triangles as stored, in the local frame.
    pub(super) fn triangles(&self) -> impl Iterator<Item = Stored> + '_ {
        let step = 2f64.powi(self.grid_exponent);
        let of_leaf = move |leaf: &Leaf| {
            let corners = |t: usize| leaf.corners(t).map(|v| leaf.vertices[v].map(|x| x * step));
            let number = |t: usize| self.source[leaf.first_triangle + t];
            (0..leaf.triangles()).map(|t| (number(t), corners(t))).collect::<Vec<_>>()
        };
        self.leaves.iter().flat_map(of_leaf)
    }

    fn finite(self) -> Result<Self, String> {
        let mut slabs = self.slabs.iter().flat_map(|s| s.origin.iter().chain(&s.step));
        let vertices = self.leaves.iter().flat_map(|leaf| leaf.vertices.as_flattened());
        let bounds = [self.surface_error, self.star_radius];
        let sound = slabs.all(|x| x.is_finite())
            && vertices.chain(&bounds).all(|x| x.is_finite())
            && bounds.iter().all(|&x| x >= 0.0);
        if sound { Ok(self) } else { Err("a number of the tree is not finite".into()) }
    }
}

/// Vertices of the leaves.
struct Fans<'a> {
    body: &'a [u8],
    single: bool,
    origin: [f64; 3],
}

impl Fans<'_> {
    fn vertex_bytes(&self) -> usize {
        if self.single { 12 } else { 6 }
    }

    /// Number `index` of the section, along `axis`.
    fn number(&self, index: usize, axis: usize) -> Option<f64> {
        if self.single {
            return word(self.body, 4 * index).map(|bits| f64::from(f32::from_bits(bits)));
        }
        let stored = self.body.get(2 * index..)?.first_chunk()?;
        Some(f64::from(u16::from_le_bytes(*stored)) + self.origin[axis])
    }

    /// The leaf of a shape: vertices in bits 0–3, start of the second fan in 4–6, its winding in 7.
    /// Centres are stored one after the other, the ring axis by axis.
    fn leaf(&self, tag: u8, (vertex, triangle): (u32, u32)) -> Option<Leaf> {
        let (count, turn) = (usize::from(tag & 15), usize::from(tag >> 4 & 7));
        let centres = if turn == 0 { 1 } else { 2 };
        let ring = count.checked_sub(centres)?;
        let triangles = ring.checked_sub(1)?;
        if !(1..=8).contains(&triangles)
            || turn >= triangles.max(1)
            || (turn == 0 && tag & 0x80 != 0)
        {
            return None;
        }
        let from = 3 * vertex as usize;
        let vertex = |place: [usize; 3]| -> Option<[f64; 3]> {
            let [x, y, z] = place.map(|k| from + k);
            Some([self.number(x, 0)?, self.number(y, 1)?, self.number(z, 2)?])
        };
        let centre = (0..centres).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]);
        let ring = (0..ring).map(|i| [0, 1, 2].map(|axis| 3 * centres + ring * axis + i));
        let vertices = centre.chain(ring).map(vertex).collect::<Option<_>>()?;
        let turn = (turn > 0).then_some(turn);
        Some(Leaf {
            vertices,
            centres,
            turn,
            reversed: tag & 0x80 != 0,
            first_triangle: triangle as usize,
        })
    }
}

/// A bit for each triangle, least bit of a byte first, and zeros to the end of the last byte; or
/// nothing, if the header says so.
fn bits(bits: &[u8], is_there: bool, triangles: usize) -> Result<Vec<bool>, String> {
    if bits.len() != if is_there { triangles.div_ceil(8) } else { 0 } {
        return Err("not a bit for each".into());
    }
    let bit = |k: usize| bits.get(k / 8).is_some_and(|byte| byte >> (k % 8) & 1 != 0);
    if (triangles..8 * bits.len()).any(bit) {
        return Err("more than there are".into());
    }
    Ok((0..triangles).map(bit).collect())
}

/// Blocks of 64 numbers: for each a least one, and 27 bits of place and 5 bits of width of the
/// differences; then these, least bit first.
fn source(body: &[u8], triangles: usize) -> Result<Vec<u32>, String> {
    let numbers = (0..triangles).map(|triangle| {
        let (block, place) = (triangle / 64, triangle % 64);
        let (least, packed) = (word(body, 8 * block)?, word(body, 8 * block + 4)?);
        let (start, width) = ((packed >> 5) as usize, (packed & 31) as usize);
        let bit = |k: usize| Some(u32::from(*body.get(start + k / 8)? >> (k % 8) & 1));
        (0..width).try_fold(least, |sum, k| sum.checked_add(bit(place * width + k)? << k))
    });
    numbers.collect::<Option<_>>().ok_or("source numbers end early".into())
}
