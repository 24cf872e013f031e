/** The flight's own tracks: where it was, where it should have been, and what follows from both. */

import { Track, type Point, type SceneJson } from "./data";

type Tracked = "path" | "truth" | "reference";
export type Rows = Partial<Record<Tracked, (number | null)[][]>>;

const NAMES = ["path", "truth", "reference"] as const;
const SLACK_S = 0.1;

export class Tracks {
  path = new Track();
  truth = new Track();
  reference = new Track();

  constructor(json: SceneJson) {
    this.replace(json);
  }

  replace(more: Partial<SceneJson>): void {
    for (const name of NAMES) if (more[name]) this[name] = new Track(more[name]);
  }

  /** Whether there was anything to append. */
  append(more: Rows): boolean {
    for (const name of NAMES) if (more[name]) this[name].append(more[name]);
    return NAMES.some((name) => !!more[name]);
  }

  get first(): number {
    return this.path.length ? this.path.t.at(0) : 0;
  }

  get last(): number {
    return this.path.length ? this.path.t.at(this.path.length - 1) : 0;
  }

  /** Whether anything says where it should have been. */
  get judged(): boolean {
    return this.path.error.length > 0 || this.reference.length > 0;
  }

  /** Where the i-th sample of the path was. */
  place(i: number): Point {
    return [this.path.n.at(i), this.path.e.at(i), this.path.u.at(i)];
  }

  /** Speed [m/s] over a fifth of a second. */
  speedAt(moment: number): number {
    const t = Math.max(this.first, Math.min(this.last, moment));
    const a = this.path.at(t - SLACK_S), b = this.path.at(t + SLACK_S);
    const span = Math.min(this.last, t + SLACK_S) - Math.max(this.first, t - SLACK_S);
    return a && b && span > 0 ? Math.hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]) / span : NaN;
  }

  /** How far from where it should be [m]: told, or the distance to the reference at the same time. */
  errorAt(t: number): number {
    if (this.path.error.length) return this.path.value(this.path.error, t);
    const b = this.referenceAt(t, SLACK_S, SLACK_S), a = b && this.path.at(t);
    return a && b ? Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) : NaN;
  }

  /** The reference at a time, up to so many seconds before its first sample and after its last; else null. */
  referenceAt(t: number, before: number, after: number): Point | null {
    const { reference } = this, count = reference.length;
    return count && t >= reference.t.at(0) - before && t <= reference.t.at(count - 1) + after ? reference.at(t) : null;
  }
}
