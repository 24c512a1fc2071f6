import { existsSync } from "node:fs";
import { mkdtemp, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium, type Browser, type BrowserContextOptions, type Page } from "playwright-core";

declare const VIEWER: string; // the folder of package.json, put in when tests are bundled

/** The page without a result: what is built, or what KEENLINE_PAGE names. */
export const pagePath = process.env.KEENLINE_PAGE ?? join(VIEWER, "dist/report.html");
export const program = process.env.KEENLINE && resolve(process.env.KEENLINE);

const chromiumPath =
  process.env.CHROMIUM ?? ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find(existsSync);

export function launch(more: string[] = []): Promise<Browser> {
  if (!chromiumPath) throw new Error("no chromium: install Debian's, or name one in CHROMIUM");
  // Software rendering everywhere; no sandbox, because containers have none to offer.
  const args = [
    "--no-sandbox",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
  ];
  return chromium.launch({ executablePath: chromiumPath, args: [...args, ...more] });
}

export interface OpenPage {
  page: Page;
  errors: string[]; // what the console and the page complained of
  requests: string[]; // other than the page itself
}

/** Opens a file as a person does, from the disk, and waits until it is drawn. */
export async function openPage(
  browser: Browser,
  path: string,
  options: BrowserContextOptions = {},
  hash = "",
): Promise<OpenPage> {
  const context = await browser.newContext({ viewport: { width: 1100, height: 760 }, ...options });
  const page = await context.newPage();
  const errors: string[] = [];
  const requests: string[] = [];
  const address = pathToFileURL(path).href + hash;
  page.on("console", (message) => {
    // The driver of software rendering comments on reading pixels back.
    if (
      message.type() === "error" ||
      (message.type() === "warning" && !message.text().includes("GL Driver Message"))
    )
      errors.push(message.text());
  });
  page.on("pageerror", (error) => errors.push(error.message));
  page.on("request", (request) => {
    if (request.url() !== address && !request.url().startsWith("blob:")) requests.push(request.url());
  });
  await page.goto(address);
  await page.waitForSelector("body[data-ready]");
  return { page, errors, requests };
}

export async function temporaryFile(name: string, text: string): Promise<string> {
  const folder = await mkdtemp(join(tmpdir(), "keenline-page-"));
  const path = join(folder, name);
  await writeFile(path, text);
  return path;
}

/** What the page says of its labels: "1,062 sharp points" as 1062. */
export async function sharpCount(page: Page): Promise<number> {
  return Number((await page.textContent("#sharp-count"))!.replace(/[^0-9]/g, ""));
}

/** Counts of the layers by name. */
export async function layerCounts(page: Page): Promise<Record<string, number>> {
  const rows = await page.$$eval(".layers label", (labels) =>
    labels.map((l) => [l.children[2].textContent, l.children[3].textContent]),
  );
  return Object.fromEntries(rows.map(([name, count]) => [name, Number(count!.replace(/,/g, ""))]));
}

/** How many pixels of the stage have about this colour. */
export async function pixelsLike(page: Page, color: [number, number, number]): Promise<number> {
  await page.waitForTimeout(250); // for the frame that is due
  const shot = (await page.locator("#stage").screenshot()).toString("base64");
  return page.evaluate(
    async ([address, [red, green, blue]]) => {
      const image = new Image();
      image.src = address;
      await image.decode();
      const canvas = document.createElement("canvas");
      [canvas.width, canvas.height] = [image.width, image.height];
      const context = canvas.getContext("2d")!;
      context.drawImage(image, 0, 0);
      const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
      let count = 0;
      for (let i = 0; i < data.length; i += 4) {
        const away = Math.abs(data[i] - red) + Math.abs(data[i + 1] - green) + Math.abs(data[i + 2] - blue);
        if (away < 90) ++count;
      }
      return count;
    },
    [`data:image/png;base64,${shot}`, color] as const,
  );
}
