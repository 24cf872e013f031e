/** The path's colour: of what, and the legend that says so. */

import { Color, SRGBColorSpace } from "three";
import { colour, h } from "./dom";
import { clock, number } from "./format";
import { ramp, RAMP_CSS, roundUp } from "./ramp";
import type { Tracks } from "./tracks";

const CHOICES = { error: ["tracking error", " m"], speed: ["speed", " m/s"], height: ["height", " m"], time: ["time", ""] } as const;
type Choice = keyof typeof CHOICES;

export class Tint {
  private by: Choice = "error";
  private readonly ends = h("span.legend-ends");
  private readonly choice: HTMLSelectElement;
  readonly element: HTMLElement;

  constructor(changed: () => void) {
    const choice = this.choice = h<HTMLSelectElement>("select", {
      "aria-label": "colour of the path", title: "colour of the path",
      onchange: () => {
        this.by = choice.value as Choice;
        changed();
      },
    }, Object.entries(CHOICES).map(([name, [label]]) => h("option", { value: name }, label)));
    this.element = h("div.colour-legend", choice, h("span.ramp", { style: { "background-image": RAMP_CSS } }), this.ends);
  }

  choose(by: Choice): void {
    this.by = by;
    this.choice.value = by;
  }

  /** Linear red, green, blue of each of the path's samples `kept`; grey where nothing is known. */
  of(tracks: Tracks, kept: number[], floor: number, end: number): Float32Array {
    const { t, u } = tracks.path, { by } = this;
    const value = { error: (i: number) => tracks.errorAt(t.at(i)), speed: (i: number) => tracks.speedAt(t.at(i)),
      height: (i: number) => u.at(i) - floor, time: (i: number) => t.at(i) }[by];
    const values = kept.map(value);
    const sorted = values.filter(Number.isFinite).sort((a, b) => a - b);
    const high = by === "time" ? Math.max(1e-6, end) : roundUp(sorted[Math.floor(0.99 * (sorted.length - 1))] ?? 1);
    this.ends.replaceChildren(h("span", "0"), h("span", `${by === "time" ? clock(high, 0) : number(high)}${CHOICES[by][1]}`));
    const neutral = new Color(colour("ink-3")), colours = new Float32Array(3 * kept.length), c = new Color();
    values.forEach((v, k) => {
      if (Number.isFinite(v)) c.setRGB(...ramp(v / high), SRGBColorSpace);
      else c.copy(neutral);
      colours.set([c.r, c.g, c.b], 3 * k);
    });
    return colours;
  }
}
