"use strict";
// The page: the worker builds the blob of a file, and an instance on the page answers about it.

const by = (id) => document.getElementById(id);

// Shows a message, or takes it away.
function showError(message) {
  by("failed").hidden = !message;
  by("failed").textContent = message ?? "";
}

const view = (() => {
  try {
    return new View(by("scene"), by("marks"));
  } catch (error) {
    showError(error.message);
    throw error;
  }
})();

const state = {
  // The name and the bytes of the open file.
  file: null,
  // The report and the blob that were built from the file.
  built: null,
  // The instance that has opened the blob.
  instance: null,
  // The point whose distance is shown.
  place: null,
  // The measured trade.
  trade: null,
};

const tasks = new Tasks(showProgress);

// Shows the stage of the work and its fraction that is done, or takes both away.
function showProgress(stage, fraction) {
  by("busy").hidden = stage === null;
  // Measuring would cancel the build.
  by("measure").disabled = stage !== null;
  if (stage === null) return;
  by("stage-name").textContent = stage;
  by("fraction").value = fraction;
}

// Runs something that may fail, and shows the message if it does.
async function attempt(action) {
  try {
    showError(null);
    await action();
  } catch (error) {
    if (!(error instanceof Cancelled)) showError(error.message);
  }
}

// Opens a file. The box tree is built first, because the hull takes longer.
function open(name, bytes) {
  return attempt(async () => {
    const file = { name, bytes };
    Object.assign(state, { file, built: null, instance: null, place: null, trade: null });
    ["distance", "report", "trade"].forEach((id) => (by(id).hidden = true));
    ["mesh", "hull"].forEach((id) => view.set(id, null));
    by("title").textContent = name;
    showTrade();
    redraw();
    await build(file, { serve: ["closest", "segment"] }, true);
    await buildHull(file);
  });
}

function buildHull(file) {
  const faces = [Number(by("faces").value)];
  return build(file, { serve: ["closest", "segment", "tight"], faces }, false);
}

// Builds a blob of a file and shows it, unless another file was opened meanwhile.
async function build(file, options, isFirst) {
  const made = await tasks.run("build", file, options);
  const instance = await Instance.of(await tasks.module);
  if (state.file !== file) throw new Cancelled();
  instance.write(undefined, made.blob);
  instance.call("open");
  Object.assign(state, { built: { answer: made.answer, blob: made.blob }, instance });
  show(made, isFirst);
}

// The name of the file without its extension.
const stem = () => state.file.name.replace(/\.[^.]*$/, "");

function show({ answer, mesh, hull }, isFirst) {
  if (isFirst) {
    view.lookAt(answer.tree.bounds);
    by("depth").value = 0;
  }
  view.set("mesh", mesh);
  view.set("hull", hull);
  ["distance", "report", "trade"].forEach((id) => (by(id).hidden = false));
  showReport(answer);
  draw();
  if (isFirst) move(view.toPlane([0.72 * view.scene.width, 0.3 * view.scene.height]));
  else showDistance();
}

// Rounds outward, so that the digits shown still contain the distance.
function roundedOutward(x, isUp, digits = 7) {
  const nearest = Number(x.toPrecision(digits));
  if (isUp ? nearest >= x : nearest <= x) return String(nearest);
  const exponent = Number(x.toExponential().split("e")[1]);
  const step = 10 ** (exponent - digits + 1);
  return String(Number((nearest + (isUp ? step : -step)).toPrecision(digits)));
}

// A word as a shell reads it.
function quoted(word) {
  return /^[\w.\/=:,+-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
}

function row(cells) {
  const line = document.createElement("tr");
  const cell = (text) => Object.assign(document.createElement("td"), { textContent: text });
  line.append(...cells.map(cell));
  return line;
}

function showReport({ notes, sections, tree, hulls, bytes, unit, options }) {
  const item = (text) => Object.assign(document.createElement("li"), { textContent: text });
  by("notes").replaceChildren(...notes.map(item));
  const count = (n) => n.toLocaleString("en");
  const of = sections.map(({ name, bytes }) => row([name, `${count(bytes)} bytes`]));
  by("sections").replaceChildren(...of, row(["blob", `${count(bytes)} bytes`]));
  by("tree").textContent =
    `${count(tree.triangles)} triangles, ${tree.is_closed ? "closed" : "open"}. ` +
    (tree.has_sides ? "" : "The triangles do not tell inside from outside. ") +
    `The stored surface is at most ${roundedOutward(tree.surface_error, true)} off the file's, ` +
    "and every interval includes that. " +
    `A query of the box tree takes ${count(tree.scratch_bytes)} bytes of scratch memory. ` +
    `Lengths are in ${unit ?? "the file's unit, which the file does not name"}.`;
  by("hulls").hidden = hulls.length === 0;
  by("hulls").tBodies[0].replaceChildren(
    ...hulls.map((hull) =>
      row([
        hull.faces,
        hull.void_percent === null ? "-" : roundedOutward(hull.void_percent, true),
        roundedOutward(hull.hull_to_mesh, true),
        roundedOutward(hull.mesh_to_hull, true),
        count(hull.bytes),
      ]),
    ),
  );
  const [file, blob] = [state.file.name, `${stem()}.msw`].map(quoted);
  by("command").textContent = `meshsweep build ${file} -o ${blob} ${options}`;
}

// Moves the point.
function move(place) {
  state.place = place;
  [...by("place").querySelectorAll("input")].forEach((field, axis) => (field.value = place[axis]));
  showDistance();
}

// What the box tree tells beside the distance.
function sentences({ side, point, triangle }) {
  const sides = {
    inside: "The point is inside. ",
    outside: "The point is outside. ",
    undecided: "It is undecided whether the point is inside. ",
  };
  const at = point.map((x) => Number(x.toPrecision(6))).join(", ");
  const on = triangle === null ? "" : ` on triangle ${triangle} of the file, counted from 0`;
  return `${sides[side] ?? ""}The closest point found is ${at}${on}.`;
}

// Asks the box tree and the hull for the distance of the point, and shows both answers. Returns the
// answer that is drawn.
function showDistance() {
  const { instance, place } = state;
  if (!instance || !place) return view.drawMarks(null);
  const [relative, steps] = ["relative", "steps"].map((id) => Number(by(id).value));
  by("found").textContent = "";
  const rows = [];
  let drawn = null;
  const hasHull = state.built.answer.hulls.length > 0;
  for (const [of, name] of [[0, "box tree"], [1, "tight hull"]].slice(0, hasHull ? 2 : 1)) {
    try {
      instance.call("closest", of, ...place, relative, steps);
      const found = instance.json();
      const { lower, upper, steps: nodes, ended } = found;
      const ends = [roundedOutward(lower, false), roundedOutward(upper, true)];
      rows.push(row([name, ...ends, nodes, ended]));
      if (of === Number(by("of").value) || !drawn) drawn = found;
      if (of === 0) by("found").textContent = sentences(found);
    } catch (error) {
      rows.push(row([name, error.message, "", "", ""]));
    }
  }
  by("answers").replaceChildren(...rows);
  view.drawMarks(place, drawn);
  return drawn;
}

function showTrade() {
  const { trade } = state;
  by("rows").hidden = by("legend").hidden = by("all").parentElement.hidden = !trade;
  const number = (x) => (x === null ? "-" : x.toLocaleString("en", { maximumFractionDigits: 0 }));
  const width = (x) => (x === null ? "-" : roundedOutward(x, true, 3));
  const shown = (trade?.rows ?? []).filter(({ is_best }) => is_best || by("all").checked);
  by("rows").tBodies[0].replaceChildren(
    ...shown.map((one) => {
      const { structure, dials, build, is_best, error, median } = one;
      const costs = [one.m4f, one.m0, one.flash, one.scratch].map(number);
      const cells = [width(error), width(median), ...costs];
      const line = row([`${structure}: ${dials}`, ...cells]);
      line.className = is_best ? "best" : "";
      line.title = build;
      return line;
    }),
  );
  const missing = trade?.not_built ?? [];
  const reasons = missing.map(({ structure, reason }) => `${structure}: ${reason}`);
  by("missing").textContent = reasons.length ? `Not built: ${reasons.join("; ")}` : "";
}

function measure() {
  return attempt(async () => {
    const { file } = state;
    const options = { points: Number(by("points").value), all: by("slow").checked };
    const { answer } = await tasks.run("trade", file, options);
    if (state.file !== file) throw new Cancelled();
    state.trade = answer;
    showTrade();
  });
}

// Saves the blob, or its source text: 0 Rust, 1 a C header, 2 C.
function save(what) {
  const { instance, built, file } = state;
  let content = built.blob;
  if (what !== "blob") {
    instance.call("source", Number(what), instance.write([file.name, `${stem()}.msw`]));
    content = instance.part(Part.text);
  }
  const extension = { blob: "msw", 0: "rs", 1: "h", 2: "c" }[what];
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([content]));
  link.download = `${stem()}.${extension}`;
  link.click();
  URL.revokeObjectURL(link.href);
}

function draw() {
  by("invite").hidden = state.file !== null;
  view.shown = { mesh: by("mesh").checked, hull: by("hull").checked };
  Object.assign(view, { cut: by("cut").checked, depth: Number(by("depth").value) });
  view.draw();
}

// Draws again after the view has changed. The point keeps its coordinates.
function redraw() {
  draw();
  showDistance();
}

// Moves the plane. The point moves with the plane, and keeps its pixel.
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
    if (!last) return state.instance && move(view.toPlane(here));
    const [x, y] = here.map((at, axis) => at - last[axis]);
    last = here;
    if (event.shiftKey) view.shift = view.shift.map((at, axis) => at + [x, y][axis]);
    else view.turn(x / 200 / devicePixelRatio, y / 200 / devicePixelRatio);
    redraw();
  });
  // A finger that only taps sets the point.
  marks.addEventListener("click", (event) => state.instance && move(view.toPlane(pixel(event))));
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
  ["relative", "steps", "of"].forEach((id) => by(id).addEventListener("input", showDistance));
  by("all").addEventListener("input", showTrade);
  by("place").addEventListener("submit", (event) => {
    event.preventDefault();
    move([...event.target.querySelectorAll("input")].map((field) => Math.fround(field.value)));
  });
  by("measure").addEventListener("click", measure);
  by("cancel").addEventListener("click", () => tasks.cancel());
  for (const button of document.querySelectorAll("[data-save]")) {
    button.addEventListener("click", () => attempt(() => save(button.dataset.save)));
  }
  const take = (file) =>
    file && attempt(async () => open(file.name, new Uint8Array(await file.arrayBuffer())));
  by("file").addEventListener("change", ({ target }) => {
    take(target.files[0]);
    // The same file can be opened again after it has changed.
    target.value = "";
  });
  by("faces").addEventListener("change", () => {
    const { file, built } = state;
    if (built) attempt(() => buildHull(file));
    else if (file) open(file.name, file.bytes);
  });
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
