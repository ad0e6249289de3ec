//! Which cubes of a grid a triangle meets, found by halving blocks of them: a long triangle meets few of those that its box does.

use super::boxes::Bounds;
use super::predicates::Triangle;
use glam::DVec3;

/// Cubes along each axis: the first and the last.
pub(super) type Block = [[i64; 2]; 3];

/// Calls `visit` with every cube of a block that a triangle meets, and perhaps others that its box and its plane meet. `grown` is the box of a block, larger than it is by
/// more than rounding.
pub(super) fn visit_met(
    triangle: &Triangle,
    of: Block,
    grown: impl Fn(Block) -> Bounds,
    mut visit: impl FnMut([i64; 3]),
) {
    let sheet = Sheet::new(triangle);
    let mut open = vec![of];
    while let Some(block) = open.pop() {
        if !sheet.reaches(&grown(block)) {
            continue;
        }
        let further = block.map(|[from, to]| to - from);
        let axis = (0..3).fold(0, |most, axis| if further[axis] > further[most] { axis } else { most });
        if further[axis] <= 0 {
            visit(block.map(|[only, _]| only));
            continue;
        }
        let [from, to] = block[axis];
        let middle = (from + to).div_euclid(2);
        for half in [[from, middle], [middle + 1, to]] {
            let mut part = block;
            part[axis] = half;
            open.push(part);
        }
    }
}

/// A triangle's plane, within its box.
struct Sheet {
    bounds: Bounds,
    corner: DVec3,
    normal: DVec3,
    /// Product of the edges' lengths that the normal is of: it is off by a part of that.
    size: f64,
}

impl Sheet {
    fn new(triangle: &Triangle) -> Self {
        let [a, b, c] = *triangle;
        let (ab, ac) = (b - a, c - a);
        Self {
            bounds: Bounds::of(triangle),
            corner: a,
            normal: ab.cross(ac),
            size: ab.length() * ac.length(),
        }
    }

    /// Never false for a box that the triangle meets.
    fn reaches(&self, of: &Bounds) -> bool {
        if !self.bounds.meets(of) {
            return false;
        }
        let (middle, half) = ((of.low + of.high) * 0.5, (of.high - of.low) * 0.5);
        let a = self.corner - middle;
        let reach = half.dot(self.normal.abs());
        let slack = 64.0 * f64::EPSILON * self.size * (a.length() + half.length());
        self.normal.dot(a).abs() <= reach + slack
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wrap::polish::Dice;

    /// Unit cubes.
    fn grown(block: Block) -> Bounds {
        let [from, to] = [block.map(|[from, _]| from), block.map(|[_, to]| to + 1)]
            .map(|corner| DVec3::from(corner.map(|x| x as f64)));
        Bounds { low: from - 1e-6, high: to + 1e-6 }
    }

    #[test]
    fn halving_leaves_out_no_cube_that_is_met() {
        let mut dice = Dice::new(7);
        for size in [1e-9, 0.5, 3.0, 20.0] {
            for kind in 0..3 {
                let mut point = || {
                    let p = DVec3::new(dice.roll(), dice.roll(), dice.roll());
                    (p * size - 0.5 * size).as_vec3().as_dvec3()
                };
                let [a, b, c] = [point(), point(), point()];
                let triangle = match kind {
                    0 => [a, b, c],
                    1 => [(a + b) * 0.5, a, b],
                    _ => [a, b, (a + b) * 0.5 + (c - a) * 1e-7],
                };
                let sheet = Sheet::new(&triangle);
                let mut wanted = Vec::new();
                for (i, j, k) in (0..22i64.pow(3)).map(|n| (n % 22 - 11, n / 22 % 22 - 11, n / 484 - 11)) {
                    if sheet.reaches(&grown([[i, i], [j, j], [k, k]])) {
                        wanted.push([i, j, k]);
                    }
                }
                let mut found = Vec::new();
                visit_met(&triangle, [[-11, 10]; 3], grown, |cube| found.push(cube));
                found.sort_unstable();
                wanted.sort_unstable();
                assert!(!wanted.is_empty() && found == wanted, "{triangle:?}");
                let middle = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
                assert!(found.contains(&middle.floor().as_i64vec3().to_array()));
            }
        }
    }
}
