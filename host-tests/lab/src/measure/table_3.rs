//! Times of paper 000, Table 3, on the mesh at hand: segments and triangles against the refined
//! hull, the sweep, and every triangle.

use meshsweep::mesh::Mesh;
use meshsweep_core::{Budget, Focus, Hit, Hull, OuterSearch, RefinedHull, ScratchEntry, Verdict};
use meshsweep_host_tests::workload::Subject;
use meshsweep_xtask::table::{Cell, Table, fixed, row};

use super::brute::Brute;
use super::paper::figures::HORSE;
use super::stopwatch::{Stopwatch, fastest};

type Segment = [[f32; 3]; 2];

/// Seconds of the paper for 10,000 segments, by base hull and strategy; then without a hull.
const SECONDS: [[f64; 2]; HORSE.len()] = [
    [22.11, 23.11],
    [21.15, 22.38],
    [20.77, 21.79],
    [21.41, 22.59],
    [23.93, 24.44],
    [26.07, 26.98],
    [28.79, 29.46],
    [44.12, 44.29],
];
const SECONDS_WITHOUT: f64 = 362.63;

/// The second strategy's column.
const SECOND: usize = 1;

/// Characters of the longest bar.
const BAR: f64 = 40.0;

/// Segments after which a kept hull is reset.
const KEPT: [usize; 3] = [1, 10, 100];

/// What is done with a refined hull between two segments.
#[derive(Clone, Copy)]
enum Between {
    /// It is reset after so many.
    Reset(usize),
    /// Splits that the next segment does not need are undone, and some that it needs performed: the
    /// paper's selective coarsening.
    Update,
}

/// Error to which a hull is updated near the next segment, of the diagonal.
const COARSE: f64 = 0.05;

/// Primitives that are timed, and those that are compared with every triangle.
const TIMED: usize = 2_000;
const BRUTE: usize = 100;

/// Splits of the refined hull.
const SPLITS: usize = 4096;

/// The table, filled row by row.
pub struct Times<'a> {
    table: Table,
    segments: &'a [Segment],
    triangles: Vec<[[f32; 3]; 3]>,
    /// Microseconds of a segment, and of a triangle, compared with every triangle.
    brute: [f64; 2],
    is_horse: bool,
    undecided: usize,
    /// [`COARSE`], input units.
    coarse: f32,
    /// Base faces and seconds for 10,000 segments, of the second strategy.
    curve: Vec<(u32, f64)>,
}

impl<'a> Times<'a> {
    /// The columns, and the times without a hierarchy. A primitive outside the mesh's box is
    /// discarded first, as in the paper.
    pub fn new(subject: &Subject, segments: &'a [Segment], is_horse: bool) -> Self {
        let columns = [
            "strategy",
            "base faces",
            "outer, µs",
            "kept for 10",
            "kept for 100",
            "updated",
            "first",
            "sweep",
            "of brute force",
            "paper's",
            "triangle, µs",
            "bounds",
            "tests",
            "of brute force",
        ];
        let mut table = Table::new(
            "table_3",
            "Times of segments and of triangles, beside paper 000, Table 3",
            &columns,
        );
        let segments = &segments[..segments.len().min(TIMED)];
        // A triangle of the segment, and of a point a hundredth of the diagonal beside its end.
        let off = (0.01 * subject.diagonal()) as f32;
        let triangle = |&[a, b]: &Segment| [a, b, b.map(|x| x + off)];
        let triangles: Vec<_> = segments.iter().map(triangle).collect();
        let brute = [by_segment(subject, segments), by_triangle(&subject.mesh, &triangles)];
        table.note(format!(
            "every triangle of the mesh in f64: {:.1} µs a segment, {:.1} µs a triangle",
            brute[0], brute[1]
        ));
        table.note(
            "outer, kept: until every crossed face is the surface's, from the base hull or from \
                the hull that up to 10 or 100 segments left; first: until the first hit is \
                certain; sweep: Hull::first_hit",
        );
        table.note("of brute force: the time of outer, and of a triangle, as a part of it");
        table.note(format!(
            "the paper's: seconds for 10,000 segments over its {SECONDS_WITHOUT} s for all faces"
        ));
        table.note(
            "updated: RefinedHull::update on the next segment, to 5 % of the diagonal: splits away \
             from it are undone",
        );
        let coarse = (COARSE * subject.diagonal()) as f32;
        let curve = Vec::new();
        Times { table, segments, triangles, brute, is_horse, undecided: 0, coarse, curve }
    }

    /// Times one base hull. `place`: row and column of the paper's table.
    pub fn push(
        &mut self,
        name: &str,
        model: &Hull<'_>,
        [row, column]: [usize; 2],
    ) -> Result<(), String> {
        let [outer, kept, long] =
            KEPT.map(|kept| self.refined(model, OuterSearch::Outer, Between::Reset(kept)));
        let (outer, kept, long) = (outer?, kept?, long?);
        let updated = self.refined(model, OuterSearch::Outer, Between::Update)?;
        let first = self.refined(model, OuterSearch::First, Between::Reset(1))?;
        let mut scratch = vec![ScratchEntry::EMPTY; model.scratch_entries() + 20];
        let sweep = fastest(
            || {
                let watch = Stopwatch::start();
                for &[a, b] in self.segments {
                    model
                        .first_hit(a, b, Budget::EXACT, &mut scratch)
                        .map_err(|e| e.to_string())?;
                }
                Ok(micros(&watch, self.segments.len()))
            },
            |&time| time,
        )?;
        let (triangle, work, undecided) = fastest(
            || {
                let (watch, mut work, mut undecided) = (Stopwatch::start(), [0u64; 2], 0);
                for &corners in &self.triangles {
                    let answer = model
                        .meets_triangle(corners, Budget::EXACT, &mut scratch)
                        .map_err(|error| error.to_string())?;
                    work[0] += u64::from(answer.work.bounds);
                    work[1] += u64::from(answer.work.triangles);
                    undecided += usize::from(matches!(answer.verdict, Verdict::Undecided(_)));
                }
                Ok((micros(&watch, self.triangles.len()), work, undecided))
            },
            |run| run.0,
        )?;
        self.undecided += undecided;
        if column == SECOND {
            // Microseconds of one are hundredths of seconds of 10,000.
            self.curve.push((model.header().base_triangles, outer / 100.0));
        }
        let mean = |sum: u64| fixed(sum as f64 / self.triangles.len() as f64, 1);
        let theirs = self.is_horse.then(|| SECONDS[row][column] / SECONDS_WITHOUT);
        self.table.push(row![
            name,
            model.header().base_triangles,
            fixed(outer, 1),
            fixed(kept, 1),
            fixed(long, 1),
            fixed(updated, 1),
            fixed(first, 1),
            fixed(sweep, 1),
            fixed(outer / self.brute[0], 4),
            theirs.map_or(Cell::Empty, |part| fixed(part, 4)),
            fixed(triangle, 1),
            mean(work[0]),
            mean(work[1]),
            fixed(triangle / self.brute[1], 4),
        ]);
        Ok(())
    }

    /// The table, and Figure 8: a curve of the second strategy.
    pub fn finish(mut self) -> [Table; 2] {
        if self.undecided > 0 {
            self.table.note(format!("{} triangles were undecided", self.undecided));
        }
        let columns = ["base faces", "seconds for 10,000", "the paper's horse", "drawn"];
        let title = "Times by the size of the base hull, second strategy, paper 000, Figure 8";
        let mut figure = Table::new("figure_8", title, &columns);
        let most = self.curve.iter().fold(0.0, |most: f64, (_, seconds)| most.max(*seconds));
        for &(faces, seconds) in &self.curve {
            let theirs = HORSE.iter().position(|(base, _)| *base == faces as usize);
            let theirs = theirs.filter(|_| self.is_horse).map(|row| SECONDS[row][SECOND]);
            let length = (BAR * seconds / most).round() as usize;
            figure.push(row![
                faces,
                fixed(seconds, 3),
                theirs.map_or(Cell::Empty, |seconds| fixed(seconds, 2)),
                "#".repeat(length),
            ]);
        }
        figure.note("until every crossed face is the surface's, from the base hull each");
        [self.table, figure]
    }

    /// Microseconds a segment on the refined hull.
    fn refined(
        &self,
        model: &Hull<'_>,
        search: OuterSearch,
        between: Between,
    ) -> Result<f64, String> {
        let mut refined = Box::new(RefinedHull::<SPLITS>::new());
        let mut scratch = [ScratchEntry::EMPTY; 1024];
        let mut hits = [Hit::EMPTY; 64];
        let exact = Budget::EXACT;
        let run = || {
            let watch = Stopwatch::start();
            for (i, &[a, b]) in self.segments.iter().enumerate() {
                match between {
                    Between::Reset(after) if i % after == 0 => refined.reset(),
                    Between::Reset(_) => {}
                    Between::Update => {
                        let focus = Focus::Segment { a, b, radius: 0.0 };
                        refined
                            .update(model, &focus, self.coarse, &mut [])
                            .map_err(|error| error.to_string())?;
                    }
                }
                model
                    .outer_hits(a, b, search, &mut refined, &mut hits, exact, &mut scratch)
                    .map_err(|error| error.to_string())?;
            }
            Ok(micros(&watch, self.segments.len()))
        };
        fastest(run, |&time| time)
    }
}

fn micros(watch: &Stopwatch, count: usize) -> f64 {
    1e-3 * watch.nanoseconds_each(count)
}

/// Whether the box of some points misses the mesh's.
fn misses(mesh: &Mesh, points: &[[f32; 3]]) -> bool {
    let range = |points: &[[f32; 3]], k: usize| {
        points.iter().fold((f32::MAX, f32::MIN), |(low, high), p| (low.min(p[k]), high.max(p[k])))
    };
    (0..3).any(|k| {
        let ((low, high), (from, to)) = (range(points, k), range(&mesh.positions, k));
        low > to || from > high
    })
}

fn by_segment(subject: &Subject, segments: &[Segment]) -> f64 {
    let brute = Brute::new(subject);
    let near: Vec<bool> =
        segments.iter().take(BRUTE).map(|ends| !misses(&subject.mesh, ends)).collect();
    let watch = Stopwatch::start();
    for (ends, _) in segments.iter().zip(&near).filter(|(_, near)| **near) {
        std::hint::black_box(brute.first_hit(*ends));
    }
    micros(&watch, near.len())
}

fn by_triangle(mesh: &Mesh, triangles: &[[[f32; 3]; 3]]) -> f64 {
    use meshsweep_core::internal::geom::{Contact, triangles_meet};
    let near: Vec<bool> =
        triangles.iter().take(BRUTE).map(|corners| !misses(mesh, corners)).collect();
    let wide = |corners: [[f32; 3]; 3]| corners.map(|corner| corner.map(f64::from));
    let watch = Stopwatch::start();
    for (corners, _) in triangles.iter().zip(&near).filter(|(_, near)| **near) {
        let meets = mesh.triangles.iter().any(|t| {
            let other = t.map(|v| mesh.positions[v as usize]);
            triangles_meet(wide(other), wide(*corners), 0.0) != Contact::Apart
        });
        std::hint::black_box(meets);
    }
    micros(&watch, near.len())
}
