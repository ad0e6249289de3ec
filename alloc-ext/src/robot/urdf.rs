//! The elements of a robot's description: links with collision shapes, and joints.

use super::shape::Shape;
use crate::error::BuildError;
use crate::mesh::{Document, MeshError, Placement, text_of};
use std::collections::HashSet;
use std::path::Path;

/// A part of a link's collision geometry.
pub(super) struct Collision {
    pub(super) shape: Shape,
    /// In the link's frame.
    pub(super) placement: Placement,
    pub(super) line: usize,
}

pub(super) struct Link {
    pub(super) name: String,
    pub(super) collisions: Vec<Collision>,
    pub(super) line: usize,
}

/// How a joint moves, as the file says.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Moves {
    Not,
    Turns,
    Slides,
}

/// The joint that this one follows.
pub(super) struct Follows {
    pub(super) joint: String,
    pub(super) factor: f64,
    pub(super) offset: f64,
}

pub(super) struct UrdfJoint {
    pub(super) name: String,
    pub(super) moves: Moves,
    pub(super) parent: String,
    pub(super) child: String,
    pub(super) origin: Placement,
    /// A unit vector.
    pub(super) axis: [f64; 3],
    pub(super) limits: [f64; 2],
    pub(super) follows: Option<Follows>,
    pub(super) line: usize,
}

/// A description as it was read. Names are unique.
pub(super) struct Urdf {
    pub(super) name: String,
    pub(super) links: Vec<Link>,
    pub(super) joints: Vec<UrdfJoint>,
}

/// Elements of xacro, which are expanded before a description is read.
const XACRO: [&str; 6] = ["macro", "property", "include", "arg", "if", "unless"];

impl Urdf {
    pub(super) fn read(file: &Path, bytes: &[u8]) -> Result<Self, BuildError> {
        let text = text_of(file, bytes).map_err(of_xml)?;
        let document = &Document::parse(file, &text).map_err(of_xml)?;
        let root = Element { document, at: 0 };
        if root.name() != "robot" {
            return Err(root.refused("the root is no <robot>: this is no URDF"));
        }
        if let Some(element) = root.children().find(|child| XACRO.contains(&child.name())) {
            return Err(element.refused("this is xacro; expand it first: xacro FILE > robot.urdf"));
        }
        let links = root.all("link").map(link).collect::<Result<Vec<_>, _>>()?;
        let joints = root.all("joint").map(joint).collect::<Result<Vec<_>, _>>()?;
        let (mut known, mut joint_names) = (HashSet::new(), HashSet::new());
        for (element, link) in root.all("link").zip(&links) {
            if !known.insert(link.name.as_str()) {
                return Err(element.refused("a second link of this name"));
            }
        }
        for (element, joint) in root.all("joint").zip(&joints) {
            if !joint_names.insert(joint.name.as_str()) {
                return Err(element.refused("a second joint of this name"));
            }
            if let Some(none) = [&joint.parent, &joint.child]
                .into_iter()
                .find(|name| !known.contains(name.as_str()))
            {
                return Err(element.refused(&format!("there is no link {none:?}")));
            }
        }
        let name = root.attribute("name").unwrap_or_default().to_owned();
        Ok(Self { name, links, joints })
    }
}

/// Pairs of links that an SRDF disables, each with its reason. Without one the reason is empty.
pub(super) fn disabled_pairs(
    file: &Path,
    bytes: &[u8],
) -> Result<Vec<([String; 2], String)>, BuildError> {
    let text = text_of(file, bytes).map_err(of_xml)?;
    let document = &Document::parse(file, &text).map_err(of_xml)?;
    let root = Element { document, at: 0 };
    if root.name() != "robot" {
        return Err(root.refused("the root is no <robot>: this is no SRDF"));
    }
    let others = ["disable_default_collisions", "enable_collisions"];
    if let Some(other) = root.children().find(|child| others.contains(&child.name())) {
        return Err(other.refused("it is not read; name pairs by disable_collisions"));
    }
    let pair = |element: Element<'_>| {
        let links = [element.wanted("link1")?.to_owned(), element.wanted("link2")?.to_owned()];
        Ok((links, element.attribute("reason").unwrap_or_default().to_owned()))
    };
    root.all("disable_collisions").map(pair).collect()
}

/// Refuses a description, where it stands.
pub(super) fn refused(file: &Path, line: usize, what: String) -> BuildError {
    BuildError::Robot { file: file.to_owned(), line: Some(line), what }
}

/// What is wrong with the XML, without the advice to export a mesh.
fn of_xml(error: MeshError) -> BuildError {
    match error {
        MeshError::Malformed { file, line, place, reason } => {
            BuildError::Robot { file, line, what: format!("{place}: {reason}") }
        }
        MeshError::Unsupported { file, what } => {
            BuildError::Robot { file, line: None, what: format!("{what} is not read") }
        }
        error => BuildError::Mesh { file: Path::new("").to_owned(), error: Box::new(error) },
    }
}

#[derive(Clone, Copy)]
struct Element<'a> {
    document: &'a Document<'a>,
    at: usize,
}

impl<'a> Element<'a> {
    fn name(self) -> &'a str {
        &self.document.nodes[self.at].name
    }

    fn line(self) -> usize {
        self.document.nodes[self.at].line
    }

    fn children(self) -> impl Iterator<Item = Self> + 'a {
        let Self { document, at } = self;
        document.nodes[at].children.iter().map(move |&at| Self { document, at })
    }

    fn all(self, name: &'static str) -> impl Iterator<Item = Self> + 'a {
        self.children().filter(move |child| child.name() == name)
    }

    /// The only child of a name.
    fn child(self, name: &'static str) -> Result<Option<Self>, BuildError> {
        let mut found = self.all(name);
        let first = found.next();
        found.next().map_or(Ok(first), |second| Err(second.refused("a second one")))
    }

    fn attribute(self, name: &str) -> Option<&'a str> {
        self.document.attribute(self.at, name)
    }

    fn wanted(self, name: &str) -> Result<&'a str, BuildError> {
        let value = self.attribute(name).filter(|value| !value.trim().is_empty());
        value.map(str::trim).ok_or_else(|| self.refused(&format!("it has no {name}")))
    }

    /// So many finite numbers, if the attribute is there.
    fn numbers<const N: usize>(self, name: &str) -> Result<Option<[f64; N]>, BuildError> {
        let Some(text) = self.attribute(name) else { return Ok(None) };
        let parsed = text.split_ascii_whitespace().map(|word| word.parse::<f64>().ok());
        let numbers: Option<Vec<f64>> = parsed.map(|x| x.filter(|x| x.is_finite())).collect();
        let numbers = numbers.and_then(|numbers| <[f64; N]>::try_from(numbers).ok());
        let wanted = || {
            let numbers =
                if N == 1 { "one finite number".into() } else { format!("{N} finite numbers") };
            self.refused(&format!("{name} {text:?}: {numbers} wanted"))
        };
        numbers.map(Some).ok_or_else(wanted)
    }

    fn number(self, name: &str) -> Result<Option<f64>, BuildError> {
        Ok(self.numbers::<1>(name)?.map(|[x]| x))
    }

    /// A length above 0.
    fn length(self, name: &str) -> Result<f64, BuildError> {
        let length = self.number(name)?.filter(|&x| x > 0.0);
        length.ok_or_else(|| self.refused(&format!("{name} wants a number above 0")))
    }

    fn refused(self, why: &str) -> BuildError {
        let what = format!("{}: {why}", self.document.place(self.at));
        refused(self.document.file, self.line(), what)
    }
}

fn link(element: Element<'_>) -> Result<Link, BuildError> {
    let name = element.wanted("name")?.to_owned();
    let collisions = element.all("collision").map(collision).collect::<Result<_, _>>()?;
    Ok(Link { name, collisions, line: element.line() })
}

fn collision(element: Element<'_>) -> Result<Collision, BuildError> {
    let missing = |what: &str| element.refused(&format!("it has no {what}"));
    let geometry = element.child("geometry")?.ok_or_else(|| missing("geometry"))?;
    let mut shapes = geometry.children();
    let of = shapes.next().ok_or_else(|| geometry.refused("it is empty"))?;
    if let Some(second) = shapes.next() {
        return Err(second.refused("a second shape; give it a collision of its own"));
    }
    let shape = match of.name() {
        "mesh" => Shape::Mesh {
            file: of.wanted("filename")?.to_owned(),
            scale: of.numbers("scale")?.unwrap_or([1.0; 3]),
        },
        "box" => Shape::Box(of.numbers("size")?.ok_or_else(|| of.refused("it has no size"))?),
        "cylinder" => {
            Shape::Cylinder { radius: of.length("radius")?, length: of.length("length")? }
        }
        "sphere" => Shape::Sphere { radius: of.length("radius")? },
        _ => {
            return Err(
                of.refused("this shape is not read; give a mesh, a box, a cylinder or a sphere")
            );
        }
    };
    if let Shape::Mesh { scale: sizes, .. } | Shape::Box(sizes) = &shape {
        let is_box = matches!(shape, Shape::Box(_));
        if sizes.iter().any(|&x| x == 0.0 || is_box && x < 0.0) {
            return Err(of.refused("a size of 0, or a negative one of a box"));
        }
    }
    let placement = origin(element)?;
    Ok(Collision { shape, placement, line: element.line() })
}

/// Where an element is in its parent.
fn origin(element: Element<'_>) -> Result<Placement, BuildError> {
    let Some(origin) = element.child("origin")? else { return Ok(Placement::IDENTITY) };
    if origin.attribute("quat_xyzw").is_some() {
        return Err(origin.refused("quat_xyzw is not read; write rpy"));
    }
    let [shift, turns] = [origin.numbers("xyz")?, origin.numbers("rpy")?];
    Ok(Placement::of_origin(shift.unwrap_or_default(), turns.unwrap_or_default()))
}

fn joint(element: Element<'_>) -> Result<UrdfJoint, BuildError> {
    let name = element.wanted("name")?.to_owned();
    let kind = element.wanted("type")?;
    let moves = match kind {
        "fixed" => Moves::Not,
        "revolute" | "continuous" => Moves::Turns,
        "prismatic" => Moves::Slides,
        "floating" | "planar" => {
            let why = "it has no place of one number; make it fixed, and put the robot by its pose";
            return Err(element.refused(&format!("{kind}: {why}")));
        }
        _ => return Err(element.refused(&format!("the type {kind:?} is not known"))),
    };
    let end = |name: &'static str| {
        let end =
            element.child(name)?.ok_or_else(|| element.refused(&format!("it has no {name}")))?;
        end.wanted("link").map(str::to_owned)
    };
    let follows = match element.child("mimic")? {
        Some(mimic) if moves != Moves::Not => Some(Follows {
            joint: mimic.wanted("joint")?.to_owned(),
            factor: mimic.number("multiplier")?.unwrap_or(1.0),
            offset: mimic.number("offset")?.unwrap_or(0.0),
        }),
        _ => None,
    };
    let limits = match (element.child("limit")?, kind) {
        _ if moves == Moves::Not || follows.is_some() => [0.0; 2],
        (_, "continuous") => [-std::f64::consts::PI, std::f64::consts::PI],
        (None, _) => return Err(element.refused("it has no limit")),
        (Some(limit), _) => {
            let end = |name: &str| {
                let missing = || limit.refused(&format!("it has no {name}"));
                limit.number(name)?.ok_or_else(missing)
            };
            let [low, high] = [end("lower")?, end("upper")?];
            if low > high {
                return Err(limit.refused("lower is above upper"));
            }
            [low, high]
        }
    };
    let axis = match element.child("axis")? {
        None => [1.0, 0.0, 0.0],
        Some(axis) => {
            let along = axis.numbers("xyz")?.unwrap_or([1.0, 0.0, 0.0]);
            // Divided first, so that no square overflows.
            let most = along.iter().fold(0f64, |most, x| most.max(x.abs()));
            if most == 0.0 && moves != Moves::Not {
                return Err(axis.refused("an axis without length"));
            }
            let scaled = along.map(|x| x / most);
            let length = scaled.iter().map(|x| x * x).sum::<f64>().sqrt();
            scaled.map(|x| x / length)
        }
    };
    let (parent, child, origin) = (end("parent")?, end("child")?, origin(element)?);
    let line = element.line();
    Ok(UrdfJoint { name, moves, parent, child, origin, axis, limits, follows, line })
}
