//! Single pairs of triangles: what is certain stays so wherever the vertices are.

use meshsweep_core::internal::geom::{Contact, triangles_meet};
use meshsweep_host_tests::generate::Rng;
use meshsweep_host_tests::oracle::moved::{Place, triangles_meet as truth};

type Triangle = [[f32; 3]; 3];

/// Triangles of which some are needles, nearly in one plane, or tiny beside the other.
fn pair(rng: &mut Rng) -> [Triangle; 2] {
    let mut triangle = |size: f32, flat: f32, thin: f32| -> Triangle {
        let centre = rng.point_in([-0.5; 3], [0.5; 3]);
        let mut corners = [(); 3].map(|()| {
            let p = rng.point_in([-size; 3], [size; 3]);
            [centre[0] + p[0], centre[1] + p[1] * thin, centre[2] * flat + p[2] * flat]
        });
        if thin < 0.5 {
            corners[2][0] = corners[1][0] + thin * size;
        }
        corners
    };
    let pick = |rng: &mut Rng, of: &[f32]| of[rng.below(of.len())];
    let mut shapes = Rng::new(7 + triangle(1.0, 1.0, 1.0)[0][0].to_bits() as u64);
    let flat = pick(&mut shapes, &[1.0, 1.0, 1e-3, 0.0]);
    let mut next = || {
        let (size, thin) =
            (pick(&mut shapes, &[1.0, 1.0, 0.1, 1e-3]), pick(&mut shapes, &[1.0, 1.0, 1e-3]));
        triangle(size, flat, thin)
    };
    [next(), next()]
}

#[test]
fn what_is_certain_of_vertices_within_a_ball_is_true_of_each() {
    let mut rng = Rng::new(41);
    let mut counts = [0usize; 3];
    for round in 0..40_000 {
        let [a, b] = pair(&mut rng);
        let doubt = [0.0f32, 1e-6, 1e-3, 0.1][round % 4];
        let single = triangles_meet(a, b, doubt);
        let wide = |t: Triangle| t.map(|p| p.map(f64::from));
        let double = triangles_meet(wide(a), wide(b), f64::from(doubt));
        for contact in [single, double] {
            counts[contact as usize] += 1;
        }
        // Single precision may leave open what double does not.
        assert!(single == double || single == Contact::Undecided, "{a:?} {b:?} {doubt}");
        if double == Contact::Undecided {
            continue;
        }
        for _ in 0..4 {
            let mut shaken = |t: Triangle| {
                t.map(|p| {
                    let way = rng.direction();
                    Place::of(std::array::from_fn(|k| p[k] + 0.99 * doubt * way[k]))
                })
            };
            let (p, q) = (shaken(a), shaken(b));
            let meets = truth(p.each_ref(), q.each_ref());
            assert_eq!(meets, double == Contact::Meets, "{a:?} {b:?} {doubt}");
            if doubt == 0.0 {
                break;
            }
        }
    }
    assert!(counts.iter().all(|&count| count > 1_000), "{counts:?}");
}
