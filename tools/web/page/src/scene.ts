// The camera, what turns it, and when it is drawn: only where something changed.
import { Color, DirectionalLight, HemisphereLight, OrthographicCamera, Scene, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { BladeFrame } from "./frame";

export type ViewName = "pressure" | "suction" | "edge";

const kTurn_ms = 350, kRest_ms = 60;

// Without a graphics card the processor draws: then less is drawn while the blade is turned.
function drawnByProcessor(): boolean {
  const gl = document.createElement("canvas").getContext("webgl2"), names = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = names ? String(gl?.getParameter(names.UNMASKED_RENDERER_WEBGL)) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

export class BladeScene {
  readonly scene = new Scene();
  readonly camera = new OrthographicCamera();
  // Called before each drawing.
  onDraw: () => void = () => {};
  private readonly renderer: WebGLRenderer;
  private readonly controls: OrbitControls;
  private readonly light = new DirectionalLight(0xffffff, 1.6);
  private reach = 1; // half of what is seen [mm]
  private frame: BladeFrame | null = null;
  private wanted = false;
  private drawn = 0; // when [ms]
  private held = false; // a mouse or a finger turns the blade
  private readonly byProcessor: boolean;
  private turn: { from: Vector3; to: Vector3; begun: number } | null = null;

  constructor(readonly canvas: HTMLCanvasElement) {
    this.byProcessor = drawnByProcessor();
    this.renderer = new WebGLRenderer({ canvas, antialias: !this.byProcessor });
    this.scene.background = new Color("#eef2f5");
    this.scene.add(new HemisphereLight(0xffffff, 0x8899a6, 1.6), this.camera);
    this.camera.add(this.light);
    this.light.position.set(0.4, 0.8, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", () => this.draw());
    this.controls.addEventListener("start", () => { this.turn = null; this.held = true; });
    this.controls.addEventListener("end", () => { this.held = false; this.draw(); });
    new ResizeObserver(() => this.resize()).observe(canvas);
  }

  // Looks at a blade of this size anew.
  show(frame: BladeFrame, halfDiagonal: number): void {
    this.frame = frame;
    this.reach = halfDiagonal;
    this.camera.up.copy(frame.up);
    this.camera.near = -4 * halfDiagonal;
    this.camera.far = 12 * halfDiagonal;
    this.view("suction", false);
    this.resize();
  }

  view(name: ViewName, slowly = true): void {
    if (!this.frame) return;
    const { suction, edge, up } = this.frame;
    const side = name === "edge" ? (edge ?? up.clone().cross(suction)) : suction.clone().multiplyScalar(name === "suction" ? 1 : -1);
    this.controls.target.set(0, 0, 0);
    this.camera.zoom = 1;
    this.camera.updateProjectionMatrix();
    this.lookFrom(side, slowly);
  }

  // Turns until one looks along -direction.
  lookFrom(direction: Vector3, slowly = true): void {
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    const from = this.camera.position.clone().sub(this.controls.target).normalize();
    this.turn = { from: from.lengthSq() > 0 ? from : direction.clone(), to: direction.clone().normalize(), begun: slowly && !still ? performance.now() : -Infinity };
    this.draw();
  }

  // Whether a side with this normal is seen.
  faces(normal: Vector3): boolean {
    return this.camera.position.clone().sub(this.controls.target).normalize().dot(normal) > 0.15;
  }

  draw(): void {
    if (this.wanted) return;
    this.wanted = true;
    // The processor has other things to do than to draw what has hardly changed.
    const wait = this.byProcessor && !this.hurried ? kRest_ms - (performance.now() - this.drawn) : 0;
    const drawNext = (): void => void requestAnimationFrame(() => {
      this.wanted = false;
      this.drawn = performance.now();
      this.step();
      this.onDraw();
      this.renderer.render(this.scene, this.camera);
    });
    if (wait > 0) setTimeout(drawNext, wait); else drawNext();
  }

  // Whether the next drawing is one of many, and each takes long.
  get hurried(): boolean { return this.byProcessor && (this.held || this.turn !== null); }

  get pixelRatio(): number { return this.renderer.getPixelRatio(); }

  private step(): void {
    if (!this.turn) return;
    const { from, to, begun } = this.turn;
    const share = Math.min((performance.now() - begun) / kTurn_ms, 1);
    const at = from.clone().lerp(to, share * share * (3 - 2 * share));
    if (at.lengthSq() < 1e-4) at.addScaledVector(this.frame?.up.clone().cross(to) ?? new Vector3(1, 0, 0), 0.1);
    this.camera.position.copy(at.normalize().multiplyScalar(4 * this.reach).add(this.controls.target));
    if (share >= 1) this.turn = null;
    this.controls.update();
    if (this.turn) this.draw();
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, this.byProcessor ? 1 : 2));
    this.renderer.setSize(width, height, false);
    const wide = Math.max(width / height, 1), high = Math.max(height / width, 1), reach = 0.72 * this.reach;
    Object.assign(this.camera, { left: -reach * wide, right: reach * wide, top: reach * high, bottom: -reach * high });
    this.camera.updateProjectionMatrix();
    this.draw();
  }
}
