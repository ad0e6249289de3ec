//! Soups of every kind through both ways of making fans.

use glam::DVec3;

use super::{Fan, FanFault, FanLeaf, FanReport, MAX_LEAF_TRIANGLES, decompose, pack, validate};

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
    fn sheet(size: u32, random: &mut Random) -> Self {
        let at = |i: u32, j: u32| i * (size + 1) + j;
        let mut triangles = Vec::new();
        for i in 0..size {
            for j in 0..size {
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                let halves = [[[a, b, c], [a, c, d]], [[a, b, d], [b, c, d]]];
                triangles.extend(halves[random.below(2) as usize]);
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

    /// Both ways, checked; the same twice.
    fn check(&self) -> FanReport {
        let fans = decompose(&self.triangles, self.positions.len());
        let single: Vec<FanLeaf> =
            fans.iter().cloned().map(|first| FanLeaf { first, second: None }).collect();
        assert_eq!(validate(&single, &self.triangles), Ok(()));
        assert_eq!(fans, decompose(&self.triangles, self.positions.len()));

        let leaves = pack(&self.triangles, &self.positions);
        assert_eq!(validate(&leaves, &self.triangles), Ok(()));
        assert_eq!(leaves, pack(&self.triangles, &self.positions));
        FanReport::new(&fans, &leaves)
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

/// SplitMix64 (Steele, Lea & Flood 2014).
struct Random(u64);

impl Random {
    fn below(&mut self, limit: u32) -> u32 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) % u64::from(limit)) as u32
    }
}

#[test]
fn nothing_makes_no_fans() {
    let report = Soup::new(vec![]).check();
    assert_eq!((report.fans, report.leaves), (0, 0));
    assert_eq!(
        report.triangles_per_fan() + report.triangles_per_leaf() + report.vertices_per_triangle(),
        0.0
    );
}

#[test]
fn a_single_triangle_is_a_fan() {
    let report = Soup::new(vec![[0, 1, 2]]).check();
    assert_eq!(
        (report.fans, report.degenerate, report.leaves, report.stored_vertices),
        (1, 1, 1, 3)
    );
}

#[test]
fn a_tetrahedron_is_one_patch() {
    let report = Soup::new(vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]).check();
    assert_eq!((report.leaves, report.leaf_sizes[3]), (1, 1));
}

#[test]
fn two_fans_of_one_path_are_one_patch() {
    // A strip: no vertex has more than 3 triangles.
    let report = Soup::new(vec![[0, 1, 2], [2, 1, 3], [2, 3, 4], [4, 3, 5]]).check();
    assert_eq!((report.leaves, report.stored_vertices), (1, 7));
}

#[test]
fn a_second_fan_may_be_reversed() {
    // Four triangles about 0 and two about 4, or two about 0 and four about 4: both rings end at
    // the vertex they share.
    let triangles = vec![[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5], [4, 7, 6], [4, 6, 5]];
    let leaves = pack(&triangles, &Soup::new(triangles.clone()).positions);
    assert_eq!(validate(&leaves, &triangles), Ok(()));
    assert_eq!(leaves.len(), 1);
    assert!(leaves[0].second.as_ref().is_some_and(|second| second.reversed));
}

#[test]
fn coinciding_triangles_are_kept_apart() {
    for copies in 2..20 {
        Soup::new(vec![[0, 1, 2]; copies]).check();
        Soup::new([[0, 1, 2], [0, 2, 1]].repeat(copies)).check();
    }
}

#[test]
fn triangles_with_a_repeated_corner_are_kept() {
    for degenerate in [[0, 0, 1], [0, 1, 0], [1, 0, 0], [1, 1, 1], [2, 2, 0]] {
        let sheet = vec![[0, 1, 2], [0, 2, 3], [0, 3, 1], degenerate, degenerate];
        Soup::new(sheet).check();
        Soup::new(vec![degenerate]).check();
    }
}

#[test]
fn coinciding_positions_change_no_promise() {
    let mut soup = Soup::torus(12, 12);
    soup.positions.fill(DVec3::ONE);
    assert!(soup.check().triangles_per_leaf() > 7.0);
}

#[test]
fn three_triangles_on_an_edge_are_cut_apart() {
    let report = Soup::new(vec![[0, 1, 2], [1, 0, 3], [0, 1, 4]]).check();
    assert_eq!(report.fans, 2);
}

#[test]
fn a_bow_tie_vertex_makes_two_fans() {
    let mut triangles = Soup::cone(6).triangles;
    triangles
        .extend(Soup::cone(5).triangles.iter().map(|t| t.map(|v| if v == 0 { 0 } else { v + 10 })));
    let report = Soup::new(triangles).check();
    assert_eq!((report.fans, report.leaves), (2, 2));
}

#[test]
fn a_moebius_strip_is_packed_across_its_seam() {
    let quads = 20;
    let at = |i: u32, side: u32| if i < quads { 2 * i + side } else { 1 - side };
    let triangles = (0..quads).flat_map(|i| {
        let [a, b, c, d] = [at(i, 0), at(i + 1, 0), at(i + 1, 1), at(i, 1)];
        [[a, b, c], [a, c, d]]
    });
    let report = Soup::new(triangles.collect()).check();
    assert!(report.triangles_per_leaf() >= 4.0, "{report}");
}

#[test]
fn flipped_triangles_still_share_patches() {
    let mut random = Random(5);
    let mut soup = Soup::torus(20, 20);
    soup.triangles.iter_mut().filter(|_| random.below(10) == 0).for_each(|t| t.swap(1, 2));
    assert!(soup.check().triangles_per_leaf() > 6.0);
}

#[test]
fn a_vertex_of_any_valence_is_split_into_full_fans() {
    for valence in 3..=40 {
        let report = Soup::cone(valence).check();
        assert_eq!(
            report.leaves,
            (valence as usize).div_ceil(MAX_LEAF_TRIANGLES),
            "valence {valence}"
        );
        assert!(
            report.fans <= (valence as usize).div_ceil(MAX_LEAF_TRIANGLES),
            "valence {valence}"
        );
    }
}

#[test]
fn time_does_not_grow_with_the_square_of_the_valence() {
    // 100,000² steps would take minutes.
    Soup::cone(100_000).check();
    Soup::new((0..100_000).map(|i| [0, 2 * i + 1, 2 * i + 2]).collect()).check();
}

#[test]
fn separate_parts_are_all_packed() {
    let mut triangles = Vec::new();
    for part in 0..30 {
        triangles.extend(Soup::torus(3, 4).triangles.iter().map(|t| t.map(|v| v + 12 * part)));
    }
    assert_eq!(Soup::new(triangles).check().leaves, 90);
}

#[test]
fn random_soups_lose_no_triangle() {
    for seed in 0..300 {
        let mut random = Random(seed);
        let (count, vertices) = (1 + random.below(60), 1 + random.below(30));
        Soup::new((0..count).map(|_| [0; 3].map(|_| random.below(vertices))).collect()).check();
    }
}

#[test]
fn random_sheets_with_holes_fill_their_leaves() {
    for seed in 0..10 {
        let mut random = Random(seed);
        let mut soup = Soup::sheet(30, &mut random);
        soup.triangles.retain(|_| random.below(50) != 0);
        let report = soup.check();
        assert!(report.triangles_per_fan() > 4.2, "{report}");
        assert!(report.triangles_per_leaf() > 7.0, "{report}");
    }
}

#[test]
fn packing_fills_leaves_and_stays_compact() {
    let soup = Soup::torus(60, 40);
    let report = soup.check();
    assert!(report.triangles_per_fan() > 5.0, "{report}");
    assert!(report.triangles_per_leaf() > 7.3, "{report}");
    assert!(report.vertices_per_triangle() < 1.41, "{report}");

    let fans = decompose(&soup.triangles, soup.positions.len());
    let leaves = pack(&soup.triangles, &soup.positions);
    let sets: Vec<Vec<u32>> = leaves.iter().map(|leaf| leaf.triangles().collect()).collect();
    let apart = soup.half_areas(fans.iter().map(|fan| &fan.triangles[..]));
    let packed = soup.half_areas(sets.iter().map(|set| &set[..]));
    assert!(packed < 1.1 * apart, "{packed} {apart}");
}

#[test]
fn the_report_counts_what_it_is_given() {
    let fan = |triangles: Vec<u32>| Fan {
        centre: 0,
        ring: vec![0; triangles.len() + 1],
        triangles,
        reversed: false,
    };
    let leaves = [
        FanLeaf { first: fan(vec![0, 1, 2]), second: Some(fan(vec![3])) },
        FanLeaf { first: fan(vec![4]), second: None },
    ];
    let report = FanReport::new(leaves.iter().flat_map(FanLeaf::fans), &leaves);
    assert_eq!((report.triangles, report.fans, report.degenerate, report.leaves), (5, 3, 2, 2));
    assert_eq!((report.stored_vertices, report.fan_sizes[2], report.leaf_sizes[3]), (7 + 3, 1, 1));
    assert!(
        report
            .to_string()
            .contains("2 leaves, 2.500 triangles a leaf, 2.000 stored vertices a triangle")
    );
}

#[test]
fn validate_names_each_fault() {
    let triangles = vec![[0, 1, 2], [0, 2, 3], [3, 2, 4]];
    let fault = |change: fn(&mut Fan, &mut Fan)| {
        let mut first =
            Fan { centre: 0, ring: vec![1, 2, 3], triangles: vec![0, 1], reversed: false };
        let mut second = Fan { centre: 4, ring: vec![3, 2], triangles: vec![2], reversed: false };
        change(&mut first, &mut second);
        validate(&[FanLeaf { first, second: Some(second) }], &triangles)
    };
    assert_eq!(fault(|_, _| ()), Ok(()));
    assert_eq!(
        fault(|_, second| second.triangles.clear()),
        Err(FanFault::Size { leaf: 0, found: 2 })
    );
    assert_eq!(
        fault(|_, second| second.triangles = vec![2; 7]),
        Err(FanFault::Size { leaf: 0, found: 9 })
    );
    assert_eq!(fault(|_, second| second.ring.push(0)), Err(FanFault::Ring { leaf: 0 }));
    assert_eq!(fault(|first, _| first.reversed = true), Err(FanFault::Reversed { leaf: 0 }));
    assert_eq!(fault(|_, second| second.ring[0] = 0), Err(FanFault::Apart { leaf: 0 }));
    assert_eq!(fault(|_, second| second.reversed = true), Err(FanFault::Corners { triangle: 2 }));
    assert_eq!(
        fault(|_, second| second.triangles = vec![9]),
        Err(FanFault::Corners { triangle: 9 })
    );
    assert_eq!(validate(&[], &triangles), Err(FanFault::Cover { triangle: 0, found: 0 }));
    assert!(
        FanFault::Cover { triangle: 7, found: 2 }.to_string().contains("triangle 7 is in 2 fans")
    );
}
