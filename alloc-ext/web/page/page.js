"use strict";
// The page: a file goes to the worker, its blob comes back, and an instance here answers at once.

const by = (id) => document.getElementById(id);
const view = new View(by("scene"), by("marks"));

// The file, what was built of it, the instance that answers, the point that is asked.
const state = { name: "", file: null, built: null, asks: null, place: null, rows: null };

const module = (async () => {
  const packed = Uint8Array.from(atob(by("wasm").textContent), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return WebAssembly.compile(await new Response(stream).arrayBuffer());
})();

// The worker, and who waits for its answer.
let worker = null;
let waiting = null;

function endWorker(reason) {
  worker?.terminate();
  worker = null;
  waiting?.reject(new Error(reason));
  waiting = null;
}

// Has the worker do something. What it did before ends.
async function work(call, options) {
  if (waiting) endWorker("");
  if (!worker) {
    const texts = ["instance", "worker"].map((id) => by(id).textContent);
    const address = URL.createObjectURL(new Blob(texts, { type: "text/javascript" }));
    worker = new Worker(address);
    URL.revokeObjectURL(address);
    worker.onmessage = ({ data }) => {
      if (data.doing) return busy(data.doing, data.part);
      const { resolve, reject } = waiting;
      waiting = null;
      busy(null);
      if (data.failed === undefined) return resolve(data);
      // A worker that has panicked is of no more use.
      endWorker("");
      reject(new Error(data.failed));
    };
    worker.onerror = (event) => endWorker(event.message);
  }
  busy("starting", 0);
  const answer = new Promise((resolve, reject) => (waiting = { resolve, reject }));
  worker.postMessage({ module: await module, call, options, file: state.file });
  return answer;
}

function busy(doing, part) {
  by("busy").hidden = doing === null;
  if (doing === null) return;
  by("doing").textContent = doing;
  by("part").value = part;
}

// Shows a message, or takes it away.
function tell(message) {
  by("failed").hidden = !message;
  by("failed").textContent = message ?? "";
  if (message) busy(null);
}

// Opens a file: first what is built at once, then the hull.
async function open(name, bytes) {
  try {
    tell(null);
    Object.assign(state, { name, file: bytes, built: null, asks: null, place: null, rows: null });
    ["ask", "report", "trade"].forEach((id) => (by(id).hidden = true));
    ["mesh", "hull"].forEach((id) => view.set(id, null));
    by("title").textContent = name;
    showTrade();
    draw();
    await show(await work("build", { name, serve: ["closest", "segment"] }), true);
    const faces = [Number(by("faces").value)];
    const serve = ["closest", "segment", "tight"];
    await show(await work("build", { name, serve, faces }), false);
  } catch (error) {
    if (error.message) tell(error.message);
  }
}

const blobName = () => state.name.replace(/\.[^.]*$/, "") + ".msw";

async function show({ answer, blob, mesh, hull }, isFirst) {
  const asks = await Instance.of(await module);
  asks.write(undefined, blob);
  asks.call("open");
  Object.assign(state, { built: { answer, blob }, asks });
  if (isFirst) {
    view.lookAt(answer.tree.bounds);
    by("depth").value = 0;
  }
  view.set("mesh", mesh);
  view.set("hull", hull);
  ["ask", "report", "trade"].forEach((id) => (by(id).hidden = false));
  showReport(answer);
  draw();
  if (isFirst) move(view.toPlane([0.72 * view.scene.width, 0.3 * view.scene.height]));
  else ask();
}

// Digits that do not widen a proof: rounded down, or up.
function rounded(x, isUp) {
  const text = x.toPrecision(7);
  const off = isUp ? x - Number(text) : Number(text) - x;
  if (!(off > 0)) return String(Number(text));
  const step = 10 ** (Math.floor(Math.log10(Math.abs(x))) - 6);
  return String(Number((Number(text) + (isUp ? step : -step)).toPrecision(7)));
}

function row(cells) {
  const line = document.createElement("tr");
  const cell = (text) => Object.assign(document.createElement("td"), { textContent: text });
  line.append(...cells.map(cell));
  return line;
}

function showReport({ notes, sections, tree, hulls, bytes, unit, options }) {
  const item = ({ text }) => Object.assign(document.createElement("li"), { textContent: text });
  by("notes").replaceChildren(...notes.map(item));
  const count = (n) => n.toLocaleString("en");
  const of = sections.map(({ name, bytes }) => row([name, `${count(bytes)} bytes`]));
  by("sections").replaceChildren(...of, row(["blob", `${count(bytes)} bytes`]));
  by("tree").textContent =
    `${count(tree.triangles)} triangles, ${tree.is_closed ? "closed" : "open"}. ` +
    `Stored within ${rounded(tree.surface_error, true)} of the file: answers include that. ` +
    `A query takes ${count(tree.scratch_bytes)} bytes of RAM. ` +
    (unit ? `Lengths in ${unit}.` : "Lengths in the file's unit.");
  by("hulls").hidden = hulls.length === 0;
  by("hulls").tBodies[0].replaceChildren(
    ...hulls.map((hull) =>
      row([
        hull.faces,
        hull.void_percent === null ? "-" : rounded(hull.void_percent, true),
        rounded(hull.hull_to_mesh, true),
        rounded(hull.mesh_to_hull, true),
        count(hull.bytes),
      ]),
    ),
  );
  by("command").textContent = `meshsweep build ${state.name} -o ${blobName()} ${options}`;
}

function move(place) {
  state.place = place;
  [...by("place").querySelectorAll("input")].forEach((field, axis) => (field.value = place[axis]));
  ask();
}

// Asks both structures about the point.
function ask() {
  const { asks, place } = state;
  if (!asks || !place) return view.drawMarks(null);
  const [relative, steps] = ["relative", "steps"].map((id) => Number(by(id).value));
  const rows = [];
  let drawn = null;
  const hasHull = state.built.answer.hulls.length > 0;
  for (const [of, name] of [[0, "box tree"], [1, "hull"]].slice(0, hasHull ? 2 : 1)) {
    try {
      asks.call("closest", of, ...place, relative, steps);
      const found = asks.json();
      const { lower, upper, steps: nodes, ended } = found;
      rows.push(row([name, rounded(lower, false), rounded(upper, true), nodes, ended]));
      if (of === Number(by("of").value) || !drawn) drawn = found;
      if (of === 0) {
        const side = found.side ? `The point is ${found.side}. ` : "";
        const triangle = found.triangle === null ? "" : `of triangle ${found.triangle} `;
        const at = found.point.map((x) => Number(x.toPrecision(6))).join(", ");
        by("found").textContent = `${side}Closest: a point ${triangle}at ${at}.`;
      }
    } catch (error) {
      rows.push(row([name, error.message, "", "", ""]));
    }
  }
  by("answers").replaceChildren(...rows);
  view.drawMarks(place, drawn);
  return drawn;
}

function showTrade() {
  const { rows } = state;
  by("rows").hidden = by("all").parentElement.hidden = !rows;
  const number = (x) => (x === null ? "-" : x.toLocaleString("en", { maximumFractionDigits: 0 }));
  const error = (x) => (x === null ? "-" : rounded(Number(x.toPrecision(3)), true));
  const shown = (rows?.rows ?? []).filter(({ is_best }) => is_best || by("all").checked);
  by("rows").tBodies[0].replaceChildren(
    ...shown.map((one) => {
      const { structure, dials, build, is_best, median, m4f, m0, flash, scratch } = one;
      const cells = [error(one.error), error(median), ...[m4f, m0, flash, scratch].map(number)];
      const line = row([`${structure}: ${dials}`, ...cells]);
      line.className = is_best ? "best" : "";
      line.title = build;
      return line;
    }),
  );
  const reasons = (rows?.not_built ?? []).map(({ structure, reason }) => `${structure}: ${reason}`);
  by("missing").textContent = reasons.length ? `Not built: ${reasons.join("; ")}` : "";
}

async function measure() {
  try {
    tell(null);
    const points = Number(by("points").value);
    const options = { name: state.name, points, all: by("slow").checked };
    state.rows = (await work("trade", options)).answer;
    showTrade();
  } catch (error) {
    if (error.message) tell(error.message);
  }
}

function save(what) {
  const stem = blobName().slice(0, -4);
  const { asks, built, name } = state;
  let content = built.blob;
  if (what !== "blob") {
    asks.call("source", Number(what), asks.write([name, blobName()]));
    content = asks.part(Part.text);
  }
  const extension = { blob: "msw", 0: "rs", 1: "h", 2: "c" }[what];
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([content]));
  link.download = `${stem}.${extension}`;
  link.click();
  URL.revokeObjectURL(link.href);
}

function draw() {
  by("invite").hidden = state.file !== null;
  view.shown = { mesh: by("mesh").checked, hull: by("hull").checked };
  Object.assign(view, { cut: by("cut").checked, depth: Number(by("depth").value) });
  view.draw();
}

// Draws anew after the view has changed: the point stays where it is.
function redraw() {
  draw();
  ask();
}

// Keeps the point under the same pixel of the plane.
function moveDepth(depth) {
  const pixel = state.place && view.toPixels(state.place);
  by("depth").value = depth;
  draw();
  if (pixel) move(view.toPlane(pixel));
}

function listen() {
  const marks = by("marks");
  const pixel = ({ offsetX, offsetY }) => [offsetX, offsetY].map((x) => x * devicePixelRatio);
  let last = null;
  marks.addEventListener("pointerdown", (event) => {
    marks.setPointerCapture(event.pointerId);
    last = pixel(event);
  });
  marks.addEventListener("pointerup", () => (last = null));
  marks.addEventListener("pointercancel", () => (last = null));
  marks.addEventListener("pointermove", (event) => {
    const here = pixel(event);
    if (!last) return state.asks && move(view.toPlane(here));
    const [x, y] = here.map((at, axis) => at - last[axis]);
    last = here;
    if (event.shiftKey) view.shift = view.shift.map((at, axis) => at + [x, y][axis]);
    else view.turn(x / 200 / devicePixelRatio, y / 200 / devicePixelRatio);
    redraw();
  });
  // A finger that only taps sets the point.
  marks.addEventListener("click", (event) => state.asks && move(view.toPlane(pixel(event))));
  marks.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      view.zoomAt(pixel(event), Math.exp(-event.deltaY / 500));
      redraw();
    },
    { passive: false },
  );
  marks.addEventListener("keydown", (event) => {
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const [arrow, key] = [arrows[event.key], event.key];
    const middle = [view.scene.width / 2, view.scene.height / 2];
    if (arrow && event.shiftKey) view.turn(arrow[0] / 12, arrow[1] / 12), redraw();
    else if (arrow && state.place) {
      const [x, y] = view.toPixels(state.place);
      move(view.toPlane([x + 8 * arrow[0], y + 8 * arrow[1]]));
    } else if (key === "PageUp") moveDepth(view.depth + 0.05);
    else if (key === "PageDown") moveDepth(view.depth - 0.05);
    else if (key === "+" || key === "-") view.zoomAt(middle, key === "+" ? 1.25 : 0.8), redraw();
    else return;
    event.preventDefault();
  });
  by("depth").addEventListener("input", (event) => moveDepth(event.target.value));
  ["mesh", "hull", "cut"].forEach((id) => by(id).addEventListener("input", draw));
  ["relative", "steps", "of"].forEach((id) => by(id).addEventListener("input", ask));
  by("all").addEventListener("input", showTrade);
  by("place").addEventListener("submit", (event) => {
    event.preventDefault();
    move([...event.target.querySelectorAll("input")].map((field) => Math.fround(field.value)));
  });
  by("measure").addEventListener("click", measure);
  by("cancel").addEventListener("click", () => (endWorker(""), busy(null)));
  for (const button of document.querySelectorAll("[data-save]")) {
    button.addEventListener("click", () => save(button.dataset.save));
  }
  const take = async (file) => file && open(file.name, new Uint8Array(await file.arrayBuffer()));
  by("file").addEventListener("change", ({ target }) => take(target.files[0]));
  by("faces").addEventListener("change", () => state.file && open(state.name, state.file));
  by("sample").addEventListener("click", () => {
    open("part.obj", new TextEncoder().encode(by("part.obj").textContent));
  });
  const stage = by("stage");
  addEventListener("dragover", (event) => (event.preventDefault(), stage.classList.add("over")));
  addEventListener("dragleave", () => stage.classList.remove("over"));
  addEventListener("drop", (event) => {
    event.preventDefault();
    stage.classList.remove("over");
    take(event.dataTransfer.files[0]);
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
  new ResizeObserver(() => (view.resize(), redraw())).observe(stage);
}

view.resize();
listen();
