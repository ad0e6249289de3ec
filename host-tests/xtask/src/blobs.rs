//! The blobs that the images are asked about.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use crate::boards::Flash;
use crate::host;
use crate::images::Profile;
use crate::reading::Reading;
use crate::workspace;

/// A blob, by the name that `host blobs` gives it, and the image that is asked about it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Blob {
    /// The file's name without its extension.
    pub name: &'static str,
    /// The image.
    pub image: &'static str,
}

const fn hull(name: &'static str) -> Blob {
    Blob { name, image: "suite_hull" }
}

const fn tree(name: &'static str) -> Blob {
    Blob { name, image: "suite_tree" }
}

const fn curve(name: &'static str) -> Blob {
    Blob { name, image: "suite_curve" }
}

const TRIBOXES: Blob = Blob { name: "triboxes", image: "suite_triboxes" };
/// The box tree that is asked about other bodies.
pub const APART: Blob = Blob { name: "apart", image: "suite_apart" };
const MOVING: Blob = Blob { name: "moving", image: "suite_moving" };
const DEFORM: Blob = Blob { name: "bend", image: "suite_deform" };
const FIELD: Blob = Blob { name: "field", image: "suite_sdf" };
const BOTH: Blob = Blob { name: "both", image: "suite_both" };
const TIGHT: Blob = Blob { name: "tight", image: "suite_tight" };

impl Blob {
    /// The blobs whose costs are reported for a part with so much flash: hull hierarchy and box
    /// tree of one mesh, triboxes, tight hulls, a curve, and a distance field.
    #[must_use]
    pub const fn standard(flash: Flash) -> [Self; 6] {
        match flash {
            Flash::Small => {
                [hull("torus"), tree("torus_tree"), TRIBOXES, TIGHT, curve("fence"), FIELD]
            }
            Flash::Large => {
                [hull("bracket"), tree("bracket_tree"), TRIBOXES, TIGHT, curve("tool_path"), FIELD]
            }
        }
    }

    /// Blobs whose bits are compared beside the standard ones: other formats of vertices, a cut
    /// blob, an open mesh, a soup of triangles, a box tree that is asked about other bodies, one
    /// with a distance field, a hull that moves, and one that deforms.
    pub const VARIANTS: [Self; 10] = [
        hull("grid16"),
        hull("grid24"),
        hull("cut"),
        hull("sieve"),
        tree("single_tree"),
        tree("soup_tree"),
        APART,
        BOTH,
        MOVING,
        DEFORM,
    ];

    /// Whether the costs of its image are reported for a part with so much flash.
    #[must_use]
    pub fn is_reported(self, flash: Flash) -> bool {
        self == APART || Self::standard(flash).contains(&self)
    }

    /// Whether its image paints the stack with both optimisations.
    #[must_use]
    pub fn is_painted(self) -> bool {
        self == MOVING || self == BOTH || self.is_reported(Flash::Large)
    }

    /// All blobs, each once.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let standard = [Flash::Small, Flash::Large].into_iter().flat_map(Self::standard);
        let mut all: Vec<Self> = Vec::new();
        for blob in standard.chain(Self::VARIANTS) {
            if !all.contains(&blob) {
                all.push(blob);
            }
        }
        all
    }

    /// The blob of a name.
    ///
    /// # Errors
    /// There is none.
    pub fn named(name: &str) -> Result<Self, String> {
        let mut all = Self::all().into_iter();
        all.find(|blob| blob.name == name).ok_or_else(|| format!("no blob `{name}`"))
    }

    /// How the image is optimised for a part with so much flash. All questions to a box tree or to
    /// a hull hierarchy, compiled for speed, are more than 256 KiB.
    #[must_use]
    pub fn profile(self, flash: Flash) -> Profile {
        if matches!(
            self.image,
            "suite_tree" | "suite_hull" | "suite_apart" | "suite_both" | "suite_moving"
        ) && flash == Flash::Small
        {
            Profile::Small
        } else {
            Profile::Release
        }
    }

    /// The file.
    #[must_use]
    pub fn file(self) -> PathBuf {
        folder().join(self.name).with_extension("msw")
    }

    /// The blob as it lies in a board's flash.
    ///
    /// # Errors
    /// [`write()`] was not run.
    pub fn in_flash(self, blocks: Blocks) -> Result<PathBuf, String> {
        in_flash(&self.file(), blocks)
    }

    /// What the host answered.
    ///
    /// # Errors
    /// [`write()`] was not run.
    pub fn expected(self) -> Result<Reading, String> {
        let file = folder().join(self.name).with_extension("txt");
        let text = fs::read_to_string(&file)
            .map_err(|error| format!("cannot read {}: {error}", file.display()))?;
        Reading::parse(&text, None)
    }
}

/// Writes all blobs, each beside the answers of this machine, if this process has not written them.
///
/// # Errors
/// The builder's.
pub fn write() -> Result<(), String> {
    static WRITTEN: OnceLock<Result<(), String>> = OnceLock::new();
    let write = || host::run(&["blobs", &folder().to_string_lossy()]).map(drop);
    WRITTEN.get_or_init(write).clone()
}

/// How many blocks of queries an image asks of each kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Blocks {
    /// Of kinds whose instructions are in the documents' tables.
    pub tabled: u32,
    /// Of each other kind.
    pub others: u32,
}

impl Blocks {
    /// As many as the host asks.
    pub const ALL: Self = Self { tabled: 16, others: 16 };
    /// A quarter: 128 queries of each kind.
    pub const QUARTER: Self = Self { tabled: 4, others: 4 };
    /// A quarter of those that no table holds.
    pub const TABLED: Self = Self { tabled: 16, others: 4 };
}

/// Writes what lies at the end of a board's flash for the images of the suite: a blob, padding to a
/// multiple of 16 bytes, and 16 bytes that begin with the blob's length and the two numbers of
/// blocks.
///
/// # Errors
/// A file that cannot be read or written.
pub fn in_flash(blob: &Path, blocks: Blocks) -> Result<PathBuf, String> {
    let mut bytes = fs::read(blob).map_err(|error| format!("{}: {error}", blob.display()))?;
    let length = u32::try_from(bytes.len()).map_err(|error| error.to_string())?;
    bytes.resize(bytes.len().next_multiple_of(16), 0);
    let Blocks { tabled, others } = blocks;
    bytes.extend([length, tabled, others, 0].into_iter().flat_map(u32::to_le_bytes));
    let file = blob.with_extension(format!("{tabled}-{others}.flash"));
    fs::write(&file, bytes).map_err(|error| format!("{}: {error}", file.display()))?;
    Ok(file)
}

fn folder() -> PathBuf {
    workspace::target().join("blobs")
}
