"use strict";
// An instance of the compiled library, on the page and in its worker: see src/lib.rs.

const Part = { text: 0, blob: 1, mesh: [2, 3], hull: [4, 5] };

class Instance {
  // `told` gets what a long call is doing and the part of the work that is done.
  static async of(module, told = () => {}) {
    const made = new Instance();
    const page = {
      told: (at, bytes, part) => told(made.textAt(at, bytes), part),
      panicked: (at, bytes) => (made.panic = made.textAt(at, bytes)),
    };
    made.exports = (await WebAssembly.instantiate(module, { page })).exports;
    made.exports.start();
    return made;
  }

  bytesAt(at, bytes) {
    return new Uint8Array(this.exports.memory.buffer, at, bytes);
  }

  textAt(at, bytes) {
    return new TextDecoder().decode(this.bytesAt(at, bytes));
  }

  // Writes a request: a value as JSON, and bytes behind it. How long the JSON is.
  write(json, bytes = new Uint8Array()) {
    const text = json === undefined ? "" : JSON.stringify(json);
    const head = new TextEncoder().encode(text);
    // By a call: the memory may move as it grows.
    const at = this.exports.input(head.length + bytes.length);
    this.bytesAt(at, head.length).set(head);
    this.bytesAt(at + head.length, bytes.length).set(bytes);
    return head.length;
  }

  // Calls an export, and throws its message if it refuses.
  call(name, ...numbers) {
    let went;
    try {
      went = this.exports[name](...numbers);
    } catch (error) {
      // Without a message the memory of 4 GiB is full, or the browser gives no more.
      throw new Error(this.panic ?? `${error.message}: not enough memory?`);
    }
    if (!went) throw new Error(this.json().message);
  }

  // A copy of a part of the answer.
  part(part) {
    return this.bytesAt(this.exports.output(part), this.exports.output_bytes(part)).slice();
  }

  text() {
    return new TextDecoder().decode(this.part(Part.text));
  }

  json() {
    return JSON.parse(this.text());
  }

  // A surface of the answer, if there is one.
  surface([vertices, triangles]) {
    const numbers = new Uint32Array(this.part(triangles).buffer);
    if (numbers.length === 0) return null;
    return { vertices: new Float32Array(this.part(vertices).buffer), triangles: numbers };
  }
}
