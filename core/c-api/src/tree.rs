//! Questions about the box tree.

use meshsweep_core::{Blob, Bvh, Hint, Neighbor, ScratchEntry, Solid};

use crate::answer::{ClosestC, CoherentC, HitC, NearestC, NeighborC, SignedC, WindingC, WithinC};
use crate::ask::{ask, questions};
use crate::error::Error;
use crate::memory::{CoherentStorage, In, Out, Storage, View};
use crate::question::{BudgetC, HintC, facing};

/// Words of `msw_model`.
pub const MODEL_WORDS: usize = if cfg!(target_pointer_width = "64") { 36 } else { 52 };

/// `msw_model`.
pub type Model = Storage<Bvh<'static>, MODEL_WORDS>;

impl View for Bvh<'static> {
    const TAG: usize = 0x6d73_7701;
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_open(model: Out<Model>, bytes: In<u8>, count: usize) -> i32 {
    model.open(|| Ok(Bvh::open(bytes.slice(count)?)?))
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_open_trusted(model: Out<Model>, bytes: In<u8>, count: usize) -> i32 {
    model.open(|| Ok(Bvh::open_trusted(bytes.slice(count)?)?))
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_checksum(bytes: In<u8>, count: usize, checksum: Out<u32>) -> i32 {
    checksum.answer(|| Ok(Blob::checksum(bytes.slice(count)?)?))
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_scratch_entries(model: In<Model>) -> u32 {
    model.view().map_or(0, |model| model.scratch_entries() as u32)
}

questions! {
    msw_closest_point(model: In<Model>, point: In<[f32; 3]>) -> ClosestC {
        let (model, point) = (model.view()?, point.get()?);
        |budget, scratch| model.closest_point(point, budget, scratch)
    }
    msw_coherent_closest_point(
        model: In<Model>, coherent: Out<CoherentStorage>, point: In<[f32; 3]>
    ) -> CoherentC {
        let (model, query, point) = (model.view()?, coherent.kept()?, point.get()?);
        |budget, scratch| query.closest_point(model, point, budget, scratch)
    }
    msw_signed_distance(model: In<Model>, point: In<[f32; 3]>) -> SignedC {
        let (model, point) = (model.view()?, point.get()?);
        |budget, scratch| model.signed_distance(point, budget, scratch)
    }
    msw_winding_number(model: In<Model>, point: In<[f32; 3]>) -> WindingC {
        let (model, point) = (model.view()?, point.get()?);
        |budget, scratch| model.winding_number(point, budget, scratch)
    }
    msw_within(model: In<Model>, point: In<[f32; 3]>, distance: f32) -> WithinC {
        let (model, point) = (model.view()?, point.get()?);
        |budget, scratch| model.within(point, distance, budget, scratch)
    }
    msw_first_hit(model: In<Model>, a: In<[f32; 3]>, b: In<[f32; 3]>, facing_code: i32) -> HitC {
        let (model, a, b, facing) = (model.view()?, a.get()?, b.get()?, facing(facing_code)?);
        |budget, scratch| model.first_hit(a, b, facing, budget, scratch)
    }
    msw_first_hit_of_ray(
        model: In<Model>, origin: In<[f32; 3]>, direction: In<[f32; 3]>, facing_code: i32
    ) -> HitC {
        let (model, [origin, way], facing) =
            (model.view()?, [origin.get()?, direction.get()?], facing(facing_code)?);
        |budget, scratch| model.first_hit_of_ray(origin, way, facing, budget, scratch)
    }
    msw_solid_first_contact(
        model: In<Model>, from: In<[f32; 3]>, to: In<[f32; 3]>, corner_count: usize, radius: f32
    ) -> HitC {
        let (model, from, to) = {
            let (model, [from, to]) = (model.view()?, [from, to].map(|at| at.slice(corner_count)));
            (model, Solid::new(from?, radius)?, Solid::new(to?, radius)?)
        };
        |budget, scratch| model.solid_first_contact(&from, &to, budget, scratch)
    }
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_closest_point_from(
    model: In<Model>,
    mut hint: Out<HintC>,
    point: In<[f32; 3]>,
    budget: In<BudgetC>,
    scratch: Out<ScratchEntry>,
    scratch_count: usize,
    answer: Out<ClosestC>,
) -> i32 {
    answer.answer(|| {
        let (model, kept, point) = (model.view()?, hint.one()?, point.get()?);
        let mut hint = Hint::of_word(kept.word);
        let near = ask(budget, scratch, scratch_count, |budget, scratch| {
            Ok(model.closest_point_from(point, &mut hint, budget, scratch)?)
        })?;
        kept.word = hint.word();
        Ok(near.into())
    })
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_nearest(
    model: In<Model>,
    point: In<[f32; 3]>,
    mut neighbors: Out<NeighborC>,
    neighbor_count: usize,
    budget: In<BudgetC>,
    scratch: Out<ScratchEntry>,
    scratch_count: usize,
    answer: Out<NearestC>,
) -> i32 {
    answer.answer(|| {
        let (model, point) = (model.view()?, point.get()?);
        // The search keeps its state where the answers will be.
        let mut held = neighbors.held::<Neighbor>();
        let found = ask(budget, scratch, scratch_count, |budget, scratch| {
            Ok(model.nearest(point, held.slice(neighbor_count)?, budget, scratch)?)
        })?;
        for index in 0..found.stored {
            let near: Option<Neighbor> = held.slice(neighbor_count)?.get(index).copied();
            neighbors.set(neighbor_count, index, near.ok_or(Error::Internal)?.into())?;
        }
        Ok(found.into())
    })
}
