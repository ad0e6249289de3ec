//! Distance fields: errors found and guaranteed beside those of a plain grid of as many bytes,
//! questions that the field decides alone, and answers that lie outside of the truth.
//!
//! *The plain grid* has a byte a corner and one error for all of it, which its worst cell decides.
//! It is a lattice of the builder without its cells' errors: the corners of about twice the bytes.
//! The builder moves them so that cells become narrow, and proves them. So the grid is better than
//! one of rounded distances.
//!
//! *The truth* is the interval of the box tree, whose code is another. Some points are compared
//! with all triangles in f64.

use meshsweep::bvh::TreeOptions;
use meshsweep::mesh::Input;
use meshsweep::progress::Watch;
use meshsweep::sdf::{SdfKind, SdfLayout, SdfOptions, SdfReport, build};
use meshsweep_core::{Blob, Budget, Bvh, Interval, QueryError, ScratchEntry, Sdf, Side, Verdict};
use meshsweep_host_tests::generate::Rng;
use meshsweep_host_tests::oracle::field::Field;
use meshsweep_host_tests::workload::Subject;
use meshsweep_xtask::table::{Cell, Table, fixed, row};
use rayon::prelude::*;

use super::brute::Brute;
use super::tree;

/// Points, unless told otherwise.
pub const QUERIES: usize = 100_000;

/// Bytes of the fields.
const BYTES: [u32; 3] = [4 << 10, 8 << 10, 16 << 10];

/// Points that are asked at once, by one thread.
const AT_ONCE: usize = 4096;

/// Points of each field that are compared with every triangle.
const BRUTE: usize = 300;

/// How far outside of the surface points count, of the diagonal: where most questions are.
const NEAR: f64 = 0.1;

/// Distances that are asked about, of the diagonal.
const CLOSER: [f64; 3] = [0.01, 0.02, 0.05];

/// Errors at points, each a part of the diagonal, and verdicts.
#[derive(Clone, Copy, Debug, Default)]
struct Found {
    count: usize,
    outside: usize,
    /// Half widths of intervals: what the field guarantees of the middle.
    guaranteed: Errors,
    /// How far the middle is from the truth.
    found: Errors,
    /// The same of the function of a plain grid.
    of_grid: Errors,
    /// Verdicts about distances, and those that are decided.
    asked: usize,
    decided: [usize; 3],
}

#[derive(Clone, Copy, Debug, Default)]
struct Errors {
    sum: f64,
    most: f64,
    count: usize,
}

impl Errors {
    fn add(&mut self, error: f64) {
        self.sum += error;
        self.most = self.most.max(error);
        self.count += 1;
    }

    fn join(self, other: Self) -> Self {
        let most = self.most.max(other.most);
        Self { sum: self.sum + other.sum, most, count: self.count + other.count }
    }

    /// Mean and largest, per cent of the diagonal.
    fn cells(self, diagonal: f64) -> [Cell; 2] {
        let percent = |error: f64| fixed(100.0 * error / diagonal, 3);
        [percent(self.sum / self.count.max(1) as f64), percent(self.most)]
    }
}

impl Found {
    fn join(self, other: Self) -> Self {
        Self {
            count: self.count + other.count,
            outside: self.outside + other.outside,
            guaranteed: self.guaranteed.join(other.guaranteed),
            found: self.found.join(other.found),
            of_grid: self.of_grid.join(other.of_grid),
            asked: self.asked + other.asked,
            decided: std::array::from_fn(|k| self.decided[k] + other.decided[k]),
        }
    }
}

/// A field, a grid of as many bytes, and the tree that tells the truth.
struct Asked<'a> {
    field: Sdf<'a>,
    grid: Field,
    tree: Bvh<'a>,
    brute: &'a Brute,
    diagonal: f64,
}

impl Asked<'_> {
    /// The truth at a point: its signed distance as the tree knows it.
    fn truth(&self, p: [f32; 3], scratch: &mut [ScratchEntry]) -> Result<Interval, String> {
        let words = |error: QueryError| error.to_string();
        if self.field.kind() == SdfKind::Surface {
            let found = self.tree.closest_point(p, Budget::EXACT, scratch).map_err(words)?;
            return Ok(found.distance);
        }
        let found = self.tree.signed_distance(p, Budget::EXACT, scratch).map_err(words)?;
        let Interval { lower, upper } = found.closest.distance;
        Ok(match found.side {
            Side::Outside => Interval::new(lower, upper),
            Side::Inside => Interval::new(-upper, -lower),
            _ => Interval::new(-upper, upper),
        })
    }

    fn ask(
        &self,
        p: [f32; 3],
        to_brute: bool,
        scratch: &mut [ScratchEntry],
    ) -> Result<Found, String> {
        let mut found = Found { count: 1, ..Found::default() };
        let answer = self.field.distance(p).map_err(|error| error.to_string())?;
        let [lower, upper] = [answer.distance.lower, answer.distance.upper].map(f64::from);
        let truth = self.truth(p, scratch)?;
        let [least, most] = [truth.lower, truth.upper].map(f64::from);
        found.outside += usize::from(lower > most || upper < least);
        if to_brute {
            let length = self.brute.distance(p);
            // Brute force has no sign.
            let holds = |of: f64| lower <= of * (1.0 + 1e-12) && of * (1.0 - 1e-12) <= upper;
            let holds_inside = self.field.kind() == SdfKind::Signed
                && lower <= -length * (1.0 - 1e-12)
                && -length * (1.0 + 1e-12) <= upper;
            found.outside += usize::from(!holds(length) && !holds_inside);
        }
        if least > NEAR * self.diagonal {
            return Ok(found);
        }
        let middle = 0.5 * (least + most);
        found.guaranteed.add(0.5 * (upper - lower));
        found.found.add((0.5 * (upper + lower) - middle).abs());
        if let Some(value) = self.grid.value(p) {
            found.of_grid.add((value - middle).abs());
        }
        if least > 0.0 {
            found.asked += 1;
            for (decided, part) in found.decided.iter_mut().zip(CLOSER) {
                let verdict = self.field.within(p, (part * self.diagonal) as f32);
                let verdict = verdict.map_err(|error| error.to_string())?;
                *decided += usize::from(!matches!(verdict, Verdict::Undecided(_)));
            }
        }
        Ok(found)
    }

    /// Points of the field's box, some thousand at once.
    fn all(&self, count: usize) -> Result<Found, String> {
        let [low, high] = self.field.bounds();
        let blocks = count.div_ceil(AT_ONCE);
        let of_block = |block: usize| {
            let mut rng = Rng::new(0x6669_656c_6400 + block as u64);
            let entries = self.tree.header().stack_entries as usize;
            let mut scratch = vec![ScratchEntry::EMPTY; entries];
            let mut all = Found::default();
            for number in 0..AT_ONCE.min(count - block * AT_ONCE) {
                let p = rng.point_in(low, high);
                let to_brute = block == 0 && number < BRUTE;
                all = all.join(self.ask(p, to_brute, &mut scratch)?);
            }
            Ok(all)
        };
        let found: Vec<Found> =
            (0..blocks).into_par_iter().map(of_block).collect::<Result<_, String>>()?;
        Ok(found.into_iter().fold(Found::default(), Found::join))
    }
}

/// The tables.
///
/// # Errors
/// No field is built, or an answer is wrong.
pub fn tables(subject: &Subject, queries: usize) -> Result<Vec<Table>, String> {
    let columns = [
        "bytes",
        "layout",
        "mean, guaranteed",
        "largest, guaranteed",
        "mean, found",
        "largest, found",
        "1 % decided",
        "2 %",
        "5 %",
        "wrong",
    ];
    let title = "Distance field beside a plain grid: errors in per cent of the diagonal";
    let mut table = Table::new("field", title, &columns);
    let built = tree::Built::new(subject, &TreeOptions::default().with_f32(true));
    let brute = Brute::new(subject);
    let diagonal = subject.diagonal();
    for bytes in BYTES {
        let (blob, report) = field(subject, bytes, None)?;
        let (grid, grid_report) = plain_grid(subject, bytes)?;
        let opened = Blob::open(&blob).map_err(|error| error.to_string())?;
        let field = opened.sdf().map_err(|error| error.to_string())?;
        let asked = Asked { field, grid, tree: built.open()?, brute: &brute, diagonal };
        let found = asked.all(queries)?;
        let [mean, most] = found.guaranteed.cells(diagonal);
        let [mean_found, most_found] = found.found.cells(diagonal);
        let part = |count: usize| fixed(100.0 * count as f64 / found.asked.max(1) as f64, 1);
        let [one, two, five] = found.decided.map(part);
        table.push(row![
            report.bytes,
            report.layout.name(),
            mean,
            most,
            mean_found,
            most_found,
            one,
            two,
            five,
            found.outside
        ]);
        let corners: usize = grid_report.cells.iter().map(|cells| cells + 1).product();
        let [mean_found, most_found] = found.of_grid.cells(diagonal);
        let guaranteed = fixed(100.0 * grid_report.largest_error / diagonal, 3);
        table.push(row![
            corners,
            "plain grid",
            guaranteed.clone(),
            guaranteed,
            mean_found,
            most_found,
            Cell::Empty,
            Cell::Empty,
            Cell::Empty,
            Cell::Empty
        ]);
        if found.outside > 0 {
            return Err(format!("{} answers of {bytes} bytes are wrong", found.outside));
        }
    }
    table.note(format!(
        "{queries} points in the box of the field; errors at those inside and up to a tenth of \
         the diagonal outside, of the middle of the interval; decided: whether the surface is \
         within a part of the diagonal, by the field alone, outside up to a tenth; wrong: answers \
         that do not hold the box tree's, and {BRUTE} of them those of all triangles in f64"
    ));
    Ok(vec![table])
}

fn field(
    subject: &Subject,
    bytes: u32,
    layout: Option<SdfLayout>,
) -> Result<(Vec<u8>, SdfReport), String> {
    let options = SdfOptions::default().with_bytes(bytes).with_layout(layout);
    let mesh = subject.mesh.as_input();
    let input = Input { input_triangles: subject.triangles_read, ..mesh };
    let (sections, report) =
        build(input, &options, Watch::NONE).map_err(|error| error.to_string())?;
    Ok((sections.to_bytes(), report))
}

/// The lattice with the most corners that are no more than so many bytes.
fn plain_grid(subject: &Subject, bytes: u32) -> Result<(Field, SdfReport), String> {
    let mut of_lattice = 2 * bytes;
    loop {
        let (blob, report) = field(subject, of_lattice, Some(SdfLayout::Lattice))?;
        let corners: usize = report.cells.iter().map(|cells| cells + 1).product();
        if corners <= bytes as usize {
            return Ok((Field::of(&blob), report));
        }
        of_lattice -= of_lattice / 32;
    }
}
