/** The keyboard: one table, which is also the help. */

import type { FlightScene } from "./scene";
import type { State } from "./state";
import { h } from "./dom";

interface Key { keys: string[]; shown: string; what: string; act: (event: KeyboardEvent) => void }

export function keyboard(state: State, scene: FlightScene, toggleTheme: () => void, signal: AbortSignal): { open: () => void } {
  const step = (share: number) => (event: KeyboardEvent) => {
    const [low, high] = state.range;
    state.setPlaying(false);
    state.setCursor(state.cursor + share * (high - low) * (event.shiftKey ? 10 : 1));
    state.reveal();
  };
  const zoom = (factor: number) => () => (scene.focused ? scene.cameras.zoom(factor) : state.zoom(factor));
  const table: Key[] = [
    { keys: [" "], shown: "space", what: "play or pause", act: () => state.setPlaying(!state.playing) },
    { keys: ["ArrowLeft"], shown: "← →", what: "move the cursor (shift: further)", act: step(-0.005) },
    { keys: ["ArrowRight"], shown: "", what: "", act: step(0.005) },
    { keys: ["Home"], shown: "home end", what: "to the start, to the end", act: () => { state.setCursor(state.full[0]); state.reveal(); } },
    { keys: ["End"], shown: "", what: "", act: () => { state.setCursor(state.full[1]); state.reveal(); } },
    { keys: ["+", "="], shown: "+ −", what: "zoom the time axes, or the scene when it has the focus", act: zoom(0.75) },
    { keys: ["-", "_"], shown: "", what: "", act: zoom(1 / 0.75) },
    { keys: ["0"], shown: "0", what: "the whole flight", act: () => state.resetRange() },
    { keys: ["["], shown: "[ ]", what: "slower, faster", act: () => state.slower() },
    { keys: ["]"], shown: "", what: "", act: () => state.faster() },
    { keys: ["1"], shown: "1 2 3", what: "3D, top, side view (3 again: the other side)", act: () => scene.setView("3D") },
    { keys: ["2"], shown: "", what: "", act: () => scene.setView("top") },
    { keys: ["3"], shown: "", what: "", act: () => scene.setView("side") },
    { keys: ["f"], shown: "f", what: "follow the vehicle", act: () => scene.setFollowing(!scene.following) },
    { keys: ["a"], shown: "w a s d", what: "turn the scene (shift: move it)", act: (e) => (e.shiftKey ? scene.cameras.pan(-0.06, 0) : scene.cameras.orbit(-0.1, 0)) },
    { keys: ["d"], shown: "", what: "", act: (e) => (e.shiftKey ? scene.cameras.pan(0.06, 0) : scene.cameras.orbit(0.1, 0)) },
    { keys: ["w"], shown: "", what: "", act: (e) => (e.shiftKey ? scene.cameras.pan(0, 0.06) : scene.cameras.orbit(0, 0.08)) },
    { keys: ["s"], shown: "", what: "", act: (e) => (e.shiftKey ? scene.cameras.pan(0, -0.06) : scene.cameras.orbit(0, -0.08)) },
    { keys: ["t"], shown: "t", what: "dark or light", act: toggleTheme },
    { keys: ["/"], shown: "/", what: "search the events", act: () => document.getElementById("event-search")?.focus() },
    { keys: ["?"], shown: "?", what: "this help", act: () => (dialog.open ? dialog.close() : dialog.showModal()) },
  ];
  const dialog = h<HTMLDialogElement>("dialog.help", { "aria-label": "help", onclick: (e: Event) => e.target === dialog && dialog.close() },
    h("div.dialog-body",
      h("h2", "Keys and gestures"),
      h("dl", table.filter((k) => k.shown).map((k) => h("div", h("dt", k.shown.split(" ").map((name) => h("kbd", name))), h("dd", k.what)))),
      h("dl",
        h("div", h("dt", "plots"), h("dd", "hover looks, a click puts the cursor, drag zooms, shift and drag pans, ctrl and wheel zooms, double click shows all")),
        h("div", h("dt", "scene"), h("dd", "drag turns, wheel or pinch zooms, right drag or two fingers move; a click on the path jumps there; double click resets")),
        h("div", h("dt", "touch"), h("dd", "one finger moves the cursor on a plot, two zoom it"))),
      h("button.primary", { type: "button", onclick: () => dialog.close() }, "close")));
  document.body.append(dialog);

  addEventListener("keydown", (event) => {
    const target = event.target as HTMLElement;
    if (event.ctrlKey || event.metaKey || event.altKey || target.matches("input, select, textarea")) {
      if (event.key === "Escape" && target.matches("input")) target.blur();
      return;
    }
    if (document.querySelector("dialog[open]") && !dialog.open) return;
    if (dialog.open && event.key !== "?") return;
    if (event.key === " " && target.matches("button, summary")) return; // a button under the focus is what space is for
    const found = table.find((k) => k.keys.includes(event.key.length === 1 ? event.key.toLowerCase() : event.key));
    if (!found) return;
    event.preventDefault();
    found.act(event);
  }, { signal });
  signal.addEventListener("abort", () => dialog.remove());
  return { open: () => dialog.showModal() };
}
