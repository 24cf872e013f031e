/**
 * How a time axis is handled, the same on every plot: hover looks, a click or a finger puts the cursor, a drag zooms, shift and drag
 * pans, two fingers or ctrl and the wheel zoom, a double click shows the whole flight.
 */

import type { State } from "./state";
import { h } from "./dom";

const CLICK_PX = 4;

export function timeGestures(area: HTMLElement, state: State, toTime: (px: number) => number): void {
  const selection = h("div.selection", { hidden: true });
  area.append(selection);
  area.style.touchAction = "pan-y";
  const fingers = new Map<number, number>();
  let pressed: { x: number; mode: "select" | "pan"; range: [number, number]; moved: boolean } | null = null;
  let pinch: { low: number; high: number } | null = null;
  const x = (event: MouseEvent) => event.clientX - area.getBoundingClientRect().left;

  area.addEventListener("pointerdown", (event) => {
    if (event.pointerType === "mouse") {
      if (event.button !== 0) return;
      area.setPointerCapture(event.pointerId);
      pressed = { x: x(event), mode: event.shiftKey ? "pan" : "select", range: [...state.range], moved: false };
      return;
    }
    fingers.set(event.pointerId, x(event));
    if (fingers.size === 1) {
      state.setPlaying(false);
      state.setCursor(toTime(x(event)));
    } else if (fingers.size === 2) {
      const [a, b] = [...fingers.values()].sort((p, q) => p - q);
      pinch = { low: toTime(a), high: toTime(b) };
    }
  });

  area.addEventListener("pointermove", (event) => {
    const here = x(event);
    if (event.pointerType !== "mouse") {
      if (!fingers.has(event.pointerId)) return;
      fingers.set(event.pointerId, here);
      if (pinch && fingers.size >= 2) {
        const [a, b] = [...fingers.values()].sort((p, q) => p - q);
        const width = area.clientWidth;
        if (b - a < 16) return;
        const perPixel = (pinch.high - pinch.low) / (b - a);
        state.setRange(pinch.low - a * perPixel, pinch.high + (width - b) * perPixel);
      } else if (fingers.size === 1) state.setCursor(toTime(here));
      return;
    }
    if (!pressed) {
      state.hover(toTime(here));
      return;
    }
    pressed.moved ||= Math.abs(here - pressed.x) > CLICK_PX;
    if (!pressed.moved) return;
    if (pressed.mode === "pan") {
      const perPixel = (pressed.range[1] - pressed.range[0]) / area.clientWidth;
      const shift = (pressed.x - here) * perPixel;
      state.setRange(pressed.range[0] + shift, pressed.range[1] + shift);
    } else {
      selection.hidden = false;
      selection.style.left = `${Math.max(0, Math.min(here, pressed.x))}px`;
      selection.style.width = `${Math.min(area.clientWidth, Math.max(here, pressed.x)) - Math.max(0, Math.min(here, pressed.x))}px`;
    }
  });

  const release = (event: PointerEvent) => {
    fingers.delete(event.pointerId);
    if (fingers.size < 2) pinch = null;
    if (event.pointerType !== "mouse" || !pressed) return;
    const { x: from, mode, moved } = pressed;
    pressed = null;
    selection.hidden = true;
    if (event.type === "pointercancel") return;
    if (!moved) {
      state.setPlaying(false);
      state.setCursor(toTime(x(event)));
    } else if (mode === "select") {
      const [a, b] = [toTime(from), toTime(x(event))];
      state.setRange(Math.min(a, b), Math.max(a, b));
    }
  };
  area.addEventListener("pointerup", release);
  area.addEventListener("pointercancel", release);
  area.addEventListener("pointerleave", (event) => event.pointerType === "mouse" && state.hover(null));
  area.addEventListener("dblclick", () => state.resetRange());
  area.addEventListener("wheel", (event) => {
    if (!event.ctrlKey && !event.metaKey && !event.shiftKey) return;
    event.preventDefault();
    const turn = event.deltaY || event.deltaX;
    state.zoom(Math.exp(Math.max(-1, Math.min(1, turn / 300))), toTime(x(event)));
  }, { passive: false });
}
