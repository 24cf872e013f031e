/** What does not move: how large the scene is, the ground with its numbers, obstacles, bounds, fence, the least clearance, light. */

import { AmbientLight, DirectionalLight, HemisphereLight, Mesh, SphereGeometry, type Scene as Stage } from "three";
import type { Extent } from "./cameras";
import type { Point, SceneJson } from "./data";
import { clock, number } from "./format";
import type { Labels } from "./labels";
import type { LayerName, Layers } from "./layers";
import { boundsFrame, fenceCurtain, glowing, ground, obstacle, segments, toThree } from "./solids";
import type { Tracks } from "./tracks";
import type { Ways } from "./ways";

const LEAST_SPAN_M = 4;
const TICKS = 6; // numbers along an edge of the ground, at most about so many

/** The flight, and the world's bounds where they are of its size. */
export function extentOf(json: SceneJson, tracks: Tracks, ways: Ways): Extent {
  const low: Point = [Infinity, Infinity, Infinity], high: Point = [-Infinity, -Infinity, -Infinity];
  const take = (p: ArrayLike<number>) => {
    for (let k = 0; k < 3; k++) {
      if (p[k] < low[k]) low[k] = p[k];
      if (p[k] > high[k]) high[k] = p[k];
    }
  };
  for (const track of [tracks.path, tracks.reference, tracks.truth]) {
    const stride = Math.max(1, Math.floor(track.length / 2000));
    for (let i = 0; i < track.length; i += stride) take([track.n.at(i), track.e.at(i), track.u.at(i)]);
  }
  for (const point of ways.points()) take(point);
  const flown = Number.isFinite(low[0]) ? Math.max(high[0] - low[0], high[1] - low[1], high[2] - low[2]) : 0;
  const { bounds } = json;
  if (bounds && (!flown || Math.max(bounds[1][0] - bounds[0][0], bounds[1][1] - bounds[0][1]) < 4 * flown + 20)) {
    take(bounds[0]);
    take(bounds[1]);
  }
  if (!Number.isFinite(low[0])) {
    take([-5, -5, 0]);
    take([5, 5, 3]);
  }
  const level = bounds ? bounds[0][2] : Math.min(0, low[2]);
  for (let k = 0; k < 2; k++) {
    if (high[k] - low[k] >= LEAST_SPAN_M) continue;
    const middle = (low[k] + high[k]) / 2;
    [low[k], high[k]] = [middle - LEAST_SPAN_M / 2, middle + LEAST_SPAN_M / 2];
  }
  const floor = ground([low[0], low[1]], [high[0], high[1]], level);
  low[2] = Math.min(low[2], level);
  const centre = toThree([(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2]);
  const reach = Math.max(LEAST_SPAN_M, Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]));
  return { centre, reach, box: [toThree(low), toThree(high)], floor };
}

/** Which layers hold something of it. */
export function standing(json: SceneJson): Partial<Record<LayerName, boolean>> {
  const mapped = json.obstacles.some((o) => o.kind === "cells");
  return { obstacles: json.obstacles.some((o) => o.kind !== "cells"), cells: mapped, fence: !!json.fence?.length, bounds: !!json.bounds, least: !!json.least };
}

/** All that stands, anew, in the colours of now. */
export function stand(json: SceneJson, { floor, reach }: Extent, layers: Layers, labels: Labels, goTo: (t: number) => void): void {
  layers.fresh("ground").add(floor.object);
  labels.clear("ground");
  numbered({ floor, reach }, labels);
  const { obstacles, bounds, fence, least } = json;
  const solids = layers.fresh("obstacles"), cells = layers.fresh("cells");
  for (const o of obstacles) (o.kind === "cells" ? cells : solids).add(obstacle(o));
  const box = layers.fresh("bounds"), rim = layers.fresh("fence"), mark = layers.fresh("least");
  if (bounds) box.add(boundsFrame(...bounds));
  if (fence?.length) rim.add(fenceCurtain(fence, floor.level, bounds ? bounds[1][2] : floor.level + Math.max(3, reach / 8)));
  labels.clear("least");
  if (!least) return;
  const at = toThree(least.at);
  const ball = new Mesh(new SphereGeometry(Math.max(0.12, reach / 160), 20, 14), glowing("warn"));
  ball.position.copy(at);
  mark.add(ball, segments([at.x, floor.level, at.z, at.x, at.y, at.z], "warn", 0.7));
  const { element } = labels.add(`${number(least.clearance, 3)} m clear`, at, "least", "least");
  element.title = `least clearance, at ${clock(least.t)}${json.movers.length ? "; of what moves, as great as it was taken to be" : ""}`;
  element.addEventListener("click", () => goTo(least.t));
}

/** Metres along two edges of the ground. */
function numbered({ floor, reach }: Pick<Extent, "floor" | "reach">, labels: Labels): void {
  const { low, high, level } = floor, off = 0.035 * reach;
  const put = (n: number, e: number, text: string, kind: "tick" | "axis") => labels.add(text, toThree([n, e, level]), kind, "ground");
  const every = floor.step * Math.max(1, Math.ceil((high[0] - low[0]) / floor.step / TICKS));
  for (let n = low[0]; n <= high[0] + 1e-6; n += every) put(n, low[1] - off, number(round(n)), "tick");
  for (let e = low[1]; e <= high[1] + 1e-6; e += every) put(low[0] - off, e, number(round(e)), "tick");
  put((low[0] + high[0]) / 2, low[1] - 3 * off, "north [m]", "axis");
  put(low[0] - 2.6 * off, (low[1] + high[1]) / 2, "east [m]", "axis");
}

/** Light for the theme of now, in place of what was. */
export function light(stage: Stage): void {
  stage.children.filter((c) => c.userData.light).forEach((c) => c.removeFromParent());
  const dark = document.documentElement.dataset.theme === "dark";
  const sky = new HemisphereLight(0xffffff, dark ? 0x334 : 0x99a, dark ? 1.6 : 2.0), sun = new DirectionalLight(0xffffff, 1.2), all = new AmbientLight(0xffffff, 0.6);
  sun.position.set(0.5, 1, 0.8);
  for (const lamp of [sky, sun, all]) {
    lamp.userData.light = true;
    stage.add(lamp);
  }
}

function round(value: number): number {
  return Math.abs(value) < 1e-9 ? 0 : Number(value.toPrecision(6));
}
