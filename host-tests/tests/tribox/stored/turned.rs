//! Turned triboxes: what they hold, what is asked of them in the mesh's frame, and their bytes.

use super::mesh;
use meshsweep::check::{Against, Finding, Outcome, verify};
use meshsweep::mesh::Mesh;
use meshsweep::progress::Watch;
use meshsweep::tribox::{self, Measure, TriboxOptions, cut};
use meshsweep_core::{
    Blob, Budget, Contradiction, NodePair, OpenError, Pose, ScratchEntry, SectionKind, Triboxes,
};
use meshsweep_host_tests::corrupt;
use meshsweep_host_tests::generate::{
    Rng, Triangles, bracket, groove_block, rough_sphere, scaled, torus, transformed,
};
use meshsweep_host_tests::oracle::{distance_of_meshes, distance_to_mesh, meets, winding_number};
use meshsweep_host_tests::workload::Subject;
use meshsweep_host_tests::workload::pose::{poses, sphere};
use std::sync::OnceLock;

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

/// Shapes that lie askew, so that their triboxes are better turned.
fn askew() -> Vec<(&'static str, Triangles)> {
    let rotation = [[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]];
    let turned = |of: &Triangles, by| transformed(of, rotation, by);
    let mut open = turned(&groove_block(), [1.0, 2.0, 3.0]);
    open.1.truncate(open.1.len() - 20);
    vec![
        ("torus", turned(&torus(2.0, 0.75, 16, 8), [0.3, 0.1, -0.2])),
        ("bracket", turned(&bracket(), [0.0; 3])),
        ("groove", turned(&groove_block(), [1.0, 2.0, 3.0])),
        ("open", open),
        ("far", turned(&groove_block(), [3000.0, -2000.0, 10.0])),
        ("small", scaled(&turned(&groove_block(), [0.0; 3]), 1e-30)),
        ("large", scaled(&turned(&groove_block(), [0.0; 3]), 1e30)),
    ]
}

fn turned(mesh: &Mesh, count: u32) -> Vec<u8> {
    let options = TriboxOptions::new(count).with_orient(Some(Measure::Volume));
    tribox::build(mesh.as_input(), &options, Watch::NONE).expect("in the domain").0.to_bytes()
}

/// The shapes, and the blob of each.
fn blobs() -> &'static [(&'static str, Mesh, Vec<u8>)] {
    static ALL: OnceLock<Vec<(&'static str, Mesh, Vec<u8>)>> = OnceLock::new();
    ALL.get_or_init(|| {
        let all = askew().into_iter().map(|(name, triangles)| {
            let mesh = mesh(&triangles);
            let bytes = turned(&mesh, 12);
            (name, mesh, bytes)
        });
        all.collect()
    })
}

fn open<'a>((name, _, bytes): &'a (&'static str, Mesh, Vec<u8>)) -> Triboxes<'a> {
    let triboxes = Triboxes::open(bytes).unwrap_or_else(|error| panic!("{name}: {error}"));
    assert!(triboxes.is_turned(), "{name} lies askew");
    triboxes
}

/// Whether a place of the mesh's frame is in one of the triboxes, or no farther outside than
/// `off` by the worst plane.
fn is_held(triboxes: Triboxes<'_>, p: [f64; 3], off: f64) -> bool {
    let q = triboxes.orientation().map(|row| (0..3).map(|k| f64::from(row[k]) * p[k]).sum::<f64>());
    let along = DIRECTIONS.map(|d| d[0] * q[0] + d[1] * q[1] + d[2] * q[2]);
    triboxes.leaves().any(|(_, tribox)| {
        let slabs = tribox.slabs().zip(along);
        slabs
            .into_iter()
            .all(|((low, high), x)| f64::from(low) - x <= off && x - f64::from(high) <= off)
    })
}

fn size(mesh: &Mesh) -> f64 {
    mesh.positions.iter().flatten().fold(0f64, |most, &x| most.max(f64::from(x).abs()))
}

#[test]
fn every_level_holds_the_surface_and_the_inside() {
    for of @ (name, mesh, _) in blobs() {
        let all = open(of);
        let off = 16.0 * f64::EPSILON * size(mesh);
        let mut rng = Rng::new(5);
        let mut inside = 0;
        for level in all.levels() {
            let triboxes = all.coarser(level.triboxes);
            for t in 0..mesh.triangles.len() {
                let [a, b, c] = mesh.corners(t).expect("one").map(|p| p.map(f64::from));
                for [u, v, w] in
                    [[8.0, 0.0, 0.0], [0.0, 8.0, 0.0], [1.0, 2.0, 5.0], [3.0, 3.0, 2.0]]
                {
                    let p = [0, 1, 2].map(|k| (u * a[k] + v * b[k] + w * c[k]) / 8.0);
                    assert!(is_held(triboxes, p, off), "{name}, {}: {p:?}", level.triboxes);
                }
            }
            let corner = |least: bool| {
                [0, 1, 2].map(|k| {
                    let axis = mesh.positions.iter().map(|p| p[k]);
                    if least {
                        axis.fold(f32::INFINITY, f32::min)
                    } else {
                        axis.fold(f32::NEG_INFINITY, f32::max)
                    }
                })
            };
            for _ in 0..if all.is_solid() { 150 } else { 0 } {
                let p = rng.point_in(corner(true), corner(false)).map(f64::from);
                if winding_number(p, &mesh.positions, &mesh.triangles, 1.0).abs() > 0.5 {
                    inside += 1;
                    assert!(is_held(triboxes, p, off), "{name}, {}: {p:?}", level.triboxes);
                }
            }
        }
        assert_eq!(all.is_solid(), *name != "open");
        assert!(inside > 40 || *name == "open", "{name}: {inside}");
    }
}

#[test]
fn a_block_that_lies_askew_has_almost_no_void() {
    let (_, _, bytes) = &blobs()[2];
    let whole = Triboxes::open(bytes).expect("opens").level(0).expect("a level");
    let groove = mesh(&askew()[2].1);
    let own = tribox::build(groove.as_input(), &TriboxOptions::new(1), Watch::NONE);
    let own = own.expect("in the domain").0.to_bytes();
    let own = Triboxes::open(&own).expect("opens").level(0).expect("a level");
    // The block with its groove filled, and that in a tribox along other axes.
    assert!(1.0 + whole.void_ratio < 0.75 * (1.0 + own.void_ratio), "{whole:?} {own:?}");
}

#[test]
fn distances_and_segments_are_below_the_mesh_s() {
    for of @ (name, mesh, _) in blobs() {
        let all = open(of);
        let mut rng = Rng::new(23);
        let mut stack = vec![ScratchEntry::EMPTY; all.scratch_entries()];
        let near = |rng: &mut Rng| {
            let at = mesh.positions[rng.below(mesh.positions.len())];
            let by = (size(mesh) * if *name == "far" { 0.002 } else { 0.4 }) as f32;
            [0, 1, 2].map(|k| at[k] + by * rng.range(-1.0, 1.0))
        };
        let (mut known, mut clear) = (0, 0);
        for _ in 0..120 {
            let [a, b] = [(); 2].map(|()| near(&mut rng));
            let answer = all.distance(a, Budget::EXACT, &mut stack).expect("answered");
            let truth = distance_to_mesh(a, &mesh.positions, &mesh.triangles);
            assert!(f64::from(answer.lower) <= truth.upper, "{name}: {answer:?} {truth:?}");
            known += usize::from(f64::from(answer.lower) > 0.3 * truth.lower);
            let answer = all.clip(a, b, Budget::EXACT, &mut stack).expect("answered");
            let t = if answer.lower.is_infinite() { 1.0 } else { answer.lower - 1e-5 };
            let end = if t >= 1.0 { b } else { [0, 1, 2].map(|k| a[k] + t * (b[k] - a[k])) };
            if t > 0.0 {
                let met = (0..mesh.triangles.len())
                    .any(|i| meets(a, end, mesh.corners(i).expect("one")).is_some());
                assert!(!met, "{name}: {a:?} {b:?} {answer:?}");
                clear += 1;
            }
        }
        assert!(known > 10 && clear > 10, "{name}: {known} {clear}");
    }
}

/// The largest distance that is proved, by halving; `None` if they may meet.
fn proved(a: &Triboxes<'_>, b: &Triboxes<'_>, pose: Pose, most: f32) -> Option<f32> {
    let mut stack = vec![ScratchEntry::EMPTY; a.separation_entries(b)];
    let mut is_proved = |distance: f32| {
        let found = a.within_of(b, pose, distance, Budget::EXACT, &mut stack).expect("answered");
        found.is_apart()
    };
    let mut pairs = [NodePair::EMPTY; 1];
    if !is_proved(0.0) {
        let found = a.candidates(
            b,
            pose,
            &mut pairs,
            Budget::EXACT,
            &mut vec![ScratchEntry::EMPTY; a.separation_entries(b)],
        );
        assert!(!found.expect("answered").is_apart());
        return None;
    }
    let (mut low, mut high) = (0.0f32, most);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if is_proved(middle) { low = middle } else { high = middle }
    }
    Some(low)
}

#[test]
fn no_distance_is_proved_that_turned_and_other_models_do_not_keep() {
    let plain_triangles = rough_sphere(1, 0.4, 2);
    let plain = mesh(&plain_triangles);
    let plain_bytes = super::blob(&plain, 12);
    let (mut counted, mut shares) = (0, 0.0);
    for of @ (name, turned, _) in blobs().iter().take(3) {
        let first = open(of);
        let second = Triboxes::open(&plain_bytes).expect("opens");
        assert!(!second.is_turned());
        let arrays = |mesh: &Mesh| (mesh.positions.clone(), mesh.triangles.clone());
        let [of_first, of_second] = [arrays(turned), arrays(&plain)];
        let subject = Subject::of("", turned.clone());
        let sphere = sphere(&subject);
        for (a, b, of_a, of_b) in [
            (&first, &first, &of_first, &of_first),
            (&first, &second, &of_first, &of_second),
            (&second, &first, &of_second, &of_first),
        ] {
            let rigid = poses(&sphere, 10).map(|(_, core)| core);
            let affine = [Pose::affine(
                [[1.0, 0.5, 0.0], [0.0, 1.0, -1.5], [0.5, 0.0, 2.0]],
                [0.0, (6.0 * size(turned)) as f32, 0.0],
            )];
            for pose in rigid.chain(affine) {
                let most = (32.0 * size(turned)) as f32;
                let Some(distance) = proved(a, b, pose, most) else { continue };
                let exact = distance_of_meshes(
                    (&of_a.0, &of_a.1),
                    (&of_b.0, &of_b.1),
                    &pose.rotation,
                    pose.translation,
                );
                assert!(f64::from(distance) < exact.upper, "{name}: {distance} {exact:?} {pose:?}");
                (counted, shares) = (counted + 1, shares + f64::from(distance) / exact.upper);
            }
        }
    }
    assert!(counted > 30 && shares > 0.7 * f64::from(counted), "{shares} of {counted}");
}

fn is_proved(finding: &Finding) -> bool {
    finding.outcome == Outcome::Proved
}

#[test]
fn the_section_proves_itself_and_another_rotation_does_not() {
    for (name, mesh, bytes) in blobs() {
        let findings = verify(bytes, Against::Mesh(mesh.as_input(), &[]));
        assert!(findings.iter().all(is_proved), "{name}: {findings:?}");
    }
    // Turned a little further about an axis: a rotation still, and no longer that of the triboxes.
    let (_, mesh, bytes) = &blobs()[1];
    let rows = Triboxes::open(bytes).expect("opens").orientation();
    let (c, s) = (1.0 - 5e-5, 0.01 * (1.0 - 2.5e-5 / 1.5));
    let norm = f64::sqrt(c * c + s * s);
    let (c, s) = (c / norm, s / norm);
    let wide = rows.map(|row| row.map(f64::from));
    let other = [
        [0, 1, 2].map(|k| (c * wide[0][k] - s * wide[1][k]) as f32),
        [0, 1, 2].map(|k| (s * wide[0][k] + c * wide[1][k]) as f32),
        rows[2],
    ];
    corrupt::edited(
        bytes.clone(),
        SectionKind::Triboxes,
        |section| {
            let numbers = other.iter().flatten().flat_map(|x| x.to_le_bytes());
            section[32..68].iter_mut().zip(numbers).for_each(|(slot, byte)| *slot = byte);
        },
        |edited| {
            Triboxes::open(edited)?;
            let findings = verify(edited, Against::Mesh(mesh.as_input(), &[]));
            assert!(!findings.iter().all(is_proved), "{findings:?}");
            Ok::<(), OpenError>(())
        },
    )
    .expect("it opens");
}

#[test]
fn a_matrix_that_is_no_rotation_is_named() {
    let (_, _, bytes) = &blobs()[1];
    let wrong = OpenError::Counts { what: Contradiction::TriboxTurn };
    for (at, value) in
        [(32, f32::NAN), (36, f32::INFINITY), (40, 2.0), (44, 0.0), (48, 1e-3), (64, -0.5)]
    {
        let opened = corrupt::edited(
            bytes.clone(),
            SectionKind::Triboxes,
            |section| corrupt::put_u32(section, at, value.to_bits()),
            |edited| Triboxes::open(edited).map(|_| ()),
        );
        assert_eq!(opened, Err(wrong), "{value} at {at}");
    }
    // A mirror.
    let opened = corrupt::edited(
        bytes.clone(),
        SectionKind::Triboxes,
        |section| section[32..44].chunks_mut(4).for_each(|number| number[3] ^= 0x80),
        |edited| Triboxes::open(edited).map(|_| ()),
    );
    assert_eq!(opened, Err(wrong));
    // Without the matrix the section has another length.
    let opened = corrupt::edited(
        bytes.clone(),
        SectionKind::Triboxes,
        |section| section[0] &= !2,
        |edited| Triboxes::open(edited).map(|_| ()),
    );
    assert!(opened.is_err());
}

#[test]
fn cuts_keep_the_rotation() {
    let (_, _, bytes) = &blobs()[0];
    let blob = Blob::open(bytes).expect("opens");
    let all = blob.triboxes().expect("there");
    for level in all.levels() {
        let cut = cut(&blob, level.triboxes).expect("a level").to_bytes();
        let left = Triboxes::open(&cut).expect("opens");
        assert_eq!(left.orientation(), all.orientation());
        let coarser = all.coarser(level.triboxes);
        assert_eq!(left.leaves().collect::<Vec<_>>(), coarser.leaves().collect::<Vec<_>>());
    }
}

#[test]
fn what_lies_along_its_axes_stays_there_with_the_same_bytes() {
    let mesh = mesh(&bracket());
    let plain = tribox::build(mesh.as_input(), &TriboxOptions::new(12), Watch::NONE);
    let plain = plain.expect("in the domain").0.to_bytes();
    for measure in [Measure::Volume, Measure::Area] {
        let options = TriboxOptions::new(12).with_orient(Some(measure));
        let asked = tribox::build(mesh.as_input(), &options, Watch::NONE).expect("in the domain");
        assert!(asked.0.to_bytes() == plain);
    }
}
