// Reads the format of report/viewer/page_data.cpp, and the same without compression.

type Numbers = Uint8Array | Uint16Array | Uint32Array | Float32Array | Float64Array;

interface Header<About> {
  arrays: { name: string; type: "u8" | "u16" | "u32" | "f32" | "f64"; count: number }[];
  about: About;
}

/** An array that is not there; the message is its name. */
export class MissingArray extends Error {}

export class PageData<About> {
  constructor(
    readonly about: About,
    private readonly arrays: Map<string, Numbers>,
  ) {}

  get<Kind extends Numbers>(name: string, kind: new (length: number) => Kind): Kind {
    const values = this.arrays.get(name);
    if (!(values instanceof kind)) throw new MissingArray(name);
    return values;
  }

  has(name: string): boolean {
    return this.arrays.has(name);
  }

  /** The arrays "name_key" by their keys. */
  group<Group>(name: string): Group {
    const found = [...this.arrays].filter(([key]) => key.startsWith(`${name}_`));
    return Object.fromEntries(found.map(([key, values]) => [key.slice(name.length + 1), values])) as Group;
  }
}

const kinds = { u8: Uint8Array, u16: Uint16Array, u32: Uint32Array, f32: Float32Array, f64: Float64Array };

function fromBase64(text: string): Uint8Array<ArrayBuffer> {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let k = 0; k < bytes.length; ++k) bytes[k] = binary.charCodeAt(k);
  return bytes;
}

async function inflate(bytes: Uint8Array<ArrayBuffer>): Promise<Uint8Array> {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** An array is stored in byte planes: the lowest byte of every element, then the next byte. */
function joinPlanes(bytes: Uint8Array, count: number, width: number): ArrayBuffer {
  const out = new Uint8Array(count * width);
  for (let plane = 0; plane < width; ++plane)
    for (let k = 0, from = plane * count; k < count; ++k) out[k * width + plane] = bytes[from + k];
  return out.buffer;
}

function read<About>(
  bytes: Uint8Array,
  toBuffer: (bytes: Uint8Array, count: number, width: number) => ArrayBuffer,
): PageData<About> {
  const size = new DataView(bytes.buffer, bytes.byteOffset).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + size))) as Header<About>;
  const arrays = new Map<string, Numbers>();
  let at = 4 + size;
  for (const { name, type, count } of header.arrays) {
    const kind = kinds[type];
    const length = count * kind.BYTES_PER_ELEMENT;
    arrays.set(name, new kind(toBuffer(bytes.subarray(at, at + length), count, kind.BYTES_PER_ELEMENT)));
    at += length;
  }
  return new PageData(header.about, arrays);
}

export async function readPageData<About>(base64: string): Promise<PageData<About>> {
  return read(await inflate(fromBase64(base64)), joinPlanes);
}

/** Data from a server: the header and the arrays as they are. */
export function readFrame<About>(bytes: ArrayBuffer): PageData<About> {
  return read(new Uint8Array(bytes), (part) => part.slice().buffer as ArrayBuffer);
}
