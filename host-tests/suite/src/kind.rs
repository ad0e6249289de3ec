//! Kinds of queries.

/// What a block asks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The target's own arithmetic.
    Arith,
    /// What the blob says of itself.
    Contents,
    /// Closest point from the doubled box.
    ClosestFar,
    /// Closest point from near the surface.
    ClosestNear,
    /// Closest point along a path of small steps.
    ClosestPath,
    /// First hit of a segment through the doubled box.
    FirstHit,
    /// All hits of such a segment.
    AllHits,
    /// Such a segment on the refined hull.
    OuterHits,
    /// Closest point with tolerances and with too few steps.
    Stopped,
    /// Whether the surface is within a distance.
    Within,
    /// The closest triangles.
    Nearest,
    /// All triangles within a distance.
    AllWithin,
    /// Distance with a sign.
    Signed,
    /// First hit of a segment on fronts, and on backs.
    Facing,
    /// Whether a segment meets the surface.
    AnyHit,
    /// Closest point along a path of small steps and few jumps, by a coherent query.
    CoherentQuery,
    /// Closest points of eight points from the doubled box.
    Batch,
    /// Triangles that may face an eye.
    Cull,
    /// Whether the surface meets its moved copy.
    Overlap,
    /// All pairs of triangles that do.
    AllOverlaps,
    /// The tribox of eight points.
    TriboxBounds,
    /// The boundary of a tribox.
    TriboxFaces,
    /// Whether two triboxes overlap.
    TriboxOverlap,
    /// Whether two boxes do, for comparison.
    BoxOverlap,
    /// All else that triboxes answer.
    TriboxRest,
    /// Whether a tribox hierarchy is apart from a moved copy.
    TriboxesApart,
    /// Which of its leaves may meet those of the copy.
    TriboxesCandidates,
    /// A lower bound of the distance from the doubled box.
    TriboxesDistance,
    /// Where a segment first enters a leaf.
    TriboxesClip,
    /// The hull refined for a focus that moves.
    Refine,
    /// A sweep that is moved, interrupted, and asked for more triangles.
    Sweep,
    /// Closest point of the model under a pose.
    Posed,
    /// Closest point between two key frames.
    Frame,
    /// An update of a moved hull.
    Update,
    /// Closest point of a moved hull.
    Moved,
    /// How far the surface is from its moved copy.
    PairDistance,
    /// How far a capsule is from the surface.
    Solid,
    /// Where a capsule that moves first meets the surface.
    Contact,
    /// How often the surface encloses a point.
    Winding,
    /// Which two of three moved copies are nearest.
    Scene,
    /// How far the surface is from its copy, which moves in small steps.
    CoherentPair,
    /// How deep the solid is in its moved copy.
    Penetration,
    /// Closest point in f64 from near the surface.
    ClosestPrecise,
}

impl Kind {
    /// All kinds in the order in which they are run.
    pub const ALL: [Self; 43] = [
        Self::Arith,
        Self::Contents,
        Self::ClosestFar,
        Self::ClosestNear,
        Self::ClosestPath,
        Self::FirstHit,
        Self::AllHits,
        Self::OuterHits,
        Self::Refine,
        Self::Sweep,
        Self::Posed,
        Self::Stopped,
        Self::Within,
        Self::Nearest,
        Self::AllWithin,
        Self::Signed,
        Self::Facing,
        Self::AnyHit,
        Self::CoherentQuery,
        Self::Batch,
        Self::Cull,
        Self::Overlap,
        Self::AllOverlaps,
        Self::PairDistance,
        Self::Solid,
        Self::Contact,
        Self::Winding,
        Self::Scene,
        Self::CoherentPair,
        Self::Penetration,
        Self::TriboxBounds,
        Self::TriboxFaces,
        Self::TriboxOverlap,
        Self::BoxOverlap,
        Self::TriboxRest,
        Self::TriboxesApart,
        Self::TriboxesCandidates,
        Self::TriboxesDistance,
        Self::TriboxesClip,
        Self::Frame,
        Self::Update,
        Self::Moved,
        Self::ClosestPrecise,
    ];

    /// The name in reports: one word.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Arith => "arith",
            Self::Contents => "contents",
            Self::ClosestFar => "closest_far",
            Self::ClosestNear => "closest_near",
            Self::ClosestPath => "closest_path",
            Self::ClosestPrecise => "closest_precise",
            Self::FirstHit => "first_hit",
            Self::AllHits => "all_hits",
            Self::OuterHits => "outer_hits",
            Self::Stopped => "stopped",
            Self::Within => "within",
            Self::Nearest => "nearest",
            Self::AllWithin => "all_within",
            Self::Signed => "signed",
            Self::Facing => "facing",
            Self::AnyHit => "any_hit",
            Self::CoherentQuery => "coherent_query",
            Self::Batch => "batch_of_8",
            Self::Cull => "cull",
            Self::Overlap => "overlap",
            Self::AllOverlaps => "all_overlaps",
            Self::PairDistance => "pair_distance",
            Self::Solid => "solid",
            Self::Contact => "first_contact",
            Self::Winding => "winding",
            Self::Scene => "scene",
            Self::CoherentPair => "coherent_pair",
            Self::Penetration => "penetration",
            Self::TriboxBounds => "tribox_bounds",
            Self::TriboxFaces => "tribox_faces",
            Self::TriboxOverlap => "tribox_overlap",
            Self::BoxOverlap => "box_overlap",
            Self::TriboxRest => "tribox_rest",
            Self::TriboxesApart => "triboxes_apart",
            Self::TriboxesCandidates => "triboxes_candidates",
            Self::TriboxesDistance => "triboxes_distance",
            Self::TriboxesClip => "triboxes_clip",
            Self::Refine => "refine",
            Self::Sweep => "sweep",
            Self::Posed => "posed",
            Self::Frame => "frame",
            Self::Update => "update",
            Self::Moved => "moved",
        }
    }

    /// Whether it is about triboxes: no blob is asked.
    pub(crate) const fn is_tribox(self) -> bool {
        matches!(
            self,
            Self::TriboxBounds
                | Self::TriboxFaces
                | Self::TriboxOverlap
                | Self::BoxOverlap
                | Self::TriboxRest
        )
    }

    /// Whether it is about a blob's triboxes.
    #[must_use]
    pub const fn is_triboxes(self) -> bool {
        matches!(
            self,
            Self::TriboxesApart
                | Self::TriboxesCandidates
                | Self::TriboxesDistance
                | Self::TriboxesClip
        )
    }

    /// Whether it is about other bodies than points and segments, or about winding numbers.
    #[must_use]
    pub const fn is_apart(self) -> bool {
        matches!(
            self,
            Self::PairDistance
                | Self::Solid
                | Self::Contact
                | Self::Winding
                | Self::Scene
                | Self::CoherentPair
                | Self::Penetration
        )
    }

    /// Whether it is about a hull that deforms.
    #[must_use]
    pub const fn is_deform(self) -> bool {
        matches!(self, Self::Frame | Self::Update | Self::Moved)
    }

    /// Whether the documents' tables hold its instructions on the boards.
    #[must_use]
    pub const fn is_tabled(self) -> bool {
        matches!(
            self,
            Self::ClosestFar
                | Self::ClosestNear
                | Self::FirstHit
                | Self::OuterHits
                | Self::Within
                | Self::Signed
        )
    }

    pub(crate) const fn seed(self) -> u64 {
        0x6d65_7368_7377_6570 ^ ((self as u64) << 56)
    }
}

#[cfg(test)]
mod tests {
    use super::Kind;

    #[test]
    fn kinds_have_names_and_seeds_of_their_own() {
        for (index, a) in Kind::ALL.into_iter().enumerate() {
            for b in Kind::ALL.into_iter().skip(index + 1) {
                assert_ne!(a.name(), b.name());
                assert_ne!(a.seed(), b.seed());
            }
        }
    }
}
