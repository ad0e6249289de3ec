//! Questions about two models.

use crate::answer::{OverlapC, PairContactC, PairDistanceC};
use crate::ask::{posed, questions};
use crate::memory::{In, Out, PairStorage};
use crate::question::{MotionC, PoseC};
use crate::tree::Model;

questions! {
    msw_overlap(model: In<Model>, other: In<Model>, pose: In<PoseC>) -> OverlapC {
        let ([model, other], pose) = posed([&model, &other], pose)?;
        |budget, scratch| model.overlap(other, pose, budget, scratch)
    }
    msw_distance(model: In<Model>, other: In<Model>, pose: In<PoseC>) -> PairDistanceC {
        let ([model, other], pose) = posed([&model, &other], pose)?;
        |budget, scratch| model.distance_to(other, pose, budget, scratch)
    }
    msw_within_of(model: In<Model>, other: In<Model>, pose: In<PoseC>, distance: f32) -> OverlapC {
        let ([model, other], pose) = posed([&model, &other], pose)?;
        |budget, scratch| model.within_of(other, pose, distance, budget, scratch)
    }
    msw_coherent_pair_distance(
        pair: Out<PairStorage>, model: In<Model>, other: In<Model>, pose: In<PoseC>
    ) -> PairDistanceC {
        let (pair, ([model, other], pose)) = (pair.kept()?, posed([&model, &other], pose)?);
        |budget, scratch| pair.distance(model, other, pose, budget, scratch)
    }
    msw_coherent_pair_within(
        pair: Out<PairStorage>, model: In<Model>, other: In<Model>, pose: In<PoseC>, distance: f32
    ) -> OverlapC {
        let (pair, ([model, other], pose)) = (pair.kept()?, posed([&model, &other], pose)?);
        |budget, scratch| pair.within(model, other, pose, distance, budget, scratch)
    }
    msw_first_contact_of(
        model: In<Model>, other: In<Model>, motion: In<MotionC>, keep: f32
    ) -> PairContactC {
        let (model, other, motion) = (model.view()?, other.view()?, motion.get()?.motion()?);
        |budget, scratch| model.first_contact_of(other, &motion, keep, budget, scratch)
    }
}
