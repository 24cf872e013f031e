/** Plans: of all that were made, the one flown at the moment and the stop kept ready. */

import { decode, type PlanJson } from "./data";
import { colour } from "./dom";
import { fat } from "./lines";
import type { Layers } from "./layers";

const MOST = 400, KEPT = 200; // of a flight that goes on

interface Way { t: number; kind: string; points: Float64Array | Float32Array }

export class Ways {
  private all: Way[] = [];
  private shown: (Way | undefined)[] = [];

  replace(plans: PlanJson[]): void {
    this.all = plans.map(way);
    this.stale();
  }

  append(plans: PlanJson[]): void {
    this.all.push(...plans.map(way));
    if (this.all.length > MOST) this.all.splice(0, this.all.length - KEPT);
  }

  /** Colours have changed: draw again what is shown. */
  stale(): void {
    this.shown = [];
  }

  has(backup: boolean): boolean {
    return this.all.some((w) => (w.kind === "backup") === backup);
  }

  /** Points of the first plans, to see how large a scene is. */
  *points(): Generator<ArrayLike<number>> {
    for (const { points } of this.all.slice(0, 50)) for (let i = 0; i + 2 < points.length; i += 3) yield points.subarray(i, i + 3);
  }

  /** Draw those of a moment; how many, or null when they are drawn already. */
  show(t: number, layers: Layers): number | null {
    let plan: Way | undefined, backup: Way | undefined;
    for (const w of this.all) {
      if (w.t > t + 1e-6) continue;
      if (w.kind === "backup") backup = w;
      else plan = w;
    }
    plan ??= this.all.find((w) => w.kind !== "backup");
    if (this.shown.length && this.shown[0] === plan && this.shown[1] === backup) return null;
    this.shown = [plan, backup];
    for (const [w, name, tone, width] of [[plan, "plan", "plan", 2.4], [backup, "backup", "warn", 2]] as const) {
      const group = layers.fresh(name);
      if (!w || w.points.length < 6) continue;
      const positions = new Float32Array(w.points.length);
      for (let i = 0; i + 2 < w.points.length; i += 3) positions.set([w.points[i + 1], w.points[i + 2], -w.points[i]], i);
      group.add(fat(positions, colour(tone), width, 0.9));
    }
    return Number(!!plan) + Number(!!backup);
  }
}

function way(json: PlanJson): Way {
  return { t: json.t, kind: json.kind, points: decode(json.points).view() };
}
