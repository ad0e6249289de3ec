//! Whether a model, moved by each of some poses, keeps a distance from another one: what the
//! structures cost that can tell, and at which poses they cannot.

use super::blobs::{NotBuilt, kept};
use super::cost::{Board, Search, features_of_pair};
use super::fitted::cost;
use super::measure::Instructions;
use crate::builder::{Builder, Built, Recipe};
use crate::load::{Loaded, Source};
use crate::surface::VertexBits;
use meshsweep_core::{
    Blob, Budget, Bvh, Ended, Pose, QueryError, ScratchEntry, Undecided, Verdict, Work,
};
use rayon::prelude::*;
use std::fmt;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A structure of both models that can tell whether they keep a distance. `Display` prints the
/// options with which the program builds it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum PairStructure {
    /// Box trees for segments.
    Trees(VertexBits),
    /// Tight hulls of at most so many faces, not polished.
    Tight(u32),
    /// At most so many triboxes each.
    Triboxes(u32),
}

impl PairStructure {
    /// Box trees of f32 vertices. Their verdicts are those that others are compared with.
    pub const EXACT: Self = Self::Trees(VertexBits::F32);

    /// All that are measured. Hulls have no more faces than the larger mesh, but for the coarsest.
    fn of(triangles: usize) -> Vec<Self> {
        let mut all = vec![Self::EXACT, Self::Trees(VertexBits::Grid16)];
        let faces = [1000, 200, 50].into_iter();
        all.extend(faces.filter(|&faces| faces as usize <= triangles.max(50)).map(Self::Tight));
        all.extend([64, 8].map(Self::Triboxes));
        all
    }

    /// The structure and its size in words.
    #[must_use]
    pub fn name(self) -> String {
        match self {
            Self::Trees(bits) => format!("box trees, {bits} bits"),
            Self::Tight(faces) => format!("tight hulls, {faces} faces"),
            Self::Triboxes(count) => format!("triboxes, {count}"),
        }
    }

    /// The search whose costs it has. `None` of box trees of f32 vertices: none of their kind was
    /// counted. Tight hulls are asked as box trees.
    #[must_use]
    pub const fn search(self) -> Option<Search> {
        match self {
            Self::Trees(VertexBits::F32) => None,
            Self::Trees(_) | Self::Tight(_) => Some(Search::PairOfTrees),
            Self::Triboxes(_) => Some(Search::PairOfTriboxes),
        }
    }

    fn builder(self) -> Builder<'static> {
        match self {
            Self::Trees(bits) => Builder::of(Recipe::SegmentTree(bits)),
            Self::Tight(faces) => Builder::of(Recipe::Tight(faces)).tight_for(false, true),
            Self::Triboxes(count) => Builder::of(Recipe::Triboxes(count)),
        }
    }

    fn build(self, source: &Source, repaired: &Loaded) -> Result<Built, NotBuilt> {
        let built = self.builder().build_repaired(source, repaired)?;
        match self {
            Self::Tight(faces) => kept(Recipe::Tight(faces), &built),
            _ => Ok(built),
        }
    }

    /// Asks at every pose. Verdicts with their work, and the bytes of scratch.
    fn ask(
        self,
        [first, second]: [&Blob<'_>; 2],
        poses: &[Pose],
        keep: f32,
    ) -> Result<Asked, (usize, QueryError)> {
        let trees = |of: [Bvh<'_>; 2]| {
            each(poses, Bvh::DISTANCE_ENTRIES, |pose, scratch| {
                let found = of[0].within_of(&of[1], pose, keep, Budget::EXACT, scratch)?;
                Ok((found.verdict, found.work))
            })
        };
        let opened = |error: QueryError| (0, error);
        match self {
            Self::Trees(_) => trees([first.bvh().map_err(opened)?, second.bvh().map_err(opened)?]),
            Self::Tight(_) => {
                trees([finest(first).map_err(opened)?, finest(second).map_err(opened)?])
            }
            Self::Triboxes(_) => {
                let of = [first.triboxes().map_err(opened)?, second.triboxes().map_err(opened)?];
                let entries = of[0].separation_entries(&of[1]);
                each(poses, entries, |pose, scratch| {
                    let found = of[0].within_of(&of[1], pose, keep, Budget::EXACT, scratch)?;
                    let undecided = match found.ended {
                        Ended::Scratch => Undecided::Scratch,
                        _ => Undecided::Resolution,
                    };
                    let is_clear = found.is_apart();
                    let verdict =
                        if is_clear { Verdict::No } else { Verdict::Undecided(undecided) };
                    Ok((verdict, found.work))
                })
            }
        }
    }
}

impl fmt::Display for PairStructure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.builder().fmt(f)
    }
}

fn finest<'a>(blob: &Blob<'a>) -> Result<Bvh<'a>, QueryError> {
    blob.tight_hulls()?.finest().map(|hull| *hull.bvh()).ok_or(QueryError::Unchecked)
}

/// The answers at all poses.
struct Asked {
    answers: Vec<(Verdict, Work)>,
    scratch: usize,
}

fn each(
    poses: &[Pose],
    entries: usize,
    mut one: impl FnMut(Pose, &mut [ScratchEntry]) -> Result<(Verdict, Work), QueryError>,
) -> Result<Asked, (usize, QueryError)> {
    let mut scratch = vec![ScratchEntry::EMPTY; entries];
    let asked = poses.iter().enumerate();
    let answers = asked.map(|(at, pose)| one(*pose, &mut scratch).map_err(|error| (at, error)));
    let answers = answers.collect::<Result<Vec<_>, _>>()?;
    Ok(Asked { answers, scratch: size_of_val(scratch.as_slice()) })
}

/// A structure of two models, its verdicts and its costs.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct PairRow {
    /// The structure.
    pub structure: PairStructure,
    /// Predicted, in the order of [`Board::ALL`]; `None` if no cost was fitted.
    pub boards: [Option<Instructions>; 2],
    /// Bytes of the processor's stack below the caller, at most, by board.
    pub stack: [u32; 2],
    /// Poses that it proves to keep the distance.
    pub clear: usize,
    /// Poses that [`PairStructure::EXACT`] proves to keep it and this one does not.
    pub false_alarms: usize,
    /// Poses without a verdict.
    pub undecided: usize,
    /// Poses that a tight hull calls clear although they are not: a model reached the inside of the
    /// other's hull, where its surface is far.
    pub missed: usize,
    /// Bytes of both blobs.
    pub flash: [usize; 2],
    /// Bytes of scratch.
    pub scratch: usize,
}

/// What is measured of two models.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct PairTrade {
    /// Poses at which the models keep the distance, by [`PairStructure::EXACT`].
    pub clear: usize,
    /// A row for each structure that was built.
    pub rows: Vec<PairRow>,
    /// Structures that one of the meshes does not allow, and why.
    pub missing: Vec<(PairStructure, NotBuilt)>,
}

/// Why two models were not measured.
#[derive(Clone, Debug, PartialEq)]
pub enum PairError {
    /// A mesh has no box tree. Its index, and why.
    NoTree(usize, NotBuilt),
    /// The pose of this index was refused.
    Refused(usize, QueryError),
}

/// Measures which structures tell that the second mesh, moved by each pose, is farther than `keep`
/// from the first one. Meshes are as read and as repaired. Structures are built on all cores.
/// `progress` is called from any of them, with the number of structures done, and of how many.
///
/// # Errors
/// [`PairError`].
pub fn measure_pair(
    meshes: [(&Source, &Loaded); 2],
    poses: &[Pose],
    keep: f32,
    progress: &(dyn Fn(usize, usize) + Sync),
) -> Result<PairTrade, PairError> {
    let triangles = meshes.map(|(_, loaded)| loaded.mesh.triangles.len());
    let structures = PairStructure::of(triangles[0].max(triangles[1]));
    let (done, of) = (AtomicUsize::new(0), structures.len());
    let measured = structures.par_iter().with_max_len(1).map(|&structure| {
        let both = meshes.map(|(source, loaded)| structure.build(source, loaded));
        let [first, second] = both;
        let result = match (first, second) {
            (Ok(first), Ok(second)) => {
                let asked = structure.ask([&first.blob(), &second.blob()], poses, keep);
                let asked = asked.map_err(|(at, error)| PairError::Refused(at, error))?;
                Ok((asked, [first.bytes().len(), second.bytes().len()]))
            }
            (Err(reason), _) => Err((0, reason)),
            (_, Err(reason)) => Err((1, reason)),
        };
        progress(done.fetch_add(1, Ordering::Relaxed) + 1, of);
        Ok((structure, result))
    });
    let measured = measured.collect::<Result<Vec<_>, PairError>>()?;
    let mut trade = PairTrade { clear: 0, rows: Vec::new(), missing: Vec::new() };
    let mut exact: Vec<Verdict> = Vec::new();
    for (structure, result) in measured {
        match result {
            Ok((asked, flash)) => {
                if structure == PairStructure::EXACT {
                    exact = asked.answers.iter().map(|(verdict, _)| *verdict).collect();
                    trade.clear = exact.iter().filter(|verdict| is_clear(verdict)).count();
                }
                trade.rows.push(row(structure, &asked, &exact, flash));
            }
            Err((mesh, reason)) if structure == PairStructure::EXACT => {
                return Err(PairError::NoTree(mesh, reason));
            }
            Err((_, reason)) => trade.missing.push((structure, reason)),
        }
    }
    Ok(trade)
}

fn is_clear(verdict: &Verdict) -> bool {
    matches!(verdict, Verdict::No)
}

fn row(
    structure: PairStructure,
    Asked { answers, scratch }: &Asked,
    exact: &[Verdict],
    flash: [usize; 2],
) -> PairRow {
    let boards = Board::ALL.map(|board| {
        let search = structure.search()?;
        let cost = cost(board, search)?;
        let all = answers.iter().map(|(_, work)| cost.of(&features_of_pair(work)));
        Some(Instructions::of(cost, &all.collect::<Vec<_>>()))
    });
    // Box trees of any vertices are asked alike.
    let search = structure.search().unwrap_or(Search::PairOfTrees);
    let count = |is: &dyn Fn(&Verdict, &Verdict) -> bool| {
        answers.iter().zip(exact).filter(|((verdict, _), exact)| is(verdict, exact)).count()
    };
    PairRow {
        structure,
        boards,
        stack: Board::ALL.map(|board| search.stack(board)),
        clear: count(&|verdict, _| is_clear(verdict)),
        false_alarms: count(&|verdict, exact| !is_clear(verdict) && is_clear(exact)),
        undecided: count(&|verdict, _| matches!(verdict, Verdict::Undecided(_))),
        missed: count(&|verdict, exact| is_clear(verdict) && *exact == Verdict::Yes),
        flash,
        scratch: *scratch,
    }
}
