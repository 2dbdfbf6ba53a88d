// What the sliders of a report page compute, against the program, on random settings.
//
//   node loop_analysis_test.mjs LOOP_SETTINGS ROOT
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import path from "node:path";
import { test } from "node:test";

const [loopSettings, root] = process.argv.slice(2);
const count = 200;
const source = ["matrices", "loop_model", "loop_analysis"].map((name) => readFileSync(path.join(root, "app", "page", `${name}.js`), "utf8")).join("");
const { Matrices, LoopAnalysis } = new Function(`${source}; return { Matrices, LoopAnalysis };`)();
const { step, loops } = JSON.parse(execFileSync(loopSettings, [String(count)], { encoding: "utf8", maxBuffer: 1e9 }));
const cases = loops.flatMap(({ data, settings }) => settings.map((one) => ({ data, prepared: LoopAnalysis.prepare(data, one.setting), ...one })));
const stable = cases.filter(({ expected }) => expected.stable);

const near = (found, expected, tolerance, what) => {
  // null: infinite
  if (expected === null) return assert.equal(found, Infinity, what);
  assert.ok(Math.abs(found - expected) <= tolerance * Math.abs(expected), `${what}: ${found}, expected ${expected}`);
};

test("settings are stable and unstable, in all loops", () => {
  assert.equal(cases.length, count);
  for (const { settings } of loops) assert.ok(settings.filter(({ expected }) => expected.stable).length >= 0.2 * settings.length);
  assert.ok(cases.length - stable.length >= 5);
});

test("stability is the program's", () => {
  for (const { prepared, gains, expected } of cases) {
    const found = LoopAnalysis.stability(prepared, gains);
    assert.equal(found.stable, expected.stable);
    if (!expected.stable) continue;
    near(found.rate_loop_abscissa, expected.rate_loop_abscissa, 1e-6, "rate loop");
    near(found.closed_loop_abscissa, expected.closed_loop_abscissa, 1e-6, "closed loop");
  }
});

test("rms are the program's to 1e-9", () => {
  for (const { prepared, gains, expected } of stable) {
    const found = LoopAnalysis.rms(prepared, gains);
    for (const part of ["beam", "wind", "noise", "effort"]) near(found[part], expected[part], 1e-9, part);
  }
});

test("margins and Ms are the program's to 1e-9", () => {
  for (const { prepared, gains, expected } of stable) {
    LoopAnalysis.margins(prepared, gains).forEach((found, b) => {
      const at = (part) => `${part} of the ${found.name}`;
      for (const part of ["gain_up", "gain_down", "phase_deg", "delay", "peak"]) near(found[part], expected.margins[b][part], 1e-9, at(part));
      near(found.peak_frequency, expected.margins[b].peak_frequency, 1e-5, at("peak_frequency"));
    });
  }
});

test("step responses are the program's to 1e-9 of their largest value", () => {
  for (const { data, setting, gains, expected } of stable) {
    for (const [closed, name] of [[true, "position_step"], [false, "rate_step"]]) {
      const values = expected[name], largest = Math.max(...values.map(Math.abs));
      const found = LoopAnalysis.stepResponse(data, setting, gains, closed, step, values.length);
      values.forEach((value, k) => assert.ok(Math.abs(found[k] - value) <= 1e-9 * largest, `${name} at ${k * step} s: ${found[k]}, expected ${value}`));
    }
  }
});

test("eigenvalues and exponential of a Jordan block, and a matrix that needs balancing", () => {
  const jordan = [[-2, 1, 0], [0, -2, 1], [0, 0, -2]].map((row) => Float64Array.from(row));
  for (const { re } of Matrices.eigenvalues(jordan)) near(re, -2, 1e-4, "triple eigenvalue");
  const exponential = Matrices.exponential(jordan);
  [1, 1, 0.5].forEach((factor, j) => near(exponential[0][j], factor * Math.exp(-2), 1e-13, `exp, column ${j}`));
  const scaled = [[1, 1e8], [-1e-8, 1]].map((row) => Float64Array.from(row));
  for (const { re, im } of Matrices.eigenvalues(scaled)) {
    near(re, 1, 1e-13, "real part");
    near(Math.abs(im), 1, 1e-13, "imaginary part");
  }
});
