//! What a source file names: `use` lines, inline paths, and the items that it defines.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// A path that a file names, with the line.
#[derive(Clone, Debug)]
pub struct Named {
    pub path: Vec<String>,
    pub line: usize,
    pub is_export: bool,
}

/// What a file names.
#[derive(Debug)]
pub struct Source {
    pub file: PathBuf,
    pub named: Vec<Named>,
    /// Names of items that are defined here.
    pub items: BTreeSet<String>,
    /// Name → path of what is handed on under it; `*` is in `globs`.
    pub exports: BTreeMap<String, Vec<String>>,
    pub globs: Vec<Vec<String>>,
}

pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

impl Source {
    pub fn of(file: &Path, text: &str) -> Self {
        let text = without_comments(text);
        // Tests may look at anything.
        let text = text.split("#[cfg(test)]").next().unwrap_or_default().to_owned();
        let mut source = Self {
            file: file.to_path_buf(),
            named: Vec::new(),
            items: BTreeSet::new(),
            exports: BTreeMap::new(),
            globs: Vec::new(),
        };
        let lines: Vec<&str> = text.lines().collect();
        let mut index = 0;
        while index < lines.len() {
            let line = lines[index].trim_start();
            let (is_export, start) = visibility(line);
            if let Some(tree) = start.strip_prefix("use ") {
                let begun = index + 1;
                let mut tree = tree.to_owned();
                while !tree.contains(';') && index + 1 < lines.len() {
                    index += 1;
                    tree.push_str(lines[index].trim());
                }
                let mut paths = Vec::new();
                expand(tree.split(';').next().unwrap_or_default(), &[], &mut paths);
                for (path, name) in paths {
                    if is_export {
                        if name == "*" {
                            source.globs.push(path.clone());
                        } else {
                            source.exports.insert(name, path.clone());
                        }
                    }
                    source.named.push(Named { path, line: begun, is_export });
                }
            } else {
                if let Some(name) = defined(start) {
                    source.items.insert(name);
                }
                for path in inline(lines[index]) {
                    source.named.push(Named { path, line: index + 1, is_export: false });
                }
            }
            index += 1;
        }
        source
    }
}

/// Whether a line's item is visible outside of its file, and the line without the word.
pub fn visibility(line: &str) -> (bool, &str) {
    let Some(rest) = line.strip_prefix("pub") else { return (false, line) };
    let rest = match rest.strip_prefix('(') {
        Some(inside) => inside.split_once(')').map_or(rest, |(_, rest)| rest),
        None => rest,
    };
    (true, rest.trim_start())
}

/// The name of an item that a line begins to define.
pub fn defined(line: &str) -> Option<String> {
    let mut words = line.split(|c: char| !(c.is_alphanumeric() || c == '_' || c == '!'));
    match words.next()? {
        "const" | "unsafe" | "extern" | "async" => {
            // `const fn` and `const NAME` alike: the next word decides.
            let next = words.next()?;
            if next != "fn" {
                return Some(next.to_owned()).filter(|name| !name.is_empty());
            }
            words.next().map(str::to_owned)
        }
        "fn" | "struct" | "enum" | "trait" | "type" | "static" | "union" | "macro_rules!" => {
            words.find(|word| !word.is_empty()).map(str::to_owned)
        }
        _ => None,
    }
}

/// `a::{b, c as d}` to paths, each with the name that it gets.
fn expand(tree: &str, before: &[String], paths: &mut Vec<(Vec<String>, String)>) {
    let tree = tree.trim();
    if let Some((head, inside)) = tree.split_once('{') {
        let head = head.trim_end_matches("::");
        let parts = head.split("::").filter(|part| !part.is_empty()).map(|s| s.trim().to_owned());
        let before: Vec<String> = before.iter().cloned().chain(parts).collect();
        let inside = inside.trim_end().strip_suffix('}').unwrap_or(inside);
        let (mut depth, mut start) = (0, 0);
        for (at, c) in inside.char_indices() {
            match c {
                '{' => depth += 1,
                '}' => depth -= 1,
                ',' if depth == 0 => {
                    expand(&inside[start..at], &before, paths);
                    start = at + 1;
                }
                _ => {}
            }
        }
        expand(&inside[start..], &before, paths);
        return;
    }
    if tree.is_empty() {
        return;
    }
    let (path, renamed) = tree.split_once(" as ").map_or((tree, None), |(p, n)| (p, Some(n)));
    let parts = path.split("::").map(|part| part.trim().to_owned());
    let mut path: Vec<String> = before.iter().cloned().chain(parts).collect();
    if path.last().is_some_and(|last| last == "self") && path.len() > 1 {
        path.pop();
    }
    let name = renamed.map(|name| name.trim().to_owned()).or_else(|| path.last().cloned());
    let name = name.unwrap_or_default();
    if name == "*" {
        path.pop();
    }
    paths.push((path, name));
}

/// Paths from `crate` and `super` in the middle of code.
fn inline(line: &str) -> Vec<Vec<String>> {
    let mut paths = Vec::new();
    for start in ["crate::", "super::"] {
        for (at, _) in line.match_indices(start) {
            let before = line[..at].chars().next_back();
            if before.is_some_and(|c| c.is_alphanumeric() || c == '_' || c == ':' || c == '$') {
                continue;
            }
            let end = line[at..]
                .find(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':'))
                .map_or(line.len(), |length| at + length);
            let path = line[at..end].trim_end_matches(':');
            paths.push(path.split("::").map(str::to_owned).collect());
        }
    }
    paths
}

/// Line comments and doc comments become empty; the lines stay.
pub fn without_comments(text: &str) -> String {
    let line = |line: &str| {
        let code = line.split_once("//").map_or(line, |(code, _)| code);
        format!("{code}\n")
    };
    text.lines().map(line).collect()
}

pub fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    let mut entries: Vec<PathBuf> =
        fs::read_dir(folder).expect("a folder").flatten().map(|entry| entry.path()).collect();
    entries.sort();
    for entry in entries {
        if entry.is_dir() {
            collect(&entry, files);
        } else if entry.extension().is_some_and(|extension| extension == "rs") {
            files.push(entry);
        }
    }
}

#[test]
fn paths_are_read_as_the_compiler_reads_them() {
    let mut paths = Vec::new();
    expand("crate::{a::{self, B}, c::D as E, f::*}", &[], &mut paths);
    let paths: Vec<String> =
        paths.iter().map(|(path, name)| format!("{} {name}", path.join("::"))).collect();
    assert_eq!(paths, ["crate::a a", "crate::a::B B", "crate::c::D E", "crate::f *"]);
    assert_eq!(defined("const fn f(x: u8)"), Some("f".to_owned()));
    assert_eq!(defined("const LIMIT: usize = 3;"), Some("LIMIT".to_owned()));
    assert_eq!(
        inline("    super::a::b(crate::c::D)"),
        [["crate", "c", "D"].map(str::to_owned), ["super", "a", "b"].map(str::to_owned)]
    );
}
