//! `meshsweep build`: a mesh file in, a blob and a report out.

use crate::args::{BuildArgs, FACES, HullServes, Serves, StoredBits, slack_within_margin};
use crate::failure::Failure;
use crate::hull_report::{
    require_met, why_stuck, write_margin, write_no_void, write_start, write_wires,
};
use crate::mesh_file::{self, Loaded};
use crate::number::{About, AtMost};
use crate::output::{Output, refuse_same_file};
use crate::progress::{Bar, StageBars};
use crate::unmet::Tightness;
use crate::{curve, describe, source, trade, windings};
use meshsweep::BuildError;
use meshsweep::bvh::{self, TreeOptions};
use meshsweep::collapse::Progress;
use meshsweep::counted::Counted;
use meshsweep::emit::{self, Sections};
use meshsweep::hull::{self, BuildReport, Built, Kind};
use meshsweep::mesh::KeyFrame;
use meshsweep::surface::{VertexBits, components_whose_boxes_meet};
use meshsweep::tight::{self, ChainOptions, Goal, HullReport, Stage};
use meshsweep::tribox::{self, TriboxReport};
use meshsweep_core::Blob;
use meshsweep_core::internal::format::layout::VertexFormat;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Triboxes unless told otherwise.
const TRIBOXES: u32 = 64;

/// The remedy for a mesh that is not closed.
const INSTEAD: &str =
    "for distances and segments, --for closest,segment and --for sweep need no closed mesh";

pub fn run(args: &BuildArgs) -> Result<(), Failure> {
    let wanted = args.wanted();
    refuse_options(args).map_or(Ok(()), |what| Err(Failure::Usage { what }))?;
    let inputs: Vec<&Path> =
        [&args.mesh].into_iter().chain(&args.frames).map(PathBuf::as_path).collect();
    refuse_same_file(Some(&args.output), &inputs)?;
    Output::probe(&args.output)?;
    source::probe(args, &inputs)?;
    if args.limits.given().is_some() {
        return trade::build(args);
    }
    if args.is_curve() {
        return curve::build(args);
    }
    let (mut frames, unit) = (None, args.unit);
    let loaded = if wanted.deform {
        let (loaded, keys) =
            mesh_file::load_deformable(&args.mesh, &args.frames, unit, Some(INSTEAD))?;
        frames = Some(keys);
        loaded
    } else if wanted.hull {
        mesh_file::load_solid(&args.mesh, args.vertex_bits.format(), unit, Some(INSTEAD))?
    } else if wanted.sweep {
        mesh_file::load_snapped(&args.mesh, args.vertex_bits.format(), unit)?
    } else {
        mesh_file::load(&args.mesh, unit)?
    };
    let hull = match wanted.hierarchy() {
        true => Some(build_hull(args, &loaded, frames.as_deref())?),
        false => None,
    };
    // A grid so coarse would be the greater part of every interval.
    let is_far = args.vertex_bits == StoredBits::Auto && bvh::is_too_far_for_grid(&loaded.mesh);
    let options = TreeOptions::default()
        .with_closest(wanted.closest)
        .with_segments(wanted.segment)
        .with_cull(wanted.cull)
        .with_winding(wanted.winding)
        .with_f32(args.vertex_bits.is_f32() || is_far);
    let failed = |error| Failure::build(&args.mesh, error);
    let tree = wanted.tree().then(|| bvh::build(loaded.input(), &options)).transpose();
    let tree = tree.map_err(failed)?;
    let triboxes = if wanted.triboxes { Some(build_triboxes(args, &loaded)?) } else { None };
    let tight = if wanted.tight { Some(build_tight(args, &loaded)?) } else { None };
    let hierarchy = hull.as_ref().map(|hull| hull.tables.sections());
    let bytes = emit::assemble(
        [
            hierarchy.as_ref(),
            hull.as_ref().and_then(|hull| hull.deform.as_ref()),
            tree.as_ref().map(|(tables, _)| tables),
            triboxes.as_ref().map(|(tables, _)| tables),
            tight.as_ref().map(|(tables, _)| tables),
        ]
        .into_iter()
        .flatten(),
    );
    if wanted.winding {
        windings::warn(&args.mesh, &loaded);
    }
    // A blob that does not open must not be written.
    let blob = Blob::open(&bytes).map_err(|error| failed(BuildError::Reopen(error)))?;
    source::write(args, &blob)?;
    let report = Report {
        args,
        loaded: &loaded,
        hull: hull.as_ref().map(|hull| &hull.report),
        tree_time: tree.as_ref().map(|(_, report)| report.time),
        tribox_time: triboxes.as_ref().map(|(_, report)| report.time),
        tight: tight.as_ref().map(|(_, reports)| reports.as_slice()),
        blob: &blob,
    };
    Output::stdout().finish(|out| report.write(out))
}

/// Why the options do not go together, if they do not.
fn refuse_options(args: &BuildArgs) -> Option<String> {
    let wanted = args.wanted();
    if args.serves().contains(&Serves::Curve) && mesh_file::is_named_as_mesh(&args.mesh) {
        return Some("--for curve needs a .csv; leave it out for a mesh".to_owned());
    }
    if args.asks_mesh_of_curve() {
        return Some("a curve serves --for curve only; name a mesh for anything else".to_owned());
    }
    if let Some(option) = args.limits.given()
        && let Some(other) = args.chosen_option()
    {
        return Some(format!("{option} chooses structure and dials; leave out {other}"));
    }
    if args.limits.given().is_none() && (args.limits.cpu.is_some() || args.limits.at.is_some()) {
        return Some("--cpu and --at go with --flash, --ram, --error or --rate".to_owned());
    }
    if args.closed && !args.is_curve() {
        return Some("--closed is for curves; add --for curve".to_owned());
    }
    if args.unit.is_some() && args.is_curve() {
        return Some("--unit is for meshes".to_owned());
    }
    if let Some(option) = args.hull_option().filter(|_| !wanted.hierarchy()) {
        return Some(format!("{option} is for a hull; add hull to --for"));
    }
    if !args.frames.is_empty() && !wanted.deform {
        return Some("several meshes are key frames; add --for deform".to_owned());
    }
    if wanted.deform && args.vertex_bits.is_grid() {
        return Some("--for deform keeps the vertices as they are; leave out --vertex-bits".into());
    }
    if args.triboxes.is_some() && !wanted.triboxes {
        return Some("--triboxes is for triboxes; add triboxes to --for".to_owned());
    }
    if let Some(option) = args.tight_option().filter(|_| !wanted.tight) {
        return Some(format!("{option} is for tight hulls; add tight to --for"));
    }
    let too_many = || format!("--tight takes at most {} numbers of faces", tight::MAX_HULLS);
    slack_within_margin(args.slack, args.margin)
        .or_else(|| (args.tight.len() > tight::MAX_HULLS).then(too_many))
}

fn build_hull(
    args: &BuildArgs,
    loaded: &Loaded,
    frames: Option<&[KeyFrame]>,
) -> Result<Built, Failure> {
    let options = args.collapse.options(args.base.unwrap_or(FACES), args.vertex_bits);
    let faces = loaded.mesh.triangles.len();
    let bar = Bar::new(faces.saturating_sub(options.base_faces), "collapsing", "faces");
    let show = |progress: Progress| bar.show(faces.saturating_sub(progress.faces));
    let built = match frames {
        Some(frames) => hull::build_deform(loaded.input(), frames, &options, show),
        None if args.wanted().hull => hull::build(loaded.input(), &options, show),
        None => hull::build_for_sweep(loaded.input(), &options, show),
    };
    built.map_err(|error| Failure::build(&args.mesh, error))
}

fn build_triboxes(args: &BuildArgs, loaded: &Loaded) -> Result<(Sections, TriboxReport), Failure> {
    tribox::store(loaded.input(), args.triboxes.unwrap_or(TRIBOXES))
        .map_err(|error| Failure::build(&args.mesh, error))
}

fn build_tight(args: &BuildArgs, loaded: &Loaded) -> Result<(Sections, Vec<HullReport>), Failure> {
    let asked = |what: HullServes| args.tight_for.is_empty() || args.tight_for.contains(&what);
    let goal = args.void.map(|percent| Goal::Void(percent / 100.0)).or(args.slack.map(Goal::Slack));
    let faces: Vec<usize> = args.tight.iter().map(|&faces| faces as usize).collect();
    let options = goal
        .map_or_else(|| ChainOptions::of_faces(&faces), ChainOptions::of_goal)
        .with_margin(loaded.widened(args.margin))
        .with_effort(args.effort.unwrap_or(1.0))
        .with_vertex_bits(args.vertex_bits.format())
        .with_boxes(asked(HullServes::Closest), asked(HullServes::Segment));
    let mut bars = StageBars::default();
    let made = tight::chain(loaded.input(), &options, |stage| match stage {
        Stage::Wrapping { progress, .. } => bars.show(progress),
        Stage::Certifying => bars = StageBars::default(),
    })
    .map_err(|error| Failure::build(&args.mesh, error))?;
    let asked = Tightness { slack: args.slack, void: args.void, by_faces: "--tight" };
    require_met(&args.mesh, asked, made.1.iter().map(|report| &report.wrapped))?;
    Ok(made)
}

/// The report of the command.
struct Report<'a> {
    args: &'a BuildArgs,
    loaded: &'a Loaded,
    hull: Option<&'a BuildReport>,
    tree_time: Option<Duration>,
    tribox_time: Option<Duration>,
    tight: Option<&'a [HullReport]>,
    blob: &'a Blob<'a>,
}

impl Report<'_> {
    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let Report { args, loaded, hull, tree_time, tribox_time, tight, blob } = self;
        writeln!(out, "{}", args.mesh.display())?;
        writeln!(out, "  {}", loaded.report)?;
        loaded.write_unit(out)?;
        if let Some(report) = hull {
            write_kind(out, &report.kind)?;
            write_wires(out, report.wires)?;
        }
        if loaded.moved > 0.0 {
            writeln!(out, "  vertices moved to the hull's grid by up to {}", AtMost(loaded.moved))?;
        }
        writeln!(out, "{}", args.output.display())?;
        source::report(args, out)?;
        if let Some(report) = hull {
            writeln!(out, "  base hull: {}", Counted(report.base_faces, "face"))?;
            if let Some(stuck) = report.stuck {
                writeln!(out, "  {}", why_stuck(args.base.unwrap_or(FACES), &stuck))?;
            }
            if let Some(note) = other_format(args.vertex_bits, blob.header().vertex_format) {
                writeln!(out, "  {note}")?;
            }
        }
        describe::write_blob(out, blob)?;
        let is_tree_f32 = blob.bvh().is_ok_and(|tree| tree.header().is_f32());
        if is_tree_f32 && !args.vertex_bits.is_f32() {
            writeln!(
                out,
                "  the mesh is too far from its origin for the box tree's grid: its coordinates \
                 are stored as f32"
            )?;
        }
        if blob.bvh().is_ok_and(|tree| tree.is_closed() && tree.serves_distances()) {
            write_overlaps(out, components_whose_boxes_meet(&loaded.mesh))?;
        }
        if let Some(reports) = tight {
            write_left_out(out, args, reports)?;
            write_margin(out, args.margin, "mesh")?;
            reports.first().map_or(Ok(()), |report| write_no_void(out, &report.void))?;
            reports.iter().try_for_each(|report| write_tight(out, report))?;
        }
        write!(out, "seconds: read and repair {:.3}", loaded.time.as_secs_f64())?;
        if let Some(report) = hull {
            write!(
                out,
                ", collapse {:.3} ({}), sweep {:.3}, certify and check {:.3}",
                report.collapse_time.as_secs_f64(),
                Counted(report.programs, "program"),
                report.sweep_time.as_secs_f64(),
                report.certify_time.as_secs_f64()
            )?;
        }
        if let Some(time) = tree_time {
            write!(out, ", box tree {:.3}", time.as_secs_f64())?;
        }
        if let Some(time) = tribox_time {
            write!(out, ", triboxes {:.3}", time.as_secs_f64())?;
        }
        if let Some(reports) = tight {
            let time: Duration = reports.iter().map(|report| report.time).sum();
            write!(out, ", tight hulls {:.3}", time.as_secs_f64())?;
        }
        writeln!(out)
    }
}

/// Says what the levels of the hierarchy are.
fn write_kind(out: &mut dyn Write, kind: &Kind) -> io::Result<()> {
    match *kind {
        Kind::Hulls { volume } => writeln!(out, "  volume {}", About(volume)),
        Kind::SweepOnly { holes, copies } => writeln!(
            out,
            "  no hulls, distances and segments only: {}, {} where the mesh is no manifold",
            Counted(holes, "hole"),
            Counted(copies, "copied vertex")
        ),
    }
}

/// Says of how many connected components the inside may be answered as outside.
fn write_overlaps(out: &mut dyn Write, components: usize) -> io::Result<()> {
    if components == 0 {
        return Ok(());
    }
    writeln!(
        out,
        "connected components whose boxes overlap: {components}; they are not united: where they \
         overlap, a side is that of the nearest surface"
    )
}

/// Names the tight hulls that the blob lacks.
fn write_left_out(out: &mut dyn Write, args: &BuildArgs, reports: &[HullReport]) -> io::Result<()> {
    let mut asked: Vec<u32> = args.tight.clone();
    asked.sort_unstable();
    asked.dedup();
    asked.retain(|&faces| reports.iter().all(|report| report.asked != Goal::Faces(faces as usize)));
    for faces in asked {
        writeln!(
            out,
            "  no tight hull of {faces} faces: it came to no fewer than the next finer one"
        )?;
    }
    Ok(())
}

/// Adds to the table of tight hulls.
fn write_tight(out: &mut dyn Write, report: &HullReport) -> io::Result<()> {
    if let Goal::Faces(asked) = report.asked
        && report.wrapped.faces > asked
    {
        writeln!(
            out,
            "  tight hull of {}: stopped before {}, where no edge may collapse and leave it \
             closed, clear of the mesh and of itself",
            Counted(report.wrapped.faces, "face"),
            asked
        )?;
    }
    write_start(out, &report.wrapped)
}

/// A note if the hull could not have the wanted format.
fn other_format(wanted: StoredBits, got: VertexFormat) -> Option<&'static str> {
    let wanted_format = match wanted.format() {
        VertexBits::Grid16 => VertexFormat::Grid16,
        VertexBits::Grid24 => VertexFormat::Grid24,
        VertexBits::Auto | VertexBits::F32 => return None,
    };
    (got != wanted_format).then_some(
        "the mesh is too small or too far from its origin for the hull's grid: its coordinates \
         are stored as f32",
    )
}
