//! Models at their places, and what is remembered of their pairs.

use meshsweep_core::PlacedModel;
use meshsweep_core::internal::bvh::{MovingModel, RememberedPair};

use crate::answer::SceneC;
use crate::ask::questions;
use crate::error::Error;
use crate::memory::{AnyBits, In, Out, SceneEntry};
use crate::question::{KeptPairC, PoseC};
use crate::tree::Model;

/// `msw_placed`.
#[repr(C)]
#[derive(Clone, Copy)]
#[allow(missing_docs, missing_debug_implementations, reason = "meshsweep.h says it")]
pub struct PlacedC {
    pub model: In<Model>,
    pub pose: PoseC,
}

// SAFETY: a pointer, which `In` checks before it is used, floats and an integer.
unsafe impl AnyBits for PlacedC {}

/// What a function without an answer returns.
fn code(result: Result<(), Error>) -> i32 {
    result.map_or_else(Error::code, |()| 0)
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_scene_begin(
    mut scene: Out<SceneEntry>,
    scene_count: usize,
    models: In<PlacedC>,
    model_count: usize,
    pairs: In<KeptPairC>,
    pair_count: usize,
) -> i32 {
    let model = |index: usize| {
        let placed = models.slice(model_count)?.get(index).ok_or(Error::Internal)?;
        Ok(MovingModel::new(PlacedModel::new(*placed.model.view()?, placed.pose.pose())?))
    };
    let pair = |index: usize| {
        let pair = pairs.slice(pair_count)?.get(index).ok_or(Error::Internal)?;
        Ok(RememberedPair::new(pair.kept()?, model_count)?)
    };
    code(scene.begin_scene(scene_count, [model_count, pair_count], model, pair))
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_scene_move(mut scene: Out<SceneEntry>, model: u32, pose: In<PoseC>) -> i32 {
    code((|| Ok(scene.scene()?.move_to(model as usize, pose.get()?.pose())?))())
}

questions! {
    msw_scene_within(scene: Out<SceneEntry>) -> SceneC {
        let scene = scene.scene()?;
        |budget, scratch| scene.within(budget, scratch)
    }
}

/// See `meshsweep.h`.
#[unsafe(no_mangle)]
pub extern "C" fn msw_scene_reset(mut scene: Out<SceneEntry>) -> i32 {
    code(scene.scene().map(|scene| scene.reset()))
}
