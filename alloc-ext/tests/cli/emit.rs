//! `--emit`: sources that hold a blob.

use crate::support::{arg, fixture, ok, refused, run, scratch};
use std::fs;
use std::path::Path;

#[test]
fn emitted_sources_depend_on_the_blob_and_on_names_of_files_alone() {
    let texts = ["emit_one", "emit_other"].map(|name| {
        let directory = scratch(name);
        let (mesh, out) = (fixture("groove.obj"), directory.join("3 part.msw"));
        let text = ok(["build", arg(&mesh), "-o", arg(&out), "--emit", "rust,c"]);
        let texts = ["rs", "h", "c"].map(|extension| {
            let file = out.with_extension(extension);
            assert!(text.contains(arg(&file)), "{text}");
            fs::read_to_string(file).unwrap()
        });
        (texts, fs::read(out).unwrap())
    });
    assert_eq!(texts[0], texts[1]);
    let ([rust, header, source], bytes) = &texts[0];
    assert!(rust.contains("`#[path = \"3 part.rs\"] mod _3_part;`"), "{rust}");
    assert!(rust.contains("include_bytes!(\"3 part.msw\")"), "{rust}");
    assert!(header.contains("#define _3_PART_SCRATCH_ENTRIES 31u"), "{header}");
    let listed = source.split_once("= {").unwrap().1.split(',').map(|byte| byte.trim().parse());
    let listed: Vec<u8> = listed.map_while(Result::ok).collect();
    assert!(&listed == bytes);
    // The C compiles, with names that are no identifiers.
    let include = concat!("-I", env!("CARGO_MANIFEST_DIR"), "/../../core/c-api/include");
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join("cli/emit_other/3 part.c");
    let checked = ["cc", "gcc", "clang"].into_iter().find_map(|compiler| {
        let mut command = std::process::Command::new(compiler);
        command.args(["-std=c11", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", include]);
        command.arg(&file).output().ok()
    });
    let checked = checked.expect("a C compiler");
    assert!(checked.status.success(), "{}", String::from_utf8_lossy(&checked.stderr));
}

/// `rustc` says whether the line that the file recommends compiles. `mod` reads the file itself, so
/// one that stands in for it suffices.
#[test]
fn an_emitted_module_named_by_a_reserved_word_can_be_declared() {
    let directory = scratch("emit_reserved");
    for word in ["move", "self", "gen", "_", "part"] {
        let out = directory.join(format!("{word}.msw"));
        ok(["build", arg(&fixture("groove.obj")), "-o", arg(&out), "--emit", "rust,c"]);
        let rust = fs::read_to_string(out.with_extension("rs")).unwrap();
        let line = rust.split('`').find(|text| text.contains("mod ")).unwrap();
        assert_eq!(line.contains("#[path"), word != "part", "{line}");
        fs::write(out.with_extension("rs"), "").unwrap();
        let user = directory.join("user.rs");
        fs::write(&user, format!("{line}\n")).unwrap();
        let mut rustc = std::process::Command::new("rustc");
        rustc.args(["--edition=2024", "--crate-type=lib", "--emit=metadata", "--out-dir"]);
        let output = rustc.arg(&directory).arg(&user).output().expect("rustc");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
}

#[test]
fn emitted_sources_overwrite_no_input() {
    let directory = scratch("emit_over_input");
    let mesh = directory.join("part.c");
    fs::copy(fixture("groove.obj"), &mesh).unwrap();
    let out = directory.join("part.msw");
    let output = run(["build", arg(&mesh), "-o", arg(&out), "--emit", "c"]);
    refused(&output, 1, "part.c");
    assert_eq!(fs::read(mesh).unwrap(), fs::read(fixture("groove.obj")).unwrap());
}
