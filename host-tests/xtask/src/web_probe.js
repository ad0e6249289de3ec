// Runs in the page of `cargo xtask web`, behind `const given`: opens files, moves the controls,
// looks whether pictures change, and returns what was made, in parts with | between them.
const seen = [];
const require = (is, what) => {
  if (!is) throw new Error(what);
  seen.push(what);
};
const until = async (is, what) => {
  for (let i = 0; i < 600; i++) {
    if (is()) return;
    if (!by("failed").hidden) throw new Error(by("failed").textContent);
    await new Promise((done) => setTimeout(done, 100));
  }
  throw new Error(`in a minute not ${what}`);
};
const bytesOf = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
const packed = (bytes) => btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""));
const plain = (text) => text.replaceAll(/["|\\]/g, "'").trim();

// Pixels of both pictures, read at once: the browser takes them away.
const pixels = () => {
  draw();
  const { gl, pen, marks } = view;
  const [width, height] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
  const scene = new Uint8Array(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, scene);
  const drawn = pen.getImageData(0, 0, marks.width, marks.height).data;
  return [new Uint32Array(scene.buffer), new Uint32Array(drawn.buffer)];
};
const changed = ([a, b], [c, d]) => [[a, c], [b, d]]
  .map(([one, other]) => one.reduce((count, x, i) => count + (x !== other[i]), 0));
const hover = (x, y) => {
  const [offsetX, offsetY] = [x * by("marks").clientWidth, y * by("marks").clientHeight];
  const { left, top } = by("marks").getBoundingClientRect();
  const at = { clientX: left + offsetX, clientY: top + offsetY, bubbles: true };
  by("marks").dispatchEvent(new PointerEvent("pointermove", at));
};

// Of two files the later one is shown.
const earlier = open("part.obj", new TextEncoder().encode(by("part.obj").textContent));
await Promise.all([earlier, open("part.stl", bytesOf(given.mesh))]);
await until(() => state.built?.answer.hulls.length === 1, "built");
require(state.file.name === "part.stl" && by("failed").hidden, "the later file is shown");
const colours = new Set(pixels()[0]).size;
require(colours > 50, `${colours} colours of the mesh and its hull`);

hover(0.3, 0.6);
const before = pixels();
const shown = by("answers").textContent;
hover(0.8, 0.2);
const [still, moved] = changed(before, pixels());
require(still === 0 && moved > 100, `hovering moves ${moved} pixels of marks`);
require(by("answers").textContent !== shown, "another distance");
const toggle = (id) => by(id).click();
for (const id of ["mesh", "hull", "cut"]) {
  const whole = pixels();
  toggle(id);
  const [without] = changed(whole, pixels());
  toggle(id);
  const [left] = changed(whole, pixels());
  require(without > 500 && left === 0, `${id} is ${without} pixels`);
}
const keys = [["ArrowLeft", false], ["ArrowUp", true], ["PageUp", false], ["+", false]];
for (const [key, shiftKey] of keys) {
  const [was, place] = [pixels(), state.place];
  by("marks").dispatchEvent(new KeyboardEvent("keydown", { key, shiftKey, cancelable: true }));
  const [turned, marked] = changed(was, pixels());
  const isSame = place.every((x, axis) => x === state.place[axis]);
  const moves = key === "ArrowLeft" || key === "PageUp";
  require(marked > 0 && isSame !== moves && turned > 500 !== moves, `key ${key} works`);
}
// Fewer nodes, a wider interval.
by("steps").value = "1";
const wide = showDistance();
by("steps").selectedIndex = 0;
const narrow = showDistance();
require(wide.lower <= narrow.lower && wide.upper - wide.lower > 2 * (narrow.upper - narrow.lower),
  "one node gives a wider interval");

// Another number of faces makes another hull. The point stays.
const stays = state.place;
for (const faces of [100, 200]) {
  by("faces").value = faces;
  by("faces").dispatchEvent(new Event("change"));
  await until(() => state.built.answer.hulls[0]?.faces === faces, "built anew");
}
require(state.place === stays, "other faces of the hull");

const roundings = [[0.12341, true, 3, "0.124"], [0.12349, false, 3, "0.123"], [1000.0001, true, 7,
  "1000.001"], [9.9996, false, 4, "9.999"], [-0.12341, true, 3, "-0.123"], [0, true, 3, "0"]];
for (const [x, isUp, digits, text] of roundings) {
  const found = roundedOutward(x, isUp, digits);
  if (found !== text) throw new Error(`${x} is rounded to ${found}`);
}

const answers = given.points.map((point) => {
  const fields = by("place").querySelectorAll("input");
  point.forEach((x, axis) => (fields[axis].value = x));
  by("place").requestSubmit();
  return showDistance().bits;
});
const blob = packed(state.built.blob);

// What the buttons save, without a folder.
const saved = [];
const { createObjectURL } = URL;
HTMLAnchorElement.prototype.click = function () {
  seen.push(this.download);
};
URL.createObjectURL = (content) => {
  saved.push(content);
  return createObjectURL(content);
};
document.querySelectorAll("[data-save]").forEach((button) => button.click());
URL.createObjectURL = createObjectURL;
const files = [];
for (const content of saved) files.push(packed(new Uint8Array(await content.arrayBuffer())));
require(files.length === 4 && files[0] === blob, "four files saved");

const [name, text] = given.broken;
await open(name, new TextEncoder().encode(text));
require(!by("failed").hidden, "a broken file is refused");
const refusal = plain(by("failed").textContent);

let rows = [];
if (given.isWhole) {
  by("sample").click();
  await until(() => state.built?.answer.hulls.length === 1, "built");
  require(by("failed").hidden, "the refusal is gone");
  by("points").value = 20;
  by("measure").click();
  await until(() => state.trade, "measured");
  rows = state.trade.rows.map(({ structure, dials, flash }) => [structure, dials, flash].join("/"));
  require(by("rows").tBodies[0].rows.length > 3, `${rows.length} rows of a trade`);
  // What is in the pictures.
  await open("part.stl", bytesOf(given.mesh));
  await until(() => state.built?.answer.hulls.length === 1, "built");
  hover(0.72, 0.3);
}
return [plain(seen.join("; ")), answers.join(";"), ...files, refusal, rows.join(";")].join("|");
