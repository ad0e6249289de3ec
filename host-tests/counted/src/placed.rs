//! Questions of any blob at places in a row, as a board reads them.

use std::hint::black_box;

use meshsweep_suite::ask::placed::{self, Answer, Memory, Placed};
use meshsweep_suite::fold::Fold;

/// Asks at the first `queries` places. With means of an update's faces and changed splits, and the
/// part of the updates that lacked memory.
///
/// # Errors
/// The core's refusal.
pub fn ask(laid: &[u8], queries: usize) -> Result<String, String> {
    let (mut faces, mut changed, mut short) = (0u64, 0u64, 0u64);
    told(laid, queries, |answer| {
        if let Answer::Refined(update) = black_box(answer) {
            faces += u64::from(update.faces);
            changed += u64::from(update.performed + update.undone);
            short += u64::from(update.error_left > 0.0);
        }
    })?;
    let mean = |sum: u64| sum as f64 / queries.max(1) as f64;
    Ok(if faces == 0 {
        String::new()
    } else {
        let [faces, changed, short] = [faces, changed, short].map(mean);
        format!("{faces:.0} faces, {changed:.1} splits changed, {short:.2} of the updates short")
    })
}

/// The lines that a board prints for the first `queries` places, without its costs.
///
/// # Errors
/// The core's refusal.
pub fn expected(laid: &[u8], queries: usize) -> Result<String, String> {
    let mut fold = Fold::new();
    told(laid, queries, |answer| answer.told(&mut fold))?;
    let blob = read(laid)?.blob;
    let hash = Fold::of_bytes(blob);
    Ok(format!("blob {} {hash:016x}\nblock asked 0 {:016x}\ndone\n", blob.len(), fold.finish()))
}

/// The places of the first `queries` queries, each with its answer.
///
/// # Errors
/// The core's refusal.
pub fn answers(
    laid: &[u8],
    queries: usize,
    mut each: impl FnMut(&[[f32; 3]], &Answer),
) -> Result<(), String> {
    let placed = read(laid)?;
    let places: Vec<[f32; 3]> = placed.places().collect();
    let mut next = places.chunks(placed.question.places());
    told(laid, queries, |answer| {
        if let Some(place) = next.next() {
            each(place, answer);
        }
    })?;
    Ok(())
}

fn told(laid: &[u8], queries: usize, each: impl FnMut(&Answer)) -> Result<usize, String> {
    let memory = &mut Box::new(Memory::new());
    let bytes = placed::ask(&read(laid)?, queries, memory, &mut (), each);
    bytes.map_err(|refused| format!("the core refuses the blob: error {}", refused.0))
}

fn read(laid: &[u8]) -> Result<Placed<'_>, String> {
    Placed::read(laid).ok_or_else(|| "the bytes of a question end early".to_owned())
}
