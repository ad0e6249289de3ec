//! `meshsweep closest`: points in, intervals and closest points out.

use crate::args::{self, ClosestArgs, SearchArgs, files};
use crate::ask::threads::Refused;
use crate::ask::{self, Question, write_end, write_numbers};
use crate::failure::Failure;
use crate::need::Need;
use crate::output::refuse_same_file;
use crate::queries::Queries;
use crate::{blob_file, served};
use meshsweep_core::query::tree::{BatchError, Hint, ScratchEntry, closest_points};
use meshsweep_core::query::{Budget, ClosestPoint, Ended, QueryError, Work, closest_point, tight};
use meshsweep_core::{Bvh, Model, QueueEntry, TightHull};
use std::io::{self, Write};

/// Points that the box tree sorts and answers at once: enough for neighbours to be near, and for
/// all threads to have some.
const BATCH: usize = 1 << 14;

const UNANSWERED: ClosestPoint = ClosestPoint {
    lower: 0.0,
    upper: f32::INFINITY,
    point: [0.0; 3],
    triangle: None,
    work: Work { nodes: 0, triangles: 0, exact: 0, splits: 0 },
    ended: Ended::Steps,
};

pub fn run(args: &ClosestArgs) -> Result<(), Failure> {
    let blob = &args.input.blob;
    refuse_same_file(args.search.output.as_deref(), &files(&[blob], &args.input.points))?;
    let bytes = blob_file::read(blob)?;
    let model = blob_file::open(blob, &bytes)?;
    let tree_chosen = args.engine.map(|engine| engine == args::Engine::Tree);
    let hull = match tree_chosen {
        Some(_) => None,
        None => served::tight_hull(blob, &model, args.tight)?,
    };
    let engine = match hull {
        Some(hull) => Engine::Tight(hull),
        None => match served::choose(blob, &model, Need::Distances, tree_chosen)? {
            Some(tree) => Engine::Tree(tree),
            None => Engine::Cover(&model),
        },
    };
    let queries = Queries::read(&args.input.points)?;
    let points = queries.rows.len();
    let budget = args.search.budget(args.rel, args.abs);
    ask::run(&Closest { engine, budget, search: &args.search, points }, queries, &args.search)
}

enum Engine<'a> {
    Tree(Bvh<'a>),
    Cover(&'a Model<'a>),
    Tight(TightHull<'a>),
}

struct Closest<'a> {
    engine: Engine<'a>,
    budget: Budget,
    search: &'a SearchArgs,
    /// Number of queries.
    points: usize,
}

struct Memory {
    stack: Vec<ScratchEntry>,
    queue: Vec<QueueEntry>,
    order: Vec<u64>,
}

impl Question<3> for Closest<'_> {
    type Answer = ClosestPoint;
    type Memory = Memory;

    fn header(&self) -> &'static str {
        "x,y,z,lower,upper,px,py,pz,triangle,work"
    }

    fn memory(&self) -> Memory {
        let mut memory = Memory { stack: Vec::new(), queue: Vec::new(), order: Vec::new() };
        match &self.engine {
            Engine::Tree(tree) => {
                memory.stack = self.search.stack(tree);
                memory.order = vec![0; 2 * BATCH.min(self.points)];
            }
            Engine::Cover(model) => memory.queue = self.search.queue(model),
            Engine::Tight(hull) => memory.stack = self.search.stack(hull.tree()),
        }
        memory
    }

    fn ask(&self, point: [f32; 3], memory: &mut Memory) -> Result<ClosestPoint, QueryError> {
        match &self.engine {
            Engine::Cover(model) => closest_point(model, point, &self.budget, &mut memory.queue),
            Engine::Tight(hull) => {
                tight::closest_point(hull, point, &self.budget, &mut memory.stack)
            }
            Engine::Tree(tree) => meshsweep_core::query::tree::closest_point(
                tree,
                point,
                &self.budget,
                &mut memory.stack,
            ),
        }
    }

    fn outcome(answer: &ClosestPoint) -> (Ended, Work) {
        (answer.ended, answer.work)
    }

    fn at_once(&self) -> usize {
        if matches!(self.engine, Engine::Tree(_)) { BATCH } else { ask::AT_ONCE }
    }

    fn ask_many(
        &self,
        first: usize,
        rows: &[[f32; 3]],
        memory: &mut Memory,
        answers: &mut Vec<ClosestPoint>,
    ) -> Result<(), Refused> {
        let Engine::Tree(tree) = &self.engine else {
            return ask::each(self, first, rows, memory, answers);
        };
        answers.resize(rows.len(), UNANSWERED);
        let Memory { stack, order, .. } = memory;
        // Without a hint: so the work does not depend on the batch before.
        let mut hint = Hint::NONE;
        let done = closest_points(tree, rows, answers, &self.budget, stack, order, &mut hint);
        done.map_err(|error| {
            // A batch is not answered in its order.
            answers.clear();
            match error {
                BatchError::Query { index, error } => (first + index, error),
                // There is a place for each answer.
                BatchError::Length { .. } => (first, QueryError::Model),
            }
        })
    }

    fn is_by_hull(&self) -> bool {
        matches!(self.engine, Engine::Tight(_))
    }

    fn write(
        &self,
        out: &mut dyn Write,
        _: usize,
        [x, y, z]: &[f32; 3],
        answer: &ClosestPoint,
    ) -> io::Result<()> {
        let ClosestPoint { lower, upper, point: [px, py, pz], triangle, work, .. } = *answer;
        write_numbers(out, &[*x, *y, *z, lower, upper, px, py, pz])?;
        write_end(out, triangle, work)
    }
}
