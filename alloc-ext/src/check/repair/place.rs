//! Places of a mesh as keys.

/// A place by its bits, without −0.0.
pub(super) type Place = [u32; 3];

pub(super) fn place(at: [f32; 3]) -> Place {
    at.map(|x| (x + 0.0).to_bits())
}
