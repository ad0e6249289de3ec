//! What a question needs of a blob.

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Need {
    Distances,
    Segments,
    Culling,
    Hull,
    Tight,
    TightDistances,
}

impl Need {
    /// The part of the blob.
    pub fn part(self) -> &'static str {
        match self {
            Need::Distances => "box tree for distances",
            Need::Segments => "box tree for segments",
            Need::Culling => "box tree with normal cones",
            Need::Hull => "hull hierarchy",
            Need::Tight => "tight hulls",
            Need::TightDistances => "tight hull for distances",
        }
    }

    /// The value of `build --for` that writes the part.
    pub fn option(self) -> &'static str {
        match self {
            Need::Distances => "closest",
            Need::Segments => "segment",
            Need::Culling => "cull",
            Need::Hull => "hull",
            Need::Tight => "tight",
            Need::TightDistances => "tight --tight-for closest",
        }
    }
}
