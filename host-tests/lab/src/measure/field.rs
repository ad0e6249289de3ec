//! Distance fields: errors found and guaranteed beside those of a plain grid of as many bytes,
//! questions that the field decides alone, and answers that lie outside of the truth.
//!
//! *The plain grid* has a byte a corner and one error for all of it. It is a lattice of the
//! builder, whose cells' errors are proved, without them: the corners of about twice the bytes. Its
//! error is the least that holds at all cells with points that count, once its values are shifted.
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

/// What points tell. Errors are in input units.
#[derive(Clone, Debug, Default)]
struct Found {
    /// Answers and verdicts that are not the truth.
    wrong: usize,
    /// Points whose side the tree does not tell: only their lengths are compared.
    undecided: usize,
    /// Half widths of intervals: what the field guarantees of the middle.
    guaranteed: Errors,
    /// How far the middle is from the truth.
    found: Errors,
    /// The truth less the plain grid's function.
    of_grid: Vec<f64>,
    /// The largest errors below and above of the grid's cells.
    grid_errors: [f64; 2],
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
    fn join(mut self, other: Self) -> Self {
        self.of_grid.extend(other.of_grid);
        Self {
            wrong: self.wrong + other.wrong,
            undecided: self.undecided + other.undecided,
            guaranteed: self.guaranteed.join(other.guaranteed),
            found: self.found.join(other.found),
            of_grid: self.of_grid,
            grid_errors: [0, 1].map(|k| self.grid_errors[k].max(other.grid_errors[k])),
            asked: self.asked + other.asked,
            decided: std::array::from_fn(|k| self.decided[k] + other.decided[k]),
        }
    }

    /// The error that the plain grid guarantees, and those found, once its values are shifted so
    /// that as much is allowed below as above.
    fn grid(&self) -> (f64, Errors) {
        let [low, high] = self.grid_errors;
        let shift = 0.5 * (high - low);
        let mut found = Errors::default();
        self.of_grid.iter().for_each(|over| found.add((over - shift).abs()));
        (0.5 * (low + high), found)
    }
}

/// A field, a grid of as many bytes, and the tree that tells the truth.
struct Asked<'a> {
    field: Sdf<'a>,
    /// Of a field with sides.
    grid: Option<Field>,
    tree: Bvh<'a>,
    brute: &'a Brute,
    diagonal: f64,
}

impl Asked<'_> {
    /// The truth at a point as the tree knows it: its distance, negative inside. `None` if the tree
    /// tells no side; then the bounds of the length.
    fn truth(
        &self,
        p: [f32; 3],
        scratch: &mut [ScratchEntry],
    ) -> Result<(Option<[f64; 2]>, [f64; 2]), QueryError> {
        let of = |distance: Interval| [distance.lower, distance.upper].map(f64::from);
        if self.field.kind() == SdfKind::Surface {
            let length = of(self.tree.closest_point(p, Budget::EXACT, scratch)?.distance);
            return Ok((Some(length), length));
        }
        let found = self.tree.signed_distance(p, Budget::EXACT, scratch)?;
        let [lower, upper] = of(found.closest.distance);
        let signed = match found.side {
            Side::Outside => Some([lower, upper]),
            Side::Inside => Some([-upper, -lower]),
            _ => None,
        };
        Ok((signed, [lower, upper]))
    }

    fn ask(
        &self,
        p: [f32; 3],
        to_brute: bool,
        scratch: &mut [ScratchEntry],
    ) -> Result<Found, QueryError> {
        let mut found = Found::default();
        let answer = self.field.distance(p)?.distance;
        let [lower, upper] = [answer.lower, answer.upper].map(f64::from);
        let misses = |[least, most]: [f64; 2]| lower > most || upper < least;
        let misses_length = |[least, most]: [f64; 2]| {
            misses([least, most])
                && (self.field.kind() == SdfKind::Surface || misses([-most, -least]))
        };
        let (signed, length) = self.truth(p, scratch)?;
        found.wrong += usize::from(signed.map_or_else(|| misses_length(length), misses));
        if to_brute {
            let length = self.brute.distance(p);
            found.wrong +=
                usize::from(misses_length([length * (1.0 - 1e-12), length * (1.0 + 1e-12)]));
        }
        let Some([least, most]) = signed else {
            found.undecided = 1;
            return Ok(found);
        };
        if least > NEAR * self.diagonal {
            return Ok(found);
        }
        let middle = 0.5 * (least + most);
        found.guaranteed.add(0.5 * (upper - lower));
        found.found.add((0.5 * (upper + lower) - middle).abs());
        if let Some((value, errors)) = self.grid.as_ref().and_then(|grid| grid.function(p)) {
            found.of_grid.push(middle - value);
            found.grid_errors = errors;
        }
        if least > 0.0 {
            found.asked += 1;
            for (decided, part) in found.decided.iter_mut().zip(CLOSER) {
                let distance = (part * self.diagonal) as f32;
                let (is_decided, is_wrong) = match self.field.within(p, distance)? {
                    Verdict::Yes => (true, least > f64::from(distance)),
                    Verdict::No => (true, most <= f64::from(distance)),
                    _ => (false, false),
                };
                *decided += usize::from(is_decided);
                found.wrong += usize::from(is_wrong);
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
                let found = self.ask(p, to_brute, &mut scratch);
                all = all.join(found.map_err(|error| error.to_string())?);
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
    let mut undecided = 0;
    for bytes in BYTES {
        let (blob, report) = field(subject, bytes, None)?;
        let opened = Blob::open(&blob).map_err(|error| error.to_string())?;
        let field = opened.sdf().map_err(|error| error.to_string())?;
        let grid = match field.kind() {
            SdfKind::Signed => Some(plain_grid(subject, bytes)?),
            _ => None,
        };
        let corners = grid.as_ref().map(corners);
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
            found.wrong
        ]);
        if let Some(corners) = corners {
            let (guaranteed, errors) = found.grid();
            let guaranteed = fixed(100.0 * guaranteed / diagonal, 3);
            let [mean_found, most_found] = errors.cells(diagonal);
            let mut cells =
                row![corners, "plain grid", guaranteed.clone(), guaranteed, mean_found, most_found];
            cells.resize(columns.len(), Cell::Empty);
            table.push(cells);
        }
        undecided = undecided.max(found.undecided);
        if found.wrong > 0 {
            return Err(format!("{} answers of {bytes} bytes are wrong", found.wrong));
        }
        if 100 * found.undecided > queries {
            return Err(format!("the tree tells no side of {} points", found.undecided));
        }
    }
    table.note(format!(
        "{queries} points in the box of the field; errors at those inside and up to a tenth of the \
         diagonal outside, of the middle of the interval; decided: whether the surface is within a \
         part of the diagonal, by the field alone, outside up to a tenth; wrong: intervals that \
         miss the box tree's, verdicts that it refutes, and of the first {BRUTE} intervals those \
         without the distance from all triangles in f64; the tree tells no side of {undecided}"
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

fn corners(grid: &Field) -> usize {
    grid.cells.iter().map(|cells| cells + 1).product()
}

/// A lattice with about as many corners as bytes, and no more.
fn plain_grid(subject: &Subject, bytes: u32) -> Result<Field, String> {
    let mut of_lattice = 2 * bytes;
    loop {
        let (blob, _) = field(subject, of_lattice, Some(SdfLayout::Lattice))?;
        let grid = Field::of(&blob);
        if corners(&grid) <= bytes as usize {
            return Ok(grid);
        }
        of_lattice -= of_lattice / 32;
    }
}
