/** Words over the scene: each beside its place, none over another; of two that want the same spot the more telling stays. */

import { Vector3, type Camera } from "three";
import { h } from "./dom";

/** Kinds, the most telling first, each with how far below its place [px] it may stand. */
const KINDS = { least: [-20, 20, -42], place: [14, -16, 34], mover: [-16, 14], axis: [0, 16, 32], tick: [0] };
const ALWAYS = "least"; // is shown whatever is in its way
type Kind = keyof typeof KINDS;

export interface Label { element: HTMLElement; at: Vector3; kind: Kind; layer: string; size: [number, number] | null }
interface Box { left: number; top: number; right: number; bottom: number }

export class Labels {
  readonly element = h("div.scene-tags", { "aria-hidden": "true" });
  private all: Label[] = [];

  /** A word at a place, which may move; it goes with its layer. */
  add(text: string, at: Vector3, kind: Kind, layer: string): Label {
    const label: Label = { element: h(`span.tag.${kind}`, text), at, kind, layer, size: null };
    this.element.append(label.element);
    this.all.push(label);
    const rank = Object.keys(KINDS);
    this.all.sort((a, b) => rank.indexOf(a.kind) - rank.indexOf(b.kind));
    return label;
  }

  clear(layer: string): void {
    this.all = this.all.filter((label) => label.layer !== layer || (label.element.remove(), false));
  }

  /** Put each where its place is seen from here. */
  place(camera: Camera, shown: (label: Label) => boolean): void {
    const { clientWidth: width, clientHeight: height } = this.element;
    const p = new Vector3(), ahead = camera.getWorldDirection(new Vector3());
    const sideways = Math.abs(ahead.y) < 0.05; // what lies on the ground is seen from its edge
    for (const label of this.all) {
      if (label.size) continue;
      label.element.hidden = false;
      label.size = [label.element.offsetWidth, label.element.offsetHeight];
    }
    const taken: Box[] = [];
    for (const label of this.all) {
      const { element, kind } = label, [wide, tall] = label.size!;
      p.copy(label.at).project(camera);
      const inside = p.z > -1 && p.z < 1 && Math.abs(p.x) < 1.05 && Math.abs(p.y) < 1.05;
      const wanted = inside && shown(label) && !(sideways && (kind === "tick" || kind === "axis"));
      const x = ((p.x + 1) / 2) * width, y = ((1 - p.y) / 2) * height;
      const boxes = !wanted ? [] : KINDS[kind].map((below) => ({
        left: x - wide / 2, right: x + wide / 2, top: y + below - tall / 2, bottom: y + below + tall / 2,
      }));
      const box = boxes.find((b) => !taken.some((t) => overlap(b, t))) ?? (kind === ALWAYS ? boxes[0] : undefined);
      element.hidden = !box;
      if (!box) continue;
      taken.push(box);
      element.style.transform = `translate(${box.left}px, ${box.top}px)`;
    }
  }
}

function overlap(a: Box, b: Box): boolean {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}
