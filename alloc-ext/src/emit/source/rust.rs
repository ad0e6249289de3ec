//! A Rust module.

use super::stack::{self, Caller};
use super::{Facts, SourceNames, identifier, in_comment};
use meshsweep_core::Blob;
use std::fmt::Write;

/// A module with the blob's structures as `static`s, opened by the compiler. It includes the blob
/// from its own folder, and does not compile with another one.
#[must_use]
pub fn rust_module(blob: &Blob<'_>, names: SourceNames<'_>) -> String {
    let facts = Facts::of(blob);
    head(&facts, names, &stack::lines(blob, Caller::Rust)) + &items(&facts, names)
}

/// The same without the comment on the blob: what it imports, and its items.
pub(crate) fn rust_items(blob: &Blob<'_>, names: SourceNames<'_>) -> String {
    items(&Facts::of(blob), names)
}

/// A name as that of a module.
pub(crate) fn rust_name(name: &str) -> String {
    module(&identifier(name))
}

fn items(facts: &Facts, names: SourceNames<'_>) -> String {
    let mut out = format!("use meshsweep_core::{{{}}};\n\n", imports(facts).join(", "));
    let first = Some(bytes(facts, names));
    for part in [first, tree(facts), hulls(facts), field(facts), sweep(facts), more(facts)] {
        out.extend(part);
    }
    out
}

fn head(facts: &Facts, names: SourceNames<'_>, stack: &[String]) -> String {
    let (stem, file) = (module(&names.identifier()), names.file_stem());
    let path = if file == stem {
        String::new()
    } else {
        format!("#[path = {:?}] ", format!("{}.rs", in_comment(file)))
    };
    let mut out = format!(
        "// The blob `{}` of `{}`, opened by the compiler.\n//\n\
         // Written by `meshsweep build --emit rust`. Keep both files in one folder, and write\n\
         // `{}mod {stem};` in a crate that depends on `meshsweep-core` {}.\n//\n\
         // - triangles in the mesh file: {}\n",
        in_comment(names.blob),
        in_comment(names.mesh),
        path,
        env!("CARGO_PKG_VERSION"),
        facts.triangles,
    );
    let facts_of_tree = [
        facts.is_closed.map(|closed| (if closed { "closed" } else { "not closed" }).to_owned()),
        (facts.has_sides != facts.is_closed).then(|| "no sides by the nearest triangle".to_owned()),
        facts.bounds.map(|[low, high]| format!("a box that contains it: {low:?} to {high:?}")),
        facts.surface_error.map(|error| {
            format!("no point of the mesh is farther than {error:?} from the stored surface")
        }),
    ];
    for fact in facts_of_tree.into_iter().flatten() {
        let _ = writeln!(out, "// - {fact}");
    }
    out.push_str(
        "//\n// Bytes of the processor's stack that a question takes, at opt-level \"s\" / 3. \
         Debug builds\n// take several times as much: core/docs/guide.md tells how to avoid it.\n",
    );
    for line in stack {
        let _ = writeln!(out, "//   {line}");
    }
    out.push_str(
        "//\n// Distances are in the mesh's unit. Intervals hold of the mesh, not only of the \
         stored surface.\n\n",
    );
    out
}

/// Words that name no module, in any edition, the name that is none, and the crate that modules use.
const RESERVED: [&str; 53] = [
    "_",
    "abstract",
    "as",
    "async",
    "await",
    "become",
    "box",
    "break",
    "const",
    "continue",
    "crate",
    "do",
    "dyn",
    "else",
    "enum",
    "extern",
    "false",
    "final",
    "fn",
    "for",
    "gen",
    "if",
    "impl",
    "in",
    "let",
    "loop",
    "macro",
    "match",
    "meshsweep_core",
    "mod",
    "move",
    "mut",
    "override",
    "priv",
    "pub",
    "ref",
    "return",
    "self",
    "static",
    "struct",
    "super",
    "trait",
    "true",
    "try",
    "type",
    "typeof",
    "unsafe",
    "unsized",
    "use",
    "virtual",
    "where",
    "while",
    "yield",
];

/// A module of this name. `r#` does not serve all reserved words.
fn module(identifier: &str) -> String {
    let mark = if RESERVED.contains(&identifier) { "_" } else { "" };
    format!("{identifier}{mark}")
}

fn imports(facts: &Facts) -> Vec<&'static str> {
    let uses = [
        (true, "Blob"),
        (facts.has_tree, "Bvh"),
        (facts.has_more, "OpenError"),
        (true, "Scratch"),
        (facts.field_unit.is_some(), "Sdf"),
        (facts.hulls > 0, "TightHull"),
        (facts.hulls > 0, "TightHulls"),
    ];
    uses.into_iter().filter_map(|(is_used, name)| is_used.then_some(name)).collect()
}

fn bytes(facts: &Facts, names: SourceNames<'_>) -> String {
    let (size, checksum, file) = (facts.bytes, facts.checksum, names.blob);
    format!(
        "/// Bytes that begin at a multiple of four.\n\
         #[repr(C, align(4))]\n\
         pub struct Aligned<const N: usize>(pub [u8; N]);\n\n\
         /// The blob.\n\
         #[allow(dead_code)]\n\
         pub static BYTES: Aligned<{size}> = Aligned(*include_bytes!({file:?}));\n\n\
         /// What `Blob::checksum` gives while the bytes are those of the builder.\n\
         #[allow(dead_code)]\n\
         pub const CHECKSUM: u32 = {checksum:#010x};\n\n\
         #[allow(long_running_const_eval, reason = \"every byte is compared\")]\n\
         const _: () = assert!(\n    \
             matches!(Blob::checksum(include_bytes!({file:?})), Ok(CHECKSUM)),\n    \
             \"the file is another blob than this module was written for\"\n);\n\n\
         /// No question about one point, segment or solid needs more scratch entries.\n\
         #[allow(dead_code)]\n\
         pub const SCRATCH_ENTRIES: usize = {};\n\n\
         /// Scratch memory. `cargo build` refuses fewer than `SCRATCH_ENTRIES`.\n\
         #[allow(dead_code)]\n\
         pub const fn scratch<const N: usize>() -> Scratch<N> {{\n    \
             const {{ assert!(N >= SCRATCH_ENTRIES, \"too few scratch entries\") }}\n    \
             Scratch::new()\n}}\n",
        facts.scratch,
    )
}

fn tree(facts: &Facts) -> Option<String> {
    facts.has_tree.then(|| {
        "\n/// The box tree.\n\
         #[allow(dead_code)]\n\
         pub static TREE: Bvh<'static> = match Bvh::open_trusted(&BYTES.0) {\n    \
             Ok(tree) => tree,\n    \
             Err(_) => panic!(\"the blob has no box tree\"),\n};\n"
            .to_owned()
    })
}

fn hulls(facts: &Facts) -> Option<String> {
    (facts.hulls > 0).then(|| {
        format!(
            "\n/// Tight hulls, coarse to fine: {} of them.\n\
             #[allow(dead_code)]\n\
         pub static TIGHT_HULLS: TightHulls<'static> = match \
             TightHulls::open_trusted(&BYTES.0) {{\n    \
                 Ok(hulls) => hulls,\n    \
                 Err(_) => panic!(\"the blob has no tight hulls\"),\n}};\n\n\
             /// The tightest of them.\n\
             #[allow(dead_code)]\n\
         pub static FINEST_HULL: TightHull<'static> = match TIGHT_HULLS.finest() {{\n    \
                 Some(hull) => hull,\n    \
                 None => panic!(\"the blob has no tight hulls\"),\n}};\n",
            facts.hulls
        )
    })
}

fn field(facts: &Facts) -> Option<String> {
    facts.field_unit.map(|unit| {
        format!(
            "\n/// The distance field. It needs no scratch. A unit of it is {unit:?}.\n\
             #[allow(dead_code)]\n\
             pub static FIELD: Sdf<'static> = match Sdf::open_trusted(&BYTES.0) {{\n    \
                 Ok(field) => field,\n    \
                 Err(_) => panic!(\"the blob has no distance field\"),\n}};\n"
        )
    })
}

fn sweep(facts: &Facts) -> Option<String> {
    facts.sweep.map(|entries| {
        format!(
            "\n/// No place of the point of a kept sweep needs more scratch entries.\n\
             #[allow(dead_code)]\n\
             pub const SWEEP_ENTRIES: usize = {entries};\n"
        )
    })
}

fn more(facts: &Facts) -> Option<String> {
    facts.has_more.then(|| {
        "\n/// Opens all structures of the blob and checks every byte. The compiler cannot open\n\
         /// hull hierarchies, triboxes and curves.\n\
         ///\n\
         /// # Errors\n\
         /// Flash does not hold the blob any more.\n\
         #[allow(dead_code)]\n\
         pub fn open() -> Result<Blob<'static>, OpenError> {\n    \
             Blob::open(&BYTES.0)\n}\n"
            .to_owned()
    })
}
