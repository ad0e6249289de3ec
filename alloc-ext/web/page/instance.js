"use strict";
// An instance of the compiled library. The page has one, and so has its worker: see src/lib.rs.

// The numbers of `Part` in src/border.rs; of a surface its vertices and its triangles.
const Part = { text: 0, blob: 1, mesh: [2, 3], hull: [4, 5] };

class Instance {
  // `onProgress` gets the stage of a long call and the fraction of the work that is done.
  static async of(module, onProgress = () => {}) {
    const made = new Instance();
    const page = {
      progress: (at, bytes, fraction) => onProgress(made.textAt(at, bytes), fraction),
      panicked: (at, bytes) => (made.panic = made.textAt(at, bytes)),
    };
    made.exports = (await WebAssembly.instantiate(module, { page })).exports;
    made.exports.start();
    return made;
  }

  // A view of memory. Calls may move the memory, so a view is used before the next call.
  bytesAt(at, bytes) {
    // Addresses and lengths beyond 2 GiB arrive as negative numbers.
    return new Uint8Array(this.exports.memory.buffer, at >>> 0, bytes >>> 0);
  }

  textAt(at, bytes) {
    return new TextDecoder().decode(this.bytesAt(at, bytes));
  }

  // Runs an export, and throws the message of a panic.
  run(name, ...numbers) {
    try {
      return this.exports[name](...numbers);
    } catch (error) {
      // Without memory the library stops without a message. It may have 4 GiB.
      throw new Error(this.panic ?? `${error.message}: not enough memory?`);
    }
  }

  // Runs an export that may refuse, and throws its message if it does.
  call(name, ...numbers) {
    if (!this.run(name, ...numbers)) throw new Error(this.json().message);
  }

  // Writes a request: a value as JSON, then bytes. Returns the number of bytes of the JSON.
  write(json, bytes = new Uint8Array()) {
    const text = json === undefined ? "" : JSON.stringify(json);
    const head = new TextEncoder().encode(text);
    const at = this.run("input", head.length + bytes.length) >>> 0;
    this.bytesAt(at, head.length).set(head);
    this.bytesAt(at + head.length, bytes.length).set(bytes);
    return head.length;
  }

  // A copy of a part of the answer.
  part(part) {
    return this.bytesAt(this.run("output", part), this.run("output_bytes", part)).slice();
  }

  text() {
    return new TextDecoder().decode(this.part(Part.text));
  }

  json() {
    return JSON.parse(this.text());
  }

  // A surface of the answer; null if the answer has none.
  surface([vertices, triangles]) {
    const numbers = new Uint32Array(this.part(triangles).buffer);
    if (numbers.length === 0) return null;
    return { vertices: new Float32Array(this.part(vertices).buffer), triangles: numbers };
  }
}
