// Makes the reports that docs/report.md and docs/cards.md show, takes their pictures and writes the text of the cards
// (./dev screenshots).
//
//   node report_screenshots.mjs PROGRAM ROOT
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";

const [program, root] = process.argv.slice(2);
const { chromium } = createRequire(path.join(root, "web", "package.json"))("playwright-core");
const folder = mkdtempSync(path.join(tmpdir(), "boresight-report-"));
const browser = await chromium.launch({
  executablePath: "/usr/bin/chromium",
  args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync"],
});

const picture_of = (name) => path.join(root, "docs", "figures", `${name}.png`);

// The card of each case that docs/cards.md names, as picture and, below the command, as text.
const cards = async () => {
  const file = path.join(root, "docs", "cards.md");
  let text = readFileSync(file, "utf8");
  for (const [shown, command, picture] of text.matchAll(/^ {4}boresight (redesign \S+)\n\n!\[[^\]]*\]\(figures\/(card-[\w-]+)\.png\)\n(?:\n| {6}.*\n)*/gm)) {
    const report = path.join(folder, "card.html");
    const printed = execFileSync(program, [...command.split(" "), "--report", report], { cwd: root, encoding: "utf8", stdio: ["ignore", "pipe", "ignore"] });
    const lines = printed.split("\n\n")[1].split("\n").map((line) => `    ${line}\n`).join("");
    const head = shown.match(/^.*\n\n.*\n/)[0];
    text = text.replace(shown, () => `${head}\n${lines}\n`);
    const page = await browser.newPage({ viewport: { width: 1400, height: 860 } });
    await page.goto(`file://${report}`);
    await page.locator(".decision").screenshot({ path: picture_of(picture) });
    await page.close();
  }
  writeFileSync(file, text.trimEnd() + "\n");
};

const shoot = async (name, args, prepare) => {
  const file = path.join(folder, `${name}.html`);
  execFileSync(program, [...args, "--report", file], { cwd: root, stdio: ["ignore", "ignore", "inherit"] });
  const page = await browser.newPage({ viewport: { width: 1400, height: 860 } });
  await page.goto(`file://${file}`);
  const picture = (of) => picture_of(`report-${of}`);
  await prepare(page, picture);
  await page.screenshot({ path: picture(name) });
  await page.close();
};

try {
  await cards();
  await shoot("redesign", ["redesign", "cases/dss14-70m/campaign.toml"], async (page, picture) => {
    const start = await page.locator(".loop-sliders .answer").getAttribute("data-rms");
    await page.locator("input[data-gain='0']").fill("-0.2");
    await page.locator("input[data-setting='wind_speed']").fill("0.3");
    await page.waitForFunction((before) => document.querySelector(".loop-sliders .answer").dataset.rms !== before, start);
    await page.setViewportSize({ width: 1100, height: 1100 });
    await page.locator(".loop-sliders").screenshot({ path: picture("gains") });
    await page.setViewportSize({ width: 1100, height: 860 });
    await page.locator(".loop-sliders .reset").click();
    await page.evaluate(() => scrollTo(0, 0));
  });
  await shoot("match", ["match", "cases/dss14-70m/case.toml"], async (page) => {
    await page.locator(".what-if select").selectOption({ index: 0 });
    await page.locator(".what-if").evaluate((panel) => panel.closest("section").scrollIntoView());
  });
} finally {
  await browser.close();
  rmSync(folder, { recursive: true });
}
