// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies in space on a 2-D canvas, painted from the far end to the near one: no WebGL is asked for.
import type { Vec } from "./core";
import type { Surface } from "./data";
import { button, colour, niceStep, sized } from "./dom";
import { cross, dot, norm, plus, short, turned } from "./doubles";

export interface Shown {
  surface: Surface;
  rotation: number[];
  at: Vec;
  colour: string;
  alpha: number;
}
export interface Line {
  points: Vec[];
  colour: string;
  width: number;
  dashed?: boolean;
  arrow?: boolean;
  words?: string;
}
export interface Picture {
  bodies: Shown[];
  lines: Line[];
}

/** 1 or -1 where all triangles of a closed surface have their outer side to the left, or to the right, of their borders;
 *  0: it is not closed, or not so. Of one that stands before what is behind it, half need not be painted. */
const sides = new WeakMap<Surface, number>();
function outerSide(surface: Surface): number {
  const known = sides.get(surface);
  if (known !== undefined) return known;
  const { points, triangles } = surface,
    edges = new Set<number>(),
    count = points.length / 3;
  const at = (i: number): Vec => [points[3 * i], points[3 * i + 1], points[3 * i + 2]];
  let volume = 0;
  for (let i = 0; i < triangles.length; i += 3) {
    const [a, b, c] = [triangles[i], triangles[i + 1], triangles[i + 2]];
    for (const edge of [a * count + b, b * count + c, c * count + a]) edges.add(edge);
    volume += dot(at(a), cross(at(b), at(c)));
  }
  let closed = edges.size === triangles.length;
  for (const edge of edges) closed &&= edges.has((edge % count) * count + Math.floor(edge / count));
  const side = closed ? Math.sign(volume) : 0;
  sides.set(surface, side);
  return side;
}

const MOST = 30000; // triangles painted at once

interface Face {
  depth: number;
  path: number[];
  fill: string;
  alpha: number;
  dot: number; // pixels to its border; 0: a triangle
}

export class SolidView {
  private yaw = -55;
  private pitch = 24;
  private zoom = 1;
  private middle: Vec = [0, 0, 0];
  private corners: Vec[] = [];

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly planar: boolean,
    private readonly redraw: () => void,
  ) {
    if (planar) [this.yaw, this.pitch] = [-90, 90];
    canvas.addEventListener("pointerdown", e => {
      canvas.setPointerCapture(e.pointerId);
    });
    canvas.addEventListener("pointermove", e => {
      if (e.buttons & 1) this.turn(-0.4 * e.movementX, 0.4 * e.movementY);
    });
    canvas.addEventListener(
      "wheel",
      e => {
        if (!e.ctrlKey && document.activeElement !== canvas) return; // the page scrolls
        e.preventDefault();
        this.scale(Math.exp(-0.001 * e.deltaY));
      },
      { passive: false },
    );
    canvas.addEventListener("keydown", e => {
      const turns: Record<string, [number, number]> = {
        ArrowLeft: [-5, 0],
        ArrowRight: [5, 0],
        ArrowUp: [0, 5],
        ArrowDown: [0, -5],
      };
      if (turns[e.key]) this.turn(...turns[e.key]);
      else if (e.key === "+" || e.key === "=") this.scale(1.2);
      else if (e.key === "-") this.scale(1 / 1.2);
      else if (e.key === "0") this.reset();
      else return;
      e.preventDefault();
    });
  }

  turn(yaw: number, pitch: number): void {
    if (this.planar) return;
    this.yaw += yaw;
    this.pitch = Math.min(90, Math.max(-90, this.pitch + pitch));
    this.redraw();
  }
  /** From where it is looked at, and how large: of a planar scene the size alone. */
  buttons(planar: boolean): HTMLButtonElement[] {
    const from = planar
      ? []
      : [
          button("from above", () => this.look(-90, 90)),
          button("along x", () => this.look(180, 0)),
          button("along y", () => this.look(-90, 0)),
        ];
    return [
      ...from,
      button("+", () => this.scale(1.2), "larger"),
      button("\u2212", () => this.scale(1 / 1.2), "smaller"),
      button("reset", () => this.reset(), "reset the view"),
    ];
  }
  look(yaw: number, pitch: number): void {
    if (!this.planar) [this.yaw, this.pitch] = [yaw, pitch];
    this.redraw();
  }
  scale(by: number): void {
    this.zoom = Math.min(50, Math.max(0.05, this.zoom * by));
    this.redraw();
  }
  reset(): void {
    this.zoom = 1;
    this.look(-55, 24);
  }
  /** What is to be seen, once and for all. */
  fit(points: Vec[]): void {
    const low = [0, 1, 2].map(k => Math.min(...points.map(p => p[k]))) as Vec;
    const high = [0, 1, 2].map(k => Math.max(...points.map(p => p[k]))) as Vec;
    this.middle = [0, 1, 2].map(k => (low[k] + high[k]) / 2) as Vec;
    this.corners = Array.from({ length: 8 }, (_, i) => low.map((x, k) => ((i >> k) & 1 ? high[k] : x)) as Vec);
  }

  /** How many triangles there are, and how many were painted. */
  draw(picture: Picture): [number, number] {
    const { context, width, height } = sized(this.canvas);
    const y = (this.yaw * Math.PI) / 180,
      p = (this.pitch * Math.PI) / 180;
    const toward: Vec = [Math.cos(p) * Math.cos(y), Math.cos(p) * Math.sin(y), Math.sin(p)];
    const right: Vec = [-Math.sin(y), Math.cos(y), 0],
      up = cross(toward, right);
    const reach = (e: Vec): number =>
      Math.max(...this.corners.map(c => Math.abs(dot(e, plus(c, this.middle, -1)))), 1e-300);
    const scale = this.zoom * Math.min((0.46 * width) / reach(right), (0.46 * height) / reach(up));
    const flat = (q: Vec): [number, number] => {
      const d = plus(q, this.middle, -1);
      return [width / 2 + scale * dot(right, d), height / 2 - scale * dot(up, d)];
    };
    context.fillStyle = colour("paper");
    context.fillRect(0, 0, width, height);
    const all = picture.bodies.reduce((n, b) => n + b.surface.triangles.length / 3, 0);
    const every = Math.max(1, Math.ceil(all / MOST));
    const faces = picture.bodies.flatMap(b => this.faces(b, flat, toward, up, every, scale));
    faces.sort((a, b) => a.depth - b.depth);
    for (const face of faces) paint(context, face);
    context.globalAlpha = 1;
    for (const line of picture.lines) stroke(context, line, flat);
    this.axes(context, right, up, height);
    scaleBar(context, scale, width, height);
    return [all, every > 1 ? faces.length : all];
  }

  private faces(
    body: Shown,
    flat: (q: Vec) => [number, number],
    toward: Vec,
    up: Vec,
    every: number,
    scale: number,
  ): Face[] {
    const { points, triangles } = body.surface;
    const world: Vec[] = [];
    for (let i = 0; i < points.length; i += 3)
      world.push(plus(body.at, turned(body.rotation, [points[i], points[i + 1], points[i + 2]])));
    const rgb = body.colour.match(/[0-9a-f]{2}/gi)?.map(h => parseInt(h, 16)) ?? [128, 128, 128];
    const lit = (light: number): string =>
      `rgb(${rgb.map(c => Math.round(c * (0.45 + 0.55 * light))).join(",")})`;
    const faces: Face[] = [];
    const side = this.planar || body.alpha < 1 ? 0 : outerSide(body.surface);
    for (let i = 0; i < triangles.length; i += 3 * every) {
      const [a, b, c] = [world[triangles[i]], world[triangles[i + 1]], world[triangles[i + 2]]];
      const n = cross(plus(b, a, -1), plus(c, a, -1)),
        length = norm(n) || 1;
      if (side * dot(n, toward) < 0) continue; // behind the body's own front
      const light = this.planar ? 1 : Math.abs(dot(n, toward) + 0.5 * dot(n, up)) / length / 1.12;
      faces.push({
        depth: dot(a, toward) + dot(b, toward) + dot(c, toward),
        alpha: body.alpha,
        dot: 0,
        path: [...flat(a), ...flat(b), ...flat(c)],
        fill: lit(Math.min(light, 1)),
      });
    }
    if (!triangles.length)
      world.forEach((q, i) =>
        faces.push({
          depth: 3 * dot(q, toward),
          alpha: body.alpha,
          dot: Math.max(1, scale * (body.surface.sizes?.[i] ?? 0)),
          path: flat(q),
          fill: lit(body.surface.sizes ? 0.5 + 0.5 * hash(i) : 1),
        }),
      );
    return faces;
  }

  private axes(context: CanvasRenderingContext2D, right: Vec, up: Vec, height: number): void {
    const at = [34, height - 34];
    context.font = "12px sans-serif";
    context.textAlign = "center";
    context.textBaseline = "middle";
    for (let k = 0; k < (this.planar ? 2 : 3); ++k) {
      const [x, y] = [22 * right[k], -22 * up[k]];
      context.strokeStyle = context.fillStyle = colour("quiet");
      context.lineWidth = 1.4;
      context.beginPath();
      context.moveTo(at[0], at[1]);
      context.lineTo(at[0] + x, at[1] + y);
      context.stroke();
      context.fillText("xyz"[k], at[0] + 1.4 * x, at[1] + 1.4 * y);
    }
  }
}

/** Lightness of one of many boxes, so that neighbours are told apart. */
const hash = (i: number): number => ((i * 2654435761) % 1024) / 1024;

/** Nothing is foreshortened across the line of sight: one bar holds for all of the picture. */
function scaleBar(context: CanvasRenderingContext2D, scale: number, width: number, height: number): void {
  const metres = niceStep(50 / scale),
    pixels = metres * scale,
    x = width - 12 - pixels,
    y = height - 12;
  context.fillStyle = colour("quiet");
  context.fillRect(x, y, pixels, 2);
  context.fillRect(x, y - 4, 1, 6);
  context.fillRect(x + pixels - 1, y - 4, 1, 6);
  context.textAlign = "center";
  context.textBaseline = "bottom";
  context.fillText(short(metres) + " m", x + pixels / 2, y - 4);
}

function paint(context: CanvasRenderingContext2D, face: Face): void {
  context.globalAlpha = face.alpha;
  context.fillStyle = context.strokeStyle = face.fill;
  if (face.dot)
    return context.fillRect(face.path[0] - face.dot, face.path[1] - face.dot, 2 * face.dot, 2 * face.dot);
  const [a, b, c, d, e, f] = face.path;
  context.beginPath();
  context.moveTo(a, b);
  context.lineTo(c, d);
  context.lineTo(e, f);
  context.closePath();
  context.fill();
  if (face.alpha < 1) return;
  context.lineWidth = 0.6; // closes the seams between neighbours
  context.stroke();
}

function stroke(context: CanvasRenderingContext2D, line: Line, flat: (q: Vec) => [number, number]): void {
  const ends = line.points.map(flat);
  if (!ends.length) return;
  context.strokeStyle = context.fillStyle = line.colour;
  context.lineWidth = line.width;
  context.setLineDash(line.dashed ? [5, 4] : []);
  context.beginPath();
  ends.forEach((q, i) => (i ? context.lineTo(...q) : context.moveTo(...q)));
  context.stroke();
  context.setLineDash([]);
  const last = ends[ends.length - 1];
  if (line.arrow && ends.length > 1) {
    const [x, y] = [last[0] - ends[ends.length - 2][0], last[1] - ends[ends.length - 2][1]],
      n = Math.hypot(x, y) || 1;
    context.beginPath();
    context.moveTo(...last);
    context.lineTo(last[0] - (9 * x - 4 * y) / n, last[1] - (9 * y + 4 * x) / n);
    context.lineTo(last[0] - (9 * x + 4 * y) / n, last[1] - (9 * y - 4 * x) / n);
    context.fill();
  }
  if (!line.words) return;
  context.font = "13px sans-serif";
  context.textAlign = "left";
  context.textBaseline = "bottom";
  context.strokeStyle = colour("paper"); // around the letters, over any body
  context.lineWidth = 3;
  context.strokeText(line.words, last[0] + 6, last[1] - 4);
  context.fillText(line.words, last[0] + 6, last[1] - 4);
}
