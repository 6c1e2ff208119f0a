// SPDX-License-Identifier: BSD-3-Clause
//
// What `vericone view` puts into the page (apps/src/view/scene_page.cpp).
import type { Vec } from "./core";

export interface Surface {
  points: number[];
  triangles: number[];
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

export type PageData = SceneData;
