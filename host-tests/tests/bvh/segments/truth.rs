//! What is so, by exact predicates, and what the tree says of it.

use meshsweep_core::{
    Budget, Bvh, Ended, Facing, FirstHit, ScratchEntry, TriangleHit, Undecided, Verdict,
};
use meshsweep_host_tests::oracle::contacts;
use meshsweep_host_tests::scene::Scene;
use robust::{Coord, Coord3D, orient2d, orient3d};

type Point = [f32; 3];

/// An input triangle that the closed segment meets.
#[derive(Clone, Copy, Debug)]
pub struct Met {
    pub triangle: u32,
    pub t_lower: f64,
    pub t_upper: f64,
    /// Whether its front is seen; `None` in the triangle's plane, and of triangles without area.
    pub front: Option<bool>,
}

fn coord([x, y, z]: Point) -> Coord3D<f64> {
    Coord3D { x: f64::from(x), y: f64::from(y), z: f64::from(z) }
}

fn flat(p: Point, drop: usize) -> Coord<f64> {
    Coord { x: f64::from(p[(drop + 1) % 3]), y: f64::from(p[(drop + 2) % 3]) }
}

fn turn(drop: usize, p: Point, q: Point, r: Point) -> f64 {
    orient2d(flat(p, drop), flat(q, drop), flat(r, drop))
}

fn collinear(p: Point, q: Point, r: Point) -> bool {
    (0..3).all(|drop| turn(drop, p, q, r) == 0.0)
}

/// Whether the closed boxes of two segments overlap: on one line they meet then.
fn overlap([a, b]: [Point; 2], [p, q]: [Point; 2]) -> bool {
    (0..3).all(|k| a[k].min(b[k]) <= p[k].max(q[k]) && p[k].min(q[k]) <= a[k].max(b[k]))
}

/// Whether two closed segments have a common point. Exact; either may be a point.
fn meet([a, b]: [Point; 2], [p, q]: [Point; 2]) -> bool {
    if orient3d(coord(a), coord(b), coord(p), coord(q)) != 0.0 {
        return false;
    }
    let triples = [[a, b, p], [a, b, q], [p, q, a], [p, q, b]];
    let plane = (0..3).find(|&drop| triples.iter().any(|&[x, y, z]| turn(drop, x, y, z) != 0.0));
    let Some(drop) = plane else { return overlap([a, b], [p, q]) };
    let apart = |x: f64, y: f64| (x > 0.0 && y > 0.0) || (x < 0.0 && y < 0.0);
    !apart(turn(drop, a, b, p), turn(drop, a, b, q))
        && !apart(turn(drop, p, q, a), turn(drop, p, q, b))
        && overlap([a, b], [p, q])
}

/// All input triangles that the closed segment meets, those without area as the segments or points
/// that they are.
pub fn truth(scene: &Scene, a: Point, b: Point) -> Vec<Met> {
    let mut met: Vec<Met> = Vec::new();
    let is_thin = |&[u, v, w]: &[Point; 3]| collinear(u, v, w);
    let all: Vec<[Point; 3]> =
        (0..scene.triangles.len()).map(|t| scene.corners(t as u32)).collect();
    for contact in contacts(a, b, &scene.positions, &scene.triangles) {
        let corners = all[contact.triangle as usize];
        if is_thin(&corners) {
            continue;
        }
        let [u, v, w] = corners.map(coord);
        // Negative where corners run counter-clockwise as seen from there.
        let (from, to) = (orient3d(u, v, w, coord(a)), orient3d(u, v, w, coord(b)));
        let front = if from == 0.0 && to == 0.0 { None } else { Some(from < 0.0 || to > 0.0) };
        met.push(Met {
            triangle: contact.triangle,
            t_lower: contact.t_lower,
            t_upper: contact.t_upper,
            front,
        });
    }
    for (triangle, corners) in (0u32..).zip(&all) {
        let [u, v, w] = *corners;
        if is_thin(corners) && [[u, v], [v, w], [w, u]].iter().any(|&side| meet([a, b], side)) {
            met.push(Met { triangle, t_lower: 0.0, t_upper: 1.0, front: None });
        }
    }
    met
}

pub const FACINGS: [Facing; 3] = [Facing::Both, Facing::Front, Facing::Back];

pub fn of_facing(truth: &[Met], facing: Facing) -> Vec<Met> {
    let wanted = |met: &&Met| match facing {
        Facing::Both => true,
        Facing::Front => met.front == Some(true),
        Facing::Back => met.front == Some(false),
        other => panic!("{other:?}"),
    };
    truth.iter().filter(wanted).copied().collect()
}

/// How often a question was decided.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tally {
    pub hits: usize,
    pub clear: usize,
    pub open: usize,
}

pub struct Asker {
    stack: Vec<ScratchEntry>,
    hits: Vec<TriangleHit>,
    few: Vec<TriangleHit>,
}

impl Asker {
    pub fn new() -> Self {
        let none = TriangleHit::EMPTY;
        Asker { stack: vec![ScratchEntry::EMPTY; 4096], hits: vec![none; 1024], few: vec![none; 3] }
    }

    /// Asks both trees of a scene everything about a segment, and compares with what is so. Counts
    /// the first hits of both facings.
    pub fn prove(&mut self, scene: &Scene, a: Point, b: Point) -> [Tally; 2] {
        let truth = truth(scene, a, b);
        let mut tallies = [Tally::default(); 2];
        for (tree, tally) in scene.trees().iter().zip(&mut tallies) {
            for facing in FACINGS {
                let wanted = of_facing(&truth, facing);
                let at = || {
                    let single = tree.header().is_f32();
                    format!("{}, f32 {single}, {facing:?}, {a:?} {b:?}, met {wanted:?}", scene.name)
                };
                let hit = self.prove_first(tree, [a, b], facing, &wanted, &at);
                self.prove_all((scene, tree), [a, b], facing, &wanted, &at);
                if facing == Facing::Both {
                    tally.hits += usize::from(!hit.is_clear() && hit.ended == Ended::Exact);
                    tally.clear += usize::from(hit.is_clear());
                    tally.open += usize::from(hit.ended != Ended::Exact);
                }
            }
        }
        tallies
    }

    fn prove_first(
        &mut self,
        tree: &Bvh<'_>,
        [a, b]: [Point; 2],
        facing: Facing,
        wanted: &[Met],
        at: &dyn Fn() -> String,
    ) -> FirstHit {
        let hit = tree.first_hit(a, b, facing, Budget::EXACT, &mut self.stack).expect("answers");
        check_first(&hit, wanted, at);
        assert_ne!(hit.ended, Ended::Scratch, "{}", at());
        let any = tree.any_hit(a, b, facing, Budget::EXACT, &mut self.stack).expect("answers");
        let same = match (hit.is_clear(), hit.ended) {
            (true, _) => Verdict::No,
            (_, Ended::Exact) => Verdict::Yes,
            _ => Verdict::Undecided(Undecided::Resolution),
        };
        assert_eq!(any.verdict, same, "{}: {hit:?}", at());
        for entries in [1, 2, 5, 9] {
            let short = tree
                .first_hit(a, b, facing, Budget::EXACT, &mut self.stack[..entries])
                .expect("answers");
            check_first(&short, wanted, at);
            if short.ended != Ended::Scratch {
                let same = (short.t.lower, short.t.upper, short.hit, short.ended);
                assert_eq!(
                    same,
                    (hit.t.lower, hit.t.upper, hit.hit, hit.ended),
                    "{entries} entries, {}",
                    at()
                );
            }
            let any = tree
                .any_hit(a, b, facing, Budget::EXACT, &mut self.stack[..entries])
                .expect("answers");
            let right = match any.verdict {
                Verdict::Yes => !wanted.is_empty(),
                Verdict::No => wanted.is_empty(),
                _ => true,
            };
            assert!(right, "{entries} entries, {any:?}, {}", at());
        }
        hit
    }

    fn prove_all(
        &mut self,
        (scene, tree): (&Scene, &Bvh<'_>),
        [a, b]: [Point; 2],
        facing: Facing,
        wanted: &[Met],
        at: &dyn Fn() -> String,
    ) {
        let all = tree
            .all_hits(a, b, facing, &mut self.hits, Budget::EXACT, &mut self.stack)
            .expect("answers");
        assert_eq!(all.dropped, 0, "{}", at());
        let hits = &self.hits[..all.stored];
        assert!(hits.is_sorted_by_key(|x| (x.hit.t, x.hit.triangle)), "{}: {hits:?}", at());
        let number = |listed: &TriangleHit| listed.hit.triangle.expect("numbered");
        let mut found: Vec<u32> = hits.iter().map(number).collect();
        found.sort_unstable();
        let mut expected: Vec<u32> = wanted.iter().map(|met| met.triangle).collect();
        expected.sort_unstable();
        if all.ended == Ended::Exact {
            assert_eq!(found, expected, "{}", at());
        }
        let lacks = expected.iter().any(|triangle| found.binary_search(triangle).is_err());
        assert!(!(lacks && all.is_complete), "{}: {hits:?}", at());
        let is_expected = |triangle: u32| expected.binary_search(&triangle).is_ok();
        let certain: Vec<u32> = hits.iter().filter(|hit| hit.is_certain).map(number).collect();
        assert!(certain.len() <= expected.len(), "{}: {hits:?}", at());
        for &triangle in certain.iter().filter(|&&triangle| !is_expected(triangle)) {
            // Proved is then that a triangle beside it in the fan is met.
            let of = scene.corners(triangle);
            let is_beside = |&other: &u32| scene.corners(other).iter().any(|v| of.contains(v));
            let mut others = expected.iter().filter(|other| !certain.contains(other));
            assert!(others.any(is_beside), "{triangle}, {}: {hits:?}", at());
        }
        let is_proved = all.is_complete && certain.len() == hits.len();
        assert!(is_proved || all.ended != Ended::Exact, "{}: {hits:?}", at());
        for room in 0..=3 {
            let few = tree
                .all_hits(a, b, facing, &mut self.few[..room], Budget::EXACT, &mut self.stack)
                .expect("answers");
            assert_eq!(few.stored + few.dropped as usize, all.stored, "{}", at());
            assert_eq!(few.stored, room.min(all.stored), "{}", at());
            assert_eq!(self.few[..few.stored], hits[..few.stored], "{}", at());
            assert_eq!((few.ended, few.is_complete), (all.ended, all.is_complete), "{}", at());
        }
        let short = tree
            .all_hits(a, b, facing, &mut self.hits, Budget::EXACT, &mut self.stack[..1])
            .expect("answers");
        if short.ended == Ended::Exact {
            assert_eq!(all.ended, Ended::Exact, "{}", at());
            assert_eq!(short.stored, all.stored, "{}", at());
        }
    }
}

/// Checks every claim of an answer, with any scratch memory.
fn check_first(hit: &FirstHit, wanted: &[Met], at: &dyn Fn() -> String) {
    let least = |f: fn(&Met) -> f64| wanted.iter().map(f).fold(f64::INFINITY, f64::min);
    let (low, high) = (least(|met| met.t_lower), least(|met| met.t_upper));
    assert!(f64::from(hit.t.lower) <= high, "met earlier, {}: {hit:?}", at());
    assert!(hit.t.lower <= hit.t.upper, "{}: {hit:?}", at());
    if hit.ended == Ended::Exact && !hit.is_clear() {
        assert!(!wanted.is_empty(), "no hit, {}: {hit:?}", at());
        assert!(f64::from(hit.t.upper) >= low, "met later, {}: {hit:?}", at());
        assert!(hit.hit.is_some(), "{}: {hit:?}", at());
    }
}
