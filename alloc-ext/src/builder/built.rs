//! A blob in memory, with the report of its build.

use super::notes::{Note, Topic};
use crate::bvh::TreeReport;
use crate::curve::CurveReport;
use crate::error::BuildError;
use crate::hull::BuildReport;
use crate::load::Loaded;
use crate::tight::HullReport;
use crate::tribox::TriboxReport;
use meshsweep_core::Blob;

/// A blob in memory, with the report of its build.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Built {
    bytes: Vec<u8>,
    pub(super) notes: Vec<Note>,
    /// The repaired mesh and its repairs; of curves: `None`.
    pub loaded: Option<Loaded>,
    /// Report of the hull hierarchy.
    pub hull: Option<BuildReport>,
    /// Report of the box tree.
    pub tree: Option<TreeReport>,
    /// Report of the triboxes.
    pub triboxes: Option<TriboxReport>,
    /// Report of each tight hull.
    pub tight: Vec<HullReport>,
    /// Report of the curves.
    pub curve: Option<CurveReport>,
}

impl Built {
    /// The blob, if it opens. One that does not open must not be handed out.
    pub(super) fn of(bytes: Vec<u8>) -> Result<Self, BuildError> {
        Blob::open(&bytes).map_err(BuildError::Reopen)?;
        Ok(Self {
            bytes,
            notes: Vec::new(),
            loaded: None,
            hull: None,
            tree: None,
            triboxes: None,
            tight: Vec::new(),
            curve: None,
        })
    }

    /// The blob's bytes, as `meshsweep build` writes them.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// The blob's bytes, without the report.
    #[must_use]
    pub fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }

    /// The blob, opened. Each call checks all bytes again: keep the blob for many questions.
    #[must_use]
    #[expect(clippy::missing_panics_doc, reason = "the bytes were opened when they were built")]
    pub fn blob(&self) -> Blob<'_> {
        Blob::open(&self.bytes).expect("it opened before")
    }

    /// Notes on repairs, on moved and left out parts, and on doubts.
    pub fn report(&self) -> impl Iterator<Item = &Note> {
        self.notes.iter()
    }

    /// The notes of one topic.
    pub fn report_on(&self, topic: Topic) -> impl Iterator<Item = &Note> {
        self.notes.iter().filter(move |note| note.topic == topic)
    }
}
