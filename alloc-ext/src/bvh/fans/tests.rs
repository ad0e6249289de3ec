//! Soups of every kind, packed.

use super::cells::cells;
use super::{Effort, Fan, FanLeaf, LeafBytes, MAX_LEAF_TRIANGLES, Packed, Packing, pack};
use crate::progress::Watch;
use crate::random::SplitMix;
use glam::DVec3;

/// One cell.
const WHOLE: Packing = Packing::Cells(usize::MAX);

/// Cells of the least cost, for a blob of closest points on a grid.
fn cheapest(largest: usize, weight_of_bytes: f64) -> Packing {
    let bytes = LeafBytes { node: 96, coordinate: 2 };
    Packing::Cheapest { largest, weight_of_bytes, bytes }
}

struct Soup {
    triangles: Vec<[u32; 3]>,
    positions: Vec<DVec3>,
}

impl Soup {
    /// Vertices on a curve that repeats no coordinate.
    fn new(triangles: Vec<[u32; 3]>) -> Self {
        let count = triangles.as_flattened().iter().max().map_or(0, |v| v + 1);
        let at = |v: f64| DVec3::new((v * 1.3).sin(), (v * 0.7).cos(), v * 0.01);
        Self { triangles, positions: (0..count).map(f64::from).map(at).collect() }
    }

    /// A torus of `2 · around · along` triangles, all vertices of valence 6.
    fn torus(around: u32, along: u32) -> Self {
        let at = |i: u32, j: u32| (i % around) * along + j % along;
        let mut triangles = Vec::new();
        let mut positions = Vec::new();
        for i in 0..around {
            for j in 0..along {
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                triangles.extend([[a, b, c], [a, c, d]]);
                let (s, t) = (turn(i, around), turn(j, along));
                let radius = 3.0 + t.cos();
                positions.push(DVec3::new(radius * s.cos(), radius * s.sin(), t.sin()));
            }
        }
        Self { triangles, positions }
    }

    /// A flat sheet whose diagonals run at random, so that valences differ.
    fn sheet(size: u32, random: &mut SplitMix) -> Self {
        let at = |i: u32, j: u32| i * (size + 1) + j;
        let mut triangles = Vec::new();
        for i in 0..size {
            for j in 0..size {
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                let halves = [[[a, b, c], [a, c, d]], [[a, b, d], [b, c, d]]];
                triangles.extend(halves[below(random, 2) as usize]);
            }
        }
        let positions = (0..=size)
            .flat_map(|i| (0..=size).map(move |j| DVec3::new(f64::from(i), f64::from(j), 0.0)))
            .collect();
        Self { triangles, positions }
    }

    /// A closed fan of `valence` triangles about vertex 0.
    fn cone(valence: u32) -> Self {
        Self::new((0..valence).map(|i| [0, 1 + i, 1 + (i + 1) % valence]).collect())
    }

    /// Leaves of one cell, checked; the same twice. Those of a quick packing and of small cells are
    /// checked too.
    fn pack(&self) -> Vec<FanLeaf> {
        self.pack_with(WHOLE, Effort::QUICK);
        self.pack_with(Packing::Cells(20), Effort::FULL);
        self.pack_with(cheapest(100, 1.0), Effort::FULL);
        self.pack_with(WHOLE, Effort::FULL).leaves
    }

    fn pack_with(&self, packing: Packing, effort: Effort) -> Packed {
        let pack = || pack(&self.triangles, &self.positions, packing, effort, Watch::NONE).unwrap();
        let packed = pack();
        let leaves = &packed.leaves;
        let mut found = vec![0; self.triangles.len()];
        for leaf in leaves {
            demand_form(leaf);
            for fan in leaf.fans() {
                for (i, &t) in fan.triangles.iter().enumerate() {
                    let [a, b, c] = self.triangles[t as usize];
                    let (from, to) = (fan.ring[i], fan.ring[i + 1]);
                    let [from, to] = if fan.reversed { [to, from] } else { [from, to] };
                    let in_fan = [fan.centre, from, to];
                    assert!([[a, b, c], [b, c, a], [c, a, b]].contains(&in_fan), "{leaf:?}");
                    found[t as usize] += 1;
                }
            }
        }
        assert!(found.iter().all(|&count| count == 1), "every triangle is in one fan");
        assert_eq!(*leaves, pack().leaves);
        packed
    }

    /// Triangles a leaf.
    fn fill(&self) -> f64 {
        self.triangles.len() as f64 / self.pack().len() as f64
    }

    fn half_areas<'a>(&self, parts: impl Iterator<Item = &'a [u32]>) -> f64 {
        parts
            .map(|part| {
                let corners = || {
                    part.iter()
                        .flat_map(|&t| self.triangles[t as usize])
                        .map(|v| self.positions[v as usize])
                };
                let size =
                    corners().reduce(DVec3::max).unwrap() - corners().reduce(DVec3::min).unwrap();
                size.x * size.y + size.y * size.z + size.z * size.x
            })
            .sum()
    }
}

fn turn(i: u32, of: u32) -> f64 {
    f64::from(i) / f64::from(of) * std::f64::consts::TAU
}

/// The invariants of [`Fan`] and [`FanLeaf`].
fn demand_form(leaf: &FanLeaf) {
    assert!((1..=MAX_LEAF_TRIANGLES).contains(&leaf.triangle_count()) && !leaf.first.reversed);
    for fan in leaf.fans() {
        assert!(!fan.triangles.is_empty() && fan.ring.len() == fan.triangles.len() + 1, "{fan:?}");
    }
    let joins = |second: &Fan| second.ring.first() == leaf.first.ring.last();
    assert!(leaf.second.as_ref().is_none_or(joins), "{leaf:?}");
}

/// A number below `limit`.
fn below(random: &mut SplitMix, limit: u32) -> u32 {
    (random.roll() * f64::from(limit)) as u32
}

#[test]
fn small_soups_are_packed_into_as_few_leaves_and_vertices_as_can_be() {
    for (triangles, leaves, vertices) in [
        (vec![], 0, 0),
        (vec![[0, 1, 2]], 1, 3),
        // A tetrahedron.
        (vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]], 1, 7),
        // A strip: no vertex has more than 3 triangles.
        (vec![[0, 1, 2], [2, 1, 3], [2, 3, 4], [4, 3, 5]], 1, 7),
        // Two cones with one apex: a bow tie.
        ([Soup::cone(6).triangles, shifted(&Soup::cone(5).triangles, 10)].concat(), 2, 15),
    ] {
        let packed = Soup::new(triangles).pack();
        let stored: usize = packed.iter().map(stored_vertices).sum();
        assert_eq!((packed.len(), stored), (leaves, vertices), "{packed:?}");
    }
}

/// One or two centres, and the path of both rings.
fn stored_vertices(leaf: &FanLeaf) -> usize {
    leaf.triangle_count() + 1 + leaf.fans().count()
}

/// The same triangles with other vertices, but for vertex 0.
fn shifted(triangles: &[[u32; 3]], by: u32) -> Vec<[u32; 3]> {
    triangles.iter().map(|t| t.map(|v| if v == 0 { 0 } else { v + by })).collect()
}

#[test]
fn a_second_fan_may_be_reversed() {
    // Four triangles about 0 and two about 4, or two about 0 and four about 4: both rings end at
    // the vertex they share.
    let triangles = vec![[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5], [4, 7, 6], [4, 6, 5]];
    let leaves = Soup::new(triangles).pack();
    assert_eq!(leaves.len(), 1);
    assert!(leaves[0].second.as_ref().is_some_and(|second| second.reversed));
}

#[test]
fn coinciding_triangles_and_repeated_corners_are_kept() {
    for copies in 2..20 {
        Soup::new(vec![[0, 1, 2]; copies]).pack();
        Soup::new([[0, 1, 2], [0, 2, 1]].repeat(copies)).pack();
    }
    for degenerate in [[0, 0, 1], [0, 1, 0], [1, 0, 0], [1, 1, 1], [2, 2, 0]] {
        let sheet = vec![[0, 1, 2], [0, 2, 3], [0, 3, 1], degenerate, degenerate];
        Soup::new(sheet).pack();
        Soup::new(vec![degenerate]).pack();
    }
}

#[test]
fn coinciding_positions_change_no_promise() {
    let mut soup = Soup::torus(12, 12);
    soup.positions.fill(DVec3::ONE);
    assert!(soup.fill() > 7.0);
}

#[test]
fn edge_connected_components_never_share_a_leaf() {
    // Of three triangles on an edge, two are neighbours.
    assert_eq!(Soup::new(vec![[0, 1, 2], [1, 0, 3], [0, 1, 4]]).pack().len(), 2);
    let tori = (0..30).flat_map(|n| Soup::torus(3, 4).triangles.into_iter().map(move |t| (n, t)));
    let apart = tori.map(|(n, t)| t.map(|v| v + 12 * n)).collect();
    assert_eq!(Soup::new(apart).pack().len(), 90);
}

#[test]
fn a_moebius_strip_is_packed_across_its_seam() {
    let quads = 20;
    let at = |i: u32, side: u32| if i < quads { 2 * i + side } else { 1 - side };
    let triangles = (0..quads).flat_map(|i| {
        let [a, b, c, d] = [at(i, 0), at(i + 1, 0), at(i + 1, 1), at(i, 1)];
        [[a, b, c], [a, c, d]]
    });
    let vertex = |v: u32| {
        let along = turn(v / 2, quads);
        let across = f64::from(v % 2) - 0.5;
        let radius = 3.0 + across * (along / 2.0).cos();
        DVec3::new(radius * along.cos(), radius * along.sin(), across * (along / 2.0).sin())
    };
    let soup =
        Soup { triangles: triangles.collect(), positions: (0..2 * quads).map(vertex).collect() };
    let leaves = soup.pack();
    let crosses = |leaf: &FanLeaf| {
        let has = |of: [u32; 2]| leaf.triangles().any(|t| of.contains(&t));
        has([0, 1]) && has([2 * quads - 2, 2 * quads - 1])
    };
    assert!(leaves.iter().any(crosses), "{leaves:?}");
}

#[test]
fn flipped_triangles_still_share_leaves() {
    let mut random = SplitMix::new(5);
    let mut soup = Soup::torus(20, 20);
    let is_flipped = |_: &&mut [u32; 3]| below(&mut random, 10) == 0;
    soup.triangles.iter_mut().filter(is_flipped).for_each(|t| t.swap(1, 2));
    let fill = soup.fill();
    // With flipped triangles alone it would be 4.5.
    assert!(fill > 5.0, "{fill}");
}

#[test]
fn a_vertex_of_any_valence_is_split_into_full_fans() {
    for valence in 3..=40 {
        let leaves = Soup::cone(valence).pack();
        assert_eq!(leaves.len(), (valence as usize).div_ceil(MAX_LEAF_TRIANGLES), "{valence}");
    }
}

#[test]
fn time_does_not_grow_with_the_square_of_the_valence() {
    // 100,000² steps would take minutes.
    Soup::cone(100_000).pack();
    Soup::new((0..100_000).map(|i| [0, 2 * i + 1, 2 * i + 2]).collect()).pack();
}

#[test]
fn random_soups_lose_no_triangle_and_sheets_with_holes_fill_their_leaves() {
    for seed in 0..300 {
        let mut random = SplitMix::new(seed);
        let (count, vertices) = (1 + below(&mut random, 60), 1 + below(&mut random, 30));
        let mut corner = |_| below(&mut random, vertices);
        Soup::new((0..count).map(|_| [0; 3].map(&mut corner)).collect()).pack();
    }
    for seed in 0..10 {
        let mut random = SplitMix::new(seed);
        let mut soup = Soup::sheet(30, &mut random);
        soup.triangles.retain(|_| below(&mut random, 50) != 0);
        let fill = soup.fill();
        assert!(fill > 6.5, "{fill}");
    }
}

#[test]
fn packing_fills_leaves_and_stays_compact() {
    let soup = Soup::torus(60, 40);
    let leaves = soup.pack();
    let triangles = soup.triangles.len() as f64;
    let stored: usize = leaves.iter().map(stored_vertices).sum();
    assert!(triangles / leaves.len() as f64 > 7.3 && stored as f64 / triangles < 1.41);
    let sets: Vec<Vec<u32>> = leaves.iter().map(|leaf| leaf.triangles().collect()).collect();
    let quads: Vec<Vec<u32>> = (0..soup.triangles.len() as u32 / 8)
        .map(|block| (8 * block..8 * block + 8).collect())
        .collect();
    let half_areas = |sets: &[Vec<u32>]| soup.half_areas(sets.iter().map(|set| &set[..]));
    let [packed, strips] = [&sets, &quads].map(|sets| half_areas(sets));
    assert!(packed < 1.2 * strips, "{packed} {strips}");
}

/// A square plate with a round bore: needles from its corners to the bore's rims, and a wall.
fn plate_with_bore(around: u32) -> Soup {
    let corners = [[-100.0, -100.0], [100.0, -100.0], [100.0, 100.0], [-100.0, 100.0]];
    let mut positions: Vec<DVec3> = corners.iter().map(|&[x, y]| DVec3::new(x, y, 0.0)).collect();
    for z in [0.0, -50.0] {
        let rim = (0..around).map(|i| turn(i, around) - 0.75 * std::f64::consts::PI);
        positions.extend(rim.map(|at| DVec3::new(10.0 * at.cos(), 10.0 * at.sin(), z)));
    }
    let rim = |level: u32, i: u32| 4 + level * around + i % around;
    let mut triangles = Vec::new();
    for i in 0..around {
        let corner = 4 * i / around;
        triangles.push([corner, rim(0, i + 1), rim(0, i)]);
        triangles.push([rim(0, i), rim(0, i + 1), rim(1, i)]);
        triangles.push([rim(0, i + 1), rim(1, i + 1), rim(1, i)]);
        if 4 * (i + 1) / around != corner {
            triangles.push([corner, (corner + 1) % 4, rim(0, i + 1)]);
        }
    }
    Soup { triangles, positions }
}

#[test]
fn needles_of_a_face_share_no_leaf_with_the_wall_of_a_bore() {
    for around in [16, 40, 64] {
        let soup = plate_with_bore(around);
        let is_wall = |t: u32| {
            let [a, b, c] = soup.triangles[t as usize].map(|v| soup.positions[v as usize].z);
            a.min(b).min(c) < 0.0
        };
        for leaf in soup.pack_with(cheapest(256, 1.0), Effort::FULL).leaves {
            let walls = leaf.triangles().filter(|&t| is_wall(t)).count();
            assert!([0, leaf.triangle_count()].contains(&walls), "{around}: {leaf:?}");
        }
    }
}

#[test]
fn the_chosen_cells_cost_no_more_than_the_largest_and_heavier_bytes_save_bytes() {
    let mut random = SplitMix::new(3);
    let soups = [plate_with_bore(64), Soup::torus(30, 20), Soup::sheet(30, &mut random)];
    for soup in soups {
        let [light, heavy] = [0.25, 16.0].map(|weight| {
            let packed = soup.pack_with(cheapest(256, weight), Effort::FULL);
            let [largest, chosen] = packed.choice.unwrap();
            let ratios = [chosen.instructions / largest.instructions, chosen.bytes / largest.bytes];
            assert!(ratios[0] + weight * ratios[1] <= 1.0 + weight, "{weight}: {ratios:?}");
            assert!(packed.cells >= soup.triangles.len().div_ceil(256));
            chosen
        });
        assert!(light.instructions <= heavy.instructions && heavy.bytes <= light.bytes);
    }
}

#[test]
fn no_leaf_reaches_out_of_its_cell() {
    let soup = Soup::torus(40, 30);
    for most in [1, 2, 7, 64, 500] {
        let cells = cells(&soup.triangles, &soup.positions, most);
        let mut cell_of = vec![usize::MAX; soup.triangles.len()];
        for (number, cell) in cells.iter().enumerate() {
            assert!((1..=most).contains(&cell.len()) && cell.is_sorted());
            for &t in cell {
                assert_eq!(std::mem::replace(&mut cell_of[t as usize], number), usize::MAX);
            }
        }
        assert!(!cell_of.contains(&usize::MAX));
        for leaf in soup.pack_with(Packing::Cells(most), Effort::FULL).leaves {
            let mut cells = leaf.triangles().map(|t| cell_of[t as usize]);
            let first = cells.next();
            assert!(cells.all(|cell| Some(cell) == first));
        }
    }
}

#[test]
fn leaves_are_the_same_on_any_number_of_threads() {
    let mut random = SplitMix::new(8);
    let mut soup = Soup::sheet(120, &mut random);
    soup.triangles.retain(|_| below(&mut random, 200) != 0);
    let packed = [1, 2, 3].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| soup.pack_with(cheapest(256, 1.0), Effort::FULL).leaves)
    });
    assert!(packed[0] == packed[1] && packed[0] == packed[2]);
}

#[test]
fn separate_triangles_are_leaves_by_themselves() {
    let corner = |k: u32, x: f64, y: f64| DVec3::new(f64::from(3 * k) + x, y, 0.0);
    let positions =
        (0..8193).flat_map(|k| [corner(k, 0.0, 0.0), corner(k, 1.0, 0.0), corner(k, 0.0, 1.0)]);
    let triangles = (0..8193).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    let soup = Soup { positions: positions.collect(), triangles };
    assert_eq!(soup.pack().len(), 8193);
}
