//! Questions of any blob at places in a row: closest points of the box tree and of sweeps on the
//! split tables, and a refined hull that follows a point.

use std::path::Path;

use glam::Vec3;
use meshsweep::mesh::Mesh;
use meshsweep_core::{Blob, Budget, Hull, ScratchEntry, Sdf, VertIdx};
use meshsweep_suite::ask::placed::{self, Question};

use crate::generate::Rng;
use crate::workload::{Points, Subject, points};

/// A step of the point that a refined hull follows, as a part of the diagonal.
const STEP: f32 = 1e-3;

/// The bytes of a question with `count` places, as a board reads them; `None` if the words are no
/// such question.
///
/// - `bvh BLOB RELATIVE`: closest points of the box tree, to a relative tolerance, at
///   [`Points::Far`].
/// - `sweep BLOB STEP RELATIVE`: the same of the hull hierarchy. With a step of 0 each query is a
///   fresh one, else one kept sweep moves from each point to the next by such a part of the
///   diagonal.
/// - `refine BLOB RADIUS ERROR`: updates for a ball that runs from vertex to vertex of the base
///   hull, by a thousandth of the diagonal each; radius and error are parts of the diagonal.
/// - `field BLOB`, `units BLOB`: the distance of a field at points within it, in input units and in
///   whole units. `beyond BLOB`: the first at points of the doubled box, seven in eight outside.
/// - `within BLOB PART`, `within-both BLOB PART`: whether the box tree, alone or with the field, is
///   within such a part of the diagonal, at points up to a tenth of it from the surface.
/// - `near BLOB RELATIVE`, `near-both BLOB RELATIVE`, `bounds-both BLOB RELATIVE`: closest points
///   of the box tree, alone or with the field, and bounds of the distance, at the same points.
///
/// # Errors
/// A blob that is missing or refused, or numbers that are none.
pub fn lay(fixtures: &Path, question: &str, count: usize) -> Option<Result<Vec<u8>, String>> {
    let words: Vec<&str> = question.split(' ').collect();
    let number = |word: &str| word.parse::<f32>().map_err(|_| format!("`{word}` is not a number"));
    let read =
        |blob| std::fs::read(fixtures.join(blob)).map_err(|error| format!("{blob}: {error}"));
    let laid = match *words.as_slice() {
        ["bvh", blob, relative] => read(blob).and_then(|bytes| {
            let bounds = of(&bytes, |blob| Ok(blob.bvh()?.bounds()))?;
            let budget = Budget::EXACT.with_relative(number(relative)?);
            Ok(written(Question::Tree(budget), &bytes, &[], &far(bounds, count)))
        }),
        ["sweep", blob, step, relative] => read(blob).and_then(|bytes| {
            let bounds = of(&bytes, |blob| Ok(blob.hull()?.bounds()))?;
            let step = number(step)? * diagonal(bounds);
            let budget = Budget::EXACT.with_relative(number(relative)?);
            let places = far(bounds, count.max(2));
            Ok(if step == 0.0 {
                written(Question::Sweep(budget), &bytes, &[], &places)
            } else {
                let places = walk(places.into_iter(), step, count);
                written(Question::KeptSweep(budget), &bytes, &[], &places)
            })
        }),
        ["refine", blob, radius, error] => read(blob).and_then(|bytes| {
            let hull = of(&bytes, Blob::hull)?;
            let diagonal = diagonal(hull.bounds());
            let part = |word| number(word).map(|part| part * diagonal);
            let question = Question::Refine(part(radius)?, part(error)?);
            Ok(written(question, &bytes, &[], &walk(along_base(&hull), STEP * diagonal, count)))
        }),
        ["field", blob] => read(blob).and_then(|bytes| {
            let field = of(&bytes, Blob::sdf)?;
            Ok(written(Question::Field, &bytes, &[], &in_field(&field, count)))
        }),
        ["beyond", blob] => read(blob).and_then(|bytes| {
            let bounds = of(&bytes, |blob| Ok(blob.sdf()?.bounds()))?;
            Ok(written(Question::Field, &bytes, &[], &far(bounds, count)))
        }),
        ["units", blob] => read(blob).and_then(|bytes| {
            let field = of(&bytes, Blob::sdf)?;
            let wholes = in_field(&field, count).into_iter().filter_map(|p| field.units_of(p).ok());
            let places: Vec<_> = wholes.map(|whole| whole.map(|x| x as f32)).collect();
            Ok(written(Question::FieldInUnits, &bytes, &[], &places))
        }),
        ["within" | "within-both", blob, part] => read(blob).and_then(|bytes| {
            let bounds = of(&bytes, |blob| Ok(blob.bvh()?.bounds()))?;
            let distance = number(part)? * diagonal(bounds);
            let question = match words.first() {
                Some(&"within") => Question::Within(distance),
                _ => Question::WithinOfBoth(distance),
            };
            Ok(written(question, &bytes, &[], &near(&bytes, count)?))
        }),
        ["near" | "near-both" | "bounds-both", blob, relative] => read(blob).and_then(|bytes| {
            let budget = Budget::EXACT.with_relative(number(relative)?);
            let question = match words.first() {
                Some(&"near") => Question::Tree(budget),
                Some(&"near-both") => Question::ClosestOfBoth(budget),
                _ => Question::BoundsOfBoth(budget),
            };
            Ok(written(question, &bytes, &[], &near(&bytes, count)?))
        }),
        _ => return None,
    };
    Some(laid)
}

/// What a blob has, as a result with text.
fn of<'t, T>(
    bytes: &'t [u8],
    has: impl FnOnce(&Blob<'t>) -> Result<T, meshsweep_core::QueryError>,
) -> Result<T, String> {
    let blob = Blob::open(bytes).map_err(|error| error.to_string())?;
    has(&blob).map_err(|error| error.to_string())
}

fn diagonal([least, greatest]: [[f32; 3]; 2]) -> f32 {
    Vec3::from_array(least).distance(Vec3::from_array(greatest))
}

fn far(bounds: [[f32; 3]; 2], count: usize) -> Vec<[f32; 3]> {
    let corners = Subject::of("box", Mesh::new(bounds.to_vec(), Vec::new()));
    points(&corners, Points::Far, count)
}

/// Points at most a tenth of the diagonal from the surface of a box tree.
fn near(bytes: &[u8], count: usize) -> Result<Vec<[f32; 3]>, String> {
    let tree = of(bytes, |blob| blob.bvh())?;
    let bounds = tree.bounds();
    let mut stack = vec![ScratchEntry::EMPTY; tree.scratch_entries()];
    let mut rng = Rng::new(77);
    let moved = |point| {
        let found = tree.closest_point(point, Budget::EXACT, &mut stack);
        let surface = Vec3::from_array(found.map_err(|error| error.to_string())?.point);
        let off = 0.1 * diagonal(bounds) * rng.unit_f64() as f32;
        Ok((surface + off * Vec3::from_array(rng.direction())).to_array())
    };
    far(bounds, count).into_iter().map(moved).collect()
}

/// Points of a field's box.
fn in_field(field: &Sdf<'_>, count: usize) -> Vec<[f32; 3]> {
    let [least, greatest] = field.bounds().map(Vec3::from_array);
    let (middle, half) = (least.midpoint(greatest), (greatest - least) / 4.0);
    // Far points are those of the doubled box.
    far([(middle - half).to_array(), (middle + half).to_array()], count)
}

/// The first vertex of the base hull, then the others from the last to the first, again and again.
fn along_base(hull: &Hull<'_>) -> impl Iterator<Item = [f32; 3]> {
    let targets = (0..hull.header().base_vertices).rev().cycle();
    std::iter::once(0).chain(targets).filter_map(|v| hull.vertex(VertIdx(v)))
}

/// `count` places from corner to corner, in steps of at most `step`.
fn walk(mut corners: impl Iterator<Item = [f32; 3]>, step: f32, count: usize) -> Vec<[f32; 3]> {
    let mut places = Vec::with_capacity(count);
    let mut next = || corners.next().map(Vec3::from_array);
    let Some(mut from) = next() else { return places };
    while let Some(to) = next() {
        let steps = (from.distance(to) / step).ceil().max(1.0);
        let way = (0..steps as u32).map(|i| from + (to - from) * (i as f32 / steps));
        places.extend(way.take(count - places.len()).map(|place| place.to_array()));
        if places.len() == count {
            break;
        }
        from = to;
    }
    places
}

pub(crate) fn written(
    question: Question,
    blob: &[u8],
    other: &[u8],
    places: &[[f32; 3]],
) -> Vec<u8> {
    let bytes = [blob, other].map(|blob| blob.len() as u32);
    let header = placed::header(question, bytes, places.len() as u32);
    let places = places.as_flattened().iter().flat_map(|x| x.to_le_bytes());
    header.into_iter().chain([blob, other].concat()).chain(places).collect()
}
