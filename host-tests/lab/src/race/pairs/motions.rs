//! Motions of a mesh past itself, and what is true of them.

use glam::DVec3;
use meshsweep::bvh::{TreeOptions, build};
use meshsweep::progress::Watch;
use meshsweep_core::{Budget, Bvh, Pose, ScratchEntry};
use meshsweep_host_tests::oracle::Bounded;
use meshsweep_host_tests::workload::Subject;
use meshsweep_host_tests::workload::contact::Surface;
use meshsweep_host_tests::workload::pose::{Pose as Motion, poses, sphere};
use parry3d::math::Pose as ParryPose;
use rayon::prelude::*;

use crate::measure::rival::parry;

/// Random motions that are looked at for each that is wanted.
const TRIED: usize = 40;

/// The gap that is left of motions near contact, as a part of the distance of the random motion.
const LEFT: f64 = 0.01;

/// A motion as each engine takes it, and what is true of it.
pub struct Case {
    /// parry3d's.
    pub parry: ParryPose,
    /// As the library takes it.
    pub pose: Pose,
    /// The same motion in f64, for FCL.
    pub near: Motion,
    /// The distance; 0 where the surfaces meet.
    pub truth: Bounded,
}

/// Cases of one kind.
pub struct Group {
    /// In tables.
    pub name: &'static str,
    /// The motions.
    pub cases: Vec<Case>,
    /// They meet, so only overlap is asked about.
    pub is_meeting: bool,
}

/// A blob of the mesh.
pub fn blob(subject: &Subject, is_f32: bool) -> Vec<u8> {
    let options = TreeOptions::default().with_closest(false).with_f32(is_f32);
    let input = meshsweep::mesh::Input {
        input_triangles: subject.triangles_read,
        ..subject.mesh.as_input()
    };
    build(input, &options, Watch::NONE).expect("builds").0.to_bytes()
}

/// Up to `wanted` random motions that are apart, as many after most of the way to contact, and as
/// many that meet. A motion by less than the distance meets nothing.
///
/// # Errors
/// The library's refusal of a motion.
pub fn groups(subject: &Subject, wanted: usize) -> Result<[Group; 3], String> {
    let blob = blob(subject, true);
    let tree = Bvh::open(&blob).map_err(|error| error.to_string())?;
    let surface = Surface::new(subject);
    let (mut apart, mut closer, mut meeting) = (Vec::new(), Vec::new(), Vec::new());
    for (near, pose) in poses(&sphere(subject), wanted * TRIED) {
        if apart.len() >= wanted && meeting.len() >= wanted {
            break;
        }
        let mut stack = [ScratchEntry::EMPTY; Bvh::DISTANCE_ENTRIES];
        let found = tree.distance_to(&tree, pose, Budget::EXACT, &mut stack);
        let found = found.map_err(|error| error.to_string())?;
        if found.distance.lower > 0.0 {
            if apart.len() < wanted {
                let [from, to] = found.points.map(|p| DVec3::from_array(p.map(f64::from)));
                let closer_by = (to - from) * (1.0 - LEFT);
                let near_contact = Motion { shift: near.shift - closer_by, ..near };
                let core = near_contact.rounded();
                apart.push((near, pose));
                closer.push((Motion::exact(&core, &near_contact), core));
            }
        } else if meeting.len() < wanted && surface.meets_exactly(&pose, &near) {
            meeting.push((near, pose));
        }
    }
    let met = Bounded { lower: 0.0, upper: 0.0 };
    let case = |near: Motion, pose, truth| Case { parry: parry(&near), pose, near, truth };
    let measured = |motions: Vec<(Motion, Pose)>| -> Result<Vec<Case>, String> {
        let one = |(near, pose): (Motion, Pose)| {
            let mut stack = [ScratchEntry::EMPTY; Bvh::DISTANCE_ENTRIES];
            let found = tree.distance_to(&tree, pose, Budget::EXACT, &mut stack);
            let limit = f64::from(found.map_err(|error| error.to_string())?.distance.upper) * 1.001;
            // Beyond the limit the truth is infinite, and no answer holds it.
            Ok(case(near, pose, surface.distance_up_to(&pose, &near, limit)))
        };
        motions.into_par_iter().map(one).collect()
    };
    let meeting = meeting.into_iter().map(|(near, pose)| case(near, pose, met)).collect();
    Ok([
        Group { name: "apart", cases: measured(apart)?, is_meeting: false },
        Group { name: "near contact", cases: measured(closer)?, is_meeting: false },
        Group { name: "meeting", cases: meeting, is_meeting: true },
    ])
}
