//! Curves that costs are fitted to, curves that test the fit, and the questions about them.

use meshsweep::builder::{Builder, Recipe};
use meshsweep::curve::Polyline;
use meshsweep::surface::VertexBits;
use meshsweep::trade::{Points, Search, diagonal_of_curves, points_of_curves};
use meshsweep_core::{Blob, Budget};
use meshsweep_suite::ask::placed::Question;

use crate::generate::curves::{circle, closed, fence, open, spiral, tool_path, walk, zig_zag};

/// A question about curves, and what is told of it.
pub(super) struct OfCurves {
    /// Whether it is fitted or tested.
    pub role: &'static str,
    pub name: &'static str,
    pub search: Search,
    pub blob: Vec<u8>,
    pub question: Question,
    pub budget: Budget,
    pub places: Vec<[f32; 3]>,
    /// The kind of points, and the distance that is asked about.
    pub at: String,
}

/// All questions about all curves. A kept search has 512 entries, which suffice for these.
pub(super) fn questions(queries: usize) -> Result<Vec<OfCurves>, String> {
    let mut all = Vec::new();
    for (role, name, polylines) in subjects() {
        let recipe = Recipe::Curve(VertexBits::Grid16);
        let built = Builder::of(recipe).build_curves(&polylines);
        let blob = built.map_err(|error| error.to_string())?.into_bytes();
        let opened = Blob::open(&blob).map_err(|error| error.to_string())?;
        let curve = opened.curve().map_err(|error| error.to_string())?;
        let is_fence = curve.check_fence().is_ok();
        let diagonal = diagonal_of_curves(&polylines);
        for (search, kind, budget, question) in asked(diagonal, is_fence) {
            let at = match question {
                Question::CurveWithin(distance, _) => {
                    format!("{} within {distance:.3}", kind.name())
                }
                _ => kind.name().to_owned(),
            };
            let places = points_of_curves(&polylines, kind, queries);
            let blob = blob.clone();
            all.push(OfCurves { role, name, search, blob, question, budget, places, at });
        }
    }
    Ok(all)
}

fn subjects() -> [(&'static str, &'static str, Vec<Polyline>); 11] {
    let flat =
        |polyline: Polyline| closed(polyline.points.iter().map(|&[x, y, _]| [x, y, 0.0]).collect());
    let shorter = |polyline: Polyline| open(polyline.points.into_iter().step_by(3).collect());
    [
        ("fit", "fence", fence()),
        ("fit", "walk 400", vec![walk(400, 1)]),
        ("fit", "spiral 400", vec![spiral(400)]),
        ("fit", "zig-zag 200", vec![zig_zag(200)]),
        ("fit", "circle 60", vec![circle(60)]),
        ("fit", "closed walk 300", vec![flat(walk(300, 4))]),
        ("test", "tool path 400", vec![tool_path(400)]),
        ("test", "circle 200", vec![circle(200)]),
        ("test", "closed walk 450", vec![flat(walk(450, 7))]),
        ("test", "closed spiral 250", vec![flat(spiral(250))]),
        ("test", "third of a walk", vec![shorter(walk(300, 9))]),
    ]
}

fn asked(diagonal: f64, is_fence: bool) -> Vec<(Search, Points, Budget, Question)> {
    use Points::{Far, Near, Path};
    let exact = Budget::EXACT;
    let (loose, brief) = (exact.with_relative(0.1), exact.with_steps(8));
    let absolute = exact.with_absolute((0.01 * diagonal) as f32);
    let mut all = Vec::new();
    let closest = [(Far, exact), (Near, exact), (Near, absolute), (Far, loose), (Near, brief)];
    all.extend(closest.map(|(kind, b)| (Search::Curve, kind, b, Question::Curve(b))));
    let kept = [(Path, exact), (Near, exact), (Path, loose), (Path, brief)];
    all.extend(kept.map(|(kind, b)| (Search::KeptCurve, kind, b, Question::KeptCurve(b))));
    let within =
        [(Near, 0.003, exact), (Near, 0.03, exact), (Far, 0.1, exact), (Near, 0.03, brief)];
    all.extend(within.map(|(kind, part, b)| {
        let question = Question::CurveWithin((part * diagonal) as f32, b.steps);
        (Search::CurveWithin, kind, b, question)
    }));
    if is_fence {
        all.extend(
            closest.map(|(kind, b)| (Search::CurveSigned, kind, b, Question::CurveSigned(b))),
        );
    }
    all
}
