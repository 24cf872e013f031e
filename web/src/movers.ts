/** What moves beside the vehicle: balls with trails. */

import { Mesh, SphereGeometry, type BufferAttribute, type Group, type Line } from "three";
import { decode, Track, type MoverJson } from "./data";
import type { Label, Labels } from "./labels";
import { trail, TRAIL } from "./lines";
import { solid, toThree } from "./solids";

const TRAIL_S = 3;
const BEFORE_S = 0.5, AFTER_S = 1.5; // it is shown a little longer than it was told of
const MOST_NAMED = 12;

interface Moving { json: MoverJson; track: Track; drawn?: { ball: Mesh; trail: Line; label: Label | null } }

export class Movers {
  private all: Moving[] = [];

  get count(): number {
    return this.all.length;
  }

  replace(movers: MoverJson[]): void {
    this.all = movers.map((json) => ({ json, track: new Track(json) }));
  }

  /** Whether one is new; then all are to be built again. */
  append(movers: MoverJson[]): boolean {
    let fresh = false;
    for (const json of movers) {
      const known = this.all.find((m) => m.json.id === json.id);
      if (known) for (const name of ["t", "n", "e", "u"] as const) known.track[name].push(decode(json[name]).view());
      else {
        this.all.push({ json, track: new Track(json) });
        fresh = true;
      }
    }
    return fresh;
  }

  /** Anew, in the colours of now. */
  build(group: Group, labels: Labels): void {
    labels.clear("movers");
    for (const mover of this.all) {
      const ball = new Mesh(new SphereGeometry(mover.json.radius, 24, 16), solid("mover", 0.6));
      const label = this.all.length > MOST_NAMED ? null : labels.add(mover.json.id, ball.position, "mover", "movers");
      mover.drawn = { ball, trail: trail(), label };
      group.add(ball, mover.drawn.trail);
    }
  }

  /** Whether a label is that of one that is not there now. */
  hides(label: Label): boolean {
    return this.all.some(({ drawn }) => drawn?.label === label && !drawn.ball.visible);
  }

  moveTo(t: number): void {
    for (const { track, drawn } of this.all) {
      if (!drawn) continue;
      const { ball, trail } = drawn;
      const first = track.t.at(0), place = track.at(t);
      ball.visible = trail.visible = !!place && t >= first - BEFORE_S && t <= track.t.at(track.length - 1) + AFTER_S;
      if (!place || !ball.visible) continue;
      ball.position.copy(toThree(place));
      const points = trail.geometry.getAttribute("position") as BufferAttribute;
      for (let k = 0; k < TRAIL; k++) {
        const [n, e, u] = track.at(Math.max(first, t - (TRAIL_S * k) / (TRAIL - 1)))!;
        points.setXYZ(k, e, u, -n);
      }
      points.needsUpdate = true;
    }
  }
}
