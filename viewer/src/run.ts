// SPDX-License-Identifier: BSD-3-Clause
//
// The page of a run: what flew where, what is proved of it, and what is true of any moment of it.
import type { Core, Pair, Vec } from "./core";
import { TimeChart } from "./chart";
import type { EventData, FlownBody, PairProof, PassageProof, RunData, Surface } from "./data";
import { button, colour, element, fillTable, make, nextFrame } from "./dom";
import { atLeast, atMost, digits, norm, plus, short, times } from "./doubles";
import { Bodies, goalAt, placeAt, placeOf, rimAt, rowAt, sizeOf, surfaceAt, type Place } from "./motion";
import { SolidView, type Line, type Shown } from "./solid_view";

const COLOURS = ["#0072b2", "#c2650a", "#009e73", "#b5619a", "#8f7a00", "#3f97cf", "#b3372f", "#6a6ab5"];
const HAPPENS: Record<string, string> = {
  "enters-cone": "is on course to meet or to pass too near",
  "leaves-cone": "is on course to pass",
  aligned: "points at its goal",
  "reaches-goal": "reaches its goal",
  contact: "and",
  "cannot-avoid": "finds no course that avoids",
  "goes-through": "goes through",
  "goes-beside": "crosses the plane beside",
  loses: "loses sight of",
};
const VERDICTS: Record<string, string> = {
  avoided: "No two bodies touch, between the commands too: proved.",
  touched: "Two bodies touch: proved.",
  passed: "Through the openings without touching them: proved.",
  missed: "An opening was not passed.",
  undecided: "Two bodies come closer than the proof resolves.",
  none: "There was nothing to prove: no pair could be checked.",
};
const STANDING = [1, 0, 0, 0, 1, 0, 0, 0, 1];
const MOST_SHOWN = 200; // rows of a table
const MOST_NAMED = 12; // names in the picture
const BUDGET = 10; // ms of a picture for answers
const QUICK_CONES = 12; // ms: cones that cost no more are drawn while the run plays

/** The distance of two bodies at rows of the first, as the library brackets it. */
interface Kept {
  t: number[];
  least: (number | null)[];
  most: (number | null)[];
  done: number;
}

const eventWords = (e: EventData): string => {
  const what = HAPPENS[e.event] ?? e.event,
    goal = e.event === "reaches-goal" && e.unit === "goal" ? ` ${e.value}` : "";
  const value = e.value !== null && e.unit === "m" ? `, ${short(e.value, 5)} m` : "";
  return `${e.agent} ${what} ${e.obstacle}${e.event === "contact" ? " meet, proved" : ""}`.trim() + goal + value;
};
const pairWords = (p: { a: string; b: string }): string => `${p.a}, ${p.b}`;
const metres = (x: number | null | undefined): string => (x === null || x === undefined ? "" : atLeast(x));

export class RunPage {
  private time = 0;
  private playing = false;
  private last: number | null = null;
  private pair: PairProof | null;
  private readonly pairs: PairProof[];
  private readonly bodies: Bodies;
  private readonly kept = new Map<PairProof, Kept>();
  private readonly sizes: number[];
  private readonly solid: SolidView;
  private readonly chart: TimeChart;
  private cones: { key: string; shown: Shown[]; lines: Line[]; words: string; took: number } | null = null;
  private told = 0;
  private readonly redraw = nextFrame(() => this.draw());

  constructor(
    core: Core,
    private readonly data: RunData,
  ) {
    this.bodies = new Bodies(core, data);
    this.sizes = data.bodies.map(sizeOf);
    const rank = (p: PairProof): number =>
      p.verdict === "avoided" ? (p.least_distance ?? 0) - (p.required ?? 0) : p.verdict === "touched" ? -2e300 : -1e300;
    this.pairs = [...data.proof.pairs].sort((p, q) => rank(p) - rank(q));
    this.pair = this.pairs[0] ?? null;
    this.solid = new SolidView(element<HTMLCanvasElement>("solid"), data.planar, this.redraw);
    this.chart = new TimeChart(element<HTMLCanvasElement>("chart"), data.end, t => this.go(t));
    this.head();
    this.controls();
    this.fit();
    this.tellProofs();
    this.tellEvents();
    this.choose(this.pair);
    window.addEventListener("resize", () => this.all());
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.all());
  }

  // --- What changes.

  /** Another time. */
  go(t: number, say = ""): void {
    this.time = Math.min(this.data.end, Math.max(0, t));
    this.redraw();
    if (say) element("announce").textContent = say;
  }
  private choose(pair: PairProof | null): void {
    this.pair = pair;
    if (pair) {
      element<HTMLSelectElement>("pair").value = String(this.pairs.indexOf(pair));
      const flier = [pair.a, pair.b].find(name => this.bodies.body(name).flies) ?? pair.a;
      element<HTMLSelectElement>("agent").value = String(this.data.bodies.indexOf(this.bodies.body(flier)));
    }
    document
      .querySelectorAll<HTMLElement>("#proofs tbody tr")
      .forEach((row, i) => row.classList.toggle("chosen", this.pairs[i] === pair));
    this.measure();
    this.all();
  }
  private all(): void {
    this.cones = null;
    this.showChart();
    this.redraw();
  }
  private play(on: boolean): void {
    this.playing = on;
    this.last = null;
    element("play").textContent = on ? "pause" : "play";
    if (on && this.time >= this.data.end) this.time = 0;
    if (on) requestAnimationFrame(this.step);
    else this.redraw();
  }
  private readonly step = (now: number): void => {
    if (!this.playing) return;
    // Who wants no motion sees a picture each half second.
    const rest = matchMedia("(prefers-reduced-motion: reduce)").matches ? 500 : 0;
    if (this.last === null || now - this.last >= rest) {
      const speed = Number(element<HTMLSelectElement>("speed").value);
      if (this.last !== null) this.time = Math.min(this.time + (speed * (now - this.last)) / 1000, this.data.end);
      this.last = now;
      this.draw();
    }
    if (this.time >= this.data.end) this.play(false);
    else requestAnimationFrame(this.step);
  };

  // --- The picture.

  private draw(): void {
    const t = this.time,
      planar = this.data.planar;
    const shown: Shown[] = [],
      lines: Line[] = [];
    this.data.bodies.forEach((body, i) => {
      const place = placeAt(body, t);
      const chosen = this.pair !== null && (this.pair.a === body.name || this.pair.b === body.name);
      const ink = COLOURS[i % COLOURS.length];
      lines.push(...ways(body, place, t, ink));
      if (!place) return;
      shown.push({ surface: surfaceAt(body, place.k), rotation: place.turn, at: place.at, colour: ink, alpha: planar ? 0.7 : 1 });
      if (chosen || this.data.bodies.length <= MOST_NAMED)
        lines.push({ points: [place.at], colour: colour("ink"), width: 1, words: body.name });
    });
    for (const goal of this.data.goals) lines.push(...this.goalLines(goal, t));
    for (const orifice of this.data.orifices ?? [])
      if (t >= orifice.appears)
        lines.push({ points: rimAt(orifice, t), colour: colour("ink"), width: 2, words: orifice.name });
    for (const proof of [...this.data.proof.pairs, ...(this.data.proof.passages ?? [])])
      if (proof.verdict === "touched" && proof.place && proof.from <= t)
        lines.push({ points: [proof.place], colour: colour("overlapping"), width: 2, words: "\u00d7 touch" });
    this.addCones(shown, lines);
    if (this.close) this.fitPair(t);
    const [all, painted] = this.solid.draw({ bodies: shown, lines });
    element("painted").textContent = painted < all ? `${painted} of ${all} triangles are drawn.` : "";
    this.chart.move(t);
    this.tellTime();
  }

  private goalLines(goal: RunData["goals"][number], t: number): Line[] {
    const at = goalAt(goal, this.data.bodies, t),
      i = this.data.bodies.findIndex(body => body.name === goal.agent);
    const ring = Array.from({ length: 33 }, (_, k): Vec => {
      const angle = (Math.PI * k) / 16;
      return plus(at, [goal.reached * Math.cos(angle), goal.reached * Math.sin(angle), 0]);
    });
    const few = this.data.goals.length <= MOST_NAMED;
    return [
      { points: ring, colour: COLOURS[i % COLOURS.length], width: 1, dashed: true },
      { points: [at], colour: COLOURS[i % COLOURS.length], width: 1, words: few ? "\u2605 goal" : "\u2605" },
    ];
  }

  /** Of all velocities of an agent those that collide with another body which keeps its own, about its velocity. */
  private addCones(shown: Shown[], lines: Line[]): void {
    const choice = element<HTMLSelectElement>("cones").value,
      agent = this.agent;
    const others =
      choice === "none" || !agent
        ? []
        : this.data.bodies.filter(
            other =>
              other !== agent &&
              (choice === "all" || (this.pair && [this.pair.a, this.pair.b].includes(other.name))) &&
              this.bodies.quick(agent) &&
              this.bodies.quick(other),
          );
    const at = agent ? rowAt(agent.t, this.time) : -1;
    const key = [agent?.name, at, ...others.map(other => other.name)].join("\n");
    if (this.cones?.key !== key && !(this.playing && (this.cones?.took ?? 0) > QUICK_CONES)) {
      const start = performance.now();
      this.cones = { key, shown: [], lines: [], words: "", took: 0 };
      const said = others.map(other => this.coneOf(agent!, at, other)).filter(Boolean);
      this.cones.took = performance.now() - start;
      this.cones.words = said.length
        ? `Cone of ${agent!.name}, of v ${agent!.name} - v of the other, at its command of ${short(agent!.t[at])} s: ${said.join("; ")}.`
        : choice !== "none" && agent && others.length === 0
          ? "Cones of meshes, clouds, maps, unions and bodies that change take longer than a picture: vericone cone."
          : "";
    }
    if (this.cones?.key === key) {
      shown.push(...this.cones.shown);
      lines.push(...this.cones.lines);
    }
    element("cone-say").textContent = this.cones?.key === key ? this.cones.words : "";
  }

  private coneOf(agent: FlownBody, row: number, other: FlownBody): string {
    const theirs = row < 0 ? -1 : rowAt(other.t, agent.t[row]);
    if (theirs < 0) return "";
    const a = placeOf(agent, row),
      b = placeOf(other, theirs),
      sight = plus(b.at, a.at, -1);
    const pair = this.bodies.pair(agent, a, other, b),
      reach = norm(sight) || 1;
    try {
      const w = plus(a.velocity, b.velocity, -1);
      if (norm(w) > 0)
        this.cones!.lines.push({
          points: [a.at, plus(a.at, w, (0.5 * reach) / norm(w))], colour: colour("ink"), width: 1.6, arrow: true, words: "w",
        }); // prettier-ignore
      const sector = this.data.planar ? pair.sector([-sight[1], sight[0], 0]) : null;
      if (sector) {
        for (const angle of [sector.left, -sector.right]) {
          const d = plus(times(sector.lineOfSight, Math.cos(angle)), sector.across, Math.sin(angle));
          this.cones!.lines.push({ points: [a.at, plus(a.at, d, 1.2 * reach)], colour: colour("in"), width: 1.6, dashed: true });
        }
        return `${other.name}, ${short(sector.left + sector.right, 6)} rad, drawn in doubles`;
      }
      const cone = this.data.planar ? null : pair.cone();
      if (!cone) return "";
      for (const loop of cone.outer) {
        const ends = loop.map(d => times(d, reach));
        const surface: Surface = { points: [0, 0, 0, ...ends.flat()], triangles: [] };
        for (let i = 1; i <= ends.length; ++i) surface.triangles.push(0, i, 1 + (i % ends.length));
        this.cones!.shown.push({ surface, rotation: STANDING, at: a.at, colour: colour("in"), alpha: 0.12 });
        const points = [...ends, ends[0]].map(d => plus(a.at, d));
        this.cones!.lines.push({ points, colour: colour("in"), width: 1.4, dashed: true });
      }
      return `${other.name}, between ${atLeast(cone.least)} and ${atMost(cone.most)} sr, proved`;
    } finally {
      pair.free();
    }
  }

  // --- The distance kept.

  private get agent(): FlownBody | null {
    return this.data.bodies[Number(element<HTMLSelectElement>("agent").value)] ?? null;
  }

  /** Asks the library how far the chosen pair was apart, a little at a time. */
  private measure(): void {
    const pair = this.pair;
    if (!pair) return;
    const [a, b] = [this.bodies.body(pair.a), this.bodies.body(pair.b)];
    if (!this.bodies.answers(a) || !this.bodies.answers(b)) return;
    let kept = this.kept.get(pair);
    if (!kept) {
      const t = a.t.filter(x => rowAt(b.t, x) >= 0);
      this.kept.set(pair, (kept = { t, least: t.map(() => null), most: t.map(() => null), done: 0 }));
    }
    const start = performance.now();
    while (kept.done < kept.t.length && performance.now() - start < BUDGET) {
      const i = kept.done++,
        t = kept.t[i];
      const both = this.bodies.pair(a, placeOf(a, rowAt(a.t, t)), b, this.sameTime(b, t));
      try {
        const now = both.miss([0, 0, 0], [0, 0, 0]);
        [kept.least[i], kept.most[i]] = [now.least, now.most];
      } finally {
        both.free();
      }
    }
    this.showChart();
    if (kept.done < kept.t.length) requestAnimationFrame(() => this.pair === pair && this.measure());
  }
  /** A row of that time where there is one: all bodies have rows at commands. */
  private sameTime(body: FlownBody, t: number): Place {
    const row = rowAt(body.t, t);
    return body.t[row] === t ? placeOf(body, row) : placeAt(body, t)!;
  }

  private showChart(): void {
    const pair = this.pair;
    if (!pair) {
      element("chart-say").textContent = "No pair of bodies could be checked.";
      return;
    }
    const kept = this.kept.get(pair);
    const seen = this.data.encounters.find(
      e => (e.agent === pair.a && e.obstacle === pair.b) || (e.agent === pair.b && e.obstacle === pair.a),
    );
    const series = [];
    if (seen) series.push({ t: seen.t, y: seen.m, colour: colour("quiet"), width: 1.2, dash: [2, 3] });
    if (kept) series.push({ t: kept.t, y: kept.least, colour: colour("ink"), width: 2 });
    const levels = [];
    if (pair.required)
      levels.push({ from: 0, to: this.data.end, y: pair.required, colour: colour("overlapping"), dash: [6, 4] });
    if (pair.least_distance !== null)
      levels.push({ from: pair.from, to: pair.to, y: pair.least_distance, colour: colour("agent"), dash: [] });
    const marks = this.data.events
      .filter(e => [pair.a, pair.b].includes(e.agent) && ["", pair.a, pair.b].includes(e.obstacle))
      .map(e => e.t);
    this.chart.show({ series, levels, marks, unit: "m" });
    const words: [string, string][] = [];
    if (kept) words.push(["kept", "distance at the commands: proved, of each"]);
    if (pair.least_distance !== null) words.push(["proved", "never nearer, between the commands too: proved"]);
    if (pair.required) words.push(["required", "required"]);
    if (seen) words.push(["foreseen", `how near ${seen.agent} would pass, flying straight on: in doubles`]);
    element("chart-legend").replaceChildren(...words.map(([name, text]) => make("li", { class: name }, text)));
    element("chart-say").textContent = proofWords(pair) + (kept ? "" : " " + WITHOUT);
    if (!kept || kept.done < kept.t.length) return;
    const every = Math.max(1, Math.ceil(kept.t.length / 40));
    fillTable(
      element<HTMLTableElement>("chart-table"),
      `Distance of ${pairWords(pair)} at ${every > 1 ? "some of the" : "the"} commands: between these, proved`,
      ["time, s", "at least, m", "at most, m"],
      kept.t.flatMap((t, i) => (i % every ? [] : [[short(t), atLeast(kept.least[i]!, 9), atMost(kept.most[i]!, 9)]])),
    );
  }

  // --- What is told of the time.

  private tellTime(): void {
    const t = this.time,
      slider = element<HTMLInputElement>("time");
    slider.value = String(t);
    element("time-says").textContent = `${t.toFixed(2)} of ${this.data.end.toFixed(2)} s`;
    slider.setAttribute("aria-valuetext", `${t.toFixed(2)} seconds`);
    const past = this.data.events.filter(e => e.t <= t).pop();
    element("happened").textContent = past ? `Last event, at ${short(past.t, 5)} s: ${eventWords(past)}.` : "";
    const now = performance.now();
    if (this.playing && now - this.told < 250) return; // tables that nobody can read so fast
    this.told = now;
    this.tellNow();
    const rows = this.data.bodies.slice(0, MOST_SHOWN).map((body): string[] => {
      const place = placeAt(body, t);
      const list = (x: Vec): string => x.map(c => short(c, 5)).join(", ");
      return [body.name, body.flies ?? body.is, place ? list(place.at) : "not there yet", place ? list(place.velocity) : ""];
    });
    const table = element<HTMLTableElement>("bodies-table");
    fillTable(table, `At ${t.toFixed(2)} s`, ["body", "what it is or does", "at, m", "velocity, m/s"], rows);
  }

  private tellNow(): void {
    const agent = this.agent,
      row = agent ? rowAt(agent.t, this.time) : -1;
    const rows: (Node | string)[][] = [];
    let left = 0;
    const start = performance.now();
    for (const other of this.data.bodies) {
      if (!agent || row < 0 || other === agent || rowAt(other.t, agent.t[row]) < 0) continue;
      if (!this.bodies.answers(agent) || !this.bodies.answers(other) || performance.now() - start > 100) ++left;
      else rows.push(this.nowRow(agent, placeOf(agent, row), other, this.sameTime(other, agent.t[row])));
    }
    fillTable(
      element<HTMLTableElement>("now"),
      agent && row >= 0 ? `Seen by ${agent.name} at its command of ${short(agent.t[row])} s` : "Nothing is there yet",
      ["body", "apart now, m", "they will", "when, or how near", "the law"],
      rows,
    );
    element("now-say").textContent =
      "Asked of the library in this page, about the bodies as bodies.csv has them at that command. Verdicts and distances " +
      "between two numbers are proved; what the law says is from encounters.csv." + (left ? ` ${left} more: ${WITHOUT}` : "");
  }

  private nowRow(agent: FlownBody, at: Place, other: FlownBody, there: Place): (Node | string)[] {
    const pair: Pair = this.bodies.pair(agent, at, other, there);
    try {
      const now = pair.miss([0, 0, 0], [0, 0, 0]),
        verdict = pair.verdict(at.velocity, there.velocity);
      const contact = verdict === "in" || verdict === "on" ? pair.contact(at.velocity, there.velocity) : null;
      const miss = verdict === "out" ? pair.miss(at.velocity, there.velocity) : null;
      const ahead = contact
        ? `between ${atLeast(contact.earliest, 7)} and ${atMost(contact.latest, 7)} s`
        : miss
          ? `between ${atLeast(miss.least, 7)} and ${atMost(miss.most, 7)} m`
          : "";
      const seen = this.data.encounters.find(e => e.agent === agent.name && e.obstacle === other.name);
      const row = seen ? rowAt(seen.t, agent.t[at.row]) : -1,
        asks = seen && row >= 0 ? seen.a[row] : null;
      const law = seen && row >= 0 ? seen.status[row] + (asks ? `, ${short(asks, 3)} m/s\u00b2` : "") : "";
      const words = { out: "never meet", on: "touch", in: "overlap", undecided: "undecided", touching: "touch now", overlapping: "overlap now" };
      return [other.name, `${atLeast(now.least)} to ${atMost(now.most)}`, words[verdict], ahead, law];
    } finally {
      pair.free();
    }
  }

  // --- What stays.

  private head(): void {
    const box = element("verdict");
    box.className = this.data.verdict;
    element("verdict-word").textContent = this.data.verdict;
    element("verdict-says").textContent = VERDICTS[this.data.verdict] ?? "";
    const count = this.data.proof.pairs.length;
    element("exactness").textContent =
      `${this.data.bodies.length} bodies over ${short(this.data.end)} s, a command each ${short(this.data.step)} s; ` +
      `${count} pair${count === 1 ? "" : "s"} judged.`;
  }

  private tellProofs(): void {
    const rows = this.pairs.slice(0, MOST_SHOWN).map((p): (Node | string)[] => [
      button(pairWords(p), () => {
        this.choose(p);
        this.go(p.least_time ?? p.to, proofWords(p));
      }, "show " + pairWords(p)), // prettier-ignore
      p.verdict,
      metres(p.least_distance),
      metres(p.required) + (p.required ? (p.kept ? ", kept" : ", not kept") : ""),
      p.verdict === "touched" ? `${atLeast(p.from)} to ${atMost(p.to)}` : `${digits(p.from)} to ${digits(p.to)}`,
      String(p.pieces),
    ]);
    fillTable(
      element<HTMLTableElement>("proofs"),
      "Of each pair, the worst first; a name shows it where it is nearest",
      ["pair", "proved", "apart by, m", "required, m", "from, to, s", "pieces of time"],
      rows,
    );
    const { not_checked: none, passages } = this.data.proof;
    const more = this.pairs.length - rows.length;
    element("proofs-say").textContent =
      "Each piece of time has its own proof: bodies apart at its ends by exact arithmetic, and meanwhile by more than they can move." +
      (more > 0 ? ` ${more} more pairs: proof.json.` : "") +
      (none.length ? ` Not checked: ${none.length} that do not move against each other.` : "");
    if (!passages?.length) return;
    element("passages").parentElement!.hidden = false;
    fillTable(
      element<HTMLTableElement>("passages"),
      "Of each body and opening",
      ["through", "proved", "from the rim, m", "at, s", "pieces of time"],
      passages.map((p: PassageProof): (Node | string)[] => [
        button(`${p.agent} through ${p.orifice}`, () => this.go(p.time ?? p.to), `show ${p.agent} at ${p.orifice}`),
        p.verdict,
        metres(p.least_distance),
        p.time === null ? "" : short(p.time),
        String(p.pieces),
      ]),
    );
  }

  private tellEvents(): void {
    const rows = this.data.events.slice(0, MOST_SHOWN).map((e): (Node | string)[] => [
      button(short(e.t, 5), () => this.go(e.t, eventWords(e)), `go to ${short(e.t, 5)} s: ${eventWords(e)}`),
      eventWords(e),
    ]);
    const more = this.data.events.length - rows.length;
    fillTable(
      element<HTMLTableElement>("events"),
      "A time goes there" + (more > 0 ? `; ${more} more in events.csv` : ""),
      ["time, s", "what happened"],
      rows,
    );
  }

  private fit(): void {
    const points: Vec[] = [];
    this.data.bodies.forEach((body, i) => {
      // A large one that stands is there for what flies past it.
      const reach = body.flies || this.data.bodies.every(b => !b.flies) ? this.sizes[i] : Math.min(this.sizes[i], 0.6 * this.spread());
      const n = body.t.length;
      for (let k = 0; k < Math.min(20, n); ++k) {
        const at = placeOf(body, Math.floor((k * (n - 1)) / Math.max(1, Math.min(20, n) - 1))).at;
        for (const s of [-reach, reach]) for (const e of [0, 1, 2]) points.push(plus(at, unitOf(e), s));
      }
    });
    for (const goal of this.data.goals) points.push(goalAt(goal, this.data.bodies, 0));
    if (points.length) this.solid.fit(points);
  }
  private get close(): boolean {
    return element<HTMLSelectElement>("look").value === "pair";
  }
  /** Both bodies of the pair, or as much of a large one as is around the other. */
  private fitPair(t: number): void {
    const both = [this.pair?.a, this.pair?.b]
      .map(name => this.data.bodies.findIndex(body => body.name === name))
      .map(i => ({ size: this.sizes[i] ?? 0, place: i < 0 ? null : placeAt(this.data.bodies[i], t) }));
    const gap = both[0].place && both[1].place ? norm(plus(both[0].place.at, both[1].place.at, -1)) : 0;
    const points = both.flatMap(({ size, place }) =>
      place ? [-1, 1].flatMap(s => [0, 1, 2].map(k => plus(place.at, unitOf(k), s * Math.min(size, gap || size)))) : [],
    );
    if (points.length) this.solid.fit(points);
  }
  private spread(): number {
    const all = this.data.bodies.filter(body => body.flies).flatMap(body => [placeOf(body, 0).at, placeOf(body, body.t.length - 1).at]);
    return all.length ? Math.max(...all.map(x => norm(plus(x, all[0], -1))), 1) : Infinity;
  }

  private controls(): void {
    const end = this.data.end;
    const jump = (way: number): void => {
      const next = way > 0 ? this.data.events.find(e => e.t > this.time + 1e-9) : this.data.events.filter(e => e.t < this.time - 1e-9).pop();
      this.go(next ? next.t : way > 0 ? end : 0, next ? `${short(next.t, 5)} s: ${eventWords(next)}` : way > 0 ? "the end" : "the start");
    };
    const play = button("play", () => this.play(!this.playing));
    play.id = "play";
    play.removeAttribute("aria-label");
    element("run-buttons").append(
      play,
      button("start", () => this.go(0), "to the start"),
      button("\u2190 event", () => jump(-1), "the event before"),
      button("event \u2192", () => jump(1), "the next event"),
    );
    const slider = element<HTMLInputElement>("time");
    slider.max = String(end);
    slider.addEventListener("input", () => this.go(Number(slider.value)));
    slider.addEventListener("keydown", e => {
      const way = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[e.key];
      if (way === undefined) return;
      e.preventDefault(); // by commands, not by some share of the run
      this.go(this.time + way * (e.shiftKey ? 10 : 1) * this.data.step);
    });
    const pairs = element<HTMLSelectElement>("pair"),
      agents = element<HTMLSelectElement>("agent");
    this.pairs.forEach((p, i) => pairs.append(make("option", { value: String(i) }, pairWords(p))));
    this.data.bodies.forEach((b, i) => agents.append(make("option", { value: String(i) }, b.name)));
    pairs.addEventListener("change", () => this.choose(this.pairs[Number(pairs.value)]));
    agents.addEventListener("change", () => this.all());
    element("cones").addEventListener("change", () => this.all());
    element("look").addEventListener("change", () => {
      this.fit();
      this.redraw();
    });
    element("solid-buttons").append(...this.solid.buttons(this.data.planar));
  }
}

const WITHOUT = "bodies that change, and maps of more than 20,000 pieces, are not asked about in a page.";
const unitOf = (k: number): Vec => [0, 1, 2].map(i => Number(i === k)) as Vec;

/** What has been flown, and faint what is to come. */
function ways(body: FlownBody, place: Place | null, t: number, ink: string): Line[] {
  const n = body.t.length,
    row = place?.row ?? -1;
  const points = Array.from({ length: n }, (_, i): Vec => [body.at[3 * i], body.at[3 * i + 1], body.at[3 * i + 2]]);
  const lines: Line[] = [];
  if (place && row >= 0 && t > body.t[0]) lines.push({ points: [...points.slice(0, row + 1), place.at], colour: ink, width: 2 });
  if (row < n - 1) lines.push({ points: [...(place ? [place.at] : []), ...points.slice(row + 1)], colour: ink, width: 0.7 });
  return lines;
}

function proofWords(p: PairProof): string {
  const names = pairWords(p);
  if (p.verdict === "touched") return `${names}: apart before ${atLeast(p.from, 9)} s, meeting at ${atMost(p.to, 9)} s, both proved.`;
  if (p.verdict === "undecided") return `${names}: closer than the proof resolves between ${digits(p.from)} and ${digits(p.to)} s.`;
  const kept = p.required ? ` Required: ${short(p.required)} m, ${p.kept ? "kept: proved" : "not kept"}.` : "";
  return (
    `${names}: never nearer than ${atLeast(p.least_distance ?? 0)} m from ${digits(p.from)} to ${digits(p.to)} s, between the ` +
    `commands too: proved, in ${p.pieces} pieces of time; nearest at about ${short(p.least_time ?? 0)} s.${kept}`
  );
}
