//! Updates of a free motion, and closest points after them, of any blob that deforms.

use std::hint::black_box;

use meshsweep_core::{Budget, DeformableHull, MovedVertex, QueryError, ScratchEntry, VertIdx};

use crate::Counted;

/// A slack that no motion uses up.
const SLACK: f32 = 1e30;
/// Shear from one frame to the next.
const STEP: f32 = 1e-4;

/// Updates a moved hull so many times, or asks it after one update; or follows it with a sweep. The
/// mesh is sheared by half of its size.
pub fn ask(counted: &Counted<'_>, question: &str, queries: usize) -> Result<(), String> {
    let refused = |error: QueryError| error.to_string();
    let hull = DeformableHull::open(counted.blob).map_err(|error| error.to_string())?;
    let rest = hull.rest();
    let mut places = vec![[0.0; 3]; hull.input_vertices() as usize];
    let of_surface =
        (0..rest.header().vertices).map(VertIdx).filter(|&v| rest.split_of(v).is_none());
    for (rank, vertex) in (0..).zip(of_surface) {
        let number = hull.vertex_number(rank).ok_or("a vertex without a number")?;
        let [x, y, z] = rest.vertex(vertex).ok_or("a vertex without a place")?;
        places[number as usize] = [x + 0.5 * z, y, z];
    }
    let mut memory = vec![MovedVertex::EMPTY; hull.vertex_records()];
    let mut moved = hull.moved(&mut memory).map_err(refused)?;
    moved.update(|vertex| places[vertex as usize]).map_err(refused)?;
    let mut scratch = vec![ScratchEntry::EMPTY; rest.scratch_entries()];
    match question {
        "update" => {
            for _ in 0..queries {
                moved.update(|vertex| places[vertex as usize]).map_err(refused)?;
            }
        }
        "within" => {
            for _ in 0..queries {
                moved.update_within(SLACK, |vertex| places[vertex as usize]).map_err(refused)?;
            }
        }
        "kept" => {
            let point = counted.points(1).next().ok_or("no point")?;
            let mut queue = vec![ScratchEntry::EMPTY; rest.sweep_entries()];
            let mut sweep = moved.sweep(point, &mut queue).map_err(refused)?;
            let [low, high] = rest.bounds();
            let slack = 0.02 * (0..3).map(|k| high[k] - low[k]).fold(0.0, f32::max);
            for step in 0..queries {
                let by = STEP * step as f32;
                let place = |[x, y, z]: [f32; 3]| [x + by * z, y, z];
                let update = sweep.update_within(slack, |vertex| place(places[vertex as usize]));
                update.map_err(refused)?;
                black_box(sweep.closest_point(Budget::EXACT).map_err(refused)?);
            }
        }
        "closest" => {
            for point in counted.points(queries) {
                let answer = moved.closest_point(point, Budget::EXACT, &mut scratch);
                black_box(answer.map_err(refused)?);
            }
        }
        _ => return Err(format!("no question `{question}` to a hull that deforms")),
    }
    Ok(())
}
