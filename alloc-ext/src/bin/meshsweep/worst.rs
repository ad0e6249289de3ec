//! `meshsweep worst`: the costliest query of each question, or the costliest pose of a second mesh,
//! found by hill climbing.

use crate::args::{WorstArgs, WorstQuestion};
use crate::failure::Failure;
use crate::output::Output;
use crate::{blob_file, served};
use meshsweep::counted::Counted;
use meshsweep::distances::Distances;
use meshsweep::number::{About, Short};
use meshsweep::trade::Board;
use meshsweep::worst::{Goal, Pair, PairQuestion, Question, Subject, Worst};
use meshsweep_core::{Budget, BuildFor, Work};
use serde_json::{Value, json};
use std::io::{self, Write};
use std::path::Path;

/// The worst query of a question to a structure.
struct Row {
    question: &'static str,
    structure: &'static str,
    /// The name of what a step opens.
    opens: &'static str,
    /// What the last numbers of a query are, where that is not plain.
    note: &'static str,
    worst: Worst,
}

pub fn run(args: &WorstArgs) -> Result<(), Failure> {
    args.threads.start();
    let budget = Budget::EXACT
        .with_relative(args.rel)
        .with_absolute(args.abs)
        .with_steps(args.steps.unwrap_or(u32::MAX));
    let rows = match &args.moved {
        Some(moved) => of_pair(args, moved, budget)?,
        None => of_blob(args, budget)?,
    };
    Output::stdout().finish(|out| match args.json {
        true => {
            let all: Vec<Value> = rows.iter().map(as_json).collect();
            serde_json::to_writer_pretty(&mut *out, &json!({ "worst": all }))?;
            writeln!(out)
        }
        false => write(out, &rows),
    })
}

fn of_blob(args: &WorstArgs, budget: Budget) -> Result<Vec<Row>, Failure> {
    let blob = blob_file::open(&args.blob)?;
    let mut rows = Vec::new();
    for subject in Subject::all(&blob) {
        let question = subject.question;
        if args.ask.is_empty() || args.ask.contains(&WorstQuestion::of(question)) {
            let found = subject.worst(budget, args.starts as usize).into_iter();
            rows.extend(found.map(|worst| Row {
                question: question.name(),
                structure: subject.structure.name(),
                opens: match subject.structure {
                    Distances::Hull(_) => "split",
                    _ => "node",
                },
                note: match question {
                    Question::Within => {
                        " (point, and the share of its distance that is asked about)"
                    }
                    _ => "",
                },
                worst,
            }));
        }
    }
    if rows.is_empty() {
        let (file, served) = (args.blob.clone(), served::listed(&blob));
        return Err(Failure::NothingToSearch { file, served });
    }
    Ok(rows)
}

fn of_pair(args: &WorstArgs, moved: &Path, budget: Budget) -> Result<Vec<Row>, Failure> {
    let (blob, other) = (blob_file::open(&args.blob)?, blob_file::open(moved)?);
    let trees = [
        served::require_tree(&args.blob, &blob, BuildFor::Segment)?,
        served::require_tree(moved, &other, BuildFor::Segment)?,
    ];
    let question = args.within.map_or(PairQuestion::Distance, PairQuestion::Within);
    let found = Pair { trees, question }.worst(budget, args.starts as usize).into_iter();
    Ok(found
        .map(|worst| Row {
            question: question.name(),
            structure: "box trees",
            opens: "pair",
            note: " (x,y,z,qw,qx,qy,qz, as for --pose)",
            worst,
        })
        .collect())
}

impl WorstQuestion {
    fn of(question: Question) -> Self {
        match question {
            Question::Closest => Self::Closest,
            Question::Within => Self::Within,
            Question::Signed => Self::Signed,
            Question::Winding => Self::Winding,
            Question::Segment => Self::Segment,
        }
    }
}

fn as_json(Row { question, structure, worst, .. }: &Row) -> Value {
    let Work { bounds, triangles, exact, opened, .. } = worst.found.work;
    json!({
        "question": question,
        "structure": structure,
        "greatest": match worst.goal { Goal::Work => "work", Goal::Width => "width" },
        "value": worst.value(),
        "mean_of_random_queries": worst.typical,
        "query": worst.query,
        "width": worst.found.width,
        "opened": opened,
        "bounds": bounds,
        "triangles": triangles,
        "exact": exact,
        "m4f_instructions": worst.found.instructions.map(|[m4f, _]| m4f),
        "m0_instructions": worst.found.instructions.map(|[_, m0]| m0),
        "scratch_bytes": worst.scratch_bytes,
        "queries_asked": worst.asked,
    })
}

fn write(out: &mut dyn Write, rows: &[Row]) -> io::Result<()> {
    for Row { question, structure, opens, note, worst: row } in rows {
        let Work { bounds, triangles, exact, opened, .. } = row.found.work;
        let times = About(row.times());
        write!(out, "{question} by the {structure}: ")?;
        match row.goal {
            Goal::Work => write!(out, "costliest, {times} times the mean of random queries")?,
            Goal::Width => write!(
                out,
                "widest interval, {}, {times} times the mean of random queries",
                Short(row.found.width.unwrap_or(0.0))
            )?,
        }
        let numbers: Vec<String> = row.query.iter().map(|&x| Short(x).to_string()).collect();
        writeln!(out, ", at {}{note}", numbers.join(","))?;
        writeln!(
            out,
            "  opens {}, looks at {}, {} and {} in f64; {} of scratch suffice",
            Counted(opened, opens),
            Counted(bounds, "bound"),
            Counted(triangles, "triangle"),
            exact,
            Counted(row.scratch_bytes, "byte"),
        )?;
        let [on, other] = Board::ALL.map(Board::name);
        match row.found.instructions {
            Some([m4f, m0]) => {
                writeln!(out, "  about {m4f:.0} instructions on a {on}, {m0:.0} on a {other}")?;
            }
            None => writeln!(out, "  instructions are not predicted for this question and blob")?,
        }
    }
    Ok(())
}
