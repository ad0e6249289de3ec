//! Segments: the paper's counts (Table 3), and the engines against each other.

use meshsweep_core::{Budget, Ended, Hit, Hull, OuterSearch, RefinedHull, ScratchEntry, Work};
use meshsweep_host_tests::workload::segments;
use meshsweep_xtask::table::{Cell, Table, fixed, row};

use super::brute::Brute;
use super::open;
use super::paper::figures::{HORSE, Model as Paper, STRATEGIES};
use super::rival::Rival;
use super::stopwatch::{Stopwatch, fastest};
use super::table_3::Times;
use super::{BASE_FACES, Subject};

/// Segments of the paper's tests.
pub const COUNT: usize = 10_000;
/// Segments compared with every triangle in f64.
const BRUTE: usize = 300;

/// What a run over all segments gave.
pub struct Run {
    hits: Vec<Option<Hit>>,
    /// A segment's, mean.
    pub nanoseconds: f64,
    work: [u64; 4],
    /// Answers that did not end exact, or were not given because the segment starts inside the
    /// base hull's box.
    unsettled: usize,
}

impl Run {
    fn of(
        segments: &[[[f32; 3]; 2]],
        mut ask: impl FnMut([[f32; 3]; 2]) -> Asked,
    ) -> Result<Self, String> {
        let mut run = Self {
            hits: Vec::with_capacity(segments.len()),
            nanoseconds: 0.0,
            work: [0; 4],
            unsettled: 0,
        };
        let begun = Stopwatch::start();
        for &segment in segments {
            let (hit, work, settled) = ask(segment)?;
            run.hits.push(hit);
            run.unsettled += usize::from(!settled);
            let Work { bounds, triangles, exact, opened, .. } = work;
            for (sum, one) in run.work.iter_mut().zip([bounds, triangles, exact, opened]) {
                *sum += u64::from(one);
            }
        }
        run.nanoseconds = begun.nanoseconds_each(segments.len());
        Ok(run)
    }

    /// Segments that hit.
    pub fn hit_count(&self) -> usize {
        self.hits.iter().flatten().count()
    }

    /// Mean of a counter: nodes, triangles, exact, splits.
    pub fn mean(&self, counter: usize) -> Cell {
        fixed(self.work[counter] as f64 / self.hits.len() as f64, 1)
    }

    fn disagreements(&self, other: &Self) -> usize {
        self.hits
            .iter()
            .zip(&other.hits)
            .filter(|(a, b)| a.map(|hit| hit.t) != b.map(|hit| hit.t))
            .count()
    }
}

type Asked = Result<(Option<Hit>, Work, bool), String>;

fn cover(model: &Hull<'_>, segments: &[[[f32; 3]; 2]], queue: usize) -> Result<Run, String> {
    let mut queue = vec![ScratchEntry::EMPTY; queue];
    Run::of(segments, |[a, b]| {
        let answer =
            model.first_hit(a, b, Budget::EXACT, &mut queue).map_err(|error| error.to_string())?;
        Ok((answer.hit, answer.work, answer.ended == Ended::Exact))
    })
}

/// Splits of the refined hull.
const SPLITS: usize = 4096;

/// All segments on the refined hull, from the base hull each.
pub fn hull(
    model: &Hull<'_>,
    segments: &[[[f32; 3]; 2]],
    search: OuterSearch,
) -> Result<Run, String> {
    let mut refined = Box::new(RefinedHull::<SPLITS>::new());
    let mut scratch = [ScratchEntry::EMPTY; 1024];
    let mut hits = [Hit::EMPTY; 64];
    Run::of(segments, |[a, b]| {
        refined.reset();
        let answer = model
            .outer_hits(a, b, search, &mut refined, &mut hits, Budget::EXACT, &mut scratch)
            .map_err(|error| error.to_string())?;
        let settled = answer.ended == Ended::Exact && !answer.starts_inside;
        Ok((hits.get(..answer.stored).and_then(<[Hit]>::first).copied(), answer.work, settled))
    })
}

/// Faces tested and splits a segment for each base hull, and times, beside the paper's Table 3 and
/// Figure 8.
pub fn work(subject: &Subject) -> Result<[Table; 3], String> {
    let columns = [
        "strategy",
        "base faces",
        "outer faces",
        "outer bounds",
        "outer splits",
        "paper faces",
        "paper splits",
        "first faces",
        "first bounds",
        "first splits",
        "disagree",
    ];
    let mut table = Table::new(
        "outer_hits",
        "Work a segment on the refined hull, beside paper 000, Table 3",
        &columns,
    );
    let segments = segments(subject, COUNT);
    let paper = Paper::of(&subject.name);
    let mut times = Times::new(subject, &segments, paper.is_some_and(Paper::is_horse));
    let (mut hit_count, mut unsettled) = (0, 0);
    for (strategy, (priority, name)) in STRATEGIES.into_iter().enumerate() {
        for (place, (base_faces, theirs)) in HORSE.into_iter().enumerate() {
            if base_faces > subject.mesh.triangles.len() {
                continue;
            }
            let built = subject.build(base_faces, priority)?;
            let model = open(&built)?;
            let reference = cover(&model, &segments, model.scratch_entries())?;
            let [outer, first] = [OuterSearch::Outer, OuterSearch::First]
                .map(|search| hull(&model, &segments, search));
            let (outer, first) = (outer?, first?);
            let theirs = paper.filter(|paper| paper.is_horse()).map(|_| theirs[strategy]);
            table.push(row![
                name,
                model.header().base_triangles,
                outer.mean(1),
                outer.mean(0),
                outer.mean(3),
                theirs.map(|[faces, _]| faces),
                theirs.map(|[_, splits]| splits),
                first.mean(1),
                first.mean(0),
                first.mean(3),
                outer.disagreements(&reference) + first.disagreements(&reference),
            ]);
            times.push(name, &model, [place, strategy])?;
            hit_count = reference.hit_count();
            unsettled += outer.unsettled + first.unsettled + reference.unsettled;
        }
    }
    let paper_hits =
        paper.map_or_else(String::new, |paper| format!("; the paper's: {}", paper.hits));
    table.note(format!(
        "{COUNT} segments with ends on two different sides of a box twice the mesh's; \
            {hit_count} hit{paper_hits}"
    ));
    table.note(
        "outer: until every crossed face is the surface's, the paper's question; first: \
        until the first hit is certain",
    );
    table.note(
        "bounds: swept triangles tested instead of the faces below; disagree: first hits \
        that differ from the sweep's",
    );
    if unsettled > 0 {
        table.note(format!(
            "{unsettled} answers did not end exact or started inside the base hull's box"
        ));
    }
    if let Some(remark) = paper.and_then(|paper| paper.remark(subject.mesh.triangles.len())) {
        table.note(remark);
    }
    let [times, figure] = times.finish();
    Ok([table, times, figure])
}

/// First hits by each engine and by parry3d: time, work and agreement.
pub fn engines(subject: &Subject, model: &Hull<'_>) -> Result<Table, String> {
    let columns =
        ["engine", "ns", "of parry3d", "hits", "nodes", "triangles", "exact", "splits", "disagree"];
    let mut table = Table::new("first_hit", "First hit of the same segments", &columns);
    let segments = segments(subject, COUNT);
    let rival = Rival::new(subject)?;
    let by_rival = || {
        let begun = Stopwatch::start();
        let hits: Vec<Option<f32>> =
            segments.iter().map(|&segment| rival.first_hit(segment)).collect();
        Ok((hits, begun.nanoseconds_each(segments.len())))
    };
    let (theirs, their_ns) = fastest(by_rival, |run| run.1)?;
    let capacity = model.scratch_entries();
    let reference = cover(model, &segments, capacity)?;
    let runs = [
        (
            format!("first_hit, queue {capacity}"),
            fastest(|| cover(model, &segments, capacity), |run| run.nanoseconds)?,
        ),
        (
            "first_hit, queue 4096".to_owned(),
            fastest(|| cover(model, &segments, 4096), |run| run.nanoseconds)?,
        ),
        (
            format!("outer_hits First, base {BASE_FACES}"),
            fastest(|| hull(model, &segments, OuterSearch::First), |run| run.nanoseconds)?,
        ),
        (
            format!("outer_hits Outer, base {BASE_FACES}"),
            fastest(|| hull(model, &segments, OuterSearch::Outer), |run| run.nanoseconds)?,
        ),
    ];
    for (name, run) in runs {
        table.push(row![
            name,
            fixed(run.nanoseconds, 0),
            fixed(run.nanoseconds / their_ns, 2),
            run.hit_count(),
            run.mean(0),
            run.mean(1),
            run.mean(2),
            run.mean(3),
            run.disagreements(&reference),
        ]);
    }
    let both = reference.hits.iter().zip(&theirs);
    let their_disagreements =
        both.filter(|(ours, theirs)| ours.is_some() != theirs.is_some()).count();
    let empty = || Cell::Empty;
    table.push(row![
        "parry3d TriMesh ray",
        fixed(their_ns, 0),
        fixed(1.0, 2),
        theirs.iter().flatten().count(),
        empty(),
        empty(),
        empty(),
        empty(),
        their_disagreements,
    ]);
    table.note(
        "disagree: first hits that differ from first_hit's; for parry3d, in f32, only hit \
        or no hit is compared",
    );
    table.note(against_brute(subject, model, &segments[..BRUTE])?);
    Ok(table)
}

fn against_brute(
    subject: &Subject,
    model: &Hull<'_>,
    segments: &[[[f32; 3]; 2]],
) -> Result<String, String> {
    let brute = Brute::new(subject);
    let mut queue = vec![ScratchEntry::EMPTY; model.scratch_entries()];
    let (mut outside, mut grazing) = (0, 0);
    for &[a, b] in segments {
        let ours =
            model.first_hit(a, b, Budget::EXACT, &mut queue).map_err(|error| error.to_string())?;
        let (theirs, clear) = brute.first_hit([a, b]);
        let inside = match theirs {
            None => ours.is_clear(),
            Some(t) => {
                f64::from(ours.t.lower) <= t + 1.0e-12 && t <= f64::from(ours.t.upper) + 1.0e-12
            }
        };
        // Where a hit or miss is within rounding of an edge, either answer is right.
        grazing += usize::from(!clear);
        outside += usize::from(clear && !inside);
    }
    Ok(format!(
        "f64 brute force on {} segments: {outside} outside of the interval, {grazing} too near \
            an edge to compare",
        segments.len()
    ))
}
