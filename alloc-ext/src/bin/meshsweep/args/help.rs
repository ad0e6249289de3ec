//! The texts below the options: plain files in `help/`, one a command.
//!
//! `-h` shows the examples alone, `--help` all. The terminal breaks lines: a file's lines are
//! joined to paragraphs. A line of two blanks begins an item of a list or is an example.

/// The end of the program's own help.
pub const EXIT_STATUS: &str = "Exit status: 0 done, 1 a file or its content is not usable, or no \
    hull is as tight as asked for, or no setting meets the limits, 2 wrong usage, 3 not proved: a \
    claim that verify proves, or the distance of hausdorff --at-most.";

/// Texts that several commands share, by their marks.
const SHARED: [(&str, &str); 3] = [
    ("{queries}", include_str!("help/queries.txt")),
    ("{triangle}", include_str!("help/triangle.txt")),
    ("{poses}", include_str!("help/poses.txt")),
];

/// Blanks that continue an item of a list.
const CONTINUED: &str = "    ";

/// The help of one command.
pub struct Help {
    /// All of the text.
    pub long: String,
    /// The examples.
    pub short: String,
    /// What `--scratch` of this command says, where that is more than usual.
    pub scratch: Option<&'static str>,
}

impl Help {
    /// By the command's name.
    pub fn of(command: &str) -> Self {
        let long = joined(file(command));
        let short = long.find("Examples:").and_then(|at| long.get(at..)).unwrap_or_default();
        Self { short: short.to_owned(), scratch: scratch(command), long }
    }
}

fn file(command: &str) -> &'static str {
    match command {
        "build" => include_str!("help/build.txt"),
        "info" => include_str!("help/info.txt"),
        "closest" => include_str!("help/closest.txt"),
        "within" => include_str!("help/within.txt"),
        "nearest" => include_str!("help/nearest.txt"),
        "signed" => include_str!("help/signed.txt"),
        "winding" => include_str!("help/winding.txt"),
        "field" => include_str!("help/field.txt"),
        "segment" => include_str!("help/segment.txt"),
        "overlap" => include_str!("help/overlap.txt"),
        "clearance" => include_str!("help/clearance.txt"),
        "clear" => include_str!("help/clear.txt"),
        "hausdorff" => include_str!("help/hausdorff.txt"),
        "cull" => include_str!("help/cull.txt"),
        "hull" => include_str!("help/hull.txt"),
        "refine" => include_str!("help/refine.txt"),
        "cut" => include_str!("help/cut.txt"),
        "tribox" => include_str!("help/tribox.txt"),
        "robot" => include_str!("help/robot.txt"),
        "verify" => include_str!("help/verify.txt"),
        "trade" => include_str!("help/trade.txt"),
        "worst" => include_str!("help/worst.txt"),
        _ => "",
    }
}

fn scratch(command: &str) -> Option<&'static str> {
    Some(match command {
        "closest" | "segment" => {
            "Scratch entries to search with [default: what the blob needs; on the hull hierarchy \
             4096 more]"
        }
        "overlap" => {
            "Scratch entries to search with [default: 256, on hull hierarchies what the blobs \
             need, which always suffice]"
        }
        "clearance" => "Scratch entries to search with [default: 384, which always suffice]",
        _ => return None,
    })
}

/// A file with its shared texts, the lines of a paragraph or an item as one line.
fn joined(file: &str) -> String {
    let mut text = file.to_owned();
    for (mark, shared) in SHARED {
        text = text.replace(mark, shared.trim_end());
    }
    let mut joined = String::new();
    let mut before = "";
    for line in text.lines() {
        let is_prose = |line: &str| !line.is_empty() && !line.starts_with(' ');
        let continues = line.starts_with(CONTINUED) || is_prose(line) && is_prose(before);
        if continues {
            joined.push(' ');
            joined.push_str(line.trim_start());
        } else {
            // Of the first line there is none before.
            joined.push_str(if joined.is_empty() { "" } else { "\n" });
            joined.push_str(line);
        }
        before = line;
    }
    joined
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_a_paragraph_are_joined_and_lists_and_examples_are_not() {
        let text = "One\ntwo.\n\nList:\n  a  first\n     and more\n  b  second\n";
        assert_eq!(joined(text), "One two.\n\nList:\n  a  first and more\n  b  second");
        assert_eq!(joined("Seen: {triangle}.").lines().count(), 1);
    }

    #[test]
    fn every_command_has_a_text_that_ends_with_examples() {
        for command in crate::args::command().get_subcommands() {
            let Help { long, short, .. } = Help::of(command.get_name());
            let begin = format!("Examples:\n  meshsweep {}", command.get_name());
            assert!(long.ends_with(&short) && short.contains("Examples:\n  "), "{begin}");
            assert!(!long.contains('{'), "{}: a mark without a text", command.get_name());
        }
    }
}
