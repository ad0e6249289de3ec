//! What can be logged.

use std::fs;
use std::path::Path;

use crate::source::{collect, defined, root, visibility, without_comments};

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
