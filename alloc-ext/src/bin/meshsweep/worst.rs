//! `meshsweep worst`: the dearest query of each question, found by hill climbing.

use crate::args::{WorstArgs, WorstQuestion};
use crate::failure::Failure;
use crate::output::Output;
use crate::served::{self, Engine};
use crate::side::has_sides;
use crate::{blob_file, side};
use meshsweep::counted::Counted;
use meshsweep::number::{About, Short};
use meshsweep::trade::{self, Board, Shape};
use meshsweep::worst::{Climb, Domain, Summit, climb};
use meshsweep_core::{
    Blob, Budget, Bvh, Curve, Facing, Hint, Hull, Interval, QueryError, ScratchEntry, TightHull,
    Work,
};
use serde_json::{Value, json};
use std::io::{self, Write};

pub fn run(args: &WorstArgs) -> Result<(), Failure> {
    let blob = blob_file::open(&args.blob)?;
    let rows: Vec<Row> = subjects(&blob)
        .iter()
        .filter(|subject| args.ask.is_empty() || args.ask.contains(&subject.question()))
        .flat_map(|subject| subject.rows(args))
        .collect();
    if rows.is_empty() {
        return Err(Failure::NothingToSearch {
            file: args.blob.clone(),
            served: served::listed(&blob),
        });
    }
    Output::stdout().finish(|out| match args.json {
        true => {
            let all: Vec<Value> = rows.iter().map(Row::as_json).collect();
            serde_json::to_writer_pretty(&mut *out, &json!({ "dearest": all }))?;
            writeln!(out)
        }
        false => write(out, &rows),
    })
}

/// A question and the structure that answers it.
enum Subject<'a> {
    Closest(Structure<'a>),
    Within(Structure<'a>),
    Signed(Bvh<'a>),
    Winding(Bvh<'a>),
    Segment(Engine<'a>),
}

/// A structure that answers points.
pub enum Structure<'a> {
    Tree(Bvh<'a>),
    Hull(Hull<'a>),
    Tight(TightHull<'a>),
    Curve(Curve<'a>),
}

/// The goal of a search.
#[derive(Clone, Copy, PartialEq)]
pub enum Goal {
    /// The most work.
    Work,
    /// The widest interval that is left.
    Width,
}

/// An answer, as far as the search wants to know it.
#[derive(Clone, Copy)]
pub struct Found {
    work: Work,
    /// Of the answer's interval, if it has one.
    pub width: Option<f32>,
    /// As predicted, on each of [`Board::ALL`].
    pub instructions: Option<[f64; 2]>,
}

impl Found {
    /// A measure of the work: instructions of a Cortex-M4F if they can be predicted, else the sum
    /// of all counters.
    fn effort(&self) -> f64 {
        self.instructions.map_or(f64::from(self.work.total()), |[on_m4f, _]| on_m4f)
    }
}

/// The result of one search.
pub struct Row {
    question: &'static str,
    structure: &'static str,
    goal: Goal,
    pub query: Vec<f32>,
    pub found: Found,
    /// Mean value of random queries.
    typical: f64,
    asked: usize,
    scratch_bytes: usize,
}

/// All that the blob can be asked.
fn subjects<'a>(blob: &Blob<'a>) -> Vec<Subject<'a>> {
    let mut subjects = Vec::new();
    if let Ok(tree) = blob.bvh() {
        if tree.serves_distances() {
            subjects.push(Subject::Closest(Structure::Tree(tree)));
            subjects.push(Subject::Within(Structure::Tree(tree)));
            if has_sides(&tree) {
                subjects.push(Subject::Signed(tree));
            }
        }
        if tree.serves_winding() {
            subjects.push(Subject::Winding(tree));
        }
        if tree.serves_segments() {
            subjects.push(Subject::Segment(Engine::Tree(tree)));
        }
    }
    if let Ok(hull) = blob.hull() {
        subjects.push(Subject::Closest(Structure::Hull(hull)));
        subjects.push(Subject::Segment(Engine::Hull(hull)));
    }
    let tight = blob.tight_hulls().ok().and_then(|hulls| hulls.finest());
    if let Some(hull) = tight.filter(|hull| hull.bvh().serves_distances()) {
        subjects.push(Subject::Closest(Structure::Tight(hull)));
        subjects.push(Subject::Within(Structure::Tight(hull)));
    }
    if let Ok(curve) = blob.curve() {
        subjects.push(Subject::Closest(Structure::Curve(curve)));
        subjects.push(Subject::Within(Structure::Curve(curve)));
    }
    subjects
}

impl Structure<'_> {
    /// Searches the worst query of closest points.
    pub fn worst(self, goal: Goal, budget: Budget) -> Option<Row> {
        Subject::Closest(self).row(goal, budget, Climb::default().starts)
    }

    fn name(&self) -> &'static str {
        match self {
            Structure::Tree(_) => "box tree",
            Structure::Hull(_) => "hull hierarchy",
            Structure::Tight(_) => "finest tight hull",
            Structure::Curve(_) => "curve",
        }
    }

    fn bounds(&self) -> [[f32; 3]; 2] {
        match self {
            Structure::Tree(tree) => tree.bounds(),
            Structure::Hull(hull) => hull.bounds(),
            Structure::Tight(hull) => hull.bvh().bounds(),
            Structure::Curve(curve) => curve.bounds(),
        }
    }

    fn scratch_entries(&self) -> usize {
        match self {
            Structure::Tree(tree) => tree.scratch_entries(),
            Structure::Hull(hull) => hull.scratch_entries(),
            Structure::Tight(hull) => hull.bvh().scratch_entries(),
            Structure::Curve(curve) => curve.scratch_entries(),
        }
    }

    /// Interval of the distance, closest point, work.
    fn closest(
        &self,
        point: [f32; 3],
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Result<(Interval, [f32; 3], Work), QueryError> {
        let near = match self {
            Structure::Tree(tree) => {
                tree.closest_point_in_order(point, &mut Hint::NONE.clone(), budget, scratch)?
            }
            Structure::Hull(hull) => hull.closest_point(point, budget, scratch)?,
            Structure::Tight(hull) => hull.closest_point(point, budget, scratch)?,
            Structure::Curve(curve) => {
                let near = curve.closest_point(point, budget, scratch)?;
                return Ok((near.distance, near.point, near.work));
            }
        };
        Ok((near.distance, near.point, near.work))
    }

    /// Instructions of a closest point with this work, as `meshsweep trade` predicts them.
    fn instructions(&self, point: [f32; 3], budget: &Budget, work: &Work) -> Option<[f64; 2]> {
        let (search, shape) = match self {
            Structure::Tree(tree) if tree.header().is_f32() => {
                (trade::Search::TreeF32, Shape::of_tree(tree))
            }
            Structure::Tree(tree) => (trade::Search::Tree, Shape::of_tree(tree)),
            Structure::Hull(hull) => (trade::Search::Sweep, Shape::of_hull(hull)),
            Structure::Tight(hull) => (trade::Search::Tight, Shape::of_tight(hull)),
            Structure::Curve(_) => return None,
        };
        let features = shape.features(point, budget, work);
        let [m4f, m0] = Board::ALL.map(|board| trade::cost(board, search));
        Some([m4f?.of(&features), m0?.of(&features)])
    }

    /// The work of `within`. `None` for a structure that does not answer it.
    fn within(
        &self,
        point: [f32; 3],
        distance: f32,
        budget: Budget,
        scratch: &mut [ScratchEntry],
    ) -> Option<Work> {
        let within = match self {
            Structure::Tree(tree) => tree.within(point, distance, budget, scratch),
            Structure::Tight(hull) => hull.within(point, distance, budget, scratch),
            Structure::Curve(curve) => {
                return Some(curve.within(point, distance, budget, scratch).ok()?.work);
            }
            Structure::Hull(_) => return None,
        };
        Some(within.ok()?.work)
    }
}

impl Subject<'_> {
    fn question(&self) -> WorstQuestion {
        match self {
            Subject::Closest(_) => WorstQuestion::Closest,
            Subject::Within(_) => WorstQuestion::Within,
            Subject::Signed(_) => WorstQuestion::Signed,
            Subject::Winding(_) => WorstQuestion::Winding,
            Subject::Segment(_) => WorstQuestion::Segment,
        }
    }

    /// Searches the dearest query; with a step budget the widest interval too.
    fn rows(&self, args: &WorstArgs) -> Vec<Row> {
        let budget = Budget::EXACT
            .with_relative(args.rel)
            .with_absolute(args.abs)
            .with_steps(args.steps.unwrap_or(u32::MAX));
        let goals: &[Goal] = if args.steps.is_some() && self.has_interval() {
            &[Goal::Work, Goal::Width]
        } else {
            &[Goal::Work]
        };
        goals.iter().filter_map(|&goal| self.row(goal, budget, args.starts as usize)).collect()
    }

    fn has_interval(&self) -> bool {
        !matches!(self, Subject::Within(_) | Subject::Segment(_))
    }

    fn row(&self, goal: Goal, budget: Budget, starts: usize) -> Option<Row> {
        match self {
            Subject::Closest(structure) => {
                let search = Search::new("closest", structure, goal, starts);
                search.points(|point, scratch| {
                    let (distance, _, work) = structure.closest(*point, budget, scratch).ok()?;
                    let width = Some(distance.upper - distance.lower);
                    let instructions = structure.instructions(*point, &budget, &work);
                    Some(Found { work, width, instructions })
                })
            }
            Subject::Within(structure) => {
                let search = Search::new("within", structure, goal, starts);
                search.balls(|point, share, scratch| {
                    let (distance, ..) = structure.closest(point, Budget::EXACT, scratch).ok()?;
                    let work = structure.within(point, share * distance.upper, budget, scratch)?;
                    Some(Found { work, width: None, instructions: None })
                })
            }
            Subject::Signed(tree) => {
                let structure = Structure::Tree(*tree);
                let search = Search::new("signed", &structure, goal, starts);
                search.points(|point, scratch| {
                    let found = side::signed_distance(tree, *point, budget, scratch).ok()?;
                    let Interval { lower, upper } = found.distance;
                    let (work, width) = (found.closest.work, Some(upper - lower));
                    Some(Found { work, width, instructions: None })
                })
            }
            Subject::Winding(tree) => {
                let structure = Structure::Tree(*tree);
                let search = Search::new("winding", &structure, goal, starts);
                search.points(|point, scratch| {
                    let found = tree.winding_number(*point, budget, scratch).ok()?;
                    let Interval { lower, upper } = found.number;
                    let width = Some(upper - lower);
                    Some(Found { work: found.work, width, instructions: None })
                })
            }
            Subject::Segment(engine) => {
                let structure = match engine {
                    Engine::Tree(tree) => Structure::Tree(*tree),
                    Engine::Hull(hull) => Structure::Hull(*hull),
                };
                let search = Search::new("segment", &structure, goal, starts);
                search.segments(|a, b, scratch| {
                    let hit = match engine {
                        Engine::Tree(tree) => tree.first_hit(a, b, Facing::Both, budget, scratch),
                        Engine::Hull(hull) => hull.first_hit(a, b, budget, scratch),
                    };
                    Some(Found { work: hit.ok()?.work, width: None, instructions: None })
                })
            }
        }
    }
}

/// A search, up to the way a query is asked.
struct Search<'s, 'a> {
    question: &'static str,
    structure: &'s Structure<'a>,
    goal: Goal,
    climb: Climb,
    /// The model's box, doubled.
    low: [f32; 3],
    high: [f32; 3],
}

impl<'s, 'a> Search<'s, 'a> {
    fn new(
        question: &'static str,
        structure: &'s Structure<'a>,
        goal: Goal,
        starts: usize,
    ) -> Self {
        let [low, high] = structure.bounds();
        let half = |k: usize| 0.5 * high[k] - 0.5 * low[k];
        Search {
            question,
            structure,
            goal,
            climb: Climb::default().with_starts(starts),
            low: std::array::from_fn(|k| (low[k] - half(k)).max(f32::MIN)),
            high: std::array::from_fn(|k| (high[k] + half(k)).min(f32::MAX)),
        }
    }

    fn middle(&self) -> [f32; 3] {
        std::array::from_fn(|k| 0.5 * self.low[k] + 0.5 * self.high[k])
    }

    /// The box's middle, and points of the surface.
    fn seeds(&self) -> Vec<[f32; 3]> {
        let mut scratch = self.scratch();
        let mut seeds = vec![self.middle()];
        for corner in 0..8 {
            let corner: [f32; 3] =
                std::array::from_fn(
                    |k| {
                        if corner >> k & 1 == 0 { self.low[k] } else { self.high[k] }
                    },
                );
            if let Ok((_, point, _)) = self.structure.closest(corner, Budget::EXACT, &mut scratch) {
                seeds.push(point);
            }
        }
        seeds
    }

    fn scratch(&self) -> Vec<ScratchEntry> {
        vec![ScratchEntry::EMPTY; self.structure.scratch_entries()]
    }

    fn points(
        &self,
        ask: impl Fn(&[f32; 3], &mut [ScratchEntry]) -> Option<Found> + Sync,
    ) -> Option<Row> {
        self.search(&Domain { low: self.low, high: self.high }, &self.seeds(), ask)
    }

    /// Points, each with a distance to ask about: up to twice that of the surface.
    fn balls(
        &self,
        ask: impl Fn([f32; 3], f32, &mut [ScratchEntry]) -> Option<Found> + Sync,
    ) -> Option<Row> {
        let with = |[x, y, z]: [f32; 3], share: f32| [x, y, z, share];
        let domain = Domain { low: with(self.low, 0.0), high: with(self.high, 2.0) };
        let seeds: Vec<_> = self.seeds().into_iter().map(|point| with(point, 1.0)).collect();
        self.search(&domain, &seeds, |&[x, y, z, share], scratch| ask([x, y, z], share, scratch))
    }

    fn segments(
        &self,
        ask: impl Fn([f32; 3], [f32; 3], &mut [ScratchEntry]) -> Option<Found> + Sync,
    ) -> Option<Row> {
        let join = |[a, b, c]: [f32; 3], [d, e, f]: [f32; 3]| [a, b, c, d, e, f];
        let domain = Domain { low: join(self.low, self.low), high: join(self.high, self.high) };
        let seeds = [join(self.low, self.high), join(self.middle(), self.high)];
        self.search(&domain, &seeds, |&[a, b, c, d, e, f], scratch| {
            ask([a, b, c], [d, e, f], scratch)
        })
    }

    fn search<const N: usize>(
        &self,
        domain: &Domain<N>,
        seeds: &[[f32; N]],
        ask: impl Fn(&[f32; N], &mut [ScratchEntry]) -> Option<Found> + Sync,
    ) -> Option<Row> {
        let value = |found: Found| match self.goal {
            Goal::Work => Some(found.effort()),
            Goal::Width => found.width.map(f64::from),
        };
        let of = |query: &[f32; N]| value(ask(query, &mut self.scratch())?);
        let Summit { query, typical, asked, .. } = climb(domain, seeds, &self.climb, of)?;
        Some(Row {
            question: self.question,
            structure: self.structure.name(),
            goal: self.goal,
            query: query.to_vec(),
            found: ask(&query, &mut self.scratch())?,
            typical,
            asked,
            scratch_bytes: self.structure.scratch_entries() * size_of::<ScratchEntry>(),
        })
    }
}

impl Row {
    /// How many times the mean of random queries the value is.
    pub fn times(&self, value: f64) -> f64 {
        value / self.typical.max(f64::MIN_POSITIVE)
    }

    pub fn value(&self) -> f64 {
        match self.goal {
            Goal::Work => self.found.effort(),
            Goal::Width => self.found.width.map_or(0.0, f64::from),
        }
    }

    fn as_json(&self) -> Value {
        let Work { nodes, triangles, exact, splits, .. } = self.found.work;
        json!({
            "question": self.question,
            "structure": self.structure,
            "greatest": match self.goal { Goal::Work => "work", Goal::Width => "width" },
            "value": self.value(),
            "mean_of_random_queries": self.typical,
            "query": self.query,
            "width": self.found.width,
            "opened": splits,
            "bounds": nodes,
            "triangles": triangles,
            "exact": exact,
            "m4f_instructions": self.found.instructions.map(|[m4f, _]| m4f),
            "m0_instructions": self.found.instructions.map(|[_, m0]| m0),
            "scratch_bytes": self.scratch_bytes,
            "queries_asked": self.asked,
        })
    }
}

fn write(out: &mut dyn Write, rows: &[Row]) -> io::Result<()> {
    for row in rows {
        let Work { nodes, triangles, exact, splits, .. } = row.found.work;
        let times = About(row.times(row.value()));
        write!(out, "{} by the {}: ", row.question, row.structure)?;
        match row.goal {
            Goal::Work => write!(out, "dearest, {times} times the mean of random queries")?,
            Goal::Width => write!(
                out,
                "widest interval, {}, {times} times the mean of random queries",
                Short(row.found.width.unwrap_or(0.0))
            )?,
        }
        let numbers: Vec<String> = row.query.iter().map(|&x| Short(x).to_string()).collect();
        writeln!(out, ", at {}{}", numbers.join(","), note(row))?;
        writeln!(
            out,
            "  opens {}, looks at {}, {} and {} in f64; {} of scratch suffice",
            Counted(splits, "node"),
            Counted(nodes, "bound"),
            Counted(triangles, "triangle"),
            exact,
            Counted(row.scratch_bytes, "byte"),
        )?;
        if let Some([m4f, m0]) = row.found.instructions {
            let [on, other] = Board::ALL.map(Board::name);
            writeln!(out, "  about {m4f:.0} instructions on a {on}, {m0:.0} on a {other}")?;
        }
    }
    Ok(())
}

/// What the last number of a query is, where that is not plain.
fn note(row: &Row) -> &'static str {
    match row.question {
        "within" => " (point, and the share of its distance that is asked about)",
        _ => "",
    }
}
