//! Answers of yes or no, and the reasons for neither.

/// Why a question is undecided. For collision avoidance, treat an undecided answer as a contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Undecided {
    /// The steps of the budget were used up.
    Steps,
    /// The scratch memory was too short.
    Scratch,
    /// The stored precision is not enough: vertices were moved to a grid, the blob was cut after a
    /// coarser level, a tight hull stands for the mesh, or rounding does not decide.
    Resolution,
    /// The side is not defined: the mesh is not closed, or its winding is inconsistent.
    OpenMesh,
    /// The point is so near to the surface, or to a line of a fence, that no side is certain.
    OnSurface,
    /// The closest features disagree about the side, or have no certain normal.
    Feature,
}

impl core::fmt::Display for Undecided {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Undecided::Steps => "the steps were used up",
            Undecided::Scratch => "the scratch memory was too short",
            Undecided::Resolution => "the stored precision leaves it open",
            Undecided::OpenMesh => "the mesh is not closed and consistently wound",
            Undecided::OnSurface => "the point is too near to the surface",
            Undecided::Feature => "the closest features have no certain side",
        })
    }
}

/// An answer about the input mesh in real arithmetic. `Yes` and `No` are proved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Verdict {
    /// Proved.
    Yes,
    /// The opposite is proved.
    No,
    /// Neither is proved.
    Undecided(Undecided),
}

/// On which side of a surface a point lies. `Inside` and `Outside` are proved. By the [winding
/// number](crate::WindingNumber) they mean above and below ½. Of a fence they mean allowed and
/// forbidden ([`Curve::signed_distance`](crate::Curve::signed_distance)).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Side {
    /// The nearest surface has its back to the point.
    Inside,
    /// The nearest surface has its front to the point.
    Outside,
    /// Neither is proved.
    Undecided(Undecided),
}
