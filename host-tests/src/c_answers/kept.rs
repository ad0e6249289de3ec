//! The lines about sweeps that are kept and meshes that deform.

use super::{Kind, ROUNDS, budget, ended};
use meshsweep_core::{
    Budget, ClosestPoint, DeformableHull, FirstHit, Hit, Hull, MovedVertex, QueryError,
    ScratchEntry, Sweep,
};

/// Scratch entries of a sweep.
const KEPT: usize = 512;
const RECORDS: usize = 512;
const VERTICES: usize = 256;

type Lines = Result<String, Box<dyn std::error::Error>>;

impl Kind {
    /// The next triangle, or that none is left.
    fn next(&mut self, found: Option<&ClosestPoint>) {
        self.words(&[0]);
        match found {
            Some(found) => self.closest(found),
            None => {
                self.floats(&[f32::INFINITY, f32::INFINITY, 0.0, 0.0, 0.0]);
                self.words(&[u32::MAX, 1]);
            }
        }
    }

    fn hit(&mut self, found: &FirstHit) {
        let is_proved = found.hit.is_some() && found.ended == meshsweep_core::Ended::Exact;
        let verdict = if found.is_clear() { 2 } else { u32::from(is_proved) };
        self.words(&[0, verdict, ended(found.ended)]);
        self.interval(found.t);
        let hit = found.hit.unwrap_or(Hit::EMPTY);
        self.floats(&[hit.t]);
        self.floats(&hit.point);
        self.words(&[hit.triangle.unwrap_or(u32::MAX)]);
    }

    /// A point near a mesh of about one unit.
    fn near(&mut self) -> [f32; 3] {
        self.point().map(|x| x / 32.0)
    }

    fn vertices(&mut self, count: usize) -> Vec<[f32; 3]> {
        (0..count).map(|_| self.point().map(|x| x / 64.0)).collect()
    }

    fn answers<'a, G: meshsweep_core::internal::hull::Geometry<'a>>(
        &mut self,
        sweep: &mut Sweep<'_, G>,
        place: [f32; 3],
        round: usize,
    ) -> Result<(), QueryError> {
        sweep.move_to(place)?;
        self.words(&[0, 0]);
        self.closest(&sweep.closest_point(budget(round))?);
        for _ in 0..2 {
            let found = sweep.next_triangle(Budget::EXACT)?;
            self.next(found.as_ref());
        }
        Ok(())
    }
}

pub(super) fn sweeps(bracket: &[u8]) -> Lines {
    let hull = Hull::open(bracket)?;
    let (mut kind, mut kept) = (Kind::begin(), vec![ScratchEntry::EMPTY; KEPT]);
    kind.words(&[0, hull.sweep_entries() as u32, 0]);
    let mut place = kind.point();
    let mut sweep = hull.sweep(place, &mut kept)?;
    for round in 0..ROUNDS {
        if round % 8 == 7 {
            place = kind.point();
        } else {
            kind.step(&mut place);
        }
        kind.answers(&mut sweep, place, round)?;
    }
    Ok(kind.line("sweep"))
}

pub(super) fn frames(bend: &[u8]) -> Lines {
    let deform = DeformableHull::open(bend)?;
    let rest = deform.rest();
    let (mut kind, mut kept) = (Kind::begin(), vec![ScratchEntry::EMPTY; KEPT]);
    let mut scratch = vec![ScratchEntry::EMPTY; deform.scratch_entries()];
    kind.words(&[0, deform.scratch_entries() as u32, deform.frames()]);
    kind.words(&[deform.input_vertices(), deform.vertex_records() as u32]);
    kind.words(&[0, rest.sweep_entries() as u32, 0]);
    let mut place = kind.near();
    let mut sweep = deform.at_frame(0.0)?.sweep(place, &mut kept)?;
    for round in 0..ROUNDS {
        let frame = (round % 9) as f32 / 8.0;
        let (a, b) = (kind.near(), kind.near());
        let at = deform.at_frame(frame)?;
        kind.words(&[0]);
        kind.closest(&at.closest_point(a, budget(round), &mut scratch)?);
        kind.hit(&at.first_hit(a, b, budget(round), &mut scratch)?);
        kind.words(&[0]);
        sweep.move_to_frame(frame)?;
        kind.step(&mut place);
        kind.answers(&mut sweep, place, round)?;
    }
    Ok(kind.line("frames"))
}

pub(super) fn moved(bend: &[u8]) -> Lines {
    let deform = DeformableHull::open(bend)?;
    let (mut kind, mut kept) = (Kind::begin(), vec![ScratchEntry::EMPTY; KEPT]);
    let mut scratch = vec![ScratchEntry::EMPTY; deform.scratch_entries()];
    let mut records = vec![[MovedVertex::EMPTY; RECORDS]; 2];
    let [first, second] = &mut records[..] else { return Err("two".into()) };
    let count = deform.input_vertices() as usize;
    assert!(count <= VERTICES);
    kind.words(&[0, 0, 0]);
    let mut moved = deform.moved(first)?;
    let mut place = kind.near();
    let mut sweep = deform.moved(second)?.sweep(place, &mut kept)?;
    for round in 0..ROUNDS {
        let vertices = kind.vertices(count);
        let slack = (round % 3) as f32 * 0.25;
        let (a, b) = (kind.near(), kind.near());
        moved.update_within(slack, |vertex| vertices[vertex as usize])?;
        kind.words(&[0, 0]);
        kind.closest(&moved.closest_point(a, budget(round), &mut scratch)?);
        kind.hit(&moved.first_hit(a, b, budget(round), &mut scratch)?);
        kind.words(&[0]);
        sweep.update_within(slack, |vertex| vertices[vertex as usize])?;
        kind.step(&mut place);
        kind.answers(&mut sweep, place, round)?;
    }
    Ok(kind.line("moved"))
}
