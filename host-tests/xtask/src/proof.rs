//! The proof that no query can panic: an image whose panic handler cannot be linked, linked.

use crate::cross::Cross;
use crate::elf;
use crate::images::{self, Profile};
use crate::process;
use crate::workspace;

/// The function that the panic handler calls and nobody defines.
const UNDEFINED: &str = "meshsweep_core_panics_here";

/// The functions that the proof image's source names. One that the linker dropped would prove
/// nothing. What they ask is decided at run time, so no question of the suite is dropped.
fn functions() -> Result<Vec<String>, String> {
    let file = workspace::firmware().join("src/bin/proof.rs");
    let text = std::fs::read_to_string(&file)
        .map_err(|error| format!("cannot read {}: {error}", file.display()))?;
    let words = text.split(|letter: char| !(letter.is_alphanumeric() || letter == '_'));
    let names: Vec<String> =
        words.filter(|word| word.starts_with("ask_")).map(str::to_owned).collect();
    // One for each subject of the suite at least, or the source is read wrongly.
    if names.len() < 12 { Err(format!("{names:?} are too few functions")) } else { Ok(names) }
}

/// Links the proof image for each target.
///
/// # Errors
/// A query can panic, or the image lacks a question.
pub fn holds(cross: &Cross, targets: &[&str], profile: Profile) -> Result<(), String> {
    let mut command = images::cargo(cross, "build", targets, profile);
    let output = process::output(command.args(["--bin", "proof"]))?;
    if !output.status.success() {
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        if !message.contains(UNDEFINED) {
            return Err(message);
        }
        let told =
            targets.iter().map(|target| format!("{target}: {}", places(cross, target, profile)));
        return Err(told.collect::<Vec<_>>().join("\n"));
    }
    let functions = functions()?;
    for target in targets {
        let image = images::image(cross, target, profile, "proof");
        for function in &functions {
            if !elf::defines(&image, function)? {
                return Err(format!("{target}: the proof image does not contain `{function}`"));
            }
        }
    }
    Ok(())
}

/// Puts a panic into a query: the image must fail to link, for that reason.
///
/// # Errors
/// The image links, or fails for another reason.
pub fn notices_a_panic(cross: &Cross, target: &str, profile: Profile) -> Result<(), String> {
    let mut command = images::cargo(cross, "build", &[target], profile);
    let output = process::output(command.args(["--bin", "proof", "--features", "inject_panic"]))?;
    let message = String::from_utf8_lossy(&output.stderr);
    if output.status.success() {
        Err("the image links although a query can panic: the proof proves nothing".to_owned())
    } else if message.contains(UNDEFINED) {
        Ok(())
    } else {
        Err(format!("the image failed to build for another reason than the panic\n{message}"))
    }
}

/// Where the panics come from: read from an image that is allowed to have them.
fn places(cross: &Cross, target: &str, profile: Profile) -> String {
    let mut command = images::cargo(cross, "build", &[target], profile);
    let built = process::capture(command.args(["--bin", "proof", "--features", "name_panics"]));
    let found =
        built.and_then(|_| elf::panic_places(&images::image(cross, target, profile, "proof")));
    match found {
        Ok(places) if places.is_empty() => {
            "a query can panic, at a place that the image does not name".to_owned()
        }
        Ok(places) => format!("a query can panic at\n  {}", places.join("\n  ")),
        Err(reason) => format!("a query can panic; its place could not be read: {reason}"),
    }
}
