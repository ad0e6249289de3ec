//! A C header and a C file.

use super::stack::{self, Caller};
use super::{Facts, SourceNames, in_comment};
use meshsweep_core::Blob;
use std::fmt::Write;

/// The end of a header, with marks in the place of its name.
const DECLARATIONS: &str = include_str!("part.h.txt");

/// The header: sizes and facts as macros, a declaration of the bytes, a check of scratch memory.
#[must_use]
pub fn c_header(blob: &Blob<'_>, names: SourceNames<'_>) -> String {
    let facts = Facts::of(blob);
    let (lower, upper) = (names.identifier(), names.identifier().to_ascii_uppercase());
    let mut out = format!(
        "/* The blob `{}` of `{}`.\n *\n \
         * Written by `meshsweep build --emit c`, for version {} of the library. Compile {}.c\n \
         * with your program. Give {lower}_bytes to an open function of meshsweep.h.\n *\n \
         * Bytes of the processor's stack that a function takes in libmeshsweep_small.a /\n \
         * libmeshsweep.a. Of the functions for this blob, those that are not listed take less\n \
         * than 64.\n{} */\n\
         #ifndef {upper}_MSW_H\n#define {upper}_MSW_H\n\n#include <stdint.h>\n\n\
         #ifdef __cplusplus\nextern \"C\" {{\n#endif\n\n",
        in_comment(names.blob),
        in_comment(names.mesh),
        env!("CARGO_PKG_VERSION"),
        in_comment(names.file_stem()),
        stack::lines(blob, Caller::C)
            .iter()
            .map(|line| format!(" *   {line}\n"))
            .collect::<String>(),
    );
    let mut define = |name: &str, value: String, about: &str| {
        let _ = writeln!(out, "#define {upper}_{name} {value} /* {about} */");
    };
    define("BYTES", format!("{}u", facts.bytes), "of the blob");
    define(
        "CHECKSUM",
        format!("{:#010x}u", facts.checksum),
        "by msw_checksum; covers all sections",
    );
    if facts.triangles > 0 {
        define("TRIANGLES", format!("{}u", facts.triangles), "of the mesh");
    }
    let entries = format!("{}u", facts.scratch);
    define("SCRATCH_ENTRIES", entries, "no question about a point or a segment needs more");
    if let Some(closed) = facts.is_closed {
        define("IS_CLOSED", u8::from(closed).to_string(), "whether the mesh is closed");
    }
    if let Some(has_sides) = facts.has_sides {
        let value = u8::from(has_sides).to_string();
        define("HAS_SIDES", value, "whether msw_signed_distance decides sides");
    }
    if let Some(is_fence) = facts.is_fence {
        let value = u8::from(is_fence).to_string();
        define("IS_FENCE", value, "whether msw_curve_signed_distance answers");
    }
    if let Some(unit) = facts.field_unit {
        define("SDF_UNIT", float(unit), "of the distance field, in the mesh's unit");
    }
    if let Some(error) = facts.surface_error {
        define("SURFACE_ERROR", float(error), "most distance of the mesh from the stored surface");
    }
    for (name, corner) in ["BOX_LOW", "BOX_HIGH"].into_iter().zip(facts.bounds.iter().flatten()) {
        let [x, y, z] = corner.map(float);
        define(name, format!("{{{x}, {y}, {z}}}"), "of a box that contains the mesh");
    }
    if facts.hulls > 0 {
        define("TIGHT_HULLS", format!("{}u", facts.hulls), "coarse to fine, for msw_open_tight");
    }
    out + &DECLARATIONS.replace("LOWER", &lower).replace("UPPER", &upper)
}

/// The file with the bytes.
#[must_use]
pub fn c_source(blob: &Blob<'_>, names: SourceNames<'_>) -> String {
    let facts = Facts::of(blob);
    let (lower, upper) = (names.identifier(), names.identifier().to_ascii_uppercase());
    let mut out = format!(
        "/* The {} bytes of `{}`. Written by `meshsweep build --emit c`. */\n\
         #include \"{}.h\"\n\n\
         #if {upper}_CHECKSUM != {:#010x}u\n\
         #error \"this file and its header are of different blobs\"\n#endif\n\n\
         _Alignas(4) const uint8_t {lower}_bytes[{upper}_BYTES] = {{\n",
        facts.bytes,
        in_comment(names.blob),
        in_comment(names.file_stem()),
        facts.checksum,
    );
    for row in blob.bytes().chunks(20) {
        out.push_str("   ");
        for byte in row {
            let _ = write!(out, " {byte},");
        }
        out.push('\n');
    }
    out.push_str("};\n");
    out
}

/// A literal of the same value.
fn float(x: f32) -> String {
    format!("{x:?}f")
}
