/**
 * What the parts of the page share: one cursor, one time range, one clock.
 *
 * A part says what it listens to; changes are gathered and told once a frame, so that ten moves of the mouse cost one
 * redraw. Nothing else is shared.
 */

export type Topic = "cursor" | "range" | "play" | "theme" | "data" | "live";
const SPEEDS = [0.25, 0.5, 1, 2, 5, 10];

export class State {
  /** The flight's span [s]; grows while live. */
  full: [number, number] = [0, 1];
  /** What the plots show [s]. */
  range: [number, number] = [0, 1];
  cursor = 0;
  /** Where the cursor goes back to when the mouse leaves a plot: where it was last put on purpose. */
  private pinned = 0;
  playing = false;
  speed = 1;
  /** Live: the cursor stays at the newest moment and the range follows it. */
  follow = false;
  /** Live: how much of the past is shown [s]; 0 is all. */
  window = 60;

  private listeners = new Map<Topic, Set<() => void>>();
  private changed = new Set<Topic>();
  private waiting = false;
  private lastFrame = 0;

  on(topics: Topic | Topic[], listener: () => void): void {
    for (const topic of [topics].flat()) {
      if (!this.listeners.has(topic)) this.listeners.set(topic, new Set());
      this.listeners.get(topic)!.add(listener);
    }
  }

  tell(topic: Topic): void {
    this.changed.add(topic);
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => this.flush());
  }

  private flush(): void {
    const topics = [...this.changed];
    this.changed.clear();
    this.waiting = false;
    const due = new Set(topics.flatMap((topic) => [...(this.listeners.get(topic) ?? [])]));
    for (const listener of due) listener();
  }

  setFull(low: number, high: number): void {
    const whole = this.range[0] <= this.full[0] && this.range[1] >= this.full[1];
    this.full = [low, Math.max(high, low + 1e-3)];
    if (this.follow) this.followNow();
    else if (whole) this.range = [...this.full];
    this.tell("range");
  }

  private followNow(): void {
    this.cursor = this.pinned = this.full[1];
    this.range = this.window ? [Math.max(this.full[0], this.full[1] - this.window), this.full[1]] : [...this.full];
    if (this.range[1] - this.range[0] < 1) this.range[1] = this.range[0] + 1;
    this.tell("cursor");
  }

  setFollow(follow: boolean, window = this.window): void {
    this.follow = follow;
    this.window = window;
    if (follow) this.followNow();
    this.tell("range");
    this.tell("live");
  }

  setCursor(t: number): void {
    if (this.follow) this.setFollow(false);
    this.cursor = this.pinned = Math.max(this.full[0], Math.min(this.full[1], t));
    this.tell("cursor");
  }

  /** Look at a moment in passing; null: no longer. */
  hover(t: number | null): void {
    if (this.playing || this.follow) return;
    this.cursor = t === null ? this.pinned : Math.max(this.full[0], Math.min(this.full[1], t));
    this.tell("cursor");
  }

  setRange(low: number, high: number): void {
    const span = Math.max(1e-3, Math.min(high - low, this.full[1] - this.full[0]));
    const start = Math.max(this.full[0], Math.min(this.full[1] - span, low));
    if (this.follow) this.setFollow(false);
    this.range = [start, start + span];
    this.tell("range");
  }

  resetRange(): void {
    this.setRange(...this.full);
  }

  /** Zoom the time axes about the cursor, or about another moment. */
  zoom(factor: number, about = this.cursor): void {
    const [low, high] = this.range;
    const centre = about >= low && about <= high ? about : (low + high) / 2;
    this.setRange(centre - (centre - low) * factor, centre + (high - centre) * factor);
  }

  /** Keep the cursor in sight. */
  reveal(): void {
    const [low, high] = this.range;
    if (this.cursor < low || this.cursor > high) {
      const half = (high - low) / 2;
      this.setRange(this.cursor - half, this.cursor + half);
    }
  }

  setPlaying(playing: boolean): void {
    if (playing === this.playing) return;
    if (playing && this.follow) this.setFollow(false);
    if (playing && this.cursor >= this.full[1] - 1e-6) this.setCursor(this.full[0]);
    this.playing = playing;
    this.tell("play");
    if (!playing) return;
    this.lastFrame = performance.now();
    const step = (now: number) => {
      if (!this.playing) return;
      const next = this.cursor + ((now - this.lastFrame) / 1000) * this.speed;
      this.lastFrame = now;
      this.setCursor(next);
      this.reveal();
      if (next >= this.full[1]) this.setPlaying(false);
      else requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  setSpeed(speed: number): void {
    this.speed = speed;
    this.tell("play");
  }

  slower(): void {
    this.setSpeed(SPEEDS[Math.max(0, SPEEDS.indexOf(this.speed) - 1)]);
  }

  faster(): void {
    this.setSpeed(SPEEDS[Math.min(SPEEDS.length - 1, SPEEDS.indexOf(this.speed) + 1)]);
  }
}

export { SPEEDS };
