//! Links of mechanisms: none is farther off than its pose says, and what is no mechanism is
//! refused. The truth is computed in f64: points are turned by Rodrigues' formula, link by link.

use std::f64::consts::FRAC_PI_2;

use meshsweep_core::internal::num::half_turn;
use meshsweep_core::{Joint, JointAxis, JointKind, Pose, QueryError, RoundedPose, link_poses};
use meshsweep_host_tests::generate::Rng;

use crate::poses::{Point, carried, cross, dot, points, pose, used};

const U: f64 = f32::EPSILON as f64 / 2.0;

/// Of the errors of a sine and a cosine the root of the sum of squares, in u.
fn error(angle: f32) -> f64 {
    let [sine, cosine] = half_turn(angle).expect("in the domain").map(f64::from);
    let (s, c) = (0.5 * f64::from(angle)).sin_cos();
    (sine - s).hypot(cosine - c) / U
}

#[test]
fn sines_and_cosines_of_half_angles_are_within_their_bound() {
    let mut rng = Rng::new(1);
    let any = (0..2_000_000).map(|_| {
        let most = [8192.0f32, 100.0, 7.0, 1.0, 1e-3, 1e-30][rng.below(6)];
        rng.range(-most, most)
    });
    // Next to all multiples of a quarter turn, where both parts of the reduction cancel.
    let quarters = (-5216..=5216).flat_map(|quarters: i32| {
        let next = (f64::from(quarters) * FRAC_PI_2) as f32;
        [next.next_down(), next, next.next_up()]
    });
    let powers = (0..140).map(|by| 8192.0 * 0.5f32.powi(by)).flat_map(|x| [x, -x, x.next_down()]);
    let zeros = [0.0, -0.0, f32::MIN_POSITIVE, f32::from_bits(1)];
    let all = any.chain(quarters).chain(powers).chain(zeros);
    let worst = all.filter(|x| x.abs() <= 8192.0).map(error).fold(0.0, f64::max);
    assert!((1.2..2.2).contains(&worst), "{worst}");
    for none in [8192.0f32.next_up(), -1e30, f32::INFINITY, f32::NEG_INFINITY, f32::NAN] {
        assert_eq!(half_turn(none), None);
    }
}

#[test]
#[ignore = "all 1.2 billion angles from 0: minutes. Those below are the same, mirrored"]
fn sines_and_cosines_of_all_half_angles_are_within_their_bound() {
    let most = 8192.0f32.to_bits();
    let worst = (0..=most).map(|bits| error(f32::from_bits(bits))).fold(0.0, f64::max);
    println!("worst: {worst} u");
    assert!(worst < 2.2);
    let mirrored = |angle: f32| {
        let [[sine, cosine], [other, same]] = [angle, -angle].map(|x| half_turn(x).expect("in"));
        sine == -other && cosine == same
    };
    assert!((0..=most).all(|bits| mirrored(f32::from_bits(bits))));
}

/// A joint as it truly is.
struct True {
    joint: Joint,
    axis: Point,
    factor: f64,
    offset: f64,
}

impl True {
    fn new(rng: &mut Rng, index: usize) -> Self {
        let parent = (index > 0 && rng.below(8) > 0).then(|| rng.below(index) as u16);
        let along = [0, 1, 2].map(|_| f64::from(rng.range(-1.0, 1.0)));
        let length = dot(along, along).sqrt();
        let axis = [along.map(|x| x / length), [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]][rng.below(3)];
        let any = (f64::from(rng.range(-2.0, 2.0)) / 3.0, f64::from(rng.range(-1.0, 1.0)) / 3.0);
        let follows = (rng.below(3) == 0).then(|| {
            [any, (any.0, 0.0), (1.00000005, 0.0), (3.0 * 0.33333333333, 0.0)][rng.below(4)]
        });
        let (factor, offset) = follows.unwrap_or((1.0, 0.0));
        let of_axis = JointAxis {
            follows: follows.map(|(factor, offset)| [factor as f32, offset as f32]),
            ..JointAxis::new(axis.map(|x| x as f32), rng.below(3) as u16)
        };
        let kinds = [JointKind::Fixed, JointKind::Turns(of_axis), JointKind::Slides(of_axis)];
        let kind = kinds[rng.below(5).min(3) % 3];
        Self {
            joint: Joint { parent, origin: RoundedPose::exact(pose(rng).pose), kind },
            axis,
            factor,
            offset,
        }
    }

    /// A point of the link in the frame of its parent.
    fn carried(&self, places: &[f32], point: Point) -> Point {
        let moved = match self.joint.kind {
            JointKind::Fixed => point,
            JointKind::Turns(axis) => {
                let place = f64::from(places[usize::from(axis.place)]);
                let (sine, cosine) = (self.factor * place + self.offset).sin_cos();
                let (across, along) = (cross(self.axis, point), dot(self.axis, point));
                [0, 1, 2].map(|k: usize| {
                    point[k] * cosine + across[k] * sine + self.axis[k] * along * (1.0 - cosine)
                })
            }
            JointKind::Slides(axis) => {
                let place = f64::from(places[usize::from(axis.place)]);
                let way = self.factor * place + self.offset;
                [0, 1, 2].map(|k: usize| point[k] + self.axis[k] * way)
            }
        };
        carried(&self.joint.origin.pose, moved)
    }
}

#[test]
fn no_link_is_farther_off_than_its_pose_says() {
    let (mut rng, mut most) = (Rng::new(2), 0f64);
    for _ in 0..4_000 {
        let arm: Vec<True> = (0..1 + rng.below(9)).map(|at| True::new(&mut rng, at)).collect();
        let joints: Vec<Joint> = arm.iter().map(|of| of.joint).collect();
        let far = [1.0f32, 4.0, 1e-6, 3000.0][rng.below(4)];
        let places = [0; 3].map(|_| rng.range(-far, far));
        let mut found = vec![RoundedPose::exact(Pose::IDENTITY); arm.len()];
        link_poses(&joints, &places, &mut found).expect("a mechanism");
        for (link, found) in found.iter().enumerate() {
            for (radius, point) in points(&mut rng) {
                let (mut truth, mut at) = (point, Some(link));
                while let Some(link) = at {
                    truth = arm[link].carried(&places, truth);
                    at = arm[link].joint.parent.map(usize::from);
                }
                most = most.max(used(found, radius, point, truth));
            }
        }
    }
    assert!(most > 0.05, "{most}");
}

#[test]
fn a_joint_that_follows_another_by_a_rounded_factor_of_1_is_not_taken_as_exact() {
    for (factor, kind) in [1.00000005, 3.0 * 0.33333333333]
        .into_iter()
        .flat_map(|factor| [JointKind::Turns, JointKind::Slides].map(|kind| (factor, kind)))
    {
        assert_eq!(factor as f32, 1.0);
        let axis = JointAxis { follows: Some([1.0, 0.0]), ..JointAxis::new([0.0, 0.0, 1.0], 0) };
        let origin = RoundedPose::exact(Pose::IDENTITY);
        let of_axis = True {
            joint: Joint { parent: None, origin, kind: kind(axis) },
            axis: [0.0, 0.0, 1.0],
            factor,
            offset: 0.0,
        };
        let mut found = [origin];
        link_poses(&[of_axis.joint], &[8000.0], &mut found).expect("a mechanism");
        used(&found[0], 1.0, [1.0, 0.0, 0.0], of_axis.carried(&[8000.0], [1.0, 0.0, 0.0]));
    }
}

#[test]
fn what_is_no_mechanism_is_refused() {
    let still = RoundedPose::exact(Pose::IDENTITY);
    let axis = JointAxis::new([0.0, 1.0, 0.0], 0);
    let joint = |parent, kind| Joint { parent, origin: still, kind };
    let ask = |joints: &[Joint], places: &[f32]| {
        link_poses(joints, places, &mut [still; 2][..joints.len()])
    };
    let turns = |axis| [joint(None, JointKind::Turns(axis))];
    assert_eq!(ask(&turns(axis), &[1.0]), Ok(()));
    assert_eq!(link_poses(&turns(axis), &[1.0], &mut []), Err(QueryError::NoJoint));
    assert_eq!(ask(&turns(axis), &[]), Err(QueryError::NoJoint));
    for parent in [1, 2, u16::MAX] {
        let loose = [joint(None, JointKind::Fixed), joint(Some(parent), JointKind::Fixed)];
        assert_eq!(ask(&loose, &[]), Err(QueryError::NoJoint));
    }
    for direction in [[0.0; 3], [0.0, 1.00001, 0.0], [1.0, 1.0, 0.0]] {
        let long = JointAxis { direction, ..axis };
        assert_eq!(ask(&turns(long), &[1.0]), Err(QueryError::NotRigid));
    }
    let lost = JointAxis { direction: [0.0, f32::NAN, 0.0], ..axis };
    assert_eq!(ask(&turns(lost), &[1.0]), Err(QueryError::NotFinite));
    for kind in [JointKind::Turns(axis), JointKind::Slides(axis)] {
        assert_eq!(ask(&[joint(None, kind)], &[f32::NAN]), Err(QueryError::NotFinite));
    }
    assert_eq!(ask(&turns(axis), &[8192.5]), Err(QueryError::OutOfDomain));
    assert_eq!(ask(&[joint(None, JointKind::Slides(axis))], &[8192.5]), Ok(()));
}
