/** Numbers under the scene: where the vehicle is at the cursor, how fast, how far off, where it looks. */

import type { Point } from "./data";
import { h } from "./dom";
import { fixed } from "./format";
import type { Tracks } from "./tracks";

const FIELDS = [["north", "m"], ["east", "m"], ["up", "m"], ["speed", "m/s"], ["error", "m"], ["heading", "°"]] as const;

export class Readout {
  readonly element = h("div.readouts");
  private readonly values: HTMLElement[] = [];

  fill(t: number, at: Point | null, tracks: Tracks): void {
    if (!at) return;
    if (!this.values.length) {
      this.element.append(...FIELDS.map(([name, unit]) => {
        const value = h("span.value");
        this.values.push(value);
        return h("div.readout-item", { "data-readout": name }, h("span.name", name), value, h("span.unit", unit));
      }));
    }
    const heading = (tracks.path.value(tracks.path.yaw, t) * 180) / Math.PI;
    const texts = [...at.map((x) => fixed(x, 2)), fixed(tracks.speedAt(t), 2), fixed(tracks.errorAt(t), 3), fixed(((heading % 360) + 360) % 360, 0)];
    texts.forEach((text, k) => (this.values[k].textContent = text));
  }
}
