// The page: what the content becomes on the screen, the legend, and what mouse, fingers and keys do.

const kColours = { edge: "#3d434a", u: "#0072b2", v: "#00694d", ring: "#8a3b78", ridge: "#b83c00", zone: "#f0b429",
  point: "#ffffff", pointInZone: "#f0b429" };
const kZoneColours = ["#f0b429", "#d55e00", "#56b4e9", "#009e73", "#cc79a7", "#0072b2", "#e69f00", "#7f7f7f"];
const kTints = ["#d3dbe4", "#e2d8cb", "#d5e0d0", "#dfd3e2", "#e3e0c4", "#cbdee0"];
const kWidths = { edge: 1.6, u: 1.1, v: 1.1, ring: 1.7, ridge: 3.4 };
const kWords = { ridge: "ridges of greatest curvature", ring: "r/R, radius from the axis / tip radius", u: "lines of constant u",
  v: "lines of constant v", edge: "edges of the faces" };

const element = (tag, rest, parent) => { const made = Object.assign(document.createElement(tag), rest); if (parent) parent.append(made); return made; };
const bytes = (text) => Uint8Array.from(atob(text || ""), (c) => c.charCodeAt(0)).buffer;
const floats = (text) => new Float32Array(bytes(text));
const content = JSON.parse(document.getElementById("content").textContent);
const units = content.units;

function grid(mesh) {
  const u = floats(mesh.u), v = floats(mesh.v), triangles = [];
  for (let i = 0; i + 1 < u.length; ++i) for (let j = 0; j + 1 < v.length; ++j) {
    const a = i * v.length + j, b = a + v.length;
    triangles.push(a, b, b + 1, a, b + 1, a + 1);
  }
  return { patch: mesh.patch, zone: mesh.zone || 0, u, v, places: floats(mesh.places), normals: new Int8Array(bytes(mesh.normals)), triangles: new Uint32Array(triangles) };
}
const at = (numbers, k) => [numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2]];
const faces = content.faces.map(grid), zones = content.zones.map(grid);
const nameOf = (patch) => `patch ${patch}` + (content.names[patch] ? ` (${content.names[patch]})` : "");
const points = { places: floats(content.points.places), feet: floats(content.points.feet),
  numbers: new Uint32Array(bytes(content.points.numbers)), zone: new Uint8Array(bytes(content.points.zones)) };
points.zones = Float32Array.from(points.zone, (zone) => (zone > 0 ? 1 : 0));
const zoneNames = content.zone_names || [];
const zoneColour = (zone) => kZoneColours[(zone - 1 + kZoneColours.length) % kZoneColours.length];

// --- what is shown ---
let reach = 0;
for (const face of faces) for (let k = 0; k < face.places.length; k += 3) reach = Math.max(reach, Math.hypot(...at(face.places, k / 3)));
const view = (() => {
  try { return new View(document.getElementById("view"), document.getElementById("labels"), reach); }
  catch (error) { element("p", { id: "failure", textContent: error.message }, document.querySelector("main")); throw error; }
})();
const meshItem = (mesh, colour, over) => view.add("mesh", { place: [mesh.places, 3], normal: [mesh.normals, 3, view.gl.BYTE] },
  { triangles: mesh.triangles, colour: rgba(colour), over });
const faceItems = faces.map((mesh, k) => meshItem(mesh, kTints[k % kTints.length], false));
const zoneItems = zones.map((mesh) => meshItem(mesh, mesh.zone ? zoneColour(mesh.zone) : kColours.zone, true));
const lineItems = { edge: [], u: [], v: [], ring: [], ridge: [] };
for (const kind of Object.keys(lineItems)) for (const line of content.lines) {
  if (line.kind !== kind || !line.ends) continue;
  const ends = floats(line.ends);
  lineItems[kind].push(view.add("line", { a: [ends, 3, 0, 24, 0], b: [ends, 3, 0, 24, 12] },
    { count: ends.length / 6, colour: rgba(kColours[kind]), width: kWidths[kind], patch: line.patch, ahead: kind === "ridge" ? 0.004 : 0 }));
}
const pointItem = points.numbers.length ? view.add("point", { place: [points.places, 3], zone: [points.zones, 1] },
  { count: points.numbers.length, colour: rgba(kColours.point), other: rgba(kColours.pointInZone), width: 6.5 }) : null;

function addMarks(kind) {
  for (const line of content.lines) if (line.kind === kind && line.label) {
    view.marks.push({ label: line.label, place: line.place, normal: line.normal, colour: kColours[kind], bold: kind === "ridge",
      shift: kind === "ring" || kind === "ridge" ? 6 : 0, shown: () => lineItems[kind].some((item) => item.shown && item.patch === line.patch) });
  }
}
addMarks("ridge");
faces.forEach((face, k) => [0.3, 0.7].forEach((share) => {
  const place = Math.max(0, face.u.findIndex((u) => u >= share)) * face.v.length + Math.floor(0.42 * face.v.length);
  view.marks.push({ label: nameOf(face.patch), place: at(face.places, place), normal: unit(at(face.normals, place)), colour: "#1a1d21",
    bold: true, shift: 0, shown: () => faceItems[k].shown });
}));
["ring", "u", "v"].forEach(addMarks);

// --- where it is looked at from ---
const axis = content.axis.direction;
function firstLook() {
  const n0 = unit(at(faces[0].normals, Math.floor(faces[0].u.length * 0.3) * faces[0].v.length + (faces[0].v.length >> 1)));
  const sum = [0, 0, 0], middle = [0, 0, 0];
  let count = 0;
  for (const face of faces) for (let k = 0; k < face.places.length / 3; ++k, ++count) {
    const n = at(face.normals, k), sign = dot(n, n0) < 0 ? -1 : 1;
    for (let d = 0; d < 3; ++d) { sum[d] += sign * n[d]; middle[d] += face.places[3 * k + d]; }
  }
  const arm = minus(middle.map((x) => x / count), content.axis.point), along = dot(arm, axis);
  let up = arm.map((x, d) => x - along * axis[d]);  // away from the axis of the shaft
  if (Math.hypot(...up) < 0.05 * reach) up = axis;
  if (Math.hypot(...cross(unit(up), unit(sum))) < 0.1) up = [sum[1], sum[2], sum[0]];
  return { toward: unit(sum), up: unit(up) };
}
const first = firstLook();
const right = unit(cross(first.up, first.toward)), toward = cross(right, first.up);
function show(direction, up) { view.reset(); view.look(direction, up); view.draw(); }
const back = (a) => a.map((x) => -x);
const turns = { "Side 1": [toward, first.up], "Side 2": [back(toward), first.up], "Edge 1": [right, first.up], "Edge 2": [back(right), first.up],
  "Tip": [first.up, back(toward)] };
for (const [name, [direction, up]] of Object.entries(turns))
  element("button", { type: "button", textContent: name, onclick: () => show(direction, up) }, document.getElementById("turns"));

// --- legend ---
document.getElementById("units").textContent = `lengths in ${units === "in" ? "inches" : units}` + (content.radius > 0 ? ` · R = ${content.radius.toPrecision(6)} ${units}` : "");
const legend = document.getElementById("legend");
function entry(items, swatch, colour, words) {
  if (items.length === 0) return;
  const label = element("label", {}, legend);
  const box = element("input", { type: "checkbox", checked: true }, label);
  box.onchange = () => { for (const item of items) item.shown = box.checked; view.draw(); };
  const key = element("span", { className: swatch }, label);
  if (swatch === "key") key.style.borderColor = colour; else key.style.background = colour;
  element("span", { textContent: words }, label);
}
if (zoneNames.length === 0) entry(zoneItems, "patch", kColours.zone, "leading-edge zone");
zoneNames.forEach((name, k) => entry(zoneItems.filter((item, place) => zones[place].zone === k + 1), "patch", zoneColour(k + 1), `zone ${name}`));
for (const kind of ["ridge", "ring", "u", "v", "edge"]) entry(lineItems[kind], "key", kColours[kind], kWords[kind]);
if (pointItem) {
  const inZone = points.zones.reduce((sum, zone) => sum + zone, 0);
  entry([pointItem], "dot", kColours.point, `${points.numbers.length} points as measured, not fitted`);
  if (zones.length) { const label = element("label", {}, legend); element("span", { className: "dot" }, label).style.cssText = `background:${kColours.pointInZone};margin-left:26px`;
    element("span", { textContent: `of these ${inZone} in ${zoneNames.length ? "zones" : "the zone"}` }, label); }
}
element("h2", { textContent: "Faces" }, legend);
faces.forEach((face, k) => entry([faceItems[k]], "patch", kTints[k % kTints.length], nameOf(face.patch)));
if (content.notes.length) element("h2", { textContent: "Found" }, legend);
for (const note of content.notes) element("p", { className: "note", textContent: note }, legend);
element("h2", { textContent: "Use" }, legend);
element("p", { className: "note", textContent: "Drag: turn. Wheel or two fingers: zoom. Right button, Shift or two fingers: move. Point or tap: u, v and r/R of a place. Double click: as at first. Arrow keys, + and - work too." }, legend);
if (matchMedia("(max-width: 760px)").matches) legend.open = false;

// --- what is under the pointer ---
function triangleHit(x, y, corners) {
  const [a, b, c] = corners, whole = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  if (whole === 0) return null;
  const p = ((b[0] - x) * (c[1] - y) - (b[1] - y) * (c[0] - x)) / whole, q = ((c[0] - x) * (a[1] - y) - (c[1] - y) * (a[0] - x)) / whole;
  return p < 0 || q < 0 || p + q > 1 ? null : [p, q, 1 - p - q];
}
function placeAt(x, y) {
  let best = null;
  faces.forEach((face, k) => {
    if (!faceItems[k].shown) return;
    const seen = [];
    for (let i = 0; i < face.places.length / 3; ++i) seen.push(view.project(at(face.places, i)));
    for (let t = 0; t < face.triangles.length; t += 3) {
      const ids = face.triangles.subarray(t, t + 3), corners = [seen[ids[0]], seen[ids[1]], seen[ids[2]]];
      const shares = triangleHit(x, y, corners);
      if (!shares) continue;
      const mix = (value) => shares.reduce((sum, share, n) => sum + share * value(ids[n]), 0), depth = shares.reduce((sum, share, n) => sum + share * corners[n][2], 0);
      if (best && best.depth >= depth) continue;
      best = { depth, patch: face.patch, u: mix((id) => face.u[Math.floor(id / face.v.length)]), v: mix((id) => face.v[id % face.v.length]),
        place: [0, 1, 2].map((d) => mix((id) => face.places[3 * id + d])) };
    }
  });
  return best;
}
function pointAt(x, y) {
  let best = null, nearest = 9;
  if (!pointItem || !pointItem.shown) return null;
  for (let k = 0; k < points.numbers.length; ++k) {
    const seen = view.project(at(points.places, k)), distance = Math.hypot(seen[0] - x, seen[1] - y);
    if (distance < nearest && !(best && best.depth > seen[2] + 0.01 * reach)) { best = { k, depth: seen[2] }; nearest = distance; }
  }
  return best;
}
const readout = document.getElementById("readout");
const length = (x) => `${x.toPrecision(5)} ${units}`;
function tell(x, y) {
  const place = placeAt(x, y), point = pointAt(x, y);
  if (point && (!place || point.depth > place.depth - 0.02 * reach)) {
    const [patch, u, v, distance] = points.feet.subarray(4 * point.k, 4 * point.k + 4);
    readout.textContent = `point ${points.numbers[point.k]} · patch ${patch} · u ${u.toFixed(4)} · v ${v.toFixed(4)} · ${distance >= 0 ? "+" : "−"}${Math.abs(distance).toPrecision(3)} ${units} off the design${points.zone[point.k] ? " · " + (zoneNames[points.zone[point.k] - 1] || "leading-edge zone") : ""}`;
  } else if (place) {
    const arm = minus(place.place, content.axis.point), along = dot(arm, axis), radius = Math.hypot(...arm.map((c, d) => c - along * axis[d]));
    const shown = place.place.map((c, d) => (c + content.middle[d]).toPrecision(5));
    readout.textContent = `${nameOf(place.patch)} · u ${place.u.toFixed(4)} · v ${place.v.toFixed(4)} · r/R ${(radius / content.radius).toFixed(3)} (r ${length(radius)}) · x ${shown[0]} y ${shown[1]} z ${shown[2]} ${units}`;
  } else readout.textContent = "Point at the blade, or tap on it: patch, u, v and r/R of the place";
}

// --- mouse, fingers, keys ---
const held = new Map();
let moved = 0;
const canvas = view.canvas;
const inside = (event) => { const box = canvas.getBoundingClientRect(); return [event.clientX - box.left, event.clientY - box.top]; };
canvas.oncontextmenu = (event) => event.preventDefault();
canvas.onpointerdown = (event) => { canvas.setPointerCapture(event.pointerId); held.set(event.pointerId, inside(event)); moved = 0; };
canvas.onpointermove = (event) => {
  const now = inside(event), before = held.get(event.pointerId);
  if (!before) { if (event.pointerType === "mouse") requestAnimationFrame(() => tell(...now)); return; }
  const dx = now[0] - before[0], dy = now[1] - before[1];
  moved += Math.abs(dx) + Math.abs(dy);
  if (held.size === 2) {
    const other = [...held].find(([id]) => id !== event.pointerId)[1];
    const was = Math.hypot(before[0] - other[0], before[1] - other[1]), is = Math.hypot(now[0] - other[0], now[1] - other[1]);
    if (was > 0) view.zoomAt(is / was, (now[0] + other[0]) / 2, (now[1] + other[1]) / 2);
    view.pan = [view.pan[0] + dx / 2, view.pan[1] + dy / 2];
  } else if (event.buttons & 6 || event.shiftKey) view.pan = [view.pan[0] + dx, view.pan[1] + dy];
  else view.turn(-dx * 0.008, -dy * 0.008);
  held.set(event.pointerId, now);
  view.draw();
};
canvas.onpointerup = canvas.onpointercancel = (event) => { held.delete(event.pointerId); if (moved < 6) tell(...inside(event)); };
canvas.addEventListener("wheel", (event) => { event.preventDefault(); view.zoomAt(Math.exp(-event.deltaY * (event.deltaMode ? 0.05 : 0.0015)), ...inside(event)); view.draw(); }, { passive: false });
canvas.ondblclick = () => show(toward, first.up);
canvas.onkeydown = (event) => {
  const turn = { ArrowLeft: [0.1, 0], ArrowRight: [-0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] }[event.key];
  const [w, h] = view.sizes;
  if (turn) view.turn(...turn); else if (event.key === "+" || event.key === "=") view.zoomAt(1.2, w / 2, h / 2);
  else if (event.key === "-") view.zoomAt(1 / 1.2, w / 2, h / 2); else return;
  event.preventDefault();
  view.draw();
};
show(toward, first.up);
tell(-1, -1);
