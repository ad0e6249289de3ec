//! The boundary of a union of triboxes.

use super::span::projections;
use glam::DVec3;
use meshsweep_core::Tribox;
use meshsweep_core::internal::tribox::{FACES, SLABS};

/// Faces of the union, in convex pieces: the parts of the triboxes' faces that are in no other
/// tribox. Of two faces back to back neither counts; of two that face the same way, one does.
///
/// For triboxes [on a grid](Tribox::on_grid). Pieces thinner than `sliver` may be missing. Faces of
/// flat triboxes stand twice.
///
/// Cost: for each face, the triboxes that overlap it.
pub(super) fn boundary_of_union(triboxes: &[Tribox], sliver: f64) -> Vec<Vec<DVec3>> {
    let mut pieces = Vec::new();
    for (number, tribox) in triboxes.iter().enumerate() {
        let others: Vec<(usize, &Tribox)> = triboxes
            .iter()
            .enumerate()
            .filter(|&(other, bounds)| other != number && bounds.overlaps(tribox))
            .collect();
        let boundary = tribox.boundary();
        for face in 0..FACES {
            let (slab, is_high) = (face / 2, face % 2 == 1);
            let at = if is_high { tribox.high[slab] } else { tribox.low[slab] };
            let corners = |v: [f32; 3]| DVec3::from(v.map(f64::from));
            let mut left = vec![boundary.corners(face).map(corners).collect::<Vec<_>>()];
            for &(other, bounds) in &others {
                let ends = (bounds.low[slab], bounds.high[slab]);
                let same = if is_high { ends.1 == at } else { ends.0 == at };
                let is_elsewhere = at < ends.0 || ends.1 < at;
                if is_elsewhere || same && other > number {
                    continue;
                }
                left = left
                    .into_iter()
                    .flat_map(|piece| outside(piece, slab, bounds, sliver))
                    .collect();
            }
            pieces.extend(left.into_iter().filter(|piece| piece.len() > 2));
        }
    }
    pieces
}

/// The parts of a convex piece, which lies between the planes of `along`, outside of a tribox.
fn outside(mut piece: Vec<DVec3>, along: usize, tribox: &Tribox, sliver: f64) -> Vec<Vec<DVec3>> {
    let mut outside = Vec::new();
    for slab in (0..SLABS).filter(|&slab| slab != along) {
        for (sign, at) in [(1.0, tribox.high[slab]), (-1.0, tribox.low[slab])] {
            let limit = sign * f64::from(at);
            let height = |p: DVec3| sign * projections(p.to_array())[slab] - limit;
            if piece.iter().all(|&p| height(p) <= sliver) {
                continue;
            }
            let [inner, outer] = [1.0, -1.0].map(|side| {
                let mut part = Vec::with_capacity(piece.len() + 1);
                let before = piece.iter().cycle().skip(piece.len() - 1);
                for (&from, &to) in before.zip(&piece) {
                    let (a, b) = (side * height(from), side * height(to));
                    if (a <= 0.0) != (b <= 0.0) {
                        part.push(from + (to - from) * (a / (a - b)));
                    }
                    if b <= 0.0 {
                        part.push(to);
                    }
                }
                part
            });
            outside.push(outer);
            piece = inner;
            if piece.len() < 3 {
                return outside;
            }
        }
    }
    outside
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block(low: [f32; 3], high: [f32; 3]) -> Tribox {
        let corner =
            |i: usize| std::array::from_fn(|k| if i >> k & 1 == 1 { high[k] } else { low[k] });
        Tribox::of_points((0..8).map(corner)).unwrap().on_grid()
    }

    fn area(pieces: &[Vec<DVec3>]) -> f64 {
        let of = |piece: &Vec<DVec3>| {
            let fan = piece.windows(2).map(|w| (w[0] - piece[0]).cross(w[1] - piece[0]));
            0.5 * fan.sum::<DVec3>().length()
        };
        pieces.iter().map(of).sum()
    }

    #[test]
    fn faces_between_neighbours_vanish_and_overlapping_ones_count_once() {
        let whole = block([0.0; 3], [2.0, 1.0, 1.0]);
        let (left, right) = (block([0.0; 3], [1.0; 3]), block([1.0, 0.0, 0.0], [2.0, 1.0, 1.0]));
        let wide = block([0.5, 0.0, 0.0], [2.0, 1.0, 1.0]);
        for triboxes in [
            vec![whole],
            vec![left, right],
            vec![left, wide],
            vec![wide, left],
            vec![whole, left, whole],
        ] {
            let area = area(&boundary_of_union(&triboxes, 1e-12));
            assert!((area - 10.0).abs() < 1e-9, "{area} of {}", triboxes.len());
        }
    }

    #[test]
    fn a_lower_neighbour_leaves_the_rest_of_a_face() {
        let (tall, low) =
            (block([0.0; 3], [1.0, 1.0, 2.0]), block([1.0, 0.0, 0.0], [2.0, 1.0, 1.0]));
        assert!((area(&boundary_of_union(&[tall, low], 1e-12)) - 14.0).abs() < 1e-9);
    }
}
