//! Why a function refused: negative numbers, and their texts.

use core::ffi::CStr;

use meshsweep_core::{OpenError, QueryError};

macro_rules! errors {
    ($($(#[$doc:meta])* $name:ident = $code:literal, $text:literal;)*) => {
        /// Why a function refused. The numbers are those of `meshsweep.h`.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Error {
            $($(#[$doc])* $name = $code,)*
        }

        impl Error {
            /// All of them.
            pub const ALL: &[Error] = &[$(Error::$name),*];

            /// Its meaning and a remedy.
            pub fn text(code: i32) -> &'static CStr {
                match code {
                    0 => c"no error",
                    $($code => $text,)*
                    _ => c"no error of meshsweep",
                }
            }
        }
    };
}

errors! {
    /// A pointer is NULL.
    Null = -1, c"a pointer is NULL";
    /// A pointer is misaligned.
    Alignment = -2, c"a pointer is not aligned for its type";
    /// A storage holds no opened model.
    NotOpened = -3, c"the model was not opened, or its open function failed";
    /// An array is larger than memory.
    Count = -4,
        c"a count of elements is larger than memory or a limit, a solid has no corner, or a mesh \
          too few vertices";
    /// A constant is unknown.
    Value = -5, c"a facing or a kind of focus or motion is none of the named constants";
    /// Memory of a refined hull or a scene.
    Memory = -6,
        c"a refined hull needs MSW_REFINED_ENTRIES(splits) entries, zeroed, always as many; \
          a scene MSW_SCENE_ENTRIES(models, pairs); a moved hull msw_deform_records";
    /// A tight hull that is not there.
    NoSuchHull = -7, c"the blob has no tight hull of this number";

    /// The blob is cut short.
    Truncated = -20, c"the blob is cut short";
    /// The blob has too many bytes.
    TrailingBytes = -21, c"the blob has more bytes than its header announces";
    /// Other bytes.
    NotABlob = -22, c"not a meshsweep blob";
    /// Another major version.
    Version = -23, c"another major version of the format: build the blob again";
    /// A CRC is wrong.
    Crc = -24, c"the blob is damaged: a CRC is wrong";
    /// The content is malformed.
    Malformed = -25, c"the blob is malformed: its bytes contradict each other";
    /// The structure is not in the blob.
    MissingSection = -26, c"the blob was built without this structure: see build --for";

    /// NaN or infinity.
    NotFinite = -40, c"a coordinate is NaN or infinite";
    /// A tolerance, distance or radius.
    Tolerance = -41, c"a tolerance, a distance or a radius is negative, NaN, infinite or too large";
    /// Too far away.
    OutOfDomain = -42, c"a point, a segment's end or a model is too far away: clip segments first";
    /// A pose that nothing can be computed with.
    Pose = -43,
        c"a pose's matrix is no rotation (all zeros, for one), or its translation is too large";
    /// No scratch memory.
    NoScratch = -44, c"the scratch memory has no entries";
    /// The blob lacks sections.
    NotServed = -45,
        c"the blob was built without the sections of this question: see build --for";
    /// A fault of the library.
    Internal = -46, c"the bytes of the blob changed, or a fault of the library";
    /// A model that a scene lacks.
    NoModel = -47, c"a pair or a move names a model that the scene lacks, or a pair one twice";
    /// Curves that bound no area of a plane.
    NotPlanar = -48, c"the curve's points differ in z, so it bounds no area: give all the same z";
    /// A polyline that is not closed.
    OpenPolyline = -49, c"a polyline is not closed, so it bounds no area: build with --closed";
    /// A frame that the blob lacks.
    NoFrame = -50, c"a key frame is not in the blob: 0 to msw_deform_frames - 1";
    /// Vertices without places.
    NoPose = -51, c"the last update of the vertices was refused: update them again";
    /// A ray without a direction.
    NoDirection = -52, c"the direction of a ray is zero";
}

impl Error {
    /// The number that a function returns.
    pub const fn code(self) -> i32 {
        self as i32
    }
}

/// 0, or the number of the error.
pub(crate) fn code(run: impl FnOnce() -> Result<(), Error>) -> i32 {
    run().map_or_else(Error::code, |()| 0)
}

impl From<OpenError> for Error {
    fn from(error: OpenError) -> Error {
        match error {
            OpenError::Truncated { .. } => Error::Truncated,
            OpenError::TrailingBytes { .. } => Error::TrailingBytes,
            OpenError::NotABlob => Error::NotABlob,
            OpenError::Version { .. } => Error::Version,
            OpenError::Crc { .. } => Error::Crc,
            OpenError::MissingSection { .. } => Error::MissingSection,
            _ => Error::Malformed,
        }
    }
}

impl From<QueryError> for Error {
    fn from(error: QueryError) -> Error {
        match error {
            QueryError::NotFinite => Error::NotFinite,
            QueryError::Corners { .. } => Error::Count,
            QueryError::Tolerance => Error::Tolerance,
            QueryError::OutOfDomain => Error::OutOfDomain,
            QueryError::PoseOutOfDomain | QueryError::NotRigid => Error::Pose,
            QueryError::NoScratch => Error::NoScratch,
            QueryError::NoModel => Error::NoModel,
            QueryError::NotPlanar => Error::NotPlanar,
            QueryError::OpenPolyline { .. } => Error::OpenPolyline,
            QueryError::NoFrame { .. } => Error::NoFrame,
            QueryError::NoPose => Error::NoPose,
            QueryError::VertexRecords { .. } => Error::Memory,
            QueryError::VertexOutOfDomain { .. } => Error::OutOfDomain,
            QueryError::NoDirection => Error::NoDirection,
            QueryError::NotServed { .. } | QueryError::NotEnclosing => Error::NotServed,
            _ => Error::Internal,
        }
    }
}
