// One script and one style sheet into ../logs/report/bundle, or the folder given, with the licences of what is inside them.
import { createHash } from "node:crypto";
import { readFileSync, readdirSync, writeFileSync } from "node:fs";
import { build } from "esbuild";

const out = process.argv[2] ?? "../logs/report/bundle";

/** The digest by which tests/pages tell that the bundle was built from these sources. */
const digest = createHash("sha256");
for (const name of readdirSync("src").sort()) digest.update(name).update("\0").update(readFileSync(`src/${name}`));
for (const name of ["build.mjs", "package-lock.json"]) digest.update(readFileSync(name));

const notices = ["three", "uplot"].map((name) => {
  const { version, homepage } = JSON.parse(readFileSync(`node_modules/${name}/package.json`, "utf8"));
  return `${name} ${version}, ${homepage}\n\n${readFileSync(`node_modules/${name}/LICENSE`, "utf8").trim()}`;
});
const banner = `/*!\nBuilt by 'make web' from web/ of companion (MIT), sources ${digest.digest("hex")}. It contains:\n\n${notices.join("\n\n")}\n*/`;

await build({
  entryPoints: { report: "src/main.ts" },
  bundle: true,
  minify: true,
  format: "iife",
  target: ["es2022"],
  charset: "utf8",
  legalComments: "none", // they are in the banner, whole
  banner: { js: banner, css: "/*! parts of uPlot (MIT); the notice stands in report.js */" },
  outdir: out,
  logLevel: "info",
});
writeFileSync(`${out}/LICENSES.txt`, `${notices.join(`\n\n${"-".repeat(80)}\n\n`)}\n`);
