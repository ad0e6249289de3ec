//! Faces of unions of triboxes (paper 001, Table 1).

use meshsweep::bvh::exact_blob;
use meshsweep::tribox::{Hierarchy, SplitOptions};
use meshsweep_core::{Bvh, Tribox};
use meshsweep_host_tests::workload::Subject;
use meshsweep_xtask::table::{Cell, Table, fixed, row};

use crate::measure::triboxes::faces;

/// Triboxes, and the faces that the paper has in its two examples of 450 and 950 faces.
const PAPER: [(usize, [Option<u32>; 2]); 4] = [
    (1, [Some(14), Some(8)]),
    (2, [Some(28), Some(18)]),
    (3, [Some(46), None]),
    (8, [None, Some(72)]),
];

/// Faces smaller than this part of the diagonal vanish in the clean-up.
const CLEAN: f64 = 0.05;

/// Faces of the mesh over those of its triboxes.
///
/// # Errors
/// The mesh is flat or out of the domain.
pub fn table(subject: &Subject) -> Result<Table, String> {
    let columns = [
        "triboxes",
        "faces",
        "ratio",
        "faces, cleaned",
        "ratio, cleaned",
        "paper faces, a and b",
        "paper ratio, a and b",
    ];
    let title = "Faces of triboxes, beside paper 001, Table 1";
    let mut table = Table::new("tribox_faces", title, &columns);
    let bytes = exact_blob(&subject.mesh).map_err(|error| error.to_string())?;
    let tree = Bvh::open(&bytes).map_err(|error| error.to_string())?;
    let options = SplitOptions::default().with_leaves(8);
    let all = Hierarchy::new(&subject.mesh, &tree, &options).map_err(|error| error.to_string())?;
    let clean = (CLEAN * subject.diagonal()) as f32;
    let count = subject.mesh.triangles.len();
    for (triboxes, theirs) in PAPER {
        let leaves = all.leaves(triboxes);
        let proxies: Vec<Tribox> =
            leaves.iter().map(|&leaf| all.nodes[leaf as usize].proxy).collect();
        let plain: usize = proxies.iter().map(faces).sum();
        let cleaned: usize = proxies.iter().map(|of| faces(&of.snapped(clean))).sum();
        let ratio = |of: f64, faces: f64| fixed(of / faces.max(1.0), 2);
        let joined = |text: fn(u32, f64) -> String| {
            let each = theirs.into_iter().zip([450.0, 950.0]);
            let each = each.map(|(faces, of)| faces.map_or("-".to_owned(), |f| text(f, of)));
            Cell::from(each.collect::<Vec<_>>().join(" / "))
        };
        table.push(row![
            leaves.len(),
            plain,
            ratio(count as f64, plain as f64),
            cleaned,
            ratio(count as f64, cleaned as f64),
            joined(|faces, _| faces.to_string()),
            joined(|faces, of| format!("{:.2}", of / f64::from(faces))),
        ]);
    }
    table.note(
        "ratio: the mesh's faces over the triboxes'; cleaned: planes moved outward by up to 5 % \
         of the diagonal so that faces vanish",
    );
    table.note(
        "the paper's objects have 450 (a) and 950 (b) faces: faces compare, ratios grow with \
         the mesh",
    );
    Ok(table)
}
