//! Tolerances that a guarantee rests on, and a few that only cost time; these say so. A factor of a
//! few roundings stands beside its formula instead. The derivations are in `core/docs/rounding.md`;
//! each constant names its section, or the file that derives it.
//!
//! All tolerances are relative. They multiply lengths of the model and of the query, or they apply
//! in the local frame, where the model's largest coordinate lies in [½, 1).

// All structures

/// Unit roundoff of f32, 2^-24.
pub const U32: f32 = f32::EPSILON / 2.0;

/// Unit roundoff of f64, 2^-53.
pub const U64: f64 = f64::EPSILON / 2.0;

/// Upper limit of the loss by underflow of a sum of a few products: no term loses more than
/// 2^-147.
pub const PRODUCT_UNDERFLOW: f32 = f32::MIN_POSITIVE;

/// Rounding of the determinant of three vectors, in unit roundoffs times the product of their
/// 1-norms. Proved: 10 (§11).
pub const DETERMINANT: f32 = 16.0;

/// Factor that makes an upper bound of a root out of two steps of Newton's iteration, 1 + 2^-16:
/// they lose less than 6e-6, and roundings 1e-6 (§17).
pub const ROOT_UP: f32 = 1.0 + 1.0 / 65_536.0;

/// Factor that makes an upper bound of a root out of the guess by bits, 1 + 5/128: it is off by
/// less than 0.035, and 0.965 of this factor is above 1.002 (§17).
pub const GUESS_UP: f32 = 1.0 + 5.0 / 128.0;

/// Added to a square before its root is bounded, 2^-100, so that no guess begins near f32's
/// subnormal range. A root grows by 2^-50 at most.
pub const SQUARE_FLOOR: f32 = 1.0 / ((1u64 << 50) as f32 * (1u64 << 50) as f32);

/// What a determinant in f32, its bound or a square loses by underflow is less, 2^-100 (§11).
pub const UNDERFLOW_LOSS: f32 = 1.0 / (1u128 << 100) as f32;

// Poses

/// Rounding of the residual of a carried point, in units of [`U64`] times the sum of its terms.
/// Proved: 4.1 (§15).
pub const POSED_POINT: f64 = 8.0;

/// Rounding of a matrix's distance from a rotation, and of the products with it, in units of
/// [`U64`]. Proved: 16 (§15).
pub const POSED_STRETCH: f64 = 64.0;

/// The Frobenius norm of `RᵀR − 1` above which a matrix is refused as a rotation. Intervals hold
/// with any value below 1.
pub const POSE_DEFECT: f64 = 0.25;

/// The largest row sum of `RRᵀ − 1` above which a matrix is refused as a rotation, where a pose
/// does not say that it may be any. It changes lengths by half of that. A rotation that was rounded
/// to f32 has some 1e-7, one of three decimals up to this.
pub const RIGID: f32 = 3e-3;

/// Rounding of a quaternion's matrix, in units of [`U32`]. Proved: 31.1 (§25).
pub const QUATERNION: f32 = 34.0;

/// Rounding of a product of two matrices, in units of [`U32`] times their norms. Proved: 9.1 (§25).
pub const POSE_PRODUCT: f32 = 10.0;

/// Rounding of a translation that a pose carries, in units of [`U32`] times the lengths of its
/// terms. Proved: 7 (§25).
pub const POSE_SHIFT: f32 = 8.0;

/// Room for the roundings of a bound of a pose's rounding, of which there are less than 16 (§25).
pub const POSE_UP: f32 = 1.0 + 32.0 * U32;

/// Rounding of a rotation's matrix by an angle about an axis that was rounded to f32, in units of
/// [`U32`]. Proved: 39.5 (§27).
pub const TURN: f32 = 42.0;

// Hull, in the local frame

/// Rounding of the f32 lower bound of a point–triangle distance, in units of [`U32`] times
/// (distance to the farthest corner + longest edge). Proved: 12.7 (§2). A smaller value loses the
/// guarantee. A larger one opens a few more nodes.
pub const POINT_BOUND: f32 = 16.0;

/// Largest sum of a point's barycentric coordinates in f32 with which it is called one of the
/// triangle. Its share of [`POINT_BOUND`] is proved (§2).
pub const WITHIN: f32 = 1.0 + 8.0 * U32;

/// Rounding of the f32 lower bound of a segment–triangle distance, in the same units; the query's
/// sum of norms holds two of them. Proved: 31 (§3).
pub const SEGMENT_BOUND: f32 = 48.0;

/// Rounding of the f32 test whether a segment misses a box, in units of [`U32`] times the 1-norms
/// of all corners and ends. Proved: 10 (§3). A larger value leaves more segments to f64.
pub const BOX_MISSED: f32 = 16.0;

/// Rounding of the f64 point–triangle interval, in units of [`U64`] times the 1-norms of `ap`,
/// `ab`, `ac`. Proved: 8.6 (§4). A larger value widens the reported interval, which at 16 is below
/// one unit of f32.
pub const POINT_INTERVAL: f64 = 16.0;

/// Rounding of a triple product `d · (b × c)` in f64, in units of [`U64`] times the product of the
/// 1-norms. Proved: 9.1 (§5). It decides how near a segment may pass an edge and still be called a
/// hit.
pub const TRIPLE_PRODUCT: f64 = 16.0;

/// Distance below which a segment in the plane of a triangle touches the triangle, in units of
/// [`U64`] times the 1-norms (§5).
pub const COPLANAR_TOUCH: f64 = 64.0;

/// Rounding of an inner product of differences in f32, in units of the product of their 1-norms.
/// Proved: 5.1 [`U32`] (§4).
pub const CORNER_SIDE: f32 = 16.0 * U32;

/// Rounding of the products that decide in f64 where the closest point of a triangle is, in units
/// of the square of the 1-norms of the query's offsets: 2^-46. Proved: 2^-49.9 (§4).
pub const CORNER_DOUBT: f32 = 1.0 / (1u64 << 46) as f32;

/// Squared sine of the angle at a corner below which f32 does not tell the area of a triangle,
/// 2^-40 (§4).
pub const CORNER_AREA: f32 = 1.0 / (1u64 << 40) as f32;

/// How far the bounds of triangles at one corner lie apart, in units of f64 of the distance, times
/// the distance and over the 1-norms of the query's offsets. Proved: 102 (§4).
pub const CORNER_WIDTH: f32 = 128.0;

/// Added to [`CORNER_WIDTH`] times its lengths, in units of f64 of the distance (§4).
pub const CORNER_WIDTH_LEAST: f32 = 16.0;

/// Coordinates of a corner and of the point are 0 or at least this, 2^-23, and so multiples of
/// 2^-46 (§4).
pub const CORNER_LEAST: f32 = 1.0 / (1u32 << 23) as f32;

/// Coordinates of a corner are below this (§4).
pub const CORNER_LARGEST: f32 = 2.0;

/// Coordinates of a point whose nearest corner is decided are below this. Differences of multiples
/// of 2^-46 below 2^6 are exact (§4).
pub const CORNER_FARTHEST: f32 = 32.0;

/// Bounds are compared as squares, with less than eight roundings. This factor keeps the comparison
/// on the safe side (§2). [`POINT_BOUND`] has room for it.
pub const SQUARED_SLACK: f32 = 1.0 - 8.0 * U32;

/// Squares that differ by more than this factor, 1 + 2^-20, tell the order of what a root and a
/// quotient would give: all together carry less than eight roundings. No decision depends on it.
pub const NEAR_SQUARES: f32 = 1.0 + 16.0 * U32;

/// Squared length below which a direction in f32 is not trusted: 2^-100. Products of two longer
/// components stay above the subnormal range. Below it a lower bound falls back to zero, which is
/// always true (§2).
pub const TRUSTED_DIRECTION_SQ: f32 = 1.0 / ((1u64 << 50) as f32 * (1u64 << 50) as f32);

/// Loss of a bound by underflow, 2^-96: a term that underflows loses less than 2^-146, and it is
/// divided by a direction no shorter than 2^-50 (§2).
pub const UNDERFLOW: f32 = 1.0 / ((1u64 << 48) as f32 * (1u64 << 48) as f32);

/// Largest query coordinate for which nodes are bounded in f32: 2^12. There the rounding margin is
/// half a percent of the model. Farther out the bounds are computed in f64. Products of four
/// lengths stay below 2^60.
pub const F32_BOUNDS: f64 = 4096.0;

/// Largest query coordinate for which distances are computed: 2^40. From farther away the model
/// subtends less than a unit of f32, and its box gives the answer.
pub const HULL_FAR: f64 = (1u64 << 40) as f64;

/// Part of the hulls' size by which triangles may be farther than the nearest one and still be kept
/// in a sweep's queue. A larger value fills the queue, a smaller one begins anew more often. No
/// answer depends on it.
pub const SWEEP_KEPT: f64 = 1.0 / 32.0;

/// Least part of the hulls' size that is kept where the queue overflows: [`SWEEP_KEPT`] after six
/// overflows. No answer depends on it.
pub const SWEEP_LEAST: f64 = SWEEP_KEPT / 4096.0;

/// Motion in the local frame after which a sweep begins anew. Keys in f32 hold a bound plus the
/// motion: with a larger value they lose digits, and triangles are bounded in vain. No guarantee
/// rests on it.
pub const SWEEP_MOTION: f64 = 16.0;

/// Least extent of the smaller of two models, in units of the larger one, for which pairs of swept
/// triangles are compared in f32: 2^-12. There the margin is a few percent of the smaller model.
/// Smaller ones are compared in f64 (§16).
pub const F32_EXTENT: f64 = 1.0 / 4096.0;

/// A sum of motions is rounded up by this factor: less than four roundings of f64 each.
pub const SUMMED: f64 = 1.0 + 1.0 / (1u64 << 48) as f64;

/// Distance from the middle of the hulls, in units of the radius of their ball, from which on a
/// sweep tells a turn of its point from other motions. Nearer, the point's way is hardly longer. No
/// guarantee rests on it.
pub const TURNS_FROM: f32 = 1.25;

/// Rounding of the motion that a sweep is charged for a turn, in units of [`U64`] times the radius
/// of the ball and the distances from its centre. Proved: 5 roundings for each direction and for
/// their chord, 4 for each length, less than 24 in all. A smaller value loses the guarantee.
pub const TURNED: f64 = 64.0;

/// Rounding to f32 and the change of units, at either end of the interval.
pub const REPORTED: f64 = 8.0 * U32 as f64;

// Hulls that deform, in the local frame

/// Largest coordinate of a moved vertex of the mesh: 64 times the model's size. Products of four
/// lengths stay below 2^60 (§17). A larger value would let a margin in f32 grow with the motion.
pub const DEFORM_DOMAIN: f32 = 64.0;

/// Largest coordinate of a vertex of any level of a moved hull. Proved: 97 (§17).
pub const DEFORM_COARSE: f32 = 128.0;

/// No two points of a hull that deforms are farther apart: 2·√3 times [`DEFORM_COARSE`] is 444.
pub const DEFORM_DIAMETER: f32 = 512.0;

/// Rounding of a difference of displacements, in units of [`U32`] times the moved distance of the
/// two vertices. Proved: 2 (§17). A smaller value loses the guarantee.
pub const DISPLACEMENT: f32 = 4.0;

/// Rounding of lengths and of their sums, relative. Proved: 10 units of [`U32`] (§17).
pub const LENGTH_UP: f32 = 1.0 + 16.0 * U32;

/// Rounding of a vertex between two keys, in units of [`U32`] times the largest coordinate of both.
/// Proved: 9 (§17). Intervals between keys are wider by twice as much.
pub const KEY_VERTEX: f64 = 12.0;

/// Rounding of a radius between two keys, in units of [`U32`] times the larger one. Proved: 4
/// (§17).
pub const KEY_RADIUS: f32 = 8.0;

/// Rounding of the distance of a vertex of the surface from its fixed point of a triangle, in units
/// of [`U64`] times the 1-norms of all terms. Proved: 9 (§17).
pub const FIXED_POINT: f64 = 16.0;

/// Loss of a moved vertex by underflow, 2^-148: three coordinates lose 2^-150 each.
pub const VERTEX_UNDERFLOW: f64 = 1.0 / ((1u128 << 74) as f64 * (1u128 << 74) as f64);

/// Rounding of the distance of a vertex from a focus, in units of [`U32`] times the 1-norms of the
/// coordinates that it is computed from. Measured, not proved: with the worst cones, 15 units in
/// 1.5 million vertices. A larger value refines a little more; no interval depends on it.
pub const FOCUS_DISTANCE: f32 = 16.0;

/// Squared distances and limits of a focus carry less than eight roundings each. This factor keeps
/// their comparison on the side of refining.
pub const FOCUS_SLACK: f32 = 1.0 + 16.0 * U32;

// Box tree, distances, in grid units

/// Least denominator of a fan kernel, grid units to the fourth power or less: 2^-60. On a u16 grid
/// every denominator above 0 is at least 1. With f32 vertices a smaller one belongs to a triangle
/// that f32 cannot tell from a point, and its centre stands for it. The lower bound does not depend
/// on the choice (§8).
pub const LEAST_DENOMINATOR: f32 = 1.0 / ((1u64 << 60) as f32);

/// Rounding of a point–triangle distance of a fan, in units of [`U32`] times the tree's
/// `star_radius`. Proved: 23 (§8). A larger value widens the interval near the surface. A smaller
/// one loses the guarantee.
pub const FAN_DISTANCE: f32 = 32.0;

/// Least rounding of that distance, grid units: 2^-48. Squares below 2^-126 are not exact, and
/// their roots are off by up to 2^-63. Without this floor, intervals miss the truth next to
/// triangles that are points (§8).
pub const LEAST_FAN_ROUNDING: f32 = 1.0 / ((1u64 << 48) as f32);

/// Rounding of the same distance, in units of [`U32`] times the distance itself. Proved: 9 (§8).
pub const FAN_RELATIVE: f32 = 16.0;

/// Rounding of the distance from a plane between a query and a leaf, in units of [`U32`] times the
/// 1-norm of the way to the farthest corner of the model's box. Proved: 14 (§8). A larger value
/// visits more.
pub const PLANE_DISTANCE: f32 = 16.0;

/// Least ratio of the lower bound of every other triangle to the best square, 1 − 2^-18. A
/// triangle with less is refined as a sliver. The lower end of an interval is lower by half of the
/// missing part.
pub const CERTIFIED_PART: f32 = 1.0 - 1.0 / 262_144.0;

/// Further shortfall of a squared lower bound that passes on a u16 grid, where vertices moved by up
/// to 0.87 units: 1 square unit. It costs the interval 1/(2D) units at distance D and spares nearly
/// every second look. With f32 vertices it is 0.
pub const CERTIFIED_SHORTFALL: f32 = 1.0;

/// Part of a point's 1-norm by which its product with a direction of twelve bits is off at most,
/// 2^-8: 16u·2^12. Proved: 7u (§8).
pub const PLANE_ALONG: f32 = 1.0 / 256.0;

/// Distance, 1-norm, beyond which the model's box gives the answer: 2^38, a million times the
/// model's size. There the interval of the box is narrower than four units of f32.
pub const BVH_FAR: f32 = (1u64 << 38) as f32;

/// Squared limit above every square of the domain and below the key of a lane without a child.
pub const EVERYTHING_SQ: f32 = f32::from_bits(0x7E80_0000);

/// Part by which a squared limit grows: with [`LIMIT_ALLOWANCE`] it holds without a root (§8).
pub const LIMIT_GROWTH: f32 = 1.0 + 1.0 / 8192.0;

/// Factor of the square of a triangle's rounding in a limit (§8).
pub const LIMIT_ALLOWANCE: f32 = 32_768.0;

/// Added to the bits of a squared upper bound by integers: at least 2^-12 of it (§8).
pub const INT_LIMIT_GROWTH_BITS: u32 = 1 << 12;

/// Factor of [`LIMIT_ALLOWANCE`] in a limit by an upper bound of integers. Room for f32 (§8); an
/// answer beyond the limit is noticed, whatever the room.
pub const INT_LIMIT_SLACK: f32 = 8.0;

/// Least distance that a limit is made for. Its square is far above underflow.
pub const LEAST_LIMIT: f32 = 1.0 / (1u64 << 40) as f32;

/// Addition to the sine of a normal cone before a leaf counts as back-facing, 2^-19. The direction
/// to the eye, its product with the axis and the squares carry less than half of it. A smaller
/// value loses the guarantee. A larger one keeps a few more leaves.
pub const CONE_SINE: f32 = 1.0 / 524_288.0;

// Box tree, segments, in grid units

/// Half the width of the strip along an edge in which a kernel decides nothing, in units of [`U32`]
/// times the 1-norm of the way to the farthest corner. Proved: 12.9 (§9). A smaller value loses the
/// guarantee. A larger one leaves more segments undecided.
pub const FAN_SHEAR: f32 = 16.0;

/// Rounding of a parameter, in units of [`U32`] times the greatest parameter of the triangle's
/// corners and of the segment's far end. Proved: 21.6 (§9).
pub const FAN_PARAMETER: f32 = 24.0;

/// Rounding of the parameter at which a segment enters a box, in units of [`U32`] times the way to
/// the farthest corner along that axis. Proved: 28 (§9). A larger value visits more.
pub const BOX_ENTRY: f32 = 32.0;

/// Extents of the model that its farthest corner may be away from a segment's start before the
/// start is moved nearer. There the strip along edges in which nothing is decided is 2^-17 of the
/// model.
pub const NEAR_START: f32 = 8.0;

/// A component of a direction that counts as 0, 2^-80: the way along it is lost in any rounding.
pub const STILL: f32 = LEAST_DENOMINATOR / (1u32 << 20) as f32;

// Box tree, the side

/// Rounding of a triple product in f32, in units of [`U32`] times the sum of the absolute values of
/// its products. Proved: 8 for factors that carry one rounding each, second order apart (§8).
pub const SIGN_TRIPLE_PRODUCT: f32 = 16.0;

/// A triple product whose square exceeds this part of the factors' squared lengths exceeds
/// [`SIGN_TRIPLE_PRODUCT`] roundings too: twice its square, and 2^-8 for the roundings of both
/// sides (§8).
pub const PLAIN_SIDE_SQ: f32 =
    2.0 * SIGN_TRIPLE_PRODUCT * SIGN_TRIPLE_PRODUCT * U32 * U32 * (1.0 + 1.0 / 256.0);

/// No underflow matters to the square of a triple product above this, on the grid: 2^-40.
pub const PLAIN_SIDE_FLOOR: f32 = 1.0 / (1u64 << 40) as f32;

/// Integers of which every product and sum below this value is exact in f32.
pub const EXACT_INTEGERS: f32 = (1u32 << 24) as f32;

/// Rounding of a cosine, in units of [`U32`].
pub const SIGN_COSINE: f32 = 16.0;

/// Factor of [`LIMIT_ALLOWANCE`] where a side is asked. Proved: 41 (§8).
pub const SIDE_ALLOWANCE: f32 = 64.0;

/// Part of the distance up to which a triangle may be the closest, for a side: more than twice the
/// need of rounding (§8, "Sides").
pub const SIDE_BAND: f32 = 1.0 + 128.0 * U32;

/// The same in roundings of a triangle's distance (§8, "Sides").
pub const SIDE_BAND_ROUNDINGS: f32 = 8.0;

/// Part of the distance up to which a feature may be the closest. All nearer triangles are within
/// [`SIDE_BAND`]: half of its room (§8, "Sides").
pub const SIDE_FEATURE: f32 = 1.0 + 64.0 * U32;

/// The same in roundings of a triangle's distance (§8, "Sides").
pub const SIDE_FEATURE_ROUNDINGS: f32 = 4.0;

/// Error of a sum of normals about a vertex, in units of η²: 2π, rounded up
/// (`bvh/point/side/pseudonormal.rs`).
pub const VERTEX_FEATURE_ERROR: f32 = 6.5;

/// The same about an edge: 1, and more than the further terms up to [`LARGEST_ETA`]
/// (`bvh/point/side/pseudonormal.rs`).
pub const EDGE_FEATURE_ERROR: f32 = 1.2;

/// From this η on the sum is not used. Below, the next term about an edge, η⁴/4, is less than a
/// fiftieth of the first (`bvh/point/side/pseudonormal.rs`).
pub const LARGEST_ETA: f32 = 0.25;

/// Rounding of a term of a sum of normals, in units of [`U32`] times the relative size of its
/// normal's products. Proved: 8.2. Also that of the way across an edge. Proved: 14 (§8, "Sum of
/// normals").
pub const SIDE_SUM_NORMAL: f32 = 16.0;

/// Rounding of a sum of normals and of its product with the direction, in units of [`U32`] times
/// the sum of the weights. Proved: 13 (§8). Each term adds [`SIDE_SUM_TERM`].
pub const SIDE_SUM_WEIGHTS: f32 = 32.0;

/// What each term adds to [`SIDE_SUM_WEIGHTS`]. Proved: 1 (§8).
pub const SIDE_SUM_TERM: f32 = 2.0;

/// Rounding of a weight, in units of [`U32`]. Proved: 26 (§8).
pub const SIDE_SUM_WEIGHT: f32 = 64.0;

/// Length of a normal in units of [`U32`] times the sizes of its products, from which on it has a
/// direction (§8, "Sum of normals").
pub const SIDE_NORMAL: f32 = 64.0;

/// Largest surface error of a box tree, grid units: 2^60. Its square and its product with any
/// length of a query stay finite.
pub const MOST_SURFACE_ERROR: f32 = (1u64 << 60) as f32;

// Box tree, overlap, in units of the coarser grid

/// Rounding of a box's interval, in units of [`U32`] times the extent of both trees along the
/// direction. Proved: 76 (§11).
pub const OVERLAP_INTERVAL: f64 = 96.0;

/// Rounding of a moved vertex, the 2-norm, in unit roundoffs times the longest offset along an
/// axis. Proved: 8.7 in f32, 19.1 in f64 (§11).
pub const OVERLAP_VERTEX: f64 = 20.0;

/// Longest offset along an axis, surface errors included: 2^30. Products of four lengths and their
/// sums stay in f32's range. Trees are within 2^25 of their origins, so that only an absurd surface
/// error gets there.
pub const OVERLAP_FARTHEST: f64 = (1u64 << 30) as f64;

/// Loss of an interval's end by underflow: terms lose 2^-150 each and are multiplied by less than
/// 2^30 (§11). A shorter direction separates nothing.
pub const OVERLAP_UNDERFLOW: f64 = 1.0 / (1u128 << 100) as f64;

// Box tree, distance of two trees, in units of the coarser grid

/// Rounding of the distance of two triangles in f64, in units of [`U64`] times the sum of the
/// largest 1-norms of their vertices. Proved: 17.5 (§18). A larger value widens the interval, which
/// at 32 is far below one unit of f32.
pub const TRIANGLE_DISTANCE: f64 = 32.0;

/// Part of the length of a way that the gap along it must have before the search for nearer points
/// of two triangles ends, 1 − 2^-30. A smaller value ends earlier and widens the interval.
pub const GAP_SETTLED: f64 = 1.0 - 1.0 / (1u64 << 30) as f64;

/// How much nearer than the limit leaves may be along a direction in integers without a look at
/// their triangles, in units of the coarser grid. A larger value widens the interval by as much, a
/// smaller one measures more.
pub const INT_GAP: f64 = 1.0 / (1u64 << 18) as f64;

/// No more than this part of the limit is given up for [`INT_GAP`].
pub const INT_PART: f64 = 1.0 / (1u64 << 20) as f64;

/// Bits after the first of a direction in integers. Its greatest component has up to 45 bits, a
/// vertex 16, a sum of three 2: 63, so heights are exact (§26).
pub const INT_DIRECTION_BITS: u64 = 44;

/// Squared length below which a direction in f64 is not trusted, so that no product that decides
/// underflows (§18). It bounds nothing then, which is always true.
pub const GAP_DIRECTION_SQ: f64 = 1e-270;

/// Rounding of the gap of two triangles along a direction in f32, in units of [`U32`] times the sum
/// of the largest 1-norms of their vertices. Proved: 7.5 (§18). A larger value computes a few more
/// distances.
pub const GAP_ALONG: f32 = 16.0;

/// Squared gaps and limits carry less than eight roundings each. This factor on a limit keeps their
/// comparison on the safe side (§18).
pub const GAP_SLACK: f32 = 1.0 + 16.0 * U32;

/// A point that moves to the nearest odd multiples of 1/256 above or below it, and its place in
/// f32, together move it by less than this, grid units. Proved: 0.017 (§12). Points that are nearer
/// to a tight hull count as inside. A smaller value could tell a wrong side.
pub const RAY_MOVED: f32 = 1.0 / 32.0;

/// The same where vertices in f32 move down to the grid, by less than one unit along each axis.
/// Proved: 1.76 (§12).
pub const RAY_MOVED_F32: f32 = 2.0;

/// The squared distance from a tight hull's box, and the squared limit that it is compared with,
/// carry less than nine roundings together. This factor keeps the comparison on the safe side
/// (§12). A smaller one leaves a few more questions to the hull's tree.
pub const TIGHT_BOX: f32 = 1.0 - 16.0 * U32;

/// Squared bound of a pair of boxes below which the bound counts as 0, 2^-100: the terms of a
/// larger one lost nothing that matters by underflow (§18).
pub const LEAST_GAP_SQ: f32 = SQUARE_FLOOR;

/// Least stretch of a matrix for which gaps along its columns bound a distance, 2^-10. A flatter
/// matrix leaves the gaps along the first model's axes.
pub const LEAST_STRETCH: f64 = 1.0 / 1024.0;

// Box tree, convex solids, in grid units

/// Rounding of the distance of a convex solid and a triangle in f64, in units of [`U64`] times the
/// sum of the largest 1-norms of their corners. Proved: 14 (§19). A larger value widens the
/// interval, which at 32 is far below one unit of f32.
pub const CONVEX_GAP: f64 = 32.0;

/// Rounding of the distance of a plane from the origin times its normal's length, in units of
/// [`U64`] times the 1-norms of two edges and of a corner. Proved: 11 (§19).
pub const CONVEX_DEPTH: f64 = 16.0;

/// Squared gaps along the axes of a solid are multiplied by this. Its axes are unit vectors that
/// were rounded to f32 (§19).
pub const SOLID_AXES: f32 = 1.0 - 16.0 * U32;

/// Rounding of a corner that moves, and of its time, in units of [`U64`] times the largest
/// coordinate of its ends. Proved: 13.9 (§19).
pub const MOVING_CORNER: f64 = 16.0;

/// Part of an advance that is kept, for the roundings of a quotient and a sum (§19).
pub const ADVANCE_KEPT: f64 = 1.0 - 1.0 / (1u64 << 40) as f64;

/// Room for the rounding in f64 of a pose on a screw, beside its rounding to f32 (§19).
pub const SCREW_ROUNDING: f64 = 1.0 + 1.0 / (1u64 << 20) as f64;

/// Rounding of a model's box in the world, in units of [`U32`] times the sizes of its terms.
/// Proved: 13 (§21).
pub const WORLD_BOX: f32 = 16.0;

/// Least gap of two boxes in the world that counts, 2^-60: its square is in f32's normal range.
pub const LEAST_WORLD_GAP: f32 = 1.0 / (1u64 << 60) as f32;

/// Rounding of what a rounded pose of one model in the frame of another leaves at a point, in units
/// of [`U64`] times the sum of its terms. Proved: 8 (§21).
pub const RELATIVE_POSE: f64 = 16.0;

// Box tree, boxes of two models in f32, in input units

/// Rounding of a model's box, of its ball's radius and of its reach, in units of [`U32`] times the
/// 1-norms of its corners. Proved: 4 (§24).
pub const MODEL_BOX: f32 = 8.0;

/// Rounding of the gap of two boxes, or of a box and a ball, in units of [`U32`] times the reach of
/// both models. Proved: 66 (§24). A larger value leaves more pairs to the trees: 128 units are 8
/// millionths of the distance.
pub const BOX_PAIR: f32 = 128.0;

/// Rounding of the way of a ball's middle, in units of [`U32`] times the change of the matrix and
/// the model's reach. Proved: 6 (§24).
pub const MOTION: f32 = 64.0;

/// Rounding of the distance of a matrix from a rotation, in units of [`U32`]. Proved: 12 (§24).
pub const SKEW: f32 = 16.0;

/// The distance of a matrix from a rotation below which it is within [`POSE_DEFECT`]: √3 times it
/// is less (§24).
pub const NEARLY_RIGID: f32 = 0.140_625;

// Box tree, two trees in f32, in units of the first grid

/// Rounding of a gap of two triangles, and of the way between two of their points, in units of
/// [`U32`] times the sizes of the terms of a place. Proved: 16 (§26).
pub const SEPARATION_VERTEX: f32 = 24.0;

/// Rounding of a gap of two boxes, in the same units. Proved: 61 (§26). A larger value opens a few
/// more pairs.
pub const SEPARATION_BOX: f32 = 72.0;

/// Rounding of the pose of one placed model in the frame of another, in units of [`U32`] times the
/// reach of both models. Proved: 7.5 (§26).
pub const SEPARATION_POSE: f32 = 10.0;

/// Longest place for which two trees are compared in f32: 2^29. Products of four differences stay
/// in f32's range.
pub const SEPARATION_FARTHEST: f32 = (1u32 << 29) as f32;

/// Least distance that points are proved to be within: 2^-20. Its square is far above underflow.
pub const LEAST_NEAR: f32 = 1.0 / (1u32 << 20) as f32;

// Box tree, winding numbers

/// Rounding of numerator and denominator of a solid angle's tangent, in units of [`U32`] times the
/// product of the corners' distances. Proved: 57 (§20).
pub const SOLID_ANGLE: f32 = 64.0;

/// Rounding of the argument of a product of two complex numbers, twice, in units of [`U32`].
/// Proved: 4.9 (§20).
pub const ANGLE_PRODUCT: f32 = 6.0;

/// Twice the arcsine of s ≤ ½ is at most this times s: 2π/3, rounded up (§20).
pub const TWO_ARCSINES: f32 = 2.125;

/// Error of `libm`'s arctangent, in units of [`U32`]. FDLIBM states one unit in the last place,
/// which is two of these.
pub const ARCTANGENT: f32 = 8.0;

/// Rounding of the distance of an edge, in units of [`U32`] times the 1-norms of its ends: that of
/// §14, and one rounding of each end (§20).
pub const EDGE_DISTANCE: f32 = 64.0;

/// Rounding of the flux of a node's moments, in units of [`U32`] times the sum of the sizes of its
/// terms. Proved: 46 (§20).
pub const MOMENT_FLUX: f32 = 64.0;

/// Shortest distance of a corner, or of a node's centre, with which squares and products keep their
/// precision: 2^-30 grid units (§20).
pub const SOLID_ANGLE_NEAREST: f32 = 1.0 / (1u32 << 30) as f32;

/// Largest error for which a point beyond [`BVH_FAR`] is certainly far, 2^36 grid units (§20).
pub const WINDING_FAR_ERROR: f32 = (1u64 << 36) as f32;

/// Winding number of a far triangle per squared grid unit of its star, 2^-78 (§20).
pub const WINDING_FAR: f32 = 1.0 / ((1u64 << 39) as f32 * (1u64 << 39) as f32);

// Two box trees that are solids

/// Rounding of a place in the other model's frame, in units of [`U64`] times the sum of its
/// coordinates. Proved: 4 (§22).
pub const PART_PLACE: f64 = 8.0;

/// Rounding of the gap of two boxes along a direction, in units of [`U64`] times the 1-norms of
/// their corners and of the shift. Proved: 16 (§22).
pub const PARTED: f64 = 64.0;

// Box tree, coherent queries

/// Squared sine of the angle between the spokes of a triangle below which the triangle counts as a
/// sliver: 2^-16, a quarter of a degree.
pub const SLIVER_SINE_SQ: f32 = 1.0 / 65_536.0;

/// Shortfall of the lower bound of a triangle that is not a sliver, as a part of (distance +
/// `star_radius`): 2^-14. It grows with 1/sine; measured at the limit: 2^-15.
pub const SHORTFALL: f32 = 1.0 / 16_384.0;

/// Rounding of a root and a few products, relative, 2^-20.
pub const ROOT_AND_PRODUCTS: f32 = 1.0 / 1_048_576.0;

/// Part of the squared radius of an empty ball that roundings may take: 2^-18. Both places convert
/// exactly, so the way between them carries u, its square 5u, and the radius and its square 4u. The
/// rest is spare.
pub const EMPTY_BALL: f32 = 1.0 / 262_144.0;

/// Rounding of the length of a scaled normal, relative, 2^-18.
pub const PLANE_NORMAL: f32 = 1.0 / 262_144.0;

/// Rounding of one sum of a path, relative, 2^-22.
pub const PATH_SUM: f32 = 1.0 / 4_194_304.0;

/// Length of a path, in units of the rounding of a box bound, after which the path is counted from
/// zero again. Keys are as long as the path, and their rounding stays below that of the bound.
pub const LONG_PATH: f32 = 2_097_152.0;

// Curves, in the local frame

/// Rounding of a point–segment distance, in unit roundoffs times the 1-norms of `ap` and `ab`.
/// Proved: 19 (§14). In f64 it is the interval, in f32 the margin of a capsule. A smaller value
/// loses the guarantee.
pub const SEGMENT_DISTANCE: f32 = 24.0;

/// Loss of a capsule's bound on a segment that is too short to have a direction in f32, and by
/// underflow: 2^-48 (§14).
pub const CAPSULE_UNDERFLOW: f32 = 1.0 / (1u64 << 48) as f32;

/// Largest query coordinate for which distances to a curve are computed: 2^24. From farther away
/// the interval of the curve's box is narrower than four units of f32.
pub const CURVE_FAR: f64 = (1u32 << 24) as f64;

/// Rounding of the turn from a segment to a point, in units of [`U64`] times the sizes of its two
/// products. Proved: 5 (§14). Where a distance is proved to be above 0, every turn is far larger,
/// and nearer points are undecided anyway: a second line of defence. Up to 16 it leaves no turn
/// unclear.
pub const CURVE_TURN: f64 = 8.0;

// Triboxes

/// Rounding of the gap between two moved triboxes along a direction, in units of [`U32`] times the
/// sum of the sizes of all terms. Proved: 30 (§10). A larger value separates less: 64 units are 4
/// millionths of the models' size.
pub const TRIBOX_AXIS: f32 = 64.0;

/// Factor by which the distance that two moved triboxes are asked about is enlarged for rounding.
/// Proved: 11 units of [`U32`] (§10). A smaller value loses the guarantee.
pub const TRIBOX_DISTANCE: f32 = 1.0 + 16.0 * U32;

/// Most that the matrix of stored triboxes may differ from a rotation, as the row sums of
/// `RRᵀ − 1`: 2^-19. Entries rounded to f32 differ by 2^-21, and the sums' own rounding is as much.
/// Every bound includes the difference (§10), so a larger value only widens bounds.
pub const TRIBOX_TURN: f32 = 1.0 / 524_288.0;

/// Rounding of a moved coordinate, in units of [`U32`] times the sum of the sizes of its terms.
/// Proved: 5, of the product 1, of the sums 3, of this product 1.
pub const TRIBOX_COORDINATE: f32 = 8.0;

/// How far a place on the way between two points of f32 may be from its computed place, in units of
/// [`U32`] times the sum of the absolute coordinates of both. Proved: 4.5, of the middle
/// a half, of a place between the middle and an end 4. A greater number leaves more questions to
/// the box tree.
pub const SWEPT_PLACE: f32 = 6.0;

/// Part by which the length of a way between two points may be too short in f32: two differences'
/// and two products' roundings, two sums, the root. Proved: 5.5 units of [`U32`].
pub const SWEPT_LENGTH: f32 = 1.0 + 16.0 * U32;
