//! The blob of a structure, or why a mesh has none.

use crate::bvh::{self, TreeOptions};
use crate::emit::assemble;
use crate::hull::{self, BuildOptions, Levels};
use crate::mesh::{Input, RawMesh, repair, require_closed_manifold};
use crate::progress::Watch;
use crate::surface::{VertexBits, snap};
use crate::tight::{self, ChainOptions};
use crate::tribox::{self, TriboxOptions};
use meshsweep_core::{Blob, Hull};
use std::fmt;

/// Bits of a box tree's vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TreeBits {
    /// On a grid.
    Sixteen,
    /// In f32.
    ThirtyTwo,
}

/// Bits of a hull hierarchy's vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HullBits {
    /// On a grid.
    Sixteen,
    /// On a finer grid.
    TwentyFour,
    /// In f32.
    ThirtyTwo,
}

impl HullBits {
    const fn format(self) -> VertexBits {
        match self {
            Self::Sixteen => VertexBits::Grid16,
            Self::TwentyFour => VertexBits::Grid24,
            Self::ThirtyTwo => VertexBits::F32,
        }
    }

    const fn number(self) -> u32 {
        match self {
            Self::Sixteen => 16,
            Self::TwentyFour => 24,
            Self::ThirtyTwo => 32,
        }
    }
}

/// A structure that answers distances, as it is built.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Structure {
    /// A box tree for distances.
    Tree(TreeBits),
    /// A hull hierarchy for sweeps.
    Sweep(HullBits),
    /// The hull hierarchy of a closed mesh, cut after its coarsest level of which no point is
    /// farther than this from the mesh, input units.
    CutLevel(f32),
    /// A tight hull of at most so many faces, not polished.
    Tight(u32),
    /// At most so many triboxes.
    Triboxes(u32),
}

impl fmt::Display for Structure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Tree(TreeBits::Sixteen) => write!(f, "box tree, 16 bits"),
            Self::Tree(TreeBits::ThirtyTwo) => write!(f, "box tree, 32 bits"),
            Self::Sweep(bits) => write!(f, "sweep, {} bits", bits.number()),
            Self::CutLevel(error) => write!(f, "cut level, error {error}"),
            Self::Tight(faces) => write!(f, "tight hull, {faces} faces"),
            Self::Triboxes(count) => write!(f, "triboxes, {count}"),
        }
    }
}

impl Structure {
    /// The options with which the program builds it.
    #[must_use]
    pub fn options(&self) -> String {
        match self {
            Self::Tree(TreeBits::Sixteen) => "--for closest --vertex-bits 16".to_owned(),
            Self::Tree(TreeBits::ThirtyTwo) => "--for closest --vertex-bits 32".to_owned(),
            Self::Sweep(bits) => format!("--for sweep --vertex-bits {}", bits.number()),
            Self::CutLevel(_) => "--for hull, then cut --level".to_owned(),
            Self::Tight(faces) => {
                format!("--for tight --tight {faces} --tight-for closest --effort 0")
            }
            Self::Triboxes(count) => format!("--for triboxes --triboxes {count}"),
        }
    }

    /// The bytes of its blob, or why there is none.
    ///
    /// # Errors
    /// A sentence about the mesh.
    pub fn build(&self, input: Input<'_>) -> Result<Vec<u8>, String> {
        let said = |error: crate::error::BuildError| error.to_string();
        let bytes = match *self {
            Self::Tree(bits) => {
                let options = TreeOptions::default()
                    .with_segments(false)
                    .with_f32(bits == TreeBits::ThirtyTwo);
                bvh::build(input, &options).map_err(said)?.0.to_bytes()
            }
            Self::Sweep(bits) => swept(input, bits)?,
            Self::CutLevel(error) => cut_level(&hierarchy(input)?, error)?,
            Self::Tight(faces) => {
                let options = ChainOptions::of_faces(&[faces as usize])
                    .with_boxes(true, false)
                    .with_effort(0.0);
                let (sections, reports) =
                    tight::build(input, &options, Watch::NONE).map_err(said)?;
                if let Some(report) = reports.first()
                    && report.wrapped.faces > faces as usize
                {
                    return Err(format!("the search stopped at {} faces", report.wrapped.faces));
                }
                sections.to_bytes()
            }
            Self::Triboxes(count) => {
                let options = TriboxOptions { count };
                tribox::build(input, &options, Watch::NONE).map_err(said)?.0.to_bytes()
            }
        };
        Blob::open(&bytes).map_err(|error| error.to_string())?;
        Ok(bytes)
    }
}

/// A hull hierarchy for sweeps. Vertices move to the grid before repair, as in the program.
fn swept(input: Input<'_>, bits: HullBits) -> Result<Vec<u8>, String> {
    let options = BuildOptions {
        levels: Levels::Sweep,
        vertex_bits: bits.format(),
        ..BuildOptions::default()
    };
    let of = |input: Input<'_>| {
        let built = hull::build(input, &options, Watch::NONE);
        built.map(|(sections, _)| sections.to_bytes()).map_err(|error| error.to_string())
    };
    if bits == HullBits::ThirtyTwo {
        return of(input);
    }
    let mesh = input.mesh;
    let all: Vec<[u32; 3]> = mesh.all_triangles().collect();
    let mut raw = RawMesh::from_f32(&mesh.positions, &all);
    let moved = snap(&mut raw.positions, bits.format());
    let (mesh, _) = repair(raw).map_err(|error| error.to_string())?;
    of(Input { mesh: &mesh, moved: input.error() + moved, input_triangles: input.input_triangles })
}

/// The blobs of structures. Cut levels come out of one hierarchy.
pub(super) fn build_all(
    structures: &[Structure],
    input: Input<'_>,
) -> Vec<Result<Vec<u8>, String>> {
    let mut whole = None;
    let mut build = |structure: &Structure| {
        let Structure::CutLevel(error) = *structure else { return structure.build(input) };
        let whole = whole.get_or_insert_with(|| hierarchy(input));
        whole.as_ref().map_err(String::clone).and_then(|bytes| cut_level(bytes, error))
    };
    structures.iter().map(&mut build).collect()
}

/// The hull hierarchy of a closed mesh.
fn hierarchy(input: Input<'_>) -> Result<Vec<u8>, String> {
    require_closed_manifold(input.mesh).map_err(|error| error.to_string())?;
    let built = hull::build(input, &BuildOptions::default(), Watch::NONE);
    built.map(|(sections, _)| sections.to_bytes()).map_err(|error| error.to_string())
}

fn cut_level(hierarchy: &[u8], error: f32) -> Result<Vec<u8>, String> {
    let whole = Hull::open(hierarchy).map_err(|error| error.to_string())?;
    let unit = whole.scale();
    let is_fine =
        |level: &meshsweep_core::Level| f64::from(level.hull_to_surface) * unit <= f64::from(error);
    let index = whole.levels().position(|level| is_fine(&level));
    let last = whole.header().levels.saturating_sub(1);
    let index = index.map_or(last, |index| index as u32);
    if index == last {
        return Err("no level but the surface itself is so near".to_owned());
    }
    let tables = hull::cut(&whole, index).ok_or("the hierarchy has no such level")?;
    Ok(assemble([&tables.sections()]))
}
