//! What `core/docs/papers.md` says of the papers: every link names a file that has the name, and
//! every table of the laboratory exists.

use std::fs;

use super::none;
use super::source::root;

/// The links of a text, each as its name without backquotes, and its path.
fn links(text: &str) -> impl Iterator<Item = (&str, &str)> {
    text.split("[`").skip(1).filter_map(|rest| {
        let (name, rest) = rest.split_once("`](")?;
        Some((name, rest.split_once(')')?.0))
    })
}

/// Whether a text has a word.
fn has_word(text: &str, word: &str) -> bool {
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    text.match_indices(word).any(|(at, _)| {
        let (before, after) =
            (text[..at].chars().next_back(), text[at + word.len()..].chars().next());
        !before.is_some_and(is_part) && !after.is_some_and(is_part)
    })
}

#[test]
fn what_the_papers_page_names_is_there() {
    let docs = root().join("core/docs");
    let page = fs::read_to_string(docs.join("papers.md")).expect("a page");
    let is_wrong = |(name, path): &(&str, &str)| {
        let text = fs::read_to_string(docs.join(path)).unwrap_or_default();
        !has_word(&text, name.rsplit("::").next().unwrap_or(name))
    };
    assert!(links(&page).count() > 80);
    none(
        &links(&page)
            .filter(is_wrong)
            .map(|(name, path)| format!("{path}: {name}"))
            .collect::<Vec<_>>(),
    );
    let lab = root().join("host-tests/lab/src/measure/paper/mod.rs");
    let lab = fs::read_to_string(lab).expect("a file");
    let named = page.split("measure --paper ").skip(1);
    let named = named.filter_map(|rest| rest.split('`').next());
    none(
        &named
            .filter(|table| !lab.contains(&format!("\"{table}\"")))
            .map(str::to_owned)
            .collect::<Vec<_>>(),
    );
}

#[test]
fn every_row_of_the_papers_page_has_a_place_or_a_reason() {
    let page = fs::read_to_string(root().join("core/docs/papers.md")).expect("a page");
    let is_bare = |line: &&str| {
        let cells: Vec<&str> = line.split(" | ").collect();
        let [_, _, place, shown @ ..] = cells.as_slice() else { return true };
        let shows = shown.iter().any(|cell| cell.contains('`'));
        !(shows || place.starts_with("None: "))
    };
    let rows = page.lines().filter(|line| line.starts_with("| "));
    let rows = rows.filter(|line| !line.starts_with("| section") && !line.starts_with("| ---"));
    none(&rows.filter(is_bare).map(str::to_owned).collect::<Vec<_>>());
}
