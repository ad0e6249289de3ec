//! `meshsweep trade`, and `build` with limits.

use crate::support::{
    Triangle, arg, coarse_torus, distance, dot, first_crossing, fixture, number, ok, parse_csv,
    random_queries, refused, run, scratch, sub, triangles, wide, write_csv,
};
use meshsweep_core::{Budget, Bvh, Facing, Hull, OuterSearch, RefinedHull, Scratch};
use serde_json::Value;
use std::fs;
use std::path::Path;

const CUBE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\nv 1 1 1\n\
    f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

fn measured(mesh: &Path, options: &[&str]) -> Value {
    let text = ok([&["trade", arg(mesh), "--json"], options].concat());
    serde_json::from_str(&text).expect("it is JSON")
}

fn rows(trade: &Value) -> &[Value] {
    trade["rows"].as_array().expect("there are rows")
}

fn worst(row: &Value, of: &str) -> Option<f64> {
    row[of]["most"].as_f64()
}

#[test]
fn errors_are_those_of_an_independent_distance_and_the_first_table_is_what_nothing_beats() {
    let directory = scratch("trade_errors");
    let mesh = coarse_torus(&directory);
    let (points, surface) = (directory.join("points.csv"), triangles(&mesh));
    let queries = random_queries::<3>(&surface, 40);
    write_csv(&points, &queries);
    let trade = measured(&mesh, &["--at", arg(&points)]);
    assert!(rows(&trade).len() > 22, "{}", rows(&trade).len());
    for row in rows(&trade) {
        let Some(guaranteed) = worst(row, "guaranteed") else {
            assert!(row["structure"].as_str().is_some_and(|name| name.starts_with("triboxes")));
            continue;
        };
        for of in ["found_lower", "found_upper"] {
            let found = worst(row, of).expect("it is measured");
            assert!(found <= guaranteed * (1.0 + 1e-12), "{row}");
        }
    }
    require_pareto(&trade);
    let find = |structure: &str, dials: &str| {
        let is = |row: &&Value| row["structure"] == structure && row["dials"] == dials;
        rows(&trade).iter().find(is).expect("it is measured")
    };
    let is_field = |row: &&Value| row["layout"].is_string() && row["by_field"].is_null();
    assert!(rows(&trade).iter().filter(is_field).count() >= 2);
    for row in rows(&trade).iter().filter(is_field) {
        // What it says to build has the layout that it names.
        let blob = directory.join("field.msw");
        let options: Vec<&str> = row["build"].as_str().unwrap().split(' ').collect();
        let built = ok([&["build", arg(&mesh), "-o", arg(&blob), "--json"], &options[..]].concat());
        let field = &serde_json::from_str::<Value>(&built).unwrap()["contents"]["sdf"];
        assert_eq!(field["layout"], row["layout"]);
        let layout = row["layout"].as_str().unwrap();
        assert!(row["structure"].as_str().unwrap().ends_with(layout), "{row}");
        // A tree's costliest place takes the steps of `Sdf::steps`; no mean takes more.
        for board in row["instructions"].as_array().unwrap() {
            assert!(board["mean"].as_f64() <= board["most"].as_f64(), "{row}");
        }
        assert!(row["work"]["nodes"].as_f64() <= field["steps"].as_f64(), "{row}");
    }
    let is_cut = |row: &&Value| row["structure"].as_str().is_some_and(|s| s.starts_with("cut"));
    for row in rows(&trade).iter().filter(is_cut) {
        // What it says to build and to cut is the blob that was measured.
        let (build, cut) = row["build"].as_str().unwrap().split_once(", then cut ").unwrap();
        let (whole, part) = (directory.join("whole.msw"), directory.join("part.msw"));
        let ([build, cut], input) =
            ([build, cut].map(|text| text.split(' ').collect::<Vec<_>>()), arg(&mesh));
        ok([&["build", input, "-o", arg(&whole)], &build[..]].concat());
        ok([&["cut", arg(&whole), "-o", arg(&part)], &cut[..]].concat());
        assert_eq!(fs::metadata(&part).unwrap().len(), row["flash"].as_u64().unwrap(), "{row}");
    }
    let header = "x,y,z,lower,upper,px,py,pz,triangle,work";
    for (dials, options) in [("exact", &[][..]), ("steps 4", &["--steps", "4"])] {
        let row = find("box tree, 16 bits", dials);
        let blob = directory.join("tree.msw");
        let build = row["build"].as_str().expect("it says how");
        let words: Vec<&str> = build.split(' ').collect();
        ok([&["build", arg(&mesh), "-o", arg(&blob)], &words[..]].concat());
        assert_eq!(fs::metadata(&blob).unwrap().len(), row["flash"].as_u64().unwrap());
        let answers = ok([&["closest", arg(&blob), arg(&points)], options].concat());
        let (mut width, mut low) = (0f64, 0f64);
        for (answer, query) in parse_csv(&answers, header).iter().zip(&queries) {
            let [lower, upper] = [number(&answer[3]), number(&answer[4])];
            width = width.max(upper - lower);
            low = low.max(distance(wide(query), &surface) - lower);
        }
        // A number of JSON may be read a little off.
        let guaranteed = worst(row, "guaranteed").unwrap();
        assert!((guaranteed - width).abs() <= 1e-12 * width, "{dials}: {guaranteed} {width}");
        let found = worst(row, "found_lower").unwrap();
        assert!((found - low).abs() < 1e-6, "{dials}: {found} {low}");
    }
}

/// Distance along a segment to its first crossing of the surface, or its whole length.
fn free_length(segment: &[f32; 6], surface: &[Triangle]) -> f64 {
    let [a, b] = [wide(&segment[..3]), wide(&segment[3..])];
    let along = sub(b, a);
    dot(along, along).sqrt() * first_crossing(a, b, surface).unwrap_or(1.0)
}

/// Free lengths on the refined hull, and whether each was found there; of a segment that starts in
/// its box by the sweep.
fn on_refined_hull(hull: &Hull<'_>, segments: &[[f32; 6]]) -> Vec<([f64; 2], bool)> {
    let (mut refined, mut scratch) = (RefinedHull::<500>::new(), Scratch::<512>::new());
    let (exact, first) = (Budget::EXACT, OuterSearch::First);
    let of = |segment: &[f32; 6]| {
        let &[a, b] = segment.as_chunks::<3>().0 else { unreachable!() };
        refined.reset();
        let outer = hull.outer_hits(a, b, first, &mut refined, &mut [], exact, &mut scratch);
        let outer = outer.unwrap();
        let t = match outer.starts_inside {
            true => hull.first_hit(a, b, exact, &mut scratch).unwrap().t,
            false => outer.t,
        };
        let along = sub(wide(&b), wide(&a));
        let ends = [t.lower, t.upper].map(|t| f64::from(t).min(1.0) * dot(along, along).sqrt());
        (ends, !outer.starts_inside)
    };
    segments.iter().map(of).collect()
}

#[test]
fn free_lengths_on_the_refined_hull_are_those_of_an_independent_crossing() {
    let directory = scratch("trade_refined");
    let (mesh, hulls) = (fixture("torus.ply"), directory.join("hulls.msw"));
    let (file, surface) = (directory.join("segments.csv"), triangles(&mesh));
    let queries = random_queries::<6>(&surface, 60);
    write_csv(&file, &queries);
    let trade = measured(&mesh, &["--for", "segment", "--at", arg(&file)]);
    let of = |row: &&Value| row["structure"] == "refined hull, 32 bits";
    let row = rows(&trade).iter().find(of).expect("the mesh is closed, and f32 holds it");
    let build: Vec<&str> = row["build"].as_str().unwrap().split(' ').collect();
    ok([&["build", arg(&mesh), "-o", arg(&hulls)], &build[..]].concat());
    let bytes = fs::read(&hulls).unwrap();
    let found = on_refined_hull(&Hull::open(&bytes).unwrap(), &queries);
    let mut refined = 0;
    for (([lower, upper], is_outer), query) in found.iter().zip(&queries) {
        let truth = free_length(query, &surface);
        assert!(lower - 1e-12 <= truth && truth <= upper + 1e-12, "{lower} {truth} {upper}");
        let &[[a, b]] = query.as_chunks::<3>().0.as_chunks::<2>().0 else { unreachable!() };
        let along = sub(wide(&b), wide(&a));
        let is_hit = truth < 0.999 * dot(along, along).sqrt();
        refined += u32::from(*is_outer && is_hit && upper - lower < 1e-5);
    }
    assert!(refined > 5, "{refined} hits were found on the refined hull");
    let width = found.iter().map(|([lower, upper], _)| upper - lower).fold(0.0, f64::max);
    let guaranteed = worst(row, "guaranteed").unwrap();
    assert!((guaranteed - width).abs() <= 1e-9 * width, "{row}: {width}");
    assert_eq!(row["flash"].as_u64(), Some(bytes.len() as u64));
    // f32 does not hold a tenth.
    let tenth = directory.join("tenth.obj");
    fs::write(&tenth, CUBE.replace("v 1 ", "v 0.1 ")).unwrap();
    let trade = measured(&tenth, &["--for", "segment", "--points", "3"]);
    assert!(!rows(&trade).iter().any(|row| of(&row)), "{trade}");
}

#[test]
fn free_lengths_of_segments_are_those_of_an_independent_crossing() {
    let directory = scratch("trade_segments");
    let mesh = coarse_torus(&directory);
    let (file, surface) = (directory.join("segments.csv"), triangles(&mesh));
    let queries = random_queries::<6>(&surface, 60);
    write_csv(&file, &queries);
    let truth: Vec<f64> = queries.iter().map(|query| free_length(query, &surface)).collect();
    let trade = measured(&mesh, &["--for", "segment", "--at", arg(&file)]);
    assert_eq!((&trade["points"], &trade["question"]), (&60.into(), &"segment".into()));
    assert!(rows(&trade).len() >= 12, "{}", rows(&trade).len());
    for row in rows(&trade) {
        let guaranteed = worst(row, "guaranteed").expect("a free length is between two numbers");
        for of in ["found_lower", "found_upper"] {
            assert!(worst(row, of).unwrap() <= guaranteed * (1.0 + 1e-12), "{row}");
        }
    }
    require_pareto(&trade);
    let tree = |row: &&Value| row["structure"] == "box tree, 16 bits" && row["dials"] == "exact";
    let row = rows(&trade).iter().find(tree).expect("it is measured");
    let blob = directory.join("tree.msw");
    let build: Vec<&str> = row["build"].as_str().expect("it says how").split(' ').collect();
    ok([&["build", arg(&mesh), "-o", arg(&blob)], &build[..]].concat());
    assert_eq!(fs::metadata(&blob).unwrap().len(), row["flash"].as_u64().unwrap());
    let bytes = fs::read(&blob).unwrap();
    let (tree, mut scratch) = (Bvh::open(&bytes).unwrap(), Scratch::<64>::new());
    let (mut width, mut low) = (0f64, 0f64);
    for (query, truth) in queries.iter().zip(&truth) {
        let &[[a, b]] = query.as_chunks::<3>().0.as_chunks::<2>().0 else { unreachable!() };
        let hit = tree.first_hit(a, b, Facing::Both, Budget::EXACT, &mut scratch).unwrap();
        let along = sub(wide(&b), wide(&a));
        let [lower, upper] =
            [hit.t.lower, hit.t.upper].map(|t| f64::from(t).min(1.0) * dot(along, along).sqrt());
        assert!(lower <= truth * (1.0 + 1e-12) && *truth <= upper * (1.0 + 1e-12), "{hit:?}");
        (width, low) = (width.max(upper - lower), low.max(truth - lower));
    }
    assert!((worst(row, "guaranteed").unwrap() - width).abs() <= 1e-9 * width, "{row}: {width}");
    assert!((worst(row, "found_lower").unwrap() - low).abs() < 1e-6, "{row}: {low}");
    let answers = ok(["segment", arg(&blob), arg(&file)]);
    let undecided = answers.lines().filter(|line| line.starts_with("undecided,")).count();
    assert_eq!(row["undecided"], undecided);
    let short = |row: &&Value| row["dials"].as_str().is_some_and(|dials| dials.contains(" 4"));
    let short = rows(&trade).iter().find(short).expect("one of four steps");
    assert!(short["undecided"].as_u64().unwrap() > 0, "{short}");
    for kind in ["near", "far", "path"] {
        let trade = measured(&mesh, &["--for", "segment", "--at", kind, "--points", "30"]);
        assert_eq!((&trade["points"], rows(&trade).is_empty()), (&30.into(), false), "{kind}");
    }
    let page = directory.join("page.html");
    let page = ["trade", arg(&mesh), "--for", "segment", "--report", arg(&page)];
    refused(&run(page), 2, "--report");
}

#[test]
fn limits_of_segments_choose_what_answers_segments() {
    let directory = scratch("trade_segment_limits");
    let (mesh, blob) = (directory.join("cube.obj"), directory.join("part.msw"));
    fs::write(&mesh, CUBE).unwrap();
    let build = ["build", arg(&mesh), "-o", arg(&blob), "--for", "segment"];
    let limits = ["--flash", "8K", "--rate", "1kHz", "--cpu", "m4f:168MHz"];
    let text = ok([&build[..], &limits[..]].concat());
    assert!(text.contains("_hit") && text.contains(" segments from near"), "{text}");
    assert!(text.contains("  undecided: 0 of these segments\n"), "{text}");
    let text = ok(["trade", arg(&mesh), "--for", "segment", "--points", "9"]);
    assert!(text.contains(" median undecided ") && text.contains("undecided: segments"), "{text}");
    let hit = ok(["segment", arg(&blob), "0.25,0.5,2,0.25,0.5,0.5"]);
    assert!(hit.lines().count() == 2, "{hit}");
}

/// That no row of the first table is beaten, and every other one is.
fn require_pareto(trade: &Value) {
    let all: Vec<Option<[f64; 3]>> = rows(trade)
        .iter()
        .map(|row| {
            let instructions = row["instructions"][0]["mean"].as_f64()?;
            Some([worst(row, "guaranteed")?, instructions, row["flash"].as_f64()?])
        })
        .collect();
    let beats = |a: [f64; 3], b: [f64; 3]| a != b && (0..3).all(|k| a[k] <= b[k]);
    for (row, of) in rows(trade).iter().zip(&all) {
        let is_beaten = of.is_none_or(|of| all.iter().flatten().any(|other| beats(*other, of)));
        if row["pareto"] == true {
            assert!(!is_beaten, "{row}");
        } else {
            let is_equal = of.is_some_and(|of| all.iter().filter(|o| **o == Some(of)).count() > 1);
            assert!(is_beaten || is_equal, "{row}");
        }
    }
}

#[test]
fn a_structure_that_an_open_mesh_does_not_allow_is_listed_with_its_reason() {
    let directory = scratch("trade_open");
    let mesh = directory.join("open.obj");
    fs::write(&mesh, "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\nf 1 2 3\nf 2 4 3\n").unwrap();
    let text = ok(["trade", arg(&mesh), "--points", "5"]);
    let reasons = text.split("not built\n").nth(1).expect("some are not built");
    assert!(reasons.contains("cut level") && reasons.contains("edge"), "{reasons}");
    assert!(text.lines().any(|line| line.trim_start().starts_with("sweep, 16 bits")), "{text}");
}

#[test]
fn limits_choose_a_setting_that_meets_them_or_name_the_nearest() {
    let directory = scratch("trade_limits");
    let (mesh, blob) = (directory.join("cube.obj"), directory.join("part.msw"));
    fs::write(&mesh, CUBE).unwrap();
    let build = ["build", arg(&mesh), "-o", arg(&blob)];
    let limits = ["--flash", "8K", "--ram", "4K", "--error", "0.01", "--cpu", "m4f:168MHz"];
    let text = ok([&build[..], &limits[..], &["--rate", "1kHz"]].concat());
    assert!(fs::metadata(&blob).unwrap().len() <= 8192);
    for wanted in ["chosen: ", "why: ", "ask with: Budget::EXACT", "second: "] {
        assert!(text.contains(wanted), "{wanted}: {text}");
    }
    // The blob, and the notes on it, are those of the options that the report names.
    let chosen = fs::read(&blob).unwrap();
    let typed = text.lines().find_map(|line| line.strip_prefix("  built: ")).expect("it says so");
    let again = ok([&build[..], &typed.split(' ').collect::<Vec<_>>()].concat());
    assert!(fs::read(&blob).unwrap() == chosen, "{typed}: other bytes");
    for note in again.lines().filter(|line| !line.starts_with("seconds")) {
        assert!(text.lines().any(|line| line == note), "{note:?} is missing in {text}");
    }
    fs::remove_file(&blob).unwrap();
    let small = run([&build[..], &["--flash", "500", "--error", "1e-9"]].concat());
    let said = refused(&small, 1, "cube.obj");
    assert!(said.contains("the nearest is") && said.contains("--error"), "{said}");
    assert!(!blob.exists());
    for wrong in [&["--flash", "8K", "--for", "hull"][..], &["--cpu", "m0:48MHz"]] {
        refused(&run([&build[..], wrong].concat()), 2, "--");
    }
}

#[test]
fn limits_choose_how_a_fence_is_asked_or_name_the_nearest() {
    let directory = scratch("trade_curve_limits");
    let (curve, blob) = (fixture("fence.csv"), directory.join("fence.msw"));
    let build = ["build", arg(&curve), "-o", arg(&blob)];
    let rate = ["--rate", "50Hz", "--cpu", "m0:48MHz", "--flash", "2K"];
    let text = ok([&build[..], &rate, &["--closed"]].concat());
    assert!(text.contains(", by Curve::signed_distance") && text.contains("of these sides"));
    let chosen = fs::read(&blob).unwrap();
    let typed = text.lines().find_map(|line| line.strip_prefix("  built: ")).expect("it says so");
    ok([&build[..], &typed.split(' ').collect::<Vec<_>>()].concat());
    assert!(fs::read(&blob).unwrap() == chosen && chosen.len() <= 2048, "{typed}");
    // A side that is undecided leaves the distance of either sign.
    let points = directory.join("points.csv");
    let few = ["--flash", "2K", "--error", "200", "--closed", "--at", arg(&points), "--json"];
    fs::write(&points, "30,10,0\n-20,60,0\n5,5,0\n70,40,0\n").unwrap();
    let told: Value = serde_json::from_str(&ok([&build[..], &few].concat())).unwrap();
    let chosen = &told["chosen"]["first"];
    let dials: Vec<&str> = chosen["dials"].as_str().unwrap().split(", ").collect();
    let steps = dials.iter().find_map(|dial| dial.strip_prefix("steps ")).unwrap_or("1000");
    let signed = ok(["signed", arg(&blob), arg(&points), "--steps", steps]);
    let header = signed.lines().next().unwrap().to_owned();
    let at = |name: &str| header.split(',').position(|of| of == name).expect("a column");
    let [lower, upper] = ["lower", "upper"].map(at);
    let answers = parse_csv(&signed, &header);
    let widths = answers.iter().map(|row| number(&row[upper]) - number(&row[lower]));
    let width = widths.fold(0.0, f64::max);
    assert!(
        (worst(chosen, "guaranteed").unwrap() - width).abs() <= 1e-6 * width,
        "{chosen} {width}"
    );
    // Without an area distances are asked, on a path by a search that is kept.
    let text = ok([&build[..], &["--flash", "2K", "--error", "9", "--at", "path"]].concat());
    assert!(!text.contains("signed") && text.contains("instructions of a Cortex-M4F"), "{text}");
    fs::remove_file(&blob).unwrap();
    let none = run([&build[..], &["--rate", "90MHz", "--cpu", "m4f:168MHz"]].concat());
    let said = refused(&none, 1, "fence.csv");
    assert!(said.contains("the nearest is curve") && !blob.exists(), "{said}");
    refused(&run([&build[..], &["--flash", "2K", "--for", "closest"]].concat()), 2, "--for");
}

#[test]
fn a_page_asks_for_nothing_and_its_intervals_hold_the_truth() {
    let directory = scratch("trade_report");
    // A name that would end the script, and begin a tag.
    let mesh = directory.join("<cube> & </script>.obj".replace('/', "\u{2215}"));
    fs::write(&mesh, CUBE).unwrap();
    let written = || {
        let page = directory.join("page.html");
        let text = ok(["trade", arg(&mesh), "--points", "20", "--report", arg(&page)]);
        assert!(text.contains("page.html"), "{text}");
        fs::read_to_string(page).unwrap()
    };
    let page = written();
    for address in ["src=", "href=", "http://", "https://", "@import", "url("] {
        assert!(!page.contains(address), "{address}");
    }
    assert!(page.contains("default-src 'none'") && !page.contains("<cube>"));
    let (_, rest) = page.split_once("id=\"data\">").unwrap();
    let (data, rest) = rest.split_once("</script>").unwrap();
    assert!(rest.contains("id=\"library\""), "nothing ends the data but their own end");
    let data: Value = serde_json::from_str(data).expect("it is JSON");
    assert_eq!(data["name"], mesh.file_name().unwrap().to_str().unwrap());
    for row in rows(&data["trade"]) {
        let Some(guaranteed) = worst(row, "guaranteed") else { continue };
        for of in ["found_lower", "found_upper"] {
            assert!(worst(row, of).unwrap() <= guaranteed * (1.0 + 1e-12), "{row}");
        }
    }
    let surface = triangles(&mesh);
    let list = |value: &Value| -> Vec<f64> { serde_json::from_value(value.clone()).unwrap() };
    let points: Vec<[f32; 3]> = serde_json::from_value(data["path"]["points"].clone()).unwrap();
    let truth: Vec<f64> = points.iter().map(|p| distance(wide(p), &surface)).collect();
    let settings = data["path"]["settings"].as_array().unwrap();
    assert!(settings.len() >= 4 && points.len() == 500);
    for setting in settings {
        let (lower, upper) = (list(&setting["lower"]), list(&setting["upper"]));
        for ((lower, upper), truth) in lower.iter().zip(&upper).zip(&truth) {
            let rounding = 1e-12 * truth;
            assert!(lower - rounding <= *truth && *truth <= upper + rounding, "{setting}");
        }
    }
    let keys = data["scene"]["bodies"].as_array().unwrap().iter().map(|body| &body["key"]);
    assert_eq!(keys.collect::<Vec<_>>(), ["mesh", "tight", "triboxes"]);
    // The same bytes but for the host's times.
    let without_times = |page: &str| {
        let parts = page.split("\"host_ns\":").enumerate();
        let rest = parts.map(|(i, part)| match i {
            0 => part.to_owned(),
            _ => part.trim_start_matches(|c: char| !",}".contains(c)).to_owned(),
        });
        rest.collect::<Vec<_>>().join("\"host_ns\":")
    };
    assert!(without_times(&page) == without_times(&written()), "two runs differ");
}

/// Poses of a mesh, up to some way off.
fn write_poses(file: &Path, count: u32) {
    let row = |i: u32| {
        let [x, y, turn] = [0.25 * f64::from(i), 0.5 * f64::from(i % 6), f64::from(i % 5)];
        format!("{x},{y},-1,1,{turn},0.5,0")
    };
    fs::write(file, (0..count).map(row).collect::<Vec<_>>().join("\n")).unwrap();
}

#[test]
fn structures_of_two_meshes_have_the_verdicts_of_clearance() {
    let directory = scratch("trade_pair");
    let (mesh, cube) = (coarse_torus(&directory), directory.join("cube.obj"));
    fs::write(&cube, CUBE).unwrap();
    let poses = directory.join("poses.csv");
    write_poses(&poses, 60);
    // Hulls of two tori would take twice as long.
    let pair = ["trade", arg(&mesh), arg(&cube), "--poses", arg(&poses), "--keep", "1.25"];
    let text = ok([&pair[..], &["--json", "--cpu", "m4f:168MHz"]].concat());
    let trade: Value = serde_json::from_str(&text).expect("it is JSON");
    let keeps = trade["clear"].as_u64().unwrap();
    assert!(trade["poses"] == 60 && (5..55).contains(&keeps), "{keeps}");
    let header = "pose,within,first,second,work";
    let mut told = 0;
    for row in rows(&trade) {
        let count = |of: &str| row[of].as_u64().expect("a count");
        let structure = row["structure"].as_str().unwrap();
        assert_eq!(count("clear") + count("false_alarms"), keeps + count("missed"), "{row}");
        if let Some(most) = row["at_most"].as_f64() {
            let [mean, time] = ["mean", "microseconds"].map(|of| row[of].as_f64().unwrap());
            assert!(mean <= most && (time - 2.0 * most / 168.0).abs() < 1e-6 * time, "{row}");
        } else {
            assert_eq!(structure, "box trees, 32 bits");
        }
        let build: Vec<&str> = row["build"].as_str().unwrap().split(' ').collect();
        let blobs = ["first.msw", "second.msw"].map(|name| directory.join(name));
        for (of, (mesh, blob)) in [&mesh, &cube].into_iter().zip(&blobs).enumerate() {
            ok([&["build", arg(mesh), "-o", arg(blob)], &build[..]].concat());
            assert_eq!(row["flash"][of], fs::metadata(blob).unwrap().len());
        }
        if structure.starts_with("tight") {
            continue;
        }
        let files = [
            "clearance",
            arg(&blobs[0]),
            arg(&blobs[1]),
            "--pose",
            arg(&poses),
            "--within",
            "1.25",
        ];
        let engine: &[&str] = if structure.starts_with("tri") { &["--triboxes"] } else { &[] };
        let answers = parse_csv(&ok([&files[..], engine].concat()), header);
        let of = |verdict: &str| answers.iter().filter(|row| row[1] == verdict).count() as u64;
        assert_eq!((of("no"), of("undecided")), (count("clear"), count("undecided")), "{row}");
        assert_eq!(count("missed"), 0, "{row}");
        told += 1;
    }
    assert_eq!(told, 4);
    // Of the rows within the limits none has fewer alarms, and of as many none fewer instructions.
    let limited =
        |limits: &[&str]| run([&pair[..], &["--json", "--cpu", "m4f:168MHz"], limits].concat());
    let flash = |row: &Value| row["flash"][0].as_u64().unwrap() + row["flash"][1].as_u64().unwrap();
    for (limit, of) in [(3000, "--flash"), (1 << 30, "--flash"), (900, "--rate")] {
        let told = limited(&[of, &limit.to_string()]);
        assert!(told.status.success());
        let trade: Value = serde_json::from_slice(&told.stdout).expect("it is JSON");
        let is_met = |row: &Value| match of {
            "--flash" => flash(row) <= limit,
            _ => row["microseconds"].as_f64().is_some_and(|time| time * limit as f64 <= 1e6),
        };
        let key = |row: &Value| {
            (row["false_alarms"].as_u64().unwrap(), row["mean"].as_f64().unwrap_or(f64::INFINITY))
        };
        let meeting = || rows(&trade).iter().filter(|row| row["missed"] == 0 && is_met(row));
        let named = |of: &str| meeting().find(|row| row["structure"] == trade["chosen"][of]);
        let first = named("first").expect("the first meets the limits");
        assert!(meeting().all(|row| key(first) <= key(row)), "{trade}");
        let costs = |row: &Value| {
            let scratch = row["scratch_bytes"].as_f64().unwrap();
            [key(row).1, flash(row) as f64, scratch]
        };
        let has_less = |row: &&Value| costs(row).into_iter().zip(costs(first)).any(|(a, b)| a < b);
        let others = || meeting().filter(|row| *row != first).filter(has_less);
        assert_eq!(named("second").is_some(), others().count() > 0);
        assert!(named("second").is_none_or(|second| others().all(|row| key(second) <= key(row))));
    }
    let said = refused(&limited(&["--rate", "100MHz"]), 1, "no structure meets");
    assert!(said.contains("--rate") && said.contains("cube.obj"), "{said}");
    // Every structure has a stack, with a cost or without.
    let told = limited(&["--ram", "8K"]);
    let trade: Value = serde_json::from_slice(&told.stdout).expect("it is JSON");
    for row in rows(&trade) {
        let ram = row["scratch_bytes"].as_u64().unwrap() + row["stack"][0].as_u64().unwrap();
        assert!(row["stack"][0].as_u64() > Some(1000), "{row}");
        assert!(trade["chosen"]["first"] != row["structure"] || ram <= 8192, "{row}");
    }
    assert!(told.status.success() || trade["unmet"].as_str().is_some_and(|s| s.contains("--ram")));
    // Where no pose keeps the distance, no structure is better than another.
    let inside = ["trade", arg(&mesh), arg(&cube), "--poses", "0,0,0,1,0,0,0", "--keep", "9"];
    refused(&run([&inside[..], &["--flash", "1M"]].concat()), 1, "no pose keeps");
    // The words depend on no mesh.
    let pair = ["trade", arg(&cube), arg(&cube), "--poses", arg(&poses), "--keep", "1.25"];
    let text = ok([&pair[..], &["--flash", "1M"]].concat());
    assert_eq!(text.matches("  meshsweep build ").count(), 2, "{text}");
    let text = ok([&pair[..], &["--cpu", "m0:48MHz"]].concat());
    assert!(text.contains("Cortex-M0") && text.contains("triboxes, 8 "), "{text}");
    let has_times = |text: &str| text.lines().any(|line| line.contains(" at most        us "));
    assert!(has_times(&text) && !has_times(&ok(pair)), "{text}");
}

#[test]
fn a_distance_to_keep_has_the_unit_that_it_names() {
    let directory = scratch("trade_keep");
    let mesh = directory.join("cube.obj");
    fs::write(&mesh, CUBE).unwrap();
    let keep = |keep: &str, unit: &[&str]| {
        let pair = ["trade", arg(&mesh), arg(&mesh), "--poses", "3,0,0,1,0,0,0", "--keep", keep];
        let text = ok([&pair[..], &["--json"], unit].concat());
        let trade: Value = serde_json::from_str(&text).expect("it is JSON");
        (trade["keep"].as_f64().unwrap(), trade["clear"].as_u64().unwrap())
    };
    assert_eq!(keep("1.5", &[]), (1.5, 1));
    assert_eq!(keep("2.5mm", &[]), (2.5, 0));
    assert_eq!(keep("15mm", &["--unit", "cm"]), (1.5, 1));
    for wrong in ["0", "-1", "15kg", "mm", "nan"] {
        let output = run(["trade", arg(&mesh), arg(&mesh), "--poses", "0,0,0,1,0,0,0", "--keep"]
            .into_iter()
            .chain([wrong]));
        assert_eq!(output.status.code(), Some(2), "{wrong}");
    }
    let alone = run(["trade", arg(&mesh), arg(&mesh), "--keep", "1"]);
    assert_eq!(alone.status.code(), Some(2));
    refused(&run(["trade", arg(&mesh), "--cpu", "m4f:168MHz"]), 2, "--cpu");
    refused(&run(["trade", arg(&mesh), "--flash", "4K"]), 2, "meshsweep build");
}

/// Distance of a point from the segments of closed polylines, in `D` dimensions.
fn from_polylines<const D: usize>(point: &[f32], polylines: &[Vec<[f64; 3]>]) -> f64 {
    let difference =
        |a: &[f64; 3], b: &[f64; 3]| -> [f64; D] { std::array::from_fn(|k| a[k] - b[k]) };
    let dot = |a: [f64; D], b: [f64; D]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let p = [0, 1, 2].map(|k| f64::from(point[k]));
    let mut least = f64::INFINITY;
    for points in polylines {
        for (k, a) in points.iter().enumerate() {
            let (along, to) = (difference(&points[(k + 1) % points.len()], a), difference(&p, a));
            let t = (dot(along, to) / dot(along, along).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
            let off: [f64; D] = std::array::from_fn(|k| to[k] - t * along[k]);
            least = least.min(dot(off, off).sqrt());
        }
    }
    least
}

#[test]
fn rows_of_a_fence_are_those_of_the_blob_that_they_name() {
    let directory = scratch("trade_fence");
    let (file, points) = (directory.join("fence.csv"), directory.join("points.csv"));
    let ring = |count: u32, middle: [f64; 2], radius: f64| -> Vec<[f64; 3]> {
        let turn = |k| f64::from(k) * std::f64::consts::TAU / f64::from(count);
        let wide = |k: u32| radius * (1.0 + 0.2 * f64::from(k % 3));
        let at =
            |k| [middle[0] + wide(k) * turn(k).cos(), middle[1] + wide(k) * turn(k).sin(), 0.0];
        (0..count).map(at).collect()
    };
    let polylines = [ring(90, [0.0, 0.0], 40.0), ring(17, [5.0, 3.0], 6.0)];
    let lines = polylines
        .iter()
        .map(|points| points.iter().map(|[x, y, z]| format!("{x},{y},{z}\n")).collect::<String>());
    fs::write(&file, lines.collect::<Vec<_>>().join("\n")).unwrap();
    let mut queries: Vec<[f32; 3]> = Vec::new();
    for k in 0..60 {
        let turn = 0.7 * k as f32;
        let out = 1.1 * k as f32;
        queries.push([out * turn.cos(), out * turn.sin(), if k % 4 == 0 { 3.0 } else { 0.0 }]);
    }
    write_csv(&points, &queries);
    let trade = measured(&file, &["--closed", "--at", arg(&points)]);
    assert_eq!((&trade["points"], &trade["segments"]), (&60.into(), &107.into()));
    let find = |dials: &str| {
        let is = |row: &&Value| row["structure"] == "curve, 16 bits" && row["dials"] == dials;
        rows(&trade).iter().find(is).unwrap_or_else(|| panic!("no row {dials}"))
    };
    for row in rows(&trade) {
        let is_verdict = row["dials"].as_str().is_some_and(|dials| dials.starts_with("within"));
        assert_eq!(row["guaranteed"].is_null(), is_verdict, "{row}");
        for of in ["found_lower", "found_upper"].into_iter().filter(|_| !is_verdict) {
            let found = worst(row, of).expect("it is measured");
            assert!(found <= worst(row, "guaranteed").unwrap() * (1.0 + 1e-12), "{row}");
        }
    }
    let blob = directory.join("fence.msw");
    let build: Vec<&str> = find("exact")["build"].as_str().unwrap().split(' ').collect();
    ok([&["build", arg(&file), "--closed", "-o", arg(&blob)], &build[..]].concat());
    assert_eq!(fs::metadata(&blob).unwrap().len(), find("exact")["flash"].as_u64().unwrap());
    let closest = "x,y,z,lower,upper,px,py,pz,polyline,segment,safe_motion,work";
    // With more memory than suffices the program searches in another order.
    let entries = find("exact")["scratch_bytes"].as_u64().unwrap() / 8;
    let entries = ["--scratch".to_owned(), entries.to_string()];
    let entries = entries.each_ref().map(String::as_str);
    for (dials, options) in
        [("exact", [].as_slice()), ("rel 0.1", &["--rel", "0.1"]), ("steps 4", &["--steps", "4"])]
    {
        let row = find(dials);
        let answers = ok([&["closest", arg(&blob), arg(&points)], options, &entries].concat());
        let (mut width, mut low, mut work) = (0f64, 0f64, 0f64);
        for (answer, query) in parse_csv(&answers, closest).iter().zip(&queries) {
            let [lower, upper] = [number(&answer[3]), number(&answer[4])];
            width = width.max(upper - lower);
            low = low.max(from_polylines::<3>(query, &polylines) - lower);
            work += number(&answer[11]) / 60.0;
        }
        let guaranteed = worst(row, "guaranteed").unwrap();
        assert!((guaranteed - width).abs() <= 1e-12 * width, "{dials}: {guaranteed} {width}");
        assert!((worst(row, "found_lower").unwrap() - low).abs() < 1e-6, "{dials}: {low}");
        let told = row["work"].as_object().unwrap().values().map(|x| x.as_f64().unwrap());
        assert!((told.sum::<f64>() - work).abs() < 1e-6, "{dials}: {work}");
        // The costliest query that was found costs what it says, and more than a mean one.
        let of = &row["worst"];
        let query: Vec<String> =
            of["query"].as_array().unwrap().iter().map(|x| x.to_string()).collect();
        let answers = ok([&["closest", arg(&blob), &query.join(",")], options, &entries].concat());
        let found = number(&parse_csv(&answers, closest)[0][11]);
        assert_eq!(Some(found), of["work"].as_f64(), "{dials}");
        assert!(found >= work - 1e-6, "{dials}: {found} {work}");
    }
    let undecided =
        |answers: &str| answers.lines().filter(|line| line.contains("undecided")).count();
    let in_plane = directory.join("plane.csv");
    write_csv(&in_plane, &queries.iter().map(|&[x, y, _]| [x, y]).collect::<Vec<_>>());
    let asked = ["signed", arg(&blob), arg(&in_plane), "--steps", "4"];
    let signed = ok([&asked[..], &entries].concat());
    assert_eq!(find("signed, steps 4")["undecided"], undecided(&signed));
    assert!(undecided(&signed) > 0, "{signed}");
    let flat = |query: &[f32; 3]| from_polylines::<2>(query, &polylines);
    let (mut low, mut queries) = (0f64, queries.iter());
    for line in ok(["signed", arg(&blob), arg(&in_plane)]).lines().skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        let ends = [number(fields[4]), number(fields[5])];
        let lower = if ends[0] * ends[1] < 0.0 { 0.0 } else { ends[0].abs().min(ends[1].abs()) };
        low = low.max(flat(queries.next().unwrap()) - lower);
    }
    assert!((worst(find("signed, exact"), "found_lower").unwrap() - low).abs() < 1e-6, "{low}");
    let dials = |row: &&Value| {
        let dials = row["dials"].as_str().unwrap();
        dials.starts_with("within") && dials.ends_with("steps 4")
    };
    for row in rows(&trade).iter().filter(dials) {
        let dials = row["dials"].as_str().unwrap();
        let distance = dials.split([' ', ',']).nth(1).unwrap();
        let within = ["within", arg(&blob), arg(&points), "--distance", distance, "--steps", "4"];
        let answers = ok([&within[..], &entries].concat());
        assert_eq!(row["undecided"], undecided(&answers), "{dials}");
    }
    // Kept searches are among the rows of points in their order; they have no worst query.
    assert!(find("coherent")["worst"].is_null());
    let line = refused(&run(["trade", arg(&file), "--for", "segment"]), 2, "segment");
    assert!(line.contains("meshes"), "{line}");
    let mesh = coarse_torus(&directory);
    refused(&run(["trade", arg(&mesh), "--closed"]), 2, "--closed");
}
