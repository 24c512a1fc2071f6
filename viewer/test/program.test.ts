import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { promisify } from "node:util";
import type { Browser, Page } from "playwright-core";
import { launch, layerCounts, openPage, program, sharpCount } from "./browser";

// What the page shows of the program's own reports must be what the program itself says. Needs KEENLINE.
const skip = program ? false : "KEENLINE names no program";
const sigmas = [0.5, 5, 12.34, 20, 33.3, 45, 61.07, 89.9];

let folder: string;
let browser: Browser;

async function keenline(...words: string[]): Promise<Record<string, unknown>> {
  const { stdout } = await promisify(execFile)(program!, [...words, "--json", "--quiet"], { cwd: folder });
  return JSON.parse(stdout) as Record<string, unknown>;
}

before(async () => {
  if (skip) return;
  folder = await mkdtemp(join(tmpdir(), "keenline-program-"));
  await keenline("synth", "fandisk", "--points", "6000", "--noise", "0.03h", "-o", "cloud.ply");
  await keenline("detect", "cloud.ply", "--spectrum", "-o", "labels.ply");
  await keenline("lines", "cloud.ply", "-o", "lines.json", "--report", "report.html");
  browser = await launch();
});
after(async () => {
  if (skip) return;
  await browser.close();
  await rm(folder, { recursive: true });
});

async function setSigma(page: Page, sigma: number): Promise<void> {
  await page.fill("#sigma-exact", `${sigma}`);
  await page.press("#sigma-exact", "Enter");
}

async function compareCounts(report: string): Promise<void> {
  const { page, errors, requests } = await openPage(browser, join(folder, report));
  for (const sigma of sigmas) {
    await setSigma(page, sigma);
    const told = await keenline("relabel", "labels.ply", "--sigma", `${sigma}`, "-o", "again.ply");
    assert.equal(await sharpCount(page), told.feature_points, `σ ${sigma}`);
    const { lines: _, ...kinds } = await layerCounts(page);
    assert.deepEqual(kinds, told.counts, `σ ${sigma}`);
  }
  assert.deepEqual(errors, []);
  assert.deepEqual(requests, []);
}

test("counts at any sigma are exactly those of relabel", { skip }, () => compareCounts("report.html"));

test("of a thinned cloud too", { skip }, async () => {
  await keenline("detect", "cloud.ply", "--report", "thinned.html", "--report-points", "1500");
  await compareCounts("thinned.html");
});

test("every point of the page is labelled as relabel does", { skip }, async () => {
  const { page } = await openPage(browser, join(folder, "report.html"));
  for (const sigma of [5, 61.07]) {
    await setSigma(page, sigma);
    await keenline("relabel", "labels.ply", "--sigma", `${sigma}`, "-o", "again.csv");
    const expected = columnsOf(await readFile(join(folder, "again.csv"), "utf8"), ["kind", "clusters"]);
    const saving = page.waitForEvent("download");
    await page.$eval("#save-csv", (button) => (button as HTMLElement).click());
    const text = await readFile(await (await saving).path(), "utf8");
    assert.deepEqual(columnsOf(text, ["kind", "clusters"]), expected);
  }
});

function columnsOf(csv: string, names: string[]): string[] {
  const [head, ...rows] = csv
    .trim()
    .split("\n")
    .map((row) => row.trim().split(","));
  const places = names.map((name) => head.indexOf(name));
  assert.ok(!places.includes(-1), `columns of ${head.join(",")}`);
  return rows.map((row) => places.map((place) => row[place]).join(","));
}

test("the clusters of a point are the program's, clicked or by number", { skip }, async () => {
  const { page } = await openPage(browser, join(folder, "report.html"));
  const sigma = 20;
  await setSigma(page, sigma);
  // With --plain the number of significant clusters is the label.
  const options = (await keenline("detect", "cloud.ply", "-o", "own.ply")).options as Record<string, unknown>;
  const same = ["neighbors", "min-sine", "triangles"].flatMap((name) => [`--${name}`, `${options[name]}`]);
  await keenline("detect", "cloud.ply", "--plain", "--sigma", `${sigma}`, ...same, "-o", "plain.csv");
  const clusters = columnsOf(await readFile(join(folder, "plain.csv"), "utf8"), ["clusters"]).map(Number);
  const shown = async () => Number.parseInt((await page.textContent("#cluster-count"))!);

  for (let point = 0; point < 6000; point += 61) {
    await page.fill("#point-number", `${point}`);
    await page.press("#point-number", "Enter");
    assert.equal(await shown(), clusters[point], `point ${point}`);
  }
  const box = (await page.locator("#canvas").boundingBox())!;
  for (const [right, down] of [
    [0, 0],
    [-60, 40],
    [80, 10],
    [-120, 60],
  ]) {
    await page.mouse.click(box.x + box.width / 2 + right, box.y + box.height / 2 + down);
    const point = Number((await page.textContent("#point-told"))!.match(/[\d,]+/)![0].replace(",", ""));
    assert.equal(await shown(), clusters[point], `point ${point}`);
  }
});

test("the table holds the lines of the drawing; they can be sorted, found and saved", { skip }, async () => {
  const drawing = JSON.parse(await readFile(join(folder, "lines.json"), "utf8")) as {
    polylines: { length: number }[];
  };
  const { page } = await openPage(browser, join(folder, "report.html"));
  const lengths = () =>
    page.$$eval("#lines tbody tr", (rows) => rows.map((row) => Number(row.children[1].textContent)));
  const falling = drawing.polylines.map(({ length }) => Number(length.toPrecision(4))).sort((a, b) => b - a);
  assert.deepEqual(await lengths(), falling);
  await page.click("#lines th:nth-child(2) button");
  assert.deepEqual(await lengths(), [...falling].reverse());
  assert.equal(await page.getAttribute("#lines th:nth-child(2)", "aria-sort"), "ascending");

  const before = await page.locator("#canvas").screenshot();
  await page.click("#lines tbody tr:nth-child(2) button");
  assert.equal(await page.locator("#lines tr.chosen").count(), 1);
  await page.waitForTimeout(400);
  assert.ok(!before.equals(await page.locator("#canvas").screenshot()));

  const saving = page.waitForEvent("download");
  await page.$eval("#save-json", (button) => (button as HTMLElement).click());
  assert.deepEqual(JSON.parse(await readFile(await (await saving).path(), "utf8")), drawing);
});

test("the facts are the program's", { skip }, async () => {
  const told = await keenline("detect", "cloud.ply", "-o", "own.ply");
  const { page } = await openPage(browser, join(folder, "report.html"));
  const facts = (await page.textContent("#facts"))!;
  assert.ok(facts.includes("cloud.ply") && facts.includes("6,000"));
  assert.ok(facts.includes(`${Number((told.spacing as number).toPrecision(4))}`));
  assert.ok(facts.includes(`neighbors${(told.options as Record<string, number>).neighbors}`));
});
