//! The proof that no query can panic: an image whose panic handler cannot be linked, linked.

use crate::cross::Cross;
use crate::elf;
use crate::images::{self, Profile};
use crate::process;

/// The function that the panic handler calls and nobody defines.
const UNDEFINED: &str = "meshsweep_core_panics_here";

/// The questions of the proof image. One that the linker dropped would prove nothing.
const QUESTIONS: [&str; 37] = [
    "ask_hull_open",
    "ask_hull_closest",
    "ask_hull_first_hit",
    "ask_hull_all_hits",
    "ask_hull_outer_hits",
    "ask_tree_open",
    "ask_tree_closest",
    "ask_tree_follow",
    "ask_tree_stopped",
    "ask_tree_is_within",
    "ask_tree_nearest",
    "ask_tree_all_within",
    "ask_tree_signed",
    "ask_tree_first_hit",
    "ask_tree_facing",
    "ask_tree_any_hit",
    "ask_tree_all_hits",
    "ask_tree_session",
    "ask_tree_batch",
    "ask_tree_cull",
    "ask_tree_overlap",
    "ask_tree_all_overlaps",
    "ask_tribox_bounds",
    "ask_tribox_faces",
    "ask_tribox_overlap",
    "ask_tribox_rest",
    "ask_triboxes_open",
    "ask_triboxes_apart",
    "ask_triboxes_candidates",
    "ask_triboxes_distance",
    "ask_triboxes_clip",
    "ask_tight_open",
    "ask_tight_closest",
    "ask_tight_is_within",
    "ask_curve_open",
    "ask_curve_closest",
    "ask_curve_is_within",
];

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
    for target in targets {
        let image = images::image(cross, target, profile, "proof");
        for question in QUESTIONS {
            if !elf::defines(&image, question)? {
                return Err(format!("{target}: the proof image does not contain `{question}`"));
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
