//! Questions to triboxes. They need no blob: points are placed around its box.

pub use meshsweep_core::Tribox;
use meshsweep_core::internal::tribox::FACES;
use meshsweep_core::{Boundary, Pose, TriboxError};

use super::timed;
use crate::fold::Fold;
use crate::kind::Kind;
use crate::observer::Observer;
use crate::place::Place;

/// Points of a tribox.
pub type Points = [[f32; 3]; 8];

/// Asks one question of a kind about triboxes; nothing of any other kind. A call, so that the other
/// questions' stacks do not hold its boundaries.
#[inline(never)]
pub fn ask(kind: Kind, place: &mut impl Place, observer: &mut impl Observer, fold: &mut Fold) {
    let points = [[0.0; 3]; 8].map(|_: [f32; 3]| place.far());
    match kind {
        Kind::TriboxBounds => {
            bounds(&points, observer, fold);
        }
        Kind::TriboxFaces => faces(&bounds(&points, &mut (), fold), observer, fold),
        Kind::TriboxOverlap | Kind::BoxOverlap => {
            // Smaller, so that some overlap and some do not.
            let [a, b, .., c, d] = points;
            let (first, second) = ([a, place.near(a)], [b, place.near(b)]);
            let (near, far) = ([a, c], [b, d]);
            let pair = if place.word() & 1 == 0 { (first, second) } else { (near, far) };
            if kind == Kind::BoxOverlap {
                box_overlap(&pair, observer, fold);
            } else {
                overlap(&pair, observer, fold);
            }
        }
        Kind::TriboxRest => {
            let snap = place.word() & 0xFF == 0;
            rest(&points, place.distance(), snap, observer, fold);
        }
        _ => {}
    }
}

fn parameters(tribox: &Tribox, fold: &mut Fold) {
    tribox.low.iter().chain(&tribox.high).for_each(|&parameter| fold.f32(parameter));
}

fn of(points: &[[f32; 3]], fold: &mut Fold) -> Tribox {
    known(Tribox::of_points(points.iter().copied()), fold)
}

fn known(tribox: Result<Tribox, TriboxError>, fold: &mut Fold) -> Tribox {
    tribox.unwrap_or_else(|error| {
        fold.word(0xffff_ff00 | error as u32);
        Tribox::EMPTY
    })
}

/// The tribox of eight points.
#[inline(never)]
pub fn bounds(points: &Points, observer: &mut impl Observer, fold: &mut Fold) -> Tribox {
    let tribox = timed(observer, || Tribox::of_points(points.iter().copied()));
    let tribox = known(tribox, fold);
    parameters(&tribox, fold);
    tribox
}

/// Its boundary.
#[inline(never)]
pub fn faces(tribox: &Tribox, observer: &mut impl Observer, fold: &mut Fold) {
    let mut boundary = Boundary::EMPTY;
    timed(observer, || boundary.compute(&tribox.low, &tribox.high));
    boundary.vertices.iter().for_each(|vertex| fold.point(*vertex));
    (0..FACES).for_each(|face| boundary.face(face).iter().for_each(|&vertex| fold.byte(vertex)));
    let cleaned = boundary.cleaned();
    (0..FACES).for_each(|face| cleaned.face(face).iter().for_each(|&vertex| fold.byte(vertex)));
}

/// Whether the triboxes of two pairs of points overlap.
#[inline(never)]
pub fn overlap(
    (a, b): &([[f32; 3]; 2], [[f32; 3]; 2]),
    observer: &mut impl Observer,
    fold: &mut Fold,
) {
    let (a, b) = (of(a, fold), of(b, fold));
    fold.word(u32::from(timed(observer, || a.overlaps(&b))));
}

/// The same of boxes: what the test above is compared with.
#[inline(never)]
pub fn box_overlap(
    ([a, b], [c, d]): &([[f32; 3]; 2], [[f32; 3]; 2]),
    observer: &mut impl Observer,
    fold: &mut Fold,
) {
    let bounds = |a: &[f32; 3], b: &[f32; 3]| {
        let (mut low, mut high) = (*a, *b);
        low.iter_mut()
            .zip(&mut high)
            .filter(|(low, high)| low > high)
            .for_each(|(low, high)| core::mem::swap(low, high));
        (low, high)
    };
    let (first, second) = (bounds(a, b), bounds(c, d));
    let apart = timed(observer, || {
        let slabs = first.0.iter().zip(&first.1).zip(second.0.iter().zip(&second.1));
        slabs.into_iter().any(|((low, high), (other_low, other_high))| {
            !((low <= other_high) & (other_low <= high))
        })
    });
    fold.word(u32::from(!apart));
}

/// Everything else.
#[inline(never)]
pub fn rest(
    points: &Points,
    distance: f32,
    snap: bool,
    observer: &mut impl Observer,
    fold: &mut Fold,
) {
    let [a, b, c, d, e, f, g, h] = *points;
    let (first, second) = (of(&[a, b, c], fold), of(&[d, e, f], fold));
    let both = timed(observer, || first.intersection(&second).tightened());
    parameters(&both, fold);
    parameters(&known(first.padded(distance), fold), fold);
    parameters(&known(first.translated(g), fold), fold);
    parameters(&first.on_grid(), fold);
    fold.f32(first.distance(g));
    fold.word(u32::from(first.contains_point(h)) | u32::from(first.contains(&both)) << 1);
    if let Some((enter, leave)) = first.clip(g, h) {
        fold.f32(enter);
        fold.f32(leave);
    }
    let pose = Pose::rigid([[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]], h);
    parameters(&known(first.moved(&pose), fold), fold);
    parameters(&known(pose.bound([a, b, c]), fold), fold);
    if snap {
        parameters(&second.snapped(distance), fold);
    }
}
