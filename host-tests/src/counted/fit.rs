//! Questions that the costs of `meshsweep trade` are fitted to, and those that test the fit.

use std::fmt::Write as _;
use std::path::Path;

use glam::Vec3;
use meshsweep::builder::{Built, Recipe};
use meshsweep::load::Source;
use meshsweep::mesh::{RawMesh, repair};
use meshsweep::surface::VertexBits;
use meshsweep::trade::{self, Search, Shape, features_of_pair};
use meshsweep_core::{Blob, Budget, QueryError, Work};
use meshsweep_counted::placed::{answers, expected};
use meshsweep_suite::ask::placed::{Answer, Question};

use super::fit_curves::{OfCurves, questions as questions_of_curves};
use super::placed::written;
use crate::generate::{
    Rng, Triangles, cube, needle_comb, rough_sphere, torus, two_parts, uv_sphere,
};
use crate::workload::pose::{Pose, sphere};
use crate::workload::{Points, Subject, points};

/// Queries of a question.
const QUERIES: usize = 200;

/// Writes the questions of all meshes to `NUMBER.bin` of a folder, with the features of each query
/// in `NUMBER.rows` and the answers of this machine in `NUMBER.expected`. `others` are mesh files
/// that are tested only. Returns a line for each question: its search, whether it is fitted or
/// tested, the mesh, and the question's dials, with tabs between them.
///
/// # Errors
/// A fixture that is missing, a mesh file that is refused, or a folder that cannot be written.
pub fn fit(fixtures: &Path, folder: &Path, others: &[&str]) -> Result<String, String> {
    std::fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let (mut lines, mut number) = (String::new(), 0);
    let subjects = subjects(fixtures, others)?;
    for (at, (role, subject)) in subjects.iter().enumerate() {
        for search in Search::ALL {
            let Some(bytes) = built(subject, search) else { continue };
            let mut all = asked(subject, search);
            if let Some(apart) = apart_of(search) {
                let (_, next) = &subjects[(at + 1) % subjects.len()];
                all = pairs(subject, &bytes, apart, "its copy");
                let small = beside(next, subject);
                if let Some(other) = built(&small, search) {
                    all.extend(pairs(subject, &other, apart, &next.name));
                }
            }
            for Asked { question, budget, other, places, dials } in all {
                let laid = written(question, &bytes, &other, &places);
                keep(folder, number, &laid, &rows(&laid, &bytes, search, budget)?)?;
                let _ = writeln!(lines, "{search:?}\t{role}\t{}\t{dials}", subject.name);
                number += 1;
            }
        }
    }
    for OfCurves { role, name, search, blob, question, budget, places, at } in
        questions_of_curves(QUERIES)?
    {
        let laid = written(question, &blob, &[], &places);
        keep(folder, number, &laid, &rows(&laid, &blob, search, budget)?)?;
        let _ = writeln!(lines, "{search:?}\t{role}\t{name}\t{at} {}", dials(budget));
        number += 1;
    }
    Ok(lines)
}

/// Writes the files of a question.
fn keep(folder: &Path, number: usize, laid: &[u8], rows: &str) -> Result<(), String> {
    let expected = expected(laid, QUERIES)?;
    let all = [("bin", laid), ("rows", rows.as_bytes()), ("expected", expected.as_bytes())];
    for (ending, bytes) in all {
        let file = folder.join(format!("{number}.{ending}"));
        let failed = |error| format!("{}: {error}", file.display());
        std::fs::write(&file, bytes).map_err(failed)?;
    }
    Ok(())
}

/// Meshes to fit to, then meshes to test on.
fn subjects(fixtures: &Path, others: &[&str]) -> Result<Vec<(&'static str, Subject)>, String> {
    let load = |name: &str| Subject::load(&fixtures.join(name));
    let made = |name: &str, (positions, triangles): Triangles| {
        let raw = RawMesh::from_f32(&positions, &triangles);
        let (mesh, _) = repair(raw).map_err(|error| error.to_string())?;
        Ok::<_, String>(Subject::of(name, mesh))
    };
    let mut all = vec![
        ("fit", load("bracket.stl")?),
        ("fit", load("groove.obj")?),
        ("fit", load("torus.ply")?),
        ("fit", made("rough sphere 4, 0.05", rough_sphere(4, 0.05, 1))?),
        ("fit", made("sphere 40x20", uv_sphere(40, 20))?),
        ("fit", made("torus 120x60", torus(2.0, 0.75, 120, 60))?),
        ("fit", made("cube 5", cube(5))?),
        ("fit", made("rough sphere 3, 0.2", rough_sphere(3, 0.2, 7))?),
        ("test", made("cube 12", cube(12))?),
        ("test", made("rough sphere 3, 0.3", rough_sphere(3, 0.3, 9))?),
        ("test", made("rough sphere 5, 0.02", rough_sphere(5, 0.02, 3))?),
        ("test", made("torus 80x30", torus(3.0, 0.5, 80, 30))?),
        ("needles", made("needle comb", needle_comb())?),
        ("test", made("two parts", two_parts())?),
    ];
    for other in others {
        all.push(("other", Subject::load_any(Path::new(other))?));
    }
    Ok(all)
}

fn built(subject: &Subject, search: Search) -> Option<Vec<u8>> {
    let triangles: Vec<[u32; 3]> = subject.mesh.all_triangles().collect();
    let raw = RawMesh::from_f32(&subject.mesh.positions, &triangles);
    let recipe = match search {
        Search::Tree | Search::Hinted | Search::Coherent => Recipe::Tree(VertexBits::Grid16),
        Search::TreeF32 | Search::Precise => Recipe::Tree(VertexBits::F32),
        Search::PairOfTrees | Search::FirstHit => Recipe::SegmentTree(VertexBits::Grid16),
        Search::FirstHitF32 => Recipe::SegmentTree(VertexBits::F32),
        Search::Sweep | Search::KeptSweep | Search::FirstHitOfHull => {
            Recipe::Sweep(VertexBits::F32)
        }
        Search::OuterHit => Recipe::Hull(VertexBits::F32),
        Search::Tight => Recipe::Tight(200),
        Search::Triboxes | Search::PairOfTriboxes => Recipe::Triboxes(64),
        Search::Field
        | Search::FieldTree
        | Search::Curve
        | Search::KeptCurve
        | Search::CurveWithin
        | Search::CurveSigned => return None,
    };
    let source = Source::of(raw, None).ok()?;
    let built = trade::build(recipe, &source, &source.repaired().ok()?);
    built.ok().map(Built::into_bytes)
}

/// A question at its places.
struct Asked {
    question: Question,
    budget: Budget,
    /// The blob of the model that moves; of a question about one model, no bytes.
    other: Vec<u8>,
    places: Vec<[f32; 3]>,
    dials: String,
}

/// Questions about one model.
fn asked(subject: &Subject, search: Search) -> Vec<Asked> {
    let at = |(kind, budget): (Points, Budget)| Asked {
        question: question(search, budget),
        budget,
        other: Vec::new(),
        places: places(subject, search, kind),
        dials: format!("{} {}", kind.name(), dials(budget)),
    };
    questions(search, subject.diagonal()).into_iter().map(at).collect()
}

/// Points, or the ends of segments.
fn places(subject: &Subject, search: Search, kind: Points) -> Vec<[f32; 3]> {
    match search {
        Search::FirstHit | Search::FirstHitF32 | Search::FirstHitOfHull | Search::OuterHit => {
            trade::segments(&subject.mesh, kind, QUERIES)
        }
        _ => points(subject, kind, QUERIES),
    }
}

/// The question about two models, by its distance.
fn apart_of(search: Search) -> Option<fn(f32) -> Question> {
    match search {
        Search::PairOfTrees => Some(Question::PairOfTrees),
        Search::PairOfTriboxes => Some(Question::PairOfTriboxes),
        _ => None,
    }
}

/// Questions about a model and the one of the blob `other`, which moves.
fn pairs(subject: &Subject, other: &[u8], apart: fn(f32) -> Question, name: &str) -> Vec<Asked> {
    let at = |part: f64| Asked {
        question: apart((part * subject.diagonal()) as f32),
        budget: Budget::EXACT,
        other: other.to_vec(),
        places: poses(subject),
        dials: format!("{name}, {part} diagonals"),
    };
    [0.01, 0.05, 0.2].map(at).into()
}

/// The mesh of `other`, half as large as `subject` and in its middle.
fn beside(other: &Subject, subject: &Subject) -> Subject {
    let [from, to] = [other, subject].map(|of| {
        let [low, high] = of.bounds.map(Vec3::from_array);
        (low + high) / 2.0
    });
    let scale = (0.5 * subject.diagonal() / other.diagonal()) as f32;
    let mut mesh = other.mesh.clone();
    for place in &mut mesh.positions {
        *place = (to + (Vec3::from_array(*place) - from) * scale).to_array();
    }
    Subject::of(&other.name, mesh)
}

/// Poses up to two diagonals away: the rows of each matrix, then its translation.
fn poses(subject: &Subject) -> Vec<[f32; 3]> {
    let (mut rng, sphere) = (Rng::new(0x7061_6972), sphere(subject));
    let mut place = || {
        let pose = Pose::random(&mut rng, &sphere, 4.0).rounded();
        let [a, b, c] = pose.rotation;
        [a, b, c, pose.translation]
    };
    (0..QUERIES).flat_map(|_| place()).collect()
}

fn questions(search: Search, diagonal: f64) -> Vec<(Points, Budget)> {
    use Points::{Far, Near, Path};
    let exact = Budget::EXACT;
    let steps = |steps: u32| exact.with_steps(steps);
    match search {
        Search::Tree | Search::TreeF32 => vec![
            (Far, exact),
            (Near, exact),
            (Near, exact.with_relative(0.01)),
            (Far, exact.with_relative(0.1)),
            (Near, exact.with_absolute((0.01 * diagonal) as f32)),
            (Near, steps(4)),
            (Far, steps(8)),
            (Near, steps(16)),
        ],
        Search::Sweep => vec![
            (Far, exact),
            (Near, exact),
            (Near, exact.with_relative(0.01)),
            (Far, exact.with_relative(0.1)),
            (Far, steps(32)),
            (Near, steps(64)),
        ],
        Search::KeptSweep => vec![(Path, exact), (Path, exact.with_relative(0.1)), (Near, exact)],
        Search::Coherent => vec![(Path, exact), (Near, exact)],
        Search::Hinted | Search::Precise | Search::Triboxes => {
            vec![(Far, exact), (Near, exact), (Path, exact)]
        }
        Search::FirstHit | Search::FirstHitF32 => {
            vec![(Far, exact), (Near, exact), (Path, exact), (Far, steps(8))]
        }
        Search::FirstHitOfHull => {
            vec![(Far, exact), (Near, exact), (Path, exact), (Far, steps(32))]
        }
        // The others start in the hull's box.
        Search::OuterHit => vec![(Far, exact)],
        // Questions about two models are listed apart, and so are those about curves.
        Search::PairOfTrees
        | Search::PairOfTriboxes
        | Search::Field
        | Search::FieldTree
        | Search::Curve
        | Search::KeptCurve
        | Search::CurveWithin
        | Search::CurveSigned => Vec::new(),
        Search::Tight => vec![(Far, exact), (Near, exact), (Near, steps(8)), (Far, steps(4))],
    }
}

fn question(search: Search, budget: Budget) -> Question {
    match search {
        Search::Tree | Search::TreeF32 => Question::Tree(budget),
        Search::Precise => Question::Precise(budget),
        Search::Hinted => Question::Hinted(budget),
        Search::Coherent => Question::Coherent(budget),
        Search::Sweep => Question::Sweep(budget),
        Search::KeptSweep => Question::KeptSweep(budget),
        Search::Tight => Question::Tight(budget),
        Search::FirstHit | Search::FirstHitF32 => Question::FirstHit(budget),
        Search::FirstHitOfHull => Question::FirstHitOfHull(budget),
        Search::OuterHit => Question::OuterHit,
        Search::Field | Search::FieldTree => Question::Field,
        Search::Curve => Question::Curve(budget),
        Search::KeptCurve => Question::KeptCurve(budget),
        Search::CurveSigned => Question::CurveSigned(budget),
        Search::Triboxes | Search::PairOfTrees | Search::PairOfTriboxes | Search::CurveWithin => {
            Question::Triboxes(budget)
        }
    }
}

fn dials(budget: Budget) -> String {
    let Budget { relative, absolute, steps, .. } = budget;
    if relative > 0.0 {
        format!("rel {relative}")
    } else if absolute > 0.0 {
        "abs 1 %".to_owned()
    } else if steps < u32::MAX {
        format!("steps {steps}")
    } else {
        "exact".to_owned()
    }
}

/// The features of each query, a line each.
fn rows(laid: &[u8], blob: &[u8], search: Search, budget: Budget) -> Result<String, String> {
    let said = |error: QueryError| error.to_string();
    let blob = Blob::open(blob).map_err(|error| error.to_string())?;
    let shape = match search {
        Search::Sweep | Search::KeptSweep | Search::FirstHitOfHull | Search::OuterHit => {
            Shape::of_hull(&blob.hull().map_err(said)?)
        }
        Search::Tight => {
            let hulls = blob.tight_hulls().map_err(said)?;
            Shape::of_tight(&hulls.finest().ok_or("no hull")?)
        }
        Search::Triboxes | Search::PairOfTriboxes => {
            Shape::of_triboxes(&blob.triboxes().map_err(said)?)
        }
        Search::Curve | Search::KeptCurve | Search::CurveWithin | Search::CurveSigned => {
            Shape::of_curve(&blob.curve().map_err(said)?)
        }
        _ => Shape::of_tree(&blob.bvh().map_err(said)?),
    };
    let mut rows = String::new();
    answers(laid, QUERIES, |place, answer| {
        let work = match answer {
            Answer::Closest(near) => near.work,
            Answer::Bound(bound) => bound.work,
            Answer::Within(found) => found.work,
            Answer::Farther(found) => found.work,
            Answer::Hit(hit) => hit.work,
            Answer::Outer(outer) => outer.work,
            Answer::Curve(near) => near.work,
            Answer::OfCurve(found) => found.work,
            Answer::Fence(found) => found.closest.work,
            _ => Work::NONE,
        };
        let features = match search {
            Search::PairOfTrees | Search::PairOfTriboxes => features_of_pair(&work),
            _ => shape.features(place, &budget, &work),
        };
        let row = features.map(|x| x.to_string()).join(" ");
        let _ = writeln!(rows, "{row}");
    })?;
    Ok(rows)
}
