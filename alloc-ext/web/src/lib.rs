//! What the page calls. Numbers cross the border, and bytes in two places: the page writes a
//! request at [`input`], and fetches what a call has left at [`output`].
//!
//! ```text
//! {"name": …, "serve": […]} + file ─ build ─ report, blob, mesh, tight hull
//! {"name": …, "points": …}  + file ─ trade ─ rows
//!                             blob ─ open ─ closest, source
//! ```
//!
//! A call that is refused returns `false` and leaves `{"message": …}`. An instance that has
//! panicked is of no more use: the page makes another one.
//!
//! A C interface, and not wasm-bindgen: eight functions need no generated code, and no program
//! beside cargo that has to be of the same version.

mod ask;
mod border;
mod build;
mod trade;

use border::{Part, answer, answered, request};

// Functions of the page.
#[link(wasm_import_module = "page")]
unsafe extern "C" {
    /// What is being done, UTF-8, and the part of the work that is done.
    safe fn told(text: *const u8, bytes: usize, part: f64);
    /// The message of a panic.
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

/// Where to write a request of so many bytes.
#[unsafe(no_mangle)]
pub extern "C" fn input(bytes: usize) -> *mut u8 {
    border::input(bytes)
}

/// Where a [`Part`] of what the last call has left begins.
#[unsafe(no_mangle)]
pub extern "C" fn output(part: u32) -> *const u8 {
    border::output(part, |bytes| bytes.as_ptr())
}

/// How many bytes that part has.
#[unsafe(no_mangle)]
pub extern "C" fn output_bytes(part: u32) -> usize {
    border::output(part, Vec::len)
}

/// Builds the blob of a file. The request is [`build::Options`] as JSON, of so many bytes, and the
/// content of the file.
#[unsafe(no_mangle)]
pub extern "C" fn build(json_bytes: usize) -> bool {
    answered(request(json_bytes).and_then(|(options, file)| build::run(&options, file)))
}

/// Measures what settings of a mesh promise and cost. The request is like that of [`build`].
#[unsafe(no_mangle)]
pub extern "C" fn trade(json_bytes: usize) -> bool {
    answered(request(json_bytes).and_then(|(options, file)| trade::run(&options, file)))
}

/// Opens a blob, once in an instance. The request is its bytes.
#[unsafe(no_mangle)]
pub extern "C" fn open() -> bool {
    answered(request(0).and_then(|(_, blob)| ask::open(blob)))
}

/// The closest point, asked of the box tree or of the finest tight hull. The answer as JSON.
#[unsafe(no_mangle)]
pub extern "C" fn closest(
    of_hull: bool,
    x: f32,
    y: f32,
    z: f32,
    relative: f32,
    steps: u32,
) -> bool {
    answered(ask::closest(of_hull, [x, y, z], relative, steps))
}

/// The open blob as source text: 0 a Rust module, 1 a C header, 2 a C file. The request is the
/// names of the mesh and of the blob, as a JSON array.
#[unsafe(no_mangle)]
pub extern "C" fn source(language: u32, json_bytes: usize) -> bool {
    answered(request(json_bytes).and_then(|(names, _)| ask::source(language, &names)))
}

/// Tells the page how far a long call is.
fn tell(doing: &str, part: f64) {
    told(doing.as_ptr(), doing.len(), part);
}

/// Leaves JSON as the answer.
fn say(json: &serde_json::Value) {
    answer(Part::Text, json.to_string().into_bytes());
}
