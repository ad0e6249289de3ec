//! The tolerances that guarantees rest on, in one place. Derivations: `core/docs/rounding.md`,
//! whose section each constant names.
//!
//! All of them are relative: multiplied by lengths of the model and the query at hand, or in the
//! local frame, where the model's largest coordinate lies in [½, 1).

/// Unit roundoff of f32, 2^-24.
pub const U32: f32 = f32::EPSILON / 2.0;

/// Unit roundoff of f64, 2^-53.
pub const U64: f64 = f64::EPSILON / 2.0;

/// Rounding of the f32 lower bound of a point–triangle distance, in units of [`U32`] times
/// (distance to the farthest corner + longest edge). Proved: 12.7 (§2). Smaller loses the
/// guarantee; larger opens a few more nodes.
pub const POINT_BOUND: f32 = 16.0;

/// Rounding of the f32 lower bound of a segment–triangle distance, in the same units, of
/// which the probe's sum of norms holds two. Proved: 31 (§3).
pub const SEGMENT_BOUND: f32 = 48.0;

/// Rounding of the f64 point–triangle interval, in units of [`U64`] times the 1-norms of `ap`,
/// `ab`, `ac`. Proved: 8.6 (§4). Larger widens the reported interval, which at 16 is still below
/// one unit of f32.
pub const POINT_INTERVAL: f64 = 16.0;

/// Rounding of a triple product `d · (b × c)` in f64, in units of [`U64`] times the product of the
/// 1-norms. Proved: 9.1 (§5). It decides how near a segment that just misses an edge may pass and
/// still be called a hit.
pub const TRIPLE_PRODUCT: f64 = 16.0;

/// Distance, in units of [`U64`] times the 1-norms in play, below which a segment in the plane of a
/// triangle touches it (§5).
pub const COPLANAR_TOUCH: f64 = 64.0;

/// Two bounds are compared as squares, which is off by less than eight roundings: a factor that
/// keeps the comparison on the safe side (§2). It is part of what [`POINT_BOUND`] leaves over.
pub const SQUARED_SLACK: f32 = 1.0 - 8.0 * U32;

/// Squared length, in the local frame, below which a direction in f32 is not trusted: 2^-100.
/// Products of two such components stay above the subnormal range. Below it a lower bound falls
/// back to zero, which is always true (§2).
pub const TRUSTED_DIRECTION_SQ: f32 = 1.0 / ((1u64 << 50) as f32 * (1u64 << 50) as f32);

/// What underflow can cost a bound in the local frame, 2^-96: every term that underflows loses less
/// than 2^-146, and it is divided by a direction no shorter than 2^-50 (§2).
pub const UNDERFLOW: f32 = 1.0 / ((1u64 << 48) as f32 * (1u64 << 48) as f32);

/// Largest query coordinate in the local frame for which nodes are bounded in f32: 2^12. There the
/// rounding margin is half a percent of the model; farther out it would hide the model, so f64
/// takes over. Products of four lengths stay below 2^60.
pub const SINGLE: f64 = 4096.0;

/// Largest query coordinate in the local frame for which distances are computed at all: 2^40.
/// Beyond it the whole model subtends less than a unit of f32, and the answer is read off its box.
pub const FAR: f64 = (1u64 << 40) as f64;

/// What a denominator in a fan's kernel has to exceed, grid units to the fourth power or less:
/// 2^-60. On a u16 grid every denominator that is not 0 is at least 1; with f32 vertices a smaller
/// one belongs to a triangle that is a point for all that f32 can tell, and its centre stands for
/// it. The bound that certifies it does not depend on the choice (§8).
pub const TREE_TINY: f32 = 1.0 / ((1u64 << 60) as f32);

/// Rounding of a computed point–triangle distance of a fan, in units of [`U32`] times the tree's
/// `reach`. Proved: 23 (§8). Larger widens the interval near the surface, smaller loses the
/// guarantee.
pub const TREE_FAN: f32 = 32.0;

/// The same, in units of [`U32`] times the distance itself. Proved: 9 (§8).
pub const TREE_RELATIVE: f32 = 16.0;

/// Rounding of a box bound of the tree, in units of [`U32`] times the 1-norm of the way to the
/// farthest corner of the model's box. Proved: 11.3 (§8). Larger visits more.
pub const TREE_BOX: f32 = 16.0;

/// A certified square less than the best square by more than this part, 2^-18, counts as weak and
/// is looked at again. The lower end of an interval is lower by half of that part.
pub const TREE_WEAK: f32 = 1.0 - 1.0 / 262_144.0;

/// What a certified square may moreover fall short by on a u16 grid, where vertices moved by up to
/// 0.87 units anyway: 1 square unit. It costs the interval 1/(2D) units at distance D and spares
/// nearly every second look. 0 with exact vertices.
pub const TREE_SHORT: f32 = 1.0;

/// What is added to the sine of a cone of normals before a leaf counts as back-facing, 2^-19. The
/// way to the eye, its product with the axis and the squares carry less than half of that. Smaller
/// loses the guarantee; larger keeps a few leaves more.
pub const CONE_SINE: f32 = 1.0 / 524_288.0;

/// Distance in grid units, 1-norm, beyond which the interval of the tree's box is narrower than
/// four units of f32: 2^38, which is a million times the model's size.
pub const TREE_FAR: f32 = (1u64 << 38) as f32;

/// Rounding of the gap between two moved triboxes along a direction, in units of [`U32`] times the
/// sum of the sizes of what is added up. Proved: 30 (§10). Larger tells less apart: 64 units are 4
/// millionths of the models' size.
pub const TRIBOX_AXIS: f32 = 64.0;
