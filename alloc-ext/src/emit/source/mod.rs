//! A blob as source text for firmware: in Rust or in C, with the facts that a program needs at
//! compile time.
//!
//! The text depends on the blob and on the names of files alone: it has no date and no path.

mod c;
mod rust;
mod stack;

pub use c::{c_header, c_source};
pub use rust::rust_module;
pub(crate) use rust::{rust_items, rust_name};
pub(crate) use stack::stack_bound;

use meshsweep_core::{Blob, Bvh};

/// Names in the text.
#[derive(Clone, Copy, Debug)]
pub struct SourceNames<'a> {
    /// The mesh file, without folders.
    pub mesh: &'a str,
    /// The blob's file, without folders.
    pub blob: &'a str,
}

impl SourceNames<'_> {
    /// The blob's name without extension.
    fn file_stem(&self) -> &str {
        self.blob.rsplit_once('.').map_or(self.blob, |(stem, _)| stem)
    }

    /// The same as an identifier in lower case.
    fn identifier(&self) -> String {
        identifier(self.file_stem())
    }
}

/// A name as an identifier in lower case.
fn identifier(name: &str) -> String {
    let letter = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' };
    let name: String = name.chars().map(letter).collect();
    // A number cannot begin an identifier.
    if name.starts_with(|c: char| c.is_ascii_digit()) { format!("_{name}") } else { name }
}

/// A box that contains the mesh: that of the stored vertices, grown by the surface error.
fn around(tree: &Bvh<'_>) -> [[f32; 3]; 2] {
    let ([low, high], error) = (tree.bounds(), tree.surface_error());
    if error == 0.0 {
        return [low, high];
    }
    [low.map(|x| (x - error).next_down()), high.map(|x| (x + error).next_up())]
}

/// A name that ends no comment and begins no other.
pub(crate) fn in_comment(name: &str) -> String {
    // Compilers refuse characters that change the direction of text.
    let turns = |c: char| {
        matches!(c, '\u{200E}' | '\u{200F}' | '\u{202A}'..='\u{202E}')
            || matches!(c, '\u{2066}'..='\u{2069}')
    };
    let harmless = |c: char| if c.is_control() || turns(c) { '?' } else { c };
    let name: String = name.chars().map(harmless).collect();
    name.replace("*/", "*_").replace("/*", "_*")
}

/// Facts of a blob that the text states.
struct Facts {
    bytes: usize,
    checksum: u32,
    triangles: u32,
    /// No question about one point, segment or solid needs more scratch entries.
    scratch: usize,
    /// No place of the point of a kept sweep needs more scratch entries.
    sweep: Option<usize>,
    has_tree: bool,
    /// Tight hulls.
    hulls: u32,
    /// A unit of the distance field.
    field_unit: Option<f32>,
    /// A structure that a `static` cannot hold.
    has_more: bool,
    is_closed: Option<bool>,
    has_sides: Option<bool>,
    /// Whether curves bound an area.
    is_fence: Option<bool>,
    surface_error: Option<f32>,
    /// Contains the mesh, or the tightest hull.
    bounds: Option<[[f32; 3]; 2]>,
}

impl Facts {
    fn of(blob: &Blob<'_>) -> Self {
        let tree = blob.bvh().ok();
        let tight = blob.tight_hulls().ok();
        let (hull, triboxes, curve) = (blob.hull().ok(), blob.triboxes().ok(), blob.curve().ok());
        let of_hulls = (0..tight.map_or(0, |hulls| hulls.count()))
            .filter_map(|index| tight?.get(index))
            .map(|hull| hull.scratch_entries());
        let scratch = [
            tree.map(|tree| tree.scratch_entries()),
            of_hulls.max(),
            hull.map(|hull| hull.scratch_entries()),
            triboxes.map(|triboxes| triboxes.scratch_entries()),
            curve.map(|curve| curve.scratch_entries()),
        ];
        let finest = tight.and_then(|hulls| hulls.finest());
        Self {
            bytes: blob.bytes().len(),
            checksum: blob.header_crc(),
            triangles: blob.header().input_triangles,
            scratch: scratch.into_iter().flatten().max().unwrap_or(1),
            sweep: hull.map(|hull| hull.sweep_entries()),
            has_tree: tree.is_some(),
            hulls: tight.map_or(0, |hulls| hulls.count()),
            field_unit: blob.sdf().ok().map(|field| field.unit()),
            has_more: hull.is_some() || triboxes.is_some() || curve.is_some(),
            is_closed: tree.map(|tree| tree.is_closed()),
            has_sides: tree.map(|tree| tree.has_sides()),
            is_fence: curve.map(|curve| curve.check_fence().is_ok()),
            surface_error: tree.map(|tree| tree.surface_error()),
            bounds: tree.or(finest.map(|hull| *hull.bvh())).map(|tree| around(&tree)),
        }
    }
}
