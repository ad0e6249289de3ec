//! Damaged files: an error or a mesh, never a panic, never more memory than the file warrants.

use std::path::Path;

use meshsweep::mesh::{read_bytes, repair, require_closed_manifold};
use meshsweep_host_tests::generate::evil::evil;
use meshsweep_host_tests::generate::scenes::{dae, glb, threemf};
use meshsweep_host_tests::generate::writers::{
    ascii_ply, ascii_stl, binary_ply, binary_stl, obj, off, strip_ply,
};
use meshsweep_host_tests::generate::{Rng, torus};

fn samples() -> Vec<(String, Vec<u8>)> {
    let mesh = torus(2.0, 1.0, 5, 4);
    let mut all: Vec<(String, Vec<u8>)> =
        evil().into_iter().map(|file| (file.name.to_owned(), file.bytes)).collect();
    all.extend([
        ("a.stl".into(), binary_stl(&mesh)),
        ("b.stl".into(), ascii_stl(&mesh)),
        ("a.obj".into(), obj(&mesh)),
        ("a.ply".into(), binary_ply(&mesh)),
        ("b.ply".into(), ascii_ply(&mesh)),
        ("c.ply".into(), strip_ply(&mesh)),
        ("a.off".into(), off(&mesh)),
        ("a.glb".into(), glb(&mesh)),
        ("a.3mf".into(), threemf(&mesh)),
        ("a.dae".into(), dae(&mesh)),
    ]);
    all
}

fn digest(name: &str, bytes: Vec<u8>) {
    if let Ok((mesh, report)) = read_bytes(Path::new(name), bytes).and_then(repair) {
        let _ = report.to_string();
        if let Err(error) = require_closed_manifold(&mesh) {
            let _ = report.explain(error).to_string();
        }
    }
}

#[test]
fn files_cut_anywhere_are_digested() {
    for (name, bytes) in samples() {
        for length in (0..bytes.len()).step_by(1 + bytes.len() / 400) {
            digest(&name, bytes[..length].to_vec());
        }
    }
}

#[test]
fn files_with_random_bytes_changed_are_digested() {
    let mut rng = Rng::new(11);
    for (name, bytes) in samples().into_iter().filter(|(_, bytes)| !bytes.is_empty()) {
        for _ in 0..200 {
            let mut damaged = bytes.clone();
            for _ in 0..=rng.below(4) {
                let at = rng.below(damaged.len());
                damaged[at] = if rng.below(2) == 0 {
                    rng.next_u64() as u8
                } else {
                    b"0129-. \nef"[rng.below(10)]
                };
            }
            digest(&name, damaged);
        }
    }
}

#[test]
fn files_under_a_wrong_extension_are_digested() {
    for (_, bytes) in samples() {
        for name in ["a.ply", "a.obj", "a.stl", "a.off", "a.glb", "a.gltf", "a.3mf", "a.dae"] {
            digest(name, bytes.clone());
        }
    }
}
