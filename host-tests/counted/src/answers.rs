//! Hashes of the answers to the suite, for blobs that are committed. A machine, a processor or a
//! compiler that computes other bits is noticed.

use std::fs;
use std::path::Path;

use meshsweep_suite::ask::{
    Refused, Subject, apart, curve, deform, hull, hull_moving, tight, tree, triboxes,
};
use meshsweep_suite::fold::Fold;
use meshsweep_suite::{Clock, Kind, Plan, Recorder, run};

/// Hashes of the answers of a blob: its name, its bytes, and what is asked.
type Answers = fn(&str, &[u8], Plan) -> Result<String, Refused>;

/// The committed blobs of today's builder, by the structure that is asked.
const FIXTURES: [(&str, Answers); 7] = [
    ("bracket.msw", hull_answers),
    ("groove.msw", tree_answers),
    ("torus.msw", |name, blob, plan| answers::<triboxes::Triboxes<'_>>(name, blob, plan)),
    ("hulls.msw", |name, blob, plan| answers::<tight::Hulls<'_>>(name, blob, plan)),
    ("fence.msw", |name, blob, plan| answers::<curve::Curve<'_>>(name, blob, plan)),
    ("sieve.msw", hull_answers),
    ("bend.msw", |name, blob, plan| answers::<deform::DeformableHull<'_>>(name, blob, plan)),
];

/// Box trees that no builder makes any more: when the packer changes, the kernels still have to
/// give the answers of before about the same blobs.
const KEPT: [&str; 5] =
    ["bracket_tree.msw", "groove.msw", "single_tree.msw", "soup_tree.msw", "torus_tree.msw"];

/// A line for each committed blob and kind of query: the blob's name, the kind, and a hash of all
/// answers' bits.
///
/// # Errors
/// A file that cannot be read, or the core's refusal of a blob.
pub fn of_fixtures(folder: &Path) -> Result<String, String> {
    let mut lines = String::new();
    for (name, answers) in FIXTURES {
        let answers = answers(name, &read(folder, name)?, Plan::STANDARD);
        lines += &answers.map_err(|refused| format!("{name} is refused: {refused:?}"))?;
    }
    Ok(lines)
}

/// A line for each kept blob and kind of query: the blob's name, the kind, a hash of the answers
/// without their work counters, and a hash of both. The folder is the one of the kept blobs.
///
/// # Errors
/// A file that cannot be read, or the core's refusal of a blob.
pub fn of_kept(folder: &Path) -> Result<String, String> {
    let mut lines = String::new();
    for name in KEPT {
        let blob = read(folder, name)?;
        let hashes = |takes_work: bool| {
            let answers = tree_answers(name, &blob, Plan { takes_work, ..Plan::STANDARD });
            answers.map_err(|refused| format!("{name} is refused: {refused:?}"))
        };
        for (answers, both) in hashes(false)?.lines().zip(hashes(true)?.lines()) {
            let both = both.rsplit(' ').next().unwrap_or_default();
            lines += &format!("{answers} {both}\n");
        }
    }
    Ok(lines)
}

fn read(folder: &Path, name: &str) -> Result<Vec<u8>, String> {
    let file = folder.join(name);
    fs::read(&file).map_err(|error| format!("{}: {error}", file.display()))
}

fn hull_answers(name: &str, blob: &[u8], plan: Plan) -> Result<String, Refused> {
    let alone = answers::<hull::Model<'_>>(name, blob, plan)?;
    Ok(alone + &answers::<hull_moving::Moving<'_>>(name, blob, plan)?)
}

fn tree_answers(name: &str, blob: &[u8], plan: Plan) -> Result<String, Refused> {
    let points = answers::<tree::Bvh<'_>>(name, blob, plan)?;
    Ok(points + &answers::<apart::Apart<'_>>(name, blob, plan)?)
}

fn answers<'t, S: Subject<'t, Scratch: Default>>(
    name: &str,
    blob: &'t [u8],
    plan: Plan,
) -> Result<String, Refused> {
    let mut lines = Lines { name: name.to_owned(), fold: Fold::new(), text: String::new() };
    run::<S>(blob, plan, &mut S::Scratch::default(), &mut lines)?;
    Ok(lines.text)
}

struct Lines {
    name: String,
    fold: Fold,
    text: String,
}

impl Clock for Lines {}

impl Recorder for Lines {
    fn kind_begins(&mut self, _kind: Kind) {
        self.fold = Fold::new();
    }

    fn block(&mut self, _kind: Kind, _index: u32, hash: u64) {
        hash.to_le_bytes().into_iter().for_each(|byte| self.fold.byte(byte));
    }

    fn kind_ends(&mut self, kind: Kind) {
        let Self { name, fold, text } = self;
        text.push_str(&format!("{name} {} {:016x}\n", kind.name(), fold.finish()));
    }
}
