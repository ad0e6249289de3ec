//! The functions that the page calls. Arguments and results are numbers. Bytes cross in two places:
//! the page writes a request at [`input`], and reads the answer of the last call at [`output`].
//!
//! ```text
//! {"name": …, "serve": […], "faces": […]}     + file ─ build ─ report, blob, mesh, tight hull
//! {"name": …, "points": …, "all": true/false} + file ─ trade ─ rows
//!                                               blob ─ open ─ closest, source
//! ```
//!
//! A call that is refused returns `false`, and its answer is `{"message": …}`. After a panic the
//! page must make a new instance.
//!
//! The interface is C's. wasm-bindgen would generate code, and needs a program of its own version
//! beside cargo. For so few functions of numbers neither is worth it.

mod border;
mod build;
mod query;
mod trade;

use border::{finish, take_request};

// Functions of the page. `page/instance.js` has them.
#[link(wasm_import_module = "page")]
unsafe extern "C" {
    /// Takes the stage of a long call, in UTF-8, and the fraction of the work that is done.
    safe fn progress(stage: *const u8, bytes: usize, fraction: f64);
    /// Takes the message of a panic, in UTF-8.
    safe fn panicked(text: *const u8, bytes: usize);
}

/// Prepares an instance. The page calls it first.
#[unsafe(no_mangle)]
pub extern "C" fn start() {
    std::panic::set_hook(Box::new(|info| {
        let text = info.to_string();
        panicked(text.as_ptr(), text.len());
    }));
}

/// Memory in which the page writes a request of this size.
#[unsafe(no_mangle)]
pub extern "C" fn input(bytes: usize) -> *mut u8 {
    border::input(bytes)
}

/// The first byte of a [`border::Part`] of the last call's answer.
#[unsafe(no_mangle)]
pub extern "C" fn output(part: u32) -> *const u8 {
    border::output(part, |bytes| bytes.as_ptr())
}

/// The number of bytes of this part.
#[unsafe(no_mangle)]
pub extern "C" fn output_bytes(part: u32) -> usize {
    border::output(part, Vec::len)
}

/// Builds the blob of a file. The request is JSON of `json_bytes` bytes, then the file: `name` of
/// the file, `serve` with the words of `meshsweep build --for`, `faces` of each tight hull.
#[unsafe(no_mangle)]
pub extern "C" fn build(json_bytes: usize) -> bool {
    finish(take_request(json_bytes).and_then(|(options, file)| build::run(&options, file)))
}

/// Measures the settings of a mesh: the widest interval of each, and its costs. The request is JSON
/// of `json_bytes` bytes, then the file: `name` of the file, number of `points`, whether `all`
/// settings are measured, the slow ones too.
#[unsafe(no_mangle)]
pub extern "C" fn trade(json_bytes: usize) -> bool {
    finish(take_request(json_bytes).and_then(|(options, file)| trade::run(&options, file)))
}

/// Opens the blob that the request holds. An instance opens one blob only.
#[unsafe(no_mangle)]
pub extern "C" fn open() -> bool {
    finish(take_request(0).and_then(|(_, blob)| query::open(blob)))
}

/// Finds the closest point by the box tree, or by the finest tight hull. The answer is JSON.
#[unsafe(no_mangle)]
pub extern "C" fn closest(
    of_hull: bool,
    x: f32,
    y: f32,
    z: f32,
    relative: f32,
    steps: u32,
) -> bool {
    finish(query::closest(of_hull, [x, y, z], relative, steps))
}

/// Writes the open blob as source text: 0 a Rust module, 1 a C header, 2 a C file. The request is a
/// JSON array of `json_bytes` bytes: the names of the mesh's file and of the blob's file.
#[unsafe(no_mangle)]
pub extern "C" fn source(language: u32, json_bytes: usize) -> bool {
    finish(take_request(json_bytes).and_then(|(names, _)| query::source(language, &names)))
}

/// Shows the page the progress of a long call.
fn report_progress(stage: &str, fraction: f64) {
    progress(stage.as_ptr(), stage.len(), fraction);
}
