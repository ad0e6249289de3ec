//! A blob: opened once, then handed out as views of its structures.

use crate::bvh::format::Bvh;
use crate::format::layout::SectionKind;
use crate::format::{Bytes, Header, OpenError, Section, read_header, section};
use crate::hull::format::Hull;
use crate::query::QueryError;
use crate::tight::format::TightHulls;
use crate::tribox::format::Triboxes;

/// A blob whose bytes were checked. Copies are cheap: it borrows the bytes and holds the header.
///
/// If [`Blob::open`] returned `Ok`, then every section of a known kind has its CRC, and every
/// structure is one that its own `open` accepts.
///
/// ```
/// use meshsweep_core::{Blob, Budget, BuildFor, QueryError, Scratch};
/// let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/groove.msw"));
/// let blob = Blob::open(bytes)?; // checks every byte, once
/// let part = blob.bvh()?; // a view: nothing is checked again
/// let mut scratch = Scratch::<64>::new(); // `part.scratch_entries()` says how many are enough
/// let near = part.closest_point([3.0, 0.0, 4.0], Budget::EXACT, &mut scratch)?;
/// assert!(near.distance.lower <= near.distance.upper);
/// let missing = QueryError::NotServed { build_for: BuildFor::Triboxes };
/// assert_eq!(blob.triboxes().err(), Some(missing));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Blob<'a> {
    header: Header,
    bytes: &'a [u8],
}

impl<'a> Blob<'a> {
    /// Opens a blob where it lies and checks all of it: CRCs, every index, every coordinate, every
    /// order that the queries rely on. Any bytes are safe to open. Their alignment does not matter.
    ///
    /// Firmware with one structure links less code with the structure's own `open`:
    /// [`Bvh::open`], [`Hull::open`], [`TightHulls::open`], [`Triboxes::open`].
    ///
    /// Cost: linear in the blob, no allocation; once per start.
    ///
    /// # Errors
    /// [`OpenError`] names the wanted and the found.
    pub fn open(bytes: &'a [u8]) -> Result<Blob<'a>, OpenError> {
        let blob = Blob { header: read_header(bytes)?, bytes };
        let hull = Hull::place(bytes, true)?;
        let kinds = || SectionKind::ALL.into_iter();
        // Any section of a tree needs the others.
        let has_tree = kinds().any(|kind| kind.is_bvh() && blob.has(kind));
        let has_triboxes = blob.has(SectionKind::Triboxes);
        let has_tight_hulls = blob.has(SectionKind::TightHulls);
        if has_tree {
            Bvh::open(bytes)?;
        }
        if has_triboxes {
            Triboxes::open(bytes)?;
        }
        if has_tight_hulls {
            TightHulls::open(bytes)?;
        }
        if !hull.has_hull() && (has_tree || has_triboxes || has_tight_hulls) {
            hull.check_absent()?;
        } else {
            hull.check()?;
        }
        Ok(blob)
    }

    /// The box tree.
    ///
    /// # Errors
    /// [`QueryError::NotServed`] if the blob was built without it.
    pub fn bvh(&self) -> Result<Bvh<'a>, QueryError> {
        Bvh::view(self.bytes).map_err(|_| QueryError::NO_DISTANCES)
    }

    /// The hull hierarchy.
    ///
    /// # Errors
    /// [`QueryError::NotServed`] if the blob was built without it.
    pub fn hull(&self) -> Result<Hull<'a>, QueryError> {
        let hull = Hull::place(self.bytes, false).map_err(|_| QueryError::NO_HULL)?;
        if hull.has_hull() { Ok(hull) } else { Err(QueryError::NO_HULL) }
    }

    /// The tight hulls.
    ///
    /// # Errors
    /// [`QueryError::NotServed`] if the blob was built without them.
    pub fn tight_hulls(&self) -> Result<TightHulls<'a>, QueryError> {
        TightHulls::view(self.bytes).map_err(|_| QueryError::NO_TIGHT_HULLS)
    }

    /// The triboxes.
    ///
    /// # Errors
    /// [`QueryError::NotServed`] if the blob was built without them.
    pub fn triboxes(&self) -> Result<Triboxes<'a>, QueryError> {
        Triboxes::view(self.bytes).map_err(|_| QueryError::NO_TRIBOXES)
    }

    /// Sections of the blob, in file order. Entries of a kind that this version does not know are
    /// passed over.
    pub fn sections(&self) -> impl Iterator<Item = Section> + 'a {
        let bytes = Bytes(self.bytes);
        (0..self.header.section_count).filter_map(move |index| section(bytes, index).ok().flatten())
    }

    /// The blob's bytes.
    pub fn bytes(&self) -> &'a [u8] {
        self.bytes
    }

    /// The fixed header.
    #[doc(hidden)]
    pub fn header(&self) -> &Header {
        &self.header
    }

    fn has(&self, kind: SectionKind) -> bool {
        self.sections().any(|section| section.kind == kind)
    }
}
