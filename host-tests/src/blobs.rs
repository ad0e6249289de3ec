//! The blobs that the firmware images are asked about: hull hierarchies in every coordinate
//! format, whole and cut, box trees, triboxes, tight hulls, curves and a distance field.

use std::fs;
use std::path::Path;

use meshsweep::bvh::{TreeOptions, build as build_tree};
use meshsweep::cut::cut;
use meshsweep::hull::{BuildOptions, build};
use meshsweep::mesh::Mesh;
use meshsweep::progress::Watch;
use meshsweep::surface::VertexBits;
use meshsweep_core::{Blob as Opened, Hull, ScratchEntry};
use meshsweep_suite::ask::{
    Refused, apart, both, curve, deform, hull, hull_moving, sdf, tight, tree, triboxes,
};
use meshsweep_suite::fold::Fold;
use meshsweep_suite::{Kind, Observer, Plan, Recorder, Subject, run};

use crate::generate::{Triangles, bracket, groove_block, torus};
use crate::golden::{
    bending_torus, bracket_hulls, fence_curves, groove_both, groove_field, tool_path_curve,
    torus_sieve, torus_triboxes,
};

/// A blob of the images.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Blob {
    /// A torus of 480 triangles: fits the smallest part with the code.
    Torus,
    /// The bracket of 1,948 triangles.
    Bracket,
    /// The torus on a 16-bit grid.
    Grid16,
    /// The torus on a 24-bit grid.
    Grid24,
    /// The torus, cut after the level that follows the base hull.
    Cut,
    /// The hierarchy for sweeps of the torus with holes.
    Sieve,
    /// A smaller torus, asked about points that move and about its moved copy.
    Moving,
    /// The box tree of a block with a slot, asked about other bodies. With the bracket's the image
    /// would not fit into the flash of the smallest board.
    Apart,
    /// The torus's box tree, vertices on a grid.
    TorusTree,
    /// The bracket's box tree.
    BracketTree,
    /// The torus's box tree, vertices as f32.
    SingleTree,
    /// The box tree of a torus with holes, beside needles and triangles without area, with normal
    /// cones.
    SoupTree,
    /// 64 triboxes of a finer torus.
    Triboxes,
    /// Tight hulls of the bracket.
    Tight,
    /// The fence of the fixtures.
    Fence,
    /// A tool path of 2,000 segments.
    ToolPath,
    /// The hull of a torus that bends.
    Bend,
    /// The distance field of the block with a slot.
    Field,
    /// Its box tree and a smaller distance field.
    Both,
}

impl Blob {
    /// All blobs.
    pub const ALL: [Self; 19] = [
        Self::Torus,
        Self::Bracket,
        Self::Grid16,
        Self::Grid24,
        Self::Cut,
        Self::Sieve,
        Self::Moving,
        Self::Apart,
        Self::TorusTree,
        Self::BracketTree,
        Self::SingleTree,
        Self::SoupTree,
        Self::Triboxes,
        Self::Tight,
        Self::Fence,
        Self::ToolPath,
        Self::Bend,
        Self::Field,
        Self::Both,
    ];

    /// The file's name without its extension.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Torus => "torus",
            Self::Bracket => "bracket",
            Self::Grid16 => "grid16",
            Self::Grid24 => "grid24",
            Self::Cut => "cut",
            Self::Sieve => "sieve",
            Self::Moving => "moving",
            Self::Apart => "apart",
            Self::TorusTree => "torus_tree",
            Self::BracketTree => "bracket_tree",
            Self::SingleTree => "single_tree",
            Self::SoupTree => "soup_tree",
            Self::Triboxes => "triboxes",
            Self::Tight => "tight",
            Self::Fence => "fence",
            Self::ToolPath => "tool_path",
            Self::Bend => "bend",
            Self::Field => "field",
            Self::Both => "both",
        }
    }

    fn bytes(self) -> Result<Vec<u8>, String> {
        // 50 faces: the levels below the surface are few enough to be cut, and the splits are many.
        let small = |vertex_bits| whole(small_torus(), 50, vertex_bits);
        let default = TreeOptions::default();
        match self {
            Self::Torus => small(VertexBits::Auto),
            // Fewer triangles, as of the tree below.
            Self::Moving => whole(torus(2.0, 0.75, 16, 10), 50, VertexBits::Auto),
            Self::Bracket => whole(bracket(), BuildOptions::default().base_faces, VertexBits::Auto),
            Self::Grid16 => small(VertexBits::Grid16),
            Self::Grid24 => small(VertexBits::Grid24),
            Self::Cut => {
                let bytes = small(VertexBits::Auto)?;
                let model = Hull::open(&bytes).map_err(|error| error.to_string())?;
                Ok(cut(&model, 1).map_err(|error| error.to_string())?.to_bytes())
            }
            Self::Sieve => Ok(torus_sieve()),
            Self::TorusTree => Ok(box_tree(small_torus(), &default)),
            Self::Apart => Ok(box_tree(groove_block(), &default.with_winding(true))),
            Self::BracketTree => Ok(box_tree(bracket(), &default)),
            // Fewer triangles: with f32 vertices and all questions the image just fits into the
            // flash of the smallest board.
            Self::SingleTree => Ok(box_tree(torus(2.0, 0.75, 16, 10), &default.with_f32(true))),
            Self::Triboxes => Ok(torus_triboxes()),
            Self::Tight => Ok(bracket_hulls()),
            Self::Fence => Ok(fence_curves()),
            Self::ToolPath => Ok(tool_path_curve()),
            Self::Bend => Ok(bending_torus()),
            Self::Field => Ok(groove_field()),
            Self::Both => Ok(groove_both()),
            Self::SoupTree => Ok(box_tree(soup(), &default.with_cull(true))),
        }
    }
}

fn small_torus() -> Triangles {
    torus(2.0, 0.75, 20, 12)
}

fn soup() -> Triangles {
    let (positions, mut triangles) = small_torus();
    let mut number = 0u32..;
    triangles.retain(|_| number.next().is_some_and(|n| n % 5 != 3));
    // Twice the same, wound either way, without area, and so long that it crosses the hole.
    triangles.extend([[0, 1, 13], [13, 1, 0], [7, 7, 8], [9, 9, 9], [0, 1, 120], [30, 150, 31]]);
    (positions, triangles)
}

fn box_tree((positions, triangles): Triangles, options: &TreeOptions) -> Vec<u8> {
    let mesh = Mesh::new(positions, triangles);
    let (tables, _) = build_tree(mesh.as_input(), options, Watch::NONE).expect("builds");
    tables.to_bytes()
}

fn whole(
    (positions, triangles): Triangles,
    base_faces: usize,
    vertex_bits: VertexBits,
) -> Result<Vec<u8>, String> {
    let mesh = Mesh::new(positions, triangles);
    let options = BuildOptions { base_faces, vertex_bits, ..BuildOptions::default() };
    let built = build(mesh.as_input(), &options, Watch::NONE).map_err(|error| error.to_string())?;
    Ok(built.0.to_bytes())
}

/// Writes each blob to `NAME.msw` and this machine's answers to `NAME.txt`, as an image prints
/// them.
///
/// # Errors
/// The builder's, or a file that cannot be written.
pub fn write(folder: &Path) -> Result<(), String> {
    let failed = |error: std::io::Error| format!("cannot write {}: {error}", folder.display());
    fs::create_dir_all(folder).map_err(failed)?;
    for blob in Blob::ALL {
        let bytes = blob.bytes()?;
        let path = folder.join(blob.name());
        let answers = match blob {
            Blob::Moving => {
                of_subject::<hull_moving::Moving<'_>>(&bytes, &mut hull_moving::Scratch::new())?
            }
            Blob::Apart => of_subject::<apart::Apart<'_>>(&bytes, &mut apart::Scratch::new())?,
            Blob::Both => of_subject::<both::BvhWithSdf<'_>>(&bytes, &mut both::Scratch::new())?,
            _ => expected(&bytes)?,
        };
        fs::write(path.with_extension("txt"), answers).map_err(failed)?;
        let file = path.with_extension("msw");
        // So that cargo does not build images again whose blob has not changed.
        if fs::read(&file).is_ok_and(|there| there == bytes) {
            continue;
        }
        fs::write(file, bytes).map_err(failed)?;
    }
    Ok(())
}

/// What an image should print of a blob: the suite's answers on this machine. The suite asks the
/// blob's box tree if there is one, else its triboxes, its tight hulls, its curves, its distance
/// field, its hull that deforms or its hull hierarchy.
///
/// # Errors
/// The core's refusal.
pub fn expected(blob: &[u8]) -> Result<String, String> {
    let mut lines = Lines::of(blob);
    let plan = Plan::STANDARD;
    let mut ran = run::<tree::Bvh<'_>>(blob, plan, &mut tree::Scratch::new(), &mut lines);
    if ran == Err(Refused::NO_SECTION) {
        ran = run::<triboxes::Triboxes<'_>>(blob, plan, &mut triboxes::Scratch::new(), &mut lines);
    }
    if ran == Err(Refused::NO_SECTION) {
        ran = run::<tight::Hulls<'_>>(blob, plan, &mut tight::Scratch::new(), &mut lines);
    }
    if ran == Err(Refused::NO_SECTION) {
        ran = run::<curve::Curve<'_>>(blob, plan, &mut curve::Scratch::new(), &mut lines);
    }
    if ran == Err(Refused::NO_SECTION) {
        ran = run::<sdf::Sdf<'_>>(blob, plan, &mut sdf::Scratch::new(), &mut lines);
    }
    if ran == Err(Refused::NO_SECTION) {
        let scratch = &mut deform::Scratch::new();
        ran = run::<deform::DeformableHull<'_>>(blob, plan, scratch, &mut lines);
    }
    if ran == Err(Refused::NO_SECTION) {
        ran = run::<hull::Model<'_>>(blob, plan, &mut hull::Scratch::new(), &mut lines);
    }
    lines.end(ran, blob)
}

/// The same of an image that asks one structure.
fn of_subject<'t, S: Subject<'t>>(
    blob: &'t [u8],
    scratch: &mut S::Scratch,
) -> Result<String, String> {
    let mut lines = Lines::of(blob);
    let ran = run::<S>(blob, Plan::STANDARD, scratch, &mut lines);
    lines.end(ran, blob)
}

/// Entries that no query to the blob's structures outgrows.
fn scratch_entries(blob: &Opened<'_>) -> usize {
    let all = [
        blob.bvh().map(|bvh| bvh.scratch_entries()),
        blob.hull().map(|hull| hull.scratch_entries()),
        blob.triboxes().map(|triboxes| triboxes.scratch_entries()),
        blob.curve().map(|curve| curve.scratch_entries()),
        blob.tight_hulls().map(|hulls| hulls.finest().map_or(0, |hull| hull.scratch_entries())),
    ];
    all.into_iter().flatten().max().unwrap_or(0)
}

struct Lines(String);

impl Lines {
    fn of(blob: &[u8]) -> Self {
        Self(format!("blob {} {:016x}\n", blob.len(), Fold::of_bytes(blob)))
    }

    fn end(self, ran: Result<(), Refused>, blob: &[u8]) -> Result<String, String> {
        ran.map_err(|refused| format!("the core refuses the blob: error {}", refused.0))?;
        let entries = Opened::open(blob).map_or(0, |opened| scratch_entries(&opened));
        Ok(self.0 + &format!("needs {}\ndone\n", entries * size_of::<ScratchEntry>()))
    }
}

impl Observer for Lines {}

impl Recorder for Lines {
    fn block(&mut self, kind: Kind, index: u32, hash: u64) {
        self.0.push_str(&format!("block {} {index} {hash:016x}\n", kind.name()));
    }
}

#[cfg(test)]
mod tests {
    use super::Blob;
    use meshsweep_core::internal::format::layout::VertexFormat;
    use meshsweep_core::{Bvh, Curve, Hull, Triboxes};
    use meshsweep_suite::Subject;
    use meshsweep_suite::ask::hull;
    use meshsweep_suite::ask::tight::Hulls;

    const HULLS: [Blob; 6] =
        [Blob::Torus, Blob::Bracket, Blob::Grid16, Blob::Grid24, Blob::Cut, Blob::Sieve];
    const TREES: [Blob; 4] = [Blob::TorusTree, Blob::BracketTree, Blob::SingleTree, Blob::SoupTree];

    #[test]
    fn every_blob_opens_and_the_suite_has_memory_for_it() {
        for blob in HULLS {
            let bytes = blob.bytes().expect("a blob");
            let opened = hull::Model::open(&bytes).expect("opens");
            assert!(opened.memory_suffices(), "{blob:?}");
        }
        for blob in TREES {
            let bytes = blob.bytes().expect("a blob");
            assert!(Bvh::open(&bytes).expect("opens").memory_suffices(), "{blob:?}");
        }
        let bytes = Blob::Triboxes.bytes().expect("a blob");
        assert!(Triboxes::open(&bytes).expect("opens").memory_suffices());
        let bytes = Blob::Tight.bytes().expect("a blob");
        assert!(Hulls::open(&bytes).expect("opens").memory_suffices());
        for blob in [Blob::Fence, Blob::ToolPath] {
            let bytes = blob.bytes().expect("a blob");
            assert!(Curve::open(&bytes).expect("opens").memory_suffices(), "{blob:?}");
        }
    }

    #[test]
    fn blobs_differ_in_format_and_in_what_they_hold() {
        let header =
            |blob: Blob| *Hull::open(&blob.bytes().expect("a blob")).expect("opens").header();
        assert_eq!(header(Blob::Torus).vertex_format, VertexFormat::F32);
        assert_eq!(header(Blob::Grid16).vertex_format, VertexFormat::Grid16);
        assert_eq!(header(Blob::Grid24).vertex_format, VertexFormat::Grid24);
        assert_eq!(header(Blob::Torus).surface_triangles, 480);
        assert_eq!(header(Blob::Bracket).surface_triangles, 1948);
        let cut = header(Blob::Cut);
        assert!(cut.surface_triangles == 0 && cut.splits > 0);
    }

    #[test]
    fn trees_differ_in_format_and_in_what_they_hold() {
        for blob in TREES {
            let bytes = blob.bytes().expect("a blob");
            let tree = Bvh::open(&bytes).expect("opens");
            let header = tree.header();
            assert!(tree.serves_distances() && tree.serves_segments(), "{blob:?}");
            assert_eq!(header.is_f32(), blob == Blob::SingleTree, "{blob:?}");
            assert_eq!(header.is_closed(), blob != Blob::SoupTree, "{blob:?}");
            assert_eq!(tree.serves_culling(), blob == Blob::SoupTree, "{blob:?}");
            let triangles = match blob {
                Blob::BracketTree => 1948,
                Blob::SingleTree => 320,
                Blob::SoupTree => 390,
                _ => 480,
            };
            assert_eq!(header.triangles, triangles, "{blob:?}");
        }
    }
}
