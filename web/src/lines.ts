/** Lines: which points of a track are worth drawing, lines of so many pixels, trails that fade. */

import { BufferAttribute, BufferGeometry, Color, Line, LineBasicMaterial } from "three";
import { Line2 } from "three/examples/jsm/lines/Line2.js";
import { LineGeometry } from "three/examples/jsm/lines/LineGeometry.js";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import type { Track } from "./data";
import { colour } from "./dom";

export const TRAIL = 24; // points of a trail

/** Indices of the vertices worth drawing: those that moved visibly, never more than a few thousand. */
export function thin(track: Track, reach: number, most: number): number[] {
  const count = track.length, kept: number[] = [];
  let least = (reach / 1000) ** 2;
  for (;;) {
    kept.length = 0;
    let n = NaN, e = NaN, u = NaN;
    for (let i = 0; i < count; i++) {
      const [a, b, c] = [track.n.at(i), track.e.at(i), track.u.at(i)];
      if (Number.isNaN(a + b + c)) continue;
      const far = (a - n) ** 2 + (b - e) ** 2 + (c - u) ** 2;
      if (far < least && i < count - 1) continue;
      kept.push(i);
      [n, e, u] = [a, b, c];
    }
    if (kept.length <= most) return kept;
    least *= 2;
  }
}

export function flat3(track: Track, kept: number[]): Float32Array {
  const positions = new Float32Array(3 * kept.length);
  kept.forEach((i, k) => positions.set([track.e.at(i), track.u.at(i), -track.n.at(i)], 3 * k));
  return positions;
}

const fatMaterials = new Map<string, LineMaterial>();

/** Kept for good: with the last material of a kind its shader would go, and be compiled again for the next line. */
function fatMaterial(linewidth: number, opacity: number, dash: number): LineMaterial {
  const key = [linewidth, opacity, dash].join();
  let material = fatMaterials.get(key);
  if (!material) {
    material = new LineMaterial({
      linewidth, vertexColors: true, transparent: true, opacity, dashed: true, dashSize: dash || 1e9, gapSize: 0.75 * dash, depthWrite: opacity >= 1,
    });
    material.userData.kept = true;
    fatMaterials.set(key, material);
  }
  return material;
}

/** A line of so many pixels, in one colour or one a vertex. */
export function fat(positions: Float32Array, tint: Float32Array | string, linewidth: number, opacity = 1, dash = 0): Line2 {
  const geometry = new LineGeometry();
  geometry.setPositions(positions);
  if (typeof tint === "string") {
    const { r, g, b } = new Color(tint);
    tint = Float32Array.from({ length: positions.length }, (_, i) => [r, g, b][i % 3]);
  }
  geometry.setColors(tint);
  const material = fatMaterial(linewidth, opacity, dash);
  const line = new Line2(geometry, material);
  // Below the obstacles, which tint what is behind them; where lines coincide, what was flown covers what was meant.
  line.renderOrder = opacity < 1 ? -2 : -1;
  line.computeLineDistances();
  line.frustumCulled = false;
  return line;
}

/** Where something was in the last seconds, paler with age. */
export function trail(): Line {
  const geometry = new BufferGeometry(), tint = new Color(colour("mover"));
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(3 * TRAIL), 3));
  geometry.setAttribute("color", new BufferAttribute(Float32Array.from({ length: 4 * TRAIL }, (_, i) =>
    i % 4 < 3 ? [tint.r, tint.g, tint.b][i % 4] : 0.8 * (1 - Math.floor(i / 4) / TRAIL)), 4));
  const line = new Line(geometry, new LineBasicMaterial({ vertexColors: true, transparent: true }));
  line.frustumCulled = false;
  return line;
}
