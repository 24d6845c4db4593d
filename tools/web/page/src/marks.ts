// Points and their whiskers, drawn from the arrays of the store. A whisker runs along the normal, so many times as long as
// the distance is; into the blade it is seen all the same, where its point is.
import { BufferAttribute, BufferGeometry, Camera, Color, DynamicDrawUsage, Group, LineSegments, Points, ShaderMaterial, Vector3 } from "three";
import { kColours, kLooks, kWithin, lookOf } from "./looks";
import type { Store } from "./store";

const kPointSize = 6, kLeastSize = 3, kOutSize = 13; // [px]
const kSparse = 6000; // points; more are drawn smaller
const kFewPoints = 4000; // within tolerance, where drawing takes long

// What colour a look has; within tolerance by the share of it that the distance takes.
const kTint = `
  uniform vec3 colours[6];
  uniform vec3 within[3];
  attribute float look;
  attribute float share;
  vec3 tint() {
    if (look > 0.5) return colours[int(look + 0.5)];
    return mix(within[1], share < 0.0 ? within[0] : within[2], min(abs(share), 1.0));
  }`;

const kPointVertex = `
  ${kTint}
  uniform float scale, size, lift;
  varying vec3 colour;
  varying float shape;
  void main() {
    shape = look;
    colour = tint();
    bool big = look > 0.5 && look < 3.5;
    gl_PointSize = scale * (big ? ${kOutSize.toFixed(1)} : size);
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position + lift * normal, 1.0);
    if (big) gl_Position.z -= 0.002 * gl_Position.w;
  }`;

// Shapes in the square from -1 to 1: how far inside, negative outside.
const kPointFragment = `
  varying vec3 colour;
  varying float shape;
  float inside(vec2 p) {
    if (shape < 0.5) return 1.0 - length(p);
    if (shape < 1.5) return min(p.y + 0.8, 0.85 - p.y - 1.8 * abs(p.x));
    if (shape < 2.5) return min(0.8 - p.y, 0.85 + p.y - 1.8 * abs(p.x));
    if (shape < 3.5) return 0.95 - abs(p.x) - abs(p.y);
    if (shape < 4.5) return 0.35 - abs(length(p) - 0.6);
    return 0.3 - min(abs(p.x - p.y), abs(p.x + p.y));
  }
  void main() {
    float depth = inside(vec2(2.0, -2.0) * (gl_PointCoord - 0.5));
    if (depth < 0.0) discard;
    bool rim = shape > 0.5 && shape < 3.5 && depth < 0.2;
    gl_FragColor = vec4(rim ? vec3(1.0) : colour, 1.0);
    #include <colorspace_fragment>
  }`;

const kLineVertex = `
  ${kTint}
  attribute vec3 offset;
  uniform float factor;
  varying vec3 colour;
  void main() {
    colour = tint() * 0.85;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position + factor * offset, 1.0);
    if ((normalMatrix * normal).z < 0.0) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
  }`;

const kLineFragment = `
  varying vec3 colour;
  void main() {
    gl_FragColor = vec4(colour, 1.0);
    #include <colorspace_fragment>
  }`;

type Attributes = Record<string, BufferAttribute>;

export class Marks {
  readonly group = new Group();
  factor = 0;
  private readonly uniforms = {
    colours: { value: kLooks.map((look) => new Color(kColours[look])) }, within: { value: kWithin.map((colour) => new Color(colour)) },
    scale: { value: 1 }, size: { value: kPointSize }, lift: { value: 0 }, factor: { value: 100 },
  };
  private readonly dots = new Points(new BufferGeometry(), new ShaderMaterial({ uniforms: this.uniforms, vertexShader: kPointVertex, fragmentShader: kPointFragment }));
  private readonly lines = new LineSegments(new BufferGeometry(), new ShaderMaterial({ uniforms: this.uniforms, vertexShader: kLineVertex, fragmentShader: kLineFragment, depthTest: false }));
  private dotData: Attributes = {};
  private lineData: Attributes = {};
  private room = 0;

  constructor(private readonly store: Store) {
    this.dots.frustumCulled = this.lines.frustumCulled = false;
    this.dots.renderOrder = 2;
    this.lines.renderOrder = 1;
    this.group.add(this.lines, this.dots);
  }

  // Takes over what changed, and what is to be drawn how.
  update(pixelRatio: number, halfDiagonal: number, few: boolean): void {
    this.uniforms.scale.value = pixelRatio;
    this.uniforms.size.value = Math.max(kLeastSize, kPointSize * Math.min(1, Math.sqrt(kSparse / Math.max(this.store.count, 1))));
    this.uniforms.lift.value = 0.001 * halfDiagonal;
    this.uniforms.factor.value = this.factor;
    let { first, end } = this.store.takeDirty();
    if (this.room !== this.store.room) {
      this.makeRoom();
      [first, end] = [0, this.store.count];
    }
    if (end > first) this.write(first, end);
    const thin = few && this.store.count > kFewPoints;
    if (thin && this.dots.geometry.index === null) this.dots.geometry.setIndex(this.fewOf());
    if (!thin) this.dots.geometry.setIndex(null);
    this.lines.visible = !thin && this.factor > 0;
    this.dots.geometry.setDrawRange(0, thin ? Infinity : this.store.count);
    this.lines.geometry.setDrawRange(0, 2 * this.store.count);
  }

  // All points that are not within tolerance, and some of the others.
  private fewOf(): BufferAttribute {
    const step = Math.ceil(this.store.count / kFewPoints), slots: number[] = [];
    for (let slot = 0; slot < this.store.count; ++slot) if (slot % step === 0 || lookOf(this.store.kind[slot]) !== "in") slots.push(slot);
    return new BufferAttribute(new Uint32Array(slots), 1);
  }

  private makeRoom(): void {
    this.room = this.store.room;
    const make = (geometry: BufferGeometry, columns: Record<string, number>, rows: number): Attributes => {
      geometry.dispose();
      const made: Attributes = {};
      for (const [name, size] of Object.entries(columns)) {
        made[name] = new BufferAttribute(new Float32Array(size * rows), size).setUsage(DynamicDrawUsage);
        geometry.setAttribute(name, made[name]);
      }
      return made;
    };
    this.dotData = make(this.dots.geometry, { position: 3, normal: 3, look: 1, share: 1 }, this.room);
    this.lineData = make(this.lines.geometry, { position: 3, normal: 3, offset: 3, look: 1, share: 1 }, 2 * this.room);
  }

  private write(first: number, end: number): void {
    const { place, normal, distance, tolerance, kind } = this.store;
    const dot = this.dotData, line = this.lineData;
    dot.position.array.set(place.subarray(3 * first, 3 * end), 3 * first);
    dot.normal.array.set(normal.subarray(3 * first, 3 * end), 3 * first);
    for (let slot = first; slot < end; ++slot) {
      const look = kLooks.indexOf(lookOf(kind[slot])), share = tolerance[slot] > 0 ? distance[slot] / tolerance[slot] : 0;
      dot.look.array[slot] = look;
      dot.share.array[slot] = share;
      for (let tip = 0; tip < 2; ++tip) {
        const row = 2 * slot + tip;
        line.look.array[row] = look;
        line.share.array[row] = share;
        for (let k = 0; k < 3; ++k) {
          line.position.array[3 * row + k] = place[3 * slot + k];
          line.normal.array[3 * row + k] = normal[3 * slot + k];
          line.offset.array[3 * row + k] = tip * distance[slot] * normal[3 * slot + k];
        }
      }
    }
    const send = (data: Attributes, from: number, to: number): void => {
      for (const attribute of Object.values(data)) {
        attribute.addUpdateRange(from * attribute.itemSize, (to - from) * attribute.itemSize);
        attribute.needsUpdate = true;
      }
    };
    send(dot, first, end);
    send(line, 2 * first, 2 * end);
  }

  // The slot nearest to a place on the screen (-1..1), of those that face the camera, within `reach` px; -1: none.
  pick(camera: Camera, x: number, y: number, width: number, height: number, reach: number): number {
    const matrix = camera.projectionMatrix.clone().multiply(camera.matrixWorldInverse);
    const towards = camera.getWorldDirection(new Vector3()), at = new Vector3();
    let best = -1, least = reach;
    for (let slot = 0; slot < this.store.count; ++slot) {
      const [nx, ny, nz] = this.store.normal.subarray(3 * slot, 3 * slot + 3);
      if (nx * towards.x + ny * towards.y + nz * towards.z > 0.1) continue;
      at.fromArray(this.store.place, 3 * slot).applyMatrix4(matrix);
      const off = Math.hypot(((at.x - x) * width) / 2, ((at.y - y) * height) / 2);
      if (off < least) [best, least] = [slot, off];
    }
    return best;
  }
}
