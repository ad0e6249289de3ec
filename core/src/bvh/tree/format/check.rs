//! Opening the box tree of a blob, and its check.

use super::header::BvhHeader;
use super::layout::{
    BVH_BYTES, BVH_SIDELESS, BVH_TURNED, FAN_PADDING, FRAME_BYTES, MAX_TREE_DEPTH, MOST_EXPONENT,
    SOURCE_BLOCK, SOURCE_ENTRY_BYTES, SOURCE_PADDING, boxes, lengthens_nothing,
};
use super::leaf::FanLeaf;
use super::leaf_shape::LeafShape;
use super::moments::NodeMoments;
use super::triangle_bits::TriangleBits;
use super::units::Units;
use super::view::Bvh;
use crate::format::Contradiction;
use crate::format::layout::SectionKind;
use crate::format::{Bytes, OpenError, SectionTable, ok};
use crate::geom::fan::WIDTH;
use crate::num::tolerance::{MOST_SURFACE_ERROR, U32};
use crate::num::{SOFT_FLOAT, greater};
use glam::Vec3;

/// Largest coordinate on a grid.
const MAX_GRID: f32 = (1u32 << 25) as f32;

/// Siblings that a walk has begun.
#[derive(Clone, Copy)]
struct Family {
    next: u32,
    end: u32,
    /// Entries on the stack above them.
    waiting: u32,
}

/// Whether a frame lengthens nothing and has known exponents and a zero at the end.
fn is_sound_frame(record: &[u8; FRAME_BYTES]) -> bool {
    let (entries, _) = record.as_chunks::<2>();
    let rows = entries.get(boxes::FRAME_ROWS / 2..).and_then(|rest| rest.first_chunk::<9>());
    let last = record.get(boxes::FRAME_EXPONENTS..).and_then(|rest| rest.first_chunk::<4>());
    let (Some(rows), Some(&[x, y, z, zero])) = (rows, last) else { return false };
    let [a, b, c, d, e, f, g, h, i] = rows.map(i16::from_le_bytes);
    lengthens_nothing(&[[a, b, c], [d, e, f], [g, h, i]])
        && x.max(y).max(z) <= MOST_EXPONENT
        && zero == 0
}

const fn wrong(what: Contradiction) -> Result<(), OpenError> {
    Err(OpenError::Counts { what })
}

const fn missing(section: SectionKind) -> Result<(), OpenError> {
    Err(OpenError::MissingSection { section })
}

const fn is_within(x: i32, least: i32, most: i32) -> bool {
    least <= x && x <= most
}

const fn is_origin(x: i32) -> bool {
    is_within(x, -(1 << 24), (1 << 24) - 0xFFFF)
}

impl<'a> Bvh<'a> {
    /// Opens the box tree of a blob where it lies and checks all of it: CRCs, every link, every
    /// coordinate. Any bytes are safe to open. Other sections are not looked at, so the linker
    /// drops their checks.
    ///
    /// Cost: linear in the tree, no allocation; once per start. Alignment of `bytes` does not
    /// matter.
    ///
    /// # Errors
    /// [`OpenError`]; [`OpenError::MissingSection`] if the blob was built without a tree.
    #[inline(never)]
    pub fn open(bytes: &'a [u8]) -> Result<Bvh<'a>, OpenError> {
        // In place: both are large.
        let opened = SectionTable::open(bytes);
        let table = opened.as_ref().map_err(|&refused| refused)?;
        table.check_crcs(SectionKind::is_bvh)?;
        let placed = Bvh::locate(table);
        if let Ok(tree) = &placed {
            tree.check()?;
        }
        placed
    }

    /// Opens the box tree of an image that was verified before, and checks header, section table
    /// and counts only. It is a constant function: a `static` tree costs no start-up, and the
    /// compiler refuses bytes that are no blob.
    ///
    /// ```
    /// use meshsweep_core::{Budget, Bvh, Scratch};
    /// const PART: Bvh<'static> = match Bvh::open_trusted(include_bytes!(concat!(
    ///     env!("CARGO_MANIFEST_DIR"),
    ///     "/fixtures/groove.msw"
    /// ))) {
    ///     Ok(part) => part,
    ///     Err(_) => panic!("groove.msw has no box tree"),
    /// };
    /// let mut scratch = Scratch::<{ PART.scratch_entries() }>::new();
    /// let near = PART.closest_point([3.0, 0.0, 4.0], Budget::EXACT, &mut scratch)?;
    /// # Ok::<(), meshsweep_core::QueryError>(())
    /// ```
    ///
    /// Verified means: [`open`](Self::open) once accepted these bytes, for example on the host, and
    /// something else guards them since, such as the signature of the firmware. Of bytes that were
    /// changed since, any answer of this tree may be wrong. All the same no question panics in a
    /// release build or reads outside of the bytes, and each ends. A search opens at most twice as
    /// many nodes as the tree has, and one. A closest point without a limit of steps may search
    /// twice on a board without floating point. A question about two trees of n and m nodes opens up to
    /// 81·n·m pairs in each of its searches, of which it has at most three. That may take minutes:
    /// give it a budget of steps. Nothing marks a wrong answer.
    ///
    /// Cost: none in a constant; else some thousand instructions.
    ///
    /// # Errors
    /// [`OpenError`]; [`OpenError::MissingSection`] if the blob was built without a tree.
    pub const fn open_trusted(bytes: &'a [u8]) -> Result<Bvh<'a>, OpenError> {
        let tree = ok!(Bvh::locate(&ok!(SectionTable::open(bytes))));
        ok!(tree.check_counts());
        Ok(tree)
    }

    /// The tree of bytes that were opened before, or lie in a blob that was opened without a check.
    pub(crate) const fn view(bytes: &'a [u8]) -> Result<Bvh<'a>, OpenError> {
        let tree = ok!(Bvh::locate(&ok!(SectionTable::view(bytes))));
        ok!(tree.check_counts());
        Ok(tree)
    }

    #[inline(never)]
    const fn locate(table: &SectionTable<'a>) -> Result<Bvh<'a>, OpenError> {
        let head = table.bytes(SectionKind::Bvh);
        if head.len() != BVH_BYTES {
            return Err(table.malformed(SectionKind::Bvh));
        }
        let header = ok!(BvhHeader::read(Bytes(head)));
        let scale_exponent = table.header.scale_exponent;
        Ok(Bvh {
            header,
            scale_exponent,
            input_triangles: table.header.input_triangles,
            checksum: table.checksum(),
            units: Units::new(&header, scale_exponent),
            grid_bounds: header.grid_bounds(),
            links: ok!(table.records(SectionKind::TreeLinks)),
            frames: ok!(table.records(SectionKind::TreeFrames)),
            boxes: ok!(table.records(SectionKind::TreeBoxes)),
            fans: table.bytes(SectionKind::TreeFans),
            source: Bytes(table.bytes(SectionKind::TreeSource)),
            cones: ok!(table.records(SectionKind::TreeCones)),
            moments: ok!(table.records(SectionKind::TreeMoments)),
            turned: table.bytes(SectionKind::TreeTurned),
            sideless: table.bytes(SectionKind::TreeSideless),
        })
    }

    fn check(&self) -> Result<(), OpenError> {
        self.check_counts()?;
        self.check_nodes()?;
        self.check_boxes()?;
        self.check_moments()?;
        self.check_source()
    }

    #[inline(never)]
    const fn check_counts(&self) -> Result<(), OpenError> {
        let h = &self.header;
        if h.nodes == 0 || h.leaves == 0 || h.triangles == 0 {
            return wrong(Contradiction::EmptyTree);
        }
        let most = u32::MAX / 64;
        if h.nodes > 0xFF_FFFF || h.vertices > most || h.triangles > most {
            return wrong(Contradiction::TreeRecords);
        }
        let [x, y, z] = h.grid_origin;
        let in_range = is_within(self.scale_exponent, -180, 180)
            && is_within(h.grid_exponent, -60, 0)
            && is_origin(x)
            && is_origin(y)
            && is_origin(z);
        if !in_range {
            return wrong(Contradiction::TreeGrid);
        }
        if !(h.surface_error >= 0.0
            && self.units.surface_error <= MOST_SURFACE_ERROR
            && h.star_radius >= 0.0
            && h.star_radius <= 1e7)
        {
            return wrong(Contradiction::TreeError);
        }
        let ([lx, ly, lz], [hx, hy, hz]) = (h.low, h.high);
        if lx > hx || ly > hy || lz > hz {
            return wrong(Contradiction::TreeBox);
        }
        let nodes = h.nodes as usize;
        if h.stack_entries < WIDTH as u32
            || h.stack_entries as usize > nodes.saturating_mul(WIDTH) + WIDTH
        {
            return wrong(Contradiction::TreeScratch);
        }
        if self.links.len() != nodes {
            return missing(SectionKind::TreeLinks);
        }
        if self.frames.len() != nodes && (!self.frames.is_empty() || self.boxes.is_empty()) {
            return missing(SectionKind::TreeFrames);
        }
        if !self.boxes.is_empty() && self.boxes.len() != nodes {
            return missing(SectionKind::TreeBoxes);
        }
        if !self.cones.is_empty() && self.cones.len() != h.leaves as usize {
            return missing(SectionKind::TreeCones);
        }
        if !self.moments.is_empty() && self.moments.len() != nodes {
            return missing(SectionKind::TreeMoments);
        }
        ok!(self.check_bits(self.turned(), BVH_TURNED, SectionKind::TreeTurned));
        ok!(self.check_bits(self.sideless(), BVH_SIDELESS, SectionKind::TreeSideless));
        let padding = FAN_PADDING / 6 * h.vertex_bytes();
        let used = h.vertices as usize * h.vertex_bytes();
        if self.fans.len() != used + padding || !Bytes(self.fans).is_zero(used, padding) {
            return missing(SectionKind::TreeFans);
        }
        Ok(())
    }

    /// A section of bits is there only if the header says so, which takes sides and boxes for
    /// distances. All triangles may be turned without a section. If all were sideless, there would
    /// be no sides.
    const fn check_bits(
        &self,
        bits: TriangleBits<'_>,
        flag: u8,
        section: SectionKind,
    ) -> Result<(), OpenError> {
        let h = &self.header;
        let is_flagged = h.has_flag(flag);
        let may_be = is_flagged && h.has_sides() && !self.frames.is_empty();
        let is_whole = bits.are_all() && flag != BVH_SIDELESS;
        let is_sound = match is_flagged {
            true => may_be && bits.fit(h.triangles) && (bits.are_stored() || is_whole),
            false => !bits.are_stored(),
        };
        if !is_sound {
            return Err(OpenError::MissingSection { section });
        }
        if !bits.ends_with_zeros(h.triangles) {
            return Err(OpenError::Record { section, index: h.triangles });
        }
        Ok(())
    }

    /// Leaves stand in the order of their nodes, without gaps.
    fn check_nodes(&self) -> Result<(), OpenError> {
        let h = &self.header;
        let (mut leaves, mut vertices, mut triangles) = (0u32, 0u32, 0u32);
        for index in 0..h.nodes {
            let bad = OpenError::Record { section: SectionKind::TreeLinks, index };
            let links = self.links(index).ok_or(bad)?;
            let sound = (1..=WIDTH as u32).contains(&links.count) && links.inner <= links.count;
            if !sound {
                return Err(bad);
            }
            if (0..links.inner).any(|child| links.shape(child) != LeafShape(0)) {
                return Err(bad);
            }
            if links.count > links.inner
                && (links.first_vertex, links.first_triangle) != (vertices, triangles)
            {
                return Err(bad);
            }
            for child in links.inner..links.count {
                let shape = links.shape(child);
                if !shape.is_sound() {
                    return Err(bad);
                }
                let leaf = self.leaf_at(vertices, shape).ok_or(bad)?;
                vertices += shape.vertices() as u32;
                triangles += shape.triangles() as u32;
                leaves += 1;
                if vertices > h.vertices {
                    return Err(bad);
                }
                self.check_leaf(&leaf, leaves - 1)?;
            }
            if (links.count..WIDTH as u32).any(|child| links.shape(child) != LeafShape(0)) {
                return Err(bad);
            }
        }
        if (leaves, vertices, triangles) != (h.leaves, h.vertices, h.triangles) {
            return Err(OpenError::Counts { what: Contradiction::TreeLeaves });
        }
        self.check_families()
    }

    /// Families of siblings stand in the order of a depth-first walk. So one walk proves that every
    /// node but the root is the child of exactly one node, which comes before it. It also counts
    /// the entries that a descent may leave on the stack.
    fn check_families(&self) -> Result<(), OpenError> {
        let mut open = [Family { next: 0, end: 1, waiting: 0 }; MAX_TREE_DEPTH];
        let (mut depth, mut fresh, mut most) = (0usize, 1u32, 0u32);
        while let Some(family) = open.get_mut(depth) {
            if family.next == family.end {
                let Some(up) = depth.checked_sub(1) else { break };
                depth = up;
                continue;
            }
            let (index, waiting) = (family.next, family.waiting);
            family.next += 1;
            let bad = OpenError::Record { section: SectionKind::TreeLinks, index };
            let links = self.links(index).ok_or(bad)?;
            let waiting = waiting + links.count.saturating_sub(1);
            most = most.max(waiting);
            if links.inner > 0 {
                if links.first_node != fresh || links.inner > self.header.nodes - fresh {
                    return Err(bad);
                }
                fresh += links.inner;
                depth += 1;
                *open
                    .get_mut(depth)
                    .ok_or(OpenError::Counts { what: Contradiction::TreeDepth })? =
                    Family { next: links.first_node, end: fresh, waiting };
            }
        }
        if fresh != self.header.nodes {
            return Err(OpenError::Counts { what: Contradiction::TreeOrphan });
        }
        // The descent stores all eight lanes, then keeps the wanted ones.
        if self.header.stack_entries < most + WIDTH as u32 {
            return Err(OpenError::Counts { what: Contradiction::TreeScratch });
        }
        Ok(())
    }

    /// Frames make no distance longer and lie near the model, and every number keeps to the range
    /// for which bounds are proved.
    fn check_boxes(&self) -> Result<(), OpenError> {
        let h = &self.header;
        let (low, high) = (h.low.map(i32::from), h.high.map(i32::from));
        let sizes = low.iter().zip(&high).map(|(low, high)| high - low);
        let size = sizes.fold(0, greater);
        let near_model = |record: &[u8; FRAME_BYTES]| {
            let (origin, _) = record[boxes::FRAME_ORIGIN..].as_chunks::<2>();
            origin.iter().zip(low.iter().zip(&high)).all(|(x, (low, high))| {
                let x = i32::from(u16::from_le_bytes(*x));
                low - size / 4 <= x && x <= high + size / 4
            })
        };
        for (index, record) in (0u32..).zip(self.frames) {
            if !is_sound_frame(record) || !near_model(record) {
                return Err(OpenError::Record { section: SectionKind::TreeFrames, index });
            }
        }
        let origin = |x: f32| x.abs() <= MAX_GRID;
        for (index, record) in (0u32..).zip(self.boxes) {
            let (words, _) = record.as_chunks::<4>();
            let sound = words.iter().skip(boxes::ORIGIN / 4).enumerate().all(|(at, word)| {
                let x = f32::from_le_bytes(*word);
                if at < 3 { origin(x) } else { (0.0..=MAX_GRID).contains(&x) }
            });
            if !sound {
                return Err(OpenError::Record { section: SectionKind::TreeBoxes, index });
            }
        }
        Ok(())
    }

    fn check_moments(&self) -> Result<(), OpenError> {
        let sound = |record| NodeMoments::read(record).is_sound();
        match (0u32..).zip(self.moments).find(|(_, record)| !sound(record)) {
            None => Ok(()),
            Some((index, _)) => Err(OpenError::Record { section: SectionKind::TreeMoments, index }),
        }
    }

    fn check_leaf(&self, leaf: &FanLeaf<'_>, index: u32) -> Result<(), OpenError> {
        let sound = if SOFT_FLOAT && !leaf.is_f32() {
            self.is_sound_on_grid(leaf) == Some(true)
        } else {
            self.is_sound(leaf)
        };
        if sound {
            Ok(())
        } else {
            Err(OpenError::Record { section: SectionKind::TreeFans, index })
        }
    }

    /// All vertices lie in the model's box, and no triangle is larger than the header says.
    fn is_sound(&self, leaf: &FanLeaf<'_>) -> bool {
        let inside = |p: Vec3| self.is_inside(p);
        let shape = leaf.shape();
        let centres = [leaf.centre(0), leaf.centre(shape.centres() - 1)];
        let mut sound = inside(centres[0]) & inside(centres[1]);
        let mut from = leaf.ring(0);
        sound &= inside(from);
        for lane in 0..shape.triangles() {
            let centre = centres[usize::from(lane >= shape.turn())];
            let to = leaf.ring(lane + 1);
            let norm = |v: Vec3| v.x.abs() + v.y.abs() + v.z.abs();
            // Exact on a grid; else off by a few roundings, for which the bounds with `star_radius`
            // have room.
            let size = norm(from - centre) + norm(to - centre);
            sound &= inside(to) & (size <= self.header.star_radius * (1.0 + 8.0 * U32));
            from = to;
        }
        sound
    }

    /// Whether a vertex lies in the model's box. A call, because it is asked at four places.
    #[cfg_attr(not(meshsweep_wide), inline(never))]
    fn is_inside(&self, p: Vec3) -> bool {
        let (low, high) = self.grid_bounds;
        p.cmpge(low).all() & p.cmple(high).all()
    }

    /// [`is_sound`](Self::is_sound) on a grid in integers, for targets without floating point.
    fn is_sound_on_grid(&self, leaf: &FanLeaf<'_>) -> Option<bool> {
        let (h, ring, shape) = (&self.header, leaf.grid_ring()?, leaf.shape());
        let (low, high) = (h.low.map(i32::from), h.high.map(i32::from));
        let inside = |[x, y, z]: [i32; 3]| {
            let ([lx, ly, lz], [hx, hy, hz]) = (low, high);
            let within = |x: i32, low: i32, high: i32| low <= x && x <= high;
            within(x, lx, hx) & within(y, ly, hy) & within(z, lz, hz)
        };
        let norm = |[x, y, z]: [i32; 3], [cx, cy, cz]: [i32; 3]| {
            (x - cx).abs() + (y - cy).abs() + (z - cz).abs()
        };
        let mut sound = inside(ring.centres[0]) & inside(ring.centres[1]);
        let mut largest = 0;
        let (mut centre, mut before) = (ring.centres[0], 0);
        for (i, ((x, y), z)) in ring.x.iter().zip(ring.y).zip(ring.z).enumerate() {
            let vertex = [x, y, z].map(|pair| i32::from(u16::from_le_bytes(*pair)));
            sound &= inside(vertex);
            let here = norm(vertex, centre);
            if i > 0 {
                largest = greater(largest, before + here);
            }
            before = here;
            if i == shape.turn() {
                centre = ring.centres[1];
                before = norm(vertex, centre);
            }
        }
        Some(sound && largest as f32 <= h.star_radius * (1.0 + 8.0 * U32))
    }

    fn check_source(&self) -> Result<(), OpenError> {
        let missing = OpenError::MissingSection { section: SectionKind::TreeSource };
        let triangles = self.header.triangles as usize;
        let directory = triangles.div_ceil(SOURCE_BLOCK) * SOURCE_ENTRY_BYTES;
        let mut end = directory;
        for block in 0..triangles.div_ceil(SOURCE_BLOCK) {
            let word = self.source.u32(block * SOURCE_ENTRY_BYTES + 4).ok_or(missing)?;
            let entries = (triangles - block * SOURCE_BLOCK).min(SOURCE_BLOCK);
            if (word >> 5) as usize != end {
                return Err(OpenError::Record {
                    section: SectionKind::TreeSource,
                    index: block as u32,
                });
            }
            end += (entries * (word & 31) as usize).div_ceil(8);
        }
        if self.source.len() != end + SOURCE_PADDING {
            return Err(missing);
        }
        for index in 0..self.header.triangles {
            if self.source(index).is_none_or(|s| s >= self.input_triangles) {
                return Err(OpenError::Record { section: SectionKind::TreeSource, index });
            }
        }
        Ok(())
    }
}
