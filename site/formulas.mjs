// Writes the formulas of standard input, a JSON array of [LaTeX, display] pairs, as HTML for KaTeX's style sheet.
import { readFileSync } from "node:fs";
import katex from "../web/test/node_modules/katex/dist/katex.mjs";

const formulas = JSON.parse(readFileSync(0, "utf8"));
process.stdout.write(JSON.stringify(formulas.map(([text, displayMode]) =>
  katex.renderToString(text, { displayMode, strict: "error" }))));
