//! Triangles against triangle fans: distances, segments and culling (paper 003, Tables 1 and 2,
//! and 6.4).
//!
//! The paper gives times. Multiplications of the kernels are exact: three an inner product, six a
//! cross product. Those of boxes and divisions are not counted.

use glam::{DVec3, Vec3};
use meshsweep_host_tests::workload::{Points, Subject, field, points, segments};
use meshsweep_xtask::table::{Cell, Table, fixed, row};

use super::dop::Slabs;
use super::fans::decompose;
use super::hierarchy::Hierarchy;
use crate::measure::stopwatch::Stopwatch;

/// Nodes of the distance field along an axis: the paper's.
const SIDE: usize = 64;

/// Segments.
const SEGMENTS: usize = 10_000;

/// Eyes.
const EYES: usize = 1_000;

/// Seconds of the paper's two tables for triangles and for fans, by models that can be had.
const PAPER: [(&str, [[f64; 2]; 2]); 2] = [
    ("horse", [[25.47, 17.67], [69.51, 40.42]]),
    ("stanford-bunny", [[34.70, 25.75], [42.26, 24.41]]),
];

/// The elements of a tree: a centre and the rim in order. A triangle is a fan of one.
pub(super) fn elements(subject: &Subject, of_fans: bool) -> Vec<Vec<DVec3>> {
    let mesh = &subject.mesh;
    let at = |v: u32| Vec3::from_array(mesh.positions[v as usize]).as_dvec3();
    if of_fans {
        let fans = decompose(&mesh.triangles, mesh.positions.len());
        fans.iter().map(|fan| fan.iter().map(|&v| at(v)).collect()).collect()
    } else {
        mesh.triangles.iter().map(|triangle| triangle.map(at).to_vec()).collect()
    }
}

/// Elements of a tree, elements a leaf, and their name.
const TREES: [(bool, usize, &str); 3] =
    [(false, 1, "triangles"), (false, 5, "triangles, 5 a leaf"), (true, 1, "fans")];

/// What a kernel did.
#[derive(Clone, Copy, Default)]
struct Work {
    triangles: u64,
    /// Triangles that the fan's test spared.
    spared: u64,
    multiplications: u64,
    /// Multiplications for lengths of edges and for normals, and subtractions for edges: what a fan
    /// that stores them spares.
    lengths: u64,
    normals: u64,
    edges: u64,
}

/// A table of the trees over triangles and fans. `ask` answers one question.
fn table<Q: Copy>(
    subject: &Subject,
    [key, title]: [&'static str; 2],
    questions: &[Q],
    paper: usize,
    ask: impl Fn(&Hierarchy<'_>, &[Vec<DVec3>], bool, Q, &mut Work) -> (f64, u64),
) -> Result<Table, String> {
    let columns = [
        "elements",
        "count",
        "boxes",
        "triangles",
        "spared",
        "multiplications",
        "of triangles'",
        "us",
        "of triangles'",
        "paper s",
        "paper, of triangles'",
    ];
    let mut table = Table::new(key, title, &columns);
    let all = Slabs::all();
    let slabs = all.first().ok_or("no slabs")?;
    let theirs = PAPER.iter().find(|(name, _)| *name == subject.name).map(|(_, of)| of[paper]);
    let mean = |sum: u64, digits| fixed(sum as f64 / questions.len() as f64, digits);
    let (mut expected, mut first): (Option<Vec<f64>>, Option<(u64, f64)>) = (None, None);
    for (of_fans, leaf, name) in TREES {
        let elements = elements(subject, of_fans);
        let tree = Hierarchy::new(slabs, &elements, leaf);
        let (mut work, mut boxes) = (Work::default(), 0);
        let mut answers = Vec::with_capacity(questions.len());
        let begun = Stopwatch::start();
        for &question in questions {
            let (answer, tested) = ask(&tree, &elements, of_fans, question, &mut work);
            answers.push(answer);
            boxes += tested;
        }
        let seconds = begun.seconds();
        let differ = |(a, b): (&f64, &f64)| a != b && (a - b).abs() > 1e-6 * (1.0 + a.abs());
        let expected = expected.get_or_insert_with(|| answers.clone());
        let others = expected.iter().zip(&answers).filter(|pair| differ(*pair)).count();
        // A segment that grazes an edge may pass in one of the kernels.
        if others * 1_000 > answers.len() {
            return Err(format!("{name}: {others} answers are not those of triangles"));
        }
        let (products, time) = *first.get_or_insert((work.multiplications, seconds));
        let paper_s = theirs.filter(|_| leaf == 1 || paper == 1).map(|s| s[usize::from(of_fans)]);
        // Table 2 of the paper is about 5 triangles a leaf, Table 1 about one.
        let paper_s = paper_s.filter(|_| of_fans || (leaf == 5) == (paper == 1));
        table.push(row![
            name,
            elements.len(),
            mean(boxes, 1),
            mean(work.triangles, 1),
            mean(work.spared, 1),
            mean(work.multiplications, 0),
            fixed(work.multiplications as f64 / products as f64, 2),
            fixed(seconds * 1e6 / questions.len() as f64, 2),
            fixed(seconds / time, 2),
            paper_s.map_or(Cell::Empty, |s| fixed(s, 2)),
            paper_s.zip(theirs).map_or(Cell::Empty, |(s, [triangles, _])| fixed(s / triangles, 2)),
        ]);
    }
    table.note(
        "a question, mean; one binary tree of boxes over triangles, or over fans of up to 8, \
         f64; spared: by the fan's test of two inner products",
    );
    Ok(table)
}

/// Table 1: the distance field.
///
/// # Errors
/// Fans give other distances.
pub fn distances(subject: &Subject) -> Result<Table, String> {
    let title = "Distance field, 64^3, by triangles and fans, beside paper 003, Table 1";
    table(
        subject,
        ["fan_distances", title],
        &field(subject, SIDE),
        0,
        |tree, fans, rejects, p, w| {
            let p = Vec3::from_array(p).as_dvec3();
            let mut found = f64::INFINITY;
            let boxes = tree.nearest(p, |e, least| {
                *least = least.min(distance_sq(p, &fans[e as usize], rejects, w));
                found = *least;
            });
            (found.sqrt(), boxes)
        },
    )
}

/// Table 2: first hits of segments.
///
/// # Errors
/// Fans give other hits.
pub fn hits(subject: &Subject) -> Result<Table, String> {
    let title = "First hits by triangles and fans, beside paper 003, Table 2";
    let segments = segments(subject, SEGMENTS);
    table(subject, ["fan_hits", title], &segments, 1, |tree, fans, of_fans, ends, work| {
        let [a, b] = ends.map(|end| Vec3::from_array(end).as_dvec3());
        let mut first = f64::INFINITY;
        let boxes = tree.crossed([a, b], |e| {
            let fan = &fans[e as usize];
            let t = if of_fans { hit(a, b - a, fan, work) } else { alone(a, b - a, fan, work) };
            first = first.min(t);
        });
        (first, boxes)
    })
}

/// Squared distance to a fan (the paper's 4). Terms of the centre and of an edge are shared. A
/// triangle is skipped if both of its edges lead away from the point.
fn distance_sq(p: DVec3, fan: &[DVec3], rejects: bool, work: &mut Work) -> f64 {
    let [centre, rim @ ..] = fan else { return f64::INFINITY };
    let s = p - *centre;
    let ss = s.length_squared();
    work.multiplications += 3;
    let mut least = ss;
    let mut before: Option<(DVec3, f64, Option<f64>)> = None;
    for vertex in rim {
        let b = *vertex - *centre;
        let xb = s.dot(b);
        work.multiplications += 3;
        work.edges += 3;
        let mut rb = None;
        if let Some((a, xa, ra)) = before {
            work.triangles += 1;
            if rejects && xa <= 0.0 && xb <= 0.0 {
                work.spared += 1;
            } else {
                work.multiplications += if ra.is_some() { 6 } else { 9 };
                work.lengths += if ra.is_some() { 3 } else { 6 };
                let (aa, bb) = (ra.unwrap_or_else(|| a.length_squared()), b.length_squared());
                least = least.min(quadratic(aa, a.dot(b), bb, xa, xb, ss));
                rb = Some(bb);
            }
        }
        before = Some((b, xb, rb));
    }
    least
}

/// The least of `|u a + v b − s|²` over a triangle, by inner products.
fn quadratic(aa: f64, ab: f64, bb: f64, xa: f64, xb: f64, ss: f64) -> f64 {
    let at = |u: f64, v: f64| {
        let value = u * (u * aa + 2.0 * (v * ab - xa)) + v * (v * bb - 2.0 * xb) + ss;
        // Not by `max`, which takes no number for 0.
        if value < 0.0 { 0.0 } else { value }
    };
    let determinant = aa * bb - ab * ab;
    let (u, v) = ((xa * bb - xb * ab) / determinant, (xb * aa - xa * ab) / determinant);
    if u >= 0.0 && v >= 0.0 && u + v <= 1.0 {
        return at(u, v);
    }
    // An edge without length gives NaN, which `min` passes over.
    let t = ((xb - xa - ab + aa) / (aa + bb - 2.0 * ab)).clamp(0.0, 1.0);
    let edge_a = at((xa / aa).clamp(0.0, 1.0), 0.0);
    edge_a.min(at(0.0, (xb / bb).clamp(0.0, 1.0))).min(at(1.0 - t, t))
}

/// Parameter of a segment's first hit of a fan (the paper's 3), else infinity. A triangle is
/// skipped if both of its rim's ends are on one side of the plane through centre and segment.
fn hit(from: DVec3, d: DVec3, fan: &[DVec3], work: &mut Work) -> f64 {
    let [centre, rim @ ..] = fan else { return f64::INFINITY };
    let s = from - *centre;
    let n = s.cross(d);
    work.multiplications += 6;
    let mut first = f64::INFINITY;
    let mut before: Option<(DVec3, f64)> = None;
    for vertex in rim {
        let b = *vertex - *centre;
        let xb = n.dot(b);
        work.multiplications += 3;
        work.edges += 3;
        if let Some((a, xa)) = before {
            work.triangles += 1;
            if (xa < 0.0 && xb < 0.0) || (xa > 0.0 && xb > 0.0) {
                work.spared += 1;
            } else {
                let normal = a.cross(b);
                let determinant = normal.dot(d);
                let (u, v) = (-xb / determinant, xa / determinant);
                work.multiplications += 9;
                work.normals += 6;
                if u >= 0.0 && v >= 0.0 && u + v <= 1.0 {
                    work.multiplications += 3;
                    let t = -normal.dot(s) / determinant;
                    first = if (0.0..=1.0).contains(&t) { first.min(t) } else { first };
                }
            }
        }
        before = Some((b, xb));
    }
    first
}

/// The same of a triangle alone (Möller & Trumbore 1997), which the paper compares with.
fn alone(from: DVec3, d: DVec3, triangle: &[DVec3], work: &mut Work) -> f64 {
    let &[a, b, c] = triangle else { return f64::INFINITY };
    let (ab, ac) = (b - a, c - a);
    work.triangles += 1;
    let p = d.cross(ac);
    let determinant = ab.dot(p);
    let s = from - a;
    let u = s.dot(p) / determinant;
    work.multiplications += 12;
    if !(0.0..=1.0).contains(&u) {
        return f64::INFINITY;
    }
    let q = s.cross(ab);
    let v = d.dot(q) / determinant;
    work.multiplications += 9;
    if v < 0.0 || u + v > 1.0 {
        return f64::INFINITY;
    }
    work.multiplications += 3;
    let t = ac.dot(q) / determinant;
    if (0.0..=1.0).contains(&t) { t } else { f64::INFINITY }
}

/// The paper's trade of memory for time (3.3, 4.3): bytes of fans that store edges, their lengths
/// and normals, against the operations of a fan that is asked.
///
/// # Errors
/// There are no fans.
pub fn stored(subject: &Subject) -> Result<Table, String> {
    let columns = [
        "stored",
        "bytes a triangle",
        "distance: multiplications",
        "subtractions",
        "segment: multiplications",
        "subtractions",
    ];
    let title = "What fans may store, paper 003, 3.3 and 4.3: a fan asked, mean";
    let mut table = Table::new("fan_storage", title, &columns);
    let all = Slabs::all();
    let slabs = all.first().ok_or("no slabs")?;
    let fans = elements(subject, true);
    let tree = Hierarchy::new(slabs, &fans, 1);
    let mut work = [Work::default(); 2];
    let mut asked = [0u64; 2];
    for p in points(subject, Points::Near, SEGMENTS) {
        let p = Vec3::from_array(p).as_dvec3();
        tree.nearest(p, |e, least| {
            asked[0] += 1;
            *least = least.min(distance_sq(p, &fans[e as usize], true, &mut work[0]));
        });
    }
    for ends in segments(subject, SEGMENTS) {
        let [a, b] = ends.map(|end| Vec3::from_array(end).as_dvec3());
        tree.crossed([a, b], |e| {
            asked[1] += 1;
            std::hint::black_box(hit(a, b - a, &fans[e as usize], &mut work[1]));
        });
    }
    let (count, triangles) = (fans.len() as f64, subject.mesh.triangles.len() as f64);
    // Of a fan: its centre, and one vertex more than triangles on the rim.
    let rim = triangles + count;
    let vertices = 12.0 * (rim + count);
    let rows = [
        ("vertices", vertices, [false; 3]),
        ("edges", vertices, [true, false, false]),
        ("edges, lengths", vertices + 4.0 * rim, [true, true, false]),
        ("edges, lengths, normals", vertices + 4.0 * rim + 12.0 * triangles, [true; 3]),
    ];
    for (name, bytes, [edges, lengths, normals]) in rows {
        let mean = |kind: usize, sum: u64| fixed(sum as f64 / asked[kind].max(1) as f64, 1);
        let spared = |is_stored: bool, of: u64| if is_stored { of } else { 0 };
        let products = |kind: usize| {
            let of = work[kind];
            mean(
                kind,
                of.multiplications - spared(lengths, of.lengths) - spared(normals, of.normals),
            )
        };
        let differences = |kind: usize| {
            let of = work[kind];
            mean(kind, 3 * asked[kind] + of.edges - spared(edges, of.edges))
        };
        table.push(row![
            name,
            fixed(bytes / triangles, 1),
            products(0),
            differences(0),
            products(1),
            differences(1),
        ]);
    }
    table.note(format!(
        "{SEGMENTS} points near the surface and as many segments; numbers of f32; the box tree \
         stores 6 bytes a vertex, on a grid, and shares it"
    ));
    Ok(table)
}

/// What the cones of fans save of backface culling (6.4). The paper's test has the wrong sign: a
/// fan with normals within `α` of an axis faces away if the axis and the way to the eye meet at a
/// cosine of at most `−sin α`. All planes of a fan go through its centre, so nothing else counts.
pub fn culling(subject: &Subject) -> Table {
    let columns = ["triangles", "facing away %", "culled with their fan %", "tests a triangle"];
    let mut table = Table::new("fan_culling", "Backface culling by fans, paper 003, 6.4", &columns);
    let (mut away, mut culled, mut tests) = (0u64, 0u64, 0u64);
    let fans: Vec<(DVec3, Vec<DVec3>, DVec3, f64)> = elements(subject, true)
        .iter()
        .map(|fan| {
            let edges: Vec<DVec3> = fan[1..].iter().map(|v| *v - fan[0]).collect();
            let normals = edges.windows(2).map(|ab| ab[0].cross(ab[1]).normalize_or_zero());
            let normals: Vec<DVec3> = normals.collect();
            let axis = normals.iter().sum::<DVec3>().normalize_or_zero();
            let cosine = normals.iter().map(|n| n.dot(axis)).fold(1.0, f64::min);
            (fan[0], normals, axis, cosine)
        })
        .collect();
    for eye in points(subject, Points::Far, EYES) {
        let eye = Vec3::from_array(eye).as_dvec3();
        for (centre, normals, axis, cosine) in &fans {
            let way = (eye - *centre).normalize_or_zero();
            let facing_away = normals.iter().filter(|n| n.dot(way) <= 0.0).count() as u64;
            away += facing_away;
            let sine = (1.0 - cosine * cosine).max(0.0).sqrt();
            if *cosine > 0.0 && axis.dot(way) <= -sine {
                culled += facing_away;
                tests += 1;
            } else {
                tests += 1 + normals.len() as u64;
            }
        }
    }
    let all = subject.mesh.triangles.len();
    let asked = (all * EYES) as f64;
    table.push(row![
        all,
        fixed(100.0 * away as f64 / asked, 1),
        fixed(100.0 * culled as f64 / away.max(1) as f64, 1),
        fixed(tests as f64 / asked, 3),
    ]);
    table.note(format!(
        "{EYES} eyes in the doubled box; tests: one a fan, and one a triangle of the fans that \
         are left; a triangle alone takes 1"
    ));
    table.note("the paper: 30 % less time to draw");
    table
}

#[cfg(test)]
mod tests {
    use super::{Work, alone, distance_sq, elements, hit};
    use crate::measure::brute::Brute;
    use crate::measure::paper::dop::Slabs;
    use crate::measure::paper::hierarchy::Hierarchy;
    use glam::Vec3;
    use meshsweep::mesh::Mesh;
    use meshsweep_host_tests::generate::rough_sphere;
    use meshsweep_host_tests::workload::{Points, Subject, points, segments};

    #[test]
    fn fans_and_triangles_in_a_tree_answer_like_brute_force() {
        let (positions, triangles) = rough_sphere(3, 0.3, 2005);
        let subject = Subject::of("rough sphere", Mesh::new(positions, triangles));
        let brute = Brute::new(&subject);
        let slabs = Slabs::all();
        for (of_fans, leaf) in [(false, 1), (false, 5), (true, 1)] {
            let elements = elements(&subject, of_fans);
            let tree = Hierarchy::new(&slabs[0], &elements, leaf);
            let mut work = Work::default();
            for point in points(&subject, Points::Near, 100) {
                let p = Vec3::from_array(point).as_dvec3();
                let mut found = f64::INFINITY;
                tree.nearest(p, |e, least| {
                    let fan = &elements[e as usize];
                    *least = least.min(distance_sq(p, fan, of_fans, &mut work));
                    found = *least;
                });
                assert!((found.sqrt() - brute.distance(point)).abs() < 1e-7, "{point:?}");
            }
            for ends in segments(&subject, 200) {
                let [a, b] = ends.map(|end| Vec3::from_array(end).as_dvec3());
                let mut first = f64::INFINITY;
                tree.crossed([a, b], |e| {
                    let fan = &elements[e as usize];
                    let of = if of_fans { hit } else { alone };
                    first = first.min(of(a, b - a, fan, &mut work));
                });
                let (expected, is_clear) = brute.first_hit(ends);
                let expected = expected.unwrap_or(f64::INFINITY);
                assert!(!is_clear || first == expected || (first - expected).abs() < 1e-9);
            }
            assert_eq!(work.spared > 0, of_fans);
        }
    }
}
