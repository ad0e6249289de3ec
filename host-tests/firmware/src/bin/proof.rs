//! The no-panic proof: every entry of the core on opaque inputs. It links, or a panic is left in
//! the core.
#![no_std]
#![no_main]

#[path = "../bare.rs"]
mod bare;

use bare::Input;
use meshsweep_suite::ask::{curve, hull, tight, tree, tribox, triboxes};
use meshsweep_suite::fold::Fold;

#[unsafe(no_mangle)]
extern "C" fn ask_hull_open(input: &Input<'_>, fold: &mut Fold) {
    match hull::open(input.blob) {
        Ok(model) => {
            fold.point(hull::bounds(&model)[0]);
            hull::contents(&model, fold);
        }
        Err(refused) => fold.word(refused.0),
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_hull_closest(input: &Input<'_>, scratch: &mut hull::Scratch, fold: &mut Fold) {
    #[cfg(feature = "inject_panic")]
    fold.byte([1, 2, 3][input.any]);
    if let Ok(model) = hull::open(input.blob) {
        hull::closest(&model, input.a, scratch, &mut (), fold);
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_tree_open(input: &Input<'_>, fold: &mut Fold) {
    match tree::open(input.blob) {
        Ok(tree) => {
            fold.point(tree::bounds(&tree)[0]);
            tree::contents(&tree, fold);
        }
        Err(refused) => fold.word(refused.0),
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_hull_first_hit(input: &Input<'_>, scratch: &mut hull::Scratch, fold: &mut Fold) {
    if let Ok(model) = hull::open(input.blob) {
        hull::first_hit(&model, [input.a, input.b], scratch, &mut (), fold);
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_hull_all_hits(input: &Input<'_>, scratch: &mut hull::Scratch, fold: &mut Fold) {
    if let Ok(model) = hull::open(input.blob) {
        hull::all_hits(&model, [input.a, input.b], scratch, &mut (), fold);
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_hull_outer_hits(input: &Input<'_>, scratch: &mut hull::Scratch, fold: &mut Fold) {
    if let Ok(model) = hull::open(input.blob) {
        hull::outer_hits(&model, [input.a, input.b], scratch, &mut (), fold);
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_tree_closest(
    input: &Input<'_>,
    scratch: &mut tree::Scratch<'_>,
    fold: &mut Fold,
) {
    if let Ok(tree) = tree::open(input.blob) {
        tree::closest(&tree, input.a, scratch, &mut (), fold);
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_tree_follow(input: &Input<'_>, scratch: &mut tree::Scratch<'_>, fold: &mut Fold) {
    if let Ok(tree) = tree::open(input.blob) {
        tree::follow(&tree, input.a, scratch, &mut (), fold);
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_tree_stopped(
    input: &Input<'_>,
    scratch: &mut tree::Scratch<'_>,
    fold: &mut Fold,
) {
    if let Ok(tree) = tree::open(input.blob) {
        tree::stopped(&tree, input.a, input.b[0], scratch, &mut (), fold);
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_tree_is_within(
    input: &Input<'_>,
    scratch: &mut tree::Scratch<'_>,
    fold: &mut Fold,
) {
    if let Ok(tree) = tree::open(input.blob) {
        tree::is_within(&tree, input.a, input.b[0], scratch, &mut (), fold);
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_tree_nearest(
    input: &Input<'_>,
    scratch: &mut tree::Scratch<'_>,
    fold: &mut Fold,
) {
    if let Ok(tree) = tree::open(input.blob) {
        tree::nearest(&tree, input.a, scratch, &mut (), fold);
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_tree_all_within(
    input: &Input<'_>,
    scratch: &mut tree::Scratch<'_>,
    fold: &mut Fold,
) {
    if let Ok(tree) = tree::open(input.blob) {
        tree::all_within(&tree, input.a, input.b[0], scratch, &mut (), fold);
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_tree_signed(input: &Input<'_>, scratch: &mut tree::Scratch<'_>, fold: &mut Fold) {
    if let Ok(tree) = tree::open(input.blob) {
        tree::signed(&tree, input.a, scratch, &mut (), fold);
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_tree_first_hit(
    input: &Input<'_>,
    scratch: &mut tree::Scratch<'_>,
    fold: &mut Fold,
) {
    if let Ok(tree) = tree::open(input.blob) {
        tree::first_hit(&tree, [input.a, input.b], scratch, &mut (), fold);
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_tree_facing(input: &Input<'_>, scratch: &mut tree::Scratch<'_>, fold: &mut Fold) {
    if let Ok(tree) = tree::open(input.blob) {
        tree::facing(&tree, [input.a, input.b], scratch, &mut (), fold);
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_tree_any_hit(
    input: &Input<'_>,
    scratch: &mut tree::Scratch<'_>,
    fold: &mut Fold,
) {
    if let Ok(tree) = tree::open(input.blob) {
        tree::any_hit(&tree, [input.a, input.b], scratch, &mut (), fold);
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_tree_all_hits(
    input: &Input<'_>,
    scratch: &mut tree::Scratch<'_>,
    fold: &mut Fold,
) {
    if let Ok(tree) = tree::open(input.blob) {
        tree::all_hits(&tree, [input.a, input.b], scratch, &mut (), fold);
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_tree_session<'t>(
    input: &Input<'t>,
    scratch: &mut tree::Scratch<'t>,
    fold: &mut Fold,
) {
    if let Ok(tree) = tree::open(input.blob) {
        tree::session(&tree, input.a, scratch, &mut (), fold);
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_tree_batch<'t>(
    input: &Input<'t>,
    scratch: &mut tree::Scratch<'t>,
    fold: &mut Fold,
) {
    if let Ok(tree) = tree::open(input.blob) {
        let [a, b] = [input.a, input.b];
        tree::batch(&tree, &[a, b, a, b, a, b, a, b], scratch, &mut (), fold);
    }
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

#[unsafe(no_mangle)]
extern "C" fn ask_tree_overlap(
    input: &Input<'_>,
    scratch: &mut tree::Scratch<'_>,
    fold: &mut Fold,
) {
    if let Ok(tree) = tree::open(input.blob) {
        let pose = tree::pose(([input.a, input.b, input.a], input.b));
        tree::overlap(&tree, pose, scratch, &mut (), fold);
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_tree_all_overlaps(
    input: &Input<'_>,
    scratch: &mut tree::Scratch<'_>,
    fold: &mut Fold,
) {
    if let Ok(tree) = tree::open(input.blob) {
        let pose = tree::pose(([input.a, input.b, input.a], input.b));
        tree::all_overlaps(&tree, pose, scratch, &mut (), fold);
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_tree_cull(input: &Input<'_>, scratch: &mut tree::Scratch<'_>, fold: &mut Fold) {
    if let Ok(tree) = tree::open(input.blob) {
        tree::cull(&tree, input.a, scratch, &mut (), fold);
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_triboxes_open(input: &Input<'_>, fold: &mut Fold) {
    match triboxes::open(input.blob) {
        Ok(opened) => {
            fold.point(triboxes::bounds(&opened)[0]);
            triboxes::contents(&opened, fold);
        }
        Err(refused) => fold.word(refused.0),
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_triboxes_apart(
    input: &Input<'_>,
    scratch: &mut triboxes::Scratch,
    fold: &mut Fold,
) {
    if let Ok(opened) = triboxes::open(input.blob) {
        triboxes::reject(&opened, &([input.a, input.b, input.a], input.b), scratch, &mut (), fold);
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_triboxes_candidates(
    input: &Input<'_>,
    scratch: &mut triboxes::Scratch,
    fold: &mut Fold,
) {
    if let Ok(opened) = triboxes::open(input.blob) {
        triboxes::candidates(
            &opened,
            &([input.a, input.b, input.a], input.b),
            scratch,
            &mut (),
            fold,
        );
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_triboxes_distance(
    input: &Input<'_>,
    scratch: &mut triboxes::Scratch,
    fold: &mut Fold,
) {
    if let Ok(opened) = triboxes::open(input.blob) {
        triboxes::nearest(&opened, input.a, scratch, &mut (), fold);
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_triboxes_clip(
    input: &Input<'_>,
    scratch: &mut triboxes::Scratch,
    fold: &mut Fold,
) {
    if let Ok(opened) = triboxes::open(input.blob) {
        triboxes::first(&opened, [input.a, input.b], scratch, &mut (), fold);
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_tight_open(input: &Input<'_>, fold: &mut Fold) {
    match tight::open(input.blob) {
        Ok(opened) => {
            fold.point(tight::bounds(&opened)[0]);
            tight::contents(&opened, fold);
        }
        Err(refused) => fold.word(refused.0),
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_tight_closest(input: &Input<'_>, scratch: &mut tight::Scratch, fold: &mut Fold) {
    if let Ok(opened) = tight::open(input.blob) {
        tight::closest(&opened, input.a, scratch, &mut (), fold);
        tight::stopped(&opened, input.a, input.b[0], scratch, &mut (), fold);
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_tight_is_within(
    input: &Input<'_>,
    scratch: &mut tight::Scratch,
    fold: &mut Fold,
) {
    if let Ok(opened) = tight::open(input.blob) {
        tight::is_within(&opened, input.a, input.b[0], scratch, &mut (), fold);
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_curve_open(input: &Input<'_>, fold: &mut Fold) {
    match curve::open(input.blob) {
        Ok(opened) => {
            fold.point(curve::bounds(&opened)[0]);
            curve::contents(&opened, fold);
        }
        Err(refused) => fold.word(refused.0),
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_curve_closest(input: &Input<'_>, scratch: &mut curve::Scratch, fold: &mut Fold) {
    if let Ok(opened) = curve::open(input.blob) {
        curve::closest(&opened, input.a, scratch, &mut (), fold);
        curve::stopped(&opened, input.a, input.b[0], scratch, &mut (), fold);
    }
}

#[unsafe(no_mangle)]
extern "C" fn ask_curve_is_within(
    input: &Input<'_>,
    scratch: &mut curve::Scratch,
    fold: &mut Fold,
) {
    if let Ok(opened) = curve::open(input.blob) {
        curve::is_within(&opened, input.a, input.b[0], scratch, &mut (), fold);
    }
}
