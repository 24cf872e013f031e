/** What can be shown and hidden in the scene, and the chips that do it. */

import { Group, type Scene as Stage } from "three";
import { h } from "./dom";
import { RAMP_CSS } from "./ramp";
import { dispose } from "./solids";

/** Name, label, colour, whether it is shown at first; in the order of the bar. Those without a label are always shown. */
const LAYERS = [
  ["ground", "", "", true], ["path", "flown", "ink-2", true], ["reference", "reference", "ink-3", true], ["truth", "truth", "s2", false],
  ["plan", "plan", "plan", true], ["backup", "stop kept ready", "warn", true], ["obstacles", "obstacles", "solid", true],
  ["cells", "map", "cells", true], ["movers", "movers", "mover", true], ["fence", "fence", "bad", true], ["bounds", "bounds", "ink-3", true],
  ["least", "least clearance", "warn", true],
] as const;
export type LayerName = (typeof LAYERS)[number][0];

export class Layers {
  readonly bar = h("div.layers");
  private readonly groups = new Map<string, Group>();
  private listed = "";

  constructor(stage: Stage, private readonly changed: () => void) {
    for (const [name, , , shown] of LAYERS) {
      const group = new Group();
      group.visible = shown;
      this.groups.set(name, group);
      stage.add(group);
    }
  }

  /** A layer, emptied. */
  fresh(name: LayerName): Group {
    const group = this.groups.get(name)!;
    for (const child of [...group.children]) dispose(child);
    return group;
  }

  shown(name: string): boolean {
    return this.groups.get(name)?.visible ?? true;
  }

  /** A chip for each layer that holds something. */
  list(present: Partial<Record<LayerName, boolean>>): void {
    const listed = LAYERS.filter(([name, label]) => label && present[name]);
    if (this.listed === listed.map(([name]) => name).join()) return;
    this.listed = listed.map(([name]) => name).join();
    this.bar.replaceChildren(...listed.map(([name, label, tone]) => {
      const group = this.groups.get(name)!;
      return h("button.chip", {
        type: "button", "aria-pressed": String(group.visible), "data-layer": name,
        onclick: (event: Event) => {
          group.visible = !group.visible;
          (event.currentTarget as HTMLElement).setAttribute("aria-pressed", String(group.visible));
          this.changed();
        },
      }, h("span.swatch", { style: { background: swatch(name, tone) } }), label);
    }));
  }
}

/** As it is drawn: the path in its colours, the reference in dashes. */
function swatch(name: LayerName, tone: string): string {
  if (name === "path") return RAMP_CSS;
  return name === "reference" ? `repeating-linear-gradient(90deg, var(--${tone}) 0 3px, transparent 3px 5px)` : `var(--${tone})`;
}
