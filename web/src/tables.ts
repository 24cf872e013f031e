/** Tables: sorted by a click on a column's head, long ones folded and searched. */

import type { TableJson } from "./data";
import { h } from "./dom";
import { cell } from "./format";

const FOLDED = 12;

export class DataTable {
  readonly element: HTMLElement;
  private readonly body = h("tbody");
  private readonly more = h("button.more", { type: "button", onclick: () => { this.open = !this.open; this.fill(); } });
  private readonly heads: HTMLElement[];
  private readonly numeric: boolean[];
  private open = false;
  private sorted: { column: number; down: boolean } | null = null;
  private words = "";

  constructor(private json: TableJson) {
    this.numeric = json.columns.map((name, k) =>
      (json.rows.some((r) => typeof r[k] === "number") || name.endsWith("]")) && json.rows.every((r) => typeof r[k] !== "string"));
    this.heads = json.columns.map((name, k) => h("th", { scope: "col", class: this.numeric[k] ? "num" : "" },
      h("button", { type: "button", title: `sort by ${name}`, onclick: () => this.sort(k) }, name)));
    const search = h<HTMLInputElement>("input", {
      type: "search", placeholder: "search", "aria-label": `search in ${json.title}`,
      oninput: () => { this.words = search.value.toLowerCase(); this.fill(); },
    });
    this.element = h("figure.table.card", { "data-table": json.title },
      h("figcaption", h("span.plot-title", json.title), json.rows.length > FOLDED ? search : null),
      h("div.scroll", h("table", h("thead", h("tr", this.heads)), this.body)), this.more);
    addEventListener("beforeprint", () => { if (!this.open) { this.open = true; this.fill(); } });
    this.fill();
  }

  replace(json: TableJson): void {
    this.json = json;
    this.fill();
  }

  private sort(column: number): void {
    this.sorted = this.sorted?.column === column ? (this.sorted.down ? null : { column, down: true }) : { column, down: false };
    this.heads.forEach((head, k) => {
      if (this.sorted?.column === k) head.setAttribute("aria-sort", this.sorted.down ? "descending" : "ascending");
      else head.removeAttribute("aria-sort");
    });
    this.fill();
  }

  private fill(): void {
    let rows = this.json.rows.filter((row) => !this.words || row.some((v) => cell(v).toLowerCase().includes(this.words)));
    if (this.sorted) {
      const { column, down } = this.sorted;
      rows = [...rows].sort((a, b) => {
        const [p, q] = [a[column], b[column]];
        const order = typeof p === "number" && typeof q === "number" ? p - q : cell(p).localeCompare(cell(q), "en", { numeric: true });
        return down ? -order : order;
      });
    }
    const shown = this.open || this.words ? rows : rows.slice(0, FOLDED);
    this.body.replaceChildren(...shown.map((row) => h("tr", row.map((v, k) => h("td", { class: this.numeric[k] ? "num" : "" }, cell(v))))));
    if (!rows.length) this.body.append(h("tr", h("td.empty", { colSpan: this.json.columns.length }, "nothing")));
    this.more.hidden = rows.length <= FOLDED || !!this.words;
    this.more.textContent = this.open ? "fewer" : `all ${rows.length}`;
  }
}
