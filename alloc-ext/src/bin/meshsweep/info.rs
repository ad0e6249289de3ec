//! `meshsweep info`: the contents of a blob, for people and as JSON.

use crate::args::InfoArgs;
use crate::failure::Failure;
use crate::output::Output;
use crate::{blob_file, describe};

pub fn run(args: &InfoArgs) -> Result<(), Failure> {
    let blob = blob_file::open(&args.blob)?;
    Output::stdout().finish(|out| {
        if args.json {
            serde_json::to_writer_pretty(&mut *out, &describe::as_json(&blob))?;
            writeln!(out)
        } else {
            writeln!(out, "{}", args.blob.display())?;
            describe::write_header(out, &blob)?;
            describe::write_blob(out, &blob)
        }
    })
}
