//! Hashes of the answers to the suite, for blobs that are committed. A machine, a processor or a
//! compiler that computes other bits is noticed.

use std::fs;
use std::path::Path;

use meshsweep_suite::ask::{
    Refused, Subject, apart, both, curve, deform, hull, hull_moving, sdf, tight, tree, triboxes,
};
use meshsweep_suite::fold::Fold;
use meshsweep_suite::{Kind, Observer, Plan, Recorder, run};

/// Hashes of the answers of a blob: its name and its bytes.
type Answers = fn(&str, &[u8]) -> Result<String, Refused>;

/// The committed blobs of today's builder, by the structure that is asked.
const FIXTURES: [(&str, Answers); 9] = [
    ("bracket.msw", hull_answers),
    ("groove.msw", tree_answers),
    ("torus.msw", |name, blob| answers::<triboxes::Triboxes<'_>>(name, blob)),
    ("hulls.msw", |name, blob| answers::<tight::Hulls<'_>>(name, blob)),
    ("fence.msw", |name, blob| answers::<curve::Curve<'_>>(name, blob)),
    ("field.msw", |name, blob| answers::<sdf::Sdf<'_>>(name, blob)),
    ("both.msw", |name, blob| answers::<both::BvhWithSdf<'_>>(name, blob)),
    ("sieve.msw", hull_answers),
    ("bend.msw", |name, blob| answers::<deform::DeformableHull<'_>>(name, blob)),
];

/// Blobs of builders of before, with every kind of section: later readers still have to give the
/// same answers about them.
const KEPT: [(&str, Answers); 11] = [
    ("bracket_tree.msw", tree_answers),
    ("groove.msw", tree_answers),
    ("single_tree.msw", tree_answers),
    ("soup_tree.msw", tree_answers),
    ("torus_tree.msw", tree_answers),
    ("sides.msw", tree_answers),
    ("bend.msw", |name, blob| answers::<deform::DeformableHull<'_>>(name, blob)),
    ("triboxes.msw", |name, blob| answers::<triboxes::Triboxes<'_>>(name, blob)),
    ("hulls.msw", |name, blob| answers::<tight::Hulls<'_>>(name, blob)),
    ("zones.msw", |name, blob| answers::<curve::Curve<'_>>(name, blob)),
    ("field.msw", |name, blob| answers::<sdf::Sdf<'_>>(name, blob)),
];

/// A line for each committed blob and kind of query: the blob's name, the kind, and a hash of all
/// answers' bits.
///
/// # Errors
/// A file that cannot be read, or the core's refusal of a blob.
pub fn of_fixtures(folder: &Path) -> Result<String, String> {
    of(&FIXTURES, folder)
}

/// The same lines for the kept blobs. The folder is theirs.
///
/// # Errors
/// A file that cannot be read, or the core's refusal of a blob.
pub fn of_kept(folder: &Path) -> Result<String, String> {
    of(&KEPT, folder)
}

fn of(blobs: &[(&str, Answers)], folder: &Path) -> Result<String, String> {
    let mut lines = String::new();
    for (name, answers) in blobs {
        let answers = answers(name, &read(folder, name)?);
        lines += &answers.map_err(|refused| format!("{name} is refused: {refused:?}"))?;
    }
    Ok(lines)
}

fn read(folder: &Path, name: &str) -> Result<Vec<u8>, String> {
    let file = folder.join(name);
    fs::read(&file).map_err(|error| format!("{}: {error}", file.display()))
}

fn hull_answers(name: &str, blob: &[u8]) -> Result<String, Refused> {
    let alone = answers::<hull::Model<'_>>(name, blob)?;
    Ok(alone + &answers::<hull_moving::Moving<'_>>(name, blob)?)
}

fn tree_answers(name: &str, blob: &[u8]) -> Result<String, Refused> {
    let points = answers::<tree::Bvh<'_>>(name, blob)?;
    Ok(points + &answers::<apart::Apart<'_>>(name, blob)?)
}

fn answers<'t, S: Subject<'t, Scratch: Default>>(
    name: &str,
    blob: &'t [u8],
) -> Result<String, Refused> {
    let mut lines = Lines { name: name.to_owned(), fold: Fold::new(), text: String::new() };
    run::<S>(blob, Plan::STANDARD, &mut S::Scratch::default(), &mut lines)?;
    Ok(lines.text)
}

struct Lines {
    name: String,
    fold: Fold,
    text: String,
}

impl Observer for Lines {}

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
