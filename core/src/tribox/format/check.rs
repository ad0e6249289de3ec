//! Opening the tribox hierarchy of a blob, and the check.

use super::layout::{
    MAX_TRIBOX_DEPTH, MAX_TRIBOXES, TRIBOX_BYTES, TRIBOX_LEVEL_BYTES, TRIBOX_TURN_BYTES,
    TRIBOXES_BYTES, TRIBOXES_TURNED, level,
};
use super::view::{Triboxes, TriboxesHeader, UNSPLIT};
use crate::format::Contradiction;
use crate::format::layout::{MAX_LEVELS, SectionKind};
use crate::format::{Bytes, OpenError, SectionTable};
use crate::num::exp2;
use crate::query::is_turn;
use crate::tribox::directions::FACES;

/// Largest coordinate of the origin, units: with an i16 added no parameter reaches 2^20, so that
/// closure and boundary are exact in f32.
const MAX_ORIGIN: i32 = 1 << 18;

/// Greatest parameter, input units: somewhat above that of a diagonal for coordinates at the end of
/// [`Tribox::DOMAIN`](crate::tribox::Tribox::DOMAIN).
const MAX_PARAMETER: f64 = (1u128 << 122) as f64;

/// Numbers between which parameters bound differences: x, −x, y, −y, z, −z.
const NUMBERS: usize = 6;

/// For numbers i and j which plane bounds number j less number i: 2 · slab + (whether it is the
/// greatest value). On the diagonal and for a number and its negative the axis's own, which counts
/// nothing or twice.
const BOUNDED_BY: [[u8; NUMBERS]; NUMBERS] = {
    let mut planes = [[0u8; NUMBERS]; NUMBERS];
    let mut axis = 0;
    while axis < 3 {
        // −x less x is −2x, at most twice the least value's negative.
        planes[2 * axis][2 * axis + 1] = 2 * axis as u8;
        planes[2 * axis + 1][2 * axis] = 2 * axis as u8 + 1;
        axis += 1;
    }
    // Slabs 3 + 2k and 4 + 2k: first + second, first − second.
    let pairs = [(0, 1), (1, 2), (2, 0)];
    let mut k = 0;
    while k < 3 {
        let (first, second) = pairs[k];
        let (a, b) = (2 * first, 2 * second);
        let (sum, difference) = (2 * (3 + 2 * k) as u8, 2 * (4 + 2 * k) as u8);
        let entries =
            [(b + 1, a, sum + 1), (a, b + 1, sum), (b, a, difference + 1), (a, b, difference)];
        let mut entry = 0;
        while entry < 4 {
            let (i, j, plane) = entries[entry];
            planes[i][j] = plane;
            // j less i is also the negative of i less the negative of j.
            planes[j ^ 1][i ^ 1] = plane;
            entry += 1;
        }
        k += 1;
    }
    planes
};

/// Whether no plane can move inward: no path of differences, and no two bounds of single
/// coordinates, imply a stricter one (see [`Tribox::tightened`](crate::tribox::Tribox::tightened)).
/// Implies that every least value is at most the greatest.
fn is_tight(planes: &[i32; FACES]) -> bool {
    let mut differences = [[0i32; NUMBERS]; NUMBERS];
    for ((i, row), names) in differences.iter_mut().enumerate().zip(&BOUNDED_BY) {
        for ((j, entry), &plane) in row.iter_mut().enumerate().zip(names) {
            let at = planes.get(usize::from(plane)).copied().unwrap_or(0);
            *entry = if i == j { 0 } else { at.wrapping_mul(if j == i ^ 1 { 2 } else { 1 }) };
        }
    }
    let entry =
        |i: usize, j: usize| differences.get(i).and_then(|row| row.get(j)).copied().unwrap_or(0);
    (0..NUMBERS).all(|i| {
        (0..NUMBERS).all(|j| {
            let here = entry(i, j);
            let both = entry(i, i ^ 1).wrapping_add(entry(j ^ 1, j));
            (i == j || here.wrapping_mul(2) <= both)
                && (0..NUMBERS).all(|via| here <= entry(i, via).wrapping_add(entry(via, j)))
        })
    })
}

impl<'a> Triboxes<'a> {
    /// Opens the tribox hierarchy of a blob where it lies, and checks all of it: CRC, every link,
    /// every parameter. Any bytes are safe to open. It reads no other sections, so that the code
    /// that checks them is not linked.
    ///
    /// Cost: linear in the nodes but for walks to the root, some thousand instructions a node; no
    /// allocation; once per start. Alignment of `bytes` does not matter.
    ///
    /// # Errors
    /// [`OpenError`]; [`OpenError::MissingSection`] if the blob was built without triboxes.
    #[inline(never)]
    pub fn open(bytes: &'a [u8]) -> Result<Triboxes<'a>, OpenError> {
        let table = SectionTable::open(bytes)?;
        table.check_crcs(|kind| kind == SectionKind::Triboxes)?;
        let triboxes = Triboxes::locate(&table)?;
        triboxes.check()?;
        Ok(triboxes)
    }

    /// The triboxes of bytes that were checked before.
    pub(crate) fn view(bytes: &'a [u8]) -> Result<Triboxes<'a>, OpenError> {
        Triboxes::locate(&SectionTable::view(bytes)?)
    }

    fn locate(table: &SectionTable<'a>) -> Result<Triboxes<'a>, OpenError> {
        let blob = &table.header;
        let malformed = table.malformed(SectionKind::Triboxes);
        let data = table.bytes(SectionKind::Triboxes);
        let (head, rest) = data.split_at_checked(TRIBOXES_BYTES).ok_or(malformed)?;
        let header = TriboxesHeader::read(Bytes(head))?;
        let wrong = |what: Contradiction| Err(OpenError::Counts { what });
        if header.nodes % 2 == 0 || header.nodes >= 2 * MAX_TRIBOXES {
            return wrong(Contradiction::TriboxCount);
        }
        if !(1..=MAX_LEVELS).contains(&header.levels) || header.depth > MAX_TRIBOX_DEPTH {
            return wrong(Contradiction::TriboxLevels);
        }
        let exponent = blob.scale_exponent.saturating_add(header.grid_exponent);
        // So that units and their halves are numbers of f32, and no sum of two parameters
        // overflows.
        let in_range = (-149..=122).contains(&blob.scale_exponent)
            && (-40..=40).contains(&header.grid_exponent)
            && (-147..=107).contains(&exponent);
        if !in_range || header.grid_origin.iter().any(|o| !(-MAX_ORIGIN..=MAX_ORIGIN).contains(o)) {
            return wrong(Contradiction::TriboxGrid);
        }
        let (turn, rest) = match header.flags & TRIBOXES_TURNED {
            0 => (None, rest),
            _ => {
                let (turn, rest) =
                    rest.split_first_chunk::<TRIBOX_TURN_BYTES>().ok_or(malformed)?;
                (Some(turn), rest)
            }
        };
        let split_count = header.nodes as usize / 2;
        let (levels, rest) =
            rest.split_at_checked(header.levels as usize * TRIBOX_LEVEL_BYTES).ok_or(malformed)?;
        let (splits, nodes) = rest.split_at_checked(2 * split_count).ok_or(malformed)?;
        if nodes.len() != header.nodes as usize * TRIBOX_BYTES {
            return Err(malformed);
        }
        Ok(Triboxes {
            header,
            scale_exponent: blob.scale_exponent,
            unit: exp2(exponent) as f32,
            local: exp2(blob.scale_exponent) as f32,
            turn,
            levels: levels.as_chunks().0,
            splits: splits.as_chunks().0,
            nodes: nodes.as_chunks().0,
        })
    }

    fn check(&self) -> Result<(), OpenError> {
        if self.is_turned() && !is_turn(&self.orientation()) {
            return Err(OpenError::Counts { what: Contradiction::TriboxTurn });
        }
        self.check_levels()?;
        self.check_splits()?;
        for index in 0..self.node_count() {
            let bad = OpenError::Record { section: SectionKind::Triboxes, index };
            let planes = self.planes_in_units(index).ok_or(bad)?;
            let inside = match self.parent(index) {
                Some(parent) => {
                    let around = self.planes_in_units(parent).ok_or(bad)?;
                    planes.iter().zip(&around).all(|(plane, outer)| plane <= outer)
                }
                None => {
                    let unit = exp2(self.scale_exponent.saturating_add(self.header.grid_exponent));
                    planes
                        .iter()
                        .all(|plane| f64::from(plane.unsigned_abs()) * unit <= MAX_PARAMETER)
                }
            };
            let error = self.local_error(index).ok_or(bad)?;
            if !(inside && is_tight(&planes) && error >= 0.0 && error.is_finite()) {
                return Err(bad);
            }
        }
        Ok(())
    }

    fn check_levels(&self) -> Result<(), OpenError> {
        let mut before = 0;
        for record in self.levels {
            let record = Bytes(record);
            let triboxes = record.u32(level::TRIBOXES).unwrap_or(0);
            let fine = |at: usize| record.f32(at).is_some_and(|x| x >= 0.0 && x.is_finite());
            let void = record.f32(level::VOID_RATIO).is_some_and(f32::is_finite);
            if triboxes <= before || !fine(level::DISTANCE) || !fine(level::ERROR) || !void {
                return Err(OpenError::Counts { what: Contradiction::TriboxLevels });
            }
            before = triboxes;
        }
        if before != self.leaf_count() {
            return Err(OpenError::Counts { what: Contradiction::LastTriboxLevel });
        }
        Ok(())
    }

    /// Each split splits one node with a lesser number, and that node names the split. So there is
    /// no cycle, and no node has two parents.
    fn check_splits(&self) -> Result<(), OpenError> {
        let bad = |index: u32| OpenError::Record { section: SectionKind::Triboxes, index };
        for index in 0..self.node_count() {
            let split = self.split_of(index).ok_or(bad(index))?;
            let named = self
                .splits
                .get(usize::from(split))
                .map(|bytes| u32::from(u16::from_le_bytes(*bytes)));
            // The node is not split, or by a later split that names it.
            let sound = match named {
                None => split == UNSPLIT,
                Some(node) => node == index && index <= 2 * u32::from(split),
            };
            if !sound {
                return Err(bad(index));
            }
            // A descent would never reach nodes whose parent does not name the split.
            if let Some(parent) = self.parent(index) {
                let names =
                    self.split_of(parent).is_some_and(|split| u32::from(split) == (index - 1) / 2);
                if parent >= index || !names {
                    return Err(bad(index));
                }
            }
            let (mut above, mut depth) = (self.parent(index), 0);
            while let Some(node) = above {
                depth += 1;
                if depth > self.header.depth {
                    return Err(OpenError::Counts { what: Contradiction::TriboxDepth });
                }
                above = self.parent(node);
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tribox::Tribox;

    #[test]
    fn integers_are_tight_where_the_closure_moves_nothing() {
        let (mut tight, mut slack) = (0, 0);
        let mut state = 0x1234_5678u32;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 20) as f32 - 2048.0
        };
        for _ in 0..2000 {
            let points = [[(); 3]; 3].map(|point| point.map(|()| next()));
            let tribox = Tribox::of_points(points).unwrap();
            for moved in 0..=FACES {
                let mut planes = [0i32; FACES];
                for (slab, (low, high)) in tribox.slabs().enumerate() {
                    (planes[2 * slab], planes[2 * slab + 1]) = (-low as i32, high as i32);
                }
                if moved < FACES {
                    planes[moved] += (next() / 64.0) as i32;
                }
                let at = |k: usize| planes[k] as f32;
                let same = Tribox {
                    low: core::array::from_fn(|slab| -at(2 * slab)),
                    high: core::array::from_fn(|slab| at(2 * slab + 1)),
                };
                let closed = same.tightened() == same && !same.is_empty();
                assert_eq!(is_tight(&planes), closed, "{same:?}");
                (tight, slack) = (tight + u32::from(closed), slack + u32::from(!closed));
            }
        }
        assert!(tight > 2000 && slack > 2000, "{tight} {slack}");
    }
}
