// SPDX-License-Identifier: BSD-3-Clause
//
// A plane of the agent's velocities: each square coloured by the verdict on the velocity at its middle.
import { VERDICTS, type Pair, type Sector, type Vec } from "./core";
import { colour, sized, whileHeld } from "./dom";
import { anyAcross, dot, norm, plus, short, times, unit } from "./doubles";

export type PlaneName = "sight" | "xy" | "xz" | "yz";

/** v = origin + s first + t second, m/s. */
interface Plane {
  origin: Vec;
  first: Vec;
  second: Vec;
  words: [string, string];
}

const SQUARES = [16, 6, 3]; // pixels, one after the other
const BUDGET = 9; // ms of a picture

export class VelocityPlane {
  private plane: Plane = { origin: [0, 0, 0], first: [1, 0, 0], second: [0, 1, 0], words: ["x", "y"] };
  private sector: Sector | null = null;
  private half = 1; // m/s from the middle to the nearer border
  private middle: [number, number] = [0, 0];
  private level = 0;
  private row = 0;
  private squares: HTMLCanvasElement = document.createElement("canvas");
  private working = 0;
  counts: number[] = VERDICTS.map(() => 0);

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly chosen: (v: Vec) => void,
    private readonly done: () => void,
  ) {
    whileHeld(canvas, e => {
      const box = canvas.getBoundingClientRect();
      this.choose(this.velocity(e.clientX - box.left, e.clientY - box.top));
    });
    canvas.addEventListener("keydown", e => {
      const ways: Record<string, [number, number]> = {
        ArrowLeft: [-1, 0],
        ArrowRight: [1, 0],
        ArrowUp: [0, 1],
        ArrowDown: [0, -1],
      };
      if (ways[e.key]) {
        const step = ((e.shiftKey ? 10 : 1) * this.half) / 100,
          [s, t] = this.place(this.v);
        this.choose(this.on(s + step * ways[e.key][0], t + step * ways[e.key][1]));
      } else if (e.key === "+" || e.key === "=") this.zoom(1 / 1.5);
      else if (e.key === "-") this.zoom(1.5);
      else return;
      e.preventDefault();
    });
  }

  private pair!: Pair;
  private u: Vec = [0, 0, 0];
  private v: Vec = [0, 0, 0];

  /** The plane for a velocity: one that goes through it. */
  show(pair: Pair, name: PlaneName, v: Vec, u: Vec, sight: Vec, planar: boolean): void {
    [this.pair, this.v, this.u] = [pair, v, u];
    const w = plus(v, u, -1);
    this.sector = null;
    if (name === "sight") {
      const first = unit(sight),
        rest = plus(w, first, -dot(w, first));
      let second = norm(rest) > 1e-9 * norm(w) ? unit(rest) : anyAcross(first);
      if (planar) second = [-first[1], first[0], 0];
      this.plane = { origin: u, first, second, words: ["along the line of sight", "across it"] };
      this.sector = pair.sector(second);
    } else {
      const k = name.split("").map(c => "xyz".indexOf(c)),
        origin: Vec = [...v];
      const [first, second]: [Vec, Vec] = [
        [0, 0, 0],
        [0, 0, 0],
      ];
      origin[k[0]] = origin[k[1]] = 0;
      first[k[0]] = second[k[1]] = 1;
      this.plane = { origin, first, second, words: [name[0], name[1]] };
    }
    const speed = Math.max(norm(w), 1e-3 * norm(v)) || 1;
    this.half = 1.5 * speed;
    this.middle = this.place(u);
    if (name === "sight") this.middle = [0.75 * speed * Math.sign(dot(w, this.plane.first) || 1), 0];
    this.restart();
  }

  /** The velocity has changed within the plane. */
  move(v: Vec): void {
    this.v = v;
    this.draw();
  }
  zoom(by: number): void {
    const [s, t] = this.place(this.v);
    // What is looked at stays where it is.
    this.middle = [s + by * (this.middle[0] - s), t + by * (this.middle[1] - t)];
    this.half *= by;
    this.restart();
  }

  /** The least sector of the plane that holds what collides; null: another plane, or there is none. */
  get edges(): Sector | null {
    return this.sector;
  }
  get words(): [string, string] {
    return this.plane.words;
  }

  private choose(v: Vec): void {
    this.v = v;
    this.draw();
    this.chosen(v);
  }
  private on(s: number, t: number): Vec {
    const { origin, first, second } = this.plane;
    return [0, 1, 2].map(k => origin[k] + s * first[k] + t * second[k]) as Vec;
  }
  private place(v: Vec): [number, number] {
    const d = plus(v, this.plane.origin, -1);
    return [dot(d, this.plane.first), dot(d, this.plane.second)];
  }
  private get scale(): number {
    // pixels in a m/s
    return Math.min(this.canvas.clientWidth, this.canvas.clientHeight) / 2 / this.half;
  }
  private velocity(x: number, y: number): Vec {
    return this.on(
      this.middle[0] + (x - this.canvas.clientWidth / 2) / this.scale,
      this.middle[1] - (y - this.canvas.clientHeight / 2) / this.scale,
    );
  }
  private flat(s: number, t: number): [number, number] {
    return [
      this.canvas.clientWidth / 2 + (s - this.middle[0]) * this.scale,
      this.canvas.clientHeight / 2 - (t - this.middle[1]) * this.scale,
    ];
  }

  /** The window may have another size. */
  resized(): void {
    const size = this.canvas.clientWidth + " x " + this.canvas.clientHeight;
    if (size !== this.asked) this.restart();
  }
  private asked = "";

  /** Asks anew, from large squares to small ones, a little at a time. */
  restart(): void {
    [this.level, this.row] = [0, 0];
    this.asked = this.canvas.clientWidth + " x " + this.canvas.clientHeight;
    cancelAnimationFrame(this.working);
    this.work();
  }

  private readonly work = (): void => {
    const start = performance.now();
    const palette = VERDICTS.map(name => bytes(colour(name)));
    do {
      const side = SQUARES[this.level];
      const columns = Math.ceil(this.canvas.clientWidth / side),
        rows = Math.ceil(this.canvas.clientHeight / side);
      if (this.row === 0) {
        this.fresh = document.createElement("canvas");
        [this.fresh.width, this.fresh.height] = [columns, rows];
        this.counts = VERDICTS.map(() => 0);
      }
      const velocities = new Float64Array(3 * columns);
      for (let i = 0; i < columns; ++i)
        velocities.set(this.velocity((i + 0.5) * side, (this.row + 0.5) * side), 3 * i);
      const found = this.pair.verdicts(velocities, this.u);
      const image = new ImageData(columns, 1);
      found.forEach((verdict, i) => {
        image.data.set(palette[verdict], 4 * i);
        ++this.counts[verdict];
      });
      this.fresh.getContext("2d")?.putImageData(image, 0, this.row);
      if (++this.row < rows) continue;
      [this.squares, this.row] = [this.fresh, 0];
      ++this.level;
      this.draw();
      if (this.level === 1 || this.level === SQUARES.length) this.done();
    } while (this.level < SQUARES.length && performance.now() - start < BUDGET);
    if (this.level < SQUARES.length) this.working = requestAnimationFrame(this.work);
  };
  private fresh: HTMLCanvasElement = this.squares;

  draw(): void {
    const { context, width, height } = sized(this.canvas);
    context.fillStyle = colour("paper");
    context.fillRect(0, 0, width, height);
    context.imageSmoothingEnabled = false;
    const side = SQUARES[Math.max(this.level - 1, 0)];
    if (this.level)
      context.drawImage(this.squares, 0, 0, this.squares.width * side, this.squares.height * side);
    this.grid(context, width, height);
    if (this.sector) {
      context.strokeStyle = colour("ink");
      context.setLineDash([6, 4]);
      context.lineWidth = 1.5;
      for (const angle of [this.sector.left, -this.sector.right]) {
        const far = 4 * this.half;
        context.beginPath();
        context.moveTo(...this.flat(0, 0));
        // The sector's own axes may be turned against those of the plane by rounding alone.
        context.lineTo(...this.flat(far * Math.cos(angle), far * Math.sin(angle)));
        context.stroke();
      }
      context.setLineDash([]);
    }
    const [x, y] = this.flat(...this.place(this.v));
    context.lineWidth = 3;
    context.strokeStyle = colour("paper");
    context.beginPath();
    context.arc(x, y, 7, 0, 2 * Math.PI);
    context.stroke();
    context.lineWidth = 1.6;
    context.strokeStyle = colour("ink");
    context.stroke();
    context.fillStyle = colour("ink");
    context.fillRect(x - 1.5, y - 1.5, 3, 3);
  }

  private grid(context: CanvasRenderingContext2D, width: number, height: number): void {
    const wanted = this.half / 2.5,
      power = 10 ** Math.floor(Math.log10(wanted));
    const step = power * (wanted / power >= 5 ? 5 : wanted / power >= 2 ? 2 : 1);
    context.font = "11px sans-serif";
    context.fillStyle = context.strokeStyle = colour("ink");
    context.globalAlpha = 0.55;
    context.lineWidth = 0.5;
    const span = (extent: number, middle: number): number[] => {
      const list: number[] = [],
        reach = extent / 2 / this.scale;
      for (let i = Math.ceil((middle - reach) / step); i * step <= middle + reach; ++i) list.push(i * step);
      return list;
    };
    context.textAlign = "center";
    context.textBaseline = "bottom";
    for (const s of span(width, this.middle[0])) {
      const [x] = this.flat(s, 0);
      context.fillRect(x, height - 6, 1, 6);
      if (x > 20 && x < width - 20) context.fillText(short(s, 4), x, height - 8);
    }
    context.textAlign = "left";
    context.textBaseline = "middle";
    for (const t of span(height, this.middle[1])) {
      const [, y] = this.flat(0, t);
      context.fillRect(0, y, 6, 1);
      if (y > 14 && y < height - 24) context.fillText(short(t, 4), 9, y);
    }
    context.globalAlpha = 1;
    context.textAlign = "right";
    context.fillText(this.plane.words[0] + ", m/s \u2192", width - 6, height - 28);
    context.textAlign = "left";
    context.fillText("\u2191 " + this.plane.words[1] + ", m/s", 6, 12);
    const [x, y] = this.flat(...this.place(this.u));
    context.lineWidth = 1.2;
    context.beginPath();
    context.moveTo(x - 5, y);
    context.lineTo(x + 5, y);
    context.moveTo(x, y - 5);
    context.lineTo(x, y + 5);
    context.stroke();
  }
}

function bytes(hex: string): [number, number, number, number] {
  const n = parseInt(hex.slice(1), 16);
  return [n >> 16, (n >> 8) & 255, n & 255, 255];
}

export const along = (sector: Sector, angle: number): Vec =>
  plus(times(sector.lineOfSight, Math.cos(angle)), times(sector.across, Math.sin(angle)));
