// The page: what the host tells, drawn; what is clicked, told.
import "./page.css";
import { BladeScene, type ViewName } from "./scene";
import { Commands } from "./commands";
import { byId, make } from "./dom";
import { showDefects } from "./defects";
import { showFigures } from "./figures";
import { frameOf } from "./frame";
import { History } from "./history";
import { Marks } from "./marks";
import { meshOf } from "./blade_mesh";
import { Pointer } from "./pointer";
import { kColours, kLooks, kLookWords, kSigns } from "./looks";
import { Store } from "./store";
import { Stream } from "./stream";
import { Strip } from "./strip";
import { showTrouble, showVerdict } from "./verdict";
import type { Design, Piece, State } from "./types";
import { Group, Vector3 } from "three";
import { count } from "./words";

const kStripEvery_ms = 200, kPick_px = 18, kDrag_px = 4, kWhiskers = 0.09;
const kFactors = [0, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];

class Page {
  private state: State | null = null;
  private run = "";
  private begun = 0;
  private lost: number | null = null;
  private paused = false;
  private follow = false;
  private chosen = false; // whiskers are as long as somebody said
  private readonly waiting: Piece[] = []; // while paused
  private selected = 0; // sequence; 0: none
  private stripDue = false;
  private oldest = Infinity; // time of the oldest verdict that is not drawn yet [ms]
  private readonly store: Store;
  private readonly marks: Marks;
  private readonly strip: Strip;
  private readonly history: History;
  private readonly commands = new Commands();
  private readonly picked = new Pointer(kColours.selected, 26);
  private readonly newest = new Pointer(kColours.ink, 18);
  private scene: BladeScene | null = null;
  private mesh = new Group();

  constructor(private design: Design) {
    this.store = new Store(design);
    this.marks = new Marks(this.store);
    this.strip = new Strip(byId("chart"), this.store);
    this.strip.onPick = (slot) => this.select(slot);
    this.history = new History(this.store, () => this.begun);
    try {
      this.scene = new BladeScene(byId<HTMLCanvasElement>("canvas"));
    } catch {
      byId("no-view").hidden = false;
      byId("blade").classList.add("no-view");
    }
    this.scene?.scene.add(this.marks.group, this.picked.ring, this.newest.ring);
    if (this.scene) this.scene.onDraw = () => this.beforeDrawing();
    this.showDesign(design);
    this.addViews();
    this.addFlow();
    this.addLegend();
    this.addPicking();
  }

  // --- from the host ---
  hello(run: string, begun: number): void {
    this.begun = begun;
    const another = this.run !== "" && this.run !== run;
    this.run = run;
    document.body.dataset.run = run;
    if (another) void fetchDesign().then((design) => this.showDesign(design)).catch(() => undefined);
  }

  show(state: State): void {
    this.state = state;
    showVerdict(state);
    showTrouble(state, this.lostFor());
    showFigures(state, this.design.name);
    showDefects(state, (sequence) => this.go(sequence));
    this.commands.show(state);
    if (!this.chosen) this.fitFactor(state);
    this.drawStrip();
  }

  points(piece: Piece): void {
    if (this.paused) {
      if (piece.afresh) this.waiting.length = 0;
      this.waiting.push(piece);
      return this.tellFlow();
    }
    this.take(piece);
  }

  connection(since: number | null): void {
    this.lost = since;
    showTrouble(this.state, this.lostFor());
  }

  private lostFor(): number | null { return this.lost === null ? null : (Date.now() - this.lost) / 1000; }

  private take(piece: Piece): void {
    if (piece.afresh) this.store.clear(this.design);
    const oldest = this.store.add(piece);
    if (!piece.afresh) this.oldest = Math.min(this.oldest, oldest);
    document.body.dataset.points = String(this.store.count);
    if (this.follow) this.showNewest();
    this.scene?.draw();
    this.drawStrip();
  }

  // --- drawing ---
  private showDesign(design: Design): void {
    this.design = design;
    this.strip.limits = design.edge_limits;
    this.scene?.scene.remove(this.mesh);
    this.mesh = meshOf(design);
    this.scene?.scene.add(this.mesh);
    this.scene?.show(frameOf(design), design.half_diagonal);
    this.scene?.draw();
  }

  private beforeDrawing(): void {
    const ratio = this.scene!.pixelRatio, slot = this.slot();
    const newest = this.store.newest;
    this.marks.update(ratio, this.design.half_diagonal, this.scene!.hurried);
    this.picked.show(this.store.place, slot, ratio);
    this.newest.show(this.store.place, this.state?.ended ? -1 : newest, ratio);
    // How long after its verdict the oldest of the marks drawn anew is there [ms].
    if (this.oldest === Infinity) return;
    document.body.dataset.drawn = `${this.store.sequence[newest]} ${Math.round(Date.now() - this.begun - this.oldest)}`;
    this.oldest = Infinity;
  }

  private drawStrip(): void {
    if (this.stripDue) return;
    this.stripDue = true;
    setTimeout(() => {
      this.stripDue = false;
      this.strip.update(this.state, this.slot());
      void this.history.show(this.slot());
    }, kStripEvery_ms);
  }

  // --- what is clicked ---
  private slot(): number { return this.selected > 0 ? this.store.slotOf(this.selected) : -1; }

  private select(slot: number): void {
    this.selected = slot >= 0 ? this.store.sequence[slot] : 0;
    this.scene?.draw();
    this.strip.update(this.state, slot);
    void this.history.show(slot);
    if (slot >= 0 && matchMedia("(min-width: 851px)").matches) byId("point").scrollIntoView({ block: "nearest" });
  }

  private go(sequence: number): void {
    const slot = this.store.slotOf(sequence);
    this.select(slot);
    if (slot >= 0) this.turnTo(slot);
  }

  private turnTo(slot: number): void {
    const normal = new Vector3().fromArray(this.store.normal, 3 * slot);
    if (normal.lengthSq() > 0 && !this.scene?.faces(normal)) this.scene?.lookFrom(normal);
  }

  private showNewest(): void { if (this.store.newest >= 0) this.turnTo(this.store.newest); }

  private addPicking(): void {
    const canvas = byId<HTMLCanvasElement>("canvas");
    let down: [number, number] = [0, 0];
    canvas.addEventListener("pointerdown", (event) => { down = [event.clientX, event.clientY]; });
    canvas.addEventListener("pointerup", (event) => {
      if (!this.scene || Math.hypot(event.clientX - down[0], event.clientY - down[1]) > kDrag_px) return;
      const box = canvas.getBoundingClientRect();
      const x = (2 * (event.clientX - box.left)) / box.width - 1, y = 1 - (2 * (event.clientY - box.top)) / box.height;
      this.select(this.marks.pick(this.scene.camera, x, y, box.width, box.height, kPick_px));
    });
  }

  private addViews(): void {
    const views: [string, ViewName][] = [["Suction", "suction"], ["Pressure", "pressure"], ["Edge", "edge"]];
    for (const [label, name] of views) {
      const button = make("button", { type: "button", textContent: label });
      button.addEventListener("click", () => this.scene?.view(name));
      byId("views").append(button);
    }
  }

  private addFlow(): void {
    const toggle = (label: string, press: (on: boolean) => void): void => {
      const button = make("button", { type: "button", textContent: label });
      button.setAttribute("aria-pressed", "false");
      button.addEventListener("click", () => {
        const on = button.getAttribute("aria-pressed") !== "true";
        button.setAttribute("aria-pressed", String(on));
        press(on);
      });
      byId("flow").append(button);
    };
    toggle("Follow", (on) => { this.follow = on; if (on) this.showNewest(); });
    toggle("Pause", (on) => this.pause(on));
    const factor = make("select", { id: "factor" });
    factor.setAttribute("aria-label", "Length of whiskers");
    factor.append(...kFactors.map((step) => make("option", { value: String(step), textContent: step === 0 ? "no whiskers" : `whiskers × ${step}` })));
    factor.addEventListener("change", () => this.setFactor(Number(factor.value), true));
    byId("flow").append(factor, make("span", { id: "flow-note" }));
  }

  // Until somebody chooses, a whisker as long as the tolerance is a small part of the blade.
  private fitFactor(state: State): void {
    const fitting = (kWhiskers * this.design.half_diagonal) / (state.tolerance.edge ?? state.tolerance.rest ?? 0.3);
    const off = (step: number): number => Math.abs(Math.log(step / fitting));
    this.setFactor(kFactors.slice(1).reduce((best, step) => (off(step) < off(best) ? step : best)), false);
  }

  private setFactor(factor: number, chosen: boolean): void {
    if (factor === this.marks.factor && !chosen) return;
    this.chosen ||= chosen;
    this.marks.factor = factor;
    byId<HTMLSelectElement>("factor").value = String(factor);
    this.scene?.draw();
  }

  private pause(on: boolean): void {
    this.paused = on;
    if (!on) for (const piece of this.waiting.splice(0)) this.take(piece);
    this.tellFlow();
  }

  private tellFlow(): void {
    const changes = this.waiting.reduce((sum, piece) => sum + piece.rows.length / 13, 0);
    byId("flow-note").textContent = this.paused ? `points paused, ${count(changes)} changes wait` : "";
  }

  private addLegend(): void {
    const scale = make("span", { className: "scale", textContent: "within −tolerance … 0 … +tolerance" });
    const rows = kLooks.slice(1).map((look) => {
      const sign = make("span", { textContent: kSigns[look], className: "sign" });
      sign.style.color = kColours[look];
      return make("span", {}, [sign, ` ${kLookWords[look]}`]);
    });
    const zone = make("span", { textContent: "■", className: "sign" });
    zone.style.color = kColours.zone;
    byId("legend").append(scale, ...rows, make("span", {}, [zone, " leading-edge zone"]));
  }
}

async function fetchDesign(): Promise<Design> {
  const answer = await fetch("/api/design");
  if (!answer.ok) throw new Error(await answer.text());
  return (await answer.json()) as Design;
}

// Until the host answers for the first time.
async function begin(): Promise<void> {
  for (;;) {
    try {
      const page = new Page(await fetchDesign());
      new Stream({ hello: page.hello.bind(page), state: page.show.bind(page), points: page.points.bind(page), connection: page.connection.bind(page) });
      return;
    } catch (error) {
      byId("verdict-why").textContent = `The host does not answer (${String(error)}); trying again`;
      await new Promise((done) => setTimeout(done, 1000));
    }
  }
}

void begin();
