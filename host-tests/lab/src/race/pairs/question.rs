//! The questions about two models, and their answers.

use super::motions::Case;

/// A question about two models at a pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Question {
    /// How far are the models from each other?
    Distance,
    /// Are they within this part of their distance?
    Within(f64),
    /// Do their surfaces meet?
    Meets,
}

impl Question {
    /// All, in the order of the table.
    pub const ALL: [Self; 4] = [Self::Distance, Self::Within(0.5), Self::Within(2.0), Self::Meets];

    /// In tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Distance => "distance",
            Self::Within(part) if part < 1.0 => "within half of it",
            Self::Within(_) => "within twice of it",
            Self::Meets => "meets",
        }
    }

    /// The distance that is asked about.
    pub fn limit(self, case: &Case) -> f32 {
        match self {
            Self::Within(part) => (part * case.truth.upper) as f32,
            _ => 0.0,
        }
    }
}

/// What an engine says.
#[derive(Clone, Copy, Debug)]
pub enum Answer {
    /// Bounds of the distance.
    Bounds(f64, f64),
    /// A distance without bounds.
    About(f64),
    /// Yes or no.
    Is(bool),
    /// Neither.
    Open,
}

/// Answers about all cases, in their order.
pub struct Run {
    /// The answers.
    pub answers: Vec<Answer>,
    /// Pairs of boxes and pairs of triangles in f64, of an engine that tells them.
    pub work: Option<[u64; 2]>,
    /// Processor time of all.
    pub seconds: f64,
}
