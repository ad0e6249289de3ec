//! Which folder may use which, and no files that use each other in a circle. Both are read from the
//! paths of the source files, from `use` lines and from inline paths.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The folders of `core/src`, each with the folders that it may use.
const CORE: [(&str, &[&str]); 10] = [
    ("num", &[]),
    ("geom", &["num"]),
    ("format", &["num", "geom"]),
    ("query", &["num", "geom", "format"]),
    ("bvh", &["num", "geom", "format", "query"]),
    ("hull", &["num", "geom", "format", "query"]),
    ("tribox", &["num", "geom", "format", "query"]),
    ("curve", &["num", "geom", "format", "query"]),
    ("tight", &["num", "geom", "format", "query", "bvh"]),
    ("blob", &["num", "geom", "format", "query", "bvh", "hull", "tribox", "curve", "tight"]),
];

/// Folders that all structures of the builder may use.
const BENEATH: &[&str] = &[
    "counted",
    "number",
    "emit",
    "error",
    "progress",
    "random",
    "lp",
    "mesh",
    "surface",
    "collapse",
    "bvh",
    "hausdorff",
];

/// The same of `alloc-ext/src`. `emit` is beneath: it knows sections and no builder. `counted` and
/// `number` print numbers, `error` says why there is no blob, `progress` tells how much is done and
/// asks whether to go on, `random` gives the same numbers in every run. `cut`, `trade` and
/// `builder` are above: they know all structures. `load` makes a clean mesh of a file for them.
/// `check` proves the others' work and shares nothing with them but meshes. `trade` measures
/// distances by it.
const BUILDER: [(&str, &[&str]); 22] = [
    ("counted", &[]),
    ("number", &[]),
    ("emit", &[]),
    ("random", &[]),
    ("lp", &["random"]),
    ("mesh", &["counted"]),
    ("check", &["mesh"]),
    ("error", &["counted", "mesh", "number"]),
    ("progress", &["error"]),
    ("surface", &["counted", "error", "lp", "mesh"]),
    ("load", &["error", "mesh", "surface"]),
    ("collapse", &["counted", "lp", "mesh", "progress", "surface"]),
    ("bvh", &["counted", "emit", "error", "lp", "mesh", "progress", "surface"]),
    ("hausdorff", &["bvh", "error", "mesh"]),
    ("hull", BENEATH),
    ("tight", BENEATH),
    ("tribox", BENEATH),
    ("curve", BENEATH),
    (
        "cut",
        &["counted", "emit", "error", "lp", "mesh", "surface", "bvh", "hull", "tight", "tribox"],
    ),
    (
        "trade",
        &["check", "emit", "error", "random", "mesh", "surface", "bvh", "hull", "tight", "tribox"],
    ),
    (
        "builder",
        &[
            "counted", "number", "emit", "error", "progress", "mesh", "surface", "load",
            "collapse", "bvh", "hull", "tight", "tribox", "curve",
        ],
    ),
    ("worst", &["random"]),
];

/// A module's path from its crate's root: `["bvh", "node"]`.
type Module = Vec<String>;

/// A path that a file names, with the line.
#[derive(Clone, Debug)]
struct Named {
    path: Vec<String>,
    line: usize,
    is_export: bool,
}

#[derive(Debug)]
struct Source {
    file: PathBuf,
    named: Vec<Named>,
    /// Names of items that are defined here.
    items: BTreeSet<String>,
    /// Name → path of what is handed on under it; `*` is in `globs`.
    exports: BTreeMap<String, Vec<String>>,
    globs: Vec<Vec<String>>,
}

/// A crate's sources by their modules.
struct House {
    sources: BTreeMap<Module, Source>,
}

/// `file` uses `other` on `line`.
#[derive(Debug)]
struct Arrow {
    from: Module,
    to: Module,
    line: usize,
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

impl House {
    /// Reads all files below `folder`; those in `but` are another crate's.
    fn read(folder: &str, but: Option<&str>) -> Self {
        let folder = root().join(folder);
        let mut files = Vec::new();
        collect(&folder, &mut files);
        let but = but.map(|but| folder.join(but));
        let is_ours = |file: &&PathBuf| but.as_ref().is_none_or(|but| !file.starts_with(but));
        let mut house = Self { sources: BTreeMap::new() };
        for file in files.iter().filter(is_ours) {
            let inside = file.strip_prefix(&folder).expect("below it").with_extension("");
            let mut module: Module =
                inside.iter().map(|part| part.to_string_lossy().into_owned()).collect();
            if module.last().is_some_and(|last| ["mod", "lib", "main"].contains(&last.as_str())) {
                module.pop();
            }
            if module.last().is_some_and(|last| last == "tests") {
                continue;
            }
            let text = fs::read_to_string(file).expect("readable");
            house.sources.insert(module.clone(), Source::of(file, &text));
        }
        assert!(house.sources.len() > 10, "{}", folder.display());
        house
    }

    /// The file that defines the last name of a path, or its module's if the name is unknown.
    fn resolve(&self, from: &Module, path: &[String], depth: usize) -> Option<Module> {
        let (first, mut rest) = path.split_first()?;
        let mut module = match first.as_str() {
            "crate" => Vec::new(),
            "self" => from.clone(),
            "super" => {
                let mut module = from.clone();
                module.pop()?;
                while rest.first().is_some_and(|name| name == "super") {
                    module.pop()?;
                    rest = &rest[1..];
                }
                module
            }
            name => {
                // A module beside, or another crate.
                let child = [from.as_slice(), &[name.to_owned()]].concat();
                self.sources.contains_key(&child).then_some(())?;
                child
            }
        };
        while let Some((name, others)) = rest.split_first() {
            let child = [module.as_slice(), std::slice::from_ref(name)].concat();
            let source = self.sources.get(&module)?;
            if self.sources.contains_key(&child) {
                module = child;
            } else if let (Some(path), false) = (source.exports.get(name), depth > 8) {
                let path = [path.as_slice(), others].concat();
                return self.resolve(&module, &path, depth + 1).or(Some(module));
            } else if !source.items.contains(name) && depth <= 8 {
                let behind = source.globs.iter().find_map(|glob| {
                    let inside = self.resolve(&module, glob, depth + 1)?;
                    let source = self.sources.get(&inside)?;
                    let known = source.items.contains(name) || source.exports.contains_key(name);
                    let path = [&["self".to_owned()], rest].concat();
                    known.then(|| self.resolve(&inside, &path, depth + 1))?
                });
                return behind.or(Some(module));
            } else {
                return Some(module);
            }
            rest = others;
        }
        Some(module)
    }

    /// What each file uses of others; handing on alone is no use.
    fn arrows(&self) -> Vec<Arrow> {
        let mut arrows = Vec::new();
        for (from, source) in &self.sources {
            for named in source.named.iter().filter(|named| !named.is_export) {
                let to = self.resolve(from, &named.path, 0);
                if let Some(to) = to.filter(|to| to != from) {
                    arrows.push(Arrow { from: from.clone(), to, line: named.line });
                }
            }
        }
        arrows
    }

    fn place(&self, arrow: &Arrow) -> String {
        let file = self.sources[&arrow.from].file.strip_prefix(root()).expect("below it");
        format!("{}:{}", file.display(), arrow.line)
    }

    /// Uses that `folders` does not allow.
    fn strays(&self, folders: &[(&str, &[&str])]) -> Vec<String> {
        let mut strays = Vec::new();
        for arrow in self.arrows() {
            let ([from, ..], [to, ..]) = (arrow.from.as_slice(), arrow.to.as_slice()) else {
                // The crate's root may use all; what is defined in the root is used by none.
                if !arrow.from.is_empty() {
                    strays.push(format!(
                        "{} may not use the crate's root: {}",
                        arrow.from[0],
                        self.place(&arrow)
                    ));
                }
                continue;
            };
            if from == to {
                continue;
            }
            match folders.iter().find(|(folder, _)| folder == from) {
                None => strays
                    .push(format!("{from} is no folder of the design: {}", self.place(&arrow))),
                Some((_, may)) if !may.contains(&to.as_str()) => {
                    strays.push(format!("{from} may not use {to}: {}", self.place(&arrow)));
                }
                Some(_) => {}
            }
        }
        strays.sort();
        strays.dedup();
        strays
    }

    /// Groups of files that use each other in a circle.
    fn circles(&self) -> Vec<String> {
        let arrows = self.arrows();
        let mut uses: BTreeMap<&Module, BTreeSet<&Module>> = BTreeMap::new();
        for arrow in &arrows {
            uses.entry(&arrow.from).or_default().insert(&arrow.to);
        }
        let reach = |from: &Module| {
            let (mut seen, mut stack) = (BTreeSet::new(), vec![from]);
            while let Some(module) = stack.pop() {
                for &next in uses.get(module).into_iter().flatten() {
                    if seen.insert(next) {
                        stack.push(next);
                    }
                }
            }
            seen
        };
        let reached: BTreeMap<&Module, BTreeSet<&Module>> =
            self.sources.keys().map(|module| (module, reach(module))).collect();
        let mut circles = BTreeSet::new();
        for (module, after) in &reached {
            let circle: BTreeSet<&Module> =
                after.iter().copied().filter(|other| reached[other].contains(module)).collect();
            if circle.len() > 1 {
                circles.insert(circle);
            }
        }
        let told = |circle: &BTreeSet<&Module>| {
            let inside = arrows
                .iter()
                .filter(|arrow| circle.contains(&arrow.from) && circle.contains(&arrow.to));
            let mut lines: Vec<String> = inside
                .map(|arrow| format!("  {} uses {}", self.place(arrow), arrow.to.join("::")))
                .collect();
            lines.dedup_by_key(|line| line.clone());
            format!("{} files use each other:\n{}", circle.len(), lines.join("\n"))
        };
        circles.iter().map(told).collect()
    }
}

impl Source {
    fn of(file: &Path, text: &str) -> Self {
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
fn visibility(line: &str) -> (bool, &str) {
    let Some(rest) = line.strip_prefix("pub") else { return (false, line) };
    let rest = match rest.strip_prefix('(') {
        Some(inside) => inside.split_once(')').map_or(rest, |(_, rest)| rest),
        None => rest,
    };
    (true, rest.trim_start())
}

/// The name of an item that a line begins to define.
fn defined(line: &str) -> Option<String> {
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

/// Paths from `crate`, `super` and `self` in the middle of code.
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
fn without_comments(text: &str) -> String {
    let line = |line: &str| {
        let code = line.split_once("//").map_or(line, |(code, _)| code);
        format!("{code}\n")
    };
    text.lines().map(line).collect()
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
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

fn none(found: &[String]) {
    assert!(found.is_empty(), "\n{}", found.join("\n"));
}

#[test]
fn folders_of_the_core_use_only_folders_beneath() {
    none(&House::read("core/src", None).strays(&CORE));
}

#[test]
fn folders_of_the_builder_use_only_folders_beneath() {
    none(&House::read("alloc-ext/src", Some("bin")).strays(&BUILDER));
}

#[test]
fn the_checker_uses_no_code_of_the_reader() {
    let mut files = Vec::new();
    collect(&root().join("alloc-ext/src/check"), &mut files);
    assert!(files.len() > 20);
    for file in files {
        let text = without_comments(&fs::read_to_string(&file).expect("readable"));
        assert!(!text.contains("meshsweep_core"), "{}", file.display());
    }
}

#[test]
fn no_files_use_each_other_in_a_circle() {
    none(&House::read("core/src", None).circles());
    none(&House::read("alloc-ext/src", Some("bin")).circles());
    none(&House::read("alloc-ext/src/bin/meshsweep", None).circles());
}

#[test]
fn every_public_answer_and_error_can_be_logged() {
    let read = |file: &Path| fs::read_to_string(file).expect("readable");
    let names = without_comments(&read(&root().join("core/src/lib.rs")));
    let (names, _) = names.split_once("pub mod internal").expect("the internal module is last");
    let is_public = |name: &str| names.split(|c: char| !c.is_alphanumeric()).any(|n| n == name);
    let mut files = Vec::new();
    collect(&root().join("core/src"), &mut files);
    let mut answers = 0;
    for text in files.iter().map(|file| without_comments(&read(file))) {
        let lines: Vec<&str> = text.lines().filter(|line| !line.is_empty()).collect();
        for (at, line) in lines.iter().enumerate() {
            // Answers, errors and budgets may get more fields or variants, and only they.
            let name = defined(visibility(line).1).filter(|name| is_public(name));
            let attributes = lines[..at].iter().rev().take_while(|line| line.starts_with("#["));
            let attributes: String = attributes.copied().collect();
            if let Some(name) = name.filter(|_| attributes.contains("#[non_exhaustive]")) {
                answers += 1;
                assert!(attributes.contains("derive(defmt::Format)"), "{name}");
            }
        }
    }
    assert!(answers > 35, "{answers}");
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
