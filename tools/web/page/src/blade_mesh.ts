// The design: its faces, and the zones of the leading edge upon them.
import { BufferAttribute, BufferGeometry, DoubleSide, Group, Mesh, MeshLambertMaterial } from "three";
import { bytesOf } from "./frame";
import { kColours } from "./looks";
import type { Design, Grid } from "./types";

function geometryOf(grid: Grid): BufferGeometry {
  const inside = new Uint8Array(bytesOf(grid.inside));
  const index: number[] = [];
  const add = (a: number, b: number, c: number): void => { if (inside[a] || inside[b] || inside[c]) index.push(a, b, c); };
  for (let row = 0; row + 1 < grid.rows; ++row) {
    for (let column = 0; column + 1 < grid.columns; ++column) {
      const a = row * grid.columns + column, b = a + grid.columns;
      add(a, b, b + 1);
      add(a, b + 1, a + 1);
    }
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(bytesOf(grid.places)), 3));
  geometry.setAttribute("normal", new BufferAttribute(new Int8Array(bytesOf(grid.normals)), 3, true));
  geometry.setIndex(index);
  return geometry;
}

// Pushed back, so that points and lines upon it are seen whole; zones less far than faces.
const materialOf = (color: string, back: number): MeshLambertMaterial =>
  new MeshLambertMaterial({ color, side: DoubleSide, polygonOffset: true, polygonOffsetFactor: back, polygonOffsetUnits: back });

export function meshOf(design: Design): Group {
  const group = new Group();
  const face = materialOf(kColours.blade, 3), zone = materialOf(kColours.zone, 2);
  group.add(...design.faces.map((grid) => new Mesh(geometryOf(grid), face)), ...design.zones.map((grid) => new Mesh(geometryOf(grid), zone)));
  return group;
}
