//! Tight hulls on a Cortex-M4F: bytes, memory, and instructions of a conservative "closer than d?",
//! by the number of faces.

use meshsweep::progress::Watch;
use meshsweep_core::{Blob, TightHulls};
use std::path::Path;

use meshsweep::tight::{self, ChainOptions, cut};
use meshsweep_host_tests::blobs::expected;
use meshsweep_host_tests::workload::Subject;
use meshsweep_lab::measure::tight::FACES;
use meshsweep_xtask::boards::BOARDS;
use meshsweep_xtask::firmware;
use meshsweep_xtask::reading::Reading;
use meshsweep_xtask::table::{Cell, Table, fixed};
use meshsweep_xtask::tools::Tools;
use meshsweep_xtask::workspace;

/// The table of a mesh. The bits of all answers are the host's, or it is an error.
pub fn table(tools: &Tools, mesh: &Path) -> Result<Table, String> {
    let subject = Subject::load(mesh)?;
    let options = ChainOptions::of_faces(&FACES).with_boxes(true, false);
    let (tables, _) = tight::build(subject.mesh.as_input(), &options, Watch::NONE)
        .map_err(|error| error.to_string())?;
    let all = tables.to_bytes();
    let blob = Blob::open(&all).map_err(|error| error.to_string())?;
    let [board, ..] = BOARDS;
    let mut table = Table::new(
        "tight_firmware",
        format!("Tight hulls on a {}: instructions a question, mean and most", board.cpu),
        &[
            "faces",
            "bytes",
            "stack",
            "scratch",
            "closer?",
            "closer?, most",
            "far",
            "far, most",
            "near",
            "near, most",
        ],
    );
    for record in blob.tight_hulls().iter().flat_map(TightHulls::records) {
        // The finest hull of a blob is the one that is asked.
        let tables = cut(&blob, record.faces).ok_or("no tight hulls")?;
        let hulls = tables.to_bytes();
        let opened = TightHulls::open(&hulls).map_err(|error| error.to_string())?;
        let hull = opened.finest().ok_or("no tight hulls")?;
        let bytes = hull.bytes().len() + 2 * record.faces as usize;
        let file = workspace::target().join("hulls.msw");
        std::fs::write(&file, &hulls).map_err(|error| error.to_string())?;
        let reading = firmware::reading(tools, &board, "suite_tight", &file, &expected(&hulls)?)?;
        let cost = |kind: &str| {
            let found = reading.costs.iter().find(|cost| cost.kind == kind);
            found.ok_or_else(|| format!("the image did not ask {kind}"))
        };
        let (within, far, near) = (cost("within")?, cost("closest_far")?, cost("closest_near")?);
        let stack = [within, far, near].iter().map(|cost| cost.stack).max().unwrap_or(0);
        let Reading { scratch, .. } = reading;
        let sizes =
            [record.faces as usize, bytes, stack as usize, scratch as usize].map(Cell::from);
        let costs = [within, far, near].into_iter().flat_map(|cost| [cost.mean, cost.max]);
        table.push(sizes.into_iter().chain(costs.map(|count| fixed(count, 0))).collect());
    }
    table.note(
        "bytes: of the hull in the blob, without boxes for segments; stack, scratch: bytes of RAM",
    );
    table.note("closer?: whether the mesh is within a distance of up to a quarter of the box's width, of points in the doubled box; far, near: an interval of its distance, from there and from next to the hull");
    Ok(table)
}
