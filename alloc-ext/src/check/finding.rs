//! What came of one proof.

/// What came of one proof.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The claim holds.
    Proved,
    /// The claim does not hold.
    Failed,
    /// There is no proof, neither of the claim nor of its opposite.
    NotProved,
}

/// A claim of a blob, and what came of its proof.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// The structure of the blob: "box tree".
    pub structure: &'static str,
    /// What came of the proof.
    pub outcome: Outcome,
    /// What was proved; else what does not hold, with its place, or why there is no proof.
    pub words: String,
    /// What was counted on the way, by nouns in the singular.
    pub counts: Vec<(&'static str, usize)>,
}

impl Finding {
    pub(crate) fn proved(
        structure: &'static str,
        words: &str,
        counts: &[(&'static str, usize)],
    ) -> Self {
        let counts = counts.iter().copied().filter(|&(_, count)| count > 0).collect();
        Self { structure, outcome: Outcome::Proved, words: words.to_owned(), counts }
    }

    pub(crate) fn failed(structure: &'static str, words: String) -> Self {
        Self { structure, outcome: Outcome::Failed, words, counts: Vec::new() }
    }

    pub(crate) fn not_proved(structure: &'static str, words: String) -> Self {
        Self { structure, outcome: Outcome::NotProved, words, counts: Vec::new() }
    }
}
