//! `meshsweep worst`: it finds costlier queries than chance does, and they cost what it says.

use crate::support::{arg, blob, fixture, number, ok, parse_csv, random_queries, refused, run};
use crate::support::{scratch, triangles, write_csv};
use serde_json::Value;

fn worst(blob: &std::path::Path, more: &[&str]) -> Vec<Value> {
    let args = [&["worst", arg(blob), "--json", "--starts", "6"], more].concat();
    let report: Value = serde_json::from_str(&ok(args)).expect("JSON");
    report["worst"].as_array().expect("a list").clone()
}

fn sum(row: &Value) -> f64 {
    let count = |name: &str| row[name].as_f64().expect("a count");
    count("opened") + count("bounds") + count("triangles") + count("exact")
}

/// The query as an argument of the program.
fn typed(row: &Value) -> String {
    let numbers = row["query"].as_array().expect("numbers").iter();
    numbers
        .map(|x| (x.as_f64().expect("a number") as f32).to_string())
        .collect::<Vec<_>>()
        .join(",")
}

#[test]
fn the_costliest_query_costs_what_is_said_and_more_than_random_ones() {
    let directory = scratch("worst");
    let blob = blob(&directory, "bracket.stl", &["--for", "closest,segment"]);
    let rows = worst(&blob, &[]);
    let questions: Vec<_> = rows.iter().map(|row| row["question"].as_str().unwrap()).collect();
    assert_eq!(questions, ["closest", "within", "signed", "segment"]);
    // One step budget that no query reaches keeps `closest` from sharing work between queries.
    for (row, question) in [(&rows[0], "closest"), (&rows[3], "segment")] {
        let text = ok([question, arg(&blob), &typed(row), "--steps", "1000000"]);
        let work = text.lines().nth(1).unwrap().rsplit(',').next().unwrap();
        assert_eq!(work.parse(), Ok(sum(row)), "{question}");
        let [costliest, mean] =
            ["value", "mean_of_random_queries"].map(|of| row[of].as_f64().expect("a number"));
        assert!(costliest > 2.0 * mean, "{row}");
    }
    let points = directory.join("p.csv");
    write_csv(&points, &random_queries::<3>(&triangles(&fixture("bracket.stl")), 200));
    let text = ok(["closest", arg(&blob), arg(&points), "--steps", "1000000"]);
    for answer in parse_csv(&text, "x,y,z,lower,upper,px,py,pz,triangle,work") {
        assert!(number(&answer[9]) <= sum(&rows[0]));
    }
}

#[test]
fn the_widest_interval_within_a_step_budget_is_wider_than_those_of_random_points() {
    let directory = scratch("worst_steps");
    let blob = blob(&directory, "bracket.stl", &["--for", "closest,segment"]);
    let rows = worst(&blob, &["--ask", "closest", "--steps", "4"]);
    let widest = rows.iter().find(|row| row["greatest"] == "width").expect("a row of widths");
    assert!(rows.iter().all(|row| row["opened"].as_f64().unwrap() <= 4.0));
    let points = directory.join("p.csv");
    write_csv(&points, &random_queries::<3>(&triangles(&fixture("bracket.stl")), 200));
    let text = ok(["closest", arg(&blob), arg(&points), "--steps", "4"]);
    for answer in parse_csv(&text, "x,y,z,lower,upper,px,py,pz,triangle,work") {
        let width = number(&answer[4]) - number(&answer[3]);
        assert!(width <= widest["width"].as_f64().unwrap() * (1.0 + 1e-6));
    }
}

#[test]
fn the_costliest_pose_of_a_second_mesh_costs_what_is_said_and_stays_within_steps() {
    let directory = scratch("worst_pair");
    let [first, second] =
        ["bracket.stl", "torus.ply"].map(|name| blob(&directory, name, &["--for", "segment"]));
    let second = arg(&second);
    for within in [&[][..], &["--within", "2"]] {
        for steps in [&[][..], &["--steps", "20"]] {
            let rows = worst(&first, &[&[second], within, steps].concat());
            for row in &rows {
                let pose = typed(row);
                let command = ["clearance", arg(&first), second, "--pose", &pose];
                let text = ok([&command[..], within, steps].concat());
                let work = text.lines().nth(1).unwrap().rsplit(',').next().unwrap();
                assert_eq!(work.parse(), Ok(sum(row)), "{row}");
                let limit = if steps.is_empty() { f64::INFINITY } else { 20.0 };
                assert!(row["opened"].as_f64().unwrap() <= limit, "{row}");
            }
            let [costliest, mean] = ["value", "mean_of_random_queries"]
                .map(|of| rows[0][of].as_f64().expect("a number"));
            assert!(costliest > 2.0 * mean, "{rows:?}");
            let has_widest = within.is_empty() && !steps.is_empty();
            assert_eq!(rows.iter().any(|row| row["greatest"] == "width"), has_widest);
        }
    }
}

#[test]
fn a_blob_without_such_questions_is_refused_with_those_it_serves() {
    let directory = scratch("worst_refused");
    let blob = blob(&directory, "torus.ply", &["--for", "triboxes", "--triboxes", "2"]);
    let line = refused(&run(["worst", arg(&blob)]), 1, "torus");
    assert!(
        line.contains(
            "serves closest --triboxes, within --triboxes, segment --triboxes, \
             overlap --triboxes, clearance --triboxes"
        ) && line.contains("searches closest"),
        "{line}"
    );
}
