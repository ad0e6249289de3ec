//! Least gains and clearances of edits. None decides whether an edit is proved.

/// Half-steps of the grid that a placement keeps from planes, by attempt. Rounding moves a vertex
/// by less than two. An edit that is not proved with the first may be proved with the last.
pub(super) const CLEARANCES: [f64; 2] = [4.0, 16.0];

/// Volumes that differ by less than this fraction of the star's radius cubed count as equal. Moves
/// must come to an end, and each makes the stars around it ask again. With a thousandth of this,
/// half of the answers are asked for again.
pub(super) const GAIN: f64 = 1e-6;

/// Least fraction of the hull's volume that a flip or an exchange gains: more than the rounding of
/// the volume's sum.
pub(super) const LEAST_GAIN: f64 = 1e-9;

/// Heights below this fraction of a star's radius are rounding.
pub(super) const ROUNDING: f64 = 1e-12;
