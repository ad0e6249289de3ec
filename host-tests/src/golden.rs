//! Blobs and answers that are committed. A machine or a version that computes other bits is
//! noticed.

use std::fs;
use std::path::Path;

use meshsweep::Builder;
use meshsweep::builder::For;
use meshsweep::bvh::{TreeOptions, build};
use meshsweep::curve::{self, CurveOptions};
use meshsweep::emit::source::{SourceNames, c_header, c_source, rust_module};
use meshsweep::hull::{self, BuildOptions, Levels};
use meshsweep::mesh::{KeyFrame, Mesh, RawMesh};
use meshsweep::progress::Watch;
use meshsweep::sdf::{self, SdfLayout, SdfOptions};
use meshsweep::tight::{self, ChainOptions};
use meshsweep::tribox::{self, TriboxOptions};
use meshsweep_core::Blob;
use meshsweep_counted::answers;

use crate::generate::curves::{fence, tool_path, zones, zones_csv};
use crate::generate::fixtures::write_fixtures;
use crate::generate::{bracket, clamps, groove_block, link, table, torus};
use crate::workload;

/// Writes the committed fixtures: meshes by their generators, blobs by the builder, then answers.
/// The blobs go to `core/fixtures` too: the core's package holds those of its examples.
///
/// # Errors
/// A file that cannot be written, or a blob that the core refuses.
pub fn write(folder: &Path) -> Result<(), String> {
    let put = |name: &str, bytes: &[u8]| {
        let file = folder.join(name);
        fs::write(&file, bytes).map_err(|error| format!("cannot write {}: {error}", file.display()))
    };
    write_fixtures(folder)
        .map_err(|error| format!("cannot write {}: {error}", folder.display()))?;
    let hull = bracket_model(folder)?;
    let (tree, triboxes, tight) = (groove_tree(), torus_triboxes(), bracket_hulls());
    let (fence, bend, sieve) = (fence_curves(), bending_torus(), torus_sieve());
    put("sieve.msw", &sieve)?;
    let blobs = [
        ("bracket", &hull),
        ("groove", &tree),
        ("torus", &triboxes),
        ("hulls", &tight),
        ("fence", &fence),
        ("field", &groove_field()),
        ("both", &groove_both()),
        ("bend", &bend),
    ];
    for (name, blob) in blobs {
        put(&format!("{name}.msw"), blob)?;
        put(&format!("../core/fixtures/{name}.msw"), blob)?;
    }
    for (file, bytes) in sources() {
        put(&format!("../core/{file}"), &bytes)?;
    }
    let answers = answers::of_fixtures(folder)?;
    put("answers.txt", answers.as_bytes())
}

/// The blob of `bracket.stl` with the builder's defaults.
///
/// # Errors
/// The file is missing.
pub fn bracket_model(folder: &Path) -> Result<Vec<u8>, String> {
    let subject = workload::Subject::load(&folder.join("bracket.stl"))?;
    subject.build_with(&BuildOptions::default())
}

/// The distance field of the block with a slot.
///
/// # Panics
/// Never: the mesh has an area.
#[must_use]
pub fn groove_field() -> Vec<u8> {
    let options = SdfOptions::default().with_bytes(8 << 10);
    field_of_groove(&options.with_layout(Some(SdfLayout::Lattice)))
}

/// The smaller field of the example `haptics`: no wider than its pad.
fn groove_pad() -> Vec<u8> {
    field_of_groove(&SdfOptions::default().with_bytes(2 << 10).with_margin(Some(3.0)))
}

fn field_of_groove(options: &SdfOptions) -> Vec<u8> {
    let (positions, triangles) = groove_block();
    let mesh = Mesh::new(positions, triangles);
    sdf::build(mesh.as_input(), options, Watch::NONE).expect("an area").0.to_bytes()
}

/// The box tree and a distance field of the block with a slot, small enough for the smallest board.
///
/// # Panics
/// Never: the mesh has an area.
#[must_use]
pub fn groove_both() -> Vec<u8> {
    let (positions, triangles) = groove_block();
    let builder =
        Builder::new().serve_all([For::Closest, For::Segment, For::Sdf]).sdf_bytes(4 << 10);
    let built = builder.build(RawMesh::from_f32(&positions, &triangles));
    built.expect("an area").into_bytes()
}

/// The hierarchy for sweeps of a small torus with a hole in place of every fifth triangle.
///
/// # Panics
/// Never: the mesh has an area.
#[must_use]
pub fn torus_sieve() -> Vec<u8> {
    let (positions, mut triangles) = torus(2.0, 0.75, 20, 12);
    let mut number = 0u32..;
    triangles.retain(|_| number.next().is_some_and(|n| n % 5 != 3));
    let mesh = Mesh::new(positions, triangles);
    let options = BuildOptions { levels: Levels::Sweep, base_faces: 50, ..BuildOptions::default() };
    hull::build(mesh.as_input(), &options, Watch::NONE).expect("an area").0.to_bytes()
}

/// What `meshsweep build --emit rust,c` writes of the models of guide and examples, and of each the
/// blob that its Rust file includes: paths in `core`, and contents. The CSV of the fence too.
///
/// # Panics
/// Never: the builder's blobs open.
#[must_use]
pub fn sources() -> Vec<(String, Vec<u8>)> {
    let (groove, clamps, [link, table]) = (groove_tree(), clamps_tree(), arm_trees());
    let (pad, geofence) = (groove_pad(), zone_curves());
    let mut files = Vec::new();
    for (name, bytes, folders) in [
        (
            "groove",
            &groove,
            &["fixtures", "examples/probe/src", "examples/haptics/src", "examples/guard/src"][..],
        ),
        ("groove_pad", &pad, &["examples/haptics/src"]),
        ("clamps", &clamps, &["examples/keep_out/src"]),
        ("link", &link, &["examples/guard/src"]),
        ("table", &table, &["examples/guard/src"]),
        ("zones", &geofence, &["examples/fence/src"]),
    ] {
        let blob = Blob::open(bytes).expect("the builder's blob opens");
        let kind = if blob.curve().is_ok() { "csv" } else { "obj" };
        let mesh = if blob.sdf().is_ok() { "groove" } else { name };
        let (mesh, file) = (format!("{mesh}.{kind}"), format!("{name}.msw"));
        let names = SourceNames { mesh: &mesh, blob: &file };
        for folder in folders {
            files.push((format!("{folder}/{name}.rs"), rust_module(&blob, names).into_bytes()));
            files.push((format!("{folder}/{file}"), bytes.clone()));
        }
        let c = format!("c-api/examples/{name}");
        files.push((format!("{c}.h"), c_header(&blob, names).into_bytes()));
        files.push((format!("{c}.c"), c_source(&blob, names).into_bytes()));
    }
    let csv = zones_csv(&zones()).into_bytes();
    files.push(("examples/fence/src/zones.csv".to_owned(), csv));
    files
}

/// The geofence of the example `fence`.
///
/// # Panics
/// Never: it is finite.
#[must_use]
pub fn zone_curves() -> Vec<u8> {
    let built = curve::build(&zones(), &CurveOptions::default(), Watch::NONE);
    built.expect("finite").0.to_bytes()
}

/// The box tree of the clamps of the example `keep_out`, by the builder's defaults.
///
/// # Panics
/// Never: the clamps have an area.
#[must_use]
pub fn clamps_tree() -> Vec<u8> {
    let (positions, triangles) = clamps();
    let mesh = Mesh::new(positions, triangles);
    let (tables, _) = build(mesh.as_input(), &TreeOptions::default(), Watch::NONE).expect("builds");
    tables.to_bytes()
}

/// The box trees of the link and of the table of the example `guard`, for pairs of models.
///
/// # Panics
/// Never: both have an area.
#[must_use]
pub fn arm_trees() -> [Vec<u8>; 2] {
    let options = TreeOptions::default().with_closest(false);
    [link(), table()].map(|(positions, triangles)| {
        let mesh = Mesh::new(positions, triangles);
        build(mesh.as_input(), &options, Watch::NONE).expect("builds").0.to_bytes()
    })
}

/// The box tree of `groove_block()`, with every section that a tree can have.
#[must_use]
pub fn groove_tree() -> Vec<u8> {
    let (positions, triangles) = groove_block();
    let mesh = Mesh::new(positions, triangles);
    let options = TreeOptions::default().with_cull(true).with_winding(true);
    let (tables, _) = build(mesh.as_input(), &options, Watch::NONE).expect("builds");
    tables.to_bytes()
}

/// 64 triboxes of the torus of the fixtures, and nothing else.
///
/// # Panics
/// Never: the torus is in the domain.
#[must_use]
pub fn torus_triboxes() -> Vec<u8> {
    let (positions, triangles) = torus(2.0, 0.75, 48, 24);
    let mesh = Mesh::new(positions, triangles);
    let (tables, _) = tribox::build(mesh.as_input(), &TriboxOptions::new(64), Watch::NONE)
        .expect("in the domain");
    tables.to_bytes()
}

/// Tight hulls of the bracket, and nothing else.
///
/// # Panics
/// Never: there is room around the bracket.
#[must_use]
pub fn bracket_hulls() -> Vec<u8> {
    let (positions, triangles) = bracket();
    let mesh = Mesh::new(positions, triangles);
    // Little polish: a test makes them again.
    let options = ChainOptions::of_faces(&[64, 160]).with_effort(0.1);
    let (tables, _) = tight::build(mesh.as_input(), &options, Watch::NONE).expect("room around it");
    tables.to_bytes()
}

/// The hull hierarchy of a torus, and a key frame in which the torus is bent and stretched: its
/// places are exact in f32, whatever the machine.
///
/// # Panics
/// Never: the torus is a solid.
#[must_use]
pub fn bending_torus() -> Vec<u8> {
    let (positions, triangles) = torus(2.0, 0.75, 16, 8);
    let bent = |&[x, y, z]: &[f32; 3]| [x, 0.5 * y, z + 0.25 * x * x];
    let frame = KeyFrame { positions: positions.iter().map(bent).collect(), rounding: 0.0 };
    let mesh = Mesh::new(positions, triangles);
    let levels = Levels::Deform(&[frame]);
    let options = BuildOptions { levels, base_faces: 48, ..BuildOptions::default() };
    hull::build(mesh.as_input(), &options, Watch::NONE).expect("a solid").0.to_bytes()
}

/// The fence of the fixtures, on a grid.
///
/// # Panics
/// Never: its coordinates are finite.
#[must_use]
pub fn fence_curves() -> Vec<u8> {
    let options = CurveOptions::default();
    curve::build(&fence(), &options, Watch::NONE).expect("finite").0.to_bytes()
}

/// A tool path of 2,000 segments, on a grid.
///
/// # Panics
/// Never: its coordinates are finite.
#[must_use]
pub fn tool_path_curve() -> Vec<u8> {
    let options = CurveOptions::default();
    curve::build(&[tool_path(2000)], &options, Watch::NONE).expect("finite").0.to_bytes()
}
