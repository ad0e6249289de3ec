//! Poses of quaternions, products and inverses: none is farther off than it says, and what is no
//! rotation is refused. The truth is computed in f64, by other formulas.

use meshsweep_core::{
    Budget, CoherentPair, Motion, PlacedModel, Pose, QueryError, RoundedPose, ScratchEntry,
};
use meshsweep_host_tests::generate::{Rng, cube};
use meshsweep_host_tests::scene::Scene;

pub type Point = [f64; 3];

pub fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub fn dot(a: Point, b: Point) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

fn apart(a: Point, b: Point) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
}

/// A point turned by a quaternion: twice the cross products (not the matrix).
fn turned(quaternion: [f32; 4], p: Point) -> Point {
    let q = quaternion.map(f64::from);
    let most = q.iter().fold(0f64, |most, x| most.max(x.abs()));
    let q = q.map(|x| x / most);
    let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    let [x, y, z, w] = q.map(|x| x / length);
    let once = cross([x, y, z], p).map(|x| 2.0 * x);
    let twice = cross([x, y, z], once);
    [0, 1, 2].map(|k: usize| p[k] + w * once[k] + twice[k])
}

/// A point carried by a pose, whose numbers are exact.
pub fn carried(pose: &Pose, p: Point) -> Point {
    [0, 1, 2]
        .map(|k: usize| dot(pose.rotation[k].map(f64::from), p) + f64::from(pose.translation[k]))
}

/// The point that a pose carries to `p`, by Cramer's rule.
fn back(pose: &Pose, p: Point) -> Point {
    let column = |k: usize| [0, 1, 2].map(|row: usize| f64::from(pose.rotation[row][k]));
    let [a, b, c] = [0, 1, 2].map(column);
    let q = [0, 1, 2].map(|k: usize| p[k] - f64::from(pose.translation[k]));
    let whole = dot(a, cross(b, c));
    [dot(q, cross(b, c)) / whole, dot(a, cross(q, c)) / whole, dot(a, cross(b, q)) / whole]
}

fn quaternion(rng: &mut Rng) -> [f32; 4] {
    let of_length = [1.0, 1e-40, 1e-30, 1e-15, 1e15, 1e30, 1e38][rng.below(7)];
    let part = |rng: &mut Rng| rng.range(-1.0, 1.0) * [1.0, 1.0, 1e-4, 0.0][rng.below(4)];
    let mut all = [0; 4].map(|_| part(rng));
    all[rng.below(4)] = rng.range(0.5, 1.0);
    all.map(|x| x * of_length)
}

fn shift(rng: &mut Rng) -> [f32; 3] {
    let far = [0.0, 1.0, 1e-20, 1e6][rng.below(4)];
    [0; 3].map(|_| rng.range(-far, far))
}

pub fn pose(rng: &mut Rng) -> RoundedPose {
    let q = quaternion(rng);
    let translation = shift(rng);
    Pose::of_quaternion(q, translation).expect("finite and not zero")
}

/// Points within a radius of the origin.
pub fn points(rng: &mut Rng) -> impl Iterator<Item = (f32, Point)> {
    let all: Vec<(f32, Point)> = [0.0, 1e-3, 1.0, 1e3]
        .map(|radius: f32| {
            let direction = rng.direction().map(f64::from);
            let length = dot(direction, direction).sqrt();
            (radius, direction.map(|x| x / length * f64::from(radius)))
        })
        .to_vec();
    all.into_iter()
}

/// That a point is where it should be, up to what the pose says; the part of it that is used.
pub fn used(found: &RoundedPose, radius: f32, point: Point, truth: Point) -> f64 {
    let (off, most) = (apart(carried(&found.pose, point), truth), found.motion(radius));
    // The truth's own rounding.
    let slack = 1e-13 * truth.iter().map(|x| x.abs()).sum::<f64>();
    assert!(off <= f64::from(most) + slack, "{found:?} {point:?}: {off:e} {most:e}");
    off / f64::from(most)
}

#[test]
fn quaternions_of_any_length_give_rotations_no_farther_off_than_they_say() {
    let (mut rng, mut most) = (Rng::new(1), 0f64);
    for _ in 0..20_000 {
        let (q, translation) = (quaternion(&mut rng), shift(&mut rng));
        let found = Pose::of_quaternion(q, translation).expect("finite and not zero");
        for (radius, point) in points(&mut rng) {
            let truth = turned(q, point);
            let truth = [0, 1, 2].map(|k: usize| truth[k] + f64::from(translation[k]));
            most = most.max(used(&found, radius, point, truth));
        }
        // A rotation: it can be asked about.
        assert!(found.pose.inverse().is_ok(), "{q:?}");
    }
    assert!(most > 0.05, "{most}");
}

#[test]
fn quaternions_that_are_none_are_refused() {
    for at in 0..4 {
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let mut q = [0.0, 0.0, 0.0, 1.0];
            q[at] = bad;
            assert_eq!(Pose::of_quaternion(q, [0.0; 3]), Err(QueryError::NotFinite));
        }
    }
    let whole = [0.0, 0.0, 0.0, 1.0];
    let lost = Pose::of_quaternion(whole, [0.0, f32::NAN, 0.0]);
    assert_eq!(lost, Err(QueryError::NotFinite));
    assert_eq!(Pose::of_quaternion([0.0; 4], [0.0; 3]), Err(QueryError::NotRigid));
    assert_eq!(Pose::of_quaternion(whole, [0.0; 3]).map(|found| found.pose), Ok(Pose::IDENTITY));
    // The least and the largest numbers: half a turn about an axis.
    for length in [f32::from_bits(1), f32::MIN_POSITIVE, f32::MAX] {
        let half = Pose::of_quaternion([0.0, length, 0.0, 0.0], [0.0; 3]).expect("not zero");
        assert_eq!(half.pose.rotation, [[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]]);
    }
}

#[test]
fn a_chain_of_products_is_no_farther_off_than_it_says() {
    let mut rng = Rng::new(2);
    for _ in 0..3_000 {
        // From the hand to the world; the exact chain carries points link by link.
        let links: Vec<RoundedPose> =
            (0..6).map(|_| RoundedPose::exact(pose(&mut rng).pose)).collect();
        let mut chain = RoundedPose::exact(Pose::IDENTITY);
        for link in &links {
            chain = chain.then(link);
            for (radius, point) in points(&mut rng) {
                let along = links.iter().take_while(|other| !std::ptr::eq(*other, link));
                let truth = along.chain([link]).fold(point, |p, link| carried(&link.pose, p));
                used(&chain, radius, point, truth);
            }
        }
    }
}

#[test]
fn inverses_and_relative_poses_are_no_farther_off_than_they_say() {
    let mut rng = Rng::new(3);
    for round in 0..10_000 {
        let [mut a, mut b] = [pose(&mut rng), pose(&mut rng)];
        if round % 3 == 0 {
            // Matrices of four decimals.
            for entry in a.pose.rotation.iter_mut().flatten() {
                *entry = (*entry * 1e4).round() / 1e4;
            }
        }
        // Both poses are known up to something.
        let (turn, off) = (rng.range(0.0, 1e-3), rng.range(0.0, 1e-3));
        let known = [a, b].map(|exact| RoundedPose::within(exact.pose, turn, off));
        for found in [a.pose.relative_to(&b.pose), known[0].relative_to(&known[1])] {
            let found = found.expect("rotations");
            for (radius, point) in points(&mut rng) {
                used(&found, radius, point, back(&b.pose, carried(&a.pose, point)));
            }
        }
        let found = a.pose.inverse().expect("a rotation");
        for (radius, point) in points(&mut rng) {
            used(&found, radius, point, back(&a.pose, point));
        }
        // What they are known up to is used: the exact poses are others.
        let moved = |pose: &Pose, rng: &mut Rng| {
            let mut moved = *pose;
            moved.translation[rng.below(3)] += 0.9 * off;
            moved
        };
        (a.pose, b.pose) = (moved(&a.pose, &mut rng), moved(&b.pose, &mut rng));
        let (found, chain) = (known[0].relative_to(&known[1]), known[0].then(&known[1]));
        let found = found.expect("rotations");
        for (radius, point) in points(&mut rng) {
            used(&found, radius, point, back(&b.pose, carried(&a.pose, point)));
            used(&chain, radius, point, carried(&b.pose, carried(&a.pose, point)));
        }
    }
}

#[test]
fn what_is_no_rotation_has_no_inverse() {
    let scaled = |by: f32| Pose::rigid([[by, 0.0, 0.0], [0.0, by, 0.0], [0.0, 0.0, by]], [0.0; 3]);
    let mirror = Pose::rigid([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]], [0.0; 3]);
    for bad in [scaled(0.0), scaled(1.02), scaled(-1.0), mirror, scaled(1e30)] {
        assert_eq!(bad.inverse(), Err(QueryError::NotRigid));
        assert_eq!(Pose { is_affine: true, ..bad }.inverse(), Err(QueryError::NotRigid));
        assert_eq!(Pose::IDENTITY.relative_to(&bad), Err(QueryError::NotRigid));
    }
    assert_eq!(scaled(f32::NAN).inverse(), Err(QueryError::NotFinite));
    let vague = RoundedPose::within(Pose::IDENTITY, 0.3, 0.0);
    assert_eq!(vague.inverse(), Err(QueryError::NotRigid));
    assert!(Pose::IDENTITY.then(&Pose { is_affine: true, ..mirror }).pose.is_affine);
}

/// A forgotten pose is all zeros, and a mesh that it moves is a point: often far from the other.
#[test]
fn questions_about_two_models_refuse_what_is_no_rotation_unless_it_may_be_any() {
    let scene = Scene::both("", cube(2));
    let scaled =
        |by: f32| Pose::rigid([[by, 0.0, 0.0], [0.0, by, 0.0], [0.0, 0.0, by]], [9.0, 0.0, 0.0]);
    let mirror = Pose::rigid([[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], [9.0, 0.0, 0.0]);
    let mut shear = scaled(1.0);
    shear.rotation[0][1] = 0.01;
    let exact = Budget::EXACT;
    for tree in scene.trees() {
        let stack = &mut [ScratchEntry::EMPTY; 512];
        let mut ask = |pose: Pose| {
            let at = Pose { translation: [-9.0, 0.0, 0.0], ..Pose::IDENTITY };
            let mut still = PlacedModel::new(tree, at).expect("a rotation");
            let pair = &mut CoherentPair::<64>::new();
            let motion = Motion::straight(pose, pose);
            [
                tree.overlap(&tree, pose, exact, stack).map(|_| ()),
                tree.all_overlaps(&tree, pose, &mut [], exact, stack).map(|_| ()),
                tree.distance_to(&tree, pose, exact, stack).map(|_| ()),
                tree.within_of(&tree, pose, 1.0, exact, stack).map(|_| ()),
                pair.distance(&tree, &tree, pose, exact, stack).map(|_| ()),
                pair.within(&tree, &tree, pose, 1.0, exact, stack).map(|_| ()),
                tree.first_contact_of(&tree, &motion, 1.0, exact, stack).map(|_| ()),
                PlacedModel::new(tree, pose).map(|_| ()),
                still.move_to(pose),
            ]
        };
        for bad in [scaled(0.0), scaled(1.02), scaled(0.98), mirror, shear] {
            assert_eq!(ask(bad), [Err(QueryError::NotRigid); 9], "{bad:?}");
        }
        for fine in [scaled(1.02), scaled(0.98), mirror, shear] {
            assert_eq!(ask(Pose { is_affine: true, ..fine }), [Ok(()); 9], "{fine:?}");
        }
        // Rounded to three decimals.
        let third = [[0.926, -0.378, 0.0], [0.378, 0.926, 0.0], [0.0, 0.0, 1.0]];
        assert_eq!(ask(Pose::rigid(third, [9.0, 0.0, 0.0])), [Ok(()); 9]);
    }
}
