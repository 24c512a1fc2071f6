import { deflateSync } from "node:zlib";
import type { BufferFacts, Facts } from "../src/facts";
import type { Numbers } from "../src/data";

/** A column to embed. */
export interface Column {
  name: string;
  values: Numbers;
  components?: number;
  coding?: BufferFacts["coding"];
}

/** What docs/report-format.md says, straightforwardly: the other half of src/data.ts. */
export function encodeColumns(columns: Column[]): { buffers: BufferFacts[]; bytes: Buffer } {
  const buffers: BufferFacts[] = [];
  const parts: Buffer[] = [];
  let offset = 0;
  for (const { name, values, components = 1, coding = "raw" } of columns) {
    const size = values.BYTES_PER_ELEMENT as 1 | 2 | 4;
    const type = `uint${8 * size}` as BufferFacts["type"];
    const part =
      coding === "raw"
        ? Buffer.from(values.buffer, values.byteOffset, values.byteLength)
        : planes(values, components, coding);
    buffers.push({
      name,
      type,
      components,
      count: values.length / components,
      coding,
      offset,
      bytes: part.length,
    });
    parts.push(part);
    offset += part.length;
  }
  return { buffers, bytes: Buffer.concat(parts) };
}

function planes(values: Numbers, components: number, coding: "planes" | "delta"): Buffer {
  const size = values.BYTES_PER_ELEMENT;
  const bits = BigInt(8 * size);
  const bytes: number[] = [];
  for (let c = 0; c < components; ++c) {
    const words = [...values].filter((_, i) => i % components === c).map(BigInt);
    const coded =
      coding === "planes"
        ? words
        : words.map((word, i) => folded(word - (i === 0 ? 0n : words[i - 1]), bits));
    for (let b = 0; b < size; ++b)
      for (const word of coded) bytes.push(Number((word >> BigInt(8 * b)) & 255n));
  }
  return Buffer.from(bytes);
}

function folded(difference: bigint, bits: bigint): bigint {
  const wrapped = BigInt.asIntN(Number(bits), difference);
  return BigInt.asUintN(Number(bits), (wrapped << 1n) ^ (wrapped >> (bits - 1n)));
}

/** The page with a result in it, as the program writes it. */
export function embed(page: string, facts: Omit<Facts, "buffers">, columns: Column[]): string {
  const { buffers, bytes } = encodeColumns(columns);
  const escapes: Record<string, string> = { "<": "\\u003c", ">": "\\u003e", "&": "\\u0026" };
  const json = JSON.stringify({ ...facts, buffers }).replace(/[<>&]/g, (letter) => escapes[letter]);
  const data =
    `<script type="application/json" id="keenline-facts">${json}</script>\n` +
    `<script type="text/plain" id="keenline-data">${deflateSync(bytes).toString("base64")}</script>`;
  return page.replace("<!-- keenline report data -->", () => data);
}
