/** The live page: a WebSocket that appends, and orders that go back. */

import type { DataJson } from "./data";
import { h, icon } from "./dom";
import { fixed } from "./format";
import type { FlightScene } from "./scene";
import type { State } from "./state";

export interface LiveConfig { url: string; token: string }
export interface Append { [field: string]: unknown }

const RETRY_MS = [500, 1000, 2000, 4000];
const SILENT_MS = 3000; // without a message for so long, a connection is called silent
const WINDOWS: [string, number][] = [["30 s", 30], ["1 min", 60], ["5 min", 300], ["all", 0]];

/** Where the page's own attributes, or the page that holds it, say the data come from. */
export function liveConfig(): LiveConfig | null {
  const given = (window as unknown as { companionLive?: LiveConfig }).companionLive;
  if (given) return given;
  const text = document.body.dataset.live;
  return text ? (JSON.parse(text) as LiveConfig) : null;
}

export type LinkState = "connecting" | "connected" | "silent" | "lost";

export class Link {
  state: LinkState = "connecting";
  messages = 0;
  private socket: WebSocket | null = null;
  private attempts = 0;
  private heard = 0;

  constructor(
    private readonly config: LiveConfig,
    private readonly on: {
      data: (data: DataJson) => void;
      append: (more: Append) => void;
      answer: (answer: { order: string; ok: boolean; text: string }) => void;
      state: (state: LinkState, heard: number) => void;
    },
  ) {
    this.open();
    setInterval(() => {
      if (this.state === "connected" && performance.now() - this.heard > SILENT_MS) this.become("silent");
      else if (this.state !== "connected") this.on.state(this.state, this.heard);
    }, 500);
  }

  private become(state: LinkState): void {
    this.state = state;
    this.on.state(state, this.heard);
  }

  private open(): void {
    const url = new URL(this.config.url, location.href);
    if (url.protocol === "http:") url.protocol = "ws:";
    if (url.protocol === "https:") url.protocol = "wss:";
    const socket = (this.socket = new WebSocket(url));
    socket.onmessage = (event) => {
      this.heard = performance.now();
      this.messages++;
      this.attempts = 0;
      if (this.state !== "connected") this.become("connected");
      const message = JSON.parse(event.data as string);
      if (message.answer) this.on.answer(message.answer);
      else if (message.append) this.on.append(message.append);
      else if (message.version) this.on.data(message as DataJson);
    };
    socket.onclose = () => {
      if (this.socket !== socket) return;
      this.become("lost");
      setTimeout(() => this.open(), RETRY_MS[Math.min(this.attempts++, RETRY_MS.length - 1)]);
    };
  }

  /** Whether the order left the page. */
  send(order: string, values: number[] = []): boolean {
    if (this.socket?.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify({ order, values, token: this.config.token }));
    return true;
  }
}

/** Buttons for a flight under way: pause, go on, land, a goal on the ground; and how much of the past is shown. */
export class LivePanel {
  readonly element: HTMLElement;
  readonly badge = h("span.link-badge.connecting", { role: "status", "aria-live": "polite" }, "connecting");
  /** Over the scene: that what is seen is old. */
  readonly notice = h("p.lost-notice", { role: "alert", hidden: true });
  private readonly toast = h("p.toast", { role: "status", "aria-live": "polite", hidden: true });
  private readonly goalBar = h("form.goal-bar", { hidden: true });
  private readonly follow: HTMLElement;
  private readonly goalButton: HTMLElement;
  private readonly buttons: HTMLButtonElement[];
  private scene: FlightScene | null = null;
  private hide = 0;
  /** The flight is judged: that whoever flew it has gone is no alarm any more. */
  over = false;

  constructor(state: State, private readonly send: (order: string, values?: number[]) => boolean) {
    const button = (name: string, label: string, act: () => void, kind = "") => h<HTMLButtonElement>(`button.order${kind}`, {
      type: "button", "data-order": name, onclick: act, disabled: true,
    }, icon({ hold: "hold", resume: "play", land: "land", goto: "go" }[name]!), label);
    this.goalButton = button("goto", "Fly to …", () => this.askGoal());
    this.buttons = [
      button("hold", "Hold", () => this.give("hold")), button("resume", "Resume", () => this.give("resume")),
      this.goalButton as HTMLButtonElement, button("land", "Land", () => this.confirmLand(), ".danger"),
    ];
    this.follow = h("button.pill", { type: "button", "aria-pressed": "true", "data-live-follow": "", onclick: () => state.setFollow(true) }, "live");
    const windows = h<HTMLSelectElement>("select", {
      "aria-label": "how much of the past is shown", onchange: () => state.setFollow(true, Number(windows.value)),
    }, WINDOWS.map(([name, seconds]) => h("option", { value: String(seconds), selected: seconds === state.window }, name)));
    this.element = h("div.live-panel", h("div.orders", this.buttons), this.goalBar, this.toast, h("div.live-window", this.follow, windows));
    state.on("live", () => this.follow.setAttribute("aria-pressed", String(state.follow)));
  }

  attach(scene: FlightScene): void {
    this.scene = scene;
  }

  show(link: LinkState, heard: number): void {
    const silent = (performance.now() - heard) / 1000;
    const ago = heard ? ` ${silent.toFixed(0)} s ago` : "";
    const gone = link === "lost" && this.over, alarm = !gone && (link === "lost" || link === "silent");
    this.badge.textContent = gone ? "ended" : { connecting: "connecting", connected: "live", silent: "silent", lost: "lost" }[link];
    this.notice.textContent = link === "lost" ? `Connection lost${ago}, trying again. What you see is old.` : `Nothing heard for ${silent.toFixed(0)} s. What you see is old.`;
    this.notice.hidden = !alarm;
    this.badge.className = `link-badge ${gone ? "ended" : link}`;
    document.body.classList.toggle("link-lost", alarm);
    for (const b of this.buttons) b.disabled = this.over || (link !== "connected" && link !== "silent");
    if (this.over) this.endGoal();
  }

  answered(answer: { order: string; ok: boolean; text: string }): void {
    this.say(`${answer.order}: ${answer.text || (answer.ok ? "done" : "refused")}`, !answer.ok);
  }

  private say(text: string, bad = false): void {
    this.toast.textContent = text;
    this.toast.classList.toggle("bad", bad);
    this.toast.hidden = false;
    clearTimeout(this.hide);
    this.hide = window.setTimeout(() => (this.toast.hidden = true), 6000);
  }

  private give(order: string, values: number[] = []): void {
    if (this.send(order, values)) this.say(`${order} asked for`);
    else this.say(`no connection: ${order} was not sent`, true);
  }

  private confirmLand(): void {
    const dialog = h<HTMLDialogElement>("dialog.confirm", { "aria-label": "land?", onclose: () => dialog.remove() }, h("div.dialog-body",
      h("h2", "Land now?"), h("p", "The vehicle comes down where it is."),
      h("div.dialog-buttons",
        h("button", { type: "button", onclick: () => dialog.close() }, "cancel"),
        h("button.danger", { type: "button", "data-confirm": "land", onclick: () => { dialog.close(); this.give("land"); } }, "Land"))));
    document.body.append(dialog);
    dialog.showModal();
    dialog.querySelector<HTMLElement>("[data-confirm]")!.focus();
  }

  private askGoal(): void {
    const { scene } = this;
    if (!scene) return;
    if (scene.onGoal) return this.endGoal();
    scene.element.classList.add("aiming");
    this.goalButton.setAttribute("aria-pressed", "true");
    const level = document.querySelector<HTMLElement>("[data-readout=up] .value")?.textContent ?? "";
    const height = Math.max(1, Number(level.replace("−", "-")) || 1.5);
    let place: [number, number] | null = null;
    const altitude = h<HTMLInputElement>("input", { type: "number", step: "0.1", value: height.toFixed(1), "aria-label": "altitude in metres", oninput: () => draw() });
    const where = h("span.where", "click the ground in the scene");
    const go = h<HTMLButtonElement>("button.primary", { type: "submit", disabled: true, "data-confirm": "goto" }, "Fly there");
    const draw = () => {
      const up = Number(altitude.value);
      go.disabled = !place || !Number.isFinite(up);
      if (place) where.textContent = `north ${fixed(place[0], 1)}, east ${fixed(place[1], 1)} m`;
      scene.showGoal(place ? [...place, Number.isFinite(up) ? up : 0] : null);
    };
    scene.onGoal = (north, east) => {
      place = [Number(north.toFixed(2)), Number(east.toFixed(2))];
      draw();
    };
    this.goalBar.replaceChildren(where, h("label", "altitude ", altitude, " m"), go,
      h("button", { type: "button", onclick: () => this.endGoal() }, "cancel"));
    this.goalBar.onsubmit = (event) => {
      event.preventDefault();
      if (!place) return;
      this.give("goto", [...place, Number(altitude.value)]);
      this.endGoal();
    };
    this.goalBar.hidden = false;
  }

  private endGoal(): void {
    const { scene } = this;
    if (!scene) return;
    scene.onGoal = null;
    scene.showGoal(null);
    scene.element.classList.remove("aiming");
    this.goalButton.setAttribute("aria-pressed", "false");
    this.goalBar.hidden = true;
  }
}
