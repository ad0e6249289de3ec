//! The field of the fewest bytes whose intervals are as narrow as allowed.
//!
//! A tree is made of leaves that are narrow enough, with each number of root cells. A lattice is
//! found by halving the range of bytes: drafts are cheap beside a proof. Where a proof widens a
//! cell beyond what is allowed, the lattice takes more bytes.

use super::domain::Domain;
use super::field::{Field, Work};
use super::tree::{self, Narrow};
use crate::error::BuildError;
use crate::progress::Watch;
use meshsweep_core::SdfLayout;
use meshsweep_core::internal::sdf::format::layout::tree as tree_layout;

/// Most root cells of a tree along the longest side. The last are looked at only if the smallest
/// boxes of the others are too large, and not by far: their samples are many.
const ROOTS_TRIED: [usize; 4] = [1, 2, 5, tree_layout::MOST_ROOTS as usize];

/// Bytes of a lattice are found to this part of them.
const NEAREST: f64 = 1.02;

/// Most drafts of lattices.
const DRAFTS: usize = 10;

/// Proofs of lattices, each of more bytes.
const PROOFS: usize = 6;

/// What was found in one layout.
enum Found {
    Field(Field),
    /// None fits the numbers of the layout.
    NoRoom,
    /// It takes so many bytes at least.
    Bytes(usize),
    /// The widest cell of the narrowest takes so much of the allowed width.
    Taken(f64),
}

impl Work<'_> {
    /// The field of the fewest bytes found whose intervals are as narrow as allowed.
    pub(super) fn fewest(&self, error: f64, watch: Watch<'_>) -> Result<Field, BuildError> {
        let is_wanted = |layout| self.options.layout.is_none_or(|wanted| wanted == layout);
        let most = self.options.bytes as usize;
        let tree = match is_wanted(SdfLayout::Tree) {
            true => match self.fewest_tree(most, watch.part(0.0, 0.5)) {
                Err(BuildError::FieldUnit { .. }) if is_wanted(SdfLayout::Lattice) => Found::NoRoom,
                found => found?,
            },
            false => Found::NoRoom,
        };
        let most_of_lattice = match &tree {
            Found::Field(field) => field.report.bytes - 1,
            _ => most,
        };
        let lattice = match is_wanted(SdfLayout::Lattice) {
            true => match self.fewest_lattice(most_of_lattice, watch.part(0.5, 1.0)) {
                Err(BuildError::FieldUnit { .. } | BuildError::FieldTooWide { .. })
                    if matches!(tree, Found::Field(_)) =>
                {
                    Found::NoRoom
                }
                found => found?,
            },
            false => Found::NoRoom,
        };
        let bytes = self.options.bytes;
        let not_narrow = |taken| BuildError::FieldNotNarrow { error, bytes, widest: taken * error };
        let needs = |needed| BuildError::FieldNeedsBytes { error, bytes, needed };
        match (lattice, tree) {
            // The smallest lattice may be larger than a tree of one leaf.
            (Found::Field(a), Found::Field(b)) => {
                Ok(if a.report.bytes <= b.report.bytes { a } else { b })
            }
            (Found::Field(field), _) | (_, Found::Field(field)) => Ok(field),
            (Found::Bytes(n), Found::Bytes(m)) => Err(needs(n.min(m))),
            (Found::Bytes(n), _) | (_, Found::Bytes(n)) => Err(needs(n)),
            (Found::Taken(s), Found::Taken(t)) => Err(not_narrow(s.min(t))),
            (Found::Taken(t), _) | (_, Found::Taken(t)) => Err(not_narrow(t)),
            (Found::NoRoom, Found::NoRoom) => Err(self.too_wide()),
        }
    }

    fn fewest_tree(&self, most_bytes: usize, watch: Watch<'_>) -> Result<Found, BuildError> {
        let (mut best, mut before, mut refused) = (Found::NoRoom, None, None);
        for (number, roots) in ROOTS_TRIED.into_iter().enumerate() {
            let part = |number: usize| number as f64 / ROOTS_TRIED.len() as f64;
            let domain = match Domain::of_roots(&self.surface, self.options.margin, roots) {
                Err(error @ BuildError::FieldUnit { .. }) => {
                    refused = Some(error);
                    continue;
                }
                domain => domain?,
            };
            let is_last = number + 1 == ROOTS_TRIED.len();
            // Boxes that are half as large again take that much more of the width, about.
            let helps = matches!(best, Found::Taken(taken) if taken < 2.0);
            let is_enough = is_last && !helps;
            if is_enough || before.replace(domain) == Some(domain) {
                continue;
            }
            let most_bytes = match &best {
                Found::Field(field) => field.report.bytes - 1,
                _ => most_bytes,
            };
            let watch = watch.part(part(number), part(number + 1));
            let make =
                |maker: &tree::Maker<'_>, watch: Watch<'_>| tree::narrow(maker, most_bytes, watch);
            let found = match self.with_maker(&domain, watch, make) {
                Err(error @ BuildError::FieldUnit { .. }) => {
                    refused = Some(error);
                    continue;
                }
                found => found?,
            };
            best = match (found, best) {
                (Some(Narrow::Tree(tree)), _) => Found::Field(self.of_tree(&domain, tree)),
                (Some(Narrow::Bytes(n)), Found::NoRoom | Found::Taken(_)) => Found::Bytes(n),
                (Some(Narrow::Bytes(n)), Found::Bytes(m)) => Found::Bytes(n.min(m)),
                (Some(Narrow::Taken(t)), Found::NoRoom) => Found::Taken(t),
                (Some(Narrow::Taken(t)), Found::Taken(s)) => Found::Taken(s.min(t)),
                (_, best) => best,
            };
        }
        match (best, refused) {
            (Found::NoRoom, Some(error)) => Err(error),
            (best, _) => Ok(best),
        }
    }

    fn fewest_lattice(&self, most_bytes: usize, watch: Watch<'_>) -> Result<Found, BuildError> {
        let part = |at: usize| at as f64 / (DRAFTS + 2 + PROOFS) as f64;
        let of_stage = |at: usize| watch.part(part(at), part(at + 1));
        let mut best = self.draft(most_bytes, of_stage(0))?;
        if best.taken() > 1.0 {
            return Ok(Found::Taken(best.taken()));
        }
        let mut low = self.draft(0, of_stage(1))?.bytes();
        for draft in 0..DRAFTS {
            let high = best.bytes() as f64;
            if high < low as f64 * NEAREST {
                break;
            }
            let middle = (low as f64 * high).sqrt() as usize;
            let found = self.draft(middle, of_stage(2 + draft))?;
            if found.taken() > 1.0 { low = middle } else { best = found }
        }
        let mut taken = 0.0;
        for proof in 0..PROOFS {
            let bytes = best.bytes();
            let watch = of_stage(DRAFTS + 2 + proof);
            let field;
            (field, taken) = self.proved(best, watch.part(0.0, 0.8))?;
            if taken <= 1.0 {
                return Ok(Found::Field(field));
            }
            let more = bytes + bytes / 16 + 16;
            if more > most_bytes {
                return Ok(Found::Bytes(more));
            }
            best = self.draft(more, watch.part(0.8, 1.0))?;
        }
        Ok(Found::Taken(taken))
    }
}
