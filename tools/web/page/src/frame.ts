// Which way a blade points: up is the tip, the leading edge lies at the end of the chord, the suction side looks ahead.
import { Vector3 } from "three";
import type { Design, Grid } from "./types";

export function bytesOf(text: string): ArrayBuffer {
  return Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer;
}

function middleOf(grids: Grid[]): Vector3 | null {
  const sum = new Vector3();
  let count = 0;
  for (const grid of grids) {
    const places = new Float32Array(bytesOf(grid.places));
    for (let k = 0; k < places.length; k += 3, ++count) sum.add(new Vector3(places[k], places[k + 1], places[k + 2]));
  }
  return count > 0 ? sum.divideScalar(count) : null;
}

// Without its part along a unit vector, made one again.
function across(vector: Vector3, unit: Vector3): Vector3 {
  return vector.clone().addScaledVector(unit, -vector.dot(unit)).normalize();
}

export interface BladeFrame {
  up: Vector3; // from the shaft to the tip
  suction: Vector3; // out of the suction side
  edge: Vector3 | null; // towards the leading edge; null where no zone is set
}

export function frameOf(design: Design): BladeFrame {
  const axis = new Vector3(...design.axis.direction).normalize();
  const middle = new Vector3(...design.middle);
  const body = middleOf(design.faces) ?? new Vector3();
  const arm = body.clone().add(middle).sub(new Vector3(...design.axis.point));
  const up = arm.length() > 1e-6 ? across(arm, axis) : across(new Vector3(0.3, 0.5, 1), axis);
  const zone = middleOf(design.zones);
  if (!zone) return { up, suction: axis, edge: null };
  const edge = across(zone.sub(body), up);
  const ahead = edge.dot(axis) < 0 ? axis.clone().negate() : axis;
  return { up, suction: across(across(ahead, up), edge), edge };
}
