// SPDX-License-Identifier: BSD-3-Clause
//
// The page of a scene: two bodies, a velocity that anybody may choose, and what is true of it.
import {
  Pair,
  VERDICTS,
  type ConeShape,
  type Contact,
  type Core,
  type Miss,
  type Sector,
  type Vec,
  type Verdict,
} from "./core";
import type { BodyData, SceneData, Surface } from "./data";
import { button, colour, element, fillTable, make, nextFrame } from "./dom";
import { atLeast, atMost, digits, dot, norm, plus, short, stepped, times, typed } from "./doubles";
import { fillNeighbours } from "./neighbours";
import { SolidView, type Line, type Shown } from "./solid_view";
import { along, VelocityPlane, type PlaneName } from "./velocity_plane";

const WORDS: Record<Verdict, string> = {
  out: "They never meet.",
  on: "They will touch, without overlapping.",
  in: "They will overlap.",
  touching: "They touch now.",
  overlapping: "They overlap now.",
  undecided: "Not decided: one of the others.",
};
const RUNG_WORDS: Record<string, string> = {
  triage: "doubles, with a bound of their error",
  interval: "intervals",
  exact: "whole numbers of any length",
  certified: "a certified search: right, or undecided",
};
const QUICK = ["ellipsoids", "combined", "hulls", "convex"]; // families whose cones take milliseconds
const STANDING = [1, 0, 0, 0, 1, 0, 0, 0, 1];

type Input = { field: HTMLInputElement; set: (x: number) => void };

export class ScenePage {
  private readonly bodies: [BodyData, BodyData];
  private readonly handles: [number, number];
  private readonly shift: [Vec, Vec] = [
    [0, 0, 0],
    [0, 0, 0],
  ]; // m, from where the file has it
  private readonly velocity: [Vec, Vec];
  private readonly inputs: { velocity: Input[][]; shift: Input[][] } = { velocity: [], shift: [] };
  private pair: Pair;
  private cone: ConeShape | null = null;
  private coneAsked = false;
  private sector: Sector | null = null; // in the plane, in place of the cone
  private verdict: Verdict = "undecided";
  private contact: Contact | null = null;
  private miss: Miss | null = null;
  private plane: PlaneName = "sight";
  private readonly solid: SolidView;
  private readonly map: VelocityPlane;
  private saying = 0;
  private looking = 0;
  private readonly redraw = nextFrame(() => this.drawBodies());

  constructor(
    private readonly core: Core,
    private readonly data: SceneData,
  ) {
    this.bodies = data.bodies;
    this.handles = data.bodies.map(b => core.body(b.numbers)) as [number, number];
    this.velocity = data.bodies.map(b => [...b.velocity]) as [Vec, Vec];
    this.pair = this.makePair();
    this.coneAsked = !data.planar && QUICK.includes(data.guarantee.family);
    this.solid = new SolidView(element<HTMLCanvasElement>("solid"), data.planar, this.redraw);
    this.map = new VelocityPlane(
      element<HTMLCanvasElement>("plane"),
      v => this.choose(v, false),
      () => this.tellMap(),
    );
    this.controls();
    this.fit();
    this.moved();
    window.addEventListener("resize", () => {
      this.redraw();
      this.map.resized();
    });
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
      this.redraw();
      this.map.restart();
    });
  }

  private makePair(): Pair {
    const [a, b] = this.bodies,
      at = this.bodies.map((body, i) => plus(body.position, this.shift[i]));
    return new Pair(this.core, this.handles[0], at[0], a.rotation, this.handles[1], at[1], b.rotation);
  }
  private middle(i: number): Vec {
    return plus(this.bodies[i].middle, this.shift[i]);
  }
  private get sight(): Vec {
    const d = plus(this.middle(1), this.middle(0), -1);
    return norm(d) > 0 ? d : [1, 0, 0];
  }
  private get w(): Vec {
    return plus(this.velocity[0], this.velocity[1], -1);
  }

  // --- What changes.

  /** A body stands elsewhere. */
  private moved(): void {
    try {
      const pair = this.makePair();
      this.pair.free();
      this.pair = pair;
    } catch (error) {
      return this.complain(String((error as Error).message));
    }
    this.complain("");
    this.cone = this.coneAsked ? this.pair.cone() : null;
    const [x, y] = this.sight;
    this.sector = this.data.planar ? this.pair.sector([-y, x, 0]) : null;
    this.changed(true);
  }
  private choose(v: Vec, anew: boolean): void {
    this.velocity[0] = this.data.planar ? [v[0], v[1], 0] : v;
    this.changed(anew);
  }
  /** `anew`: the plane is laid through the velocity again. */
  private changed(anew: boolean): void {
    const [v, u] = this.velocity;
    this.inputs.velocity.forEach((list, i) => list.forEach((input, k) => input.set(this.velocity[i][k])));
    this.inputs.shift.forEach((list, i) => list.forEach((input, k) => input.set(this.shift[i][k])));
    this.answer();
    if (anew) this.map.show(this.pair, this.plane, v, u, this.sight, this.data.planar);
    else this.map.move(v);
    this.redraw();
    // Tables that nobody reads while the velocity moves.
    clearTimeout(this.looking);
    this.looking = window.setTimeout(() => this.tables(), anew && this.data.guarantee.exact ? 0 : 150);
  }
  private tables(): void {
    this.tellBodies();
    this.neighbours();
  }
  private neighbours(): void {
    const axes = this.axes(),
      table = element<HTMLTableElement>("neighbours");
    const counts = fillNeighbours(table, this.pair, this.velocity[0], this.velocity[1], ...axes);
    element("neighbours-say").textContent =
      `Columns change ${"xyz"[axes[0]]}, rows ${"xyz"[axes[1]]}: ${told(counts)}.`;
  }
  private axes(): [number, number] {
    return element<HTMLSelectElement>("axes")
      .value.split("")
      .map(c => "xyz".indexOf(c)) as [number, number];
  }

  // --- The answer.

  private answer(): void {
    const [v, u] = this.velocity;
    const start = performance.now();
    this.verdict = this.pair.verdict(v, u);
    const rung = this.pair.rung(v, u);
    this.contact = this.verdict === "out" ? null : this.pair.contact(v, u);
    this.miss = this.pair.miss(v, u);
    const took = performance.now() - start;
    const box = element("verdict");
    box.className = this.verdict;
    element("verdict-word").textContent = this.verdict;
    element("verdict-says").textContent = WORDS[this.verdict];
    const proved = make("b", {}, "proved"),
      rounded = (): HTMLElement => make("span", {}, "in doubles");
    const rows: (Node | string)[][] = [
      ["Verdict", this.verdict, this.verdict === "undecided" ? "not decided" : proved],
      ["Decided by", rung + ": " + RUNG_WORDS[rung], ""],
    ];
    if (this.contact && this.verdict !== "overlapping" && this.verdict !== "touching") {
      rows.push([
        "First contact, s",
        digits(within(this.contact.time, this.contact.earliest, this.contact.latest)),
        rounded(),
      ]);
      rows.push([
        "\u2026 not before, and by, s",
        span(this.contact.earliest, this.contact.latest),
        make("b", {}, "proved"),
      ]);
      if (!Number.isNaN(this.contact.point[0]))
        rows.push(["\u2026 at the point, m", this.contact.point.map(x => short(x)).join(", "), rounded()]);
    }
    if (this.verdict === "out") {
      rows.push(["Least distance, m", digits(this.miss.distance), rounded()]);
      rows.push(["\u2026 between, m", span(this.miss.least, this.miss.most), make("b", {}, "proved")]);
      rows.push(["\u2026 when, s", digits(this.miss.time), rounded()]);
    } else if (this.verdict === "in" || this.verdict === "on") {
      rows.push(["To be shifted to avoid, m", digits(this.miss.depth), rounded()]);
    }
    rows.push(["Speed of v agent - v obstacle, m/s", digits(norm(this.w)), rounded()]);
    fillTable(
      element<HTMLTableElement>("answers"),
      "What is true of these velocities",
      ["what", "value", "how sure"],
      rows,
    );
    element("took").textContent = "answered here, in " + short(took, 2) + " ms";
    this.announce(this.verdict + ". " + WORDS[this.verdict] + " Decided by " + rung + ".");
  }

  /** Once the velocity rests: who listens does not hear every point of a drag. */
  private announce(text: string): void {
    clearTimeout(this.saying);
    this.saying = window.setTimeout(() => {
      if (element("announce").textContent !== text) element("announce").textContent = text;
    }, 400);
  }
  private complain(text: string): void {
    element("complaint").textContent = text;
  }

  private tellMap(): void {
    const edges = this.map.edges,
      words = this.map.words;
    const rows: string[][] = VERDICTS.map((name, i) => [name, String(this.map.counts[i])]).filter(
      row => row[1] !== "0",
    );
    fillTable(
      element<HTMLTableElement>("plane-table"),
      "Squares of the picture by their verdict, each that of its middle: proved, unless undecided",
      ["verdict", "squares"],
      rows,
    );
    const plane = `The plane: ${words[0]} and ${words[1]}; the small cross is the obstacle's velocity.`;
    element("plane-say").textContent = [plane, ...(edges ? edgeWords(edges) : [])].join(" ");
  }

  // --- The picture.

  private fit(): void {
    const points: Vec[] = [];
    for (const i of [0, 1])
      for (const s of [-1, 1]) {
        const reach = radius(this.bodies[i].surface);
        for (const k of [0, 1, 2]) points.push(plus(this.middle(i), unitOf(k), s * reach));
      }
    this.solid.fit(points);
  }

  private drawBodies(): void {
    const rows = (i: number): number[] => (this.data.planar ? STANDING : this.bodies[i].rotation);
    const shown: Shown[] = [0, 1].map(i => ({
      surface: this.bodies[i].surface,
      rotation: rows(i),
      at: this.middle(i),
      colour: colour(i ? "obstacle" : "agent"),
      alpha: 1,
    }));
    const from = this.middle(0),
      reach = norm(this.sight),
      lines: Line[] = [];
    if (norm(this.w) > 0) {
      const time =
        this.contact && Number.isFinite(this.contact.time)
          ? this.contact.time
          : this.verdict === "out"
            ? (this.miss?.time ?? 0)
            : 0;
      const there = plus(from, this.w, time);
      if (time > 0 && norm(plus(there, from, -1)) < 50 * reach) {
        shown.push({ ...shown[0], at: there, alpha: 0.3 });
        lines.push({ points: [from, there], colour: colour("agent"), width: 1.2, dashed: true });
      }
      lines.push({
        points: [from, plus(from, this.w, (0.5 * reach) / norm(this.w))],
        colour: colour("ink"),
        width: 2,
        arrow: true,
        words: "w",
      });
    }
    lines.push(...this.coneLines(from, reach, shown));
    for (const i of [0, 1])
      lines.push({ points: [this.middle(i)], colour: colour("ink"), width: 1, words: this.bodies[i].name });
    const [all, painted] = this.solid.draw({ bodies: shown, lines });
    element("painted").textContent = painted < all ? `${painted} of ${all} triangles are drawn.` : "";
  }

  private coneLines(from: Vec, reach: number, shown: Shown[]): Line[] {
    if (this.sector) {
      const edges = [along(this.sector, this.sector.left), along(this.sector, -this.sector.right)];
      return edges.map(d => ({
        points: [from, plus(from, d, 1.3 * reach)],
        colour: colour("in"),
        width: 1.6,
        dashed: true,
      }));
    }
    if (!this.cone) return [];
    const lines: Line[] = [];
    for (const [loops, name] of [
      [this.cone.outer, "in"],
      [this.cone.inner, "ink"],
    ] as const)
      for (const loop of loops) {
        const points = [...loop, loop[0]].map(d => plus(from, d, reach));
        lines.push({ points, colour: colour(name), width: name === "in" ? 1.6 : 0.8, dashed: name === "in" });
        if (name !== "in") continue;
        const surface: Surface = { points: [0, 0, 0, ...loop.flatMap(d => times(d, reach))], triangles: [] };
        for (let i = 1; i <= loop.length; ++i) surface.triangles.push(0, i, 1 + (i % loop.length));
        shown.push({ surface, rotation: STANDING, at: from, colour: colour("in"), alpha: 0.1 });
      }
    return lines;
  }

  private tellBodies(): void {
    const rows = this.bodies.map((b, i): (string | Node)[] => [
      b.name,
      b.is,
      this.shift[i].map(x => short(x)).join(", "),
      this.velocity[i].map(x => short(x)).join(", "),
    ]);
    fillTable(
      element<HTMLTableElement>("bodies-table"),
      "The bodies as the file has them, and how far each was moved",
      ["body", "what it is in the file", "moved by, m", "velocity, m/s"],
      rows,
    );
    const cone = element("cone-say");
    if (this.cone)
      cone.textContent = [
        `All directions of w = v agent - v obstacle that collide: between ${atLeast(this.cone.least, 9)} and`,
        `${atMost(this.cone.most, 9)} sr of 4 pi, proved. Solid line: inner cone, all of it collides;`,
        "dashed: outer cone, nothing beyond it does. Surfaces and lines are drawn in doubles.",
      ].join(" ");
    else if (this.sector) cone.textContent = "The cone in the plane. " + edgeWords(this.sector).join(" ");
    else if (!this.coneAsked && !this.data.planar)
      cone.textContent = "The cone of these bodies takes seconds: ask for it.";
    else cone.textContent = "The bodies are not apart: there is no cone.";
  }

  // --- The controls.

  private controls(): void {
    const axes = this.data.planar ? [0, 1] : [0, 1, 2];
    element("exactness").textContent = this.data.guarantee.exact
      ? "Every verdict of this pair is exact: right, and never undecided."
      : "Verdicts of this pair are certified: right, or undecided.";
    this.bodies.forEach((body, i) => {
      const line = (box: string, what: string, get: () => Vec, use: () => void): Input[] => {
        const group = make("fieldset", {}, make("legend", {}, body.name));
        const list = axes.map(k =>
          this.input(
            group,
            `${what} of the ${body.name}, ${"xyz"[k]}`,
            "xyz"[k],
            () => get()[k],
            x => {
              get()[k] = x;
              use();
            },
          ),
        );
        element(box).append(group);
        return list;
      };
      this.inputs.velocity.push(
        line(
          "velocities",
          "velocity",
          () => this.velocity[i],
          () => this.changed(true),
        ),
      );
      this.inputs.shift.push(
        line(
          "places",
          "move",
          () => this.shift[i],
          () => this.moved(),
        ),
      );
    });
    element("velocities").append(
      button(
        "as in the file",
        () => {
          for (const i of [0, 1]) this.velocity[i] = [...this.bodies[i].velocity];
          this.changed(true);
        },
        "velocities as in the file",
      ),
    );
    element("places").append(
      button(
        "as in the file",
        () => {
          for (const i of [0, 1]) this.shift[i] = [0, 0, 0];
          this.moved();
        },
        "places as in the file",
      ),
    );
    const planes = element<HTMLSelectElement>("plane-name"),
      ulps = element<HTMLSelectElement>("axes");
    if (this.data.planar) {
      for (const select of [planes, ulps])
        for (const option of [...select.options]) if (option.value.includes("z")) option.remove();
    }
    planes.addEventListener("change", () => {
      this.plane = planes.value as PlaneName;
      this.changed(true);
    });
    ulps.addEventListener("change", () => this.changed(false));
    element("plane-buttons").append(
      button("+", () => this.map.zoom(1 / 1.5), "nearer"),
      button("\u2212", () => this.map.zoom(1.5), "farther"),
      button("lay through v", () => this.changed(true), "lay the plane through the velocity again"),
    );
    element("solid-buttons").append(...this.solid.buttons(this.data.planar));
    if (!this.coneAsked && !this.data.planar) {
      const ask = button("compute the cone", () => {
        this.coneAsked = true;
        ask.remove();
        this.moved();
      });
      element("solid-buttons").append(ask);
    }
  }

  private input(
    group: HTMLElement,
    label: string,
    short_label: string,
    get: () => number,
    use: (x: number) => void,
  ): Input {
    const field = make("input", {
      type: "text",
      inputmode: "decimal",
      "aria-label": label,
      spellcheck: "false",
      autocomplete: "off",
    });
    const set = (x: number): void => {
      if (document.activeElement !== field || typed(field.value) !== x) field.value = digits(x);
      field.removeAttribute("aria-invalid");
    };
    field.addEventListener("change", () => {
      const x = typed(field.value);
      field.setAttribute("aria-invalid", String(x === null));
      this.complain(x === null ? `${label}: got "${field.value}", must be a finite number` : "");
      if (x === null) return;
      use(x);
      field.value = digits(x);
    });
    const step = (n: number): void => {
      const x = stepped(get(), n);
      use(x);
      field.value = digits(x);
    };
    field.addEventListener("keydown", e => {
      if (e.key !== "ArrowUp" && e.key !== "ArrowDown") return;
      e.preventDefault();
      step((e.key === "ArrowUp" ? 1 : -1) * (e.shiftKey ? 1000 : 1));
    });
    group.append(
      make("label", {}, make("span", { "aria-hidden": "true" }, short_label), field),
      button("\u25bc", () => step(-1), label + ": the next smaller double"),
      button("\u25b2", () => step(1), label + ": the next larger double"),
    );
    return { field, set };
  }
}

const unitOf = (k: number): Vec => [0, 1, 2].map(i => Number(i === k)) as Vec;
const span = (low: number, high: number): string =>
  `${digits(low)} to ${Number.isFinite(high) ? digits(high) : "for ever"}`;
const told = (counts: number[]): string =>
  counts
    .map((n, i) => [n, VERDICTS[i]] as const)
    .filter(([n]) => n)
    .map(([n, name]) => `${n} ${name}`)
    .join(", ");

function radius(surface: Surface): number {
  let most = 0;
  for (let i = 0; i < surface.points.length; i += 3) {
    const p: Vec = [surface.points[i], surface.points[i + 1], surface.points[i + 2]];
    most = Math.max(most, Math.sqrt(dot(p, p)));
  }
  return most;
}

function edgeWords(edges: Sector): string[] {
  const error = Math.max(edges.leftError, edges.rightError);
  return [
    `Dashed, drawn in doubles: the least sector of what collides, from ${short(-edges.right, 9)} to`,
    `${short(edges.left, 9)} rad off the line of sight.`,
    error > 0
      ? `Proved: nothing collides more than ${atMost(error, 3)} rad beyond it.`
      : "Its edges are right to rounding.",
  ];
}

/** The estimate, or the nearer end of what is proved where it lies outside: grazing, it has few digits. */
const within = (x: number, low: number, high: number): number => Math.min(Math.max(x, low), high);
