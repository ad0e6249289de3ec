//! The committed corpora: a text file for each target, a line of hexadecimal digits for each input.
//!
//! A fuzzer wants a file for each input. Thousands of small files would hide the rest of the
//! repository.

use super::input::random_input;
use crate::generate::Rng;
use std::fs;
use std::path::{Path, PathBuf};

/// Random inputs that a run begins with, beside the committed ones.
const SEEDED: usize = 64;

fn file(target: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../fuzz/corpus").join(target).with_extension("hex")
}

/// The committed inputs of a target.
///
/// # Errors
/// The file cannot be read, or is not of pairs of hexadecimal digits.
pub fn corpus(target: &str) -> Result<Vec<Vec<u8>>, String> {
    let file = file(target);
    let text = fs::read_to_string(&file).map_err(|error| format!("{}: {error}", file.display()))?;
    let input = |(number, line): (usize, &str)| {
        let place =
            || format!("{}:{}: not pairs of hexadecimal digits", file.display(), number + 1);
        of_hex(line).ok_or_else(place)
    };
    text.lines().enumerate().map(input).collect()
}

/// The bytes of pairs of hexadecimal digits; `None` if the text is anything else.
#[must_use]
pub fn of_hex(digits: &str) -> Option<Vec<u8>> {
    let digit = |digit: &u8| char::from(*digit).to_digit(16);
    let byte = |pair: &[u8; 2]| {
        let [high, low] = pair;
        Some((16 * digit(high)? + digit(low)?) as u8)
    };
    let (pairs, rest) = digits.as_bytes().as_chunks();
    if rest.is_empty() { pairs.iter().map(byte).collect() } else { None }
}

/// Writes the inputs that a run of a fuzzer begins with into a folder, a file each: the committed
/// ones, random ones, and files of meshes for the target that reads them.
///
/// # Errors
/// A file cannot be read or written.
pub fn unpack(target: &str, folder: &Path) -> Result<(), String> {
    let mut inputs = if file(target).exists() { corpus(target)? } else { Vec::new() };
    // A fuzzer lengthens inputs of slow targets late. So some are long from the start.
    let mut rng = Rng::new(0);
    inputs.extend((0..SEEDED).map(|_| random_input(&mut rng)));
    if target == "mesh" {
        inputs.extend(super::mesh::mesh_files());
    }
    fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    for (number, input) in inputs.iter().enumerate() {
        let path = folder.join(format!("{number:05}"));
        fs::write(&path, input).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    Ok(())
}

/// Writes a folder of inputs as the target's corpus, the shortest first. Returns their number.
///
/// # Errors
/// A file cannot be read or written.
pub fn pack(target: &str, folder: &Path) -> Result<usize, String> {
    let failed = |error: std::io::Error| format!("{}: {error}", folder.display());
    let mut inputs = Vec::new();
    for entry in fs::read_dir(folder).map_err(failed)? {
        inputs.push(fs::read(entry.map_err(failed)?.path()).map_err(failed)?);
    }
    inputs.sort_by(|a, b| (a.len(), a).cmp(&(b.len(), b)));
    inputs.dedup();
    if inputs.is_empty() {
        return Err(format!("{}: no inputs", folder.display()));
    }
    let line = |input: &Vec<u8>| {
        input.iter().map(|byte| format!("{byte:02x}")).chain(["\n".to_owned()]).collect::<String>()
    };
    let text: String = inputs.iter().map(line).collect();
    let file = file(target);
    fs::write(&file, text).map_err(|error| format!("{}: {error}", file.display()))?;
    Ok(inputs.len())
}
