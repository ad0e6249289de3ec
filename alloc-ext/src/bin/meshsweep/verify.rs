//! `meshsweep verify`: proves a blob from its bytes and the mesh, by code of its own.

use crate::args::VerifyArgs;
use crate::describe;
use crate::failure::Failure;
use crate::mesh_file;
use crate::mesh_report::write_rounding;
use crate::output::Output;
use meshsweep::BuildError;
use meshsweep::check::{
    Against, FilePolyline, Finding, Outcome, verify, verify_file, verify_repair,
};
use meshsweep::counted::Counted;
use meshsweep::curve::{Polyline, Zone, read_csv};
use meshsweep::load::{Loaded, bytes_of, is_named_as_mesh};
use meshsweep::mesh::{KeyFrame, RawMesh, RepairReport};
use meshsweep::surface::VertexBits;
use meshsweep_core::Blob;
use meshsweep_core::internal::format::layout::VertexFormat;
use serde_json::{Map, Value, json};
use std::io::{self, Write};

pub fn run(args: &VerifyArgs) -> Result<(), Failure> {
    mesh_file::check_format(&[&args.mesh], &args.read)?;
    args.threads.start();
    let bytes = bytes_of(&args.blob).map_err(|error| Failure::build(&args.blob, error))?;
    let blob = Blob::open(&bytes).map_err(|error| Failure::open(&args.blob, error))?;
    let Proofs { findings, hint, report } = prove(args, &bytes, &blob)?;
    Output::stdout().finish(|out| match args.json {
        true => {
            serde_json::to_writer_pretty(&mut *out, &as_json(&findings, report.as_ref()))?;
            writeln!(out)
        }
        false => {
            findings.iter().try_for_each(|finding| write(out, finding))?;
            report.map_or(Ok(()), |report| write_rounding(out, &args.mesh, &report))
        }
    })?;
    match unproved(&findings) {
        None => Ok(()),
        Some(open) => Err(Failure::NotVerified {
            blob: args.blob.clone(),
            mesh: args.mesh.clone(),
            open: open + &hint,
        }),
    }
}

/// What came of the proofs, and a guess at the cause if not all hold.
struct Proofs {
    findings: Vec<Finding>,
    hint: String,
    /// Of the mesh, if the blob is of one.
    report: Option<RepairReport>,
}

/// How many claims are not proved, and of which structures, if any are not.
fn unproved(findings: &[Finding]) -> Option<String> {
    let of = |outcome: Outcome, words: &str| {
        let found: Vec<&str> = findings
            .iter()
            .filter(|finding| finding.outcome == outcome)
            .map(|finding| finding.structure)
            .collect();
        let mut names = found.clone();
        names.dedup();
        let all = findings.len();
        (!found.is_empty())
            .then(|| format!("{} of {all} proofs {words}: {}", found.len(), names.join(", ")))
    };
    let open = [of(Outcome::Failed, "failed"), of(Outcome::NotProved, "could not be made")];
    let open: Vec<String> = open.into_iter().flatten().collect();
    (!open.is_empty()).then(|| open.join("; "))
}

fn prove(args: &VerifyArgs, bytes: &[u8], blob: &Blob<'_>) -> Result<Proofs, Failure> {
    let mesh = mesh_file::named(&args.mesh, &args.read)?;
    let is_csv = mesh.extension().is_some_and(|csv| csv.eq_ignore_ascii_case("csv"));
    if blob.curve().is_ok() {
        let file = &mesh;
        if is_named_as_mesh(file) {
            let (blob, file) = (args.blob.display(), file.display());
            let what =
                format!("{blob} is of curves, and {file} is a mesh; name their points, .csv");
            return Err(Failure::Usage { what });
        }
        let text = match mesh_file::stdin_bytes(&args.mesh)? {
            Some(text) => text,
            None => bytes_of(file).map_err(|error| Failure::build(file, error))?,
        };
        let polylines = read_csv(&text, false).map_err(|error| {
            Failure::build(file, BuildError::Curve { file: file.clone(), error })
        })?;
        let filed =
            polylines.into_iter().map(|Polyline { points, is_closed, zone }| FilePolyline {
                is_closed: is_closed || (points.len() > 2 && points.first() == points.last()),
                is_exclusion: zone == Zone::Exclusion,
                points,
            });
        let filed: Vec<FilePolyline> = filed.collect();
        let findings = verify(bytes, Against::Curves(&filed));
        return Ok(Proofs { findings, hint: String::new(), report: None });
    }
    if is_csv {
        let (blob, file) = (args.blob.display(), args.mesh.display());
        let what = format!(
            "{blob} is of a mesh, and {file} holds points of curves; name the mesh file that it \
             was built from"
        );
        return Err(Failure::Usage { what });
    }
    let file = mesh_file::read(&args.mesh, &args.read)?;
    let raw = file.raw();
    if let Ok(hull) = blob.deformable_hull() {
        let is_solid = hull.rest().encloses();
        let (loaded, keys) = mesh_file::deformable(&file, &args.frames, args.read.unit, is_solid)?;
        return Ok(of_mesh(args, bytes, blob, raw, &loaded, &keys));
    }
    if !args.frames.is_empty() {
        let what = "several meshes are key frames, and the blob has none; name one mesh".to_owned();
        return Err(Failure::Usage { what });
    }
    let loaded = file.repaired().map_err(|error| Failure::build(&args.mesh, error))?;
    let found = of_mesh(args, bytes, blob, raw, &loaded, &[]);
    // A hull on a grid may have moved the mesh before its repair, as --vertex-bits says.
    let bits = match blob.hull().map(|_| blob.header().vertex_format) {
        Ok(VertexFormat::Grid16) => VertexBits::Grid16,
        Ok(VertexFormat::Grid24) => VertexBits::Grid24,
        _ => return Ok(found),
    };
    if found.findings.iter().all(|finding| finding.outcome == Outcome::Proved) {
        return Ok(found);
    }
    let snapped = file.on_grid(bits).map_err(|error| Failure::build(&args.mesh, error))?;
    Ok(of_mesh(args, bytes, blob, raw, &snapped, &[]))
}

fn of_mesh(
    args: &VerifyArgs,
    bytes: &[u8],
    blob: &Blob<'_>,
    raw: &RawMesh,
    loaded: &Loaded,
    keys: &[KeyFrame],
) -> Proofs {
    let mut findings = vec![verify_repair(raw, loaded.input())];
    findings.extend(verify(bytes, Against::Mesh(loaded.input(), keys)));
    findings.extend(verify_file(bytes, raw));
    let (stored, given) = (describe::input_triangles(blob) as usize, loaded.input_triangles);
    let hint = if stored > 0 && stored != given {
        format!(
            "; the blob was built from another mesh, of {}, and {} has {given}",
            Counted(stored, "triangle"),
            args.mesh.display()
        )
    } else if loaded.is_in_own_unit() {
        "; was it built with --unit? Then give the same".to_owned()
    } else {
        String::new()
    };
    Proofs { findings, hint, report: Some(loaded.report.clone()) }
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

fn as_json(findings: &[Finding], report: Option<&RepairReport>) -> Value {
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
    let findings: Vec<Value> = findings.iter().map(one).collect();
    let rounding = report.map(|report| report.rounding);
    json!({ "proved": is_proved, "rounding": rounding, "findings": findings })
}
