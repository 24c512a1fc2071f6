import type { Facts, BufferFacts } from "./facts";

/** A table column as it was embedded; `components` numbers a row. */
export type Numbers = Uint8Array | Uint16Array | Uint32Array;

/** Columns by name. */
export type Columns = Map<string, Numbers>;

/** Reads and removes the two elements that the program wrote into the page. */
export async function readEmbedded(document: Document): Promise<{ facts: Facts; columns: Columns }> {
  const factsElement = document.getElementById("keenline-facts");
  const dataElement = document.getElementById("keenline-data");
  if (!factsElement || !dataElement) throw new Error("This page holds no result.");
  const facts = JSON.parse(factsElement.textContent ?? "") as Facts;
  if (facts.format !== "keenline report" || facts.version !== 1) {
    throw new Error("The result in this page is of a version that it cannot read.");
  }
  const compressed = bytesFromBase64(dataElement.textContent ?? "");
  dataElement.remove(); // as large as all the rest together
  return { facts, columns: decodeColumns(facts.buffers, await inflate(compressed)) };
}

/** In pieces: no second copy of the whole as a string. White space around it is allowed. */
export function bytesFromBase64(text: string): Uint8Array<ArrayBuffer> {
  const trimmed = text.trim();
  const padding = trimmed.endsWith("==") ? 2 : trimmed.endsWith("=") ? 1 : 0;
  const bytes = new Uint8Array((trimmed.length / 4) * 3 - padding);
  const piece = 1 << 20; // a multiple of 4 letters
  for (let from = 0, to = 0; from < trimmed.length; from += piece) {
    const letters = atob(trimmed.slice(from, from + piece));
    for (let i = 0; i < letters.length; ++i) bytes[to++] = letters.charCodeAt(i);
  }
  return bytes;
}

export async function inflate(zlib: Uint8Array<ArrayBuffer>): Promise<Uint8Array> {
  const stream = new Blob([zlib]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

export function decodeColumns(buffers: BufferFacts[], bytes: Uint8Array): Columns {
  return new Map(buffers.map((buffer) => [buffer.name, decodeColumn(buffer, bytes)]));
}

const arrayTypes = { uint8: Uint8Array, uint16: Uint16Array, uint32: Uint32Array };

function decodeColumn(facts: BufferFacts, stream: Uint8Array): Numbers {
  const { name, count, components, coding } = facts;
  const ArrayType = arrayTypes[facts.type];
  const size = ArrayType.BYTES_PER_ELEMENT;
  const bytes = stream.subarray(facts.offset, facts.offset + facts.bytes);
  if (bytes.length !== count * components * size) throw new Error(`The data of “${name}” are not whole.`);
  if (coding === "raw") return new ArrayType(new Uint8Array(bytes).buffer);

  const rows = new ArrayType(count * components);
  for (let c = 0; c < components; ++c) {
    const planes = bytes.subarray(c * count * size, (c + 1) * count * size);
    let value = 0;
    for (let i = 0; i < count; ++i) {
      let word = 0;
      for (let b = 0; b < size; ++b) word |= planes[b * count + i] << (8 * b);
      // Sums wrap around in the width of the column.
      value = coding === "delta" ? (value + unfolded(word)) | 0 : word;
      rows[i * components + c] = value;
    }
  }
  return rows;
}

/** 0, 1, 2, 3 … as 0, -1, 1, -2 … */
export function unfolded(word: number): number {
  return (word >>> 1) ^ -(word & 1);
}
