/** The head of the page: how it went, what was checked, what it was flown with, what was lost. */

import type { HeaderJson } from "./data";
import { h } from "./dom";
import { cell, clock, number } from "./format";

export function verdictWord(header: HeaderJson): { word: string; tone: string } {
  if (header.ok === true) return { word: "passed", tone: "good" };
  if (header.ok === false) return { word: "failed", tone: "bad" };
  return { word: header.phase || "no verdict", tone: "neutral" };
}

export class Verdict {
  readonly element = h("section.verdict", { id: "verdict", "aria-label": "verdict" });
  private header: HeaderJson;

  constructor(header: HeaderJson) {
    this.header = header;
    this.draw();
  }

  update(more: Partial<HeaderJson>): HeaderJson {
    this.header = { ...this.header, ...more };
    this.draw();
    return this.header;
  }

  private draw(): void {
    const { header } = this;
    const { word, tone } = verdictWord(header);
    const failed = header.checks.filter((c) => c.ok === false).length;
    const held = header.checks.filter((c) => c.ok === true).length;
    const lost = header.loss.reduce((sum, [, count]) => sum + count, 0);
    const summary = [
      header.duration_s > 0 ? `${clock(header.duration_s, 1)} flown` : "",
      header.checks.length ? (failed ? `${failed} of ${header.checks.length} checks failed` : `${held} of ${header.checks.length} checks held`) : "",
      header.loss.length ? (lost ? `${number(lost)} lost in recording` : "nothing lost") : "",
      header.phase && header.phase !== "done" && header.ok === false ? `ended as "${header.phase}"` : "",
    ].filter(Boolean);
    const why = header.failure || header.checks.filter((c) => c.ok === false).map((c) => `${words(c.name)}: ${found(c.value)}, expected ${bound(c.expected)}`).join("; ");
    this.element.replaceChildren(
      h(`div.banner.${tone}`,
        h("span.stamp", word),
        h("div", h("h1", header.title), h("p.summary", summary.join(" · "), header.start_utc ? h("span.when", when(header.start_utc)) : null),
          why ? h("p.failure", why) : null)),
      h("div.verdict-grid", this.checks(), this.loss(), this.facts()));
  }

  private checks(): HTMLElement | null {
    const { checks } = this.header;
    if (!checks.length) return null;
    return h("figure.card.checks", h("figcaption", h("span.plot-title", "Checks")),
      h("div.scroll", h("table",
        h("thead", h("tr", h("th", { scope: "col" }, ""), h("th", { scope: "col" }, "what"), h("th.num", { scope: "col" }, "found"), h("th.num", { scope: "col" }, "expected"))),
        h("tbody", checks.map((c) => h("tr", { class: c.ok === false ? "failed" : "" },
          h("td.mark", { "aria-label": c.ok === false ? "failed" : c.ok ? "held" : "not judged" }, c.ok === false ? "✕" : c.ok ? "✓" : "·"),
          h("td", words(c.name)), h("td.num", found(c.value)), h("td.num.dim", bound(c.expected))))))));
  }

  private facts(): HTMLElement | null {
    const { facts } = this.header;
    if (!facts.length) return null;
    return h("figure.card.facts", h("figcaption", h("span.plot-title", "Flown with")),
      h("dl", facts.map(([name, value]) => h("div", h("dt", words(name)), h("dd", ...(typeof value === "number" ? [number(value, 6)] : parted(cell(value))))))));
  }

  private loss(): HTMLElement | null {
    const { loss } = this.header;
    if (!loss.length) return null;
    return h("figure.card.loss", h("figcaption", h("span.plot-title", "Lost in recording")),
      h("dl", loss.map(([name, count]) => h(`div${count ? ".some" : ""}`, h("dt", words(name)), h("dd", count.toLocaleString("en"))))));
  }
}

/** What was found, in as many digits as a person compares. */
function found(value: unknown): string {
  return typeof value === "number" ? number(value) : cell(value);
}

/** What was expected: "<= 0.35" is "≤ 0.35". */
function bound(value: unknown): string {
  return cell(value).replace("<=", "≤").replace(">=", "≥");
}

/** Names of fields as people write them: duration_max_s is "duration max [s]". */
function words(name: string): string {
  return name.replace(/_(m|s|ms|hz|deg|rad|m_s)$/, (_, unit: string) => ` [${{ hz: "Hz", deg: "°", m_s: "m/s" }[unit] ?? unit}]`).replaceAll("_", " ");
}

/** A name that may be long, such as a path, which a line may end in at its marks. */
function parted(text: string): (string | Node)[] {
  return text.split(/(?<=[/_-])/).flatMap((part) => [part, document.createElement("wbr")]);
}

function when(utc: string): string {
  const date = new Date(utc);
  if (Number.isNaN(date.getTime())) return ` · ${utc}`;
  return ` · ${date.toLocaleString("en-GB", { dateStyle: "medium", timeStyle: "short", timeZone: "UTC" })} UTC`;
}
