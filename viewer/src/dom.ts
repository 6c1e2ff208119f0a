// SPDX-License-Identifier: BSD-3-Clause
//
// Elements of the page. What comes from the data goes into text alone.

export function element<T extends HTMLElement = HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) throw new Error("no element " + id);
  return found as T;
}

type Child = Node | string;

export function make<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Record<string, string> = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

export function button(words: string, action: () => void, label = words): HTMLButtonElement {
  const made = make("button", { type: "button", "aria-label": label }, words);
  made.addEventListener("click", action);
  return made;
}

/** Asked where the pointer is while it is held down on a canvas. */
export function whileHeld(canvas: HTMLCanvasElement, at: (e: PointerEvent) => void): void {
  canvas.addEventListener("pointerdown", e => {
    canvas.setPointerCapture(e.pointerId);
    at(e);
  });
  canvas.addEventListener("pointermove", e => {
    if (e.buttons & 1) at(e);
  });
}

/** A table whose first row and first column are headers. */
export function fillTable(table: HTMLTableElement, caption: string, head: string[], rows: Child[][]): void {
  table.replaceChildren(
    make("caption", {}, caption),
    make("thead", {}, make("tr", {}, ...head.map(h => make("th", { scope: "col" }, h)))),
    make(
      "tbody",
      {},
      ...rows.map(row =>
        make(
          "tr",
          {},
          ...row.map((cell, i) => (i ? make("td", {}, cell) : make("th", { scope: "row" }, cell))),
        ),
      ),
    ),
  );
}

/** Colours as the style sheet has them, in light or dark. */
export function colour(name: string): string {
  return getComputedStyle(document.documentElement)
    .getPropertyValue("--" + name)
    .trim();
}

/** A canvas of as many pixels as the screen has for it; sizes are those of the style sheet. */
export function sized(canvas: HTMLCanvasElement): {
  context: CanvasRenderingContext2D;
  width: number;
  height: number;
} {
  const ratio = window.devicePixelRatio || 1,
    width = canvas.clientWidth || 300,
    height = canvas.clientHeight || 200;
  const [w, h] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== w || canvas.height !== h) [canvas.width, canvas.height] = [w, h];
  const context = canvas.getContext("2d");
  if (!context) throw new Error("no canvas");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  return { context, width, height };
}

/** Around a canvas: 1, 2 or 5 times a power of ten, no smaller than `rough`. */
export function niceStep(rough: number): number {
  const power = 10 ** Math.floor(Math.log10(rough));
  return power * ([1, 2, 5].find(k => k * power >= rough * (1 - 1e-9)) ?? 10);
}

/** Calls `draw` before the next picture, once however often it is asked. */
export function nextFrame(draw: () => void): () => void {
  let waits = false;
  return () => {
    if (waits) return;
    waits = true;
    requestAnimationFrame(() => {
      waits = false;
      draw();
    });
  };
}
