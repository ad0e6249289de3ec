//! `--emit`: the blob as source text beside its file.

use crate::args::{BuildArgs, Language};
use crate::failure::Failure;
use crate::output::{Output, refuse_same_file};
use meshsweep::emit::source::{SourceNames, c_header, c_source, rust_module};
use meshsweep_core::Blob;
use serde_json::Value;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Extensions of the files that a language takes.
fn extensions(language: Language) -> &'static [&'static str] {
    match language {
        Language::Rust => &["rs"],
        Language::C => &["h", "c"],
    }
}

fn files(args: &BuildArgs) -> Vec<PathBuf> {
    let languages = args.emit.iter().flat_map(|&language| extensions(language));
    languages.map(|extension| args.output.with_extension(extension)).collect()
}

/// Refuses files that cannot be written, or that the build reads.
pub fn probe(args: &BuildArgs, inputs: &[&Path]) -> Result<(), Failure> {
    if args.emit.is_empty() {
        return Ok(());
    }
    if args.output.file_stem().and_then(|stem| stem.to_str()).is_none() {
        let what = format!("{}: --emit needs a name in UTF-8", args.output.display());
        return Err(Failure::Usage { what });
    }
    for file in files(args) {
        if file == args.output {
            let what = format!("{}: the blob and its source in one file", file.display());
            return Err(Failure::Usage { what });
        }
        refuse_same_file(Some(&file), inputs)?;
        Output::probe(&file)?;
    }
    Ok(())
}

/// Writes the blob, and its source texts.
pub fn write(args: &BuildArgs, mesh: &Path, blob: &Blob<'_>) -> Result<(), Failure> {
    Output::file(&args.output)?.finish(|out| out.write_all(blob.bytes()))?;
    let (mesh, name) = (file_name(mesh), file_name(&args.output));
    let names = SourceNames { mesh: &mesh, blob: &name };
    for file in files(args) {
        let text = match file.extension().and_then(|extension| extension.to_str()) {
            Some("rs") => rust_module(blob, names),
            Some("h") => c_header(blob, names),
            _ => c_source(blob, names),
        };
        Output::file(&file)?.finish(|out| out.write_all(text.as_bytes()))?;
    }
    Ok(())
}

/// Names the source texts in a report.
pub fn report(args: &BuildArgs, out: &mut dyn Write) -> io::Result<()> {
    files(args).iter().try_for_each(|file| writeln!(out, "{}", file.display()))
}

/// The same for JSON.
pub fn names(args: &BuildArgs) -> Value {
    files(args).iter().map(|file| file.display().to_string()).collect()
}

fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}
