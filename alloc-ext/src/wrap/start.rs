//! The first hull: one that satisfies the invariant of `work`, proved face by face.
//!
//! A level of the progressive hull is the best of starts, and may touch the mesh, and itself: its
//! vertices are lifted by a few steps of the grid. If that does not prove it, a finer level may do.
//! Where there is none, because the mesh is open, or its parts cross, the start is its closure, or
//! a progressive hull of that.

use super::boxes::{Bounds, BoxTree};
use super::closure::closure;
use super::obstacle::Obstacle;
use super::options::{Progress, Stage, Start};
use super::placement::StarFace;
use super::predicates::{are_apart, is_degenerate, side};
use super::rounding::Rounding;
use super::shell::Shell;
use crate::collapse::{Conditions, Engine, MAX_STAR, Priority, thin};
use crate::lp::{HalfSpace, minimise_bounded};
use crate::mesh::{Enclosure, Mesh};
use crate::precision::Stored;
use glam::DVec3;
use meshsweep_core::internal::num::exp2;
use std::time::Instant;

/// A hull to start from.
pub(super) struct First {
    pub shell: Shell,
    pub start: Start,
    /// Parts dropped.
    pub filled: usize,
}

/// Where first hulls are looked for, and until when.
#[derive(Clone, Copy)]
pub(super) struct Place<'a> {
    /// Frame and grid.
    pub stored: &'a Stored,
    pub obstacle: &'a Obstacle,
    pub rounding: Rounding,
    pub deadline: Option<Instant>,
}

/// Faces of the level to start from: enough to choose from for `wanted`, and no more, for each
/// costs a collapse.
fn plenty(wanted: usize) -> usize {
    wanted.saturating_add(wanted / 2).saturating_add(800)
}

/// Levels that are tried: [`plenty`] times 2 to this, in this order. Finer ones are closer to the
/// mesh; coarser ones pass over places where the mesh crosses itself.
const LEVELS: [i32; 7] = [0, 1, -1, 2, -2, 3, -3];

/// Faces that no level is coarser than.
const LEAST_FACES: usize = 40;

/// Hulls to start from that come of the progressive hull.
#[derive(Default)]
pub(super) struct Levels {
    /// The first of [`LEVELS`] that proves to be one: the choice where the mesh is round.
    pub plenty: Option<First>,
    /// The level with the wanted faces, if it proves to be one: the choice where that is the solid
    /// itself, as it may be on blocks with few flat faces.
    pub wanted: Option<First>,
}

/// The levels of the progressive hull that are hulls to start from, if they are found before the
/// deadline.
pub(super) fn first_levels(
    &Place { stored, obstacle, rounding, deadline }: &Place<'_>,
    mesh: &Mesh,
    wanted: usize,
    on_progress: &mut dyn FnMut(Progress),
) -> Levels {
    let conditions = Conditions::PAPER;
    let from =
        Surface { positions: &stored.positions, triangles: &mesh.triangles, stored, conditions };
    let mut hulls = |thins| {
        let mut levels = from.levels(wanted, thins, deadline, on_progress).unwrap_or_default();
        let mut first = |level: Option<i32>| {
            let (_, (positions, triangles)) =
                levels.remove(levels.iter().position(|(l, _)| *l == level)?);
            let mut shell = Shell::new(positions, &triangles);
            let faces = shell.face_count();
            lift(&mut shell, &rounding, obstacle.margin());
            let (shell, filled) = keep_outermost(shell);
            let start = Start::Progressive { faces };
            defects(&shell, obstacle).is_empty().then_some(First { shell, start, filled })
        };
        let tried = if thins { &LEVELS[..1] } else { &LEVELS };
        Levels { wanted: first(None), plenty: tried.iter().find_map(|&level| first(Some(level))) }
    };
    // Collapses in rounds may make the surface grow into itself where those in order do not.
    let thinned = if from.is_thinned(wanted) { hulls(true) } else { Levels::default() };
    if thinned.plenty.is_some() { thinned } else { hulls(false) }
}

/// The closure of the mesh from a grid of so many cubes, or the first of its progressive hull's
/// levels that does not meet itself, if it is found before the deadline.
pub(super) fn first_closure(
    &Place { stored, obstacle, rounding, deadline }: &Place<'_>,
    cells: usize,
    wanted: usize,
    conditions: Conditions,
    on_progress: &mut dyn FnMut(Progress),
) -> Option<First> {
    let mut closure = closure(obstacle, cells, deadline)?;
    if obstacle.margin() > 0.0 {
        closure.positions =
            closure.positions.iter().map(|&p| rounding.round(p)).collect::<Option<Vec<DVec3>>>()?;
    }
    if closure.positions.iter().any(|&p| rounding.round(p) != Some(p)) {
        return None;
    }
    let start = Start::Closure { cell: closure.cell, cells: closure.cells };
    let local = exp2(-stored.scale_exponent);
    let positions: Vec<DVec3> = closure.positions.iter().map(|&p| p * local).collect();
    let from = Surface { positions: &positions, triangles: &closure.triangles, stored, conditions };
    let hull = |(positions, triangles): Faces| {
        let (shell, filled) = keep_outermost(Shell::new(positions, &triangles));
        defects(&shell, obstacle).is_empty().then_some(First { shell, start, filled })
    };
    // In narrow places levels grow into each other.
    for thins in if from.is_thinned(wanted) { &[true, false][..] } else { &[false] } {
        let mut levels = from.levels(wanted, *thins, deadline, on_progress)?;
        let tried = if *thins { &LEVELS[..1] } else { &LEVELS };
        let first = tried.iter().filter(|&&level| level >= 0).find_map(|&level| {
            hull(levels.remove(levels.iter().position(|(l, _)| *l == Some(level))?).1)
        });
        if first.is_some() {
            return first;
        }
    }
    // The closure itself never does, but each of its faces costs a collapse against the mesh.
    if closure.triangles.len() <= MOST_FACES {
        hull((closure.positions, closure.triangles))
    } else {
        None
    }
}

/// The mesh's box, a few steps of the grid larger.
pub(super) fn first_box(obstacle: &Obstacle, rounding: &Rounding) -> Option<First> {
    let bounds = obstacle.bounds().grown(obstacle.margin());
    let size = bounds.low.abs().max(bounds.high.abs()).max_element();
    LIFTS.into_iter().find_map(|lift| {
        let out = rounding.half_step(size) * lift;
        let (low, high) = (rounding.round(bounds.low - out)?, rounding.round(bounds.high + out)?);
        let corner = |c: u32| {
            let pick = |bit: u32, low: f64, high: f64| if c & bit == 0 { low } else { high };
            DVec3::new(pick(1, low.x, high.x), pick(2, low.y, high.y), pick(4, low.z, high.z))
        };
        let quads =
            [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles: Vec<[u32; 3]> =
            quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        let shell = Shell::new((0..8).map(corner).collect(), &triangles);
        defects(&shell, obstacle).is_empty().then_some(First {
            shell,
            start: Start::Box,
            filled: 0,
        })
    })
}

/// Faces that are collapsed between two looks at the clock.
const SLICE: usize = 1000;

/// Faces of a closure that is a first hull itself.
const MOST_FACES: usize = 10_000;

/// What the hull of a closure may do to its shape where it has to stay near. Closures of what is
/// oblique are stairs, of which the paper's conditions refuse most collapses, and what is left
/// stands out.
pub(super) const OF_STAIRS: Conditions =
    Conditions { compactness_ratio: 0.2, min_normal_cosine: 0.2, ..Conditions::PAPER };

/// Compactness that may be lost before a level: the hull that comes of it is shrunk onto the mesh,
/// so that needles do little harm, while the paper's condition refuses most collapses of a fine
/// mesh.
const THINNING: f64 = 0.4;

/// Positions and triangles.
type Faces = (Vec<DVec3>, Vec<[u32; 3]>);

/// Faces of the finest level.
fn finest_level(wanted: usize) -> usize {
    plenty(wanted).saturating_mul(8)
}

/// A closed manifold surface in the local frame, on its grid.
struct Surface<'a> {
    positions: &'a [DVec3],
    triangles: &'a [[u32; 3]],
    stored: &'a Stored,
    conditions: Conditions,
}

impl Surface<'_> {
    /// Whether it has more faces than the finest level, so that it makes a difference whether it
    /// thins.
    fn is_thinned(&self, wanted: usize) -> bool {
        self.triangles.len() > finest_level(wanted)
    }

    /// Levels of the progressive hull in the mesh's frame, each with its number: level `n` has
    /// [`plenty`] times 2^n faces, the one without number has `wanted`, or as few as the hull
    /// can be brought down to; level 0 and that without number may be the surface itself. If it
    /// `thins`, what is more than the finest level has is [thinned](thin) first. `None` if the
    /// deadline passes first.
    fn levels(
        &self,
        wanted: usize,
        thins: bool,
        deadline: Option<Instant>,
        on_progress: &mut dyn FnMut(Progress),
    ) -> Option<Vec<(Option<i32>, Faces)>> {
        let is_late = || deadline.is_some_and(|deadline| Instant::now() >= deadline);
        let Self { positions, triangles, stored, conditions } = *self;
        let from = triangles.len();
        let mut show = |faces: usize| {
            on_progress(Progress {
                stage: Stage::Collapsing,
                done: from.saturating_sub(faces),
                of: from.saturating_sub(wanted),
            });
        };
        let mut counts: Vec<(Option<i32>, usize)> = (-3..=3)
            .map(|level| (Some(level), (plenty(wanted) as f64 * exp2(level)) as usize))
            .filter(|&(level, faces)| {
                !(faces >= from && level > Some(0) || faces < LEAST_FACES && level < Some(0))
            })
            .chain([(None, wanted)])
            .collect();
        counts.sort_unstable_by_key(|&(level, faces)| (std::cmp::Reverse(faces), level));
        let thinned = (thins && self.is_thinned(wanted)).then(|| {
            let compactness_ratio = conditions.compactness_ratio.min(THINNING);
            let loose = Conditions { compactness_ratio, ..conditions };
            thin(positions, triangles, finest_level(wanted), loose, stored.grid, |faces| {
                show(faces);
                is_late()
            })
        });
        if is_late() {
            return None;
        }
        let (positions, triangles) = thinned
            .as_ref()
            .map_or((positions, triangles), |(positions, triangles)| (positions, triangles));
        let mut engine =
            Engine::new(positions, triangles, conditions, Priority::Program, stored.grid);
        let scale = exp2(stored.scale_exponent);
        let mut levels = Vec::new();
        for (level, faces) in counts {
            // Where it gets stuck it is a level as well.
            while engine.progress().faces > faces && !is_late() {
                let next = engine.progress().faces.saturating_sub(SLICE).max(faces);
                if engine.run(next, |progress| show(progress.faces)).is_some() {
                    break;
                }
            }
            if is_late() {
                return None;
            }
            let all: Vec<DVec3> = engine.positions().iter().map(|&p| p * scale).collect();
            let faces: Vec<[u32; 3]> = engine.faces().collect();
            levels.push((level, compact(&all, &faces)));
        }
        Some(levels)
    }
}

/// Without positions that no triangle has.
fn compact(positions: &[DVec3], triangles: &[[u32; 3]]) -> Faces {
    let mut number = vec![u32::MAX; positions.len()];
    let mut kept = Vec::new();
    let triangles = triangles
        .iter()
        .map(|t| {
            t.map(|v| {
                let number = &mut number[v as usize];
                if *number == u32::MAX {
                    *number = kept.len() as u32;
                    kept.push(positions[v as usize]);
                }
                *number
            })
        })
        .collect();
    (kept, triangles)
}

/// Lifts of a vertex in half-steps of the grid, until one is strictly outside of every face.
const LIFTS: [f64; 5] = [3.0, 6.0, 12.0, 48.0, 192.0];

/// Moves every vertex strictly outside of all planes of its star, by the margin and a few steps of
/// the grid: then the hull lies strictly outside of where it was. A vertex without such a place
/// goes into a neighbour, where the two have one together; one that has not stays.
pub(super) fn lift(shell: &mut Shell, rounding: &Rounding, margin: f64) {
    let mut star = Vec::new();
    let mut left = Vec::new();
    // Planes that were lifted already would lift by the margin again; steps of the grid do no harm.
    let before = if margin > 0.0 { Some(shell.clone()) } else { None };
    for v in 0..shell.vertex_slots() {
        if shell.mesh.at(v).is_empty() {
            continue;
        }
        before.as_ref().unwrap_or(shell).vertex_star(v, &mut star);
        match lifted(&star, shell.position(v), rounding, margin) {
            Some(x) => shell.move_vertex(v, x),
            None => left.push(v),
        }
    }
    let mut faces = Vec::new();
    for v in left {
        let neighbours: Vec<u32> = shell.mesh.neighbours(v).collect();
        for u in neighbours {
            if !shell.mesh.collapsible_star(u, v, MAX_STAR, &mut faces) {
                continue;
            }
            star.clear();
            star.extend(faces.iter().map(|&f| shell.star_face(f, [u, v])));
            let middle = (shell.position(u) + shell.position(v)) * 0.5;
            if let Some(x) = lifted(&star, middle, rounding, margin) {
                shell.collapse(u, v, x);
                break;
            }
        }
    }
}

/// The point nearest to `from`, about, that is strictly outside of all planes of a star, and
/// farther by the margin, about; the first is exact.
fn lifted(star: &[StarFace], from: DVec3, rounding: &Rounding, margin: f64) -> Option<DVec3> {
    let step = rounding.half_step(from.abs().max_element());
    LIFTS.into_iter().find_map(|lift| {
        // In half-steps, so that the program's tolerances are far below one; where there is a
        // margin, in what is near it.
        let (unit, height) = if margin > 0.0 {
            (step + margin, (step * lift + margin) / (step + margin))
        } else {
            (step, lift)
        };
        let plane = |face: &StarFace| HalfSpace {
            normal: face.normal,
            offset: height + face.normal.dot(face.corners[0] - from) / unit,
        };
        let mut planes: Vec<HalfSpace> = star.iter().map(plane).collect();
        let x = minimise_bounded(DVec3::ZERO, &mut planes, 1.0)?;
        let x = rounding.round(from + x * unit)?;
        star.iter().all(|face| side(&face.corners, x) > 0.0).then_some(x)
    })
}

/// The faces of each connected part of a surface, largest bounds first.
fn parts(shell: &Shell) -> Vec<Vec<u32>> {
    let mut part_of = vec![usize::MAX; shell.mesh.corners.len()];
    let mut parts: Vec<Vec<u32>> = Vec::new();
    for first in shell.alive() {
        if part_of[first as usize] != usize::MAX {
            continue;
        }
        let mut faces = vec![first];
        part_of[first as usize] = parts.len();
        let mut next = 0;
        while let Some(&face) = faces.get(next) {
            next += 1;
            for v in shell.mesh.corners[face as usize] {
                for &other in shell.mesh.at(v) {
                    if part_of[other as usize] == usize::MAX {
                        part_of[other as usize] = parts.len();
                        faces.push(other);
                    }
                }
            }
        }
        faces.sort_unstable();
        parts.push(faces);
    }
    parts
}

fn enclosure(shell: &Shell, faces: &[u32]) -> Enclosure {
    let single = |p: DVec3| p.as_vec3().to_array();
    Enclosure::new(faces.iter().map(|&f| shell.triangle(f).map(single)).collect())
}

/// Drops parts of the surface that bound cavities, and parts inside others: what is left has the
/// same outside. How many were dropped. For a surface that does not meet itself.
pub(super) fn keep_outermost(shell: Shell) -> (Shell, usize) {
    let all = parts(&shell);
    if all.len() < 2 {
        return (shell, 0);
    }
    let enclosures: Vec<Enclosure> = all.iter().map(|faces| enclosure(&shell, faces)).collect();
    // Thousands of parts: only those are asked whose boxes hold the point.
    let boxes: Vec<Bounds> = enclosures.iter().map(Bounds::around).collect();
    let (tree, order) = BoxTree::new(&boxes);
    let inside = |i: usize| {
        let Some(&first) = all[i].first() else { return true };
        let p = shell.triangle(first)[0];
        let at = Bounds::of(&[p]);
        let mut is_inside = false;
        tree.visit(
            |of| of.meets(&at),
            |item| {
                let j = order[item] as usize;
                is_inside = j != i && enclosures[j].holds(p.as_vec3().to_array());
                !is_inside
            },
        );
        is_inside
    };
    let kept: Vec<u32> =
        (0..all.len()).filter(|&i| !inside(i)).flat_map(|i| all[i].iter().copied()).collect();
    let positions: Vec<DVec3> = (0..shell.vertex_slots()).map(|v| shell.position(v)).collect();
    let triangles: Vec<[u32; 3]> = kept.iter().map(|&f| shell.mesh.corners[f as usize]).collect();
    let (positions, triangles) = compact(&positions, &triangles);
    let shell = Shell::new(positions, &triangles);
    let left = parts(&shell).len();
    (shell, all.len() - left)
}

/// Why a surface does not satisfy the invariant.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Defects {
    /// Faces that meet each other, or have no area.
    pub entangled: Vec<u32>,
    /// Faces that meet the mesh.
    pub touching: Vec<u32>,
    /// Parts of the mesh that are outside.
    pub outside: usize,
}

impl Defects {
    pub fn is_empty(&self) -> bool {
        self.entangled.is_empty() && self.touching.is_empty() && self.outside == 0
    }
}

/// Tests the whole invariant. Exact.
pub(super) fn defects(shell: &Shell, obstacle: &Obstacle) -> Defects {
    let faces: Vec<u32> = shell.alive().collect();
    let boxes: Vec<Bounds> = faces.iter().map(|&f| Bounds::of(&shell.triangle(f))).collect();
    let (tree, order) = BoxTree::new(&boxes);
    let mut defects = Defects::default();
    for (i, &f) in faces.iter().enumerate() {
        let face = shell.face(f);
        let mut clean = !is_degenerate(&face.at);
        tree.visit(
            |of| of.meets(&boxes[i]),
            |j| {
                let other = faces[order[j] as usize];
                clean &= other == f || are_apart(&face, &shell.face(other));
                clean
            },
        );
        if !clean {
            defects.entangled.push(f);
        }
        if obstacle.meets(&face.at) {
            defects.touching.push(f);
        }
    }
    let hull = enclosure(shell, &faces);
    let is_out = |p: &&DVec3| !hull.holds(p.as_vec3().to_array());
    defects.outside = obstacle.witnesses().iter().filter(is_out).count();
    defects
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::wrap::polish::Dice;

    /// Tetrahedra at the points of a lattice, every third with another in it, and every sixth with
    /// one in that.
    fn tetrahedra(side: usize) -> (Shell, usize) {
        let (mut positions, mut triangles) = (Vec::new(), Vec::new());
        let mut add = |at: DVec3, size: f64| {
            let first = positions.len() as u32;
            let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
            positions.extend(corners.map(|p| (at + p * size).as_vec3().as_dvec3()));
            triangles.extend(
                [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3u32]].map(|t| t.map(|v| v + first)),
            );
        };
        let mut dice = Dice::new(3);
        let mut within = 0;
        for n in 0..side.pow(3) {
            let at = [n % side, n / side % side, n / side / side].map(|x| 2.0 * x as f64);
            let at = DVec3::from(at) + DVec3::new(dice.roll(), dice.roll(), dice.roll());
            add(at, 1.0);
            for (size, every) in [(0.5, 3), (0.25, 6)] {
                if n % every == 0 {
                    add(at + 0.1, size);
                    within += 1;
                }
            }
        }
        (Shell::new(positions, &triangles), within)
    }

    #[test]
    fn of_many_parts_those_inside_others_are_dropped() {
        for side in [1, 2, 6] {
            let (shell, within) = tetrahedra(side);
            let parts = shell.face_count() / 4;
            let (left, dropped) = keep_outermost(shell);
            assert_eq!((dropped, left.face_count()), (within, 4 * (parts - within)));
            assert!(left.volume() > (parts - within) as f64 / 6.001);
        }
    }
}
