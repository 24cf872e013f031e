/** What a click in the scene means: a moment of the path, or a place on the ground where a goal is asked for. */

import { Group, Mesh, RingGeometry, SphereGeometry, type Scene as Stage } from "three";
import type { Cameras } from "./cameras";
import type { Point } from "./data";
import { dispose, glowing, segments, toThree } from "./solids";
import type { Tracks } from "./tracks";

const CLICK_PX = 5; // moved less than this, a press was a click
const MOUSE_PX = 18, FINGER_PX = 30; // how near to the path

/** Call with each click that is no drag. */
export function clicks(canvas: HTMLElement, clicked: (event: PointerEvent) => void): void {
  let down: { x: number; y: number } | null = null;
  canvas.addEventListener("pointerdown", (event) => (down = { x: event.clientX, y: event.clientY }));
  canvas.addEventListener("pointerup", (event) => {
    if (down && Math.hypot(event.clientX - down.x, event.clientY - down.y) < CLICK_PX) clicked(event);
    down = null;
  });
}

/** Which of the path's samples `kept` is nearest to the pointer; -1: none is near. */
export function nearest(event: PointerEvent, tracks: Tracks, kept: number[], cameras: Cameras): number {
  let best = -1, least = event.pointerType === "mouse" ? MOUSE_PX : FINGER_PX;
  for (const i of kept) {
    const [x, y] = cameras.screenOf(tracks.place(i));
    const away = Math.hypot(x - event.clientX, y - event.clientY);
    if (away < least) [best, least] = [i, away];
  }
  return best;
}

/** A pole where a goal is meant. */
export class Goal {
  private mark: Group | null = null;

  /** Null takes it away. */
  show(stage: Stage, place: Point | null, level: number, reach: number): void {
    if (this.mark) dispose(this.mark);
    this.mark = null;
    if (!place) return;
    const at = toThree(place), size = Math.max(0.3, reach / 70);
    const ring = new Mesh(new RingGeometry(size, 1.4 * size, 48), glowing("accent"));
    ring.rotation.x = -Math.PI / 2;
    ring.position.set(at.x, level + 0.01, at.z);
    const ball = new Mesh(new SphereGeometry(0.55 * size, 20, 14), glowing("accent"));
    ball.position.copy(at);
    this.mark = new Group();
    this.mark.add(ring, ball, segments([at.x, level, at.z, at.x, at.y, at.z], "accent"));
    stage.add(this.mark);
  }
}
