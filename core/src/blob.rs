//! [`Blob`]: checked once by `open`. Its views of structures then cost no check.

use crate::bvh::tree::format::Bvh;
use crate::bvh_with_sdf::BvhWithSdf;
use crate::curve::format::Curve;
use crate::format::layout::{SectionKind, field};
use crate::format::{Bytes, Header, OpenError, Section, SectionTable, ok, section};
use crate::hull::format::{DeformableHull, Hull};
use crate::query::QueryError;
use crate::sdf::Sdf;
use crate::tight::format::TightHulls;
use crate::tribox::format::Triboxes;

/// A blob whose bytes were checked. Copies are cheap: it borrows the bytes and holds the header.
///
/// If [`Blob::open`] returned `Ok`, then the CRC of every section of a known kind is right, and the
/// `open` of every structure accepts these bytes.
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
    /// [`Bvh::open`], [`Hull::open`], [`DeformableHull::open`], [`TightHulls::open`],
    /// [`Triboxes::open`], [`Curve::open`], [`Sdf::open`].
    ///
    /// Cost: linear in the blob, no allocation; once per start.
    ///
    /// # Errors
    /// [`OpenError`] names what was wanted and what was found.
    #[inline(never)]
    pub fn open(bytes: &'a [u8]) -> Result<Blob<'a>, OpenError> {
        let table = SectionTable::open(bytes)?;
        table.check_crcs(SectionKind::is_hull)?;
        let hull = Hull::locate(&table)?;
        let has = |kind: SectionKind| table.has(kind);
        let kinds = || SectionKind::ALL.into_iter();
        // Any section of the box tree needs the others, so one is enough to check for all.
        let has_bvh = kinds().any(|kind| kind.is_bvh() && has(kind));
        let has_triboxes = has(SectionKind::Triboxes);
        let has_tight_hulls = has(SectionKind::TightHulls);
        let has_curves = kinds().any(|kind| kind.is_curve() && has(kind));
        let has_sdf = has(SectionKind::Sdf);
        let deforms = kinds().any(|kind| kind.is_deform() && has(kind));
        if has_bvh {
            Bvh::open(bytes)?;
        }
        if has_triboxes {
            Triboxes::open(bytes)?;
        }
        if has_tight_hulls {
            TightHulls::open(bytes)?;
        }
        if has_curves {
            Curve::open(bytes)?;
        }
        if has_sdf {
            Sdf::open(bytes)?;
        }
        if deforms {
            DeformableHull::open(bytes)?;
        }
        let has_other = has_bvh || has_triboxes || has_tight_hulls || has_curves || has_sdf;
        if !hull.has_hull() && has_other {
            hull.check_absent()?;
        } else {
            hull.check()?;
        }
        Ok(Blob { header: table.header, bytes })
    }

    /// Checks the CRCs of header, section table and sections of known kinds, and returns the first
    /// of them. It covers the others, so it names the contents of the blob. No record is looked at.
    ///
    /// A constant function: `meshsweep build --emit rust` compares the blob with this number at
    /// compile time. At start-up it tells whether flash has kept the bytes, before
    /// [`Bvh::open_trusted`]. A CRC finds damage, but no intent.
    ///
    /// Cost: a dozen instructions a byte.
    ///
    /// # Errors
    /// [`OpenError`] of the first part that is wrong.
    #[inline(never)]
    pub const fn checksum(bytes: &[u8]) -> Result<u32, OpenError> {
        let table = ok!(SectionTable::open(bytes));
        ok!(table.check_all_crcs());
        Ok(Bytes(bytes).word(field::CRC))
    }

    /// The box tree: distances, sides, segments, overlaps.
    ///
    /// # Errors
    /// [`QueryError::NotServed`] if the blob was built without it.
    pub fn bvh(&self) -> Result<Bvh<'a>, QueryError> {
        Bvh::view(self.bytes).map_err(|_| QueryError::NO_DISTANCES)
    }

    /// The hull hierarchy: nested outer hulls, refined at run time.
    ///
    /// # Errors
    /// [`QueryError::NotServed`] if the blob was built without it.
    pub fn hull(&self) -> Result<Hull<'a>, QueryError> {
        let hull = Hull::view(self.bytes).map_err(|_| QueryError::NO_HULL)?;
        if hull.has_hull() { Ok(hull) } else { Err(QueryError::NO_HULL) }
    }

    /// The hull hierarchy of a mesh that deforms.
    ///
    /// # Errors
    /// [`QueryError::NotServed`] if the blob was not built `--for deform`.
    pub fn deformable_hull(&self) -> Result<DeformableHull<'a>, QueryError> {
        DeformableHull::view(self.bytes).map_err(|_| QueryError::NO_DEFORM)
    }

    /// The tight hulls: outer hulls of few faces.
    ///
    /// # Errors
    /// [`QueryError::NotServed`] if the blob was built without them.
    pub fn tight_hulls(&self) -> Result<TightHulls<'a>, QueryError> {
        TightHulls::view(self.bytes).map_err(|_| QueryError::NO_TIGHT_HULLS)
    }

    /// The triboxes: bounds of eighteen planes.
    ///
    /// # Errors
    /// [`QueryError::NotServed`] if the blob was built without them.
    pub fn triboxes(&self) -> Result<Triboxes<'a>, QueryError> {
        Triboxes::view(self.bytes).map_err(|_| QueryError::NO_TRIBOXES)
    }

    /// The curves: fences, tool paths.
    ///
    /// # Errors
    /// [`QueryError::NotServed`] if the blob was built without them.
    pub fn curve(&self) -> Result<Curve<'a>, QueryError> {
        Curve::view(self.bytes).map_err(|_| QueryError::NO_CURVES)
    }

    /// The distance field.
    ///
    /// # Errors
    /// [`QueryError::NotServed`] if the blob was built without it.
    pub fn sdf(&self) -> Result<Sdf<'a>, QueryError> {
        Sdf::view(self.bytes).map_err(|_| QueryError::NO_SDF)
    }

    /// The box tree and the distance field together: the field is asked first.
    ///
    /// # Errors
    /// [`QueryError::NotServed`] if the blob was built without one of both.
    pub fn bvh_with_sdf(&self) -> Result<BvhWithSdf<'a>, QueryError> {
        Ok(BvhWithSdf::new(self.bvh()?, self.sdf()?))
    }

    /// Sections of the blob, in file order, without those of a kind that this version does not
    /// know.
    pub fn sections(&self) -> impl Iterator<Item = Section> + 'a {
        let bytes = Bytes(self.bytes);
        (0..self.header.section_count).filter_map(move |index| section(bytes, index).ok().flatten())
    }

    /// The blob's bytes.
    pub fn bytes(&self) -> &'a [u8] {
        self.bytes
    }

    /// The number that [`checksum`](Self::checksum) returns.
    #[doc(hidden)]
    pub const fn header_crc(&self) -> u32 {
        Bytes(self.bytes).word(field::CRC)
    }

    /// The fixed header.
    #[doc(hidden)]
    pub fn header(&self) -> &Header {
        &self.header
    }
}
