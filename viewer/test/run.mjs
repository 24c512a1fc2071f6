// Bundles every test and runs it with Node's own runner: `node test/run.mjs [name …]`.
import { build } from "esbuild";
import { spawnSync } from "node:child_process";
import { mkdtemp, readdir, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const wanted = process.argv.slice(2);
const tests = (await readdir(here)).filter((name) => name.endsWith(".test.ts"));
const chosen = tests.filter((name) => wanted.length === 0 || wanted.includes(name.replace(".test.ts", "")));
if (chosen.length === 0)
  throw new Error(`no test named ${wanted.join(", ")}: expected some of ${tests.join(", ")}`);

const out = await mkdtemp(join(tmpdir(), "keenline-viewer-"));
await build({
  entryPoints: chosen.map((name) => join(here, name)),
  bundle: true,
  platform: "node",
  format: "cjs",
  outdir: out,
  outExtension: { ".js": ".cjs" },
  define: { VIEWER: JSON.stringify(dirname(here)) },
  alias: { "playwright-core": join(here, "../node_modules/playwright-core/index.js") },
  external: [join(here, "../node_modules/playwright-core/*")],
  logLevel: "warning",
});
const files = chosen.map((name) => join(out, name.replace(".ts", ".cjs")));
const only = process.env.ONLY ? [`--test-name-pattern=${process.env.ONLY}`] : [];
// What the tests and their browser leave behind goes with the rest.
const env = { ...process.env, TMPDIR: out };
const { status } = spawnSync(process.execPath, ["--test", ...only, ...files], { stdio: "inherit", env });
await rm(out, { recursive: true, maxRetries: 5 }); // a browser may still be closing
process.exitCode = status ?? 1;
