//! The library's `Builder` gives what the program writes and says, and ends when it is told to.

use crate::support::{arg, coarse_torus, fixture, run, scratch};
use meshsweep::builder::{For, Recipe, Stage, Topic, ranges};
use meshsweep::collapse::{CollapseOptions, Priority};
use meshsweep::curve::{self, CurveOptions, read_csv};
use meshsweep::hull::{self, BuildOptions};
use meshsweep::load::Source;
use meshsweep::lp::Order;
use meshsweep::mesh::{self, MeshError, RawMesh, Unit};
use meshsweep::number::{ABOVE_ZERO, FROM_ZERO};
use meshsweep::progress::{Callback, Watch};
use meshsweep::surface::VertexBits;
use meshsweep::tight::{self, ChainOptions};
use meshsweep::tribox::{self, Measure, TriboxOptions};
use meshsweep::{BuildError, Builder, Built};
use std::fs;
use std::ops::ControlFlow::{Break, Continue};
use std::path::{Path, PathBuf};

/// The fixture that a question is asked of, and the options that make it quick.
fn quick<'a>(question: For) -> (&'static str, Builder<'a>, &'static [&'static str]) {
    let builder = Builder::new().serve(question);
    match question {
        For::Curve => ("fence.csv", builder, &[]),
        For::Tight => {
            let builder = builder.tight_faces(&[300]).effort(0.01);
            ("bracket.stl", builder, &["--tight", "300", "--effort", "0.01"])
        }
        For::Triboxes => ("bracket.stl", builder.triboxes(6), &["--triboxes", "6"]),
        _ => ("bracket.stl", builder, &[]),
    }
}

/// What the program writes; or its refusal, without the first word.
fn by_program(
    directory: &Path,
    mesh: &Path,
    options: &[&str],
) -> Result<(Vec<u8>, String), String> {
    let blob = directory.join("program.msw");
    let output = run([&["build", arg(mesh), "-o", arg(&blob)], options].concat());
    let [said, errors] =
        [output.stdout, output.stderr].map(|text| String::from_utf8(text).unwrap());
    if output.status.success() {
        Ok((fs::read(&blob).expect("it was written"), said + &errors))
    } else {
        Err(errors.trim_start_matches("error: ").trim_end().to_owned())
    }
}

/// Demands that library and program agree on a file: the same bytes, and all notes in the program's
/// report; or the same refusal.
fn demand_same(directory: &Path, mesh: &Path, builder: Builder<'_>, options: &[&str]) {
    match (builder.build_file(mesh), by_program(directory, mesh, options)) {
        (Ok(built), Ok((bytes, said))) => {
            assert!(built.bytes() == bytes, "{} {options:?}: other bytes", mesh.display());
            for note in built.report() {
                let line = match note.topic {
                    Topic::Sides => format!("\n{note}\n"),
                    Topic::Winding => format!(": {note}\n"),
                    _ => format!("\n  {note}\n"),
                };
                assert!(said.contains(&line), "{line:?} is missing in {said}");
            }
        }
        (Err(error), Err(refusal)) => {
            let lines: Vec<String> =
                error.to_string().lines().map(|line| line.trim().to_owned()).collect();
            // The program names the file where the library has no need to.
            assert!(refusal.contains(&lines.join("; ")), "{error:?} and {refusal}");
        }
        (ours, theirs) => panic!("{}: {ours:?} and {theirs:?}", mesh.display()),
    }
}

#[test]
fn each_question_gets_the_bytes_that_the_program_writes() {
    let directory = scratch("builder_bytes");
    for question in For::ALL {
        let (name, builder, options) = quick(question);
        let asked = ["--for", question.name()];
        demand_same(&directory, &fixture(name), builder, &[&asked, options].concat());
    }
    demand_same(&directory, &fixture("torus.ply"), Builder::new(), &[]);
}

#[test]
fn a_recipe_says_the_options_that_build_it() {
    let directory = scratch("builder_recipes");
    let torus = coarse_torus(&directory);
    for recipe in [
        Recipe::Tree(VertexBits::Grid16),
        Recipe::Tree(VertexBits::F32),
        Recipe::Sweep(VertexBits::Grid24),
        Recipe::Tight(200),
        Recipe::Triboxes(8),
    ] {
        let typed = recipe.to_string();
        let typed: Vec<&str> = typed.split_whitespace().collect();
        demand_same(&directory, &torus, Builder::of(recipe), &typed);
    }
}

#[test]
fn each_option_means_what_it_means_to_the_program() {
    let directory = scratch("builder_options");
    let bracket = fixture("bracket.stl");
    let collapse = CollapseOptions {
        max_valence: Some(9),
        compactness: Some(0.5),
        max_normal_deviation: Some(45.0),
        priority: Some(Priority::Span),
        order: Some(Order::Shuffled(7)),
    };
    let several = Builder::new()
        .serve_all([For::Hull, For::Triboxes, For::Segment])
        .vertex_bits(VertexBits::Grid16)
        .unit(Unit::Mm)
        .base_faces(300)
        .collapse(collapse)
        .triboxes(5)
        .tribox_error(0.5)
        .orient(Measure::Area)
        .extrema(true);
    let typed = "--for hull,triboxes,segment --unit mm --vertex-bits 16 --base 300 --max-valence 9 \
                 --compactness 0.5 --max-normal-deviation 45 --priority span --order shuffled:7 \
                 --triboxes 5 --tribox-error 0.5 --orient area --extrema";
    assert_eq!(several.to_string(), typed);
    demand_same(&directory, &bracket, several, &typed.split_whitespace().collect::<Vec<_>>());
    let torus = coarse_torus(&directory);
    let tight = || Builder::new().serve(For::Tight).effort(0.0);
    for (builder, typed) in [
        (tight().slack(0.3).margin(0.1), "--slack 0.3 --margin 0.1"),
        (tight().void_percent(12.0).tight_for(true, false), "--void 12 --tight-for closest"),
        (tight().void_percent(1e-6), "--void 1e-6"),
        (tight().tight_faces(&[200, 201, 600]), "--tight 200,201,600"),
    ] {
        let typed = format!("--for tight --effort 0 {typed}");
        demand_same(&directory, &torus, builder, &typed.split_whitespace().collect::<Vec<_>>());
    }
    demand_same(&directory, &fixture("fence.csv"), Builder::new().closed(true), &["--closed"]);
}

#[test]
fn defects_are_reported_and_refused_in_the_program_s_words() {
    let directory = scratch("builder_defects");
    let files = fs::read_dir(fixture("evil")).expect("a folder").flatten();
    let is_small = |file: &PathBuf| file.metadata().is_ok_and(|found| found.len() < 100_000);
    let files: Vec<PathBuf> = files.map(|entry| entry.path()).filter(is_small).collect();
    assert!(files.len() > 20);
    for file in &files {
        for asked in [vec![For::Closest, For::Winding], vec![For::Hull], vec![For::Sweep]] {
            let typed = asked.iter().map(For::to_string).collect::<Vec<_>>().join(",");
            let builder = Builder::new().serve_all(asked);
            demand_same(&directory, file, builder, &["--for", &typed]);
        }
    }
    let missing = directory.join("missing.stl");
    demand_same(&directory, &missing, Builder::new(), &[]);
    for (builder, typed) in [
        (Builder::new().base_faces(9), "--base 9"),
        (Builder::new().triboxes(9), "--triboxes 9"),
        (Builder::new().tribox_error(1.0), "--tribox-error 1"),
        (Builder::new().orient(Measure::Volume), "--orient volume"),
        (Builder::new().extrema(true), "--extrema"),
        (Builder::new().margin(1.0), "--margin 1"),
        (Builder::new().closed(true), "--closed"),
        (Builder::new().serve(For::Curve), "--for curve"),
        (
            Builder::new().serve(For::Deform).vertex_bits(VertexBits::Grid16),
            "--for deform --vertex-bits 16",
        ),
    ] {
        let typed: Vec<&str> = typed.split_whitespace().collect();
        demand_same(&directory, &fixture("bracket.stl"), builder, &typed);
    }
}

#[test]
fn a_mesh_in_memory_gives_the_bytes_of_its_file() {
    let bracket = fixture("bracket.stl");
    let raw = || mesh::read(&bracket).expect("a mesh");
    let bytes = |built: Result<Built, BuildError>| built.expect("it builds").into_bytes();
    let by_file = bytes(Builder::new().build_file(&bracket));
    assert!(bytes(Builder::new().build(raw())) == by_file);
    let positions: Vec<[f32; 3]> = raw().positions.iter().map(|p| p.map(|x| x as f32)).collect();
    let arrays = RawMesh::from_f32(&positions, &raw().triangles);
    assert!(bytes(Builder::new().build(arrays)) == by_file);

    let deform = || Builder::new().serve(For::Deform);
    let by_file = bytes(deform().frame_file(&bracket).build_file(&bracket));
    assert!(bytes(deform().frame(raw()).build(raw())) == by_file);

    let fence = fixture("fence.csv");
    let polylines = read_csv(&fs::read(&fence).unwrap(), false).expect("polylines");
    let in_memory = Builder::new().build_curves(&polylines);
    assert!(bytes(in_memory) == bytes(Builder::new().build_file(&fence)));
}

#[test]
fn arrays_that_are_no_mesh_are_refused_by_type() {
    let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
    let refused = |positions: &[[f32; 3]], triangles: &[[u32; 3]], builder: Builder<'_>| {
        builder.build(RawMesh::from_f32(positions, triangles)).expect_err("no mesh")
    };
    let of_mesh = |error| match error {
        BuildError::Mesh { error, .. } => *error,
        other => panic!("{other:?}"),
    };
    for wrong in [f32::NAN, f32::INFINITY] {
        let mut positions = square;
        positions[2][1] = wrong;
        let error = of_mesh(refused(&positions, &[[0, 1, 2]], Builder::new()));
        assert!(matches!(error, MeshError::NotFinite { vertex: 2, .. }), "{error:?}");
    }
    let error = of_mesh(refused(&square, &[[0, 1, 2], [1, 2, 4]], Builder::new()));
    assert!(matches!(error, MeshError::IndexOutOfRange { face: 1, index: 4, .. }), "{error:?}");
    assert!(matches!(
        of_mesh(refused(&square, &[], Builder::new())),
        MeshError::NoTriangles { .. }
    ));
    let error = refused(&square, &[[0, 1, 2], [1, 3, 2]], Builder::new().serve(For::Hull));
    let BuildError::NotSolid { error, .. } = error else { panic!("{error:?}") };
    assert!(matches!(*error, MeshError::Open { .. }), "{error:?}");
    let tight = || Builder::new().serve(For::Tight);
    for (builder, wanted) in [
        (tight().slack(1.0).void_percent(5.0), "--slack"),
        (tight().slack(1.0).tight_faces(&[60]), "--slack"),
        (tight().void_percent(5.0).tight_faces(&[60]), "--void"),
        (Builder::new().slack(1.0), "--slack"),
        (Builder::new().serve(For::Curve), "--for curve"),
    ] {
        let error = refused(&square, &[[0, 1, 2]], builder);
        assert!(
            matches!(error, BuildError::Option { option, .. } if option == wanted),
            "{error:?}"
        );
    }
    let error = Builder::new().build_curves(&[]).expect_err("no points");
    assert!(matches!(error, BuildError::Curve { .. }), "{error:?}");
    let error = Builder::new().closed(true).build_curves(&[]).expect_err("they say it themselves");
    assert!(matches!(error, BuildError::Option { option: "--closed", .. }), "{error:?}");
}

/// An option, its range, and a builder with a number for it.
type Ranged = (&'static str, [f64; 2], fn(f64) -> Builder<'static>);

/// Of the hull hierarchy, with one condition on collapses.
fn collapsing(set: impl FnOnce(&mut CollapseOptions)) -> Builder<'static> {
    let mut options = CollapseOptions::default();
    set(&mut options);
    Builder::new().serve(For::Hull).collapse(options)
}

#[test]
fn numbers_are_taken_in_their_range_and_refused_outside_of_it() {
    let whole = |[least, most]: [u32; 2]| [least, most].map(f64::from);
    let options: [Ranged; 10] = [
        ("--base", whole(ranges::BASE_FACES), |x| {
            Builder::new().serve(For::Hull).base_faces(x as u32)
        }),
        ("--triboxes", whole(ranges::TRIBOX_COUNT), |x| {
            Builder::new().serve(For::Triboxes).triboxes(x as u32)
        }),
        ("--tribox-error", ABOVE_ZERO, |x| Builder::new().serve(For::Triboxes).tribox_error(x)),
        ("--tight", whole(ranges::TIGHT_FACES), |x| {
            Builder::new().serve(For::Tight).tight_faces(&[200, x as u32])
        }),
        ("--max-valence", whole(ranges::MAX_VALENCE), |x| {
            collapsing(|options| options.max_valence = Some(x as u32))
        }),
        ("--effort", ranges::EFFORT, |x| Builder::new().serve(For::Tight).effort(x)),
        ("--slack", ABOVE_ZERO, |x| Builder::new().serve(For::Tight).slack(x)),
        ("--margin", FROM_ZERO, |x| Builder::new().serve(For::Tight).margin(x)),
        ("--compactness", ranges::COMPACTNESS, |x| {
            collapsing(|options| options.compactness = Some(x))
        }),
        ("--max-normal-deviation", ranges::NORMAL_DEVIATION, |x| {
            collapsing(|options| options.max_normal_deviation = Some(x))
        }),
    ];
    let part = Path::new("part.stl");
    for (name, [least, most], builder) in options {
        for inside in [least, least / 2.0 + most / 2.0, most] {
            assert_eq!(builder(inside).check(part), Ok(()), "{name} {inside}");
        }
        let is_whole = ["--base", "--triboxes", "--tight", "--max-valence"].contains(&name);
        let outside = if is_whole {
            // As u32 the greatest base has nothing above it.
            vec![least - 1.0, if most < f64::from(u32::MAX) { most + 1.0 } else { 0.0 }]
        } else {
            vec![least - 1e-300, -1.0, most.next_up(), f64::NAN, f64::INFINITY, -f64::INFINITY]
        };
        for wrong in outside {
            let refused = builder(wrong).check(part);
            assert!(
                matches!(refused, Err(BuildError::OutOfRange { option, .. }) if option == name),
                "{name} {wrong}: {refused:?}"
            );
        }
    }
    // A percentage: its fraction of the least number is 0.
    for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = Builder::new().serve(For::Tight).void_percent(wrong).check(part);
        assert!(
            matches!(refused, Err(BuildError::OutOfRange { option: "--void", .. })),
            "{wrong}: {refused:?}"
        );
    }
}

#[test]
fn a_slack_is_more_than_the_margin() {
    let check = |slack, margin: Option<f64>| {
        let builder = Builder::new().serve(For::Tight).slack(slack).margin(margin);
        builder.check(Path::new("part.stl"))
    };
    for margin in [1e-30, 0.25, 1e30] {
        assert_eq!(check(f64::next_up(margin), Some(margin)), Ok(()));
        for slack in [margin, margin.next_down(), margin / 2.0] {
            let refused = check(slack, Some(margin));
            assert_eq!(refused, Err(BuildError::SlackWithinMargin { slack, margin }));
        }
    }
    assert_eq!(check(f64::MIN_POSITIVE, None), Ok(()));
}

/// The stages and parts that a build tells.
fn told(question: For) -> Vec<(Stage, f64)> {
    let (name, builder, _) = quick(question);
    let mut told = Vec::new();
    let watched = builder.on_progress(|stage, part| told.push((stage, part)));
    watched.build_file(fixture(name)).expect("it builds");
    told
}

#[test]
fn progress_never_falls_and_ends_at_one() {
    for question in For::ALL {
        let told = told(question);
        let parts: Vec<f64> = told.iter().map(|&(_, part)| part).collect();
        assert!(parts.is_sorted() && parts[0] == 0.0, "{question}: {parts:?}");
        assert_eq!(told.last(), Some(&(Stage::Done, 1.0)), "{question}");
        assert!(parts[..parts.len() - 1].iter().all(|&part| part <= 1.0), "{question}");
    }
}

#[test]
fn a_cancelled_build_calls_back_no_more_and_says_so() {
    for question in For::ALL {
        let calls = told(question).len();
        for last in [0, calls / 3, 2 * calls / 3, calls - 1] {
            let (name, builder, _) = quick(question);
            let mut seen = 0;
            let builder = builder.on_progress(|_, _| {
                seen += 1;
                if seen > last { Break(()) } else { Continue(()) }
            });
            let cancelled = builder.build_file(fixture(name)).map(drop);
            assert_eq!(cancelled, Err(BuildError::Cancelled), "{question}: {last} of {calls}");
            assert_eq!(seen, last + 1, "{question}: {last} of {calls}");
        }
    }
}

/// The name of a stage, without its count.
fn name_of(stage: Stage) -> String {
    format!("{stage:?}").split(' ').next().unwrap_or_default().to_owned()
}

/// The stages that a build told, each once, in order.
fn stages<T>(build: impl FnOnce(Watch<'_>) -> Result<T, BuildError>) -> Vec<String> {
    let mut told: Vec<String> = Vec::new();
    let progress = Callback::new(|stage, _| {
        let name = name_of(stage);
        if !told.contains(&name) {
            told.push(name);
        }
    });
    build(progress.watch()).map(drop).expect("it builds");
    told
}

#[test]
fn each_structure_that_is_built_alone_tells_its_own_stages() {
    let source = Source::of_file(&fixture("bracket.stl"), None).expect("it is read");
    let part = source.repaired().expect("it is a mesh");
    let (input, of_hull) = (part.input(), BuildOptions::default());
    let of_tight = ChainOptions::of_faces(&[300]).with_effort(0.01);
    let of_triboxes = TriboxOptions::new(8);
    let curves = read_csv(b"0,0,0\n1,0,0\n1,1,0\n", false).expect("they are curves");
    let of_curves = CurveOptions::default();
    let told = stages(|watch| hull::build(input, &of_hull, watch));
    assert_eq!(told, ["Collapsing", "Certifying"]);
    let told = stages(|watch| tight::build(input, &of_tight, watch));
    assert_eq!(told, ["Collapsing", "Shrinking", "Polishing", "Certifying"]);
    let told = stages(|watch| tribox::build(input, &of_triboxes, watch));
    assert_eq!(told, ["Triboxes"]);
    let told = stages(|watch| curve::build(&curves, &of_curves, watch));
    assert_eq!(told, ["Curve"]);
}

#[test]
fn a_builder_tells_the_stages_of_what_it_serves() {
    for (question, wanted) in [
        (For::Closest, &["Loading", "BoxTree", "Done"][..]),
        (For::Sweep, &["Loading", "Collapsing", "Certifying", "Done"]),
        (For::Triboxes, &["Loading", "Triboxes", "Done"]),
        (For::Curve, &["Curve", "Done"]),
    ] {
        let mut names: Vec<String> =
            told(question).into_iter().map(|(stage, _)| name_of(stage)).collect();
        names.dedup();
        assert_eq!(names, wanted, "{question}");
    }
}
