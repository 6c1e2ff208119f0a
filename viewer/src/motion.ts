// SPDX-License-Identifier: BSD-3-Clause
//
// Where the bodies of a run are at a time, how they look then, and the pair that two of them make.
import { Pair, type Core, type Vec } from "./core";
import type { FlownBody, GoalData, OrificeData, RunData, Surface } from "./data";
import { cross, dot, norm, plus, times, turned, unit } from "./doubles";

export interface Place {
  row: number; // the last one at or before the time
  at: Vec;
  turn: number[]; // rotation, row by row
  velocity: Vec;
  k: number;
}

const three = (list: number[], row: number): Vec => [list[3 * row], list[3 * row + 1], list[3 * row + 2]];

/** The last row at or before a time; -1 before all of them. */
export function rowAt(list: number[], t: number): number {
  let low = -1,
    high = list.length;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (list[middle] <= t) low = middle;
    else high = middle;
  }
  return low;
}

/** Of a unit quaternion w, x, y, z; of one of z alone the last row is that of z to the bit. */
function rotation(q: number[]): number[] {
  const n = Math.hypot(...q),
    [w, x, y, z] = q.map(c => c / n);
  return [
    1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
    2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
    2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y),
  ]; // prettier-ignore
}

/** As a row of its table has it. */
export function placeOf(body: FlownBody, row: number): Place {
  return {
    row,
    at: three(body.at, row),
    turn: rotation(body.turn.slice(4 * row, 4 * row + 4)),
    velocity: three(body.velocity, row),
    k: body.k?.[row] ?? 0,
  };
}

/** Between the rows straight on and by the shorter turn, for pictures; null before it appears. */
export function placeAt(body: FlownBody, t: number): Place | null {
  const row = rowAt(body.t, t);
  if (row < 0) return null;
  const next = Math.min(row + 1, body.t.length - 1),
    span = body.t[next] - body.t[row];
  const share = span > 0 ? (t - body.t[row]) / span : 0;
  const mix = (list: number[], size: number, sign = 1): number[] =>
    Array.from({ length: size }, (_, i) => (1 - share) * list[size * row + i] + sign * share * list[size * next + i]);
  let near = 0;
  for (let i = 0; i < 4; ++i) near += body.turn[4 * row + i] * body.turn[4 * next + i];
  return {
    row,
    at: mix(body.at, 3) as Vec,
    turn: rotation(mix(body.turn, 4, near < 0 ? -1 : 1)),
    velocity: three(body.velocity, row),
    k: body.k ? mix(body.k, 1)[0] : 0,
  };
}

/** How far a dented body reaches along u: (x/a)^2 + |(y/b)^2 + (z/c)^2 - k| <= 1. */
function reach(axes: number[], k: number, u: Vec): number {
  const x = (u[0] / axes[0]) ** 2,
    rest = (u[1] / axes[1]) ** 2 + (axes.length > 2 ? (u[2] / axes[2]) ** 2 : 0);
  if (x + rest === 0) return 0;
  return Math.min(Math.sqrt((1 + k) / (x + rest)), x > rest ? Math.sqrt(Math.max(1 - k, 0) / (x - rest)) : Infinity);
}

export function surfaceAt(body: FlownBody, k: number): Surface {
  if (!body.dented) return body.surface;
  const points: number[] = [];
  for (let i = 0; i < body.surface.points.length / 3; ++i) {
    const u = three(body.surface.points, i);
    points.push(...times(u, reach(body.dented, k, u)));
  }
  return { points, triangles: body.surface.triangles };
}

/** The farthest point of it from its reference point, m. */
export function sizeOf(body: FlownBody): number {
  const { points } = surfaceAt(body, 1);
  let most = 0;
  for (let i = 0; i < points.length / 3; ++i) most = Math.max(most, norm(three(points, i)));
  return most;
}

const product = (a: number[], b: number[]): number[] =>
  [0, 3, 6].flatMap(i => [0, 1, 2].map(j => a[i] * b[j] + a[i + 1] * b[3 + j] + a[i + 2] * b[6 + j]));

/** The library's bodies of a run: made when first asked for. */
export class Bodies {
  private readonly handles = new Map<string, number>();

  constructor(
    private readonly core: Core,
    private readonly data: RunData,
  ) {}

  /** Whether the library can be asked about it: it keeps its shape, and the page has all of it. */
  answers(body: FlownBody): boolean {
    return body.numbers !== undefined;
  }
  /** Whether the cone of a body takes no longer than a picture: it is of one piece. */
  quick(body: FlownBody): boolean {
    return this.answers(body) && body.numbers![0] !== 2 && body.numbers![0] !== 3;
  }
  /** Two bodies where they are; who asks frees it. */
  pair(a: FlownBody, atA: Place, b: FlownBody, atB: Place): Pair {
    const own = (body: FlownBody, place: Place): [number, Vec, number[]] => [
      this.handle(body),
      plus(place.at, turned(place.turn, body.position!)),
      body.rotation!.every((x, i) => x === Number(i % 4 === 0)) ? place.turn : product(place.turn, body.rotation!),
    ];
    return new Pair(this.core, ...own(a, atA), ...own(b, atB));
  }
  private handle(body: FlownBody): number {
    let found = this.handles.get(body.name);
    if (found === undefined) this.handles.set(body.name, (found = this.core.body(body.numbers!)));
    return found;
  }
  body(name: string): FlownBody {
    return this.data.bodies.find(body => body.name === name)!;
  }
}

/** The outline of an opening at a time, in the world. */
export function rimAt(orifice: OrificeData, t: number): Vec[] {
  const { semi_axes: axes, polygon, rim } = orifice.opening;
  const angle = (i: number): number => (2 * Math.PI * i) / 64;
  const own: Vec[] = axes
    ? Array.from({ length: 64 }, (_, i): Vec => [axes[0] * Math.cos(angle(i)), axes[1] * Math.sin(angle(i)), 0])
    : (rim ?? polygon?.map(([x, y]): Vec => [x, y, 0]) ?? []);
  const s = t - orifice.appears,
    rate = norm(orifice.spin);
  const spun = (x: Vec): Vec => {
    if (rate === 0) return x;
    const n = unit(orifice.spin),
      c = Math.cos(rate * s); // Rodrigues' formula
    return plus(plus(times(x, c), cross(n, x), Math.sin(rate * s)), n, dot(n, x) * (1 - c));
  };
  const centre = plus(orifice.position, orifice.velocity, s);
  return [...own, own[0]].map(x => plus(centre, spun(turned(orifice.rotation.flat(), x))));
}

/** Where a goal is at a time. */
export function goalAt(goal: GoalData, bodies: FlownBody[], t: number): Vec {
  const at = goal.velocity ? plus(goal.point, goal.velocity, t) : goal.point;
  const followed = goal.follows === undefined ? null : bodies.find(body => body.name === goal.follows);
  const place = followed ? placeAt(followed, t) : null;
  return place ? plus(at, place.at) : at;
}
