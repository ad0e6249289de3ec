//! The no-panic proof: every entry of the core on opaque inputs. It links, or a panic is left in
//! the core.
#![no_std]
#![no_main]
#![cfg_attr(feature = "inject_panic", allow(dead_code, unused_imports, unused_macros))]

#[macro_use]
#[path = "../bare.rs"]
mod bare;

use bare::Input;
use meshsweep_suite::ask::hull::Focus;
use meshsweep_suite::ask::{
    Asked, apart, curve, deform, hull, hull_moving, tight, tree, tribox, triboxes,
};
use meshsweep_suite::fold::Fold;
use meshsweep_suite::place::{Motion, Point};

macro_rules! open {
    ($($name:ident: $room:ident;)*) => {$(
        #[unsafe(no_mangle)]
        extern "C" fn $name(input: &Input<'_>, fold: &mut Fold) {
            match $room::open(input.blob) {
                Ok(opened) => {
                    fold.point($room::bounds(&opened)[0]);
                    $room::contents(&opened, fold);
                }
                Err(refused) => fold.word(refused.0),
            }
        }
    )*};
}

ask! {
    ask_hull_closest: hull::Model<'t>, |model, input, scratch, fold| {
        #[cfg(feature = "inject_panic")]
        fold.byte([1, 2, 3][input.any]);
        hull::closest(model, input.a, scratch, &mut (), fold)
    };
}

/// Opening without a check of the records.
#[cfg(not(feature = "inject_panic"))]
#[unsafe(no_mangle)]
extern "C" fn ask_trusted(input: &Input<'_>, fold: &mut Fold) {
    if let Ok(tree) = tree::trusted(input.blob) {
        fold.point(tree::bounds(&tree)[0]);
    }
    if let Ok(hulls) = tight::trusted(input.blob) {
        fold.point(tight::bounds(&hulls)[0]);
    }
}

// One question shows that its panic is noticed. The others would only take time to link.
#[cfg(not(feature = "inject_panic"))]
open! {
    ask_hull_open: hull;
    ask_tree_open: tree;
    ask_triboxes_open: triboxes;
    ask_tight_open: tight;
    ask_curve_open: curve;
    ask_deform_open: deform;
}

#[cfg(not(feature = "inject_panic"))]
ask! {
    ask_hull_first_hit: hull::Model<'t>, |model, input, scratch, fold| {
        hull::first_hit(model, ends(input), scratch, &mut (), fold)
    };
    ask_hull_all_hits: hull::Model<'t>, |model, input, scratch, fold| {
        hull::all_hits(model, ends(input), scratch, &mut (), fold)
    };
    ask_hull_outer_hits: hull::Model<'t>, |model, input, scratch, fold| {
        hull::outer_hits(model, ends(input), scratch, &mut (), fold)
    };
    ask_hull_sweep: hull_moving::Moving<'t>, |model, input, scratch, fold| {
        hull_moving::sweep(model, [input.a, input.b, input.a], scratch, &mut (), fold)
    };
    ask_hull_posed: hull_moving::Moving<'t>, |model, input, scratch, fold| {
        hull_moving::posed(model, tree::pose(motion(input)), input.b, scratch, &mut (), fold)
    };
    ask_hull_overlap: hull_moving::Moving<'t>, |model, input, scratch, fold| {
        let (a, b) = (input.a, input.b);
        hull_moving::overlap(model, tree::pose(motion(input)), [a, b, a], scratch, &mut (), fold)
    };
    ask_hull_refine: hull::Model<'t>, |model, input, scratch, fold| {
        let [radius, cosine, error] = input.b;
        let focuses = [
            Focus::Everywhere,
            Focus::Ball { centre: input.a, radius },
            Focus::Box { a: input.a, b: input.b },
            Focus::Segment { a: input.a, b: input.b, radius },
            Focus::Eye { position: input.a, axis: input.b, cosine, error_per_distance: error },
        ];
        for focus in focuses {
            hull::refine(model, &focus, error, scratch, &mut (), fold);
        }
    };
    ask_tree_closest: tree::Bvh<'t>, |tree, input, scratch, fold| {
        tree::closest(tree, input.a, scratch, &mut Asked::new((), fold))
    };
    ask_tree_follow: tree::Bvh<'t>, |tree, input, scratch, fold| {
        tree::follow(tree, input.a, scratch, &mut Asked::new((), fold))
    };
    ask_tree_precise: tree::Bvh<'t>, |tree, input, scratch, fold| {
        tree::precise(tree, input.a, scratch, &mut Asked::new((), fold))
    };
    ask_tree_coherent: tree::Bvh<'t>, |tree, input, scratch, fold| {
        tree::coherent(tree, input.a, scratch, &mut Asked::new((), fold))
    };
    ask_tree_nearest: tree::Bvh<'t>, |tree, input, scratch, fold| {
        tree::nearest(tree, input.a, scratch, &mut Asked::new((), fold))
    };
    ask_tree_signed: tree::Bvh<'t>, |tree, input, scratch, fold| {
        tree::signed(tree, input.a, scratch, &mut Asked::new((), fold))
    };
    ask_tree_cull: tree::Bvh<'t>, |tree, input, scratch, fold| {
        tree::cull(tree, input.a, scratch, &mut Asked::new((), fold))
    };
    ask_tree_stopped: tree::Bvh<'t>, |tree, input, scratch, fold| {
        tree::stopped(tree, input.a, input.b[0], scratch, &mut Asked::new((), fold))
    };
    ask_tree_is_within: tree::Bvh<'t>, |tree, input, scratch, fold| {
        tree::is_within(tree, input.a, input.b[0], scratch, &mut Asked::new((), fold))
    };
    ask_tree_all_within: tree::Bvh<'t>, |tree, input, scratch, fold| {
        tree::all_within(tree, input.a, input.b[0], scratch, &mut Asked::new((), fold))
    };
    ask_tree_first_hit: tree::Bvh<'t>, |tree, input, scratch, fold| {
        tree::first_hit(tree, ends(input), scratch, &mut Asked::new((), fold))
    };
    ask_tree_facing: tree::Bvh<'t>, |tree, input, scratch, fold| {
        tree::facing(tree, ends(input), scratch, &mut Asked::new((), fold))
    };
    ask_tree_any_hit: tree::Bvh<'t>, |tree, input, scratch, fold| {
        tree::any_hit(tree, ends(input), scratch, &mut Asked::new((), fold))
    };
    ask_tree_with_error: tree::Bvh<'t>, |tree, input, scratch, fold| {
        if let Ok(tree) = tree.with_error(input.b[0]) {
            tree::any_hit(&tree, ends(input), scratch, &mut Asked::new((), fold))
        }
    };
    ask_tree_all_hits: tree::Bvh<'t>, |tree, input, scratch, fold| {
        tree::all_hits(tree, ends(input), scratch, &mut Asked::new((), fold))
    };
    ask_tree_overlap: tree::Bvh<'t>, |tree, input, scratch, fold| {
        tree::overlap(tree, tree::pose(motion(input)), scratch, &mut Asked::new((), fold))
    };
    ask_apart_distance: apart::Apart<'t>, |tree, input, scratch, fold| {
        apart::distance(tree, tree::pose(motion(input)), scratch, &mut Asked::new((), fold))
    };
    ask_apart_solid: apart::Apart<'t>, |tree, input, scratch, fold| {
        apart::solid(tree, ends(input), input.b[0], scratch, &mut Asked::new((), fold))
    };
    ask_apart_contact: apart::Apart<'t>, |tree, input, scratch, fold| {
        let motion = [ends(input), [input.b, input.a]];
        apart::contact(tree, motion, input.b[0], scratch, &mut Asked::new((), fold))
    };
    ask_apart_winding: apart::Apart<'t>, |tree, input, scratch, fold| {
        apart::winding(tree, input.a, scratch, &mut Asked::new((), fold))
    };
    ask_apart_coherent: apart::Apart<'t>, |tree, input, scratch, fold| {
        let pose = tree::pose(motion(input));
        apart::coherent(tree, pose, ends(input), scratch, &mut Asked::new((), fold))
    };
    ask_apart_penetration: apart::Apart<'t>, |tree, input, scratch, fold| {
        apart::penetration(tree, tree::pose(motion(input)), scratch, &mut Asked::new((), fold))
    };
    ask_apart_scene: apart::Apart<'t>, |tree, input, scratch, fold| {
        let pose = tree::pose(motion(input));
        let poses = [pose, pose, tree::pose(motion(input))];
        apart::scene(tree, poses, input.b[0], scratch, &mut Asked::new((), fold))
    };
    ask_tree_all_overlaps: tree::Bvh<'t>, |tree, input, scratch, fold| {
        tree::all_overlaps(tree, tree::pose(motion(input)), scratch, &mut Asked::new((), fold))
    };
    ask_tree_batch: tree::Bvh<'t>, |tree, input, scratch, fold| {
        let [a, b] = ends(input);
        tree::batch(tree, &[a, b, a, b, a, b, a, b], scratch, &mut Asked::new((), fold))
    };
    ask_triboxes_apart: triboxes::Triboxes<'t>, |all, input, scratch, fold| {
        triboxes::reject(all, tree::pose(motion(input)), scratch, &mut Asked::new((), fold))
    };
    ask_triboxes_candidates: triboxes::Triboxes<'t>, |all, input, scratch, fold| {
        triboxes::candidates(all, tree::pose(motion(input)), scratch, &mut Asked::new((), fold))
    };
    ask_triboxes_distance: triboxes::Triboxes<'t>, |all, input, scratch, fold| {
        triboxes::nearest(all, input.a, scratch, &mut Asked::new((), fold))
    };
    ask_triboxes_clip: triboxes::Triboxes<'t>, |all, input, scratch, fold| {
        triboxes::first(all, ends(input), scratch, &mut Asked::new((), fold))
    };
    ask_tight_closest: tight::Hulls<'t>, |hulls, input, scratch, fold| {
        tight::closest(hulls, input.a, scratch, &mut Asked::new((), fold))
    };
    ask_tight_stopped: tight::Hulls<'t>, |hulls, input, scratch, fold| {
        tight::stopped(hulls, input.a, input.b[0], scratch, &mut Asked::new((), fold))
    };
    ask_tight_is_within: tight::Hulls<'t>, |hulls, input, scratch, fold| {
        tight::is_within(hulls, input.a, input.b[0], scratch, &mut Asked::new((), fold))
    };
    ask_deform_frame: deform::DeformableHull<'t>, |hull, input, scratch, fold| {
        deform::at_frame(hull, input.b[0], input.a, scratch, &mut Asked::new((), fold))
    };
    ask_deform_moved: deform::DeformableHull<'t>, |hull, input, scratch, fold| {
        deform::moved(hull, ends(input), input.a, scratch, [Some(&mut ()), None], fold)
    };
    ask_curve_closest: curve::Curve<'t>, |curves, input, scratch, fold| {
        curve::closest(curves, input.a, scratch, &mut Asked::new((), fold))
    };
    ask_curve_stopped: curve::Curve<'t>, |curves, input, scratch, fold| {
        curve::stopped(curves, input.a, input.b[0], scratch, &mut Asked::new((), fold))
    };
    ask_curve_is_within: curve::Curve<'t>, |curves, input, scratch, fold| {
        curve::is_within(curves, input.a, input.b[0], scratch, &mut Asked::new((), fold))
    };
}

fn ends(input: &Input<'_>) -> [Point; 2] {
    [input.a, input.b]
}

fn motion(input: &Input<'_>) -> Motion {
    ([input.a, input.b, input.a], input.b)
}

#[unsafe(no_mangle)]
extern "C" fn ask_tribox_bounds(points: &tribox::Points, fold: &mut Fold) {
    tribox::bounds(points, &mut (), fold);
}

#[unsafe(no_mangle)]
extern "C" fn ask_tribox_faces(tribox: &tribox::Tribox, fold: &mut Fold) {
    tribox::faces(tribox, &mut (), fold);
}

#[unsafe(no_mangle)]
extern "C" fn ask_tribox_overlap(pairs: &([[f32; 3]; 2], [[f32; 3]; 2]), fold: &mut Fold) {
    tribox::overlap(pairs, &mut (), fold);
}

#[unsafe(no_mangle)]
extern "C" fn ask_tribox_rest(points: &tribox::Points, input: &Input<'_>, fold: &mut Fold) {
    tribox::rest(points, input.a[0], input.any != 0, &mut (), fold);
}
