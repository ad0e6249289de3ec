//! What a blob is to serve, the options of its structures, and which of them do not go together.

use super::ranges;
use crate::collapse::{CollapseOptions, Priority};
use crate::error::BuildError;
use crate::hull::BuildOptions;
use crate::load::is_named_as_mesh;
use crate::mesh::Unit;
use crate::number::{ABOVE_ZERO, FROM_ZERO};
use crate::sdf::{BYTES as SDF_BYTES, SdfKind, SdfLayout, SdfOptions};
use crate::surface::VertexBits;
use crate::tight::{ChainOptions, FACES, Goal, MAX_HULLS, Options as TightOptions};
use crate::tribox::{Measure, TriboxOptions};
use std::fmt;
use std::path::Path;

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
    /// Outer hulls of a closed mesh that deforms. With [`Sweep`](Self::Sweep) and without
    /// [`Hull`](Self::Hull): a hierarchy of any mesh that deforms.
    Deform,
    /// Winding numbers, by the box tree.
    Winding,
    /// Bounds of distances, by a look-up in a distance field.
    Sdf,
}

impl For {
    /// All questions.
    pub const ALL: [Self; 11] = [
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
        Self::Sdf,
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
            Self::Sdf => "sdf",
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
    pub asked: Vec<For>,
    pub unit: Option<Unit>,
    pub vertex_bits: VertexBits,
    pub base: Option<u32>,
    pub collapse: CollapseOptions,
    pub triboxes: Option<u32>,
    pub tribox_error: Option<f64>,
    pub orient: Option<Measure>,
    pub extrema: bool,
    pub tight: Vec<u32>,
    pub slack: Option<f64>,
    pub void_percent: Option<f64>,
    pub margin: Option<f64>,
    pub effort: Option<f64>,
    /// Whether tight hulls serve distances, and whether segments.
    pub tight_for: Option<[bool; 2]>,
    pub is_closed: bool,
    pub sdf_bytes: Option<u32>,
    pub sdf_error: Option<f64>,
    pub sdf_relative: Option<f64>,
    pub sdf_kind: Option<SdfKind>,
    pub sdf_layout: Option<SdfLayout>,
    pub sdf_margin: Option<f64>,
}

/// What an option applies to.
#[derive(Clone, Copy)]
enum Of {
    Any,
    Hull,
    /// Hulls of a closed mesh.
    Closed,
    Triboxes,
    Tight,
    Sdf,
}

/// An option of the program.
struct OptionRow {
    /// Its name, with the dashes.
    option: &'static str,
    /// What it applies to.
    of: Of,
    /// The words after the option: none where nothing was asked for. A flag has one empty word.
    words: Vec<String>,
    /// The words as numbers, if they have a range.
    numbers: Vec<f64>,
    /// The least and the greatest that each number may be.
    range: [f64; 2],
}

impl OptionRow {
    fn words<T: ToString>(
        option: &'static str,
        of: Of,
        values: impl IntoIterator<Item = T>,
    ) -> Self {
        let words = values.into_iter().map(|value| value.to_string()).collect();
        Self { option, of, words, numbers: vec![], range: [0.0; 2] }
    }

    fn numbers<N: Copy + Into<f64>>(
        option: &'static str,
        of: Of,
        values: impl IntoIterator<Item = N>,
        range: [N; 2],
    ) -> Self {
        let numbers: Vec<f64> = values.into_iter().map(N::into).collect();
        let words = Self::words(option, of, &numbers);
        Self { numbers, range: range.map(N::into), ..words }
    }
}

impl fmt::Display for Options {
    /// As the program's options, but for those with their defaults.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let given = self.rows().into_iter().filter(|row| !row.words.is_empty());
        let texts = given.map(|row| match row.words.join(",").as_str() {
            "" => row.option.to_owned(),
            words => format!("{} {words}", row.option),
        });
        f.write_str(&texts.collect::<Vec<_>>().join(" "))
    }
}

impl Options {
    pub fn serves(&self, question: For) -> bool {
        match self.asked.as_slice() {
            [] => matches!(question, For::Closest | For::Segment),
            asked => asked.contains(&question),
        }
    }

    /// Whether the blob holds hulls of a closed mesh.
    pub fn wants_solid(&self) -> bool {
        self.serves(For::Hull) || (self.serves(For::Deform) && !self.serves(For::Sweep))
    }

    pub fn wants_hierarchy(&self) -> bool {
        [For::Hull, For::Sweep, For::Deform].iter().any(|&of| self.serves(of))
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

    /// Whether the box tree's vertices are to be f32.
    pub fn is_f32(&self) -> bool {
        self.vertex_bits.is_f32_in_tree()
    }

    pub fn of_hull(&self) -> BuildOptions<'static> {
        BuildOptions {
            base_faces: self.base_faces() as usize,
            priority: self.collapse.priority.unwrap_or_default(),
            conditions: self.collapse.conditions(),
            vertex_bits: self.vertex_bits,
            ..BuildOptions::default()
        }
    }

    /// With an error, as many triboxes as it takes.
    pub fn of_triboxes(&self) -> TriboxOptions {
        let most = if self.tribox_error.is_some() { ranges::TRIBOX_COUNT[1] } else { TRIBOXES };
        TriboxOptions::new(self.triboxes.unwrap_or(most))
            .with_error(self.tribox_error)
            .with_orient(self.orient)
            .with_extrema(self.extrema)
    }

    pub fn of_tight(&self) -> ChainOptions {
        let [closest, segments] = self.tight_for.unwrap_or([true; 2]);
        ChainOptions {
            faces: self.tight.iter().map(|&faces| faces as usize).collect(),
            hull: TightOptions::new(self.goal())
                .with_margin(self.margin.unwrap_or(0.0))
                .with_effort(self.effort.unwrap_or(1.0))
                .with_vertex_bits(self.vertex_bits),
            closest,
            segments,
        }
    }

    pub fn of_sdf(&self) -> SdfOptions {
        let [_, most] = ranges::SDF_BYTES;
        let bytes = if self.sdf_error.is_some() { most } else { SDF_BYTES };
        SdfOptions::default()
            .with_bytes(self.sdf_bytes.unwrap_or(bytes))
            .with_error(self.sdf_error)
            .with_relative(self.sdf_relative.unwrap_or(0.0))
            .with_kind(self.sdf_kind)
            .with_layout(self.sdf_layout)
            .with_margin(self.sdf_margin)
    }

    /// The goal of the one tight hull, where no numbers of faces are asked for.
    fn goal(&self) -> Goal {
        let void = self.void_percent.map(|percent| Goal::Void(percent / 100.0));
        void.or(self.slack.map(Goal::Slack)).unwrap_or_default()
    }

    /// All options, one row each: name, what it applies to, value, range. The range of slack, void
    /// and margin is in [`Goal::check`].
    fn rows(&self) -> [OptionRow; 26] {
        let bits = Some(self.vertex_bits).filter(|&bits| bits != VertexBits::Auto);
        let collapse = &self.collapse;
        let [closest, segment] = self.tight_for.unwrap_or_default();
        let asked = [closest.then_some(For::Closest), segment.then_some(For::Segment)];
        [
            OptionRow::words("--for", Of::Any, &self.asked),
            OptionRow::words("--unit", Of::Any, self.unit.map(Unit::symbol)),
            OptionRow::words("--vertex-bits", Of::Any, bits),
            OptionRow::numbers("--base", Of::Hull, self.base, ranges::BASE_FACES),
            OptionRow::numbers(
                "--max-valence",
                Of::Hull,
                collapse.max_valence,
                ranges::MAX_VALENCE,
            ),
            OptionRow::numbers(
                "--compactness",
                Of::Hull,
                collapse.compactness,
                ranges::COMPACTNESS,
            ),
            OptionRow::numbers(
                "--max-normal-deviation",
                Of::Hull,
                collapse.max_normal_deviation,
                ranges::NORMAL_DEVIATION,
            ),
            OptionRow::words("--priority", Of::Closed, collapse.priority.map(Priority::name)),
            OptionRow::words("--order", Of::Closed, collapse.order.map(|order| order.to_string())),
            OptionRow::numbers("--triboxes", Of::Triboxes, self.triboxes, ranges::TRIBOX_COUNT),
            OptionRow::numbers("--tribox-error", Of::Triboxes, self.tribox_error, ABOVE_ZERO),
            OptionRow::words("--orient", Of::Triboxes, self.orient.map(Measure::name)),
            OptionRow::words("--extrema", Of::Triboxes, self.extrema.then_some("")),
            OptionRow::numbers(
                "--tight",
                Of::Tight,
                self.tight.iter().copied(),
                ranges::TIGHT_FACES,
            ),
            OptionRow::words("--slack", Of::Tight, self.slack),
            OptionRow::words("--void", Of::Tight, self.void_percent),
            OptionRow::words("--margin", Of::Tight, self.margin),
            OptionRow::words("--tight-for", Of::Tight, asked.into_iter().flatten()),
            OptionRow::numbers("--effort", Of::Tight, self.effort, ranges::EFFORT),
            OptionRow::numbers("--sdf", Of::Sdf, self.sdf_bytes, ranges::SDF_BYTES),
            OptionRow::numbers("--sdf-error", Of::Sdf, self.sdf_error, ABOVE_ZERO),
            OptionRow::numbers("--sdf-rel", Of::Sdf, self.sdf_relative, FROM_ZERO),
            OptionRow::words("--sdf-kind", Of::Sdf, self.sdf_kind.map(SdfKind::name)),
            OptionRow::words("--sdf-layout", Of::Sdf, self.sdf_layout.map(SdfLayout::name)),
            OptionRow::numbers("--sdf-margin", Of::Sdf, self.sdf_margin, FROM_ZERO),
            OptionRow::words("--closed", Of::Any, self.is_closed.then_some("")),
        ]
    }

    /// Refuses options out of range, and options that do not go together.
    pub fn check(&self, of: Subject<'_>, has_frames: bool) -> Result<(), BuildError> {
        let is_mesh = match of {
            Subject::File(file) => is_named_as_mesh(file),
            Subject::Mesh => true,
            Subject::Curves => false,
        };
        let is_curve = self.is_curve(of);
        let is_grid = matches!(self.vertex_bits, VertexBits::Grid16 | VertexBits::Grid24);
        let [slack, void] = [self.slack, self.void_percent].map(|goal| goal.is_some());
        let rules = [
            (
                self.serves(For::Curve) && is_mesh,
                "--for curve",
                "needs a .csv; leave it out for a mesh",
            ),
            (
                is_curve && self.asked.iter().any(|&other| other != For::Curve),
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
                self.sdf_relative.is_some() && self.sdf_error.is_none(),
                "--sdf-rel",
                "adds to an error; give --sdf-error too",
            ),
            (slack && void, "--slack", "and --void are two goals; leave one of them out"),
            (
                slack && !self.tight.is_empty(),
                "--slack",
                "and --tight are two goals; leave one of them out",
            ),
            (
                void && !self.tight.is_empty(),
                "--void",
                "and --tight are two goals; leave one of them out",
            ),
        ];
        let rows = self.rows();
        let without_use = rows
            .iter()
            .filter(|row| !row.words.is_empty())
            .filter_map(|row| self.lacks(row.of).map(|why| (true, row.option, why)));
        let broken = rules.into_iter().chain(without_use).find(|&(is_broken, ..)| is_broken);
        if let Some((_, option, why)) = broken {
            return Err(BuildError::Option { option, why });
        }
        if self.tight.len() > MAX_HULLS {
            return Err(BuildError::TooManyHulls { most: MAX_HULLS });
        }
        for OptionRow { option, numbers, range, .. } in &rows {
            numbers
                .iter()
                .try_for_each(|&number| BuildError::check_range(option, number, *range))?;
        }
        // As it was asked for: the goal has a part in place of a percentage.
        if let Some(void) = self.void_percent {
            BuildError::check_range("--void", void, ABOVE_ZERO)?;
        }
        self.goal().check(self.margin.unwrap_or(0.0))
    }

    /// The reason to refuse an option, if it applies to a structure that is not built.
    fn lacks(&self, of: Of) -> Option<&'static str> {
        let (is_served, why) = match of {
            Of::Any => return None,
            Of::Hull => (self.wants_hierarchy(), "is for a hull; add hull to --for"),
            Of::Closed => (self.wants_solid(), "is for outer hulls; add hull to --for"),
            Of::Triboxes => (self.serves(For::Triboxes), "is for triboxes; add triboxes to --for"),
            Of::Tight => (self.serves(For::Tight), "is for tight hulls; add tight to --for"),
            Of::Sdf => (self.serves(For::Sdf), "is for a distance field; add sdf to --for"),
        };
        (!is_served).then_some(why)
    }
}
