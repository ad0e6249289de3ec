//! A blob in memory, with the report of its build.

use crate::bvh::TreeReport;
use crate::curve::CurveReport;
use crate::error::BuildError;
use crate::hull::BuildReport;
use crate::load::Loaded;
use crate::sdf::SdfReport;
use crate::tight::HullReport;
use crate::tribox::TriboxReport;
use meshsweep_core::{Blob, Hull};
use std::fmt;

/// A sentence of the report. `Display` prints it.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Note {
    /// What it is about.
    pub topic: Topic,
    /// The sentence.
    pub text: String,
}

/// What a note is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Topic {
    /// The mesh or the curves: what was read, repaired and moved.
    Input,
    /// The hull hierarchy.
    Hull,
    /// The box tree.
    BoxTree,
    /// Where the side of a point is doubtful.
    Sides,
    /// Triboxes.
    Triboxes,
    /// Tight hulls.
    Tight,
    /// The distance field.
    Sdf,
    /// Why winding numbers are doubtful.
    Winding,
}

impl Topic {
    /// Its name in JSON.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Input => "input",
            Self::Hull => "hull",
            Self::BoxTree => "tree",
            Self::Sides => "sides",
            Self::Triboxes => "triboxes",
            Self::Tight => "tight_hulls",
            Self::Sdf => "sdf",
            Self::Winding => "winding",
        }
    }
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

/// A blob in memory, with the report of its build.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Built {
    bytes: Vec<u8>,
    notes: Vec<Note>,
    /// The repaired mesh and its repairs. `None` of curves, and of a mesh that the caller repaired
    /// ([`trade`](crate::trade)).
    pub loaded: Option<Loaded>,
    /// Report of the hull hierarchy.
    pub hull: Option<BuildReport>,
    /// Report of the box tree.
    pub tree: Option<TreeReport>,
    /// Report of the triboxes.
    pub triboxes: Option<TriboxReport>,
    /// Report of each tight hull.
    pub tight: Vec<HullReport>,
    /// Report of the distance field.
    pub sdf: Option<SdfReport>,
    /// Report of the curves.
    pub curve: Option<CurveReport>,
}

impl Built {
    /// To be [opened](Self::opened), with no report yet.
    pub(super) fn of(bytes: Vec<u8>) -> Self {
        Self {
            bytes,
            notes: Vec::new(),
            loaded: None,
            hull: None,
            tree: None,
            triboxes: None,
            tight: Vec::new(),
            sdf: None,
            curve: None,
        }
    }

    /// The blob, if it opens, with the notes on it. One that does not open must not be handed out.
    pub(super) fn opened(
        self,
        notes: impl FnOnce(&Self, &Blob<'_>) -> Vec<Note>,
    ) -> Result<Self, BuildError> {
        let blob = Blob::open(&self.bytes).map_err(BuildError::Reopen)?;
        let notes = notes(&self, &blob);
        Ok(Self { notes, ..self })
    }

    /// Other bytes of the same build, if they open.
    pub(crate) fn with_bytes(&self, bytes: Vec<u8>) -> Result<Self, BuildError> {
        let notes = self.notes.clone();
        Self { bytes, ..self.clone() }.opened(|_, _| notes)
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

    /// Of a cut hull hierarchy the finest level that is left.
    #[must_use]
    pub fn cut_level(&self) -> Option<u32> {
        let blob = self.blob();
        let hull = blob.hull().ok().filter(Hull::is_cut)?;
        hull.header().levels.checked_sub(1)
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
