//! Questions to a box tree.

use std::hint::black_box;

use meshsweep_core::{
    Budget, Bvh, Facing, Hint, ProcessorQuestions, QueryError, ScratchEntry, Work,
};

use crate::Counted;

/// Sums the answers' work, and tells it with the triangles of a leaf.
pub fn ask(counted: &Counted<'_>, question: &str, queries: usize) -> Result<String, String> {
    let tree = Bvh::open(counted.blob).map_err(|error| error.to_string())?;
    let header = *tree.header();
    let failed = |error: QueryError| error.to_string();
    let mut sum = Work::default();
    let mut add = |work: Work| {
        sum.opened += work.opened;
        sum.triangles += work.triangles;
    };
    let mut stack = vec![ScratchEntry::EMPTY; header.stack_entries as usize];
    match question {
        "overlap" => {
            let mut stack = [ScratchEntry::EMPTY; Bvh::OVERLAP_ENTRIES];
            for pose in counted.poses(queries) {
                let answer = black_box(tree.overlap(&tree, pose, Budget::EXACT, &mut stack));
                add(answer.map_err(failed)?.work);
            }
        }
        "closest" => {
            for point in counted.points(queries) {
                let answer = black_box(tree.closest_point(point, Budget::EXACT, &mut stack));
                add(answer.map_err(failed)?.work);
            }
        }
        "closest_avx2" => {
            let questions = avx2()?;
            for point in counted.points(queries) {
                let mut hint = Hint::NONE;
                let ask = questions.closest_point_from;
                let answer = ask(&tree, point, &mut hint, Budget::EXACT, &mut stack);
                add(black_box(answer).map_err(failed)?.work);
            }
        }
        "first_hit_avx2" => {
            let questions = avx2()?;
            for [a, b] in counted.segments(queries) {
                let (facing, ask) = (Facing::Both, questions.first_hit);
                let answer = ask(&tree, a, b, facing, Budget::EXACT, &mut stack);
                add(black_box(answer).map_err(failed)?.work);
            }
        }
        "within" => {
            for &[x, y, z, distance] in counted.rows(queries) {
                let point = [x, y, z];
                let answer = black_box(tree.within(point, distance, Budget::EXACT, &mut stack));
                add(answer.map_err(failed)?.work);
            }
        }
        "first_hit" => {
            for [a, b] in counted.segments(queries) {
                let facing = Facing::Both;
                let answer = black_box(tree.first_hit(a, b, facing, Budget::EXACT, &mut stack));
                add(answer.map_err(failed)?.work);
            }
        }
        _ => return Err(format!("no question `{question}` to a box tree")),
    }
    let a_leaf = f64::from(header.triangles) / f64::from(header.leaves);
    Ok(format!("{} {} {a_leaf}", sum.opened, sum.triangles))
}

/// Questions for AVX2.
#[cfg(target_arch = "x86_64")]
fn avx2() -> Result<ProcessorQuestions, String> {
    if !meshsweep_core::has_avx2!() {
        return Err("this processor has no AVX2".to_owned());
    }
    // SAFETY: the processor has all features of the function's list.
    Ok(unsafe { ProcessorQuestions::avx2() })
}

#[cfg(not(target_arch = "x86_64"))]
fn avx2() -> Result<ProcessorQuestions, String> {
    Ok(ProcessorQuestions::COMPILED)
}
