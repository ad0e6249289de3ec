//! Segments in trees of k-DOPs, on the refined hull and in the box tree (paper 000, Table 4).

use glam::{DVec3, Vec3};
use meshsweep::bvh::{TreeOptions, build};
use meshsweep::collapse::Priority;
use meshsweep::progress::Watch;
use meshsweep_core::{Budget, Bvh, Facing, OuterSearch, ScratchEntry};
use meshsweep_host_tests::workload::{Subject, segments};
use meshsweep_xtask::table::{Cell, Table, fixed};

use super::dop::Slabs;
use super::figures::Model;
use super::hierarchy::Hierarchy;
use crate::measure::brute::cross;
use crate::measure::open;
use crate::measure::segments::{COUNT, hull};
use crate::measure::stopwatch::Stopwatch;

/// The polytopes of the paper, as [`Slabs::all`] labels them, and its name for each.
const DOPS: [(&str, &str); 4] =
    [("box", "6-DOP"), ("14-DOP", "14-DOP"), ("tribox", "18-DOP"), ("26-DOP", "26-DOP")];

/// Faces of the paper's fastest base hull.
const BASE_FACES: usize = 1_000;

/// All hits of 10,000 segments by each structure: what is tested, and time.
///
/// # Errors
/// The hull is refused, or the trees find other segments that hit.
pub fn table(subject: &Subject) -> Result<Table, String> {
    let columns = [
        "structure",
        "segments that hit",
        "bounds a segment",
        "slabs a segment",
        "triangles a segment",
        "splits a segment",
        "us a segment",
        "of the 26-DOPs'",
        "paper s",
        "of the 26-DOPs'",
    ];
    let title = "Segments in trees of k-DOPs, beside paper 000, Table 4";
    let mut table = Table::new("dops", title, &columns);
    let segments = segments(subject, COUNT);
    let paper = Model::of(&subject.name);
    let mean = |sum: u64, digits| fixed(sum as f64 / COUNT as f64, digits);
    let at = |v: u32| Vec3::from_array(subject.mesh.positions[v as usize]).as_dvec3();
    let corners: Vec<[DVec3; 3]> =
        subject.mesh.triangles.iter().map(|triangle| triangle.map(at)).collect();
    let points: Vec<Vec<DVec3>> = corners.iter().map(|corners| corners.to_vec()).collect();
    let all = Slabs::all();
    let mut rows = Vec::new();
    for (index, (label, name)) in DOPS.into_iter().enumerate() {
        let slabs = all.iter().find(|slabs| slabs.label == label).ok_or("no such slabs")?;
        let tree = Hierarchy::new(slabs, &points, 1);
        let (mut hits, mut nodes, mut triangles) = (0usize, 0, 0u64);
        let begun = Stopwatch::start();
        for ends in &segments {
            let [a, b] = ends.map(|end| Vec3::from_array(end).as_dvec3());
            let mut is_hit = false;
            nodes += tree.meeting([a, b], |e| {
                triangles += 1;
                is_hit |= cross(a, b - a, &corners[e as usize]).1 > 0.0;
            });
            hits += usize::from(is_hit);
        }
        let seconds = begun.seconds();
        let slabs = nodes * slabs.directions.len() as u64;
        let counts = [mean(nodes, 1), mean(slabs, 0), mean(triangles, 1), Cell::Empty];
        rows.push((name, hits, counts, seconds, paper.map(|model| model.dops[index])));
    }
    let dop_hits = rows[0].1;
    if rows.iter().any(|row| row.1 != dop_hits) {
        return Err("trees of different polytopes find other hits".to_owned());
    }
    let built = subject.build(BASE_FACES.min(subject.mesh.triangles.len()), Priority::Span)?;
    let run = hull(&open(&built)?, &segments, OuterSearch::Outer)?;
    let counts = [run.mean(0), Cell::Empty, run.mean(1), run.mean(3)];
    let seconds = run.nanoseconds * 1e-9 * COUNT as f64;
    let theirs = paper.map(|model| model.hull);
    rows.push(("refined hull, base of 1,000", run.hit_count(), counts, seconds, theirs));
    rows.push(box_tree(subject, &segments)?);
    let of_26 = rows[DOPS.len() - 1].3;
    for (name, hits, counts, seconds, theirs) in rows {
        let of = |seconds: u32, model: &Model| f64::from(seconds) / f64::from(model.dops[3]);
        let ratio = theirs.zip(paper).map_or(Cell::Empty, |(s, model)| fixed(of(s, model), 2));
        let first = [Cell::from(name), hits.into()];
        let last = [
            fixed(seconds * 1e6 / COUNT as f64, 2),
            fixed(seconds / of_26, 3),
            theirs.map_or(Cell::Empty, Cell::from),
            ratio,
        ];
        table.push(first.into_iter().chain(counts).chain(last).collect());
    }
    table.note(
        "k-DOPs: binary tree, one triangle a leaf, f64, the segment's own k-DOP against the \
         nodes'; they find all hits, the hull the outer ones, the box tree the first",
    );
    if let Some(model) = paper {
        table.note(format!("the paper's segments that hit: {}", model.hits));
        if let Some(remark) = model.remark(subject.mesh.triangles.len()) {
            table.note(remark);
        }
    }
    Ok(table)
}

type Row = (&'static str, usize, [Cell; 4], f64, Option<u32>);

/// First hits by the box tree.
fn box_tree(subject: &Subject, segments: &[[[f32; 3]; 2]]) -> Result<Row, String> {
    let options = TreeOptions::default();
    let (sections, _) =
        build(subject.mesh.as_input(), &options, Watch::NONE).map_err(|error| error.to_string())?;
    let bytes = sections.to_bytes();
    let tree = Bvh::open(&bytes).map_err(|error| error.to_string())?;
    let mut stack = vec![ScratchEntry::EMPTY; tree.scratch_entries()];
    let (mut hits, mut nodes, mut triangles) = (0, 0u64, 0u64);
    let begun = Stopwatch::start();
    for &[a, b] in segments {
        let found = tree
            .first_hit(a, b, Facing::Both, Budget::EXACT, &mut stack)
            .map_err(|error| error.to_string())?;
        hits += usize::from(found.hit.is_some());
        nodes += u64::from(found.work.bounds);
        triangles += u64::from(found.work.triangles);
    }
    let seconds = begun.seconds();
    let mean = |sum: u64| fixed(sum as f64 / segments.len() as f64, 1);
    let counts = [mean(nodes), Cell::Empty, mean(triangles), Cell::Empty];
    Ok(("box tree, first hit", hits, counts, seconds, None))
}
