// SPDX-License-Identifier: BSD-3-Clause
//
// The doubles around a velocity: the verdict on each, as letters in a table.
import { VERDICTS, type Pair, type Vec } from "./core";
import { make } from "./dom";
import { stepped } from "./doubles";

const REACH = 8;
const LETTERS = ["o", "N", "i", "T", "V", "?"]; // of VERDICTS

/** Of components `across` and `up` changed by -8 to 8 units in the last place; how many of each verdict. */
export function fillNeighbours(
  table: HTMLTableElement,
  pair: Pair,
  v: Vec,
  u: Vec,
  across: number,
  up: number,
): number[] {
  const steps = Array.from({ length: 2 * REACH + 1 }, (_, i) => i - REACH);
  const velocities: number[] = [];
  for (const j of [...steps].reverse())
    for (const i of steps) {
      const one: Vec = [...v];
      one[across] = stepped(v[across], i);
      one[up] = stepped(v[up], j);
      velocities.push(...one);
    }
  const found = pair.verdicts(new Float64Array(velocities), u);
  const counts = VERDICTS.map(() => 0);
  found.forEach(verdict => ++counts[verdict]);
  const cells = table.querySelectorAll("td");
  if (cells.length !== found.length) build(table, steps);
  table.querySelectorAll("td").forEach((cell, i) => {
    cell.textContent = LETTERS[found[i]];
    cell.className = VERDICTS[found[i]] + (i === (found.length - 1) / 2 ? " here" : "");
  });
  return counts;
}

function build(table: HTMLTableElement, steps: number[]): void {
  table.replaceChildren(
    make("caption", {}, "Units in the last place: columns change the first component, rows the second"),
    make(
      "thead",
      {},
      make(
        "tr",
        {},
        make("th", { scope: "col" }, "ulp"),
        ...steps.map(i => make("th", { scope: "col" }, String(i))),
      ),
    ),
    make(
      "tbody",
      {},
      ...[...steps]
        .reverse()
        .map(j => make("tr", {}, make("th", { scope: "row" }, String(j)), ...steps.map(() => make("td")))),
    ),
  );
}
