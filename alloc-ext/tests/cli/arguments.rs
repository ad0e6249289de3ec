//! How queries are given, on how many threads they are asked, and that the help says what is true.

use crate::support::{
    Triangle, arg, blob, fixture, hull_blob, meshsweep, ok, random_queries, scratch, triangles,
    write_csv, write_raw,
};
use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::Stdio;

/// Standard output of the program with this standard input.
fn with_input(args: &[&str], input: &str) -> String {
    let mut child = meshsweep()
        .args(args)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("it starts");
    child.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success());
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn queries_are_arguments_files_and_the_standard_input_in_the_order_given() {
    let directory = scratch("given");
    let path = blob(&directory, "torus.ply", &[]);
    let (csv, raw) = (directory.join("q.csv"), directory.join("q.f32"));
    write_csv(&csv, &[[5f32, 6.0, 7.0], [-1.0, 0.0, 0.25]]);
    write_raw(&raw, &[[0.5f32, 0.5, 0.5]]);
    let all = directory.join("all.csv");
    let rows = [
        [-1f32, -2.0, 3.5],
        [5.0, 6.0, 7.0],
        [-1.0, 0.0, 0.25],
        [1.0, 2.0, 3.0],
        [0.5, 0.5, 0.5],
        [-0.5, 0.0, -2e-3],
    ];
    write_csv(&all, &rows);
    for (command, options) in [
        ("closest", &[][..]),
        ("within", &["-d", "1"]),
        ("nearest", &["-n", "2"]),
        ("signed", &[]),
        ("closest", &["--rel", "0.5"]),
    ] {
        let mixed = ["-1,-2,3.5", arg(&csv), "-", arg(&raw), "-.5, 0,-2e-3"];
        let answers =
            with_input(&[&[command, arg(&path)], &mixed[..], options].concat(), "x y z\n1 2 3\n");
        assert_eq!(answers, ok([&[command, arg(&path), arg(&all)], options].concat()), "{command}");
        assert!(answers.lines().count() > rows.len());
    }
    let segments = [[-5f32, 0.0, 0.0, 5.0, 0.125, 0.0], [0.0, 0.0, 9.0, 2.0, 0.0, -9.0]];
    write_csv(&all, &segments);
    let given = ok(["segment", arg(&path), "-5,0,0,5,.125,0", "0,0,9,2,0,-9"]);
    assert_eq!(given, ok(["segment", arg(&path), arg(&all)]));
}

#[test]
fn answers_do_not_depend_on_the_number_of_threads() {
    let directory = scratch("threads");
    let tree = blob(&directory, "bracket.stl", &[]);
    let hull = hull_blob(&directory, "torus.ply", &[]);
    let mesh = triangles(&fixture("bracket.stl"));
    let (points, segments) = (directory.join("p.csv"), directory.join("s.csv"));
    write_csv(&points, &random_queries::<3>(&mesh, 2000));
    write_csv(&segments, &random_queries::<6>(&mesh, 2000));
    for (command, blob, queries, options) in [
        ("closest", &tree, &points, &[][..]),
        ("closest", &tree, &points, &["--steps", "5"]),
        ("closest", &hull, &points, &["--rel", "0.1"]),
        ("within", &tree, &points, &["-d", "5"]),
        ("within", &tree, &points, &["-d", "2", "--all"]),
        ("nearest", &tree, &points, &["-n", "3"]),
        ("signed", &tree, &points, &[]),
        ("segment", &tree, &segments, &[]),
        ("segment", &tree, &segments, &["--all"]),
        ("segment", &hull, &segments, &[]),
    ] {
        let on = |threads: &str| {
            ok([&[command, arg(blob), arg(queries), "--threads", threads], options].concat())
        };
        let one = on("1");
        assert!(one.lines().count() > 2000);
        assert!(one == on("3") && one == on("64"), "{command} {options:?}");
    }
}

#[test]
fn batches_give_the_answers_of_single_queries() {
    let directory = scratch("batches");
    let path = blob(&directory, "bracket.stl", &[]);
    let points = directory.join("p.f32");
    // More than one batch.
    write_raw(&points, &random_queries::<3>(&triangles(&fixture("bracket.stl")), 20_000));
    let ask = |options: &[&str]| ok([&["closest", arg(&path), arg(&points)], options].concat());
    let one_by_one = ask(&["--steps", "1000000", "--threads", "1"]);
    let batches = ask(&["--threads", "1"]);
    assert!(
        batches == ask(&["--threads", "2"]),
        "work, too, is the same for any number of threads"
    );
    let without_work = |line: &str| line.rsplit_once(',').map(|(answer, _)| answer.to_owned());
    let pairs = batches.lines().zip(one_by_one.lines());
    assert!(pairs.clone().all(|(batch, one)| without_work(batch) == without_work(one)));
    let saved = pairs.filter(|(batch, one)| batch != one).count();
    assert!(saved > 1000, "a batch saves work: {saved}");
}

#[test]
fn every_command_s_help_has_examples_that_run() {
    let directory = scratch("examples");
    // A box: its hulls and triboxes are found at once.
    write_stl(&directory.join("part.stl"), &box_triangles([40.0, 20.0, 10.0]));
    write_stl(&directory.join("tool.stl"), &box_triangles([8.0, 8.0, 30.0]));
    let (torus, scan) = (fixture("torus.ply"), directory.join("scan.ply"));
    ok(["hull", arg(&torus), "--progressive", "--faces", "60", "-o", arg(&scan)]);
    let (points, segments) = ([[1f32, 2.0, 3.0]; 3], [[20f32, 10.0, 90.0, 20.0, 10.0, -90.0]; 3]);
    write_csv(&directory.join("points.csv"), &points);
    write_raw(&directory.join("points.f32"), &points);
    write_csv(&directory.join("segments.csv"), &segments);
    let path = [30f32, 30.0, 300.0].map(|x| [x, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
    write_csv(&directory.join("path.csv"), &path);
    fs::copy(fixture("fence.csv"), directory.join("fence.csv")).unwrap();
    for frame in ["rest.ply", "bent.ply"] {
        fs::copy(&scan, directory.join(frame)).unwrap();
    }
    fs::create_dir(directory.join("src")).unwrap();
    for (robot, package) in [("arm", ""), ("ur5", "package://ur_description/")] {
        let link = |name: &str| {
            let shape = format!("<geometry><mesh filename=\"{package}part.stl\"/></geometry>");
            format!("<link name=\"{name}\"><collision>{shape}</collision></link>")
        };
        let joint = |[name, parent, child]: [&str; 3]| {
            format!(
                "<joint name=\"{name}\" type=\"continuous\"><parent link=\"{parent}\"/>\
                 <child link=\"{child}\"/><origin xyz=\"60 0 0\"/><axis xyz=\"0 1 0\"/></joint>"
            )
        };
        // Links that share a joint keep no distance. The tool comes near the base at some angles.
        let links = ["base", "arm", "tool"].map(link).concat();
        let joints = [["turn", "base", "arm"], ["bend", "arm", "tool"]].map(joint).concat();
        let text = format!("<robot name=\"arm\">{links}{joints}</robot>");
        fs::write(directory.join(robot).with_extension("urdf"), text).unwrap();
    }
    fs::write(directory.join("arm.srdf"), "<robot name=\"arm\"/>").unwrap();
    let everything = ["--for", "closest,segment,cull,winding,hull,triboxes", "--triboxes", "8"];
    let part = blob(&directory, "torus.ply", &everything);
    let boxed = directory.join("boxed.msw");
    ok(["build", arg(&directory.join("part.stl")), "-o", arg(&boxed)]);
    let commands = ok(["help"]);
    let commands = commands.lines().skip_while(|line| *line != "Commands:").skip(1);
    let commands: Vec<&str> = commands
        .map_while(|line| line.split_whitespace().next())
        .filter(|command| *command != "help")
        .collect();
    assert_eq!(commands.len(), 22, "{commands:?}");
    for command in commands {
        let help = ok(["help", command]);
        let examples: Vec<&str> =
            help.lines().filter_map(|line| line.strip_prefix("  meshsweep ")).collect();
        assert!(examples.iter().any(|example| example.starts_with(command)), "{command}: {help}");
        for example in examples {
            // A field has a million points, each of which takes long by winding numbers, and the
            // search for the worst point of a torus takes seconds.
            let of_part =
                if matches!(command, "verify" | "field" | "worst") { &boxed } else { &part };
            fs::copy(of_part, directory.join("part.msw")).unwrap();
            fs::copy(&part, directory.join("tool.msw")).unwrap();
            let (words, input) = example.split_once(" < ").unwrap_or((example, ""));
            let mut program = meshsweep();
            program.args(words.split_whitespace()).current_dir(&directory);
            if !input.is_empty() {
                program.stdin(fs::File::open(directory.join(input)).unwrap());
            }
            let output = program.output().unwrap();
            assert!(
                output.status.success(),
                "{example}: {}",
                String::from_utf8_lossy(&output.stderr)
            );
            assert!(!output.stdout.is_empty() || writes(example, &directory), "{example}");
        }
    }
}

fn box_triangles(size: [f64; 3]) -> Vec<Triangle> {
    let corner = |i: usize| [0, 1, 2].map(|k| if i >> k & 1 == 1 { size[k] } else { 0.0 });
    let quads =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let halves = |[a, b, c, d]: [usize; 4]| [[a, b, c], [a, c, d]].map(|t| t.map(corner));
    quads.into_iter().flat_map(halves).collect()
}

fn write_stl(path: &Path, triangles: &[Triangle]) {
    let mut text = String::from("solid part\n");
    for corners in triangles {
        text += "facet normal 0 0 0\nouter loop\n";
        corners.iter().for_each(|[x, y, z]| text += &format!("vertex {x} {y} {z}\n"));
        text += "endloop\nendfacet\n";
    }
    fs::write(path, text + "endsolid part\n").unwrap();
}

/// Whether the example wrote what it names.
fn writes(example: &str, directory: &Path) -> bool {
    example.split(" -o ").nth(1).is_some_and(|name| directory.join(name).exists())
}

#[test]
fn help_names_every_option_with_a_sentence() {
    for command in [
        "build", "info", "closest", "within", "nearest", "signed", "field", "segment", "overlap",
        "cull", "hull", "refine", "cut", "verify", "trade",
    ] {
        let help = ok([command, "-h"]);
        // Options are indented by at most six blanks. A sentence that goes on in the next line is
        // indented by more, and prose by none; both may begin with an option's name.
        let is_option = |line: &&str| {
            let option = line.trim_start();
            (2..=6).contains(&(line.len() - option.len())) && option.starts_with('-')
        };
        let options: Vec<&str> = help.lines().filter(is_option).collect();
        assert!(
            options.iter().all(|line| line.trim().split("  ").count() > 1),
            "{command}: {help}"
        );
        // No line is wider than a terminal shows.
        let long = ok([command, "--help"]);
        let lines = help.lines().chain(long.lines());
        assert!(lines.into_iter().all(|line| line.chars().count() <= 100), "{command}");
        let examples = |text: &str| text.split_once("Examples:").unwrap().1.to_owned();
        assert_eq!(examples(&help), examples(&long));
        assert_eq!(long, ok(["help", command]));
        assert!(command == "info" || help.len() < long.len(), "{command}");
    }
    let [short, long] = ["-h", "--help"].map(|form| ok(["build", form]).lines().count());
    assert!(short < 90 && long > 2 * short, "{short} {long}");
}
