//! A coarser blob out of a finer one: each structure cuts its own sections.

use crate::emit::{Sections, assemble, copied};
use crate::error::BuildError;
use crate::{bvh, hull, tight, tribox};
use meshsweep_core::{Blob, Hull, SectionKind};

/// Parts of a blob to keep. A structure without a number stays as it is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Keep {
    /// The finest level of the hull hierarchy. A box tree and key frames cannot be cut: they are
    /// left out.
    pub level: Option<u32>,
    /// Of the triboxes the finest level of at most so many.
    pub triboxes: Option<u32>,
    /// The tight hulls of at most so many faces, at least the coarsest.
    pub tight: Option<u32>,
}

impl Keep {
    setters! { optional
        /// Sets the [finest level](Self::level).
        with_level: u32 => level,
        /// Sets the number of [triboxes](Self::triboxes).
        with_triboxes: u32 => triboxes,
        /// Sets the number of faces of [tight hulls](Self::tight).
        with_tight: u32 => tight,
    }
}

/// A blob that was cut.
///
/// # Errors
/// [`BuildError`] if there is nothing of the kind to cut.
pub fn cut_blob(blob: &Blob<'_>, keep: &Keep) -> Result<Vec<u8>, BuildError> {
    let header = *blob.header();
    let whole = |of| {
        let bodies = copied(blob, of);
        (!bodies.is_empty()).then_some(Sections { header, bodies })
    };
    let hierarchy = match (keep.level, blob.hull()) {
        (Some(level), Ok(hull)) => Some(cut(&hull, level)?.sections()),
        (Some(wanted), Err(_)) => return Err(BuildError::NoLevel { wanted, levels: 0 }),
        (None, _) => whole(SectionKind::is_hull),
    };
    let tree = if keep.level.is_none() { bvh::sections_of(blob) } else { None };
    // Key frames are about all vertices, so they stay beside a whole hierarchy only.
    let frames = if keep.level.is_none() { whole(SectionKind::is_deform) } else { None };
    if keep.triboxes.is_some() && blob.triboxes().is_err() {
        return Err(BuildError::NoTriboxes);
    }
    if keep.tight.is_some() && blob.tight_hulls().is_err() {
        return Err(BuildError::NoTightHulls);
    }
    let triboxes = tribox::cut(blob, keep.triboxes.unwrap_or(u32::MAX));
    let tight = tight::cut(blob, keep.tight.unwrap_or(u32::MAX));
    // It is that of the mesh itself, whatever is cut.
    let field = whole(SectionKind::is_sdf);
    let structures = [hierarchy, frames, tree, triboxes, tight, field];
    Ok(assemble(structures.iter().flatten()))
}

/// Tables of a hull hierarchy after level `index`: see [`hull::cut()`].
///
/// # Errors
/// [`BuildError::NoLevel`].
pub fn cut(whole: &Hull<'_>, index: u32) -> Result<hull::Tables, BuildError> {
    let levels = whole.header().levels;
    hull::cut(whole, index).ok_or(BuildError::NoLevel { wanted: index, levels })
}
