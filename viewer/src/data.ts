// SPDX-License-Identifier: BSD-3-Clause
//
// What `vericone view` puts into the page (apps/src/view, apps/src/simulate).
import type { Vec } from "./core";

export interface Surface {
  points: number[];
  triangles: number[];
  sizes?: number[]; // m, half the width of what stands about each point
}

export interface BodyData {
  name: string;
  is: string;
  numbers: number[]; // all that defines it, for the library
  position: Vec;
  rotation: number[]; // row by row
  velocity: Vec;
  middle: Vec; // in the world
  surface: Surface; // about its middle, rounded, in its own axes; in the plane in those of the world
}

export interface SceneData {
  what: "scene";
  title: string;
  planar: boolean;
  guarantee: { exact: boolean; family: string; tolerance: number };
  answer: Record<string, unknown>;
  bodies: [BodyData, BodyData];
}

/** Lists over time: one entry, three or four a row. */
export interface FlownBody {
  name: string;
  is: string;
  flies: string | null; // how, of a body that has a pilot
  surface: Surface; // about its reference point, in its own axes; of one that is dented the unit ball
  numbers?: number[]; // all that defines it, for the library; of a map too large for a page nothing
  position?: Vec; // where that stands in the body's own axes
  rotation?: number[];
  dented?: number[]; // semi-axes of a body whose dents change
  t: number[];
  at: number[];
  turn: number[]; // w, x, y, z
  velocity: number[];
  acceleration: (number | null)[];
  k?: number[];
}
export interface EncounterData {
  agent: string;
  obstacle: string;
  t: number[];
  m: (number | null)[];
  a: (number | null)[];
  status: string[];
}
export interface EventData {
  t: number;
  event: string;
  agent: string;
  obstacle: string;
  value: number | null;
  unit: string;
}
export interface PairProof {
  a: string;
  b: string;
  verdict: string;
  from: number;
  to: number;
  place: Vec | null;
  least_distance: number | null;
  least_time: number | null;
  pieces: number;
  required?: number;
  kept?: boolean;
}
export interface PassageProof {
  agent: string;
  orifice: string;
  verdict: string;
  time: number | null;
  from: number;
  to: number;
  least_distance: number | null;
  place: Vec;
  pieces: number;
}
export interface OrificeData {
  name: string;
  opening: { semi_axes?: [number, number]; polygon?: [number, number][]; rim?: Vec[] };
  position: Vec;
  velocity: Vec;
  rotation: [Vec, Vec, Vec];
  spin: Vec;
  appears: number;
}
export interface GoalData {
  agent: string;
  point: Vec;
  reached: number;
  velocity?: Vec;
  follows?: string;
}

/** What `vericone simulate` wrote (apps/src/simulate/run_page.cpp). */
export interface RunData {
  what: "run";
  title: string;
  planar: boolean;
  verdict: string;
  end: number;
  step: number;
  goals: GoalData[];
  bodies: FlownBody[];
  encounters: EncounterData[];
  events: EventData[];
  proof: { pairs: PairProof[]; not_checked: { a: string; b: string }[]; passages?: PassageProof[] };
  orifices?: OrificeData[];
}

export type PageData = SceneData | RunData;
