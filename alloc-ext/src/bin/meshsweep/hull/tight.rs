//! The tight hull of a mesh, which need not be closed.

use super::written::{self, Of, Written};
use crate::args::HullArgs;
use crate::failure::Failure;
use crate::mesh_file::load_snapped;
use crate::output::Output;
use crate::progress::StageBars;
use meshsweep::builder::FACES;
use meshsweep::mesh::{Input, Mesh, write_ply};
use meshsweep::progress::Callback;
use meshsweep::tight::{
    Goal, Hull, Options, Report, Tightness, margin_note, no_void_note, rounded_note,
    split_components, wrap,
};
use std::path::Path;
use std::time::Duration;

pub fn run(args: &HullArgs, mesh: &Path) -> Result<(), Failure> {
    Output::probe(&args.output)?;
    let asked = &args.of_mesh;
    let goal = match (asked.void, asked.slack) {
        (Some(percent), _) => Goal::Void(percent / 100.0),
        (_, Some(slack)) => Goal::Slack(slack),
        _ => Goal::Faces(asked.faces.unwrap_or(FACES) as usize),
    };
    let failed = |error| Failure::build(mesh, error);
    let limit = asked.seconds.map(|s| Duration::try_from_secs_f64(s).unwrap_or(Duration::MAX));
    let loaded = load_snapped(&args.input, asked.vertex_bits.format(), &args.read)?;
    let options = Options::new(goal)
        .with_margin(asked.margin.unwrap_or(0.0))
        .with_effort(asked.effort.unwrap_or(1.0))
        .with_time_limit(limit)
        .with_vertex_bits(asked.vertex_bits.format());
    let meshes =
        if asked.parts { split_components(&loaded.mesh) } else { Ok(vec![loaded.mesh.clone()]) };
    let mut hulls = Vec::new();
    for mesh in &meshes.map_err(failed)? {
        let mut bars = StageBars::default();
        let part = Input { mesh, ..loaded.input() };
        let progress = Callback::new(|stage, _| bars.show(stage));
        hulls.push(wrap(part, &options, progress.watch()).map_err(failed)?);
    }
    let tightness = Tightness { slack: asked.slack, void: asked.void };
    tightness.require(hulls.iter().map(|hull| &hull.report)).map_err(failed)?;
    Output::file(&args.output)?.finish(|out| write_ply(&joined(&hulls), out))?;
    let of = if hulls.len() == 1 { "mesh" } else { "part" };
    let written: Vec<Written> =
        hulls.iter().map(|hull| told(&hull.report, goal, asked.margin, of)).collect();
    let notes: Vec<String> = rounded_note(loaded.error()).into_iter().collect();
    written::report(args, &Of::Mesh(mesh, &loaded), &written, &notes)
}

/// Measures of a hull. `of` names what the hull encloses.
fn told(report: &Report, goal: Goal, margin: Option<f64>, of: &str) -> Written {
    let slack = report.slack_of_input();
    let notes = margin_note(margin, of).into_iter().chain(no_void_note(&report.void));
    Written {
        faces: report.faces,
        void: report.void.ok(),
        at_most: Some(slack.upper),
        at_least: Some(slack.lower),
        level: None,
        time: Some(report.time),
        notes: notes.chain(report.notes()).chain(report.why_stopped(goal)).collect(),
    }
}

/// One file for all hulls.
fn joined(hulls: &[Hull]) -> Mesh {
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for hull in hulls {
        let first = positions.len() as u32;
        positions.extend_from_slice(&hull.mesh.positions);
        triangles.extend(hull.mesh.triangles.iter().map(|t| t.map(|v| v + first)));
    }
    Mesh::new(positions, triangles)
}
