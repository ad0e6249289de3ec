//! Answers compared with every triangle in f64, and with parry3d's.

use meshsweep_host_tests::workload::Subject;

use super::engine::Answer;
use super::workload::{HitKind, Queries};
use crate::measure::brute::Brute;

/// How well an engine's answers agree with others'.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Agreement {
    /// Answers compared with f64.
    pub checked: usize,
    /// Largest error against f64: of a distance relative to it, of a hit's parameter as it is.
    pub error: f64,
    /// Hits for misses and misses for hits against f64, where no triangle is grazed.
    pub wrong_hits: usize,
    /// Largest difference from parry3d's answer: of a distance in diagonals, of a hit's parameter
    /// as it is.
    pub apart: f64,
    /// Hits where parry3d has a miss, and the other way round.
    pub other_hits: usize,
    /// Segments that are said to hit.
    pub hits: usize,
    /// Answers that are compared with nothing, because neither hit nor miss is proved.
    pub undecided: usize,
}

/// A workload with the true answers to some of its queries.
pub struct Truth<'a> {
    queries: &'a Queries,
    diagonal: f64,
    /// Of the queries every how many-th is known.
    stride: usize,
    /// As [`Truth::value`]; `None` where rounding may decide.
    known: Vec<Option<f64>>,
}

impl<'a> Truth<'a> {
    /// Asks every triangle about at least `count` queries, fewer than twice as many. If there are
    /// fewer queries than `count`, about all.
    pub fn new(subject: &Subject, queries: &'a Queries, count: usize) -> Self {
        let brute = Brute::new(subject);
        let stride = (queries.len() / count).max(1);
        let known = match queries.thinned(stride) {
            Queries::Points(points) => {
                points.iter().map(|&point| Some(brute.distance(point))).collect()
            }
            Queries::Segments(segments, kind) => segments
                .iter()
                .map(|&segment| {
                    let (hit, clear) = brute.first_hit(segment);
                    let hit = if kind == HitKind::Any { hit.map(|_| 0.0) } else { hit };
                    clear.then_some(hit.unwrap_or(f64::INFINITY))
                })
                .collect(),
        };
        Self { queries, diagonal: subject.diagonal(), stride, known }
    }

    /// Compares the answers; `reference` holds parry3d's.
    pub fn compare(&self, answers: &[Answer], reference: &[Answer]) -> Agreement {
        let mut agreement = Agreement::default();
        for (query, answer) in answers.iter().enumerate() {
            let Some(value) = self.value(query, answer) else {
                agreement.undecided += 1;
                continue;
            };
            agreement.hits += usize::from(value.is_finite());
            if query.is_multiple_of(self.stride)
                && let Some(truth) = self.known[query / self.stride]
            {
                agreement.checked += 1;
                let scale = if matches!(self.queries, Queries::Points(_)) { truth } else { 1.0 };
                match difference(value, truth) {
                    Some(difference) => {
                        agreement.error = agreement.error.max(relative(difference, scale))
                    }
                    None => agreement.wrong_hits += 1,
                }
            }
            let scale =
                if matches!(self.queries, Queries::Points(_)) { self.diagonal } else { 1.0 };
            let Some(other) = self.value(query, &reference[query]) else { continue };
            match difference(value, other) {
                Some(difference) => {
                    agreement.apart = agreement.apart.max(relative(difference, scale))
                }
                None => agreement.other_hits += 1,
            }
        }
        agreement
    }

    /// A distance or a parameter: zero for any hit, infinity for a miss. `None` if undecided.
    fn value(&self, query: usize, answer: &Answer) -> Option<f64> {
        match (answer, self.queries) {
            (Answer::Hit(value), _) => Some(f64::from(*value)),
            (Answer::Meets, _) => Some(0.0),
            (Answer::Point(point), Queries::Points(asked)) => Some(distance(asked[query], *point)),
            (Answer::Point(_), Queries::Segments(..)) | (Answer::Miss, _) => Some(f64::INFINITY),
            (Answer::Undecided, _) => None,
        }
    }
}

/// `None` if one of the two is a miss.
fn difference(a: f64, b: f64) -> Option<f64> {
    match (a.is_finite(), b.is_finite()) {
        (true, true) => Some((a - b).abs()),
        (false, false) => Some(0.0),
        _ => None,
    }
}

/// A point that lies on the surface has a distance of zero, and then only zero is right.
fn relative(difference: f64, scale: f64) -> f64 {
    if difference == 0.0 { 0.0 } else { difference / scale }
}

fn distance(a: [f32; 3], b: [f32; 3]) -> f64 {
    (0..3).map(|k| (f64::from(a[k]) - f64::from(b[k])).powi(2)).sum::<f64>().sqrt()
}
