//! The frame that the boxes of a node share.
//!
//! Box coordinates of a point are `q = A·(p − origin) + 128`, axis by axis. A step of an axis is
//! `√weight` grid units long. The builder chooses `A` so that every entry is exactly an f32 and
//! `√weight·A` is a rotation. Only the sums here are rounded.

use crate::bvh::format::layout::FRAME_BYTES;
use crate::bvh::format::layout::boxes;
use glam::Vec3;

/// A query point in the frame of one node: its box coordinates, and the lengths of their steps.
#[derive(Clone, Copy, Debug)]
pub struct NodeFrame {
    /// Box coordinates of the point.
    pub q: [f32; 3],
    /// Square of one step, grid units, rounded down.
    pub weight: [f32; 3],
}

impl NodeFrame {
    /// Brings `p` (grid units) into the frame of a node's boxes.
    #[inline(always)]
    pub fn of(record: &[u8; FRAME_BYTES], p: Vec3) -> NodeFrame {
        let (words, _) = record.as_chunks::<4>();
        let mut f = [0f32; 15];
        if let Some(tail) =
            words.get(boxes::FRAME_ROWS / 4..).and_then(|words| words.first_chunk::<15>())
        {
            f = tail.map(f32::from_le_bytes);
        }
        let [a, b, c, d, e, g, h, i, j, ox, oy, oz, u, v, w] = f;
        let (x, y, z) = (p.x - ox, p.y - oy, p.z - oz);
        let q = [
            a * x + b * y + c * z + 128.0,
            d * x + e * y + g * z + 128.0,
            h * x + i * y + j * z + 128.0,
        ];
        NodeFrame { q, weight: [u, v, w] }
    }
}
