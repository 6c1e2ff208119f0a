// SPDX-License-Identifier: BSD-3-Clause
// Opens a page of `vericone simulate --animate` without a browser: node animation_page.js PAGE WIDTH HEIGHT SHARE...
// Moves its slider to each share of the run's time, plays it, drags it, and prints what was drawn as JSON.
"use strict";
const fs = require("fs");
const vm = require("vm");

const [page, width, height, ...shares] = process.argv.slice(2);
const text = fs.readFileSync(page, "utf8");
const scripts = [...text.matchAll(/<script([^>]*)>([\s\S]*?)<\/script>/g)];
const data = scripts.find(s => s[1].includes("application/json"))[2];
const code = scripts.find(s => !s[1].includes("application/json"))[2];

let drawn = [], path = [];
const state = {globalAlpha: 1, fillStyle: "", strokeStyle: "", lineWidth: 1, setLineDash() {}, setTransform() {},
  clearRect() { drawn = []; }, beginPath() { path = []; }, closePath() {},
  moveTo(x, y) { path.push([x, y]); }, lineTo(x, y) { path.push([x, y]); },
  arc(x, y, r) { for (let i = 0; i <= 24; ++i) path.push([x + r * Math.cos(i * Math.PI / 12), y + r * Math.sin(i * Math.PI / 12)]); },
  fill() { drawn.push({fill: state.fillStyle, alpha: state.globalAlpha, path}); },
  stroke() { drawn.push({stroke: state.strokeStyle, width: state.lineWidth, alpha: state.globalAlpha, path}); },
  fillRect(x, y, w, h) { drawn.push({fill: state.fillStyle, alpha: state.globalAlpha, path: [[x, y], [x + w, y], [x + w, y + h], [x, y + h]]}); },
  fillText(words, x, y) { drawn.push({text: words, at: [x, y], align: state.textAlign}); }};

function element() {
  return {style: {}, children: [], handlers: {}, value: "1", textContent: "", clientWidth: Number(width), clientHeight: Number(height),
    getContext: () => state, setPointerCapture() {}, append(...all) { this.children.push(...all); },
    addEventListener(name, action) { this.handlers[name] = action; }};
}
const elements = {data: {textContent: data}};
let waiting = null;
const window = {addEventListener() {}};
const document = {createElement: element, getElementById: id => elements[id] || (elements[id] = element())};
const context = vm.createContext({window, document, console, requestAnimationFrame: action => { waiting = action; }});
vm.runInContext(code, context, {filename: page});

const frames = [];
const keep = what => frames.push({what, time: elements.time.textContent, note: elements.note.textContent, drawn});
for (const share of shares) {
  elements.slider.handlers.input({target: {value: 1000 * share}});
  keep("slider at " + share);
}
elements.slider.handlers.input({target: {value: "0"}});
elements.play.handlers.click();
for (let now = 0; waiting && now <= 1000; now += 100) {
  const action = waiting;
  waiting = null;
  action(now);
}
keep("played for a second");
elements.canvas.handlers.pointerdown({pointerId: 1, clientX: 10, clientY: 10});
elements.canvas.handlers.pointermove({pointerId: 1, clientX: 60, clientY: 40});
keep("dragged");
for (const button of elements.views.children) {
  button.handlers.click();
  keep(button.textContent);
}
const pose = context.poseAt ? vm.runInContext("(name, t) => poseAt(data.bodies.find(b => b.name === name), t)", context) : null;
const poses = Object.fromEntries(JSON.parse(data).bodies.map(b => [b.name, pose(b.name, b.t[b.t.length >> 1])]));
console.log(JSON.stringify({title: elements.title.textContent, names: elements.names.children.map(c => c.children[1]), frames, poses}));
