//! Bytes that the page writes and reads.

use serde_json::{Value, json};
use std::cell::RefCell;

/// A part of the answer of a call. `page/instance.js` has the same numbers.
#[derive(Clone, Copy)]
pub enum Part {
    /// JSON, or source text.
    Text = 0,
    Blob = 1,
    /// Three f32 for each vertex, in the mesh's unit.
    MeshVertices = 2,
    /// Three u32 for each triangle.
    MeshTriangles = 3,
    /// As of the mesh.
    HullVertices = 4,
    HullTriangles = 5,
}

const PARTS: usize = Part::HullTriangles as usize + 1;

thread_local! {
    static INPUT: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static OUTPUT: RefCell<[Vec<u8>; PARTS]> = RefCell::default();
}

/// Memory for a request of this size. It lasts until the request is read.
pub fn input(bytes: usize) -> *mut u8 {
    INPUT.with_borrow_mut(|input| {
        *input = vec![0; bytes];
        input.as_mut_ptr()
    })
}

/// Reads the request, and drops the answer of the call before: the JSON in its first `json_bytes`
/// bytes, `Null` if there are none, and the bytes after the JSON.
pub fn take_request(json_bytes: usize) -> Result<(Value, Vec<u8>), String> {
    let mut json = INPUT.take();
    OUTPUT.take();
    let rest = json.split_off(json_bytes.min(json.len()));
    if json.is_empty() {
        return Ok((Value::Null, rest));
    }
    let value = serde_json::from_slice(&json).map_err(|error| error.to_string())?;
    Ok((value, rest))
}

/// A property of a part of the answer. Of a number that no part has: the default.
pub fn output<T: Default>(part: u32, property: fn(&Vec<u8>) -> T) -> T {
    OUTPUT.with_borrow(|output| output.get(part as usize).map(property).unwrap_or_default())
}

/// Leaves a part of the answer.
pub fn leave(part: Part, bytes: Vec<u8>) {
    OUTPUT.with_borrow_mut(|output| output[part as usize] = bytes);
}

/// Leaves JSON as the text of the answer.
pub fn leave_json(json: &Value) {
    leave(Part::Text, json.to_string().into_bytes());
}

/// Whether a call succeeded. Leaves the message of one that did not.
pub fn finish(result: Result<(), String>) -> bool {
    if let Err(message) = &result {
        leave_json(&json!({ "message": message }));
    }
    result.is_ok()
}
