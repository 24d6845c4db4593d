"use strict";
// Draws triangles, lines and points through WebGL 2 as seen along parallel rays, and the labels beside them.

const kAhead = { line: 0.0006, point: 0.004 };  // how much nearer they are drawn, as a share of the depth

const kVertex = `
uniform mat3 turn; uniform vec3 pivot; uniform vec2 pan, size; uniform float scale, depth, ahead;
vec4 seen(vec3 place) {
  vec3 eye = turn * (place - pivot);
  return vec4((eye.xy * scale + pan) * 2.0 / size, -eye.z / depth - ahead, 1.0);
}`;
const kPrograms = {
  mesh: [`in vec3 place, normal; out vec3 n; void main() { n = turn * normal; gl_Position = seen(place); }`,
    `in vec3 n; uniform vec4 colour; out vec4 o;
     void main() { float light = 0.55 + 0.45 * abs(dot(normalize(n), normalize(vec3(0.25, 0.35, 1.0))));
       o = vec4(colour.rgb * light, 1.0); }`],
  line: [`in vec3 a, b; uniform float width; void main() {
       vec4 p = seen(a), q = seen(b); vec2 along = (q.xy - p.xy) * size; float l = length(along);
       along = l > 0.0 ? along / l : vec2(1.0, 0.0);
       vec2 side = vec2(-along.y, along.x) * ((gl_VertexID & 1) == 0 ? width : -width);
       vec4 end = (gl_VertexID & 2) == 0 ? p : q; vec2 cap = along * ((gl_VertexID & 2) == 0 ? -0.4 : 0.4) * width;
       gl_Position = vec4(end.xy + (side + cap) / size, end.zw); }`,
    `uniform vec4 colour; out vec4 o; void main() { o = colour; }`],
  point: [`in vec3 place; in float zone; uniform float width; flat out float z;
       void main() { z = zone; gl_Position = seen(place); gl_PointSize = width; }`,
    `flat in float z; uniform vec4 colour, other; out vec4 o;
     void main() { float r = 2.0 * length(gl_PointCoord - 0.5); if (r > 1.0) discard;
       o = r > 0.66 ? vec4(0.1, 0.11, 0.13, 1.0) : z > 0.5 ? other : colour; }`],
};

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const unit = (a) => { const l = Math.hypot(...a); return l > 0 ? a.map((x) => x / l) : a; };
const rgba = (hex) => [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16) / 255).concat(1);

class View {
  constructor(canvas, labels, reach) {
    this.canvas = canvas; this.labels = labels; this.reach = reach;  // reach: radius of all that is shown
    this.gl = canvas.getContext("webgl2", { antialias: true });
    if (!this.gl) throw new Error("This browser has no WebGL 2, which the page draws with; open it in another one.");
    this.text = labels.getContext("2d");
    this.programs = {};
    for (const [name, [vertex, fragment]] of Object.entries(kPrograms)) this.programs[name] = this.program(vertex, fragment);
    this.items = [];
    this.marks = [];
    this.rows = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];  // right, up and towards the viewer, in the design
    this.reset();
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  program(vertex, fragment) {
    const gl = this.gl, program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, kVertex + vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, "#version 300 es\nprecision highp float;\n" + text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error("WebGL: " + gl.getProgramInfoLog(program));
    return program;
  }

  // An item to be drawn: its arrays by attribute name, as [numbers, components, is normalised].
  add(kind, arrays, rest) {
    const gl = this.gl, item = { kind, shown: true, ...rest, array: gl.createVertexArray() };
    gl.bindVertexArray(item.array);
    for (const [name, [numbers, components, type, stride, start]] of Object.entries(arrays)) {
      const place = gl.getAttribLocation(this.programs[kind], name);
      if (place < 0) continue;
      if (!numbers.buffer3d) { numbers.buffer3d = gl.createBuffer();
        gl.bindBuffer(gl.ARRAY_BUFFER, numbers.buffer3d); gl.bufferData(gl.ARRAY_BUFFER, numbers, gl.STATIC_DRAW); }
      gl.bindBuffer(gl.ARRAY_BUFFER, numbers.buffer3d);
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, components, type || gl.FLOAT, type === gl.BYTE, stride || 0, start || 0);
      if (kind === "line") gl.vertexAttribDivisor(place, 1);
    }
    if (item.triangles) { gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, item.triangles, gl.STATIC_DRAW); }
    this.items.push(item);
    return item;
  }

  reset() { this.pivot = [0, 0, 0]; this.pan = [0, 0]; this.zoom = 1; }
  look(toward, up) {
    const z = unit(toward), x = unit(cross(up, z));
    this.rows = [x, cross(z, x), z];
  }
  turn(right, up) {  // [rad], about the axes of the screen
    const about = (a, b, angle) => { const c = Math.cos(angle), s = Math.sin(angle);
      return [a.map((x, k) => c * x + s * b[k]), b.map((x, k) => c * x - s * a[k])]; };
    let [x, y, z] = this.rows;
    [x, z] = about(x, z, right);
    [y, z] = about(y, z, -up);
    this.rows = [unit(x), unit(cross(z, x)), unit(z)];
  }

  get sizes() { return [this.canvas.clientWidth, this.canvas.clientHeight]; }
  get scale() { return 0.47 * Math.min(...this.sizes) / this.reach * this.zoom; }
  // Place on the screen, in its pixels from the upper left corner; depth towards the viewer.
  project(place) {
    const eye = this.rows.map((row) => dot(row, minus(place, this.pivot))), [w, h] = this.sizes;
    return [w / 2 + eye[0] * this.scale + this.pan[0], h / 2 - eye[1] * this.scale + this.pan[1], eye[2]];
  }
  zoomAt(factor, x, y) {
    const to = Math.min(400, Math.max(0.2, this.zoom * factor)), share = to / this.zoom, [w, h] = this.sizes;
    this.pan = [x - w / 2 - share * (x - w / 2 - this.pan[0]), y - h / 2 - share * (y - h / 2 - this.pan[1])];
    this.zoom = to;
  }

  draw() {
    if (this.waiting) return;
    this.waiting = requestAnimationFrame(() => { this.waiting = 0; this.drawNow(); });
  }
  drawNow() {
    const gl = this.gl, ratio = window.devicePixelRatio || 1, [w, h] = this.sizes;
    for (const canvas of [this.canvas, this.labels]) {
      if (canvas.width !== Math.round(w * ratio)) canvas.width = Math.round(w * ratio);
      if (canvas.height !== Math.round(h * ratio)) canvas.height = Math.round(h * ratio);
    }
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    gl.clearColor(1, 1, 1, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
    for (const item of this.items) if (item.shown) this.drawItem(item, ratio, w, h);
    this.drawMarks(ratio, w, h);
  }
  drawItem(item, ratio, w, h) {
    const gl = this.gl, program = this.programs[item.kind], at = (name) => gl.getUniformLocation(program, name);
    gl.useProgram(program);
    gl.uniformMatrix3fv(at("turn"), true, this.rows.flat());
    gl.uniform3fv(at("pivot"), this.pivot);
    gl.uniform2f(at("pan"), this.pan[0], -this.pan[1]);
    gl.uniform2f(at("size"), w, h);
    gl.uniform1f(at("scale"), this.scale);
    gl.uniform1f(at("depth"), 2 * this.reach);
    gl.uniform1f(at("ahead"), item.ahead || kAhead[item.kind] || 0);
    gl.uniform4fv(at("colour"), item.colour);
    if (item.other) gl.uniform4fv(at("other"), item.other);
    if (item.width) gl.uniform1f(at("width"), item.kind === "point" ? item.width * ratio : item.width);
    gl.bindVertexArray(item.array);
    if (item.kind === "line") gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, item.count);
    else if (item.kind === "point") gl.drawArrays(gl.POINTS, 0, item.count);
    else {
      (item.over ? gl.enable : gl.disable).call(gl, gl.POLYGON_OFFSET_FILL);
      gl.polygonOffset(-1, -2);
      gl.drawElements(gl.TRIANGLES, item.triangles.length, gl.UNSIGNED_INT, 0);
      gl.disable(gl.POLYGON_OFFSET_FILL);
    }
  }
  // Labels in the order of their importance: one that would lie on another is left out.
  drawMarks(ratio, w, h) {
    const text = this.text, taken = [];
    text.setTransform(ratio, 0, 0, ratio, 0, 0);
    text.clearRect(0, 0, w, h);
    text.textBaseline = "middle";
    text.lineJoin = "round";
    for (const mark of this.marks) {
      if (!mark.shown() || (mark.normal && dot(mark.normal, this.rows[2]) < 0.2)) continue;
      const [x, y] = this.project(mark.place), left = x + mark.shift;
      text.font = (mark.bold ? "600 13px " : "12px ") + "Segoe UI, Helvetica Neue, Arial, Liberation Sans, sans-serif";
      const width = text.measureText(mark.label).width, box = [left - 3, y - 9, left + width + 3, y + 9];
      if (box[0] < 0 || box[2] > w || box[1] < 0 || box[3] > h) continue;
      if (taken.some((t) => box[0] < t[2] && t[0] < box[2] && box[1] < t[3] && t[1] < box[3])) continue;
      taken.push(box);
      text.strokeStyle = "rgba(255,255,255,0.9)"; text.lineWidth = 4; text.strokeText(mark.label, left, y);
      text.fillStyle = mark.colour; text.fillText(mark.label, left, y);
    }
  }
}
