//! Splitting until every tribox is within a distance of the hull of what it holds.

use super::mesh;
use meshsweep::progress::Watch;
use meshsweep::tribox::{self, TriboxOptions, TriboxReport};
use meshsweep_core::{Tribox, Triboxes};
use meshsweep_host_tests::generate::{Triangles, icosphere, scaled, torus};

const DIRECTIONS: [[f64; 3]; 9] = [
    [1.0, 0.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 1.0, 0.0],
    [1.0, -1.0, 0.0],
    [0.0, 1.0, 1.0],
    [0.0, 1.0, -1.0],
    [1.0, 0.0, 1.0],
    [-1.0, 0.0, 1.0],
];

/// A half-space `normal · p ≤ level`.
type HalfSpace = ([f64; 3], f64);

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The distance of a point to an intersection of half-spaces, by Dykstra's projections: an
/// approximation.
fn distance(p: [f64; 3], planes: &[HalfSpace]) -> f64 {
    let mut at = p;
    let mut owed = vec![[0.0; 3]; planes.len()];
    for _ in 0..100 {
        for ((normal, level), owed) in planes.iter().zip(&mut owed) {
            let from = [0, 1, 2].map(|k| at[k] + owed[k]);
            let over = (dot(*normal, from) - level).max(0.0) / dot(*normal, *normal);
            at = [0, 1, 2].map(|k| from[k] - over * normal[k]);
            *owed = [0, 1, 2].map(|k| from[k] - at[k]);
        }
    }
    dot([0, 1, 2].map(|k| at[k] - p[k]), [0, 1, 2].map(|k| at[k] - p[k])).sqrt()
}

/// The half-spaces of a convex mesh.
fn of_mesh((positions, triangles): &Triangles) -> Vec<HalfSpace> {
    let plane = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|v| positions[v as usize].map(f64::from));
        let (u, v) = ([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k]));
        let normal =
            [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        (normal, dot(normal, a))
    };
    triangles.iter().map(plane).collect()
}

fn of_tribox(tribox: &Tribox) -> impl Iterator<Item = HalfSpace> {
    let slabs = DIRECTIONS.into_iter().zip(tribox.slabs().collect::<Vec<_>>());
    slabs.flat_map(|(d, (low, high))| [(d, f64::from(high)), (d.map(|x| -x), -f64::from(low))])
}

fn built(triangles: &Triangles, options: &TriboxOptions) -> (Vec<u8>, TriboxReport) {
    let mesh = mesh(triangles);
    let (tables, report) =
        tribox::build(mesh.as_input(), options, Watch::NONE).expect("in the domain");
    (tables.to_bytes(), report)
}

/// Of a convex solid the part in a tribox is convex, and so its own hull.
#[test]
fn no_tribox_of_a_ball_reaches_farther_than_asked_beyond_its_part() {
    for scale in [1.0, 1e-20] {
        let ball = scaled(&icosphere(1), scale);
        let (planes, scale) = (of_mesh(&ball), f64::from(scale));
        let mut counts = Vec::new();
        for asked in [0.4, 0.2, 0.1].map(|x| x * scale) {
            let options = TriboxOptions::new(4096).with_error(Some(asked));
            let (bytes, report) = built(&ball, &options);
            let triboxes = Triboxes::open(&bytes).expect("opens");
            assert!(report.reached.is_some_and(|reached| reached <= asked), "{report:?}");
            let mut most = 0f64;
            for (node, tribox) in triboxes.leaves() {
                let part: Vec<HalfSpace> =
                    planes.iter().copied().chain(of_tribox(&tribox)).collect();
                let error = f64::from(triboxes.error(node).expect("a node"));
                assert!(error <= asked, "{error} of {asked}");
                for vertex in tribox.boundary().vertices {
                    let far = distance(vertex.map(f64::from), &part);
                    most = most.max(far);
                    // The projections end near the part, not in it.
                    assert!(far <= error + 1e-3 * scale, "{far} {error} at node {node}");
                }
            }
            assert!(most > 0.2 * asked, "{most} of {asked}: more splits than it takes");
            counts.push(triboxes.leaf_count());
        }
        assert!(counts.is_sorted() && counts[1] > 1 && counts[2] < 1000, "{counts:?}");
    }
}

#[test]
fn what_is_near_enough_is_not_split_and_what_cannot_be_is_said() {
    let torus = torus(2.0, 0.75, 16, 8);
    let (bytes, report) = built(&torus, &TriboxOptions::new(64).with_error(Some(100.0)));
    assert_eq!(Triboxes::open(&bytes).expect("opens").leaf_count(), 1);
    assert!(report.reached.is_some_and(|reached| reached < 100.0));
    // Fewer than it takes.
    let options = TriboxOptions::new(5).with_error(Some(1e-3));
    let (bytes, report) = built(&torus, &options);
    assert_eq!(Triboxes::open(&bytes).expect("opens").leaf_count(), 5);
    assert!(report.reached.is_some_and(|reached| reached > 1e-3));
}

/// Splits of the greatest error come first, so the error falls with as few triboxes as by gain.
#[test]
fn errors_are_less_than_where_the_greatest_gain_is_split_first() {
    let torus = torus(2.0, 0.75, 24, 12);
    let reached = |options: &TriboxOptions| {
        let (bytes, report) = built(&torus, options);
        let count = Triboxes::open(&bytes).expect("opens").leaf_count();
        (count, report.reached.expect("triboxes"))
    };
    let (count, by_error) = reached(&TriboxOptions::new(48).with_error(Some(1e-6)));
    let (others, by_gain) = reached(&TriboxOptions::new(48));
    assert_eq!((count, others), (48, 48));
    assert!(by_error < by_gain, "{by_error} {by_gain}");
}
