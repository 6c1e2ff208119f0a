// SPDX-License-Identifier: BSD-3-Clause
//
// Doubles one by one, and vectors of three.
import type { Vec } from "./core";

const bits = new DataView(new ArrayBuffer(8));

/** The double `steps` away from a finite x, in units in the last place; x where that is not finite. */
export function stepped(x: number, steps: number): number {
  bits.setFloat64(0, x);
  const raw = bits.getBigInt64(0);
  // Doubles in order are whole numbers in order: negative ones count down from zero.
  const place = raw < 0n ? -(raw & 0x7fffffffffffffffn) : raw;
  const wanted = place + BigInt(steps);
  bits.setBigInt64(0, wanted < 0n ? -wanted : wanted);
  const size = bits.getFloat64(0);
  const found = wanted < 0n ? -size : size;
  return Number.isFinite(found) ? found : x;
}

/** A number that somebody typed; null where it is none. */
export function typed(text: string): number | null {
  const plain = text.trim().replace("\u2212", "-");
  if (!/^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(plain)) return null;
  const x = Number(plain);
  return Number.isFinite(x) ? x : null;
}

/** With all its digits: read again, it is the same double. */
export const digits = (x: number): string => (Object.is(x, -0) ? "-0" : String(x));
/** For people. */
export const short = (x: number, n = 6): string =>
  Number.isFinite(x) ? String(Number(x.toPrecision(n))) : x > 0 ? "for ever" : "-";

/** For people, and true: no more than x, no less than x. */
export const atLeast = (x: number, n = 6): string => rounded(x, n, -1);
export const atMost = (x: number, n = 6): string => rounded(x, n, 1);
function rounded(x: number, n: number, way: number): string {
  if (!Number.isFinite(x) || x === 0) return short(x, n);
  const near = Number(x.toPrecision(n));
  if (way * (near - x) >= 0) return String(near);
  const place = Math.floor(Math.log10(Math.abs(near))) + 1 - n;
  const next = Number((near + way * 10 ** place).toPrecision(n));
  return way * (next - x) >= 0 ? String(next) : digits(x);
}

export const dot = (a: Vec, b: Vec): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const plus = (a: Vec, b: Vec, k = 1): Vec => [a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]];
export const times = (a: Vec, k: number): Vec => [k * a[0], k * a[1], k * a[2]];
export const norm = (a: Vec): number => Math.hypot(a[0], a[1], a[2]);
export const unit = (a: Vec): Vec => times(a, 1 / norm(a));
export const cross = (a: Vec, b: Vec): Vec => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
/** Some unit vector across a. */
export function anyAcross(a: Vec): Vec {
  const small = [0, 1, 2].reduce((m, i) => (Math.abs(a[i]) < Math.abs(a[m]) ? i : m), 0);
  const e: Vec = [0, 0, 0];
  e[small] = 1;
  return unit(cross(a, e));
}
export const turned = (rows: number[], p: Vec): Vec =>
  [0, 3, 6].map(i => rows[i] * p[0] + rows[i + 1] * p[1] + rows[i + 2] * p[2]) as Vec;
