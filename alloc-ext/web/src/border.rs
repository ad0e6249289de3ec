//! Bytes that the page writes and reads.

use serde_json::{Value, json};
use std::cell::RefCell;

/// A part of what a call has left.
#[derive(Clone, Copy)]
pub enum Part {
    /// JSON, or source text.
    Text,
    Blob,
    /// Three f32 a vertex, in the mesh's unit.
    MeshVertices,
    /// Three u32 a triangle.
    MeshTriangles,
    HullVertices,
    HullTriangles,
}

const PARTS: usize = Part::HullTriangles as usize + 1;

thread_local! {
    static INPUT: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
    static OUTPUT: RefCell<[Vec<u8>; PARTS]> = RefCell::default();
}

pub fn input(bytes: usize) -> *mut u8 {
    INPUT.with_borrow_mut(|input| {
        *input = vec![0; bytes];
        input.as_mut_ptr()
    })
}

/// The request: JSON in so many bytes, and the bytes behind it.
pub fn request(json_bytes: usize) -> Result<(Value, Vec<u8>), String> {
    let mut json = INPUT.take();
    OUTPUT.take();
    let rest = json.split_off(json_bytes.min(json.len()));
    if json.is_empty() {
        return Ok((Value::Null, rest));
    }
    let value = serde_json::from_slice(&json).map_err(|error| error.to_string())?;
    Ok((value, rest))
}

pub fn output<T: Default>(part: u32, of: fn(&Vec<u8>) -> T) -> T {
    OUTPUT.with_borrow(|output| output.get(part as usize).map(of).unwrap_or_default())
}

pub fn answer(part: Part, bytes: Vec<u8>) {
    OUTPUT.with_borrow_mut(|output| output[part as usize] = bytes);
}

/// Whether it went well; if not, the message is left.
pub fn answered(result: Result<(), String>) -> bool {
    if let Err(message) = &result {
        crate::say(&json!({ "message": message }));
    }
    result.is_ok()
}
