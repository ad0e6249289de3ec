//! Kinds of queries, one a row.

/// Rows of kinds in the order in which they are run: the variant, its seed, and its name in
/// reports, which is one word. Seeds stay as they are, or `fixtures/answers.txt` changes. The
/// documents' tables hold the instructions on the boards of those that are `tabled`.
macro_rules! kinds {
    ($($(#[$doc:meta])* $kind:ident = $seed:literal, $name:literal $(, $tabled:ident)?;)*) => {
        /// What a block asks.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Kind {
            $($(#[$doc])* $kind = $seed,)*
        }

        impl Kind {
            /// All kinds in the order in which they are run.
            pub const ALL: [Self; [$($seed),*].len()] = [$(Self::$kind),*];

            /// The name in reports: one word.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$kind => $name,)*
                }
            }

            /// Whether the documents' tables hold its instructions on the boards.
            #[must_use]
            pub const fn is_tabled(self) -> bool {
                match self {
                    $($(Self::$kind => kinds!(@ $tabled),)?)*
                    _ => false,
                }
            }
        }
    };
    (@ tabled) => { true };
}

kinds! {
    /// The target's own arithmetic.
    Arith = 0, "arith";
    /// What the blob says of itself.
    Contents = 1, "contents";
    /// Closest point from the doubled box.
    ClosestFar = 2, "closest_far", tabled;
    /// Closest point from near the surface.
    ClosestNear = 3, "closest_near", tabled;
    /// Closest point along a path of small steps.
    ClosestPath = 4, "closest_path";
    /// First hit of a segment through the doubled box.
    FirstHit = 5, "first_hit", tabled;
    /// All hits of a segment.
    AllHits = 6, "all_hits";
    /// Outer hits of a segment on the refined hull.
    OuterHits = 7, "outer_hits", tabled;
    /// The hull refined for a focus that moves.
    Refine = 29, "refine";
    /// A sweep that is moved, interrupted, and asked for more triangles.
    Sweep = 30, "sweep";
    /// Closest point of the model under a pose.
    Posed = 31, "posed";
    /// Closest point with tolerances and with too few steps.
    Stopped = 8, "stopped";
    /// Whether the surface is within a distance.
    Within = 9, "within", tabled;
    /// The closest triangles.
    Nearest = 10, "nearest";
    /// All triangles within a distance.
    AllWithin = 11, "all_within";
    /// Distance with a sign.
    Signed = 12, "signed", tabled;
    /// First hit of a segment on fronts, and on backs.
    Facing = 13, "facing";
    /// Whether a segment meets the surface.
    AnyHit = 14, "any_hit";
    /// Closest point along a path of small steps and few jumps, by a coherent query.
    CoherentQuery = 15, "coherent_query";
    /// Triangles that may face an eye.
    Cull = 17, "cull";
    /// Whether the surface meets its moved copy.
    Overlap = 18, "overlap";
    /// All pairs of triangles that meet.
    AllOverlaps = 19, "all_overlaps";
    /// How far the surface is from its moved copy.
    PairDistance = 35, "pair_distance";
    /// How far a capsule is from the surface.
    Solid = 36, "solid";
    /// Where a capsule that moves first meets the surface.
    Contact = 37, "first_contact";
    /// How often the surface encloses a point.
    Winding = 38, "winding";
    /// Which two of three moved copies are nearest.
    Scene = 39, "scene";
    /// How far the surface is from its copy, which moves in small steps.
    CoherentPair = 40, "coherent_pair";
    /// How deep the solid is in its moved copy.
    Penetration = 41, "penetration";
    /// The tribox of eight points.
    TriboxBounds = 20, "tribox_bounds";
    /// The boundary of a tribox.
    TriboxFaces = 21, "tribox_faces";
    /// Whether two triboxes overlap.
    TriboxOverlap = 22, "tribox_overlap";
    /// Whether two boxes overlap, for comparison.
    BoxOverlap = 23, "box_overlap";
    /// All else that triboxes answer.
    TriboxRest = 24, "tribox_rest";
    /// Whether a tribox hierarchy is apart from a moved copy.
    TriboxesApart = 25, "triboxes_apart";
    /// Which of its leaves may meet those of the copy.
    TriboxesCandidates = 26, "triboxes_candidates";
    /// Whether it is farther than a distance from the copy.
    TriboxesWithin = 16, "triboxes_within";
    /// A lower bound of the distance from the doubled box.
    TriboxesDistance = 27, "triboxes_distance";
    /// Where a segment first enters a leaf.
    TriboxesClip = 28, "triboxes_clip";
    /// Closest point between two key frames.
    Frame = 32, "frame";
    /// An update of a moved hull.
    Update = 33, "update";
    /// Closest point of a moved hull.
    Moved = 34, "moved";
    /// Whether the hull at rest, moved, meets itself between two key frames.
    FrameOverlap = 43, "frame_overlap";
    /// Whether the hull at rest, moved, meets itself under a free motion.
    MovedOverlap = 44, "moved_overlap";
    /// First hit, any hit and all hits of a ray through the doubled box.
    Ray = 49, "ray";
    /// Closest point in f64 from near the surface.
    ClosestPrecise = 42, "closest_precise";
    /// The distance of a point of a field, in input units.
    FieldDistance = 45, "field_distance", tabled;
    /// The distance of a point of a field, in whole units.
    FieldUnits = 46, "field_units", tabled;
    /// The distance of a point of a field, and the gradient.
    FieldGradient = 47, "field_gradient", tabled;
    /// The distance of a place far from a field, in whole units.
    FieldBeyond = 48, "field_beyond";
    /// Bounds of the distance with a tolerance, by the field first.
    Bounds = 50, "bounds";
    /// Bounds of the signed distance with a tolerance, by the field first.
    SignedBounds = 51, "signed_bounds";
}

impl Kind {
    /// Whether it asks triboxes of points, without a blob.
    #[must_use]
    pub const fn is_tribox(self) -> bool {
        matches!(
            self,
            Self::TriboxBounds
                | Self::TriboxFaces
                | Self::TriboxOverlap
                | Self::BoxOverlap
                | Self::TriboxRest
        )
    }

    /// The seed of the stream that places its queries.
    #[must_use]
    pub const fn seed(self) -> u64 {
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
