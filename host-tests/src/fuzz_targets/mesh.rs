//! The target for mesh files.

use crate::generate::evil::evil;
use crate::generate::scenes::{dae, glb, threemf};
use crate::generate::writers::{ascii_ply, ascii_stl, binary_ply, binary_stl, obj, off, strip_ply};
use meshsweep::mesh::{FORMATS, Unit, read_bytes, repair};
use std::path::{Path, PathBuf};

/// Reads a file whose format the first byte tells, scales and repairs it.
pub fn mesh(data: &[u8]) {
    let Some((kind, bytes)) = data.split_first() else { return };
    let name = PathBuf::from("a").with_extension(FORMATS[usize::from(*kind) % FORMATS.len()]);
    // Refusals are right; panics are not.
    let _ =
        read_bytes(&name, bytes.to_vec()).and_then(|raw| raw.in_unit(Unit::In)).and_then(repair);
}

/// Inputs that begin a run: a tetrahedron in each format, and files that must be refused. A fuzzer
/// does not find the words of a format by itself.
pub fn mesh_files() -> Vec<Vec<u8>> {
    let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let sound = (corners.to_vec(), vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]);
    let sound = [
        ("a.stl", binary_stl(&sound)),
        ("a.stl", ascii_stl(&sound)),
        ("a.obj", obj(&sound)),
        ("a.ply", binary_ply(&sound)),
        ("a.ply", ascii_ply(&sound)),
        ("a.ply", strip_ply(&sound)),
        ("a.off", off(&sound)),
        ("a.glb", glb(&sound)),
        ("a.3mf", threemf(&sound)),
        ("a.dae", dae(&sound)),
    ];
    let evil = evil().into_iter().map(|file| (file.name, file.bytes));
    let of_kind = |(name, bytes): (&str, Vec<u8>)| {
        let extension = Path::new(name).extension()?.to_str()?;
        let kind = FORMATS.iter().position(|format| *format == extension)?;
        Some([vec![kind as u8], bytes].concat())
    };
    sound.into_iter().chain(evil).filter_map(of_kind).collect()
}
