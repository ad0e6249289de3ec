//! `meshsweep trade`: what each setting of a mesh promises, finds and costs; or which structures of
//! two meshes tell that they keep a distance.

pub mod choose;
mod curve;
mod measured;
mod pair;
mod report;
mod table;

use crate::args::TradeArgs;
use crate::failure::Failure;
use crate::mesh_file;
use crate::output::{Output, refuse_other_extension, refuse_same_file};
use measured::measured;
use meshsweep::trade::Question;
use std::ffi::OsStr;

/// A word as a shell reads it.
fn quoted(word: &OsStr) -> String {
    let word = word.to_string_lossy().into_owned();
    let is_plain = |c: char| c.is_alphanumeric() || "-_./=:,+".contains(c);
    let is_plain = !word.is_empty() && word.chars().all(is_plain);
    if is_plain { word } else { format!("'{}'", word.replace('\'', "'\\''")) }
}

pub fn run(args: &TradeArgs) -> Result<(), Failure> {
    if let (Some(other), Some(keep)) = (&args.other, args.keep) {
        return pair::run(args, other, keep);
    }
    if args.limits.is_any() {
        let what = "--flash, --ram, --rate and --cpu go with two meshes; for one, give them to \
                    meshsweep build";
        return Err(Failure::Usage { what: what.to_owned() });
    }
    if args.is_curve() {
        return curve::run(args);
    }
    if args.closed {
        let what = "--closed: it joins the ends of curves, which are .csv".to_owned();
        return Err(Failure::Usage { what });
    }
    mesh_file::check_format(&[&args.mesh], &args.read)?;
    let mesh = mesh_file::named(&args.mesh, &args.read)?;
    args.threads.start();
    if args.report.is_some() && args.question() != Question::ClosestPoint {
        let what = "--report: the page is of closest points; leave --for segment out".to_owned();
        return Err(Failure::Usage { what });
    }
    if let Some(page) = &args.report {
        refuse_other_extension(page, "html", "the report is a page")?;
        refuse_same_file(Some(page), &[&args.mesh])?;
        Output::probe(page)?;
    }
    let (question, count) = (args.question(), args.points as usize);
    let (loaded, measured) = measured(&args.mesh, &args.read, question, &args.at, count)?;
    if let Some(page) = &args.report {
        report::write(page, &mesh, &loaded, &measured)?;
    }
    Output::stdout().finish(|out| {
        if args.json {
            return table::write_json(out, &loaded, &measured);
        }
        table::write(out, &mesh, &loaded, &measured)?;
        let page = args.report.as_ref();
        page.map_or(Ok(()), |page| writeln!(out, "\n{}: open it in a browser", page.display()))
    })
}
