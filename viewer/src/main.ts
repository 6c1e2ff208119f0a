// SPDX-License-Identifier: BSD-3-Clause
import { Core, Pair } from "./core";
import type { PageData } from "./data";
import { element } from "./dom";
import { RunPage } from "./run";
import { ScenePage } from "./scene";

async function start(): Promise<void> {
  const data = JSON.parse(element("data").textContent ?? "") as PageData;
  document.title = data.title + " \u2013 vericone";
  element("title").textContent = data.title;
  element("main").append(element<HTMLTemplateElement>("of-" + data.what).content);
  const core = await Core.fromText(element("core").textContent ?? "");
  element("version").textContent = "vericone " + core.version();
  const page = data.what === "run" ? new RunPage(core, data) : new ScenePage(core, data);
  // For tests of this page: the library that it asks.
  Object.assign(window, { vericone: { core, page, data, Pair } });
  document.documentElement.dataset.ready = "yes";
}

start().catch(error => {
  element("complaint").textContent =
    "This page could not start: " +
    String(error?.message ?? error) +
    ". It needs a browser of 2023 or later (WebAssembly with exceptions, DecompressionStream).";
});
