// Runs in a page of `meshsweep trade --report`: moves each of its controls, and looks whether the
// pictures change and come back. A promise of a text that tells what was seen.
(async () => {
  const seen = [];
  const require = (is, what) => {
    if (!is) throw new Error(what);
    seen.push(what);
  };
  const pause = () => new Promise((done) => setTimeout(done, 250));

  // The pixels of WebGL, read back; of other pictures the drawn paths.
  const shown = (id) => {
    const picture = document.getElementById(id);
    const scene = picture._fullLayout.scene?._scene.glplot;
    if (!scene) return [...picture.querySelectorAll("path")].map((path) => path.outerHTML);
    const { gl } = scene;
    const [width, height] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
    const pixels = new Uint8Array(4 * width * height);
    // At once, before the browser takes the pixels away.
    scene.redraw();
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    return [...new Uint32Array(pixels.buffer)];
  };
  const changed = (a, b) => a.filter((part, i) => part !== b[i]).length;
  const move = async (control, change) => {
    change(control);
    control.dispatchEvent(new Event("input", { bubbles: true }));
    await pause();
  };
  const drive = async (picture, id, change) => {
    const control = document.getElementById(id);
    const { value, checked } = control;
    const back = () => Object.assign(control, { value, checked });
    const before = shown(picture);
    await move(control, change);
    const count = changed(before, shown(picture));
    await move(control, back);
    const left = changed(before, shown(picture));
    require(count > 5 && left === 0, `${id} changes ${count} parts of ${picture}, ${left} stay`);
  };

  // Small, because a processor draws it here.
  Object.assign(document.getElementById("scene").style, { width: "400px", height: "300px" });
  await Plotly.Plots.resize("scene");
  await pause();
  require(getComputedStyle(document.getElementById("failed")).display === "none", "no failure");
  for (const [id, least] of [["cost", 50], ["bytes", 50], ["along", 10], ["scene", 500]]) {
    const count = new Set(shown(id)).size;
    require(count > least, `${id} has ${count} colours or paths`);
  }
  const other = (control) => {
    control.selectedIndex = control.selectedIndex === 1 ? 0 : 1;
  };
  await drive("cost", "board", other);
  await drive("bytes", "spread", other);
  await drive("along", "shown", other);
  await drive("scene", "cut", (control) => (control.value = "300"));
  await drive("scene", "axis", other);
  await drive("scene", "colour", other);
  for (const key of ["middles", "widths"]) {
    await drive("scene", "colour", (control) => (control.value = `field ${key}`));
  }
  for (const { id } of document.querySelectorAll("#bodies input")) {
    await drive("scene", id, (control) => (control.checked = !control.checked));
  }
  return seen.join("; ");
})()
