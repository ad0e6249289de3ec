//! What a blob is to serve, the options of its structures, and which of them do not go together.

use super::ranges;
use crate::collapse::CollapseOptions;
use crate::error::BuildError;
use crate::hull::BuildOptions;
use crate::load::is_named_as_mesh;
use crate::mesh::Unit;
use crate::surface::VertexBits;
use crate::tight::{ChainOptions, Goal, MAX_HULLS};
use std::fmt;
use std::path::Path;

/// Faces of a hull unless told otherwise.
pub const FACES: u32 = 200;

/// Triboxes unless told otherwise.
pub const TRIBOXES: u32 = 64;

/// A question that a blob serves. `Display` prints the word of the program's `--for`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum For {
    /// Distances and closest points, by the box tree.
    Closest,
    /// Segments, overlap and clearance, by the box tree.
    Segment,
    /// Outer hulls of a closed mesh, refined where a scene needs them. They serve sweeps too.
    Hull,
    /// Distances and segments by a hierarchy of any mesh.
    Sweep,
    /// Culling by normal cones, by the box tree.
    Cull,
    /// Bounds of 18 planes.
    Triboxes,
    /// Hulls of few faces that hold any mesh.
    Tight,
    /// Curves.
    Curve,
    /// Outer hulls of a closed mesh that deforms.
    Deform,
    /// Winding numbers, by the box tree.
    Winding,
}

impl For {
    /// All questions.
    pub const ALL: [Self; 10] = [
        Self::Closest,
        Self::Segment,
        Self::Hull,
        Self::Sweep,
        Self::Cull,
        Self::Triboxes,
        Self::Tight,
        Self::Curve,
        Self::Deform,
        Self::Winding,
    ];

    /// The word of the program's `--for`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Closest => "closest",
            Self::Segment => "segment",
            Self::Hull => "hull",
            Self::Sweep => "sweep",
            Self::Cull => "cull",
            Self::Triboxes => "triboxes",
            Self::Tight => "tight",
            Self::Curve => "curve",
            Self::Deform => "deform",
            Self::Winding => "winding",
        }
    }
}

impl fmt::Display for For {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// What a blob is built from.
#[derive(Clone, Copy)]
pub(super) enum Subject<'a> {
    File(&'a Path),
    Mesh,
    Curves,
}

/// All that was asked for; `None` and no elements where nothing was.
#[derive(Clone, Debug, Default)]
pub(super) struct Options {
    pub serves: Vec<For>,
    pub unit: Option<Unit>,
    pub vertex_bits: VertexBits,
    pub base: Option<u32>,
    pub collapse: CollapseOptions,
    pub triboxes: Option<u32>,
    pub tight: Vec<u32>,
    pub slack: Option<f64>,
    pub void_percent: Option<f64>,
    pub margin: Option<f64>,
    pub effort: Option<f64>,
    /// Whether tight hulls serve distances, and whether segments.
    pub tight_for: Option<[bool; 2]>,
    pub is_closed: bool,
}

impl fmt::Display for Options {
    /// As the program's options, but for those with their defaults.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fn list<T: ToString>(of: &[T]) -> Option<String> {
            let words: Vec<String> = of.iter().map(T::to_string).collect();
            (!words.is_empty()).then(|| words.join(","))
        }
        let count = |of: Option<u32>| of.map(|n| n.to_string());
        let number = |of: Option<f64>| of.map(|x| x.to_string());
        let tight_for = self.tight_for.map_or(vec![], |[closest, segment]| {
            let all = [(closest, For::Closest), (segment, For::Segment)];
            all.into_iter().filter_map(|(is_asked, of)| is_asked.then_some(of)).collect()
        });
        let bits = self.vertex_bits;
        let all = [
            ("--for", list(&self.serves)),
            ("--unit", self.unit.map(|unit| unit.symbol().to_owned())),
            ("--vertex-bits", (bits != VertexBits::Auto).then(|| bits.to_string())),
            ("--base", count(self.base)),
            ("--max-valence", count(self.collapse.max_valence)),
            ("--compactness", number(self.collapse.compactness)),
            ("--max-normal-deviation", number(self.collapse.max_normal_deviation)),
            ("--triboxes", count(self.triboxes)),
            ("--tight", list(&self.tight)),
            ("--slack", number(self.slack)),
            ("--void", number(self.void_percent)),
            ("--margin", number(self.margin)),
            ("--tight-for", list(&tight_for)),
            ("--effort", number(self.effort)),
        ];
        let given = all.into_iter().filter_map(|(name, value)| Some(format!("{name} {}", value?)));
        let closed = self.is_closed.then(|| "--closed".to_owned());
        f.write_str(&given.chain(closed).collect::<Vec<_>>().join(" "))
    }
}

impl Options {
    pub fn serves(&self, question: For) -> bool {
        match self.serves.as_slice() {
            [] => matches!(question, For::Closest | For::Segment),
            asked => asked.contains(&question),
        }
    }

    /// Whether the blob holds hulls of a closed mesh.
    pub fn wants_solid(&self) -> bool {
        self.serves(For::Hull) || self.serves(For::Deform)
    }

    pub fn wants_hierarchy(&self) -> bool {
        self.wants_solid() || self.serves(For::Sweep)
    }

    pub fn wants_tree(&self) -> bool {
        [For::Closest, For::Segment, For::Cull, For::Winding].iter().any(|&of| self.serves(of))
    }

    pub fn is_curve(&self, of: Subject<'_>) -> bool {
        let is_csv = |file: &Path| file.extension().is_some_and(|e| e.eq_ignore_ascii_case("csv"));
        self.serves(For::Curve)
            || matches!(of, Subject::Curves)
            || matches!(of, Subject::File(file) if is_csv(file))
    }

    /// Faces of the base hull.
    pub fn base_faces(&self) -> u32 {
        self.base.unwrap_or(FACES)
    }

    /// Whether the box tree's vertices are to be f32: a tree has no grid of 24 bits.
    pub fn is_f32(&self) -> bool {
        matches!(self.vertex_bits, VertexBits::Grid24 | VertexBits::F32)
    }

    pub fn of_hull(&self) -> BuildOptions<'static> {
        BuildOptions {
            base_faces: self.base_faces() as usize,
            conditions: self.collapse.conditions(),
            vertex_bits: self.vertex_bits,
            ..BuildOptions::default()
        }
    }

    pub fn of_tight(&self) -> ChainOptions {
        let void = self.void_percent.map(|percent| Goal::Void(percent / 100.0));
        let faces: Vec<usize> = self.tight.iter().map(|&faces| faces as usize).collect();
        let [closest, segment] = self.tight_for.unwrap_or([true; 2]);
        void.or(self.slack.map(Goal::Slack))
            .map_or_else(|| ChainOptions::of_faces(&faces), ChainOptions::of_goal)
            .with_margin(self.margin.unwrap_or(0.0))
            .with_effort(self.effort.unwrap_or(1.0))
            .with_vertex_bits(self.vertex_bits)
            .with_boxes(closest, segment)
    }

    /// Refuses options out of range, and options that do not go together.
    pub fn check(&self, of: Subject<'_>, has_frames: bool) -> Result<(), BuildError> {
        let is_mesh = match of {
            Subject::File(file) => is_named_as_mesh(file),
            Subject::Mesh => true,
            Subject::Curves => false,
        };
        let is_curve = self.is_curve(of);
        let is_positive = |x: f64| x > 0.0 && x.is_finite();
        let is_grid = matches!(self.vertex_bits, VertexBits::Grid16 | VertexBits::Grid24);
        let hull = self.hull_option().filter(|_| !self.wants_hierarchy());
        let tight = self.tight_option().filter(|_| !self.serves(For::Tight));
        let rules = [
            (
                self.serves(For::Curve) && is_mesh,
                "--for curve",
                "needs a .csv; leave it out for a mesh",
            ),
            (
                is_curve && self.serves.iter().any(|&other| other != For::Curve),
                "a curve",
                "serves --for curve only; name a mesh for anything else",
            ),
            (self.is_closed && !is_curve, "--closed", "is for curves; add --for curve"),
            (
                self.is_closed && matches!(of, Subject::Curves),
                "--closed",
                "is for curves of a file; set Polyline::is_closed of those in memory",
            ),
            (self.unit.is_some() && is_curve, "--unit", "is for meshes"),
            (hull.is_some(), hull.unwrap_or_default(), "is for a hull; add hull to --for"),
            (
                has_frames && !self.serves(For::Deform),
                "several meshes",
                "are key frames; add --for deform",
            ),
            (
                self.serves(For::Deform) && is_grid,
                "--for deform",
                "keeps the vertices as they are; leave out --vertex-bits",
            ),
            (
                self.triboxes.is_some() && !self.serves(For::Triboxes),
                "--triboxes",
                "is for triboxes; add triboxes to --for",
            ),
            (tight.is_some(), tight.unwrap_or_default(), "is for tight hulls; add tight to --for"),
            (
                self.slack.is_some() && self.void_percent.is_some(),
                "--slack",
                "and --void are two goals; leave one of them out",
            ),
            (
                self.slack.is_some() && !self.tight.is_empty(),
                "--slack",
                "and --tight are two goals; leave one of them out",
            ),
            (
                self.void_percent.is_some() && !self.tight.is_empty(),
                "--void",
                "and --tight are two goals; leave one of them out",
            ),
            (
                self.slack.is_some_and(|slack| !is_positive(slack)),
                "--slack",
                "wants a finite number above 0, in the mesh's unit",
            ),
            (
                self.void_percent.is_some_and(|void| !is_positive(void)),
                "--void",
                "wants a finite percentage above 0",
            ),
            (
                self.margin.is_some_and(|margin| margin != 0.0 && !is_positive(margin)),
                "--margin",
                "wants a finite number from 0, in the mesh's unit",
            ),
        ];
        let broken = rules.into_iter().find(|&(is_broken, ..)| is_broken);
        if let Some((_, option, why)) = broken {
            return Err(BuildError::Option { option, why });
        }
        if self.tight.len() > MAX_HULLS {
            return Err(BuildError::TooManyHulls { most: MAX_HULLS });
        }
        self.check_ranges()?;
        self.slack.map_or(Ok(()), |slack| Goal::Slack(slack).check(self.margin.unwrap_or(0.0)))
    }

    /// Refuses numbers out of range.
    fn check_ranges(&self) -> Result<(), BuildError> {
        let collapse = &self.collapse;
        let counts = [
            ("--base", self.base, ranges::BASE_FACES),
            ("--triboxes", self.triboxes, ranges::TRIBOX_COUNT),
            ("--max-valence", collapse.max_valence, ranges::MAX_VALENCE),
        ];
        let counts = counts.into_iter().chain(
            // One rule for each hull.
            self.tight.iter().map(|&faces| ("--tight", Some(faces), ranges::TIGHT_FACES)),
        );
        let numbers = [
            ("--effort", self.effort, ranges::EFFORT),
            ("--compactness", collapse.compactness, ranges::COMPACTNESS),
            ("--max-normal-deviation", collapse.max_normal_deviation, ranges::NORMAL_DEVIATION),
        ];
        counts
            .map(|(option, given, range)| (option, given.map(f64::from), range.map(f64::from)))
            .chain(numbers)
            .try_for_each(|(option, given, [least, most])| match given {
                Some(found) if !(least..=most).contains(&found) => {
                    Err(BuildError::OutOfRange { option, found, least, most })
                }
                _ => Ok(()),
            })
    }

    /// The first given option that applies to the hull hierarchy only.
    fn hull_option(&self) -> Option<&'static str> {
        if self.base.is_some() { Some("--base") } else { self.collapse.given() }
    }

    /// The first given option that applies to tight hulls only.
    fn tight_option(&self) -> Option<&'static str> {
        [
            ("--tight", !self.tight.is_empty()),
            ("--slack", self.slack.is_some()),
            ("--void", self.void_percent.is_some()),
            ("--margin", self.margin.is_some()),
            ("--effort", self.effort.is_some()),
            ("--tight-for", self.tight_for.is_some()),
        ]
        .into_iter()
        .find_map(|(option, is_given)| is_given.then_some(option))
    }
}
