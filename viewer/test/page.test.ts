import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import type { Browser, Download, Page } from "playwright-core";
import { launch, layerCounts, openPage, pagePath, pixelsLike, sharpCount, temporaryFile } from "./browser";
import { embed, type Column } from "./encode";
import { creaseColumns, factsOf } from "./fixture";

const orange: [number, number, number] = [213, 94, 0];
const side = 21;

let browser: Browser;
let template: string;
let crease: string; // a page

before(async () => {
  browser = await launch();
  template = await readFile(pagePath, "utf8");
  crease = await temporaryFile("crease.html", creasePage({}));
});
after(() => browser.close());

function creasePage(changes: Partial<ReturnType<typeof factsOf>>): string {
  const { columns, points } = creaseColumns(side);
  const facts = { ...factsOf(points), ...changes };
  const counts: Record<string, number> = { edge: side, flat: points - side };
  facts.kinds = facts.kinds.map((kind) => ({ ...kind, count: counts[kind.name] ?? 0 }));
  return embed(template, facts, columns);
}

async function setSigma(page: Page, sigma: number): Promise<void> {
  await page.fill("#sigma-exact", `${sigma}`);
  await page.press("#sigma-exact", "Enter");
}

async function saved(page: Page, button: string): Promise<{ name: string; bytes: Buffer }> {
  const [download]: [Download, void] = await Promise.all([
    page.waitForEvent("download"),
    page.$eval(button, (b) => (b as HTMLElement).click()),
  ]);
  return { name: download.suggestedFilename(), bytes: await readFile(await download.path()) };
}

test("opens from the disk without a complaint and without a request, and shows the cloud", async () => {
  const { page, errors, requests } = await openPage(browser, crease);
  assert.equal(await page.title(), "fixture.ply – keenline");
  assert.equal(await sharpCount(page), side);
  assert.ok((await pixelsLike(page, orange)) > 300);
  assert.deepEqual(errors, []);
  assert.deepEqual(requests, []);
});

test("moving the slider labels anew, and the labels as detected come back", async () => {
  const { page } = await openPage(browser, crease);
  const seen = await pixelsLike(page, orange);
  await setSigma(page, 70);
  assert.equal(await sharpCount(page), 0);
  assert.equal((await layerCounts(page)).edge, 0);
  assert.ok((await pixelsLike(page, orange)) < seen / 4);
  await page.click("#sigma-back");
  assert.equal(await sharpCount(page), side);
  await page.focus("#sigma-slider");
  await page.keyboard.press("End");
  assert.equal(await sharpCount(page), 0);
  assert.equal(await page.textContent("#sigma"), "σ 90°");
});

test("a layer that is off is not drawn", async () => {
  const { page } = await openPage(browser, crease);
  const seen = await pixelsLike(page, orange);
  await page.uncheck(".layers li:nth-child(3) input");
  assert.ok((await pixelsLike(page, orange)) < seen / 4);
  await page.click("text=Only sharp points");
  assert.ok((await pixelsLike(page, orange)) > seen / 2);
  assert.equal(await page.isChecked(".layers li:nth-child(1) input"), false);
});

test("the keyboard alone reaches and moves everything", async () => {
  const { page } = await openPage(browser, crease);
  await page.focus("#canvas");
  const before = await page.locator("#canvas").screenshot();
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("+");
  await page.waitForTimeout(400);
  assert.ok(!before.equals(await page.locator("#canvas").screenshot()));
  const reached = new Set<string>();
  for (let i = 0; i < 45; ++i) {
    await page.keyboard.press("Tab");
    reached.add(
      await page.evaluate(() => document.activeElement?.id || document.activeElement?.textContent || ""),
    );
  }
  for (const id of ["fit", "measure", "sigma-slider", "sigma-exact", "point-number"])
    assert.ok(reached.has(id), id);
  await page.focus(".layers input");
  await page.keyboard.press("Space");
  assert.equal(await page.isChecked(".layers input"), false);
});

test("a link restores the view", async () => {
  const { page } = await openPage(browser, crease);
  await page.focus("#canvas");
  for (const key of ["ArrowLeft", "ArrowUp", "+", "Shift+ArrowRight"]) await page.keyboard.press(key);
  await setSigma(page, 33);
  await page.selectOption("#coloring select", "directions");
  await page.uncheck(".layers li:nth-child(2) input");
  await page.fill("#point-number", "5");
  await page.press("#point-number", "Enter");
  await page.click("#link");
  const hash = new URL(page.url()).hash;
  const { page: again, errors } = await openPage(browser, crease, {}, hash);
  assert.equal(await again.textContent("#sigma"), "σ 33°");
  assert.equal(await again.inputValue("#coloring select"), "directions");
  assert.equal(await again.isChecked(".layers li:nth-child(2) input"), false);
  assert.match((await again.textContent("#point-told"))!, /^Point 5:/);
  await again.click("#link");
  assert.equal(new URL(again.url()).hash, hash);
  assert.deepEqual(errors, []);
});

test("links that make no sense are passed over", async () => {
  const hash = "#view=1,2,3,NaN,5,6&sigma=-4&color=constructor&point=99999999&hidden=a,b&lines=<img>";
  const { page, errors } = await openPage(browser, crease, {}, hash);
  assert.equal(await sharpCount(page), side);
  assert.ok((await pixelsLike(page, orange)) > 300);
  assert.deepEqual(errors, []);
});

test("a click chooses the point under it, and shows its Gauss map", async () => {
  const { page } = await openPage(browser, crease);
  await clickMiddle(page);
  assert.match((await page.textContent("#point-told"))!, /^Point \d+: (flat|edge)$/);
  assert.match((await page.textContent("#cluster-count"))!, /^\d+ clusters? of at least \d+ of \d+ lines$/);
  await page.focus("#canvas");
  await page.keyboard.press("Escape");
  assert.match((await page.textContent("#point-told"))!, /^Click a point/);
});

/** From above, where one of the two planes fills the stage. */
async function clickMiddle(page: Page, right = 0, down = 0): Promise<void> {
  await page.click("[aria-label='From above']");
  const box = (await page.locator("#canvas").boundingBox())!;
  await page.mouse.click(box.x + box.width / 2 + right, box.y + box.height / 2 + down);
}

test("measures between two points of the cloud", async () => {
  const { page } = await openPage(browser, crease);
  await page.click("#measure");
  await clickMiddle(page);
  await clickMiddle(page, 90, 30);
  const words = (await page.textContent("#told"))!;
  const [distance, x, y, z] = words.match(/-?[\d.]+(e[-+]\d+)?/g)!.map(Number);
  assert.ok(distance > 0, words);
  assert.ok(Math.abs(distance - Math.hypot(x, y, z)) < 1e-3 * distance, words);
  const apart = 100 / 1024; // of the grid that the points lie on
  for (const d of [x, y, z]) assert.ok(Math.abs(d / apart - Math.round(d / apart)) < 0.01, words);
  await page.waitForSelector("#measured:visible");
  assert.equal(await page.textContent("#measured"), `${distance}`);
});

test("labels and pictures are saved", async () => {
  const { page } = await openPage(browser, crease);
  await setSigma(page, 70);
  const csv = await saved(page, "#save-csv");
  assert.equal(csv.name, "fixture-labels.csv");
  const rows = csv.bytes.toString().trim().split("\n");
  assert.equal(rows[0], "x,y,z,feature,kind,clusters");
  assert.equal(rows.length - 1, side * (2 * side - 1));
  assert.ok(rows.slice(1).every((row) => row.endsWith(",0,0,1")));
  const ply = await saved(page, "#save-ply");
  const header = ply.bytes.subarray(0, ply.bytes.indexOf("end_header\n") + 11);
  assert.equal(ply.bytes.length - header.length, 27 * side * (2 * side - 1));
  const png = await saved(page, "#picture");
  assert.equal(png.name, "fixture.png");
  assert.deepEqual([...png.bytes.subarray(0, 8)], [137, 80, 78, 71, 13, 10, 26, 10]);
  assert.ok(png.bytes.length > 5000, "the picture is not empty");
});

test("what a file contains is text and nothing else", async () => {
  const evil = "<img src=x onerror=window.caught=1></script><script>window.caught=1</script>";
  const changes = {
    title: evil,
    input: { ...factsOf(1).input, name: evil, path: evil, format: evil, encoding: evil },
    notes: [evil],
    options: { ...factsOf(1).options, [evil]: evil },
    program: evil,
  };
  const path = await temporaryFile("<img src=x onerror=window.caught=1>.html", creasePage(changes));
  const { page, errors, requests } = await openPage(browser, path);
  assert.equal(await page.textContent("#title"), evil);
  assert.equal(await page.locator("img").count(), 0);
  assert.equal(await page.evaluate(() => "caught" in window), false);
  assert.deepEqual(errors, []);
  assert.deepEqual(requests, []);
  const csv = await saved(page, "#save-csv");
  assert.match(csv.name, /^[\w.-]+$/);
});

test("the policy stops what is not the page's own script", async () => {
  const { page } = await openPage(browser, crease);
  const ran = await page.evaluate(async () => {
    const script = document.createElement("script");
    script.textContent = "window.caught = 1";
    document.body.append(script);
    await new Promise((resolve) => setTimeout(resolve, 50));
    return "caught" in window;
  });
  assert.equal(ran, false);
});

const degenerate: Record<string, number[]> = {
  "no point": [],
  "one point": [7, 7, 7],
  "two points in one place": [7, 7, 7, 7, 7, 7],
};
for (const [name, position] of Object.entries(degenerate)) {
  test(`a cloud of ${name} gives a page`, async () => {
    const count = position.length / 3;
    const columns: Column[] = [
      { name: "position", values: Uint32Array.from(position), components: 3, coding: "delta" },
      { name: "kind", values: new Uint8Array(count).fill(255) },
    ];
    const facts = { ...factsOf(count), spacing: 0 };
    const path = await temporaryFile("degenerate.html", embed(template, facts, columns));
    const { page, errors } = await openPage(browser, path);
    assert.equal(await page.getAttribute("body", "data-ready"), "yes");
    await clickMiddle(page);
    assert.match((await page.textContent("#point-told"))!, count === 0 ? /^Click/ : /^Point [01]: undecided/);
    assert.deepEqual(errors, []);
  });
}

test("a damaged page says so", async () => {
  const damaged = creasePage({}).replace(/(id="keenline-data">).{400}/, "$1");
  const { page } = await openPage(browser, await temporaryFile("damaged.html", damaged));
  assert.equal(await page.getAttribute("body", "data-ready"), "failed");
  assert.notEqual(await page.textContent("#summary"), "");
});

test("without WebGL everything but the cloud is there", async () => {
  const plain = await launch(["--disable-3d-apis"]);
  try {
    const { page } = await openPage(plain, crease);
    assert.match((await page.textContent("#absent"))!, /WebGL/);
    assert.equal(await page.isVisible("#absent"), true);
    await setSigma(page, 70);
    assert.equal(await sharpCount(page), 0);
    assert.match((await page.textContent("#facts"))!, /fixture\.ply/);
  } finally {
    await plain.close();
  }
});

test("on a phone nothing is wider than the screen, and a touch chooses a point", async () => {
  const { page, errors } = await openPage(browser, crease, {
    viewport: { width: 375, height: 700 },
    hasTouch: true,
    isMobile: true,
  });
  assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 375);
  await page.tap("[aria-label='From above']");
  const box = (await page.locator("#canvas").boundingBox())!;
  await page.touchscreen.tap(box.x + box.width / 2, box.y + box.height / 2);
  assert.match((await page.textContent("#point-told"))!, /^Point/);
  await setSigma(page, 70);
  assert.equal(await sharpCount(page), 0);
  assert.deepEqual(errors, []);
});

test("dark where the system is dark", async () => {
  const { page } = await openPage(browser, crease, { colorScheme: "dark" });
  assert.ok((await pixelsLike(page, [16, 19, 22])) > 100000);
});

test("nothing is drawn while nothing changes", async () => {
  const { page } = await openPage(browser, crease);
  await page.waitForTimeout(500);
  const frames = await page.evaluate(async () => {
    let count = 0;
    const original = window.requestAnimationFrame.bind(window);
    window.requestAnimationFrame = (callback) => (++count, original(callback));
    await new Promise((resolve) => setTimeout(resolve, 400));
    return count;
  });
  assert.equal(frames, 0);
});
