//! A fan asked in `f32`, as firmware asks it: the kernels of paper 003, 3.3 and 4.3, by what the
//! fan stores. The images of `fan-firmware` compile this file too, so it names no crate.

/// What a fan may store, by the number of its kernel. Lengths are of edges, normals of two edges.
pub const STORED: [&str; 4] = ["vertices", "edges", "edges, lengths", "edges, lengths, normals"];

/// A kernel that asks nothing: what the loop around a kernel takes.
pub const NOTHING: u8 = STORED.len() as u8;

/// A fan. A kernel reads the vertices of its rim or the edges, and what else it is said to store.
#[derive(Clone, Copy, Debug)]
pub struct Fan<'a> {
    /// The vertex that all triangles share.
    pub centre: [f32; 3],
    /// The others in order.
    pub rim: &'a [[f32; 3]],
    /// From the centre to each of them.
    pub edges: &'a [[f32; 3]],
    /// Squares of the edges.
    pub lengths: &'a [f32],
    /// The product of the edge before and each edge; of the first one nothing.
    pub normals: &'a [[f32; 3]],
}

/// `a - b`.
#[must_use]
pub fn minus(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// The scalar product.
#[must_use]
pub fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The vector product.
#[must_use]
pub fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The lesser number; the second one if the first is none.
fn lesser(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

fn from_0_to_1(x: f32) -> f32 {
    x.clamp(0.0, 1.0)
}

/// Each edge with its stored square and normal, whichever of them the kernel reads.
fn spokes<'a, const KIND: u8>(
    fan: &Fan<'a>,
) -> impl Iterator<Item = ([f32; 3], f32, [f32; 3])> + use<'a, KIND> {
    let centre = fan.centre;
    let ends = if KIND == 0 { fan.rim } else { fan.edges };
    ends.iter().zip(fan.lengths).zip(fan.normals).map(move |((&end, &square), &normal)| {
        (if KIND == 0 { minus(end, centre) } else { end }, square, normal)
    })
}

/// The squared distance of a point to a fan. A triangle is skipped if both of its edges lead away
/// from the point.
#[must_use]
pub fn distance_sq<const KIND: u8>(p: [f32; 3], fan: &Fan<'_>) -> f32 {
    if KIND == NOTHING {
        return p[0];
    }
    let s = minus(p, fan.centre);
    let ss = dot(s, s);
    let mut least = ss;
    let mut before: Option<([f32; 3], f32, Option<f32>)> = None;
    for (b, square, _) in spokes::<KIND>(fan) {
        let xb = dot(s, b);
        let mut rb = None;
        if let Some((a, xa, ra)) = before
            && (xa > 0.0 || xb > 0.0)
        {
            let aa = ra.unwrap_or_else(|| dot(a, a));
            let bb = if KIND >= 2 { square } else { dot(b, b) };
            least = lesser(quadratic([aa, dot(a, b), bb], [xa, xb], ss), least);
            rb = Some(bb);
        }
        before = Some((b, xb, if KIND >= 2 { Some(square) } else { rb }));
    }
    least
}

/// The least of `|u a + v b - s|²` over a triangle, by inner products.
fn quadratic([aa, ab, bb]: [f32; 3], [xa, xb]: [f32; 2], ss: f32) -> f32 {
    let at = |u: f32, v: f32| {
        let value = u * (u * aa + 2.0 * (v * ab - xa)) + v * (v * bb - 2.0 * xb) + ss;
        // Of an edge without length there is no number, and it is passed over.
        if value < 0.0 { 0.0 } else { value }
    };
    let determinant = aa * bb - ab * ab;
    let (u, v) = ((xa * bb - xb * ab) / determinant, (xb * aa - xa * ab) / determinant);
    if u >= 0.0 && v >= 0.0 && u + v <= 1.0 {
        return at(u, v);
    }
    let t = from_0_to_1((xb - xa - ab + aa) / (aa + bb - 2.0 * ab));
    let [a, b] = [at(from_0_to_1(xa / aa), 0.0), at(0.0, from_0_to_1(xb / bb))];
    lesser(a, lesser(b, at(1.0 - t, t)))
}

/// Parameter of a segment's first hit of a fan, else 2. A triangle is skipped if both ends of its
/// edge on the rim are on one side of the plane through centre and segment.
#[must_use]
pub fn hit<const KIND: u8>(from: [f32; 3], way: [f32; 3], fan: &Fan<'_>) -> f32 {
    if KIND == NOTHING {
        return from[0];
    }
    let s = minus(from, fan.centre);
    let n = cross(s, way);
    let mut first = 2.0;
    let mut before: Option<([f32; 3], f32)> = None;
    for (b, _, stored) in spokes::<KIND>(fan) {
        let xb = dot(n, b);
        if let Some((a, xa)) = before
            && !((xa < 0.0 && xb < 0.0) || (xa > 0.0 && xb > 0.0))
        {
            let normal = if KIND >= 3 { stored } else { cross(a, b) };
            let determinant = dot(normal, way);
            let (u, v) = (-xb / determinant, xa / determinant);
            if u >= 0.0 && v >= 0.0 && u + v <= 1.0 {
                let t = -dot(normal, s) / determinant;
                if (0.0..=1.0).contains(&t) {
                    first = lesser(t, first);
                }
            }
        }
        before = Some((b, xb));
    }
    first
}

/// Bits that depend on each answer and on their order.
#[must_use]
pub fn folded(sum: u32, answer: f32) -> u32 {
    sum.rotate_left(5) ^ answer.to_bits()
}
