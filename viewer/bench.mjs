// What a report costs a browser that renders in software: `node bench.mjs REPORT.html`. Linux only.
import { readdirSync, readFileSync, statSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const path = process.argv[2];
if (!path) throw new Error("usage: node bench.mjs REPORT.html");

/** Resident memory, in bytes, of the processes below one that draw and run pages. */
function pageMemory(root) {
  const processes = new Map();
  for (const pid of readdirSync("/proc").filter((name) => /^\d+$/.test(name))) {
    try {
      const status = readFileSync(`/proc/${pid}/status`, "utf8");
      const number = (name) => Number(status.match(new RegExp(`^${name}:\\s+(\\d+)`, "m"))?.[1] ?? 0);
      const command = readFileSync(`/proc/${pid}/cmdline`, "utf8");
      processes.set(Number(pid), { parent: number("PPid"), bytes: 1024 * number("VmRSS"), command });
    } catch (error) {
      if (!["ENOENT", "ESRCH"].includes(error.code)) throw error; // it has ended meanwhile
    }
  }
  const isBelow = (pid) => {
    for (let at = processes.get(pid); at; at = processes.get(at.parent)) if (at.parent === root) return true;
    return false;
  };
  return [...processes]
    .filter(([pid, { command }]) => /--type=(renderer|gpu-process)/.test(command) && isBelow(pid))
    .reduce((sum, [, { bytes }]) => sum + bytes, 0);
}

const server = await chromium.launchServer({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"],
});
const browser = await chromium.connect(server.wsEndpoint());
const page = await browser.newPage({ viewport: { width: 1200, height: 800 } });
const start = performance.now();
const seconds = () => ((performance.now() - start) / 1000).toFixed(1);
await page.goto(pathToFileURL(resolve(path)).href);
await page.waitForSelector("body[data-ready]");
const ready = seconds();
await page.screenshot(); // waits for the frame
const drawn = seconds();
const slider = page.locator("#sensitivity input[type=range]");
let step = "no sensitivity";
if ((await slider.count()) > 0) {
  const before = performance.now();
  for (let i = 0; i < 10; ++i) await slider.press("ArrowRight");
  await page.screenshot();
  step = `${((performance.now() - before) / 10).toFixed(0)} ms a step of the slider`;
}
const megabytes = (bytes) => (bytes / 1e6).toFixed(1);
console.log(
  `${megabytes(statSync(path).size)} MB; ready after ${ready} s, first picture after ${drawn} s; ${step}; ` +
    `${megabytes(pageMemory(server.process().pid))} MB of memory`,
);
await browser.close();
await server.close();
