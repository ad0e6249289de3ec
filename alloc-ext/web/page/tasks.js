"use strict";
// Long calls, one at a time, in a worker that ends when a call is cancelled.

// Rejects the promise of a call that was cancelled. It is not an error to show.
class Cancelled extends Error {}

class Tasks {
  // `onProgress` gets the stage of the call and the fraction of the work that is done, and at the
  // end of the call null.
  constructor(onProgress) {
    Object.assign(this, { onProgress, worker: null, waiting: null });
    this.module = Tasks.compile();
  }

  // The text of a script of the page.
  static text(id) {
    return document.getElementById(id).textContent;
  }

  static async compile() {
    const packed = Uint8Array.from(atob(Tasks.text("wasm")), (c) => c.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    return WebAssembly.compile(await new Response(stream).arrayBuffer());
  }

  // Runs a call about a file. Cancels the call that the worker is busy with.
  async run(call, { name, bytes }, options) {
    // The last wait before the message, so that no other call comes between.
    const module = await this.module;
    if (this.waiting) this.cancel();
    if (!this.worker) this.start();
    this.onProgress("starting", 0);
    return new Promise((resolve, reject) => {
      this.waiting = { resolve, reject };
      this.worker.postMessage({ module, call, options: { name, ...options }, file: bytes });
    });
  }

  cancel() {
    this.end(new Cancelled());
  }

  end(error) {
    this.worker?.terminate();
    this.worker = null;
    this.waiting?.reject(error);
    this.waiting = null;
    this.onProgress(null);
  }

  start() {
    const texts = ["instance", "worker"].map(Tasks.text);
    const address = URL.createObjectURL(new Blob(texts, { type: "text/javascript" }));
    this.worker = new Worker(address);
    URL.revokeObjectURL(address);
    this.worker.onmessage = ({ data }) => {
      if (data.stage) return this.onProgress(data.stage, data.fraction);
      // An instance that has panicked is of no more use. After any failure a new worker is made.
      if (data.failed !== undefined) return this.end(new Error(data.failed));
      const { resolve } = this.waiting;
      this.waiting = null;
      this.onProgress(null);
      resolve(data);
    };
    this.worker.onerror = (event) => this.end(new Error(event.message));
  }
}
