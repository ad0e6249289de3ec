//! `meshsweep robot`: a robot's description in, blobs and a Rust module out.

use crate::args::{Keep, RobotArgs};
use crate::failure::Failure;
use crate::output::{Output, refuse_same_file};
use meshsweep::counted::Counted;
use meshsweep::number::AtMost;
use meshsweep::robot::{Link, Robot, RobotOptions, Skipped};
use serde_json::{Value, json};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

pub fn run(args: &RobotArgs) -> Result<(), Failure> {
    let options = options(args)?;
    let (stem, module) = names(&args.output)?;
    let inputs = [Some(args.urdf.as_path()), args.srdf.as_deref()];
    let inputs: Vec<&Path> = inputs.into_iter().flatten().collect();
    refuse_same_file(Some(&module), &inputs)?;
    Output::probe(&module)?;
    args.threads.start();
    let robot = Robot::read(&args.urdf, &options);
    let robot = robot.map_err(|error| Failure::build(&args.urdf, error))?;
    let file = args.urdf.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let source = robot.source(&stem, &file);
    let blobs: Vec<PathBuf> =
        source.blobs.iter().map(|name| args.output.with_file_name(name)).collect();
    for (blob, link) in blobs.iter().zip(&robot.links) {
        refuse_same_file(Some(blob), &inputs)?;
        Output::file(blob)?.finish(|out| out.write_all(link.built.bytes()))?;
    }
    Output::file(&module)?.finish(|out| out.write_all(source.module.as_bytes()))?;
    Output::stdout().finish(|out| {
        if args.json {
            serde_json::to_writer_pretty(&mut *out, &as_json(&robot, &module, &blobs))?;
            return writeln!(out);
        }
        writeln!(out, "{}", module.display())?;
        write(out, args, &robot, &blobs)
    })
}

fn options(args: &RobotArgs) -> Result<RobotOptions, Failure> {
    let usage = |what: &str| Failure::Usage { what: what.to_owned() };
    let of_all: Vec<f64> =
        args.keep.iter().filter(|keep| keep.pair.is_none()).map(|keep| keep.distance).collect();
    let &[keep] = of_all.as_slice() else {
        return Err(usage("--keep wants one distance of all pairs, as --keep 0.02"));
    };
    let own = |Keep { pair, distance }: &Keep| pair.clone().map(|pair| (pair, *distance));
    let mut options = RobotOptions::default();
    options.srdf.clone_from(&args.srdf);
    options.packages.clone_from(&args.package);
    options.keep = keep;
    options.keep_pairs = args.keep.iter().filter_map(own).collect();
    options.samples = args.samples;
    Ok(options)
}

/// The stem of all files, and the module's path.
fn names(output: &Path) -> Result<(String, PathBuf), Failure> {
    let name = output.file_name().and_then(|name| name.to_str());
    let Some(name) = name.filter(|name| *name != "-") else {
        let what = format!("{}: a name in UTF-8 is wanted", output.display());
        return Err(Failure::Usage { what });
    };
    let stem = name.strip_suffix(".rs").unwrap_or(name).to_owned();
    let module = output.with_file_name(format!("{stem}.rs"));
    Ok((stem, module))
}

/// A link that is so many times larger than all joints are apart is suspected of another unit.
/// Millimetres that are read as metres make it a thousand times larger.
const SUSPECTED: f64 = 30.0;

/// The links whose meshes may be in another unit than metres.
fn too_large(robot: &Robot) -> Vec<&str> {
    let length = |shift: [f32; 3]| shift.map(|x| f64::from(x).powi(2)).iter().sum::<f64>().sqrt();
    let apart: f64 = robot.joints.iter().map(|joint| length(joint.origin.pose.translation)).sum();
    let is_large = |link: &&Link| apart > 0.0 && f64::from(link.radius) > SUSPECTED * apart;
    robot.links.iter().filter(is_large).map(|link| link.name.as_str()).collect()
}

fn triangles(link: &Link) -> usize {
    link.built.loaded.as_ref().map_or(0, |loaded| loaded.input_triangles)
}

fn write(
    out: &mut dyn Write,
    args: &RobotArgs,
    robot: &Robot,
    blobs: &[PathBuf],
) -> io::Result<()> {
    let widest = robot.links.iter().map(|link| link.name.chars().count()).max().unwrap_or(0).max(4);
    writeln!(
        out,
        "{:widest$} {:>9} {:>8} {:>10} {:>10} {:>10}  blob",
        "link", "triangles", "bytes", "radius", "rounding", "beyond"
    )?;
    for (link, blob) in robot.links.iter().zip(blobs) {
        let (count, bytes) = (triangles(link), link.built.bytes().len());
        let radius = AtMost(link.radius).to_string();
        let (rounding, beyond) =
            (AtMost(link.rounding).to_string(), AtMost(link.beyond).to_string());
        let name = &link.name;
        writeln!(
            out,
            "{name:widest$} {count:>9} {bytes:>8} {radius:>10} {rounding:>10} {beyond:>10}  {}",
            blob.display()
        )?;
    }
    let bytes: usize = robot.links.iter().map(|link| link.built.bytes().len()).sum();
    writeln!(out, "{} in {}, metres", Counted(bytes, "byte"), Counted(robot.links.len(), "blob"))?;
    for link in &robot.links {
        // The first note counts the triangles again.
        let notes = link.built.report_on(meshsweep::builder::Topic::Input).skip(1);
        for note in notes.filter(|note| !note.text.starts_with("unit: ")) {
            writeln!(out, "  {}: {note}", link.name)?;
        }
    }
    let large = too_large(robot);
    if !large.is_empty() {
        writeln!(
            out,
            "more than {SUSPECTED} times larger than all joints are apart: {}; meshes are read in \
             metres: give those in millimetres scale=\"0.001 0.001 0.001\"",
            large.join(", ")
        )?;
    }
    if !robot.without_geometry.is_empty() {
        writeln!(
            out,
            "without collision geometry, not guarded: {}",
            robot.without_geometry.join(", ")
        )?;
    }
    let places =
        robot.places.iter().map(|place| place.joint.as_str()).collect::<Vec<_>>().join(", ");
    writeln!(out, "{}: {places}", Counted(robot.places.len(), "place"))?;
    let name = |at: usize| robot.links[at].name.as_str();
    writeln!(out, "{} kept", Counted(robot.pairs.len(), "pair"))?;
    for pair in &robot.pairs {
        let [a, b] = pair.links.map(name);
        writeln!(out, "  {a}, {b}: {}", AtMost(pair.keep))?;
    }
    for why in [Skipped::Neighbours, Skipped::Rigid, Skipped::Disabled, Skipped::AlwaysMeet] {
        let of = robot.skipped.iter().filter(|(_, other)| *other == why);
        let pairs: Vec<String> =
            of.map(|([a, b], _)| format!("{}, {}", name(*a), name(*b))).collect();
        if !pairs.is_empty() {
            writeln!(
                out,
                "{} left out, {why}: {}",
                Counted(pairs.len(), "pair"),
                pairs.join("; ")
            )?;
        }
    }
    if robot.skipped.iter().any(|(_, why)| *why == Skipped::AlwaysMeet) {
        writeln!(
            out,
            "  tried at {}; guard them by --keep A,B=D",
            Counted(args.samples, "random place")
        )?;
    }
    if robot.never > 0 {
        let pairs = Counted(robot.never, "pair");
        writeln!(out, "{pairs} that the SRDF disables as Never kept: samples prove nothing")?;
    }
    if !robot.unknown.is_empty() {
        writeln!(out, "the SRDF names links that are not there: {}", robot.unknown.join(", "))?;
    }
    Ok(())
}

fn as_json(robot: &Robot, module: &Path, blobs: &[PathBuf]) -> Value {
    let link = |(link, blob): (&Link, &PathBuf)| {
        let notes = link.built.report_on(meshsweep::builder::Topic::Input);
        let notes = notes.filter(|note| !note.text.starts_with("unit: "));
        json!({
            "name": link.name,
            "blob": blob.display().to_string(),
            "triangles": triangles(link),
            "bytes": link.built.bytes().len(),
            "radius": link.radius,
            "rounding": link.rounding,
            "beyond": link.beyond,
            "notes": notes.map(ToString::to_string).collect::<Vec<_>>(),
        })
    };
    let place = |place: &meshsweep::robot::Place| json!({ "joint": place.joint, "slides": place.slides, "limits": place.limits });
    let names = |links: [usize; 2]| links.map(|at| robot.links[at].name.as_str());
    json!({
        "name": robot.name,
        "module": module.display().to_string(),
        "links": robot.links.iter().zip(blobs).map(link).collect::<Vec<_>>(),
        "too_large": too_large(robot),
        "without_geometry": robot.without_geometry,
        "places": robot.places.iter().map(place).collect::<Vec<_>>(),
        "pairs": robot.pairs.iter().map(|pair| json!({
            "links": names(pair.links), "keep": pair.keep, "distance": pair.distance,
        })).collect::<Vec<_>>(),
        "skipped": robot.skipped.iter().map(|(links, why)| json!({
            "links": names(*links), "why": why.to_string(),
        })).collect::<Vec<_>>(),
        "never": robot.never,
        "unknown": robot.unknown,
    })
}
