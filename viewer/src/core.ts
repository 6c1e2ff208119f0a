// SPDX-License-Identifier: BSD-3-Clause
//
// The library's C interface (c/include/vericone_c.h), compiled to WebAssembly: its answers.

export type Vec = [number, number, number];

export const VERDICTS = ["out", "on", "in", "touching", "overlapping", "undecided"] as const;
export type Verdict = (typeof VERDICTS)[number];
export const RUNGS = ["triage", "interval", "exact", "certified"] as const;
export type Rung = (typeof RUNGS)[number];

export interface Contact {
  earliest: number;
  latest: number;
  time: number;
  point: Vec;
  normal: Vec;
}
export interface Miss {
  least: number;
  most: number;
  depth: number;
  normal: Vec;
  time: number;
  distance: number;
}
export interface Sector {
  lineOfSight: Vec;
  across: Vec;
  distance: number;
  left: number;
  right: number;
  leftError: number;
  rightError: number;
}
export interface ConeShape {
  least: number;
  most: number;
  inner: Vec[][];
  outer: Vec[][];
}

type Call = (...values: number[]) => number | bigint;

const SCRATCH = 128; // doubles for what goes in and out of one call

/** What the module wants of a system: nothing is there, nothing is written. */
function nothingThere(module: WebAssembly.Module): WebAssembly.Imports {
  const imports: Record<string, Record<string, WebAssembly.ImportValue>> = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module)) {
    const end = name === "proc_exit" || name === "abort";
    (imports[from] ??= {})[name] = end
      ? () => {
          throw new Error("the core has stopped");
        }
      : () => 52; // ENOSYS
  }
  return imports;
}

export class Core {
  private readonly scratch: number;

  private constructor(
    private readonly exported: Record<string, Call>,
    private readonly memory: WebAssembly.Memory,
  ) {
    this.scratch = Number(exported.malloc(8 * SCRATCH));
    if (this.call("vericone_sound_arithmetic") !== 0) throw new Error(this.error());
  }

  /** `text`: the module, gzip, base64. */
  static async fromText(text: string): Promise<Core> {
    const bytes = Uint8Array.from(atob(text.trim()), c => c.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
    const module = await WebAssembly.compile(await new Response(stream).arrayBuffer());
    const instance = await WebAssembly.instantiate(module, nothingThere(module));
    const { memory, ...rest } = instance.exports;
    const exported = rest as unknown as Record<string, Call>;
    exported._initialize?.();
    return new Core(exported, memory as WebAssembly.Memory);
  }

  call(name: string, ...values: number[]): number {
    return Number(this.exported[name](...values));
  }

  /** What an error of the library says. */
  error(): string {
    return this.text(this.call("vericone_error"));
  }
  version(): string {
    return this.text(this.call("vericone_version"));
  }

  private text(at: number): string {
    const bytes = new Uint8Array(this.memory.buffer);
    let end = at;
    while (bytes[end]) ++end;
    return new TextDecoder().decode(bytes.slice(at, end));
  }

  /** The address of numbers put into the scratch block from its i-th double on. */
  put(i: number, numbers: ArrayLike<number>): number {
    new Float64Array(this.memory.buffer, this.scratch + 8 * i, numbers.length).set(numbers);
    return this.scratch + 8 * i;
  }
  address(i: number): number {
    return this.scratch + 8 * i;
  }
  take(i: number, count: number): number[] {
    return [...new Float64Array(this.memory.buffer, this.scratch + 8 * i, count)];
  }

  /** Memory for the time of one call. */
  borrow<T>(bytes: number, use: (at: number, buffer: () => ArrayBuffer) => T): T {
    const at = this.call("malloc", bytes);
    if (!at) throw new Error("out of memory");
    try {
      return use(at, () => this.memory.buffer as ArrayBuffer);
    } finally {
      this.call("free", at);
    }
  }

  checked(answer: number): number {
    if (answer < 0 || Number.isNaN(answer)) throw new Error(this.error());
    return answer;
  }

  body(numbers: number[]): number {
    const made = this.borrow(8 * numbers.length, (at, buffer) => {
      new Float64Array(buffer(), at, numbers.length).set(numbers);
      return this.call("vericone_body_of_numbers", at, numbers.length);
    });
    if (!made) throw new Error(this.error());
    return made;
  }
}

const vec = (x: number[], i: number): Vec => [x[i], x[i + 1], x[i + 2]];

/** Two bodies where they stand. Rotations row by row. */
export class Pair {
  private handle: number;

  constructor(
    private readonly core: Core,
    agent: number,
    atA: Vec,
    turnA: number[],
    obstacle: number,
    atB: Vec,
    turnB: number[],
  ) {
    this.handle = core.call(
      "vericone_pair_new",
      agent,
      core.put(0, atA),
      core.put(3, turnA),
      obstacle,
      core.put(12, atB),
      core.put(15, turnB),
      0,
    );
    if (!this.handle) throw new Error(core.error());
  }
  free(): void {
    this.core.call("vericone_pair_free", this.handle);
    this.handle = 0;
  }

  get exact(): boolean {
    return this.core.call("vericone_pair_exact", this.handle) === 1;
  }

  private ask(name: string, v: Vec, u: Vec, ...more: number[]): number {
    return this.core.checked(
      this.core.call(name, this.handle, this.core.put(0, v), this.core.put(3, u), ...more),
    );
  }
  verdict(v: Vec, u: Vec): Verdict {
    return VERDICTS[this.ask("vericone_pair_verdict", v, u)];
  }
  rung(v: Vec, u: Vec): Rung {
    return RUNGS[this.ask("vericone_pair_rung", v, u)];
  }

  /** Of many velocities of the agent, xyz by xyz: an index of VERDICTS each. */
  verdicts(velocities: Float64Array, u: Vec): Uint8Array {
    const count = velocities.length / 3;
    return this.core.borrow(25 * count, (at, buffer) => {
      new Float64Array(buffer(), at, velocities.length).set(velocities);
      this.core.checked(
        this.core.call(
          "vericone_pair_verdicts",
          this.handle,
          at,
          count,
          this.core.put(0, u),
          at + 24 * count,
        ),
      );
      return new Uint8Array(buffer(), at + 24 * count, count).slice();
    });
  }

  contact(v: Vec, u: Vec): Contact | null {
    if (!this.ask("vericone_pair_contact", v, u, this.core.address(16))) return null;
    const x = this.core.take(16, 9);
    return { earliest: x[0], latest: x[1], time: x[2], point: vec(x, 3), normal: vec(x, 6) };
  }
  miss(v: Vec, u: Vec): Miss {
    this.ask("vericone_pair_miss", v, u, this.core.address(16));
    const x = this.core.take(16, 8);
    return { least: x[0], most: x[1], depth: x[2], normal: vec(x, 3), time: x[6], distance: x[7] };
  }
  /** On the plane through the line of sight and `across`; null: not apart, or nothing of it collides. */
  sector(across: Vec): Sector | null {
    const found = this.core.call(
      "vericone_pair_sector",
      this.handle,
      this.core.put(0, across),
      this.core.address(16),
    );
    if (found !== 1) return null;
    const x = this.core.take(16, 11);
    return {
      lineOfSight: vec(x, 0),
      across: vec(x, 3),
      distance: x[6],
      left: x[7],
      right: x[8],
      leftError: x[9],
      rightError: x[10],
    };
  }
  /** null: there is none, as the bodies are not apart. */
  cone(): ConeShape | null {
    const cone = this.core.call("vericone_cone_new", this.handle, 0, 0.05, 1);
    if (!cone) return null;
    try {
      this.core.call("vericone_cone_solid_angle", cone, this.core.address(16), this.core.address(17));
      const [least, most] = this.core.take(16, 2);
      return { least, most, inner: this.loops(cone, 0), outer: this.loops(cone, 1) };
    } finally {
      this.core.call("vericone_cone_free", cone);
    }
  }
  private loops(cone: number, which: number): Vec[][] {
    const count = this.core.call("vericone_cone_loops", cone, which);
    return Array.from({ length: count }, (_, i) => {
      const size = this.core.call("vericone_cone_loop", cone, which, i, 0, 0);
      return this.core.borrow(24 * size, (at, buffer) => {
        this.core.call("vericone_cone_loop", cone, which, i, at, size);
        const x = new Float64Array(buffer(), at, 3 * size);
        return Array.from({ length: size }, (_, k): Vec => [x[3 * k], x[3 * k + 1], x[3 * k + 2]]);
      });
    });
  }
}
