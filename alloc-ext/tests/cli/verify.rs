//! `meshsweep verify` proves what `build` wrote, and nothing that was changed afterwards.

use crate::support::{arg, blob, coarse_torus, fixture, ok, refused, run, scratch};
use meshsweep::check::{Against, Outcome, crc32, entries, verify, verify_file, word};
use meshsweep::mesh;
use std::fs;
use std::path::{Path, PathBuf};

// Kinds of sections.
const VERTICES: u32 = 1;
const SPLITS: u32 = 3;
const RADII: u32 = 5;
const SOURCE: u32 = 9;
const LEVELS: u32 = 10;
const GROUPS: u32 = 11;
const TREE: u32 = 12;
const SEGMENT_BOXES: u32 = 15;
const FANS: u32 = 16;
const TREE_SOURCE: u32 = 17;
const CONES: u32 = 18;
const TRIBOXES: u32 = 19;
const TIGHT: u32 = 20;
const CURVES: u32 = 21;
const ZONES: u32 = 27;
const NUMBERS: u32 = 22;
const FRAMES: u32 = 23;
const MOMENTS: u32 = 24;
const TURNED: u32 = 25;

/// The surface error in the header.
const ERROR: usize = 88;

/// Writes all CRCs anew, those of blobs in the section of tight hulls too.
fn mend(bytes: &mut [u8]) {
    for entry in entries(bytes) {
        let body = entry.offset as usize..(entry.offset + entry.bytes) as usize;
        if entry.kind == TIGHT {
            let hulls = &mut bytes[body.clone()];
            for record in 0..word(hulls, 0).unwrap() as usize {
                let field = |at: usize| word(hulls, 8 + 24 * record + at).unwrap() as usize;
                let (start, length) = (field(0), field(4));
                mend(&mut hulls[start..start + length]);
            }
        }
        let crc = crc32(&bytes[body]);
        put(bytes, entry.at + 12, crc);
    }
    let table = word(bytes, 12).unwrap() as usize;
    let crc = crc32(&[&bytes[..156], &bytes[160..table]].concat());
    put(bytes, 156, crc);
}

fn put(bytes: &mut [u8], at: usize, value: u32) {
    bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
}

/// Multiplies a stored f32.
fn scale(bytes: &mut [u8], at: usize, factor: f32) {
    let value = f32::from_bits(word(bytes, at).unwrap());
    assert!(value != 0.0);
    put(bytes, at, (value * factor).to_bits());
}

fn start(bytes: &[u8], kind: u32) -> usize {
    entries(bytes).iter().find(|entry| entry.kind == kind).expect("a section").offset as usize
}

fn end(bytes: &[u8], kind: u32) -> usize {
    let entry = entries(bytes).into_iter().find(|entry| entry.kind == kind).expect("a section");
    (entry.offset + entry.bytes) as usize
}

/// A blob, the meshes that it is of, and where the edited copy goes.
struct Case {
    blob: PathBuf,
    meshes: Vec<PathBuf>,
    edited: PathBuf,
}

impl Case {
    fn new(directory: &Path, blob: PathBuf, meshes: &[PathBuf]) -> Self {
        let case = Self { blob, meshes: meshes.to_vec(), edited: directory.join("edited.msw") };
        let proved = ok(case.arguments(&case.blob));
        assert!(!proved.is_empty() && proved.lines().all(|line| !line.contains("not proved")));
        case
    }

    fn arguments<'a>(&'a self, blob: &'a Path) -> Vec<&'a str> {
        let meshes = self.meshes.iter().map(|mesh| arg(mesh));
        ["verify", arg(blob)].into_iter().chain(meshes).collect()
    }

    /// Demands that the edited blob is refused because of this.
    fn fails(&self, because: &str, edit: impl FnOnce(&mut [u8])) {
        let mut bytes = fs::read(&self.blob).unwrap();
        let whole = bytes.clone();
        edit(&mut bytes);
        assert!(bytes != whole);
        mend(&mut bytes);
        fs::write(&self.edited, bytes).unwrap();
        let output = run(self.arguments(&self.edited));
        assert!(!output.status.success(), "{because}: proved");
        let line = refused(&output, 3, "edited.msw");
        assert!(line.contains(" failed: ") && !line.contains(because), "{line}");
        let said = String::from_utf8_lossy(&output.stdout);
        let failed = said.lines().find(|line| line.starts_with("failed: "));
        assert!(failed.is_some_and(|line| line.contains(because)), "{because}: {said}");
    }
}

#[test]
fn box_trees_are_proved_and_changed_ones_are_not() {
    let directory = scratch("verify_tree");
    let case = Case::new(&directory, fixture("groove.msw"), &[fixture("groove.obj")]);
    // Low planes of the root's first child along x.
    case.fails("box tree: axis-aligned box 0 of node", |b| b[start(b, SEGMENT_BOXES)] += 9);
    case.fails("box tree: ", |b| b[start(b, FANS)] ^= 4);
    case.fails("box tree: the triangle stored as", |b| b[start(b, TREE_SOURCE)] += 1);
    case.fails("box tree: moments of node 0", |b| scale(b, start(b, MOMENTS) + 12, 0.9));
    case.fails("box tree: the normal cone of leaf", |b| {
        let cones = start(b, CONES);
        let known = (0..).find(|leaf| b[cones + 4 * leaf + 3] < 255).expect("a cone");
        b[cones + 4 * known] = b[cones + 4 * known].wrapping_neg().max(1);
        b[cones + 4 * known + 1] = 77;
        b[cones + 4 * known + 3] = 0;
    });
    let path = blob(&directory, "torus.ply", &[]);
    let case = Case::new(&directory, path, &[fixture("torus.ply")]);
    case.fails("box tree: the triangle stored as", |b| scale(b, start(b, TREE) + 40, 0.25));
}

#[test]
fn triangles_are_proved_in_the_winding_of_the_file_and_turned_ones_to_be_those_of_sides() {
    let directory = scratch("verify_turned");
    for bits in ["16", "32"] {
        let path = blob(&directory, "evil/room.obj", &["--vertex-bits", bits]);
        let case = Case::new(&directory, path, &[fixture("evil/room.obj")]);
        // All are turned: one flag says so.
        case.fails("box tree: the triangle stored as", |b| b[start(b, TREE) + 1] ^= 8);
        let path = blob(&directory, "evil/mixed_winding.ply", &["--vertex-bits", bits]);
        let case = Case::new(&directory, path, &[fixture("evil/mixed_winding.ply")]);
        case.fails("box tree: the triangle stored as", |b| b[start(b, TURNED)] ^= 2);
        for name in ["evil/glued_blocks.obj", "evil/plugged_shell.obj", "evil/room.obj"] {
            let options = ["--for", "closest,segment,winding", "--vertex-bits", bits];
            let path = blob(&directory, name, &options);
            Case::new(&directory, path, &[fixture(name)]);
        }
    }
}

#[test]
fn a_crack_that_the_grid_closes_is_a_boundary_still() {
    let directory = scratch("verify_crack");
    let (path, mesh) = (directory.join("crack.msw"), directory.join("crack.obj"));
    let square = |x: f32| format!("v {x} 0 0\nv {} 0 0\nv {} 1 0\nv {x} 1 0\n", x + 1.0, x + 1.0);
    let faces = "f 1 2 3 4\nf 5 6 7 8\n";
    fs::write(&mesh, format!("{}{}{faces}", square(0.0), square(1.000_001))).unwrap();
    ok(["build", arg(&mesh), "-o", arg(&path), "--for", "closest,winding"]);
    let case = Case::new(&directory, path, &[mesh]);
    // Eight sides, of which two are those of the crack.
    case.fails("moments of node 0: a boundary of", |b| scale(b, start(b, MOMENTS) + 56, 0.875));
}

#[test]
fn hull_hierarchies_are_proved_and_changed_ones_are_not() {
    let directory = scratch("verify_hull");
    let mesh = fixture("groove.obj");
    let path =
        blob(&directory, "groove.obj", &["--for", "hull", "--base", "60", "--vertex-bits", "16"]);
    let case = Case::new(&directory, path, std::slice::from_ref(&mesh));
    case.fails("hull hierarchy: triangle 0 leaves out vertex", |b| b[start(b, RADII)] -= 2);
    case.fails("hull hierarchy: split", |b| {
        let first = start(b, VERTICES);
        b.copy_within(first + 6..first + 12, first);
    });
    case.fails("hull hierarchy: the triangle stored as", |b| b[start(b, SOURCE) + 2] ^= 1);
    case.fails("its void is", |b| put(b, start(b, LEVELS) + 16, f32::NAN.to_bits()));
    // Errors of 0 would tell a refinement that no split is needed.
    case.fails("a part that it removes has no finite radius", |b| {
        let (first, last) = (start(b, RADII), end(b, RADII));
        b[first..last].iter_mut().filter(|code| **code > 0).for_each(|code| *code = 255);
        let record = (end(b, SPLITS) - start(b, SPLITS)) / word(b, 64).unwrap() as usize;
        (1..=word(b, 64).unwrap() as usize).for_each(|k| b[start(b, SPLITS) + k * record - 1] = 0);
        let levels = word(b, 80).unwrap() as usize;
        (1..levels).for_each(|k| put(b, start(b, LEVELS) + 20 * k - 8, f32::INFINITY.to_bits()));
    });
    case.fails("hull hierarchy: split 0: its error is", |b| {
        let record = (end(b, SPLITS) - start(b, SPLITS)) / word(b, 64).unwrap() as usize;
        let error = start(b, SPLITS) + record - 1;
        assert!(b[error] > 1);
        b[error] -= 1;
    });
    // A triangle of the surface: the last split's last one.
    case.fails("is its own part and has radius", |b| {
        let radii = end(b, RADII);
        assert_eq!(b[radii - 1], 0);
        b[radii - 1] = 1;
    });
    // Its mesh is moved to a grid.
    let path = directory.join("coarse.msw");
    let mesh = coarse_torus(&directory);
    let options = ["--for", "hull", "--base", "400", "--vertex-bits", "16", "-o", arg(&path)];
    ok([&["build", arg(&mesh)], &options[..]].concat());
    let case = Case::new(&directory, path, std::slice::from_ref(&mesh));
    case.fails("hull hierarchy: the triangle stored as", |b| scale(b, ERROR, 0.25));
    case.fails("from the surface, the table says", |b| scale(b, start(b, LEVELS) + 8, 0.5));
}

#[test]
fn a_group_that_sweeps_would_leave_out_is_not_proved() {
    let directory = scratch("verify_sweep");
    let (path, mesh) = (directory.join("open.msw"), fixture("evil/open_box.stl"));
    ok(["build", arg(&mesh), "-o", arg(&path), "--for", "sweep"]);
    let case = Case::new(&directory, path, &[mesh]);
    // The infinite radius says that no triangle of the group stands for a part of the surface.
    case.fails("base group 0: its radius inf denies its part", |b| {
        let first =
            (end(b, GROUPS) - start(b, GROUPS)) / word(b, 60).unwrap().div_ceil(16) as usize;
        let radius = start(b, GROUPS) + first - 2;
        b[radius..radius + 2].copy_from_slice(&[0x80, 0x7F]);
    });
}

#[test]
fn a_mesh_of_merged_walls_has_no_sides() {
    let directory = scratch("verify_walls");
    let (path, mesh) = (directory.join("shell.msw"), directory.join("shell.obj"));
    let walls = "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n";
    fs::write(&mesh, format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n{walls}")).unwrap();
    ok(["build", arg(&mesh), "-o", arg(&path), "--for", "closest"]);
    let case = Case::new(&directory, path, &[mesh]);
    case.fails("closed: false, the header says true", |b| b[start(b, TREE) + 1] |= 1);
}

#[test]
fn a_level_of_more_splits_than_there_are_is_no_proof_and_no_panic() {
    let mut bytes = fs::read(fixture("bracket.msw")).unwrap();
    let splits = start(&bytes, LEVELS) + 4;
    put(&mut bytes, splits, u32::MAX);
    mend(&mut bytes);
    let (mesh, _) = mesh::repair(mesh::read(&fixture("bracket.stl")).unwrap()).unwrap();
    let findings = verify(&bytes, Against::Mesh(mesh.as_input(), &[]));
    let outcomes: Vec<_> = findings.iter().map(|of| (of.structure, of.outcome)).collect();
    assert_eq!(outcomes, [("hull hierarchy", Outcome::Failed)]);
}

#[test]
fn key_frames_are_proved_of_their_meshes_alone() {
    let directory = scratch("verify_deform");
    let mesh = fixture("groove.obj");
    let sheared = directory.join("sheared.obj");
    let text = fs::read_to_string(&mesh).unwrap();
    let moved = text.lines().map(|line| {
        let numbers: Vec<f64> =
            line.split_whitespace().skip(1).filter_map(|x| x.parse().ok()).collect();
        match (line.starts_with("v "), &numbers[..]) {
            (true, [x, y, z]) => format!("v {x} {y} {}\n", z + 0.125 * x),
            _ => format!("{line}\n"),
        }
    });
    fs::write(&sheared, moved.collect::<String>()).unwrap();
    let path = directory.join("groove.msw");
    let options = ["--for", "deform", "--base", "60", "-o", arg(&path)];
    ok([&["build", arg(&mesh), arg(&sheared)][..], &options].concat());
    let case = Case::new(&directory, path.clone(), &[mesh.clone(), sheared.clone()]);
    case.fails("vertex numbers: vertex", |b| b[start(b, NUMBERS) + 4] ^= 1);
    // After the count and one record.
    case.fails("key 1: triangle 0 leaves out vertex", |b| {
        let vertices = word(b, 52).unwrap() as usize;
        let radii = start(b, FRAMES) + 4 + 28 + 12 * vertices;
        assert!(b[radii] > 9);
        b[radii] -= 9;
    });
    let output = run(["verify", arg(&path), arg(&mesh)]);
    refused(&output, 3, "failed: key frames");
    let said = String::from_utf8_lossy(&output.stdout);
    let wanted = "key frames, frame 0 included: 2 stored, 1 given";
    assert!(said.contains(wanted), "{said}");
    let output = run(["verify", arg(&path), arg(&mesh), arg(&mesh)]);
    refused(&output, 3, "groove.msw");
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(said.contains("failed: key frames: key frame 1: vertex"), "{said}");
}

#[test]
fn triboxes_are_proved_and_changed_ones_are_not() {
    let directory = scratch("verify_triboxes");
    let case = Case::new(&directory, fixture("torus.msw"), &[fixture("torus.ply")]);
    // The second level's distance.
    case.fails("triboxes: level 1: ", |b| scale(b, start(b, TRIBOXES) + 32 + 16 + 4, 0.5));
    case.fails("triboxes: node 0 reaches", |b| scale(b, start(b, TRIBOXES) + 32 + 8, 0.9));
    case.fails("triboxes: level 2: its void", |b| scale(b, start(b, TRIBOXES) + 64 + 12, 0.99));
    // An open mesh holds no inside, a hollow one does: another claim of the same triboxes.
    let path = directory.join("open.msw");
    let open = fixture("evil/open_box.stl");
    ok(["build", arg(&open), "-o", arg(&path), "--for", "triboxes", "--triboxes", "8"]);
    let case = Case::new(&directory, path, &[open]);
    case.fails("the inside of a mesh that is not closed", |b| b[start(b, TRIBOXES)] |= 1);
}

#[test]
fn a_shrunk_hull_error_is_caught_at_whichever_node_it_is() {
    let whole = fs::read(fixture("torus.msw")).unwrap();
    let (mesh, _) = mesh::repair(mesh::read(&fixture("torus.ply")).unwrap()).unwrap();
    let section = start(&whole, TRIBOXES);
    let [nodes, levels] = [20, 24].map(|at| word(&whole, section + at).unwrap() as usize);
    let first = section + 32 + 16 * levels + (nodes - 1);
    assert!(nodes > 15 && first + 40 * nodes <= end(&whole, TRIBOXES));
    for node in 0..nodes {
        let mut bytes = whole.clone();
        // The upper half of an f32: 13 steps are from 5 to 10 %.
        let at = first + 40 * node + 38;
        let code = u16::from_le_bytes([bytes[at], bytes[at + 1]]);
        assert!(code > 13);
        bytes[at..at + 2].copy_from_slice(&(code - 13).to_le_bytes());
        mend(&mut bytes);
        let findings = verify(&bytes, Against::Mesh(mesh.as_input(), &[]));
        let failed: Vec<_> =
            findings.iter().filter(|found| found.outcome == Outcome::Failed).collect();
        let [failed] = failed[..] else { panic!("node {node}: {findings:?}") };
        assert!(failed.words.starts_with(&format!("node {node} reaches ")), "{failed:?}");
    }
}

#[test]
fn the_files_own_triangles_prove_a_surface_error_and_catch_a_shrunk_one() {
    let directory = scratch("verify_surface_error");
    let mesh = directory.join("decimal.obj");
    let lines = fs::read_to_string(coarse_torus(&directory)).unwrap();
    // No coordinate is an f32.
    let line = |line: &str| match line.strip_prefix("v ") {
        Some(place) => {
            let place = place.split(' ').map(|x| 1.01 * x.parse::<f64>().unwrap());
            format!("v {}\n", place.map(|x| x.to_string()).collect::<Vec<_>>().join(" "))
        }
        None => format!("{line}\n"),
    };
    fs::write(&mesh, lines.lines().map(line).collect::<String>()).unwrap();
    let raw = mesh::read(&mesh).unwrap();
    let outcomes = |bytes: &[u8]| {
        let findings = verify_file(bytes, &raw);
        findings.iter().map(|of| (of.structure, of.outcome)).collect::<Vec<_>>()
    };
    for bits in ["16", "24", "32"] {
        let cases =
            [("closest", "box tree"), ("hull", "hull hierarchy"), ("sweep", "hull hierarchy")];
        for (serves, structure) in cases {
            let path = directory.join("torus.msw");
            ok(["build", arg(&mesh), "-o", arg(&path), "--for", serves, "--vertex-bits", bits]);
            let whole = fs::read(&path).unwrap();
            assert_eq!(outcomes(&whole), [(structure, Outcome::Proved)], "{bits} {serves}");
            let mut bytes = whole;
            let error = if serves == "closest" { start(&bytes, TREE) + 40 } else { ERROR };
            scale(&mut bytes, error, 0.25);
            mend(&mut bytes);
            assert_eq!(outcomes(&bytes), [(structure, Outcome::Failed)], "{bits} {serves}");
        }
    }
    // What reading moved is not in a mesh that is said to be the file's to the bit.
    let path = directory.join("torus.msw");
    ok(["build", arg(&mesh), "-o", arg(&path), "--for", "hull", "--vertex-bits", "32"]);
    let mut bytes = fs::read(&path).unwrap();
    scale(&mut bytes, ERROR, 0.25);
    mend(&mut bytes);
    let (mut repaired, _) = mesh::repair(raw.clone()).unwrap();
    repaired.rounding = 0.0;
    let findings = verify(&bytes, Against::Mesh(repaired.as_input(), &[]));
    assert!(findings.iter().all(|of| of.outcome == Outcome::Proved), "{findings:?}");
    assert_eq!(outcomes(&bytes), [("hull hierarchy", Outcome::Failed)]);
}

#[test]
fn tight_hulls_are_proved_and_changed_ones_are_not() {
    let directory = scratch("verify_tight");
    let case = Case::new(&directory, fixture("hulls.msw"), &[fixture("bracket.stl")]);
    case.fails("tight hulls: hull 0: face", |b| scale(b, start(b, TIGHT) + 8 + 12, 0.5));
    case.fails("tight hulls: hull 0: triangle", |b| scale(b, start(b, TIGHT) + 8 + 16, 0.5));
    case.fails("tight hulls: hull 1: its void", |b| scale(b, start(b, TIGHT) + 32 + 20, 0.9));
    // A corner of the first hull's first leaf.
    case.fails("tight hulls: hull 0: ", |b| {
        let hull = start(b, TIGHT) + word(b, start(b, TIGHT) + 8).unwrap() as usize;
        let fans = hull + start(&b[hull..], FANS);
        b[fans + 1] ^= 1;
    });
}

#[test]
fn curves_are_proved_and_changed_ones_are_not() {
    let directory = scratch("verify_curve");
    let case = Case::new(&directory, fixture("fence.msw"), &[fixture("fence.csv")]);
    let points = |b: &[u8]| start(b, CURVES) + 32 + 4 * 2;
    case.fails("curve: polyline 0: point 3", |b| b[points(b) + 12] ^= 2);
    case.fails("curve: polyline 0: point", |b| scale(b, ERROR, 0.25));
    // After 76 points: first, last, radius. The exponent's last bit is in the upper byte.
    case.fails("curve: the capsule of node 0", |b| {
        b[points(b) + 4 * word(b, start(b, CURVES) + 20).unwrap() as usize + 3] -= 1
    });
}

#[test]
fn zones_of_curves_are_proved_and_changed_ones_are_not() {
    let directory = scratch("verify_zones");
    let zones = directory.join("zones.csv");
    let text = "zone,x,y\ninclusion,0,0\ninclusion,9,0\ninclusion,9,9\n\
                exclusion,4,1\nexclusion,5,1\nexclusion,5,2\n";
    fs::write(&zones, text).expect("written");
    let blob = directory.join("zones.msw");
    ok(["build", arg(&zones), "-o", arg(&blob)]);
    let case = Case::new(&directory, blob, &[zones]);
    case.fails("curve: polyline 1 is an exclusion zone, and 0 is stored", |b| {
        let at = start(b, ZONES);
        b[at + 1] = 0;
    });
    case.fails("curve: polyline 0 is an inclusion zone, and 1 is stored", |b| {
        let at = start(b, ZONES);
        b[at] = 1;
    });
}

#[test]
fn a_blob_is_not_proved_of_another_mesh() {
    let bracket = fixture("bracket.stl");
    let (torus, fence) = (fixture("torus.ply"), fixture("fence.csv"));
    for (blob, mesh, structure) in [
        ("groove.msw", &torus, "box tree"),
        ("bracket.msw", &torus, "hull hierarchy"),
        ("torus.msw", &bracket, "triboxes"),
        ("hulls.msw", &torus, "tight hulls"),
    ] {
        let output = run(["verify", arg(&fixture(blob)), arg(mesh)]);
        let line = refused(&output, 3, blob);
        assert!(line.contains(" failed: ") && line.contains(structure), "{line}");
        assert!(line.contains("; the blob was built from another mesh, of "), "{line}");
        let said = String::from_utf8_lossy(&output.stdout);
        assert!(said.contains(&format!("failed: {structure}: ")), "{said}");
    }
    let line = refused(&run(["verify", arg(&fixture("groove.msw")), arg(&fence)]), 2, "fence.csv");
    assert!(line.contains("name the mesh file"), "{line}");
    let line = refused(&run(["verify", arg(&fixture("fence.msw")), arg(&torus)]), 2, "torus.ply");
    assert!(line.contains("is of curves") && line.contains(".csv"), "{line}");
    let two = ["verify", arg(&fixture("groove.msw")), arg(&torus), arg(&torus)].map(str::to_owned);
    refused(&run(two), 2, "key frames");
}

#[test]
fn what_has_no_proof_is_said_and_is_no_success() {
    let directory = scratch("verify_cut");
    let path = directory.join("cut.msw");
    ok(["cut", arg(&fixture("bracket.msw")), "--level", "1", "-o", arg(&path)]);
    let mesh = fixture("bracket.stl");
    let output = run(["verify", arg(&path), arg(&mesh), "--json"]);
    let line = refused(&output, 3, "cut.msw");
    assert!(line.contains(" could not be made: hull hierarchy"), "{line}");
    assert!(!line.contains("failed"), "{line}");
    let said: serde_json::Value = serde_json::from_slice(&output.stdout).expect("it is JSON");
    assert_eq!(said["proved"], false);
    let outcomes: Vec<_> =
        said["findings"].as_array().unwrap().iter().map(|of| of["outcome"].as_str()).collect();
    assert!(outcomes.contains(&Some("proved")) && outcomes.contains(&Some("not proved")));
    let whole = ok(["verify", arg(&fixture("groove.msw")), arg(&fixture("groove.obj")), "--json"]);
    let said: serde_json::Value = serde_json::from_str(&whole).expect("it is JSON");
    assert!(said["proved"] == true && said["findings"][0]["counts"]["triangle"] == 404, "{said}");
}
