// Bundles the page into one file that needs nothing else: dist/report.html, or `node build.mjs --out DIR`.
import { build } from "esbuild";
import { createHash } from "node:crypto";
import { mkdir, readFile, writeFile } from "node:fs/promises";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const outOption = process.argv.indexOf("--out");
const out = outOption > 0 ? process.argv[outOption + 1] : join(here, "dist");

const common = { bundle: true, minify: true, write: false, legalComments: "eof", charset: "utf8" };
const [script, style] = await Promise.all([
  build({ ...common, entryPoints: [join(here, "src/main.ts")], format: "iife", target: "es2022" }),
  build({ ...common, entryPoints: [join(here, "src/style.css")] }),
]);

// What the policy lets run are these very bytes. No "</script" may end them early.
const scriptText = script.outputFiles[0].text.replaceAll("</script", "<\\/script");
const styleText = style.outputFiles[0].text;
const hash = (text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;
const policy = [
  "default-src 'none'",
  `script-src ${hash(scriptText)}`,
  `style-src ${hash(styleText)}`,
  "img-src data: blob:",
  "base-uri 'none'",
  "form-action 'none'",
].join("; ");

const parts = { POLICY: policy, STYLE: styleText, SCRIPT: scriptText };
const page = (await readFile(join(here, "src/page.html"), "utf8")).replace(
  /@(POLICY|STYLE|SCRIPT)@/g,
  (_, name) => parts[name],
);
const marker = "<!-- keenline report data -->";
if (page.split(marker).length !== 2) throw new Error(`expected ${marker} once in the page`);
await mkdir(out, { recursive: true });
await writeFile(join(out, "report.html"), page);
