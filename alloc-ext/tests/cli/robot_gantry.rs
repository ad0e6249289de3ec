//! Which links of a gantry are neighbours, and which always meet.

use crate::support::scratch;
use meshsweep::robot::{Robot, RobotOptions};
use std::fmt::Write;
use std::fs;
use std::path::Path;

/// A bed and a tool above it, slides between them, and links without geometry between those.
fn gantry(directory: &Path, height: f64, limits: &[[f64; 2]]) -> Result<Robot, String> {
    let name = |link: usize| match link {
        0 => "bed".to_owned(),
        _ if link == limits.len() => "tool".to_owned(),
        _ => format!("bare{link}"),
    };
    let mut text = "<robot name=\"gantry\">\n".to_owned();
    for (link, size) in [(0, "1 1 0.1"), (limits.len(), "0.2 0.2 0.2")] {
        let shape = format!("<geometry><box size=\"{size}\"/></geometry>");
        let name = name(link);
        let _ = writeln!(text, "<link name=\"{name}\"><collision>{shape}</collision></link>");
    }
    for bare in 1..limits.len() {
        let _ = writeln!(text, "<link name=\"{}\"/>", name(bare));
    }
    for (joint, [low, high]) in limits.iter().enumerate() {
        let (parent, child) = (name(joint), name(joint + 1));
        let at = if joint == 0 { height } else { 0.0 };
        let _ = writeln!(
            text,
            "<joint name=\"{joint}\" type=\"prismatic\"><origin xyz=\"0 0 {at}\"/>\n\
             <parent link=\"{parent}\"/><child link=\"{child}\"/>\n\
             <limit lower=\"{low}\" upper=\"{high}\"/></joint>",
        );
    }
    let file = directory.join("gantry.urdf");
    fs::write(&file, text + "</robot>\n").unwrap();
    let mut options = RobotOptions::default();
    options.keep = 0.01;
    Robot::read(&file, &options).map_err(|error| error.to_string())
}

#[test]
fn links_with_two_moving_joints_between_them_are_no_neighbours() {
    let directory = scratch("robot_gantry");
    let free = [-0.05, 0.05];
    for joints in [2, 3] {
        let robot = gantry(&directory, 0.5, &[free; 3][..joints]).unwrap();
        assert_eq!((robot.pairs.len(), robot.pairs[0].links), (1, [0, 1]));
    }
    let none = "no pair of links keeps a distance";
    assert!(gantry(&directory, 0.5, &[free]).unwrap_err().contains(none));
    // They always meet; but a joint of one place may have others in truth.
    assert!(gantry(&directory, 0.0, &[free; 3]).unwrap_err().contains(none));
    let error = gantry(&directory, 0.0, &[free, [0.0; 2], free]).unwrap_err();
    assert!(error.contains("bed, tool at 0.01"), "{error}");
}
