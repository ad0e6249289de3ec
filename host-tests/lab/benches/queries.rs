//! Closest points and segments beside parry3d: `cargo bench -p meshsweep-lab --bench
//! queries`.
//!
//! Each sample is one query out of a fixed list. Work counters, which no busy machine disturbs, are
//! in `cargo xtask measure`.

use std::hint::black_box;
use std::path::Path;

use divan::Bencher;
use meshsweep::collapse::Priority;
use meshsweep_core::{Budget, Hit, Hull, RefinedHull, ScratchEntry, Search};
use meshsweep_host_tests::workload::Subject;
use meshsweep_host_tests::workload::{Points, points, segments};
use meshsweep_lab::measure::rival::Rival;

const FIXTURES: [&str; 2] = ["bracket.stl", "torus.ply"];
const QUERIES: usize = 1024;

fn main() {
    divan::main();
}

fn subject(file: &str) -> Subject {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fixtures");
    Subject::load(&folder.join(file)).expect("the fixture is a closed mesh")
}

fn blob(subject: &Subject) -> Vec<u8> {
    subject.build(200, Priority::Program).expect("a blob").bytes
}

fn closest(bencher: Bencher<'_, '_>, file: &str, kind: Points) {
    let subject = subject(file);
    let bytes = blob(&subject);
    let model = Hull::open(&bytes).expect("opens");
    let mut queue = vec![ScratchEntry::EMPTY; model.scratch_entries()];
    let asked = points(&subject, kind, QUERIES);
    let mut next = asked.iter().cycle();
    bencher.bench_local(|| {
        let point = next.next().copied().unwrap_or_default();
        model.closest_point(black_box(point), Budget::EXACT, &mut queue)
    });
}

fn closest_by_rival(bencher: Bencher<'_, '_>, file: &str, kind: Points) {
    let subject = subject(file);
    let rival = Rival::new(&subject).expect("a mesh for parry3d too");
    let asked = points(&subject, kind, QUERIES);
    let mut next = asked.iter().cycle();
    bencher.bench_local(|| rival.closest(black_box(next.next().copied().unwrap_or_default())));
}

#[divan::bench(args = FIXTURES)]
fn closest_far(bencher: Bencher<'_, '_>, file: &str) {
    closest(bencher, file, Points::Far);
}

#[divan::bench(args = FIXTURES)]
fn closest_far_parry3d(bencher: Bencher<'_, '_>, file: &str) {
    closest_by_rival(bencher, file, Points::Far);
}

#[divan::bench(args = FIXTURES)]
fn closest_near(bencher: Bencher<'_, '_>, file: &str) {
    closest(bencher, file, Points::Near);
}

#[divan::bench(args = FIXTURES)]
fn closest_near_parry3d(bencher: Bencher<'_, '_>, file: &str) {
    closest_by_rival(bencher, file, Points::Near);
}

#[divan::bench(args = FIXTURES)]
fn segment_first_hit(bencher: Bencher<'_, '_>, file: &str) {
    let subject = subject(file);
    let bytes = blob(&subject);
    let model = Hull::open(&bytes).expect("opens");
    let mut queue = vec![ScratchEntry::EMPTY; model.scratch_entries()];
    let asked = segments(&subject, QUERIES);
    let mut next = asked.iter().cycle();
    bencher.bench_local(|| {
        let [a, b] = black_box(next.next().copied().unwrap_or_default());
        model.first_hit(a, b, Budget::EXACT, &mut queue)
    });
}

#[divan::bench(args = FIXTURES)]
fn segment_outer_hits(bencher: Bencher<'_, '_>, file: &str) {
    let subject = subject(file);
    let bytes = blob(&subject);
    let model = Hull::open(&bytes).expect("opens");
    let mut refined = Box::new(RefinedHull::<1024>::new());
    let mut scratch = [ScratchEntry::EMPTY; 1024];
    let mut hits = [Hit::EMPTY; 16];
    let asked = segments(&subject, QUERIES);
    let mut next = asked.iter().cycle();
    bencher.bench_local(|| {
        let [a, b] = black_box(next.next().copied().unwrap_or_default());
        refined.reset();
        let first = Search::First;
        model.outer_hits(a, b, first, &mut refined, &mut hits, Budget::EXACT, &mut scratch)
    });
}

#[divan::bench(args = FIXTURES)]
fn segment_parry3d(bencher: Bencher<'_, '_>, file: &str) {
    let subject = subject(file);
    let rival = Rival::new(&subject).expect("a mesh for parry3d too");
    let asked = segments(&subject, QUERIES);
    let mut next = asked.iter().cycle();
    bencher.bench_local(|| rival.first_hit(black_box(next.next().copied().unwrap_or_default())));
}
