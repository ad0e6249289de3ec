//! The no-panic proof: everything that the suite asks of the core, on opaque inputs. It links, or a
//! panic is left in the core.
#![no_std]
#![no_main]
#![cfg_attr(feature = "inject_panic", allow(dead_code, unused_imports, unused_macros))]

#[macro_use]
#[path = "../bare.rs"]
mod bare;

use core::hint::black_box;

use bare::Input;
use meshsweep_suite::ask::{
    Asked, apart, both, curve, deform, hull, hull_moving, joints, sdf, tight, tree, tribox,
    triboxes,
};
use meshsweep_suite::fold::Fold;
use meshsweep_suite::place::{Ends, Motion, Place, Point};
use meshsweep_suite::{Kind, Subject};

/// Places of which the optimiser knows nothing, not even whether two are the same.
struct Opaque<'a>(&'a Input<'a>);

impl Place for Opaque<'_> {
    fn far(&mut self) -> Point {
        black_box(self.0.a)
    }

    fn near(&mut self, base: Point) -> Point {
        black_box(base)
    }

    fn step(&mut self) -> Point {
        self.far()
    }

    fn step_or_jump(&mut self) -> Point {
        self.far()
    }

    fn segment(&mut self) -> Ends {
        [self.far(), self.far()]
    }

    fn motion(&mut self) -> Motion {
        ([self.far(), self.far(), self.far()], self.far())
    }

    fn distance(&mut self) -> f32 {
        black_box(self.0.b[0])
    }

    fn share(&mut self) -> f32 {
        self.distance()
    }

    fn word(&mut self) -> u32 {
        black_box(self.0.any) as u32
    }
}

/// A function for each subject: it opens the blob and asks any kind of query.
macro_rules! subjects {
    ($($name:ident: $subject:ty;)*) => {$(
        #[unsafe(no_mangle)]
        extern "C" fn $name<'t>(
            input: &Input<'t>,
            kind: &Kind,
            scratch: &mut <$subject as Subject<'t>>::Scratch,
            fold: &mut Fold,
        ) {
            match <$subject as Subject<'t>>::open(input.blob) {
                Ok(subject) => {
                    fold.point(subject.bounds()[0]);
                    subject.ask(*kind, &mut Opaque(input), scratch, &mut (), fold);
                }
                Err(refused) => fold.word(refused.0),
            }
        }
    )*};
}

// One question shows that its panic is noticed. The others would only take time to link.
#[cfg(feature = "inject_panic")]
ask! {
    ask_hull: hull::Model<'t>, |model, input, scratch, fold| {
        fold.byte([1, 2, 3][input.any]);
        hull::closest(model, input.a, scratch, &mut (), fold)
    };
}

#[cfg(not(feature = "inject_panic"))]
subjects! {
    ask_hull: hull::Model<'t>;
    ask_hull_moving: hull_moving::Moving<'t>;
    ask_tree: tree::Bvh<'t>;
    ask_apart: apart::Apart<'t>;
    ask_triboxes: triboxes::Triboxes<'t>;
    ask_tight: tight::Hulls<'t>;
    ask_deform: deform::DeformableHull<'t>;
    ask_curve: curve::Curve<'t>;
    ask_sdf: sdf::Sdf<'t>;
    ask_both: both::BvhWithSdf<'t>;
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

#[cfg(not(feature = "inject_panic"))]
ask! {
    ask_with_error: tree::Bvh<'t>, |tree, input, scratch, fold| {
        if let Ok(tree) = tree.with_error(input.b[0]) {
            tree::any_hit(&tree, [input.a, input.b], scratch, &mut Asked::new((), fold))
        }
    };
}

/// Triboxes of points.
#[cfg(not(feature = "inject_panic"))]
#[unsafe(no_mangle)]
extern "C" fn ask_tribox(input: &Input<'_>, kind: &Kind, fold: &mut Fold) {
    tribox::ask(*kind, &mut Opaque(input), &mut (), fold);
}

/// Their faces, of any numbers.
#[cfg(not(feature = "inject_panic"))]
#[unsafe(no_mangle)]
extern "C" fn ask_tribox_faces(tribox: &tribox::Tribox, fold: &mut Fold) {
    tribox::faces(tribox, &mut (), fold);
}

/// Links of any joints at any places.
#[cfg(not(feature = "inject_panic"))]
#[unsafe(no_mangle)]
extern "C" fn ask_joints(mechanism: &mut joints::Mechanism<'_>, fold: &mut Fold) {
    joints::ask(mechanism, fold);
}
