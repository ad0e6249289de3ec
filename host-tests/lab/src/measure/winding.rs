//! Winding numbers of a mesh and of the same mesh with holes, held to a sum in f64.

use meshsweep::bvh::{TreeOptions, build};
use meshsweep::mesh::{Input, Mesh};
use meshsweep::progress::Watch;
use meshsweep_core::{Budget, Bvh, Interval, ScratchEntry, Side, Undecided, WindingNumber};
use meshsweep_host_tests::oracle::{distance_to_mesh, winding_number};
use meshsweep_host_tests::workload::{Points, Subject, points};
use meshsweep_xtask::table::{Cell, Table, fixed, row, scientific};
use rayon::prelude::*;

use super::stopwatch::answers as run;

/// Points of each kind.
const POINTS: usize = 2000;

/// Every so many triangles one is missing.
const HOLES: usize = 10;

/// Distance, as a part of the diagonal, from which on f64 tells the number to 1e-6.
const TOLD: f64 = 1e-4;

/// The table.
///
/// # Errors
/// The builder's refusal, or an answer that is wrong.
pub fn table(subject: &Subject) -> Result<Table, String> {
    let columns = [
        "mesh",
        "vertices",
        "points",
        "inside",
        "wrong",
        "undecided",
        "median width",
        "nodes",
        "triangles",
        "us",
        "all triangles, us",
        "bytes a triangle",
    ];
    let mut table = Table::new("winding", "Winding numbers: is a point inside?", &columns);
    let mut sieve = subject.mesh.clone();
    let keep = |number: usize| number % HOLES != HOLES / 2;
    let numbered = sieve.triangles.iter().zip(&sieve.source).enumerate();
    (sieve.triangles, sieve.source) =
        numbered.filter(|(number, _)| keep(*number)).map(|(_, (t, s))| (*t, *s)).unzip();
    for (name, mesh) in [("as it is", &subject.mesh), ("a tenth missing", &sieve)] {
        for (vertices, is_f32) in [("16-bit grid", false), ("f32", true)] {
            let options = TreeOptions::default().with_winding(true).with_f32(is_f32);
            let input = Input { input_triangles: subject.triangles_read, ..mesh.as_input() };
            let (sections, report) = build(input, &options, Watch::NONE).map_err(said)?;
            let bytes = sections.to_bytes();
            let tree = Bvh::open(&bytes).map_err(said)?;
            let moments = tree.header().nodes as f64 * 60.0 / report.triangles as f64;
            for kind in [Points::Far, Points::Near] {
                let points = points(subject, kind, POINTS);
                let measured = Measured::of(mesh, &tree, &points, subject.diagonal())?;
                let mut cells = row![name, vertices, kind.name()];
                cells.extend(measured.cells());
                cells.push(fixed(moments, 2));
                table.push(cells);
                if measured.wrong > 0 {
                    return Err(format!("{} winding numbers are wrong", measured.wrong));
                }
            }
        }
    }
    Ok(table)
}

fn said(error: impl std::fmt::Display) -> String {
    error.to_string()
}

struct Measured {
    answers: Vec<WindingNumber>,
    wrong: usize,
    time: f64,
    time_of_all: f64,
}

impl Measured {
    fn of(mesh: &Mesh, tree: &Bvh<'_>, points: &[[f32; 3]], diagonal: f64) -> Result<Self, String> {
        let mut stack = vec![ScratchEntry::EMPTY; tree.scratch_entries()];
        let (answers, time) = run(points, |&point| {
            tree.winding_number(point, Budget::EXACT, &mut stack).map_err(said)
        })?;
        let in_f64 = |point: &[f32; 3]| {
            winding_number(point.map(f64::from), &mesh.positions, &mesh.triangles, diagonal)
        };
        let few = &points[..points.len().min(50)];
        let (_, time_of_all) = run(few, |point| Ok::<_, String>(in_f64(point)))?;
        let is_wrong = |(point, answer): (&[f32; 3], &WindingNumber)| {
            let distance = distance_to_mesh(*point, &mesh.positions, &mesh.triangles).lower;
            let Interval { lower, upper } = answer.number;
            let truth = in_f64(point);
            distance > TOLD * diagonal
                && (f64::from(lower) > truth + 1e-6 || truth - 1e-6 > f64::from(upper))
        };
        let wrong = points.par_iter().zip(&answers).filter(|&pair| is_wrong(pair)).count();
        Ok(Self { answers, wrong, time, time_of_all })
    }

    fn cells(&self) -> Vec<Cell> {
        let count = |is: fn(&WindingNumber) -> bool| self.answers.iter().filter(|a| is(a)).count();
        let mean = |of: fn(&WindingNumber) -> u32| {
            let sum: f64 = self.answers.iter().map(|answer| f64::from(of(answer))).sum();
            fixed(sum / self.answers.len() as f64, 1)
        };
        let width = |answer: &WindingNumber| f64::from(answer.number.upper - answer.number.lower);
        let mut widths: Vec<f64> = self.answers.iter().map(width).collect();
        widths.sort_by(f64::total_cmp);
        row![
            count(|answer| answer.side == Side::Inside),
            self.wrong,
            count(|answer| matches!(answer.side, Side::Undecided(Undecided::Resolution))),
            scientific(widths[widths.len() / 2]),
            mean(|answer| answer.work.bounds),
            mean(|answer| answer.work.triangles),
            fixed(self.time / 1e3, 2),
            fixed(self.time_of_all / 1e3, 1),
        ]
    }
}
