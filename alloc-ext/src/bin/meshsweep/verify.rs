//! `meshsweep verify`: proves a blob from its bytes and the mesh, by code of its own.

use crate::args::VerifyArgs;
use crate::failure::Failure;
use crate::mesh_file::{self, Loaded};
use crate::output::Output;
use meshsweep::check::{Against, Finding, Outcome, verify};
use meshsweep::counted::Counted;
use meshsweep::curve::read_csv;
use meshsweep::mesh::KeyFrame;
use meshsweep::surface::VertexBits;
use meshsweep_core::Blob;
use meshsweep_core::internal::format::layout::VertexFormat;
use serde_json::{Map, Value, json};
use std::io::{self, Write};

pub fn run(args: &VerifyArgs) -> Result<(), Failure> {
    let bytes = std::fs::read(&args.blob)
        .map_err(|error| Failure::Read { file: args.blob.clone(), error })?;
    let blob = Blob::open(&bytes).map_err(|error| Failure::open(&args.blob, error))?;
    let findings = findings(args, &bytes, &blob)?;
    Output::stdout().finish(|out| match args.json {
        true => {
            serde_json::to_writer_pretty(&mut *out, &as_json(&findings))?;
            writeln!(out)
        }
        false => findings.iter().try_for_each(|finding| write(out, finding)),
    })?;
    let is_open = |finding: &&Finding| finding.outcome != Outcome::Proved;
    let open: Vec<String> = findings.iter().filter(is_open).map(said).collect();
    if open.is_empty() {
        return Ok(());
    }
    Err(Failure::NotVerified { blob: args.blob.clone(), mesh: args.mesh.clone(), open })
}

fn findings(args: &VerifyArgs, bytes: &[u8], blob: &Blob<'_>) -> Result<Vec<Finding>, Failure> {
    if blob.curve().is_ok() {
        let file = &args.mesh;
        let text =
            std::fs::read(file).map_err(|error| Failure::Read { file: file.clone(), error })?;
        let polylines =
            read_csv(&text, false).map_err(|error| Failure::Curve { file: file.clone(), error })?;
        let points: Vec<_> = polylines.into_iter().map(|polyline| polyline.points).collect();
        return Ok(verify(bytes, Against::Curves(&points)));
    }
    if blob.deformable_hull().is_ok() {
        let (loaded, keys) = mesh_file::load_deformable(&args.mesh, &args.frames, args.unit, None)?;
        return Ok(of_mesh(bytes, &loaded, &keys));
    }
    if !args.frames.is_empty() {
        let what = "several meshes are key frames, and the blob has none; name one mesh".to_owned();
        return Err(Failure::Usage { what });
    }
    let found = of_mesh(bytes, &mesh_file::load(&args.mesh, args.unit)?, &[]);
    // A hull on a grid may have moved the mesh before its repair, as --vertex-bits says.
    let bits = match blob.hull().map(|_| blob.header().vertex_format) {
        Ok(VertexFormat::Grid16) => VertexBits::Grid16,
        Ok(VertexFormat::Grid24) => VertexBits::Grid24,
        _ => return Ok(found),
    };
    if found.iter().all(|finding| finding.outcome == Outcome::Proved) {
        return Ok(found);
    }
    Ok(of_mesh(bytes, &mesh_file::load_snapped(&args.mesh, bits, args.unit)?, &[]))
}

fn of_mesh(bytes: &[u8], loaded: &Loaded, keys: &[KeyFrame]) -> Vec<Finding> {
    verify(bytes, Against::Mesh(loaded.input(), keys))
}

fn name(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Proved => "proved",
        Outcome::Failed => "failed",
        Outcome::NotProved => "not proved",
    }
}

fn said(finding: &Finding) -> String {
    format!("{}: {}: {}", name(finding.outcome), finding.structure, finding.words)
}

fn write(out: &mut dyn Write, finding: &Finding) -> io::Result<()> {
    writeln!(out, "{}", said(finding))?;
    let counts: Vec<String> =
        finding.counts.iter().map(|&(noun, count)| Counted(count, noun).to_string()).collect();
    if counts.is_empty() { Ok(()) } else { writeln!(out, "  {}", counts.join(", ")) }
}

fn as_json(findings: &[Finding]) -> Value {
    let one = |finding: &Finding| {
        let counts: Map<String, Value> =
            finding.counts.iter().map(|&(noun, count)| (noun.to_owned(), json!(count))).collect();
        json!({
            "structure": finding.structure,
            "outcome": name(finding.outcome),
            "claim": finding.words,
            "counts": counts,
        })
    };
    let is_proved = findings.iter().all(|finding| finding.outcome == Outcome::Proved);
    json!({ "proved": is_proved, "findings": findings.iter().map(one).collect::<Vec<_>>() })
}
