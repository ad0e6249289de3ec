//! A robot as a Rust module.

use super::assembled::Robot;
use super::link::Link;
use super::mechanism::Place;
use super::pairs::RobotPair;
use crate::emit::source::{SourceNames, in_comment, rust_items, rust_name};
use crate::number::Short;
use meshsweep_core::{Joint, JointAxis, JointKind, RoundedPose};
use std::collections::HashSet;
use std::fmt::Write;

/// What firmware includes.
#[derive(Clone, Debug)]
pub struct RobotSource {
    /// The module, to be written to a file that is named by the stem and `.rs`.
    pub module: String,
    /// The name of each link's blob, without folders.
    pub blobs: Vec<String>,
}

impl Robot {
    /// The robot as a Rust module, for files whose names begin with `stem`. `file` is the name of
    /// the description, without folders. The same robot and names give the same text.
    #[must_use]
    pub fn source(&self, stem: &str, file: &str) -> RobotSource {
        let mut taken = HashSet::new();
        let modules: Vec<String> = self.links.iter().map(|link| unique(link, &mut taken)).collect();
        let blobs: Vec<String> = modules.iter().map(|name| format!("{stem}_{name}.msw")).collect();
        let mut out = self.head(stem, file);
        for ((link, name), blob) in self.links.iter().zip(&modules).zip(&blobs) {
            let names = SourceNames { mesh: file, blob };
            let items = rust_items(&link.built.blob(), names);
            let _ =
                write!(out, "\n/// The link `{}`.\npub mod {name} {{\n", in_comment(&link.name));
            for line in items.lines() {
                let indent = if line.is_empty() { "" } else { "    " };
                let _ = writeln!(out, "{indent}{line}");
            }
            out.push_str("}\n");
        }
        self.tables(&mut out);
        self.functions(&mut out, &modules);
        RobotSource { module: out, blobs }
    }

    fn head(&self, stem: &str, file: &str) -> String {
        let module = rust_name(stem);
        let path = if module == stem {
            String::new()
        } else {
            format!("#[path = {:?}] ", format!("{stem}.rs"))
        };
        let mut out = format!(
            "// The robot `{}` of `{}`: links, joints, and the pairs that keep a distance.\n//\n\
             // Written by `meshsweep robot`. Keep it and the blobs of the links in one folder, and write\n\
             // `{path}mod {module};` in a crate that depends on `meshsweep-core` {}. Lengths are in\n\
             // metres, angles in radians.\n//\n\
             // let mut scratch = Scratch::<{{ Bvh::DISTANCE_ENTRIES }}>::new();\n\
             // let pairs = {module}::pairs(&[0.01; {links}]); // The links' allowances: see below.\n\
             // let mut scene = CoherentScene::new({module}::links(&{module}::poses(&places)?)?, pairs)?;\n\
             // let mut ask = |places: &[f32; {places}]| {{\n\
             //     for (link, found) in {module}::poses(places)?.iter().enumerate() {{\n\
             //         scene.move_to(link, found.pose)?;\n\
             //     }}\n\
             //     scene.within(Budget::EXACT, &mut scratch)\n\
             // }};\n\
             // // In each tick. An error stops the robot too.\n\
             // if !ask(&places).is_ok_and(|found| found.is_clear()) {{\n\
             //     stop();\n\
             // }}\n//\n\
             // The distances of `PAIRS` have room for the rounding of `poses` (`ROUNDING`), and for nothing\n\
             // else. `pairs` adds an allowance of each link. It is the sum of how far the link may be from\n\
             // its pose, or go:\n\
             // - encoders, calibration: the angle times the reach beyond the joint, for all joints before it\n\
             // - age of the reading, and motion until the next verdict: the largest speed times the time\n\
             // - braking: the way from the verdict until the robot stands\n\
             // - links that bend, cables, and all that the collision geometry lacks\n//\n\
             // Not guarded:\n",
            in_comment(&self.name),
            in_comment(file),
            env!("CARGO_PKG_VERSION"),
            links = self.links.len(),
            places = self.places.len(),
        );
        for link in &self.without_geometry {
            let _ = writeln!(out, "// - {}: no collision geometry", in_comment(link));
        }
        for (pair, why) in &self.skipped {
            let [a, b] = pair.map(|link| in_comment(&self.links[link].name));
            let _ = writeln!(out, "// - {a} and {b}: {why}");
        }
        let _ = write!(
            out,
            "\nuse meshsweep_core::{{\n    {}KeptPair, PlacedModel, Pose, QueryError, RoundedPose, link_poses,\n}};\n",
            self.imports(),
        );
        out
    }

    fn imports(&self) -> &'static str {
        let moves = self.joints.iter().any(|joint| joint.kind != JointKind::Fixed);
        if moves { "Joint, JointAxis, JointKind, " } else { "Joint, JointKind, " }
    }

    fn tables(&self, out: &mut String) {
        let (links, places) = (self.links.len(), self.places.len());
        let mut table = |about: &str, head: String, lines: Vec<String>| {
            let allowed = "clippy::approx_constant, clippy::excessive_precision, dead_code";
            let _ = write!(out, "\n{about}\n#[allow({allowed})]\n{head} = [\n");
            lines.iter().for_each(|line| out.push_str(&format!("    {line},\n")));
            out.push_str("];\n");
        };
        let names = self.links.iter().map(|link| format!("{:?}", link.name)).collect();
        table(
            "/// Links with geometry, as `PAIRS` counts them.",
            format!("pub const LINKS: [&str; {links}]"),
            names,
        );
        let names = self.places.iter().map(|place| format!("{:?}", place.joint)).collect();
        table(
            "/// Joints, in the order of the places.",
            format!("pub const PLACES: [&str; {places}]"),
            names,
        );
        let limits =
            |place: &Place| format!("[{:?}, {:?}]", place.limits[0] as f32, place.limits[1] as f32);
        let limits = self.places.iter().map(limits).collect();
        table(
            "/// Lowest and highest place of each joint, rounded. Nothing checks them.",
            format!("pub const LIMITS: [[f32; 2]; {places}]"),
            limits,
        );
        let numbers = |of: fn(&Link) -> f32| {
            self.links.iter().map(|link| format!("{:?}", of(link))).collect()
        };
        table(
            "/// No point of a link is farther from the origin of its frame.",
            format!("pub const RADII: [f32; {links}]"),
            numbers(|link| link.radius),
        );
        table(
            "/// Rounding of each link's pose that the distances of its pairs have room for.",
            format!("pub const ROUNDING: [f32; {links}]"),
            numbers(|link| link.rounding),
        );
        let pair = |pair: &RobotPair| {
            let [a, b] = pair.links;
            format!(
                "// {} and {}: {}\n    KeptPair {{ models: [{a}, {b}], distance: {:?} }}",
                in_comment(&self.links[a].name),
                in_comment(&self.links[b].name),
                Short(pair.keep as f32),
                pair.distance
            )
        };
        let pairs = self.pairs.iter().map(pair).collect();
        table(
            "/// Pairs that keep a distance, without allowances.",
            format!("pub const PAIRS: [KeptPair; {}]", self.pairs.len()),
            pairs,
        );
        let joints = self.joints.iter().map(joint).collect();
        table(
            "/// The joints; those that are fixed are part of the next ones.",
            format!("pub static JOINTS: [Joint; {}]", self.joints.len()),
            joints,
        );
    }

    fn functions(&self, out: &mut String, modules: &[String]) {
        let (links, places, joints) = (self.links.len(), self.places.len(), self.joints.len());
        let pairs = self.pairs.len();
        let picked: Vec<String> =
            self.links.iter().map(|link| format!("all[{}]", link.joint)).collect();
        let placed = |(at, name): (usize, &String)| {
            format!("        PlacedModel::new({name}::TREE, poses[{at}].pose)?,\n")
        };
        let placed: String = modules.iter().enumerate().map(placed).collect();
        let _ = write!(
            out,
            "\n/// Where the links are in the world, at these places.\n///\n\
             /// # Errors\n\
             /// Those of `link_poses`. `QueryError::OutOfDomain` also where a pose is rounded by more than\n\
             /// `ROUNDING`: far outside of the limits.\n\
             #[allow(dead_code)]\n\
             pub fn poses(places: &[f32; {places}]) -> Result<[RoundedPose; {links}], QueryError> {{\n    \
                 let mut all = [RoundedPose::exact(Pose::IDENTITY); {joints}];\n    \
                 link_poses(&JOINTS, places, &mut all)?;\n    \
                 let links = [{}];\n    \
                 let mut room = links.iter().zip(RADII.iter().zip(&ROUNDING));\n    \
                 if room.all(|(pose, (radius, rounding))| pose.motion(*radius) <= *rounding) {{\n        \
                     Ok(links)\n    \
                 }} else {{\n        \
                     Err(QueryError::OutOfDomain)\n    \
                 }}\n}}\n\n\
             /// The links for `Scene` and `CoherentScene`.\n///\n\
             /// # Errors\n\
             /// Those of `PlacedModel::new`.\n\
             #[allow(dead_code)]\n\
             pub fn links(poses: &[RoundedPose; {links}]) -> Result<[PlacedModel<'static>; {links}], QueryError> {{\n    \
                 Ok([\n{placed}    ])\n}}\n\n\
             /// `PAIRS`, each farther apart by the allowances of its two links. Their signs do not count.\n\
             #[allow(dead_code)]\n\
             pub fn pairs(allowances: &[f32; {links}]) -> [KeptPair; {pairs}] {{\n    \
                 let mut all = PAIRS;\n    \
                 for pair in &mut all {{\n        \
                     for model in pair.models {{\n            \
                         if let Some(more) = allowances.get(usize::from(model)) {{\n                \
                             // No less than the exact sum.\n                \
                             pair.distance = (pair.distance + more.abs()).next_up();\n            \
                         }}\n        \
                     }}\n    \
                 }}\n    \
                 all\n}}\n",
            picked.join(", "),
        );
    }
}

/// A name for a module and a file that no other link has.
fn unique(link: &Link, taken: &mut HashSet<String>) -> String {
    let name = rust_name(&link.name);
    let numbered = (2..).map(|number| format!("{name}_{number}"));
    let free = std::iter::once(name.clone()).chain(numbered).find(|name| !taken.contains(name));
    let free = free.unwrap_or(name);
    taken.insert(free.clone());
    free
}

fn joint(joint: &Joint) -> String {
    let Joint { parent, origin, kind } = joint;
    let RoundedPose { pose, turn, shift, .. } = origin;
    let kind = match kind {
        JointKind::Fixed => "JointKind::Fixed".to_owned(),
        JointKind::Turns(of) => format!("JointKind::Turns({})", axis(of)),
        JointKind::Slides(of) => format!("JointKind::Slides({})", axis(of)),
    };
    format!(
        "Joint {{\n        parent: {parent:?},\n        origin: RoundedPose::within(\n            \
         Pose::rigid(\n                {:?},\n                {:?},\n            ),\n            \
         {turn:?},\n            {shift:?},\n        ),\n        kind: {kind},\n    }}",
        pose.rotation, pose.translation,
    )
}

fn axis(axis: &JointAxis) -> String {
    let JointAxis { direction, place, follows } = axis;
    match follows {
        None => format!("JointAxis::new({direction:?}, {place})"),
        Some(_) => format!(
            "JointAxis {{ direction: {direction:?}, place: {place}, follows: {follows:?} }}"
        ),
    }
}
