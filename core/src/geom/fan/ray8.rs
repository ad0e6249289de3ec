//! Segment and leaf, a register of triangles at once.
//!
//! It flags the triangles that the line may meet, with the arithmetic and the bits of the scalar
//! kernel; a test checks it. Few are flagged, so the decision about them is scalar.

use super::lanes::{Lanes, WIDTH};
use super::ray::FanRay;

/// Corners of the triangles of a leaf, grid units, in the order of [`FanRay::axes`]:
/// `[axis][lane]`.
#[derive(Clone, Copy, Debug)]
pub struct Ring8 {
    /// Ring vertex `i` of triangle `i`.
    pub here: [[f32; WIDTH]; 3],
    /// Ring vertex `i + 1`.
    pub next: [[f32; WIDTH]; 3],
    /// Both centres, alike if there is one fan.
    pub centres: [[f32; 3]; 2],
}

/// The ring of the triangles in a register's lanes, in the order of [`FanRay::axes`].
#[derive(Clone, Copy, Debug)]
pub struct RingLanes<L = Lanes> {
    /// Ring vertex `i` of triangle `i`.
    pub here: [L; 3],
    /// Ring vertex `i + 1`.
    pub next: [L; 3],
}

/// Vertices in the shadow plane.
pub type ShadowLanes<L = Lanes> = [L; 2];

/// Both centres of a leaf in the shadow plane, in all lanes.
#[derive(Clone, Copy, Debug)]
pub struct CentreShadows([ShadowLanes; 2]);

impl CentreShadows {
    /// `centres` in the order of [`FanRay::axes`].
    #[inline(always)]
    pub fn new(ray: &FanRay, centres: [[f32; 3]; 2]) -> Self {
        let ([ox, oy, oz], [sx, sy]) = (ray.origin(), ray.shear());
        let shadow = |[x, y, z]: [f32; 3]| {
            let z = z - oz;
            [Lanes::splat((x - ox) - sx * z), Lanes::splat((y - oy) - sy * z)]
        };
        CentreShadows([shadow(centres[0]), shadow(centres[1])])
    }

    /// Each triangle's own. `first` has ones in the lanes of the first fan.
    #[inline(always)]
    pub fn of_lanes(&self, first: Lanes) -> ShadowLanes {
        let CentreShadows([c, d]) = self;
        [first.select(c[0], d[0]), first.select(c[1], d[1])]
    }
}

/// Defines `ray_lanes` and `shadow_lanes` for registers `$lanes`, as
/// [`define_point_lanes`](super::point8::define_point_lanes) does.
macro_rules! define_ray_lanes {
    ($(#[$attribute:meta])* $lanes:ty, $seen:vis) => {
        /// Vertices in the shadow plane, from their coordinates in the order of [`FanRay::axes`].
        $(#[$attribute])*
        $seen fn shadow_lanes(ray: &FanRay, [x, y, z]: [$lanes; 3]) -> ShadowLanes<$lanes> {
            let ([ox, oy, oz], [sx, sy]) = (ray.origin(), ray.shear());
            let z = sub(z, splat(oz));
            [
                sub(sub(x, splat(ox)), mul(splat(sx), z)),
                sub(sub(y, splat(oy)), mul(splat(sy), z)),
            ]
        }

        /// Triangles that the segment's line may meet, as [`ray_leaf`](super::ray_leaf) says: a bit
        /// for each lane. `centre` is each triangle's own.
        $(#[$attribute])*
        $seen fn ray_lanes(
            ray: &FanRay,
            ring: &RingLanes<$lanes>,
            centre: ShadowLanes<$lanes>,
        ) -> u32 {
            let (here, next) = (shadow_lanes(ray, ring.here), shadow_lanes(ray, ring.next));
            let (a, a_doubt) = side(ray, centre, here);
            let (b, b_doubt) = side(ray, centre, next);
            let (rim, rim_doubt) = side(ray, here, next);
            let positive =
                and(and(ge(a, neg(a_doubt)), le(b, b_doubt)), ge(rim, neg(rim_doubt)));
            let negative =
                and(and(le(a, a_doubt), ge(b, neg(b_doubt))), le(rim, rim_doubt));
            bits(or(positive, negative))
        }

        $(#[$attribute])*
        fn side(
            ray: &FanRay,
            from: ShadowLanes<$lanes>,
            to: ShadowLanes<$lanes>,
        ) -> ($lanes, $lanes) {
            let [ex, ey] = [sub(to[0], from[0]), sub(to[1], from[1])];
            let doubt = mul(splat(ray.doubt()), add(abs(ex), abs(ey)));
            (sub(mul(from[0], ey), mul(from[1], ex)), add(doubt, splat(PRODUCT_UNDERFLOW)))
        }
    };
}
pub(super) use define_ray_lanes;
