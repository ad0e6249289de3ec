//! Random and degenerate programs, representable for the oracle.

use glam::DVec3;
use meshsweep::lp::HalfSpace;

use super::Program;
use super::random::Random;
use super::stars::Star;

/// A way to make a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Random half-spaces around a common point; the objective points anywhere.
    Around,
    /// The same, the objective a positive combination of normals: never unbounded.
    Bounded,
    /// Random half-spaces with random offsets: mostly contradictory or unbounded.
    Anything,
    /// An edge's star of any kind.
    Star,
    /// Some constraints twice, or again with the last digits changed.
    Duplicates,
    /// Slabs and stacks: normals shared or opposite, offsets apart or the same.
    Parallel,
    /// Normals that differ by 1e-9 to 1e-4.
    NearlyParallel,
    /// All normals at right angles to one axis, so that every three planes are dependent.
    Prism,
    /// Every plane passes through one point.
    Apex,
    /// A polytope, and one half-space that misses it by a tenth or more.
    Contradiction,
    /// A polytope, and one half-space that misses it by 1e-13 to 1e-6.
    NarrowContradiction,
    /// Some normals are zero.
    ZeroNormals,
    /// Descends for ever.
    Unbounded,
    /// The objective is a normal, or a combination of two: the optimum is a face or an edge.
    Face,
    /// Faces of a box and its cut edges, in whole and half numbers: many planes through every
    /// vertex.
    Box,
    /// [`stairs`]: inserted as they come, nearly every constraint is violated.
    Stairs,
    /// [`sphere`].
    Sphere,
}

impl Family {
    /// Those without built-in coincidences.
    pub const RANDOM: [Self; 4] = [Self::Around, Self::Bounded, Self::Anything, Self::Star];
    /// Those that can have any number of constraints, with a function that makes them.
    pub const LARGE: [(Self, Large); 2] = [(Self::Stairs, stairs), (Self::Sphere, sphere)];
    /// The others.
    pub const DEGENERATE: [Self; 13] = [
        Self::Duplicates,
        Self::Parallel,
        Self::NearlyParallel,
        Self::Prism,
        Self::Apex,
        Self::Contradiction,
        Self::NarrowContradiction,
        Self::ZeroNormals,
        Self::Unbounded,
        Self::Face,
        Self::Box,
        Self::Stairs,
        Self::Sphere,
    ];

    /// One program of this family.
    #[must_use]
    pub fn program(self, random: &mut Random) -> Program {
        let program = match self {
            Self::Around => around(random, 0.3),
            Self::Bounded => bounded(random, 0.3),
            Self::Anything => anything(random),
            Self::Star => random.pick(&Star::ALL).program(random),
            Self::Duplicates => duplicates(random),
            Self::Parallel => parallel(random),
            Self::NearlyParallel => nearly_parallel(random),
            Self::Prism => prism(random),
            Self::Apex => bounded(random, 0.0),
            Self::Contradiction => contradiction(random, -1.0),
            Self::NarrowContradiction => {
                let exponent = random.within(-13.0, -6.0);
                contradiction(random, exponent)
            }
            Self::ZeroNormals => zero_normals(random),
            Self::Unbounded => unbounded(random),
            Self::Face => face(random),
            Self::Box => cut_box(random),
            Self::Stairs => {
                let count = 6 + random.below(10);
                stairs(random, count)
            }
            Self::Sphere => {
                let count = 6 + random.below(10);
                sphere(random, count)
            }
        };
        program.representable()
    }
}

/// Makes a program with a given number of constraints.
pub type Large = fn(&mut Random, usize) -> Program;

/// Three floors, then stairs along x, along y and along z, from the lowest step to the highest. The
/// steps lean by less than their height, so each lies wholly above those before it near the origin.
///
/// Inserted as they come, every step is violated, and so is every earlier one along the two other
/// axes in the programs on its plane and on its lines: the work is cubic.
#[must_use]
pub fn stairs(random: &mut Random, count: usize) -> Program {
    let axes = DVec3::AXES;
    let mut constraints: Vec<HalfSpace> =
        axes.into_iter().map(|normal| HalfSpace { normal, offset: -1.0 }).collect();
    let steps = count.saturating_sub(3);
    let each = steps.div_ceil(3);
    for step in 0..steps {
        let height = 1.0 / each as f64;
        let lean = random.direction() * (0.1 * height);
        let normal = (axes[step / each] + lean).normalize();
        constraints.push(HalfSpace { normal, offset: (step % each) as f64 * height - 0.5 });
    }
    Program { objective: DVec3::splat(1.0).normalize(), constraints }
}

/// Tangent planes of the unit sphere, which lies in every half-space: none is redundant. Three
/// slanting floors bound the program.
#[must_use]
pub fn sphere(random: &mut Random, count: usize) -> Program {
    let floor = |x: f64, y: f64| DVec3::new(x, y, 1.0).normalize();
    let floors = [floor(1.0, 0.0), floor(-1.0, 1.0), floor(-1.0, -1.0)];
    let tangent = |normal| HalfSpace { normal, offset: -1.0 };
    let mut constraints: Vec<HalfSpace> = floors.map(tangent).to_vec();
    let others = count.saturating_sub(constraints.len());
    constraints.extend((0..others).map(|_| tangent(random.direction())));
    Program { objective: DVec3::Z, constraints }
}

/// A half-space of random direction that holds `point`, by up to `slack`.
fn holding(random: &mut Random, point: DVec3, slack: f64) -> HalfSpace {
    let normal = random.direction();
    HalfSpace { normal, offset: normal.dot(point) - random.within(0.0, slack) }
}

fn around(random: &mut Random, slack: f64) -> Program {
    let point = random.direction() * random.within(0.0, 0.5);
    let count = 1 + random.below(12);
    let constraints = (0..count).map(|_| holding(random, point, slack)).collect();
    Program { objective: random.direction(), constraints }
}

fn bounded(random: &mut Random, slack: f64) -> Program {
    let mut program = around(random, slack);
    program.objective = combination(random, &program.constraints).normalize_or_zero();
    program
}

fn combination(random: &mut Random, constraints: &[HalfSpace]) -> DVec3 {
    constraints.iter().map(|h| h.normal * random.within(0.0, 1.0)).sum()
}

fn anything(random: &mut Random) -> Program {
    let count = 1 + random.below(12);
    let half_space = |random: &mut Random| HalfSpace {
        normal: random.direction(),
        offset: random.within(-1.0, 0.3),
    };
    let constraints = (0..count).map(|_| half_space(random)).collect();
    Program { objective: random.direction(), constraints }
}

fn duplicates(random: &mut Random) -> Program {
    let mut program = bounded(random, 0.2);
    for _ in 0..1 + random.below(4) {
        let mut again = random.pick(&program.constraints);
        if random.below(2) == 0 {
            again.offset += random.within(-1e-15, 1e-15);
            again.normal.x += random.within(-1e-16, 1e-16);
        }
        program.constraints.push(again);
    }
    random.shuffle(&mut program.constraints);
    program
}

fn parallel(random: &mut Random) -> Program {
    let mut program = bounded(random, 0.2);
    for _ in 0..1 + random.below(4) {
        let HalfSpace { normal, offset } = random.pick(&program.constraints);
        let apart = random.pick(&[0.0, 0.0, 1e-3, 0.1, 0.5]);
        program.constraints.push(match random.below(3) {
            0 => HalfSpace { normal: -normal, offset: -offset - apart },
            1 => HalfSpace { normal, offset: offset + apart },
            _ => HalfSpace { normal, offset: offset - apart },
        });
    }
    random.shuffle(&mut program.constraints);
    program
}

fn nearly_parallel(random: &mut Random) -> Program {
    let mut program = bounded(random, 0.1);
    for _ in 0..1 + random.below(6) {
        let HalfSpace { normal, offset } = random.pick(&program.constraints);
        let size = 10f64.powf(random.within(-9.0, -4.0));
        let normal = (normal + random.direction() * size).normalize();
        program.constraints.push(HalfSpace { normal, offset: offset + random.within(-size, size) });
    }
    program.objective = combination(random, &program.constraints).normalize_or_zero();
    random.shuffle(&mut program.constraints);
    program
}

fn prism(random: &mut Random) -> Program {
    let skew = random.direction();
    let axis = random.pick(&[DVec3::X, DVec3::Z, skew]);
    let mut program = bounded(random, 0.2);
    for h in &mut program.constraints {
        h.normal = h.normal.reject_from_normalized(axis).normalize();
        h.offset = random.within(-0.3, 0.02);
    }
    if random.below(4) > 0 {
        program.objective = combination(random, &program.constraints).normalize_or_zero();
    }
    program
}

fn contradiction(random: &mut Random, exponent: f64) -> Program {
    let mut program = bounded(random, 0.2);
    let HalfSpace { normal, offset } = random.pick(&program.constraints);
    program.constraints.push(HalfSpace { normal: -normal, offset: -offset + 10f64.powf(exponent) });
    random.shuffle(&mut program.constraints);
    program
}

fn zero_normals(random: &mut Random) -> Program {
    let mut program = bounded(random, 0.2);
    for _ in 0..1 + random.below(3) {
        let offset = random.pick(&[0.0, 0.0, -1.0, -1e-300, 0.5, 1e-3]);
        program.constraints.push(HalfSpace { normal: DVec3::ZERO, offset });
    }
    random.shuffle(&mut program.constraints);
    program
}

fn unbounded(random: &mut Random) -> Program {
    let mut program = around(random, 0.2);
    let ray = random.direction();
    for h in &mut program.constraints {
        if h.normal.dot(ray) < 0.0 {
            *h = HalfSpace { normal: -h.normal, offset: -h.offset - 0.5 };
        }
    }
    if program.objective.dot(ray) > 0.0 {
        program.objective = -program.objective;
    }
    program
}

fn face(random: &mut Random) -> Program {
    let mut program = around(random, 0.4);
    let (a, b) =
        (random.pick(&program.constraints).normal, random.pick(&program.constraints).normal);
    program.objective = if random.below(2) == 0 { a } else { a + b };
    program
}

fn cut_box(random: &mut Random) -> Program {
    let half = [-0.5, 0.0, 0.5];
    let centre = DVec3::new(random.pick(&half), random.pick(&half), random.pick(&half));
    let (mut constraints, mut objective) = (Vec::new(), DVec3::ZERO);
    for _ in 0..3 + random.below(8) {
        let whole =
            DVec3::new(random.below(3) as f64, random.below(3) as f64, random.below(3) as f64)
                - 1.0;
        let normal = whole.normalize_or_zero();
        constraints.push(HalfSpace { normal, offset: normal.dot(centre) - 0.5 * whole.length() });
        objective += whole * random.below(3) as f64;
    }
    Program { objective, constraints }
}
