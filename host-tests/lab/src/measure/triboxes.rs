//! Tribox hierarchies as stored: what they cost, and how often they prove a mesh apart from its
//! moved copy.

use meshsweep::progress::Watch;
use meshsweep::tribox::{self, TriboxOptions};
use meshsweep_core::Pose as CorePose;
use meshsweep_core::ScratchEntry;
use meshsweep_core::internal::tribox::FACES;
use meshsweep_core::{Budget, NodePair, Tribox, Triboxes};
use meshsweep_counted::triboxes::by_vertices;
use meshsweep_host_tests::workload::Subject;
use meshsweep_host_tests::workload::contact::Surface;
use meshsweep_host_tests::workload::pose::{poses, sphere};
use meshsweep_xtask::table::{Table, fixed, row};

/// Poses of the moved mesh.
const POSES: usize = 1_000;

/// Triboxes of the finest level.
const TRIBOXES: u32 = 64;

/// A blob of a mesh's triboxes alone.
///
/// # Errors
/// A coordinate is out of the domain.
pub fn blob(subject: &Subject, count: u32) -> Result<Vec<u8>, String> {
    let mesh = &subject.mesh;
    let built = tribox::build(mesh.as_input(), &TriboxOptions::new(count), Watch::NONE);
    Ok(built.map_err(|error| error.to_string())?.0.to_bytes())
}

/// Faces of a tribox that its clean-up leaves.
#[must_use]
pub fn faces(tribox: &Tribox) -> usize {
    let boundary = tribox.boundary().cleaned();
    (0..FACES).filter(|&face| !boundary.face(face).is_empty()).count()
}

/// The tables.
///
/// # Errors
/// The mesh is flat or out of the domain, or triboxes deny that meshes meet.
pub fn tables(subject: &Subject) -> Result<Vec<Table>, String> {
    let bytes = blob(subject, TRIBOXES)?;
    let all = Triboxes::open(&bytes).map_err(|error| error.to_string())?;
    let surface = Surface::new(subject);
    let cases: Vec<(CorePose, bool)> = poses(&sphere(subject), POSES)
        .map(|(pose, core)| (core, surface.meets_moved(&pose)))
        .collect();
    let apart_in_truth = cases.iter().filter(|(_, meet)| !meet).count();
    let columns = [
        "triboxes",
        "bytes",
        "void %",
        "settled",
        "of those apart %",
        "pairs tested",
        "most",
        "if apart",
        "by vertices",
        "pairs tested by vertices",
        "candidates",
    ];
    let mut table = Table::new(
        "triboxes",
        "Stored triboxes: a mesh proved apart from its moved copy",
        &columns,
    );
    for level in all.levels() {
        let triboxes = all.coarser(level.triboxes);
        let mut stack = vec![ScratchEntry::EMPTY; triboxes.separation_entries(&triboxes)];
        let mut pairs = vec![NodePair::EMPTY; 1 << 16];
        let (mut settled, mut tested, mut most, mut tested_apart) = (0usize, 0u64, 0, 0u64);
        let (mut by_vertices_settled, mut by_vertices_tested, mut found) = (0usize, 0u64, 0usize);
        for (pose, meet) in &cases {
            let answer = triboxes
                .separation(&triboxes, *pose, Budget::EXACT, &mut stack)
                .map_err(|error| error.to_string())?;
            let (other, other_tested) = by_vertices(&triboxes, &triboxes, pose);
            if *meet && (answer.is_apart() || other) {
                return Err(format!(
                    "{} triboxes deny that the meshes meet: {pose:?}",
                    level.triboxes
                ));
            }
            settled += usize::from(answer.is_apart());
            by_vertices_settled += usize::from(other);
            tested += u64::from(answer.work.bounds);
            tested_apart += if answer.is_apart() { u64::from(answer.work.bounds) } else { 0 };
            by_vertices_tested += u64::from(other_tested);
            most = most.max(answer.work.bounds);
            let all = triboxes.candidates(&triboxes, *pose, &mut pairs, Budget::EXACT, &mut stack);
            found += all.map_err(|error| error.to_string())?.stored;
        }
        let mean = |sum: u64, of: usize| fixed(sum as f64 / of.max(1) as f64, 1);
        let leaves = level.triboxes as usize;
        table.push(row![
            leaves,
            bytes_of(&all, leaves, bytes.len()),
            fixed(100.0 * f64::from(level.void_ratio), 2),
            settled,
            fixed(100.0 * settled as f64 / apart_in_truth.max(1) as f64, 1),
            mean(tested, POSES),
            most as usize,
            mean(tested_apart, settled),
            by_vertices_settled,
            mean(by_vertices_tested, POSES),
            mean(found as u64, POSES),
        ]);
    }
    table.note(format!(
        "{POSES} poses, seeded; {apart_in_truth} pairs of meshes are apart, surface against surface"
    ));
    table.note("bytes: of a blob that was cut there; by vertices: the paper's test, a tribox about the moved tribox's vertices; candidates: pairs of leaves that may meet, mean");
    Ok(vec![table])
}

/// Bytes of a blob that is cut after `leaves` of the triboxes, of `whole` bytes with all.
fn bytes_of(all: &Triboxes<'_>, leaves: usize, whole: usize) -> usize {
    let kept = all.levels().take_while(|level| level.triboxes as usize <= leaves).count();
    let dropped = all.leaf_count() as usize - leaves;
    // A level's record; a split's number and two nodes.
    whole - 16 * (all.level_count() as usize - kept) - (2 + 2 * 40) * dropped
}
