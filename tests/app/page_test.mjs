// Reports as pages, in headless Chromium: drawn, explored, printed, without a network.
//
//   node page_test.mjs PROGRAM ROOT CHROMIUM FOLDER
//
// ROOT has web/node_modules; pages are written into FOLDER.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, statSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { test, before, after } from "node:test";

const [program, root, browserPath, folder] = process.argv.slice(2);
const { chromium } = createRequire(path.join(root, "web", "package.json"))("playwright-core");
const most = 6e6; // bytes of a page

mkdirSync(folder, { recursive: true });
const made = {};
const make = (name, args) => {
  const page = path.join(folder, `${name}.html`);
  const json = path.join(folder, `${name}.json`);
  execFileSync(program, [...args, "--report", page, "--json", json], { cwd: root, stdio: ["ignore", "ignore", "inherit"] });
  made[name] = { page, json: JSON.parse(readFileSync(json)), args };
};

let browser;
before(async () => {
  make("redesign", ["redesign", "cases/dss14-70m/campaign.toml"]);
  make("match", ["match", "cases/dss14-70m/case.toml", "--structure", "PI", "DPF+C", "--points", "9", "--no-variants", "--time-domain", "none"]);
  make("tune", ["tune", "cases/dss14-70m/case.toml", "--structure", "PI", "LL+N", "--starts", "1"]);
  browser = await chromium.launch({
    executablePath: browserPath,
    args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"],
  });
});
after(() => browser?.close());

const open = async (name, options = {}) => {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, ...options });
  const page = await context.newPage();
  const troubles = [];
  page.on("console", (message) => { if (["error", "warning"].includes(message.type())) troubles.push(message.text()); });
  page.on("pageerror", (error) => troubles.push(error.message));
  page.on("request", (request) => { if (!/^(file|data):/.test(request.url())) troubles.push(`asks for ${request.url()}`); });
  // Beside other tests a page of some megabytes takes a while.
  await page.goto(`file://${made[name].page}`, { timeout: 300_000 });
  return { page, troubles, close: () => context.close() };
};

// Pairs of visible letters of a drawing whose boxes overlap by more than a pixel; names at a slant
// have boxes that do though they are apart.
const overlaps = (drawing) => {
  const texts = [...drawing.querySelectorAll("text")]
    .filter((text) => text.textContent.trim() && getComputedStyle(text).visibility === "visible" && !text.closest(".hoverlayer, .modebar"))
    .filter((text) => { const m = text.getScreenCTM(); return Math.abs(m.a * m.b) < 1e-6; })
    .map((text) => [text.textContent, text.getBoundingClientRect()]);
  const found = [];
  texts.forEach(([a, x], i) => {
    for (const [b, y] of texts.slice(0, i)) {
      const across = Math.min(x.right, y.right) - Math.max(x.left, y.left);
      const down = Math.min(x.bottom, y.bottom) - Math.max(x.top, y.top);
      if (across > 1 && down > 1) found.push(`${a} | ${b}`);
    }
  });
  return found;
};

// What of a page is cut off, too small or wasted, as a reader sees it.
const layout = () => {
  const window_width = document.documentElement.clientWidth;
  const named = (element) => `${element.closest("section, .decision")?.id} ${element.textContent.trim().slice(0, 60)}`;
  const regions = [...document.querySelectorAll(".table, .canvas")].filter((region) => region.checkVisibility());
  const scrolling = regions.filter((region) => region.scrollWidth > region.clientWidth + 1);
  const outside = regions.filter((region) => { const box = region.getBoundingClientRect(); return box.left < -1 || box.right > window_width + 1; });
  const cells = [...document.querySelectorAll("th, td")].filter((cell) => cell.checkVisibility());
  const cut = (cell) => {
    const region = (cell.closest(".table") ?? document.documentElement).getBoundingClientRect();
    const box = cell.getBoundingClientRect();
    return box.left < region.left - 1 || box.right > region.right + 1;
  };
  const hidden = cells.filter(cut).map(named);
  const small = [];
  const leaves = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let leaf = leaves.nextNode(); leaf; leaf = leaves.nextNode()) {
    const element = leaf.parentElement;
    if (!leaf.data.trim() || !element.checkVisibility() || element.matches("title, desc, script, style, option")) continue;
    const drawn = element.closest("svg") && element.getScreenCTM();
    const size = parseFloat(getComputedStyle(element).fontSize) * (drawn ? Math.hypot(drawn.b, drawn.d) : 1);
    if (size < 10) small.push(`${size} ${named(element)}`);
  }
  const silent = scrolling.filter((region) => !/gradient/.test(getComputedStyle(region).backgroundImage) || getComputedStyle(region).overflowX !== "auto");
  // The last column can be brought into sight.
  const unreachable = scrolling.filter((region) => {
    region.scrollLeft = region.scrollWidth;
    const end = region.getBoundingClientRect().right;
    return [...region.firstElementChild.querySelectorAll("tr > :last-child")].some((cell) => cell.getBoundingClientRect().right > end + 1);
  });
  return {
    overflow: document.documentElement.scrollWidth - window_width,
    used: document.querySelector("main").getBoundingClientRect().width / window_width,
    scrolling: scrolling.length,
    outside: outside.map(named), hidden, small, silent: silent.map(named), unreachable: unreachable.map(named),
  };
};

// Of a redesign: the controller recommended or, beside a state space, the best loops.
const loopsOf = ({ tuning }) => (tuning.loops ?? tuning).design;

// The designs that a report may recommend, with their gains by name and unit.
const gainsOf = {
  redesign: (json) => [loopsOf(json).gains],
  match: ({ matched }) => [matched.recommended_as_built.design.gains],
  tune: ({ tuned }) => tuned.controllers.map(({ design }) => design.gains),
};

for (const name of ["redesign", "match", "tune"]) {
  for (const width of [1920, 1400, 400]) {
    test(`${name}: nothing is cut off, too small or written over at ${width} px`, async () => {
      const { page, troubles, close } = await open(name, { viewport: { width, height: 900 } });
      const found = await page.evaluate(layout);
      assert.ok(found.overflow <= 0, `the page is ${found.overflow} px too wide`);
      for (const fault of ["outside", "small", "silent", "unreachable"]) assert.deepEqual(found[fault], [], fault);
      if (width >= 1400) {
        assert.ok(found.used > 0.95);
        assert.equal(found.scrolling, 0);
        assert.deepEqual(found.hidden, []);
      } else {
        assert.ok(found.scrolling > 0);
      }
      for (const drawing of await page.locator("svg:visible").all()) {
        assert.deepEqual(await drawing.evaluate(overlaps), [], await drawing.evaluate((svg) => svg.closest("[id]").id));
      }
      assert.deepEqual(troubles, []);
      await close();
    });
  }

  test(`${name}: the gains to load come before every figure`, async () => {
    const { page, close } = await open(name, { viewport: { width: 1400, height: 900 } });
    const gains = page.locator(".decision .gains");
    const shown = await gains.locator("tbody tr").evaluateAll((rows) => rows.map(({ cells: [gain, value] }) => [gain.textContent.replace(/^\S+ /, "").replaceAll(" ", "_"), parseFloat(value.textContent)]));
    assert.ok(shown.length >= 3);
    const same = (all) => all && Object.keys(all).length === shown.length && shown.every(([gain, value]) =>
      Object.entries(all).some(([key, exact]) => key.startsWith(gain) && Math.abs(value / exact - 1) < 1e-4));
    assert.ok(gainsOf[name](made[name].json).some(same), "gains that the report does not have");
    const end = await gains.evaluate((element) => element.getBoundingClientRect().bottom);
    assert.ok(end < await page.locator("figure").first().evaluate((figure) => figure.getBoundingClientRect().top));
    assert.ok(end < 900, "the gains are not on the first screen");
    await close();
  });

  test(`${name}: every table and figure fits on A4`, async () => {
    const { page, close } = await open(name, { viewport: { width: 680, height: 990 } }); // 180 mm between margins
    await page.emulateMedia({ media: "print" });
    const wide = await page.$$eval("table, tr > *, figure, figure .static > svg, pre", (all) =>
      all.filter((one) => one.checkVisibility() && one.getBoundingClientRect().right > 681).map((one) => one.textContent.trim().slice(0, 60)));
    assert.deepEqual(wide, []);
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 681);
    await close();
  });
}

// redesign_card_test.py compares those of redesign, with a smaller search.
test("match: the same bytes again, on one thread", () => {
  const { page, args, json } = made.match;
  const content = () => readFileSync(page, "utf8").replace(/<code>boresight [^<]* --report [^<]*<\/code>/, "");
  const first = content();
  make("match", [...args, "--threads", "1"]);
  assert.ok(first === content());
  assert.deepEqual(made.match.json, json);
});

for (const name of ["redesign", "match"]) {
  test(`${name}: one small file that refers to nothing outside`, () => {
    const html = readFileSync(made[name].page, "utf8");
    assert.ok(statSync(made[name].page).size < most);
    const markup = html.replace(/<script\b[^>]*>[\s\S]*?<\/script>/g, "");
    assert.deepEqual(markup.match(/\s(?:src|href|srcset|xlink:href|action|data)="(?!#)[^"]*"/g), null);
    assert.deepEqual(markup.match(/@import|url\(/g), null);
    assert.match(html, /Content-Security-Policy" content="default-src 'none'/);
  });

  test(`${name}: whole without scripts, every id once`, async () => {
    const { page, close } = await open(name, { javaScriptEnabled: false });
    const counts = await page.locator("figure.plot .static > svg").count();
    assert.equal(counts, made[name].json.figures.length);
    await close();
    const live = await open(name);
    const ids = await live.page.$$eval("[id]", (all) => all.map((one) => one.id));
    assert.deepEqual(ids.filter((id, i) => ids.indexOf(id) !== i), []);
    const targets = await live.page.$$eval("a[href^='#']", (all) => all.map((one) => one.getAttribute("href").slice(1)));
    assert.deepEqual(targets.filter((target) => !ids.includes(target)), []);
    const decision = await live.page.$$eval(".decision p", (all) => all.map((one) => one.textContent));
    assert.ok(decision.length >= 1 && decision.length <= 3);
    const sections = await live.page.$$eval("main > section", (all) => all.length);
    assert.equal(await live.page.locator("nav li").count(), sections);
    await live.close();
  });

  test(`${name}: every figure can be explored, and says what the JSON has`, async () => {
    const { page, troubles, close } = await open(name);
    const figures = made[name].json.figures;
    assert.ok(figures.length > 0);
    for (const figure of figures) {
      const element = page.locator(`#figure-${figure.id}`);
      await element.focus();
      await page.keyboard.press("Enter");
      await element.locator(".js-plotly-plot .main-svg").first().waitFor();
      assert.equal(await element.locator(".static").isVisible(), false, figure.id);
      const lines = await element.locator(".live").evaluate((live) =>
        live.data.filter((trace) => trace.mode?.startsWith("lines") && trace.line?.width > 0).map((trace) => trace.line.simplify));
      assert.ok(lines.every((simplify) => simplify === false));
      assert.deepEqual(await element.locator(".live").evaluate(overlaps), [], figure.id);
      // The first point that has numbers, by the arrow key.
      await page.keyboard.press("ArrowRight");
      const series = figure.panels[0].series[0];
      const i = series.x.findIndex((x, k) => x !== null && series.y[k] !== null);
      const said = await element.locator(".reading").textContent();
      for (const [axis, value] of [[figure.x, series.x[i]], [figure.panels[0].y, series.y[i]]]) {
        const shown = axis.categories?.[value] ?? (axis.unit ? `${value} ${axis.unit}` : `${value}`);
        assert.ok(said.includes(shown), `${figure.id}: ${said} has no ${shown}`);
      }
      await page.keyboard.press("Escape");
      assert.equal(await element.locator(".static").isVisible(), true, figure.id);
    }
    assert.deepEqual(troubles, []);
    await close();
  });
}

test("keys zoom and a pointer reads", async () => {
  const { page, troubles, close } = await open("redesign");
  const figure = made.redesign.json.figures.find((one) => one.panels[0].series[0].style === "line" && one.x.scale === "logarithmic");
  const element = page.locator(`#figure-${figure.id}`);
  await element.locator(".explore").click();
  const range = () => element.locator(".live").evaluate((live) => [...live._fullLayout.xaxis.range]);
  const before = await range();
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("+");
  const zoomed = await range();
  assert.ok(Math.abs((zoomed[1] - zoomed[0]) * 1.5 - (before[1] - before[0])) < 1e-9);
  await page.keyboard.press("0");
  assert.deepEqual((await range()).map((end) => end.toFixed(6)), before.map((end) => end.toFixed(6)));
  // Pointing at a static figure makes the live one.
  await page.keyboard.press("Escape");
  await element.locator(".static").hover();
  await element.locator(".js-plotly-plot").waitFor();
  const box = await element.locator(".live .nsewdrag").first().boundingBox();
  for (let part = 0.1; part < 0.9; part += 0.05) {
    await page.mouse.move(box.x + box.width * part, box.y + box.height * 0.5);
    await page.waitForTimeout(60);
  }
  assert.deepEqual(troubles, []);
  await close();
});

test("sliders give the table's values", async () => {
  const { page, troubles, close } = await open("match");
  const table = made.match.json.matched.what_if;
  const axes = [table.flywheel_disks_1, table.leakage_rates_per_s, table.friction_slopes_N_m_s_per_rad, table.wind_speeds_m_per_s];
  const place = (structure, at) => at.reduce((sum, index, axis) => sum * axes[axis].length + index, structure);
  assert.equal(table.boresight_rms_mdeg.length, axes.reduce((all, axis) => all * axis.length, table.structures.length));
  const panel = page.locator(".what-if");
  const set = async (name, value) => panel.locator(`input[name=${name}]`).fill(String(value));
  const answer = () => panel.locator(".answer").getAttribute("data-rms");
  let stable = 0;
  for (const [structure, at] of [[0, [0, 3, 1, 2]], [1, [8, 3, 1, 2]], [1, [4, 0, 0, 0]], [0, [8, 4, 5, 5]]]) {
    await panel.locator("select").selectOption({ index: structure });
    for (const [axis, name] of ["disks", "leakage", "friction", "wind"].entries()) await set(name, at[axis]);
    const entry = table.boresight_rms_mdeg[place(structure, at)];
    assert.equal(await answer(), entry === null ? "" : String(entry));
    stable += entry === null ? 0 : 1;
  }
  assert.ok(stable >= 2);
  // Between two entries: the logarithm's mean, by the keyboard.
  await panel.locator("select").selectOption({ index: 0 });
  for (const [name, value] of [["disks", 8], ["leakage", 3], ["friction", 1], ["wind", 2]]) await set(name, value);
  await panel.locator("input[name=leakage]").focus();
  for (let i = 0; i < 5; ++i) await page.keyboard.press("ArrowRight");
  const [low, high] = [place(0, [8, 3, 1, 2]), place(0, [8, 4, 1, 2])].map((entry) => table.boresight_rms_mdeg[entry]);
  assert.ok(Math.abs(Number(await answer()) / Math.sqrt(low * high) - 1) < 1e-9);
  assert.match(await panel.locator(".answer").textContent(), /interpolated/);
  assert.deepEqual(troubles, []);
  await close();
});

// What the page's own script computes, without the page.
const analysis = () => {
  const source = ["matrices", "loop_model", "loop_analysis"].map((name) => readFileSync(path.join(root, "app", "page", `${name}.js`), "utf8")).join("");
  return new Function(`${source}; return LoopAnalysis;`)();
};

test("sliders over gains begin with the report's loops", async () => {
  const { page, troubles, close } = await open("redesign");
  const panel = page.locator(".loop-sliders");
  const design = loopsOf(made.redesign.json);
  const rms = Number(await panel.locator(".answer").getAttribute("data-rms"));
  // The report's is by adaptive quadrature, the panel's on the program's frequency grid.
  assert.ok(Math.abs(rms / design.boresight_rms_mdeg - 1) < 1e-7, `${rms}, expected ${design.boresight_rms_mdeg}`);
  assert.match(await panel.locator(".verdicts").textContent(), /\u2713/);
  assert.equal(await panel.locator("tbody tr").count(), 3);
  const shell = await panel.locator(".gains-text").textContent();
  const words = [...shell.matchAll(/'([^']*)'|(\S+)/g)].map(([, quoted, bare]) => quoted ?? bare);
  assert.deepEqual([words[0], words[2]], ["--structure", "--gains"]);
  assert.equal(words.length - 3, await panel.locator("input[data-gain]").count());
  assert.deepEqual(troubles, []);
  await close();
});

test("sliders over gains, wind and drive give what their numbers make", async () => {
  const { page, troubles, close } = await open("redesign");
  const panel = page.locator(".loop-sliders");
  const data = JSON.parse(await panel.locator("script.data").textContent());
  const answer = panel.locator(".answer");
  const first = await answer.getAttribute("data-rms");
  const scaled = (value, factor) => Number((value * factor).toPrecision(4));
  const gains = data.blocks.flatMap((block) => block.gains.map(({ value }) => value));
  gains[0] = scaled(gains[0], 8 ** -0.1);
  const setting = {
    wind_speed: scaled(data.wind.mean_speed_m_per_s, 2.5 ** 0.5), oil_stiffness: scaled(data.drive.oil_stiffness_N_m_per_rad, 3 ** 0.2),
    leakage_rate: data.drive.leakage_rate_per_s, viscous_friction: data.drive.viscous_friction_N_m_s_per_rad,
  };
  for (const [slider, value] of [["data-gain='0'", "-0.1"], ["data-setting='wind_speed'", "0.5"], ["data-setting='oil_stiffness'", "0.2"]]) {
    await panel.locator(`input[${slider}]`).fill(value);
  }
  const LoopAnalysis = analysis();
  const rms = LoopAnalysis.rms(LoopAnalysis.prepare(data, setting), gains).beam * 180e3 / Math.PI;
  await page.waitForFunction((expected) => Math.abs(document.querySelector(".loop-sliders .answer").dataset.rms / expected - 1) < 1e-9, rms);
  assert.match(await panel.locator(".gains-text").textContent(), new RegExp(`=${gains[0]}(?![\\d.])`));
  // All gains at eight times the start's, and back.
  for (const slider of await panel.locator("input[data-gain]").all()) await slider.fill("1");
  await page.waitForFunction(() => document.querySelector(".loop-sliders .answer").dataset.rms === "");
  assert.match(await answer.textContent(), /unstable/);
  await panel.locator(".reset").click();
  assert.equal(await answer.getAttribute("data-rms"), first);
  assert.deepEqual(troubles, []);
  await close();
});

test("the table is the study's where they meet", () => {
  const { matched } = made.match.json;
  const table = matched.what_if;
  const leakage = table.leakage_rates_per_s.indexOf(table.start.leakage_rate_per_s);
  const friction = table.friction_slopes_N_m_s_per_rad.indexOf(table.start.friction_slope_N_m_s_per_rad);
  const wind = table.wind_speeds_m_per_s.indexOf(table.start.wind_speed_m_per_s);
  assert.ok(leakage >= 0 && friction >= 0 && wind >= 0);
  const places = matched.points.map((point) => table.flywheel_disks_1.indexOf(point.flywheel_disks_1));
  let compared = 0;
  matched.series.forEach((series, s) => {
    series.controllers.forEach(({ result }, p) => {
      const rms = result?.boresight_rms_mdeg ?? null;
      if (places[p] < 0 || rms === null) return;
      const entry = ((((s * table.flywheel_disks_1.length + places[p]) * table.leakage_rates_per_s.length + leakage) * table.friction_slopes_N_m_s_per_rad.length + friction) * table.wind_speeds_m_per_s.length) + wind;
      assert.ok(Math.abs(table.boresight_rms_mdeg[entry] / rms - 1) < 1e-4);
      assert.equal(table.states_1[entry], 2);
      ++compared;
    });
  });
  assert.ok(compared >= 16);
});

test("prints with every section and figure", async () => {
  const { page, troubles, close } = await open("redesign");
  const figure = page.locator("figure.plot").first();
  await figure.focus();
  await page.keyboard.press("Enter");
  const file = path.join(folder, "redesign.pdf");
  await page.pdf({ path: file, preferCSSPageSize: true, printBackground: true });
  const text = execFileSync("pdftotext", ["-layout", file, "-"], { encoding: "utf8", maxBuffer: 1e8 }).replace(/\s+/g, " ");
  const headings = await page.$$eval("main > section > h2", (all) => all.map((one) => one.textContent));
  for (const heading of headings) assert.ok(text.includes(heading.replace(/\s+/g, " ")), heading);
  for (const { title } of made.redesign.json.figures) assert.ok(text.includes(`${title}.`.replace(/\s+/g, " ")), title);
  assert.ok(!text.includes("Explore"));
  assert.match(execFileSync("pdfinfo", [file], { encoding: "utf8" }), /A4/);
  await page.emulateMedia({ media: "print" });
  assert.equal(await figure.locator(".static").isVisible(), true);
  assert.equal(await figure.locator(".live").isVisible(), false);
  assert.deepEqual(troubles, []);
  await close();
});
