//! What the program writes.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Command;

/// The long options that a text names, without the dashes of roff.
fn options(text: &str) -> BTreeSet<String> {
    let plain = text.replace("\\-", "-");
    let words = plain.split(|c: char| !(c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-'));
    words
        .filter_map(|word| word.strip_prefix("--"))
        .filter(|name| !name.is_empty())
        .map(str::to_owned)
        .collect()
}

#[test]
fn every_command_has_a_page_and_every_option_of_a_page_a_completion() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("manual");
    let program = env!("CARGO_BIN_EXE_meshsweep-manual");
    assert!(Command::new(program).arg(&folder).status().unwrap().success());
    let bash = options(&fs::read_to_string(folder.join("completions/meshsweep.bash")).unwrap());
    let mut commands = 0;
    for page in fs::read_dir(folder.join("man1")).unwrap() {
        let path = page.unwrap().path();
        let text = fs::read_to_string(&path).unwrap();
        let (synopsis, _) = text.split_once("EXTRA").unwrap_or((&text, ""));
        let missing: Vec<_> = options(synopsis).difference(&bash).cloned().collect();
        assert!(missing.is_empty(), "{}: {missing:?}", path.display());
        commands += usize::from(text.contains("Examples:"));
    }
    assert_eq!(commands, 22);
}
