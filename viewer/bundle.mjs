// SPDX-License-Identifier: BSD-3-Clause
//
// node bundle.mjs CORE.wasm TEMPLATE.html: style, program, core and licences become one page; the same files
// give the same bytes.
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";

const [core, to] = process.argv.slice(2);
const bundled = await build({
  entryPoints: ["src/main.ts"],
  bundle: true,
  format: "iife",
  minify: true,
  charset: "utf8",
  target: "es2022",
  write: false,
  legalComments: "none",
});
const script = bundled.outputFiles[0].text.trim();
if (/<\/script|<!--/i.test(script)) throw new Error("the program would end its own element");
const style = readFileSync("src/page.css", "utf8");
const packed = gzipSync(readFileSync(core), { level: 9 });
packed[9] = 255; // the system that packed it: not said
const hash = text => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;
const escaped = text => text.replaceAll("&", "&amp;").replaceAll("<", "&lt;");
const parts = {
  POLICY:
    `default-src 'none'; script-src ${hash(script)} 'wasm-unsafe-eval'; ` +
    `style-src ${hash(style)}; img-src data:; ` +
    "base-uri 'none'; form-action 'none'",
  STYLE: style,
  LICENCES: escaped(
    readFileSync("licences.txt", "utf8") + "\n" + readFileSync("../LICENSES/BSD-3-Clause.txt", "utf8"),
  ),
  CORE: packed.toString("base64"),
  SCRIPT: script,
};
const page = readFileSync("src/page.html", "utf8").replace(/@([A-Z]+)@/g, (all, name) => parts[name] ?? all);
writeFileSync(to, page);
const kilobytes = text => `${(text.length / 1000).toFixed(0)} kB`;
console.log(
  `${to}: ${kilobytes(page)}, of it the core ${kilobytes(parts.CORE)}, the program ${kilobytes(script)}`,
);
