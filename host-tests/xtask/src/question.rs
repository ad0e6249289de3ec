//! `cargo xtask test QUESTION`: what a change of one question can break, in two minutes.
//!
//! A question is named by its method in the core: `closest_point`. Nothing lists it here: the
//! suite's sources tell which kinds of queries call it and which images ask them, and the tests'
//! sources which modules do.

use std::fs;
use std::path::{Path, PathBuf};

use crate::blobs::Blob;
use crate::boards::{BOARDS, Board};
use crate::checks::cargo;
use crate::count_suite;
use crate::firmware::{self, Scope};
use crate::guard::Costs;
use crate::kind::Kind;
use crate::process;
use crate::steps::Steps;
use crate::tools::Tools;
use crate::workspace;

/// A question: who asks it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Question {
    /// Kinds of queries of the suite.
    pub kinds: Vec<&'static str>,
    /// Images that ask them.
    pub images: Vec<String>,
    /// Test programs with the modules that ask it.
    pub tests: Vec<(String, Vec<String>)>,
}

impl Question {
    /// The question that a method of the core answers.
    ///
    /// # Errors
    /// Neither suite nor tests call such a method, or sources cannot be read.
    pub fn of(method: &str) -> Result<Self, String> {
        let host_tests = workspace::root().join("host-tests");
        let mut question = Self::default();
        let call = format!(".{method}(");
        let mut functions = Vec::new();
        let ask = host_tests.join("suite/src/ask");
        for (file, text) in sources(&ask)? {
            let module = module(&ask, &file);
            // Each function's text, from its name on.
            for function in text.split("\npub fn ").skip(1).filter(|text| text.contains(&call)) {
                let name = function.split(['(', '<']).next().unwrap_or_default();
                functions.push((module[0].clone(), name.to_owned()));
            }
        }
        for (file, text) in sources(&ask)? {
            let Some((_, rows)) = text.split_once("asks! {") else { continue };
            let module = module(&ask, &file).remove(0);
            let calls =
                |row: &str| functions.iter().any(|(of, name)| *of == module && has_call(row, name));
            let rows = rows.split(" => ").collect::<Vec<_>>();
            // A row's text ends with the name of the next one.
            for pair in rows.windows(2).filter(|pair| calls(pair[1])) {
                let variant = pair[0].split_whitespace().last().unwrap_or_default();
                let kind = Kind::ALL.into_iter().find(|kind| format!("{kind:?}") == variant);
                question.kinds.extend(kind.map(Kind::name));
                question.images.push(format!("suite_{}", module.trim_start_matches("hull_")));
            }
        }
        let tests = host_tests.join("tests");
        for (file, text) in sources(&tests)? {
            if text.contains(&call) && module(&tests, &file).len() > 1 {
                let module = module(&tests, &file);
                let (program, modules) = (module[0].clone(), module[1..].join("::"));
                match question.tests.iter_mut().find(|(known, _)| *known == program) {
                    Some((_, known)) => known.push(modules),
                    None => question.tests.push((program, vec![modules])),
                }
            }
        }
        question.kinds.sort_unstable();
        question.kinds.dedup();
        question.images.sort_unstable();
        question.images.dedup();
        if question == Self::default() {
            return Err(format!("no question of the suite or the tests calls `{method}`"));
        }
        Ok(question)
    }

    /// Whether a board is asked about a blob: those whose costs are reported, of the images that
    /// ask the question. The Cortex-M33 runs nearly the instructions of the Cortex-M4F.
    fn is_asked(&self, board: &Board, blob: Blob) -> bool {
        board.cpu != "Cortex-M33"
            && self.asks(blob)
            && (blob.is_reported(board.flash) || !matches!(blob.image, "suite_tree" | "suite_hull"))
    }

    fn asks(&self, blob: Blob) -> bool {
        self.images.iter().any(|image| image == blob.image)
    }
}

/// Unit tests of the core, tests that call the method, committed answers; then bits and
/// instructions of the suite's queries on the boards and on this machine.
pub fn run(steps: &mut Steps, tools: Option<&Tools>, method: &str) {
    let Some(question) = steps.run(method, || Question::of(method)) else { return };
    let Question { kinds, images, tests } = &question;
    say!("   kinds: {}; images: {}", kinds.join(", "), images.join(", "));
    steps.run("unit tests of the core", || {
        process::run(&mut cargo(&["test", "--quiet", "--package", "meshsweep-core", "--lib"]))
    });
    let every: &[String] = &[];
    let fixtures = ("fixtures".to_owned(), Vec::new());
    for (program, modules) in tests.iter().chain([&fixtures]) {
        steps.run(&format!("tests of {program}"), || {
            // With the features that all of the workspace asks for.
            let mut command = cargo(&["test", "--quiet", "--workspace", "--test"]);
            command.args([program.as_str(), "--"]);
            process::run(command.args(if modules.is_empty() { every } else { modules }))
        });
    }
    if images.is_empty() {
        return;
    }
    let asked = |board: &Board, blob: Blob| question.is_asked(board, blob);
    let rows = tools.map(|tools| firmware::some(steps, tools, &BOARDS, &asked)).unwrap_or_default();
    let here = count_suite::some(steps, |blob| question.asks(blob));
    let costs = Costs::of(tools, &rows, Scope::Compared, &here);
    if let Some(costs) = steps.run("the numbers", || costs) {
        costs.of_kinds(kinds).check(steps);
    }
}

/// Whether a text calls a function of this name.
fn has_call(text: &str, name: &str) -> bool {
    text.match_indices(&format!("{name}("))
        .any(|(at, _)| !text[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == '.'))
}

/// The module of a file below a folder; that of `mod.rs` is its folder's, that of `main.rs` too.
fn module(folder: &Path, file: &Path) -> Vec<String> {
    let path = file.strip_prefix(folder).unwrap_or(file).with_extension("");
    let mut parts: Vec<String> =
        path.iter().map(|part| part.to_string_lossy().into_owned()).collect();
    if parts.len() > 1 && parts.last().is_some_and(|last| last == "mod" || last == "main") {
        parts.pop();
    }
    parts
}

/// All Rust files below a folder, with their texts.
fn sources(folder: &Path) -> Result<Vec<(PathBuf, String)>, String> {
    let failed = |error: std::io::Error| format!("{}: {error}", folder.display());
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        if path.is_dir() {
            found.extend(sources(&path)?);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let text = fs::read_to_string(&path).map_err(failed)?;
            found.push((path, text));
        }
    }
    found.sort();
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::Question;

    #[test]
    fn the_suite_and_the_tests_tell_who_asks_a_question() {
        let found = Question::of("first_hit").expect("a question");
        assert_eq!(found.kinds, ["facing", "first_hit"]);
        assert_eq!(found.images, ["suite_hull", "suite_tree"]);
        let programs: Vec<&str> = found.tests.iter().map(|(program, _)| &**program).collect();
        assert!(["bvh", "extremes", "hull"].iter().all(|program| programs.contains(program)));
        let closest = Question::of("closest_point").expect("a question");
        assert!(
            ["closest_far", "closest_near", "stopped"]
                .iter()
                .all(|kind| closest.kinds.contains(kind))
        );
        assert!(Question::of("no_such_question").is_err());
    }
}
