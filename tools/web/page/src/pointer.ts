// A ring about one point, seen through the blade.
import { BufferAttribute, BufferGeometry, Color, Points, ShaderMaterial } from "three";

export class Pointer {
  readonly ring: Points;
  private readonly place = new BufferAttribute(new Float32Array(3), 3);
  private readonly scale = { value: 1 };

  constructor(colour: string, size: number) {
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", this.place);
    this.ring = new Points(geometry, new ShaderMaterial({
      uniforms: { colour: { value: new Color(colour) }, scale: this.scale, size: { value: size } },
      depthTest: false,
      vertexShader: `uniform float scale, size;
        void main() { gl_PointSize = scale * size; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`,
      fragmentShader: `uniform vec3 colour;
        void main() {
          float off = length(2.0 * (gl_PointCoord - 0.5));
          if (off > 1.0 || off < 0.74) discard;
          gl_FragColor = vec4(colour, 1.0);
          #include <colorspace_fragment>
        }`,
    }));
    this.ring.frustumCulled = false;
    this.ring.renderOrder = 3;
    this.ring.visible = false;
  }

  // Slot -1: nowhere.
  show(places: Float32Array, slot: number, pixelRatio: number): void {
    this.ring.visible = slot >= 0;
    if (slot < 0) return;
    this.scale.value = pixelRatio;
    this.place.array.set(places.subarray(3 * slot, 3 * slot + 3));
    this.place.needsUpdate = true;
  }
}
