//! `meshsweep closest`: points in, intervals and closest points out.

use crate::args::{self, ClosestArgs, SearchArgs, files};
use crate::ask::threads::Refused;
use crate::ask::{self, Question, write_end, write_numbers};
use crate::failure::Failure;
use crate::output::refuse_same_file;
use crate::queries::Queries;
use crate::served::Engine;
use crate::{blob_file, curve, served};
use meshsweep_core::{
    Budget, BuildFor, ClosestPoint, Ended, Hint, Interval, QueryError, ScratchEntry, TightHull,
    Work,
};
use std::io::{self, Write};

/// Points that the box tree sorts and answers at once: enough for neighbours to be near, and for
/// all threads to have some.
const BATCH: usize = 1 << 14;

pub fn run(args: &ClosestArgs) -> Result<(), Failure> {
    let file = &args.input.blob;
    refuse_same_file(args.search.output.as_deref(), &files(&[file], &args.input.points))?;
    let bytes = blob_file::read(file)?;
    let blob = blob_file::open(file, &bytes)?;
    if let Ok(curve) = blob.curve()
        && args.engine.is_none()
        && args.tight.is_none()
    {
        let budget = args.search.budget().with_relative(args.rel).with_absolute(args.abs);
        return curve::closest(curve, args, Queries::read(&args.input.points)?, budget);
    }
    let tree_chosen = args.engine.map(|engine| engine == args::Engine::Tree);
    let hull = match tree_chosen {
        Some(_) => None,
        None => served::tight_hull(file, &blob, args.tight)?,
    };
    let by = match hull {
        Some(hull) => By::Tight(hull),
        None => By::Engine(served::choose(file, &blob, BuildFor::Closest, tree_chosen)?),
    };
    let queries = Queries::read(&args.input.points)?;
    let budget = args.search.budget().with_relative(args.rel).with_absolute(args.abs);
    let points = queries.rows.len();
    ask::run(&Closest { by, budget, search: &args.search, points }, queries, &args.search)
}

/// The structure that answers.
enum By<'a> {
    Engine(Engine<'a>),
    Tight(TightHull<'a>),
}

struct Closest<'a> {
    by: By<'a>,
    budget: Budget,
    search: &'a SearchArgs,
    /// Number of queries.
    points: usize,
}

impl Question<3> for Closest<'_> {
    type Answer = ClosestPoint;
    type Memory = Vec<ScratchEntry>;

    fn header(&self) -> &'static str {
        "x,y,z,lower,upper,px,py,pz,triangle,work"
    }

    fn memory(&self) -> Self::Memory {
        self.search.scratch(match &self.by {
            // Two entries more for each point sort a batch.
            By::Engine(Engine::Tree(tree)) => tree.scratch_entries() + 2 * BATCH.min(self.points),
            By::Engine(engine) => engine.scratch_entries(),
            By::Tight(hull) => hull.scratch_entries(),
        })
    }

    fn ask(&self, point: [f32; 3], scratch: &mut Self::Memory) -> Result<ClosestPoint, QueryError> {
        match &self.by {
            By::Engine(Engine::Tree(tree)) => tree.closest_point(point, self.budget, scratch),
            By::Engine(Engine::Cover(hull)) => hull.closest_point(point, self.budget, scratch),
            By::Tight(hull) => hull.closest_point(point, self.budget, scratch),
        }
    }

    fn outcome(answer: &ClosestPoint) -> (Ended, Work) {
        (answer.ended, answer.work)
    }

    fn at_once(&self) -> usize {
        if matches!(self.by, By::Engine(Engine::Tree(_))) { BATCH } else { ask::AT_ONCE }
    }

    fn ask_many(
        &self,
        first: usize,
        rows: &[[f32; 3]],
        scratch: &mut Self::Memory,
        answers: &mut Vec<ClosestPoint>,
    ) -> Result<(), Refused> {
        let By::Engine(Engine::Tree(tree)) = &self.by else {
            return ask::each(self, first, rows, scratch, answers);
        };
        answers.resize(rows.len(), ClosestPoint::EMPTY);
        // Without a hint: so the work does not depend on the batch before.
        let mut hint = Hint::NONE;
        let done = tree.closest_points(rows, &mut hint, answers, self.budget, scratch);
        done.map_err(|error| {
            answers.clear();
            match error {
                QueryError::PointNotFinite { index } => {
                    (first + index as usize, QueryError::NotFinite)
                }
                error => (first, error),
            }
        })
    }

    fn is_by_hull(&self) -> bool {
        matches!(self.by, By::Tight(_))
    }

    fn write(
        &self,
        out: &mut dyn Write,
        _: usize,
        point: &[f32; 3],
        answer: &ClosestPoint,
    ) -> io::Result<()> {
        let Interval { lower, upper } = answer.distance;
        let [x, y, z] = answer.point;
        write_numbers(out, point)?;
        write_numbers(out, &[lower, upper, x, y, z])?;
        write_end(out, answer.triangle, answer.work)
    }
}
