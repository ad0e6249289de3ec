//! The box tree on a mesh: what it takes, what it costs and how right it is.

mod accuracy;

use meshsweep::bvh::{TreeOptions, TreeReport, build};
use meshsweep::emit::Sections;
use meshsweep::progress::Watch;
use meshsweep_core::{Budget, Bvh, ClosestPoint, ScratchEntry, SectionKind};
use meshsweep_host_tests::workload::Subject;
use meshsweep_xtask::table::{Cell, Table, fixed, row};

/// All tables of the box tree.
///
/// # Errors
/// An answer or a proof fails.
pub fn tables(subject: &Subject) -> Result<Vec<Table>, String> {
    let grid = Built::new(subject, &TreeOptions::default());
    let single = Built::new(subject, &TreeOptions::default().with_f32(true));
    let mut tables = vec![shape(&grid), sections(subject)];
    tables.push(accuracy::table(subject, &grid, &single)?);
    tables.push(proofs(subject, [("16-bit grid", &grid), ("f32", &single)])?);
    Ok(tables)
}

/// A tree's blob and what building it said.
pub struct Built {
    tables: Sections,
    /// What building said.
    pub report: TreeReport,
    bytes: Vec<u8>,
}

impl Built {
    /// Builds the tree.
    pub fn new(subject: &Subject, options: &TreeOptions) -> Self {
        let (tables, report) = build(
            meshsweep::mesh::Input {
                input_triangles: subject.triangles_read,
                ..subject.mesh.as_input()
            },
            options,
            Watch::NONE,
        )
        .expect("builds");
        let bytes = tables.to_bytes();
        Self { tables, report, bytes }
    }

    /// Opens it.
    pub fn open(&self) -> Result<Bvh<'_>, String> {
        Bvh::open(&self.bytes).map_err(|error| error.to_string())
    }
}

/// Exact answers to a list of points.
fn answers(tree: &Bvh<'_>, points: &[[f32; 3]]) -> Result<Vec<ClosestPoint>, String> {
    let mut stack = vec![ScratchEntry::EMPTY; tree.header().stack_entries as usize];
    let ask = |&point: &[f32; 3]| tree.closest_point(point, Budget::EXACT, &mut stack);
    points.iter().map(ask).collect::<Result<_, _>>().map_err(|error| error.to_string())
}

fn shape(built: &Built) -> Table {
    let columns = [
        "triangles",
        "leaves",
        "nodes",
        "children a node",
        "depth",
        "stack entries",
        "stack bytes",
        "build s",
        "surface error",
    ];
    let mut table = Table::new("tree", "Box tree, 16-bit grid", &columns);
    let (report, header) = (&built.report, &built.report.header);
    table.push(row![
        report.triangles,
        report.leaves,
        report.nodes,
        fixed(report.mean_children, 2),
        report.depth,
        header.stack_entries,
        header.stack_entries as usize * size_of::<ScratchEntry>(),
        fixed(report.time.as_secs_f64(), 2),
        Cell::Scientific(f64::from(header.surface_error)),
    ]);
    table.note("surface error: of the local frame, whose largest coordinate is in 0.5 to 1");
    table
}

/// Bytes a triangle of each section, for what the tree is to serve.
fn sections(subject: &Subject) -> Table {
    let columns = ["section", "closest only", "segments only", "both", "both, f32", "everything"];
    let mut table =
        Table::new("tree_sections", "Bytes a triangle of a box tree that serves", &columns);
    let both = TreeOptions::default().with_closest(true).with_segments(true).with_cull(false);
    let kinds = [
        both.with_segments(false),
        both.with_closest(false),
        both,
        both.with_f32(true),
        both.with_cull(true),
    ];
    let built = kinds.map(|options| Built::new(subject, &options));
    let triangles = subject.mesh.triangles.len() as f64;
    for kind in SectionKind::ALL.into_iter().filter(|kind| kind.is_bvh()) {
        let bytes = |built: &Built| {
            let section = built.tables.bodies.iter().find(|(found, _)| *found == kind);
            section.map_or(Cell::Empty, |(_, body)| fixed(body.len() as f64 / triangles, 2))
        };
        let cells = built.iter().map(bytes);
        table.push([Cell::from(kind.name())].into_iter().chain(cells).collect());
    }
    let total = |built: &Built| fixed(built.bytes.len() as f64 / triangles, 2);
    table.push(
        [Cell::from("all, with header")].into_iter().chain(built.iter().map(total)).collect(),
    );
    table.note(
        "vertices on a 16-bit grid but for f32; everything: both, and normal cones for culling",
    );
    table
}

/// What the independent checker proves from the bytes and the mesh.
fn proofs(subject: &Subject, trees: [(&str, &Built); 2]) -> Result<Table, String> {
    let columns = [
        "vertices as",
        "triangles",
        "stored vertices",
        "frames",
        "coordinates in boxes",
        "by integers",
        "violations",
    ];
    let mut table = Table::new(
        "tree_proofs",
        "Proved from the blob and the mesh, in exact arithmetic",
        &columns,
    );
    for (name, built) in trees {
        let proof = meshsweep::check::check_tree(&built.bytes, &subject.mesh)?;
        table.push(row![
            name,
            proof.triangles,
            proof.vertices,
            proof.frames,
            proof.contained,
            proof.exact_contained,
            0usize,
        ]);
    }
    table.note("triangles: found in the mesh, each once, with number, winding and place; frames: make no distance longer");
    table.note(
        "coordinates: of a vertex, between two planes of each box above it; by integers: not decided by f64",
    );
    Ok(table)
}
