//! `meshsweep worst`: the dearest query of each question, found by hill climbing.

use crate::args::{WorstArgs, WorstQuestion};
use crate::failure::Failure;
use crate::output::Output;
use crate::{blob_file, served};
use meshsweep::counted::Counted;
use meshsweep::number::{About, Short};
use meshsweep::trade::Board;
use meshsweep::worst::{Goal, Question, Subject, Worst};
use meshsweep_core::{Budget, Work};
use serde_json::{Value, json};
use std::io::{self, Write};

/// The worst query of a question to a structure.
type Row<'a> = (Subject<'a>, Worst);

pub fn run(args: &WorstArgs) -> Result<(), Failure> {
    args.threads.start();
    let blob = blob_file::open(&args.blob)?;
    let budget = Budget::EXACT
        .with_relative(args.rel)
        .with_absolute(args.abs)
        .with_steps(args.steps.unwrap_or(u32::MAX));
    let mut rows: Vec<Row<'_>> = Vec::new();
    for subject in Subject::all(&blob) {
        if args.ask.is_empty() || args.ask.contains(&WorstQuestion::of(subject.question)) {
            let found = subject.worst(budget, args.starts as usize);
            rows.extend(found.into_iter().map(|worst| (subject, worst)));
        }
    }
    if rows.is_empty() {
        return Err(Failure::NothingToSearch {
            file: args.blob.clone(),
            served: served::listed(&blob),
        });
    }
    Output::stdout().finish(|out| match args.json {
        true => {
            let all: Vec<Value> = rows.iter().map(as_json).collect();
            serde_json::to_writer_pretty(&mut *out, &json!({ "dearest": all }))?;
            writeln!(out)
        }
        false => write(out, &rows),
    })
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

fn as_json((subject, worst): &Row<'_>) -> Value {
    let Work { bounds, triangles, exact, opened, .. } = worst.found.work;
    json!({
        "question": subject.question.name(),
        "structure": subject.structure.name(),
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

fn write(out: &mut dyn Write, rows: &[Row<'_>]) -> io::Result<()> {
    for (subject, row) in rows {
        let Work { bounds, triangles, exact, opened, .. } = row.found.work;
        let times = About(row.times());
        write!(out, "{} by the {}: ", subject.question.name(), subject.structure.name())?;
        match row.goal {
            Goal::Work => write!(out, "dearest, {times} times the mean of random queries")?,
            Goal::Width => write!(
                out,
                "widest interval, {}, {times} times the mean of random queries",
                Short(row.found.width.unwrap_or(0.0))
            )?,
        }
        let numbers: Vec<String> = row.query.iter().map(|&x| Short(x).to_string()).collect();
        writeln!(out, ", at {}{}", numbers.join(","), note(subject.question))?;
        writeln!(
            out,
            "  opens {}, looks at {}, {} and {} in f64; {} of scratch suffice",
            Counted(opened, "node"),
            Counted(bounds, "bound"),
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
fn note(question: Question) -> &'static str {
    match question {
        Question::Within => " (point, and the share of its distance that is asked about)",
        _ => "",
    }
}
