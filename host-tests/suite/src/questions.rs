//! Questions, one a row: their measured function, the boxes they need, and how many descents a call
//! takes. Rows of kinds are in `kind.rs`. How a kind is asked is a row beside the functions of its
//! structure, in `ask`.

use super::kind::Kind;

/// The question that is asked most.
pub const CLOSEST: &str = "closest point";

/// A question, as the tables name it.
#[derive(Clone, Copy, Debug)]
pub struct Question {
    /// Its name.
    pub name: &'static str,
    /// What a blob has to have, as the builder's table of stacks names it.
    pub needs: &'static str,
    /// The function in `ask`, of the structure whose image asks it.
    pub function: &'static str,
    /// Kinds of queries that call the function; none of opening.
    pub kinds: &'static [Kind],
    /// Kinds that ask the same in another way, by a function whose stack is not in the tables.
    pub variants: &'static [Kind],
    /// Most descents of one call to a box tree, whatever its bytes. `None` if two trees are asked,
    /// or none: pairs of nodes are bounded by the steps of the budget alone.
    pub descents: Option<u32>,
}

impl Question {
    const fn with_variants(self, variants: &'static [Kind]) -> Self {
        Self { variants, ..self }
    }

    const fn with_descents(self, descents: u32) -> Self {
        Self { descents: Some(descents), ..self }
    }

    /// The question to a box tree that queries of a kind ask.
    #[must_use]
    pub fn of_tree_kind(kind: Kind) -> Option<&'static Self> {
        let mut of_trees = QUESTIONS.iter().filter(|question| question.is_of_tree());
        of_trees.find(|question| question.all_kinds().any(|of| of == kind))
    }

    /// All kinds of queries that ask it.
    pub fn all_kinds(&self) -> impl Iterator<Item = Kind> {
        self.kinds.iter().chain(self.variants).copied()
    }

    /// Whether a box tree is asked.
    #[must_use]
    pub fn is_of_tree(&self) -> bool {
        matches!(self.subject(), "tree" | "apart")
    }

    /// The module of `ask` that asks it.
    #[must_use]
    pub fn subject(&self) -> &'static str {
        self.function.split("::").next().unwrap_or_default()
    }
}

const fn question(
    name: &'static str,
    needs: &'static str,
    function: &'static str,
    kinds: &'static [Kind],
) -> Question {
    // The builder's table of stacks is a CSV without quotes.
    let bytes = name.as_bytes();
    let mut at = 0;
    while at < bytes.len() {
        assert!(bytes[at] != b',', "a question's name has no comma");
        at += 1;
    }
    Question { name, needs, function, kinds, variants: &[], descents: None }
}

/// All questions.
pub const QUESTIONS: &[Question] = &[
    question("open a box tree", "tree", "tree::open", &[]),
    question(CLOSEST, "closest", "tree::distance::closest", &[Kind::ClosestFar, Kind::ClosestNear])
        .with_variants(&[Kind::Stopped])
        .with_descents(1),
    question(
        "closest point from a hint",
        "closest",
        "tree::distance::follow",
        &[Kind::ClosestPath],
    )
    .with_descents(1),
    question("closest point in f64", "closest", "tree::distance::precise", &[Kind::ClosestPrecise])
        .with_descents(3),
    question("coherent query", "closest", "tree::distance::coherent", &[Kind::CoherentQuery])
        .with_descents(4),
    question("within", "closest", "tree::distance::is_within", &[Kind::Within]).with_descents(1),
    question("nearest triangles", "closest", "tree::distance::nearest", &[Kind::Nearest])
        .with_descents(1),
    question("all within", "closest", "tree::distance::all_within", &[Kind::AllWithin])
        .with_descents(1),
    // Up to eleven places, each with four descents: `core/src/bvh/point/side/signed_distance.rs`.
    question("signed distance", "closest", "tree::distance::signed", &[Kind::Signed])
        .with_descents(44),
    // Up to six passes, one for each of `RATIOS` in `core/src/bvh/winding/search.rs`.
    question("winding number", "winding", "apart::winding", &[Kind::Winding]).with_descents(6),
    question("front facing", "cull", "tree::sight::cull", &[Kind::Cull]).with_descents(1),
    question("first hit", "segment", "tree::sight::first_hit", &[Kind::FirstHit])
        .with_variants(&[Kind::Facing])
        .with_descents(1),
    question("any hit", "segment", "tree::sight::any_hit", &[Kind::AnyHit]).with_descents(1),
    question("all hits", "segment", "tree::sight::all_hits", &[Kind::AllHits]).with_descents(1),
    question("ray", "segment", "tree::sight::ray", &[Kind::Ray]).with_descents(1),
    question("overlap", "segment", "tree::meeting::overlap", &[Kind::Overlap])
        .with_variants(&[Kind::AllOverlaps]),
    question("distance of two models", "segment", "apart::distance", &[Kind::PairDistance]),
    question("coherent pair", "segment", "apart::coherent", &[Kind::CoherentPair]),
    question("scene", "segment", "apart::scene", &[Kind::Scene]),
    // A triangle is bounded in f32 and computed in f64.
    question("distance of a solid", "segment", "apart::solid", &[Kind::Solid]).with_descents(2),
    // A triangle that may stop the solid takes up to some sixty distances, each of two descents.
    question("first contact", "segment", "apart::contact", &[Kind::Contact]).with_descents(140),
    question("penetration", "winding", "apart::penetration", &[Kind::Penetration]),
    question("open tight hulls", "tight", "tight::open", &[]),
    question(
        "closest point of tight hulls",
        "tight",
        "tight::closest",
        &[Kind::ClosestFar, Kind::ClosestNear],
    ),
    question("within of tight hulls", "tight", "tight::is_within", &[Kind::Within]),
    question("open a hull hierarchy", "hull", "hull::open", &[]),
    question(
        "closest point of a hull",
        "hull",
        "hull::closest",
        &[Kind::ClosestFar, Kind::ClosestNear, Kind::ClosestPath],
    ),
    question("first hit of a hull", "hull", "hull::first_hit", &[Kind::FirstHit]),
    question("ray of a hull", "hull", "hull::ray", &[Kind::Ray]),
    question("outer hits", "hull", "hull::outer_hits", &[Kind::OuterHits]),
    question("refine", "hull", "hull::refine", &[Kind::Refine]),
    question("sweep", "hull", "hull_moving::sweep", &[Kind::Sweep]),
    question("open triboxes", "triboxes", "triboxes::open", &[]),
    question("triboxes apart", "triboxes", "triboxes::reject", &[Kind::TriboxesApart]),
    question("within of triboxes", "triboxes", "triboxes::within", &[Kind::TriboxesWithin]),
    question("open a distance field", "sdf", "sdf::open", &[]),
    question("distance of a field", "sdf", "sdf::distance", &[Kind::FieldDistance, Kind::Signed]),
    question("distance of a field in units", "sdf", "sdf::in_units", &[Kind::FieldUnits])
        .with_variants(&[Kind::FieldBeyond]),
    question("distance and gradient of a field", "sdf", "sdf::gradient", &[Kind::FieldGradient]),
    question("within of a field", "sdf", "sdf::is_within", &[Kind::Within]),
    question("field-first within", "both", "both::is_within", &[Kind::Within]).with_descents(1),
    question("field-first bounds", "both", "both::bounded", &[Kind::Bounds]).with_descents(1),
    question("field-first signed bounds", "both", "both::signed_bounded", &[Kind::SignedBounds])
        .with_descents(44),
    question("open curves", "curve", "curve::open", &[]),
    question(
        "closest point of curves",
        "curve",
        "curve::closest",
        &[Kind::ClosestFar, Kind::ClosestNear],
    ),
    question("sweep of curves", "curve", "curve::sweep", &[Kind::Sweep]),
    question("nearest segments of curves", "curve", "curve::nearest", &[Kind::Nearest]),
    question("all within of curves", "curve", "curve::all_within", &[Kind::AllWithin]),
    question("signed distance of curves", "curve", "curve::signed", &[Kind::Signed]),
];

/// Questions whose code is measured, each by an image `size_*` of its own, and their names in
/// tables.
pub const SIZES: &[(&str, &str)] = &[
    ("tree_open", "open a box tree"),
    ("tree_alone", "closest point"),
    ("tree_alone_two", "closest point, first hit"),
    ("tree_alone_four", "closest point, first hit, within, signed distance"),
    ("tree_closest", "open, closest point"),
    ("tree_segment", "open, first hit"),
    ("tree_coherent", "open, coherent query"),
    ("tree_four", "open, closest point, first hit, within, signed distance"),
    ("scene", "a scene that remembers, within"),
    ("tight", "open tight hulls, within"),
    ("triboxes", "open triboxes, apart"),
    ("curve", "open curves, closest point"),
    ("sdf", "open a distance field, distance"),
    ("open", "open a hull hierarchy"),
    ("closest", "open a hull hierarchy, closest point"),
    ("segment", "open a hull hierarchy, first hit"),
    ("outer", "open a hull hierarchy, outer hits"),
];
