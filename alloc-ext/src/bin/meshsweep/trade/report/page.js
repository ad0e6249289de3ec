"use strict";
// Draws the page from its data. Nothing is asked of the network.

const byId = (id) => document.getElementById(id);
const data = JSON.parse(byId("data").textContent);
const unit = data.unit ? ` (${data.unit})` : "";
const length = (x) => (data.unit ? `${short(x)} ${data.unit}` : short(x));
const COLOURS = {
  "box tree": "#0072b2", sweep: "#d55e00", "tight hull": "#009e73", "cut level": "#cc79a7",
  triboxes: "#b8860b", "distance field": "#56b4e9", "field first": "#003f88",
};
const BODY_COLOURS = { mesh: "#9a9a9a", tight: "#009e73", triboxes: "#e69f00", level: "#cc79a7" };
const HEAT = [[0, "#f3efe0"], [0.5, "#f4a04a"], [1, "#a50f15"]];
const CONFIG = { displaylogo: false, responsive: true,
  modeBarButtons: [["toImage", "zoom2d", "pan2d", "resetScale2d"]] };
const CONFIG_3D = { ...CONFIG,
  modeBarButtons: [["toImage", "orbitRotation", "pan3d", "resetCameraDefault3d"]] };
const FONT = { size: 14, color: "#222" };

/** Shows a failure to the reader, who else would see an empty picture. */
function failed(reason) {
  byId("failed").style.display = "block";
  byId("failed").textContent = `This page could not be drawn: ${reason}`;
}
addEventListener("error", (event) => failed(event.message));
addEventListener("unhandledrejection", (event) => failed(event.reason));

const bytesOf = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));

/** A list of numbers of the data. */
function numbers({ f32, u32 }) {
  const { buffer } = bytesOf(f32 ?? u32);
  return f32 === undefined ? new Uint32Array(buffer) : new Float32Array(buffer);
}

const short = (x) => (x == null ? "–" : Number(x.toPrecision(3)).toString());

const familyOf = (row) => row.structure.split(",")[0];

const foundOf = (row, spread) =>
  Math.max(row.found_lower[spread], row.found_upper ? row.found_upper[spread] : 0);

function textOf(row) {
  const board = (i) => (row.instructions[i] ? Math.round(row.instructions[i].mean) : "–");
  const error = row.guaranteed
    ? `guaranteed ${short(row.guaranteed.most)}, median ${short(row.guaranteed.median)}`
    : "no upper end, so no interval";
  const found = `found ${short(foundOf(row, "most"))}, median ${short(foundOf(row, "median"))}`;
  return `<b>${row.structure}: ${row.dials}</b><br>${error}<br>${found}<br>instructions: ` +
    `M4F ${board(0)}, M0 ${board(1)}<br>blob ${row.flash} bytes, scratch ${row.scratch_bytes} bytes`;
}

const axis = (title, type, dtick) => ({
  title: { text: title, standoff: 8 }, type, dtick, automargin: true, gridcolor: "#e3e3e3",
  linecolor: "#888", zeroline: type !== "log", zerolinecolor: "#bbb", exponentformat: "power",
});

/** Error against a cost, both in powers of ten. */
function drawCost(id, title, costOf, spread) {
  const rows = data.trade.rows.filter((row) => costOf(row) > 0);
  const traces = [];
  for (const [family, color] of Object.entries(COLOURS)) {
    const own = rows.filter((row) => familyOf(row) === family);
    if (own.length === 0) continue;
    const points = (of, rows, extra) => ({
      x: rows.map(costOf), y: rows.map(of), text: rows.map(textOf), name: family,
      legendgroup: family, hovertemplate: "%{text}<extra></extra>", mode: "markers", ...extra,
    });
    const bounded = own.filter((row) => row.guaranteed && row.guaranteed[spread] > 0);
    const margin = bounded.map((row) => row.guaranteed[spread] - foundOf(row, spread));
    const ring = bounded.map((row) => (row.pareto ? 2.5 : 0));
    traces.push(points((row) => row.guaranteed[spread], bounded, {
      marker: { color, size: 11, line: { color: "#000", width: ring } }, showlegend: false,
      error_y: { type: "data", symmetric: false, array: margin.map(() => 0), arrayminus: margin,
        color, thickness: 1, width: 0 },
    }));
    const positive = own.filter((row) => foundOf(row, spread) > 0);
    traces.push(points((row) => foundOf(row, spread), positive,
      { marker: { color, size: 8, symbol: "circle-open" }, showlegend: false }));
    traces.push({ x: [null], y: [null], mode: "markers", name: family, legendgroup: family,
      marker: { color, size: 11 } });
  }
  const key = (name, marker) =>
    traces.push({ x: [null], y: [null], mode: "markers", name, marker, hoverinfo: "skip" });
  key("guaranteed", { color: "#888", size: 11 });
  key("found", { color: "#888", size: 8, symbol: "circle-open" });
  const ring = { color: "#fff", size: 11, line: { color: "#000", width: 2.5 } };
  key("nothing beats it (largest error, Cortex-M4F, flash)", ring);
  return Plotly.react(id, traces, {
    font: FONT, margin: { l: 70, r: 10, t: 10, b: 50 }, hovermode: "closest", uirevision: "kept",
    legend: { orientation: "h", y: -0.2, yanchor: "top" }, hoverlabel: { align: "left" },
    xaxis: axis(title, "log", "D2"), yaxis: axis(`error${unit}`, "log"),
  }, CONFIG);
}

async function drawCosts() {
  const [board, spread] = [Number(byId("board").value), byId("spread").value];
  const name = byId("board").selectedOptions[0].textContent;
  const instructions = (row) => (row.instructions[board] ? row.instructions[board].mean : 0);
  await drawCost("cost", `instructions of a ${name}, mean, predicted`, instructions, spread);
  await drawCost("bytes", "bytes of the blob", (row) => row.flash, spread);
  const exact = data.trade.rows.filter((row) => foundOf(row, spread) <= 0).length;
  byId("hidden").textContent =
    exact ? `${exact} settings have no open circle: their error found is 0.` : "";
}

const PATH_COLOURS = ["#0072b2", "#56b4e9", "#d55e00", "#009e73", "#cc79a7"];

function drawPath() {
  const { along, truth, settings } = data.path;
  const isDifference = byId("shown").value === "1";
  const less = (ends) => (isDifference ? ends.map((x, i) => x - truth[i]) : ends);
  const traces = [];
  settings.forEach(({ name, lower, upper }, i) => {
    const color = PATH_COLOURS[i];
    const end = (y, extra) => traces.push({ x: along, y, mode: "lines", legendgroup: name,
      line: { color, width: 1.5 }, ...extra });
    end(less(lower), { showlegend: false, name: `${name}, lower end` });
    end(less(upper), { fill: "tonexty", fillcolor: `${color}30`, name });
  });
  traces.push({ x: along, y: less(truth), mode: "lines", name: "true distance",
    line: { color: "#000", width: 2 } });
  return Plotly.react("along", traces, {
    font: FONT, margin: { l: 70, r: 10, t: 10, b: 50 }, hovermode: "x",
    legend: { orientation: "h", y: -0.2, yanchor: "top" },
    xaxis: axis(`length of the path so far${unit}`), uirevision: byId("shown").value,
    yaxis: axis(isDifference ? `end less true distance${unit}` : `distance${unit}`),
  }, CONFIG);
}

/** A body below a plane across an axis, and the line where the plane cuts it. */
function clipped({ positions, triangles }, values, across, most) {
  const [x, y, z] = [[], [], []], [i, j, k] = [[], [], []], kept = [];
  const cut = [[], [], []];
  const number = new Map();
  const add = (p) => (x.push(p[0]), y.push(p[1]), z.push(p[2]) - 1);
  const at = (v) => [positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]];
  const old = (v) => {
    if (!number.has(v)) number.set(v, add(at(v)));
    return number.get(v);
  };
  const meet = (u, v) => {
    const [p, q] = [at(u), at(v)];
    const part = (most - p[across]) / (q[across] - p[across]);
    return p.map((c, n) => c + part * (q[n] - c));
  };
  const face = (a, b, c, value) => (i.push(a), j.push(b), k.push(c), kept.push(value));
  for (let t = 0; t < triangles.length; t += 3) {
    let corners = [triangles[t], triangles[t + 1], triangles[t + 2]];
    const value = values ? values[t / 3] : 0;
    const isIn = (v) => positions[3 * v + across] <= most;
    const inside = corners.filter(isIn).length;
    if (inside === 3) face(...corners.map(old), value);
    if (inside === 0 || inside === 3) continue;
    // The corner that is alone on its side comes first.
    while (isIn(corners[0]) !== (inside === 1)) corners = [corners[1], corners[2], corners[0]];
    const [a, b, c] = corners;
    const [p, q] = [meet(a, b), meet(a, c)];
    const [s, u] = [add(p), add(q)];
    if (inside === 1) face(old(a), s, u, value);
    else { face(s, old(b), old(c), value); face(s, old(c), u, value); }
    p.forEach((_, n) => cut[n].push(p[n], q[n], null));
  }
  return { x, y, z, i, j, k, kept, cut };
}

/** The slice of the distance field that is nearest to a plane, coloured by one of its numbers. */
function sliceOf(field, key, across, most) {
  const { low, high, slices, side } = field;
  const at = (axis, step, of) => low[axis] + ((step + 0.5) / of) * (high[axis] - low[axis]);
  const part = (most - low[across]) / (high[across] - low[across]);
  const slice = Math.min(slices - 1, Math.max(0, Math.floor(part * slices)));
  const steps = Array.from({ length: side }, (_, step) => step);
  const grid = (of) => steps.map((row) => steps.map((column) => of(row, column)));
  const first = (across * slices + slice) * side * side;
  const axes = [0, 1, 2].map((axis) => grid((row, column) => {
    if (axis === across) return at(axis, slice, slices);
    return at(axis, axis === (across + 1) % 3 ? row : column, side);
  }));
  const surfacecolor = grid((row, column) => field[key][first + row * side + column]);
  const all = field[key].reduce((most, x) => Math.max(most, Math.abs(x)), 0);
  const signed = key === "middles";
  return { type: "surface", uid: `slice-${key}`, x: axes[0], y: axes[1], z: axes[2], surfacecolor,
    cmin: signed ? -all : 0, cmax: all, colorscale: signed ? "RdBu" : HEAT, reversescale: signed,
    colorbar: { title: { text: `length${unit}`, side: "right" }, len: 0.7, thickness: 16,
      exponentformat: "power" },
    name: field.name, hoverinfo: "name", contours: { x: { highlight: false },
      y: { highlight: false }, z: { highlight: false } },
    lighting: { ambient: 1, diffuse: 0, specular: 0 } };
}

const isOn = (key) => byId(`is-${key}`).checked;

function drawScene() {
  const { bodies, worst, low, high } = data.scene;
  const across = Number(byId("axis").value);
  const part = Number(byId("cut").value) / 1000;
  const most = part === 1 ? Infinity : low[across] + part * (high[across] - low[across]);
  byId("at").textContent =
    part === 1 ? "nothing is cut away" : `${"xyz"[across]} = ${length(most)}`;
  const [painted, index] = byId("colour").value.split(" ");
  const traces = [];
  for (const body of bodies.filter(({ key }) => isOn(key))) {
    const colour = body.key === painted ? body.colours[Number(index)] : null;
    const { x, y, z, i, j, k, kept, cut } = clipped(body, colour?.values, across, most);
    const isGlass = body.key !== "mesh" && !colour;
    const paint = colour
      ? { intensity: kept, intensitymode: "cell", colorscale: HEAT, cmin: 0, cmax: colour.most,
        colorbar: { title: { text: `length${unit}`, side: "right" }, len: 0.7, thickness: 16,
          exponentformat: "power" } }
      : { color: BODY_COLOURS[body.key] };
    // With a number of its own for each colouring: a body keeps its colours when they change.
    traces.push({ type: "mesh3d", uid: `${body.key}-${colour ? index : "plain"}`, x, y, z, i, j, k,
      name: body.name, ...paint, flatshading: true,
      opacity: isGlass ? 0.25 : 1, hoverinfo: "name",
      lighting: { ambient: 0.55, diffuse: 0.7, specular: 0.05, facenormalsepsilon: 0 } });
    traces.push({ type: "scatter3d", mode: "lines", x: cut[0], y: cut[1], z: cut[2],
      line: { color: body.key === "mesh" ? "#000" : BODY_COLOURS[body.key], width: 5 },
      hoverinfo: "skip" });
  }
  if (painted === "field") {
    const plane = part === 1 ? (low[across] + high[across]) / 2 : most;
    traces.push(sliceOf(data.field, index, across, plane));
  }
  const line = (points, extra) => traces.push({ type: "scatter3d", x: points.map((p) => p[0]),
    y: points.map((p) => p[1]), z: points.map((p) => p[2]), ...extra });
  if (isOn("path")) {
    line(data.path.points, { mode: "lines", line: { color: "#000", width: 4 }, name: "the path" });
  }
  if (isOn("worst")) {
    for (const { name, query, point, number } of worst) {
      line([query, point], { mode: "lines+markers+text", text: [number, ""], name,
        hoverinfo: "name", textfont: { size: 18 }, textposition: "top center",
        line: { color: "#d00000", width: 4 }, marker: { color: "#d00000", size: [7, 3] } });
    }
  }
  const side = (title) => ({ title: { text: title }, backgroundcolor: "#fff" });
  return Plotly.react("scene", traces, {
    font: { size: 13, color: "#222" }, margin: { l: 0, r: 0, t: 0, b: 0 }, showlegend: false,
    uirevision: "kept", hoverlabel: { namelength: -1 },
    scene: { aspectmode: "data", xaxis: side("x"), yaxis: side("y"), zaxis: side("z"),
      camera: { eye: { x: 1.3, y: -1.5, z: 1 } } },
  }, CONFIG_3D);
}

/** Reads the scene's numbers, and makes its switches. */
function prepareScene() {
  const { bodies, worst } = data.scene;
  for (const body of bodies) {
    [body.positions, body.triangles] = [numbers(body.positions), numbers(body.triangles)];
    body.colours.forEach((colour, i) => {
      colour.values = numbers(colour.values);
      colour.most = colour.values.reduce((most, x) => Math.max(most, x), 0);
      byId("colour").add(new Option(colour.name, `${body.key} ${i}`));
    });
  }
  if (data.field) {
    for (const [key, by] of [["middles", "distance"], ["widths", "interval's width"]]) {
      data.field[key] = numbers(data.field[key]);
      byId("colour").add(new Option(`a slice of the ${data.field.name}, by its ${by}`,
        `field ${key}`));
    }
  }
  byId("colour").add(new Option("none", "none 0"));
  const { positions } = bodies[0];
  const along = (n) => positions.filter((_, i) => i % 3 === n);
  const end = (n, of) => along(n).reduce((a, b) => of(a, b));
  data.scene.low = [0, 1, 2].map((n) => end(n, Math.min));
  data.scene.high = [0, 1, 2].map((n) => end(n, Math.max));
  const add = (key, text, checked) => {
    const label = document.createElement("label");
    const box = Object.assign(document.createElement("input"),
      { type: "checkbox", id: `is-${key}`, checked });
    label.append(box, ` ${text}`);
    byId("bodies").append(label);
  };
  // First the tight hull, cut open across the longest axis: the mesh shows inside.
  const extents = [0, 1, 2].map((n) => data.scene.high[n] - data.scene.low[n]);
  byId("axis").value = String(extents.indexOf(Math.max(...extents)));
  byId("cut").value = "600";
  if (bodies.some(({ key }) => key === "tight")) byId("colour").value = "tight 0";
  bodies.forEach(({ key, name }) => add(key, name, key === "mesh" || key === "tight"));
  add("path", "the path", false);
  add("worst", "the worst queries", true);
  worst.forEach((query, i) => {
    query.number = String(i + 1);
    const cost = query.key === "costliest"
      ? `about ${Math.round(query.instructions)} instructions on a Cortex-M4F`
      : `${length(query.width)} wide`;
    byId("worst").append(Object.assign(document.createElement("li"), {
      textContent: `${query.name}, ${cost}, ${short(query.times)} times the mean of random ` +
        `queries, at ${query.query.map(short).join(", ")}`,
    }));
  });
  if (bodies.some((body) => body.is_coarse)) {
    byId("coarse").textContent = "The picture shows at most 50,000 triangles of a body: vertices " +
      "that lie close together are drawn as one. Colours are of the drawn triangles, all other " +
      "numbers of the whole mesh.";
  }
}

/** Draws anew once the browser is ready, however often a control moves until then. */
function whenMoved(ids, draw) {
  let asked = 0;
  const ask = () => {
    cancelAnimationFrame(asked);
    asked = requestAnimationFrame(draw);
  };
  ids.forEach((id) => byId(id).addEventListener("input", ask));
}

async function main() {
  const { trade } = data;
  document.title = `${data.name}: meshsweep trade`;
  byId("title").textContent = `${data.name}: the trade of error for instructions and bytes`;
  byId("about").textContent = `${data.triangles} triangles, diagonal ${length(trade.diagonal)}. ` +
    `Errors were measured at ${trade.points} points ${trade.kind}. ` +
    (data.unit ? "" : "Lengths are in the unit of the file, which does not tell it.");
  byId("command").textContent = data.command;
  byId("program").textContent = `version ${data.program}`;
  const packed = new Blob([bytesOf(byId("library").textContent)]).stream();
  const unpacked = packed.pipeThrough(new DecompressionStream("gzip"));
  const library = document.createElement("script");
  library.textContent = await new Response(unpacked).text();
  document.head.append(library);
  prepareScene();
  await drawCosts();
  await drawPath();
  await drawScene();
  whenMoved(["board", "spread"], drawCosts);
  whenMoved(["shown"], drawPath);
  const switches = [...byId("bodies").querySelectorAll("input")].map(({ id }) => id);
  whenMoved([...switches, "colour", "axis", "cut"], drawScene);
}

/** Settled when all is drawn. */
const drawn = main();
