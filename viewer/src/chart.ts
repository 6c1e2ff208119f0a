// SPDX-License-Identifier: BSD-3-Clause
//
// Lines over time on a canvas, with a cursor that people move by pointer or keys.
import { colour, niceStep, sized, whileHeld } from "./dom";
import { short } from "./doubles";

export interface Series {
  t: number[];
  y: (number | null)[];
  colour: string;
  width: number;
  dash?: number[];
}
export interface Level {
  from: number;
  to: number;
  y: number;
  colour: string;
  dash: number[];
}
export interface Chart {
  series: Series[];
  levels: Level[];
  marks: number[]; // s: events
  unit: string;
}

const LEFT = 48,
  BELOW = 30,
  EDGE = 10;

export class TimeChart {
  private chart: Chart = { series: [], levels: [], marks: [], unit: "m" };
  private time = 0;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly end: number,
    private readonly chosen: (t: number) => void,
  ) {
    whileHeld(canvas, e => {
      const box = canvas.getBoundingClientRect();
      const share = (e.clientX - box.left - LEFT) / (box.width - LEFT - EDGE);
      this.chosen(this.end * Math.min(1, Math.max(0, share)));
    });
    canvas.addEventListener("keydown", e => {
      const step = ((e.shiftKey ? 10 : 1) * this.end) / 200;
      if (e.key === "ArrowLeft") this.chosen(Math.max(0, this.time - step));
      else if (e.key === "ArrowRight") this.chosen(Math.min(this.end, this.time + step));
      else if (e.key === "Home") this.chosen(0);
      else if (e.key === "End") this.chosen(this.end);
      else return;
      e.preventDefault();
    });
  }

  show(chart: Chart): void {
    this.chart = chart;
    this.draw();
  }
  move(t: number): void {
    this.time = t;
    this.draw();
  }

  draw(): void {
    const { context, width, height } = sized(this.canvas);
    context.fillStyle = colour("paper");
    context.fillRect(0, 0, width, height);
    const values = [
      ...this.chart.series.flatMap(s => s.y.filter((y): y is number => y !== null)),
      ...this.chart.levels.map(level => level.y),
    ];
    const high = values.reduce((m, y) => Math.max(m, y), 0) || 1,
      low = values.reduce((m, y) => Math.min(m, y), 0);
    const x = (t: number): number => LEFT + ((width - LEFT - EDGE) * t) / (this.end || 1);
    const y = (value: number): number =>
      height - BELOW - ((height - BELOW - EDGE) * (value - low)) / ((high - low) * 1.05);
    this.grid(context, x, y, low, high, width, height);
    const path = (points: [number, number][], style: string, size: number, dash: number[] = []): void => {
      context.strokeStyle = style;
      context.lineWidth = size;
      context.setLineDash(dash);
      context.beginPath();
      points.forEach((p, i) => (i ? context.lineTo(...p) : context.moveTo(...p)));
      context.stroke();
      context.setLineDash([]);
    };
    for (const t of this.chart.marks) path([[x(t), height - BELOW], [x(t), height - BELOW - 6]], colour("ink"), 1.2); // prettier-ignore
    for (const level of this.chart.levels)
      path([[x(level.from), y(level.y)], [x(level.to), y(level.y)]], level.colour, 1.8, level.dash); // prettier-ignore
    for (const series of this.chart.series) {
      let piece: [number, number][] = [];
      series.t.forEach((t, i) => {
        const value = series.y[i];
        if (value === null) {
          path(piece, series.colour, series.width, series.dash);
          piece = [];
        } else piece.push([x(t), y(value)]);
      });
      path(piece, series.colour, series.width, series.dash);
    }
    path([[x(this.time), EDGE], [x(this.time), height - BELOW]], colour("ink"), 1.4); // prettier-ignore
  }

  private grid(
    context: CanvasRenderingContext2D,
    x: (t: number) => number,
    y: (value: number) => number,
    low: number,
    high: number,
    width: number,
    height: number,
  ): void {
    context.font = "11px sans-serif";
    context.textAlign = "center";
    context.textBaseline = "top";
    const tick = (px: number, py: number, w: number, h: number, words: string, at: [number, number]): void => {
      context.fillStyle = colour("line");
      context.fillRect(px, py, w, h);
      context.fillStyle = colour("quiet");
      context.fillText(words, ...at);
    };
    const step = niceStep((this.end || 1) / Math.max(2, width / 90));
    for (let i = 0; i * step <= this.end * (1 + 1e-9); ++i)
      tick(x(i * step), EDGE, 1, height - BELOW - EDGE, short(i * step, 4), [x(i * step), height - BELOW + 3]);
    context.textAlign = "right";
    context.textBaseline = "middle";
    const rise = niceStep((high - low) / Math.max(2, height / 50));
    for (let i = Math.ceil(low / rise - 1e-9); i * rise <= high * (1 + 1e-9); ++i)
      tick(LEFT, y(i * rise), width - LEFT - EDGE, 1, short(i * rise, 4), [LEFT - 5, y(i * rise)]);
    context.textBaseline = "bottom";
    context.fillText("time, s", width - EDGE, height - 1);
    context.textAlign = "left";
    context.fillText(this.chart.unit, 4, height - 1);
  }
}
