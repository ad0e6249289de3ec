//! Casts segments, by whichever engine, and says of each what is known.
//!
//! `unknown` means one thing of a first hit, whatever the reason: the segment is proved clear
//! before `t`, and no more is known for certain. Of all hits, it is a place where the stored
//! surface is met and the mesh's may be.

use crate::args::SearchArgs;
use meshsweep_core::query::tree::{self, Facing, ScratchEntry};
use meshsweep_core::query::{
    AllHits, Budget, Ended, Hit, Search, SegmentHit, Work, all_hits, first_hit, outer_hits,
};
use meshsweep_core::refine::{Face, RefinedHull};
use meshsweep_core::{Bvh, Model, QueryError, QueueEntry};

/// Hits that fit at first; a segment with more is asked again with as much room as it needs.
const HITS: usize = 64;

/// Faces that wait on the hull; more cost a search to find again, not an answer.
const CANDIDATES: usize = 1024;

/// What is known of a segment, or of one of its hits.
#[derive(Clone, Copy)]
pub enum Verdict {
    Hit(Hit),
    Clear,
    /// Clear before this parameter; of all hits, where the stored `triangle` is met.
    Unknown {
        t: f32,
        triangle: Option<u32>,
    },
}

/// One line of output.
pub struct Row {
    pub query: usize,
    pub verdict: Verdict,
    pub work: Work,
}

/// An engine with its working memory.
enum Engine<'a> {
    Tree { tree: Bvh<'a>, facing: Facing, stack: Vec<ScratchEntry> },
    Cover { model: &'a Model<'a>, queue: Vec<QueueEntry> },
    Hull { model: &'a Model<'a>, queue: Vec<QueueEntry>, front: Memory },
}

/// What a front is kept in.
struct Memory {
    performed: Vec<u32>,
    swept: Vec<u32>,
    candidates: Vec<Face>,
}

pub struct Caster<'a> {
    engine: Engine<'a>,
    stop: Budget,
    hits: Vec<Hit>,
}

impl<'a> Caster<'a> {
    /// By the box tree.
    pub fn tree(tree: Bvh<'a>, facing: Facing, search: &SearchArgs) -> Self {
        Self::new(Engine::Tree { tree, facing, stack: search.stack(&tree) }, search)
    }

    /// By the cover tree.
    pub fn cover(model: &'a Model<'a>, search: &SearchArgs) -> Self {
        Self::new(Engine::Cover { model, queue: search.queue(model) }, search)
    }

    /// First hits by the refined hull, by the cover tree where a segment does not start outside.
    pub fn hull(model: &'a Model<'a>, search: &SearchArgs) -> Self {
        let words = model.capacities().front_words;
        let front = Memory {
            performed: vec![0; words],
            swept: vec![0; words],
            candidates: vec![Face::EMPTY; CANDIDATES],
        };
        Self::new(Engine::Hull { model, queue: search.queue(model), front }, search)
    }

    fn new(engine: Engine<'a>, search: &SearchArgs) -> Self {
        Caster { engine, stop: search.stop(0.0, 0.0), hits: vec![Hit::EMPTY; HITS] }
    }

    /// The first hit: one row.
    pub fn first(
        &mut self,
        query: usize,
        segment: [f32; 6],
        rows: &mut Vec<Row>,
    ) -> Result<(Ended, Work), QueryError> {
        let [a, b] = ends(segment);
        let answer = match &mut self.engine {
            Engine::Tree { tree, facing, stack } => tree::first_hit(tree, a, b, facing, stack)?,
            Engine::Cover { model, queue } => first_hit(model, a, b, &self.stop, queue)?,
            Engine::Hull { model, queue, front } => {
                match on_hull(model, a, b, front, &mut self.hits)? {
                    Some(answer) => answer,
                    None => first_hit(model, a, b, &self.stop, queue)?,
                }
            }
        };
        let verdict = match answer.hit {
            _ if answer.is_clear() => Verdict::Clear,
            Some(hit) if answer.ended == Ended::Exact => Verdict::Hit(hit),
            _ => Verdict::Unknown { t: answer.lower, triangle: None },
        };
        rows.push(Row { query, verdict, work: answer.work });
        Ok((answer.ended, answer.work))
    }

    /// All hits: a row for each, or one that says that there is none.
    pub fn all(
        &mut self,
        query: usize,
        segment: [f32; 6],
        rows: &mut Vec<Row>,
    ) -> Result<(Ended, Work), QueryError> {
        let mut found = self.collect(segment)?;
        if found.dropped > 0 {
            self.hits.resize(found.stored + found.dropped as usize, Hit::EMPTY);
            found = self.collect(segment)?;
        }
        let work = found.work;
        let is_exact = found.ended == Ended::Exact;
        for &hit in self.hits.iter().take(found.stored) {
            // A place from which on the surface may be; its t was rounded to nearest.
            let from = hit.t.next_down().max(0.0);
            let verdict = if found.ended == Ended::Level {
                Verdict::Unknown { t: from, triangle: hit.triangle }
            } else {
                Verdict::Hit(hit)
            };
            rows.push(Row { query, verdict, work });
        }
        let anywhere = Verdict::Unknown { t: 0.0, triangle: None };
        if found.ended == Ended::Capacity {
            // Hits may be missing anywhere.
            rows.push(Row { query, verdict: anywhere, work });
        } else if found.stored == 0 {
            let verdict = if is_exact { Verdict::Clear } else { anywhere };
            rows.push(Row { query, verdict, work });
        }
        Ok((found.ended, work))
    }

    fn collect(&mut self, segment: [f32; 6]) -> Result<AllHits, QueryError> {
        let [a, b] = ends(segment);
        match &mut self.engine {
            Engine::Tree { tree, facing, stack } => {
                tree::all_hits(tree, a, b, facing, &mut self.hits, stack)
            }
            Engine::Cover { model, queue } | Engine::Hull { model, queue, .. } => {
                all_hits(model, a, b, queue, &mut self.hits)
            }
        }
    }
}

/// The first hit by the refined hull; `None` if the segment does not start outside.
fn on_hull(
    model: &Model<'_>,
    a: [f32; 3],
    b: [f32; 3],
    memory: &mut Memory,
    hits: &mut [Hit],
) -> Result<Option<SegmentHit>, QueryError> {
    let mut front =
        RefinedHull::new(&mut memory.performed, &mut memory.swept, &mut memory.candidates);
    let outer = outer_hits(model, a, b, Search::First, &mut front, hits)?;
    if outer.starts_inside {
        return Ok(None);
    }
    let hit = hits.first().copied().filter(|_| outer.stored > 0);
    let (lower, upper) = (outer.lower, outer.upper);
    Ok(Some(SegmentHit { lower, upper, hit, work: outer.work, ended: outer.ended }))
}

pub fn ends([ax, ay, az, bx, by, bz]: [f32; 6]) -> [[f32; 3]; 2] {
    [[ax, ay, az], [bx, by, bz]]
}
