// The leading edge unrolled: distance against r/R, with the band of its tolerance and what is known of each place below.
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { kCellLooks, kColours, kLooks, lookOf, type Look } from "./looks";
import type { Store } from "./store";
import type { EdgeLimits, State } from "./types";

const kHeight = 190, kCellHeight = 9, kReach_px = 14;
const kMostTolerances = 6; // beyond it points stand at the border

const kSizes: Record<Look, number> = { in: 2, cut: 5, weld: 5, undecided: 4, pending: 3, rejected: 3 };

function shapeInto(path: CanvasRenderingContext2D, look: Look, x: number, y: number, size: number): void {
  if (look === "cut" || look === "weld") {
    const up = look === "cut" ? -1 : 1;
    path.moveTo(x, y + up * size);
    path.lineTo(x - size, y - up * size);
    path.lineTo(x + size, y - up * size);
    path.closePath();
  } else if (look === "undecided") {
    path.moveTo(x, y - size);
    path.lineTo(x + size, y);
    path.lineTo(x, y + size);
    path.lineTo(x - size, y);
    path.closePath();
  } else {
    path.arc(x, y, size, 0, 2 * Math.PI);
  }
}

export class Strip {
  onPick: (slot: number) => void = () => {};
  limits: EdgeLimits[] = []; // by zone; empty: the same all along
  private readonly chart: uPlot;
  private state: State | null = null;
  private selected = -1;
  private drawn = "";
  private reach = 1; // of the distances shown [mm]
  private edges: [number, number] = [0, 1]; // r/R

  constructor(holder: HTMLElement, private readonly store: Store) {
    const axis = { stroke: kColours.ink, grid: { stroke: "#dde4ea", width: 1 }, ticks: { stroke: "#aab6c0", width: 1 }, font: "13px system-ui, sans-serif", labelFont: "13px system-ui, sans-serif" };
    this.chart = new uPlot({
      width: Math.max(holder.clientWidth, 200), height: kHeight, legend: { show: false },
      cursor: { drag: { x: false, y: false }, points: { show: false } },
      scales: { x: { time: false, range: () => this.edges }, y: { range: () => [-this.reach, this.reach] } },
      series: [{}, { paths: () => null, points: { show: false } }],
      axes: [
        { ...axis, label: "r/R, root to tip", labelSize: 18, size: 30, space: 60 },
        { ...axis, label: "distance, mm", labelSize: 18, size: 50, space: 28 },
      ],
      padding: [8, 14, 0, 0],
      hooks: { drawClear: [(chart) => this.drawBand(chart)], draw: [(chart) => this.drawPoints(chart)] },
    }, [[0, 1], [0, 0]], holder);
    new ResizeObserver(() => this.chart.setSize({ width: Math.max(holder.clientWidth, 200), height: kHeight })).observe(holder);
    this.chart.over.addEventListener("click", (event) => this.pick(event));
  }

  update(state: State | null, selected: number): void {
    // What would look the same is not drawn again.
    const look = JSON.stringify([this.store.version, selected, state?.tolerance.edge, state?.blade.edge, state?.blade.edge_tip]);
    if (look === this.drawn) return;
    this.drawn = look;
    this.state = state;
    this.selected = selected;
    if (state && state.blade.tip > 0 && state.blade.edge_tip > state.blade.edge_root)
      this.edges = [state.blade.edge_root / state.blade.tip - 0.01, Math.max(state.blade.edge_tip / state.blade.tip, 1) + 0.01];
    const tolerance = Math.max(0, ...this.bands().flatMap((band) => [band.plus ?? 0, band.minus ?? 0]));
    let most = 1.6 * tolerance;
    for (const slot of this.store.edge()) most = Math.max(most, 1.25 * Math.abs(this.store.distance[slot]));
    this.reach = tolerance > 0 ? Math.min(most, kMostTolerances * tolerance) : most || 1;
    this.chart.redraw(true, true);
  }

  private bands(): EdgeLimits[] {
    const tolerance = this.state?.tolerance.edge ?? 0, [from, to] = this.edges;
    return this.limits.length > 0 ? this.limits : tolerance > 0 ? [{ from, to, plus: tolerance, minus: tolerance }] : [];
  }

  // Where a band stands on the canvas: its sides, then its limits; a side that is not judged is open.
  private boxOf(chart: uPlot, band: EdgeLimits): [number, number, number, number] {
    const x = (ratio: number): number => chart.valToPos(Math.min(Math.max(ratio, this.edges[0]), this.edges[1]), "x", true);
    const y = (distance: number): number => chart.valToPos(distance, "y", true), far = 2 * this.reach;
    return [x(band.from), x(band.to), y(band.plus ?? far), y(-(band.minus ?? far))];
  }

  private drawBand(chart: uPlot): void {
    const { left, top, width, height } = chart.bbox;
    chart.ctx.save();
    chart.ctx.beginPath();
    chart.ctx.rect(left, top, width, height);
    chart.ctx.clip();
    chart.ctx.fillStyle = "#f3f5f7";
    chart.ctx.fillRect(left, top, width, height);
    chart.ctx.fillStyle = "#d6ebe3";
    for (const band of this.bands()) {
      const [from, to, above, below] = this.boxOf(chart, band);
      chart.ctx.fillRect(from, above, to - from, below - above);
    }
    chart.ctx.restore();
  }

  private drawPoints(chart: uPlot): void {
    const { ctx, bbox } = chart, scale = devicePixelRatio;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    ctx.strokeStyle = kColours.ink;
    ctx.lineWidth = scale;
    ctx.setLineDash([5 * scale, 4 * scale]);
    for (const band of this.bands()) {
      const [from, to, above, below] = this.boxOf(chart, band);
      for (const y of [above, below]) ctx.stroke(new Path2D(`M${from} ${y}H${to}`));
    }
    ctx.setLineDash([]);
    this.drawCells(chart, scale);
    this.drawShapes(ctx, bbox.left + bbox.width, scale);
    if (this.selected >= 0 && this.selected < this.store.count) {
      const ring = new Path2D(), [x, y] = this.placeOf(this.selected);
      ring.arc(x, y, 9 * scale, 0, 2 * Math.PI);
      ctx.strokeStyle = kColours.selected;
      ctx.lineWidth = 2.5 * scale;
      ctx.stroke(ring);
    }
    ctx.restore();
  }

  // Those within tolerance below the others. What falls upon a place that has the same shape already is not drawn: there
  // may be tens of thousands.
  private drawShapes(ctx: CanvasRenderingContext2D, width: number, scale: number): void {
    const places = new Map<Look, Set<number>>(kLooks.map((look) => [look, new Set()]));
    const across = Math.ceil(width);
    for (const slot of this.store.edge()) {
      const [x, y] = this.placeOf(slot);
      places.get(lookOf(this.store.kind[slot]))!.add(Math.round(y) * across + Math.round(x));
    }
    for (const [look, taken] of places) {
      ctx.fillStyle = ctx.strokeStyle = kColours[look];
      ctx.lineWidth = scale;
      const size = kSizes[look] * scale;
      for (const at of taken) {
        const x = at % across, y = Math.floor(at / across);
        if (look === "in") {
          ctx.fillRect(x - size / 2, y - size / 2, size, size);
          continue;
        }
        ctx.beginPath();
        shapeInto(ctx, look, x, y, size);
        if (look === "pending" || look === "rejected") ctx.stroke(); else ctx.fill();
      }
    }
  }

  // Where a point stands on the canvas; one beyond the limits at the border.
  private placeOf(slot: number): [number, number] {
    const limit = 0.97 * this.reach, distance = Math.min(Math.max(this.store.distance[slot], -limit), limit);
    return [this.chart.valToPos(this.store.ratio[slot], "x", true), this.chart.valToPos(distance, "y", true)];
  }

  private drawCells(chart: uPlot, scale: number): void {
    const blade = this.state?.blade;
    if (!blade || !(blade.edge_tip > blade.edge_root)) return;
    const bottom = chart.bbox.top + chart.bbox.height, height = kCellHeight * scale;
    const at = (cell: number): number =>
      chart.valToPos((blade.edge_root + (cell / blade.edge.length) * (blade.edge_tip - blade.edge_root)) / blade.tip, "x", true);
    blade.edge.forEach((cell, k) => {
      const look = kCellLooks[cell];
      chart.ctx.fillStyle = look ? kColours[look] : "#ffffff";
      chart.ctx.fillRect(at(k), bottom - height, at(k + 1) - at(k), height);
      chart.ctx.strokeStyle = "#8795a1";
      chart.ctx.lineWidth = 0.5 * scale;
      chart.ctx.strokeRect(at(k), bottom - height, at(k + 1) - at(k), height);
    });
  }

  private pick(event: MouseEvent): void {
    const box = this.chart.over.getBoundingClientRect(), scale = devicePixelRatio;
    const x = (event.clientX - box.left) * scale + this.chart.bbox.left, y = (event.clientY - box.top) * scale + this.chart.bbox.top;
    let best = -1, least = kReach_px * scale;
    for (const slot of this.store.edge()) {
      const [px, py] = this.placeOf(slot), off = Math.hypot(px - x, py - y);
      if (off < least) [best, least] = [slot, off];
    }
    this.onPick(best);
  }
}
