//! Every way of damaging a blob that is worth trying on all of its bytes: cut short, a bit flipped,
//! bytes replaced.

use super::seal;
use super::sections::entry;
use crate::generate::Rng;
use meshsweep::check::Entry;
use meshsweep_core::{OpenError, SectionKind};
use std::collections::HashSet;
use std::mem::{Discriminant, discriminant};

/// Holds that nothing but the whole blob opens, as it is: neither a beginning of it nor one with a
/// bit flipped.
///
/// # Panics
/// If damage opens, a beginning is refused for another reason than its length, or the blob itself
/// does not open.
pub fn assert_only_the_whole_opens(blob: &[u8], open: impl Fn(&[u8]) -> Result<(), OpenError>) {
    for length in 0..blob.len() {
        let error = open(&blob[..length]).expect_err("cut short");
        let says = matches!(error, OpenError::Truncated { found, .. } if found as usize == length);
        assert!(says, "{length}: {error:?}");
    }
    let mut bytes = blob.to_vec();
    for bit in 0..8 * bytes.len() {
        bytes[bit / 8] ^= 1 << (bit % 8);
        assert!(open(&bytes).is_err(), "bit {bit}");
        bytes[bit / 8] ^= 1 << (bit % 8);
    }
    assert_eq!(open(&bytes), Ok(()));
}

/// How many damaged blobs opened, and the kinds of error of those that did not.
#[derive(Clone, Debug, Default)]
pub struct Outcome {
    /// Blobs that opened.
    pub opened: usize,
    /// Blobs that did not.
    pub refused: usize,
    /// Why they did not.
    pub reasons: HashSet<Discriminant<OpenError>>,
}

impl Outcome {
    fn count(&mut self, opened: Result<(), OpenError>) {
        match opened {
            Ok(()) => self.opened += 1,
            Err(error) => {
                self.refused += 1;
                self.reasons.insert(discriminant(&error));
            }
        }
    }
}

/// Flips one bit after the other, checksums made right each time, and has each such blob opened and
/// asked.
pub fn flip_bits(
    blob: &[u8],
    bits: impl Iterator<Item = usize>,
    mut ask: impl FnMut(&[u8]) -> Result<(), OpenError>,
) -> Outcome {
    let mut outcome = Outcome::default();
    for bit in bits {
        let mut flipped = blob.to_vec();
        flipped[bit / 8] ^= 1 << (bit % 8);
        seal(&mut flipped);
        outcome.count(ask(&flipped));
    }
    outcome
}

/// Replaces bytes of a section by any, one or two of them and up to `most` by turns, checksums made
/// right, `runs` times, and has each such blob opened and asked. `section` says which, by the
/// number of the run.
pub fn replace_bytes(
    blob: &[u8],
    (runs, most): (usize, usize),
    rng: &mut Rng,
    section: impl Fn(usize, &mut Rng) -> Entry,
    mut ask: impl FnMut(&[u8]) -> Result<(), OpenError>,
) -> Outcome {
    let mut outcome = Outcome::default();
    for run in 0..runs {
        let mut changed = blob.to_vec();
        for _ in 0..1 + rng.below(if run % 2 == 0 { 2 } else { most }) {
            let section = section(run, rng);
            changed[section.offset as usize + rng.below(section.bytes as usize)] =
                rng.next_u64() as u8;
        }
        seal(&mut changed);
        outcome.count(ask(&changed));
    }
    outcome
}

/// Opens a blob after an edit of one section's bytes, its checksums made right.
///
/// # Errors
/// What `open` says.
///
/// # Panics
/// If the blob has no such section.
pub fn edited<E>(
    mut blob: Vec<u8>,
    kind: SectionKind,
    edit: impl FnOnce(&mut [u8]),
    open: impl FnOnce(&[u8]) -> Result<(), E>,
) -> Result<(), E> {
    let at = entry(&blob, kind as u32);
    edit(&mut blob[at.offset as usize..][..at.bytes as usize]);
    seal(&mut blob);
    open(&blob)
}

/// Holds that damage to header, table and one section of each seed, checksums made right, is
/// refused or safe to ask: every bit of the section's first `bytes` flipped, then `runs` times up
/// to
/// `most` bytes replaced.
///
/// # Panics
/// If too few of the damaged blobs open for the test to mean something, or `ask` panics.
pub fn assert_damage_is_safe(
    seeds: &[Vec<u8>],
    kind: SectionKind,
    bytes: u32,
    (runs, most): (usize, usize),
    ask: impl Fn(&[u8]) -> Result<(), OpenError>,
) {
    let rng = &mut Rng::new(5);
    for blob in seeds {
        let section = entry(blob, kind as u32);
        let [from, to] = [section.offset, section.offset + section.bytes.min(bytes)];
        let bits = (0..8 * 200).chain(8 * from as usize..8 * to as usize);
        let outcome = flip_bits(blob, bits, &ask);
        assert!(outcome.opened > 50 && outcome.reasons.len() >= 6, "{outcome:?}");
        replace_bytes(blob, (runs, most), rng, |_, _| section, &ask);
    }
}
