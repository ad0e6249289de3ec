"use strict";
// The picture: the mesh and its hull by WebGL, and marks on a canvas above. The projection is
// parallel, so that the outline of a ball is a circle.

const VERTEX = `#version 300 es
in vec3 place;
uniform mat3 turn; // To right, up and towards the viewer.
uniform vec3 scale;
uniform vec2 middle;
out vec3 seen;
void main() {
  seen = turn * place;
  gl_Position = vec4(seen.xy * scale.xy + middle, -seen.z * scale.z, 1.0);
}`;

const FRAGMENT = `#version 300 es
precision highp float;
in vec3 seen;
uniform vec4 colour;
uniform vec4 inner;
uniform float nearest;
uniform bool isLit;
out vec4 pixel;
void main() {
  if (seen.z > nearest) discard;
  vec4 of = gl_FrontFacing ? colour : inner;
  // Flat, by the normal of the face.
  vec3 normal = normalize(cross(dFdx(seen), dFdy(seen)));
  float light = isLit ? 0.35 + 0.65 * max(dot(normal, vec3(0.27, 0.40, 0.87)), 0.0) : 1.0;
  pixel = vec4(of.rgb * light * of.a, of.a);
}`;

class View {
  constructor(scene, marks) {
    Object.assign(this, { scene, marks, pen: marks.getContext("2d") });
    this.gl = scene.getContext("webgl2", { antialias: true });
    if (!this.gl) throw new Error("The picture needs WebGL 2, and the browser has none.");
    Object.assign(this, { yaw: -0.9, pitch: 0.5, zoom: 1, shift: [0, 0], centre: [0, 0, 0] });
    Object.assign(this, { radius: 1, cut: false, depth: 0, surfaces: {}, shown: {} });
    this.prepare();
    // A lost context has lost its buffers.
    scene.addEventListener("webglcontextlost", (event) => event.preventDefault());
    scene.addEventListener("webglcontextrestored", () => {
      this.prepare();
      for (const [name, { surface }] of Object.entries(this.surfaces)) this.set(name, surface);
      this.draw();
    });
  }

  prepare() {
    const { gl } = this;
    this.program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(this.program, shader);
    }
    gl.linkProgram(this.program);
    if (!gl.getProgramParameter(this.program, gl.LINK_STATUS) && !gl.isContextLost()) {
      throw new Error(gl.getProgramInfoLog(this.program));
    }
    this.at = (name) => gl.getUniformLocation(this.program, name);
  }

  // Looks at a box from its least to its greatest corner.
  lookAt([low, high]) {
    this.centre = low.map((x, axis) => (x + high[axis]) / 2);
    this.radius = Math.hypot(...low.map((x, axis) => high[axis] - x)) / 2 || 1;
    Object.assign(this, { zoom: 1, shift: [0, 0], depth: 0 });
  }

  // Sends a surface to the graphics card, or takes it away.
  set(name, surface) {
    const { gl, centre } = this;
    const old = this.surfaces[name];
    if (old) {
      [old.vertices, old.faces, old.lines].forEach((buffer) => gl.deleteBuffer(buffer));
      gl.deleteVertexArray(old.array);
    }
    delete this.surfaces[name];
    if (!surface) return;
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    const send = (kind, data) => {
      const buffer = gl.createBuffer();
      gl.bindBuffer(kind, buffer);
      gl.bufferData(kind, data, gl.STATIC_DRAW);
      return buffer;
    };
    // Relative to the centre: single precision is finer there.
    const vertices = send(gl.ARRAY_BUFFER, surface.vertices.map((x, i) => x - centre[i % 3]));
    const place = gl.getAttribLocation(this.program, "place");
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, 3, gl.FLOAT, false, 0, 0);
    const faces = send(gl.ELEMENT_ARRAY_BUFFER, surface.triangles);
    const edges = name === "hull" ? View.edges(surface.triangles) : new Uint32Array();
    const lines = send(gl.ELEMENT_ARRAY_BUFFER, edges);
    this.surfaces[name] = { surface, array, vertices, faces, lines, lineEnds: edges.length };
  }

  // The ends of each edge. In a closed surface an edge occurs once in each direction.
  static edges(triangles) {
    const ends = [];
    for (let i = 0; i < triangles.length; i++) {
      const [a, b] = [triangles[i], triangles[i % 3 === 2 ? i - 2 : i + 1]];
      if (a < b) ends.push(a, b);
    }
    return Uint32Array.from(ends);
  }

  // Directions to the right, up and towards the viewer.
  axes() {
    const [sy, cy, sp, cp] =
      [Math.sin(this.yaw), Math.cos(this.yaw), Math.sin(this.pitch), Math.cos(this.pitch)];
    return [[-sy, cy, 0], [-sp * cy, -sp * sy, cp], [cp * cy, cp * sy, sp]];
  }

  // Pixels of the length 1.
  pixels() {
    const { width, height } = this.scene;
    return (0.42 * Math.min(width, height) * this.zoom) / this.radius;
  }

  // Where a point is drawn, in pixels of the canvas.
  toPixels(point) {
    const { width, height } = this.scene;
    const from = point.map((x, axis) => x - this.centre[axis]);
    const [x, y] = this.axes().map((axis) => axis.reduce((sum, a, i) => sum + a * from[i], 0));
    const scale = this.pixels();
    return [width / 2 + this.shift[0] + x * scale, height / 2 + this.shift[1] - y * scale];
  }

  // The point of the plane under a pixel.
  toPlane([x, y]) {
    const { width, height } = this.scene;
    const scale = this.pixels();
    const along = [
      (x - width / 2 - this.shift[0]) / scale,
      -(y - height / 2 - this.shift[1]) / scale,
      this.depth * this.radius,
    ];
    const axes = this.axes();
    const sum = (axis) => along.reduce((sum, length, k) => sum + length * axes[k][axis], 0);
    return this.centre.map((x, axis) => Math.fround(x + sum(axis)));
  }

  turn(x, y) {
    this.yaw -= x;
    this.pitch = Math.min(Math.max(this.pitch + y, -Math.PI / 2), Math.PI / 2);
  }

  // Zooms about a pixel.
  zoomAt([x, y], factor) {
    const zoom = Math.min(Math.max(this.zoom * factor, 0.1), 10000);
    const real = zoom / this.zoom;
    const middle = [x - this.scene.width / 2, y - this.scene.height / 2];
    this.shift = this.shift.map((s, i) => middle[i] - (middle[i] - s) * real);
    this.zoom = zoom;
  }

  resize() {
    const box = this.marks.getBoundingClientRect();
    for (const canvas of [this.scene, this.marks]) {
      canvas.width = Math.max(1, Math.round(box.width * devicePixelRatio));
      canvas.height = Math.max(1, Math.round(box.height * devicePixelRatio));
    }
  }

  // A colour of the style sheet.
  colour(name) {
    return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
  }

  // A colour of the style sheet as red, green, blue and opacity, from 0 to 1.
  numbers(name, opacity = 1) {
    this.pen.fillStyle = this.colour(name);
    const hex = this.pen.fillStyle;
    return [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16) / 255).concat(opacity);
  }

  draw() {
    const { gl, scene, at } = this;
    const { width, height } = scene;
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.useProgram(this.program);
    const axes = this.axes();
    gl.uniformMatrix3fv(at("turn"), false, [0, 1, 2].flatMap((i) => axes.map((axis) => axis[i])));
    const scale = 2 * this.pixels();
    gl.uniform3f(at("scale"), scale / width, scale / height, 0.5 / this.radius);
    gl.uniform2f(at("middle"), (2 * this.shift[0]) / width, (-2 * this.shift[1]) / height);
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    const { mesh, hull } = this.surfaces;
    if (mesh && this.shown.mesh) {
      gl.depthMask(true);
      // Pushed back a little, so that a hull that touches the mesh is drawn in front.
      gl.enable(gl.POLYGON_OFFSET_FILL);
      gl.polygonOffset(1, 2);
      this.paint(mesh, this.numbers("mesh"), this.numbers("inner"), this.cut);
      gl.disable(gl.POLYGON_OFFSET_FILL);
    }
    if (hull && this.shown.hull) {
      gl.depthMask(false);
      this.paint(hull, this.numbers("hull", 0.14), this.numbers("hull", 0.1), false);
      this.paint(hull, this.numbers("hull", 0.75), this.numbers("hull", 0.75), false, true);
      gl.depthMask(true);
    }
  }

  paint({ array, faces, lines, lineEnds, surface }, colour, inner, isCut, isLines = false) {
    const { gl, at } = this;
    gl.uniform4fv(at("colour"), colour);
    gl.uniform4fv(at("inner"), inner);
    gl.uniform1f(at("nearest"), isCut ? this.depth * this.radius : 1e30);
    gl.uniform1i(at("isLit"), isLines ? 0 : 1);
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, isLines ? lines : faces);
    const count = isLines ? lineEnds : surface.triangles.length;
    gl.drawElements(isLines ? gl.LINES : gl.TRIANGLES, count, gl.UNSIGNED_INT, 0);
  }

  // The point, the closest point found, and both ends of the distance as circles.
  drawMarks(place, found) {
    const { pen, marks } = this;
    pen.clearRect(0, 0, marks.width, marks.height);
    if (!place) return;
    const unit = devicePixelRatio;
    const middle = this.toPixels(place);
    if (found) {
      const circle = (length, colour, dash) => {
        pen.setLineDash(dash);
        pen.strokeStyle = this.colour(colour);
        pen.lineWidth = 2 * unit;
        pen.beginPath();
        pen.arc(...middle, length * this.pixels(), 0, 2 * Math.PI);
        pen.stroke();
      };
      circle(found.upper, "far", [6 * unit, 5 * unit]);
      circle(found.lower, "near", []);
      const end = this.toPixels(found.point);
      pen.setLineDash([]);
      pen.strokeStyle = this.colour("ink");
      pen.beginPath();
      pen.moveTo(...middle);
      pen.lineTo(...end);
      pen.stroke();
      this.dot(end, "hull");
    }
    this.dot(middle, "ink");
  }

  dot(place, colour) {
    const { pen } = this;
    pen.fillStyle = this.colour(colour);
    pen.strokeStyle = this.colour("paper");
    pen.lineWidth = 1.5 * devicePixelRatio;
    pen.beginPath();
    pen.arc(...place, 4.5 * devicePixelRatio, 0, 2 * Math.PI);
    pen.fill();
    pen.stroke();
  }
}
