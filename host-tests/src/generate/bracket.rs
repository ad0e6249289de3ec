//! A machined part as CAD tessellators export it.

use super::Triangles;
use super::builder::Builder;

const STEPS: usize = 240;

/// An L-shaped bracket of two plates, each with a bore: closed, genus 2, 1,948 triangles, flat
/// faces exactly flat, most triangles needles (fans from a face's corner to the bore's arc; walls
/// one chord wide). Box (0,0,0)–(60,40,60).
#[must_use]
pub fn bracket() -> Triangles {
    let mut builder = Builder::default();
    // Profile in x and z, along y from 0 to 40; plates 8 thick. Both bores are centred at (36, 20)
    // in their plates.
    let lying = |u: f32, v: f32, w: f32| [u, v, w];
    let standing = |u: f32, v: f32, w: f32| [w, v, u];
    plate(&mut builder, lying, [0.0, 0.0, 1.0]);
    plate(&mut builder, standing, [1.0, 0.0, 0.0]);
    // Ends of the plates.
    let strip = |x: [f32; 2], z: [f32; 2]| {
        [[x[0], 0.0, z[0]], [x[0], 40.0, z[0]], [x[1], 40.0, z[1]], [x[1], 0.0, z[1]]]
    };
    builder.quad(strip([60.0, 60.0], [0.0, 8.0]), [1.0, 0.0, 0.0]);
    builder.quad(strip([0.0, 8.0], [60.0, 60.0]), [0.0, 0.0, 1.0]);
    // The L-shaped sides.
    let profile = [[60.0, 0.0], [60.0, 8.0], [8.0, 8.0], [8.0, 60.0], [0.0, 60.0]];
    for (y, outward) in [(0.0, [0.0, -1.0, 0.0]), (40.0, [0.0, 1.0, 0.0])] {
        let at = |[x, z]: [f32; 2]| [x, y, z];
        for pair in profile.windows(2) {
            builder.facing([at([0.0, 0.0]), at(pair[0]), at(pair[1])], outward);
        }
    }
    builder.finish()
}

/// The two faces and the bore of one plate. `place` maps plate coordinates (u along, v across, w
/// through) to the part; `through` is the direction of w.
fn plate(builder: &mut Builder, place: impl Fn(f32, f32, f32) -> [f32; 3], through: [f32; 3]) {
    let arc: Vec<[f32; 2]> = (0..STEPS)
        .map(|i| {
            let angle = std::f64::consts::TAU * i as f64 / STEPS as f64;
            [(36.0 + 8.0 * libm::cos(angle)) as f32, (20.0 + 8.0 * libm::sin(angle)) as f32]
        })
        .collect();
    let back = through.map(|x| -x);
    // Outer face at w = 0, inner face at w = 8, where the other plate takes up the first 8 of u.
    for (w, u_low, outward) in [(0.0, 0.0, back), (8.0, 8.0, through)] {
        let corners = [[60.0, 40.0], [u_low, 40.0], [u_low, 0.0], [60.0, 0.0]];
        let at = |[u, v]: [f32; 2]| place(u, v, w);
        let quarter = STEPS / 4;
        for (k, &corner) in corners.iter().enumerate() {
            for i in k * quarter..(k + 1) * quarter {
                builder.facing([at(corner), at(arc[i]), at(arc[(i + 1) % STEPS])], outward);
            }
            let junction = arc[(k + 1) * quarter % STEPS];
            builder.facing([at(corner), at(junction), at(corners[(k + 1) % 4])], outward);
        }
    }
    for i in 0..STEPS {
        let ([u, v], [s, t]) = (arc[i], arc[(i + 1) % STEPS]);
        let inwards = place(36.0 - u, 20.0 - v, 0.0);
        builder.quad(
            [place(u, v, 0.0), place(s, t, 0.0), place(s, t, 8.0), place(u, v, 8.0)],
            inwards,
        );
    }
}
