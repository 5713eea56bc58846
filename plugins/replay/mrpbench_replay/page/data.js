// Reads what `packing.py` wrote: differences, zigzag coded, bytes of equal weight side by side, deflated, base64.

const TYPES = { Uint8Array, Int16Array, Int32Array };

/** The arrays in the script element `id`, by name: `values`, `shape`, `scale`, `offset`. Frees the element's text. */
export async function readArrays(id) {
  const element = document.getElementById(id);
  if (!element) return {};
  const layout = JSON.parse(element.dataset.layout);
  const bytes = await inflate(element.textContent);
  element.remove();
  return Object.fromEntries(Object.entries(layout).map(([name, entry]) => [name, unpack(bytes, entry)]));
}

async function inflate(text) {
  const letters = atob(text);
  const packed = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; i++) packed[i] = letters.charCodeAt(i);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function unpack(bytes, { at, shape, order, width, type, scale, offset }) {
  const count = shape.reduce((left, right) => left * right, 1);
  const columns = shape.at(-1);
  const values = new TYPES[type](count);
  for (let start = 0; start < count; start += columns) {
    let value = 0;
    let slope = 0;
    for (let i = start; i < start + columns; i++) {
      let code = 0;
      for (let plane = width - 1; plane >= 0; plane--) code = (code << 8) | bytes[at + plane * count + i];
      const step = (code >>> 1) ^ -(code & 1);
      if (order === 0) value = step;
      else if (order === 1) value = (value + step) | 0;
      else {
        slope = (slope + step) | 0;
        value = (value + slope) | 0;
      }
      values[i] = value;
    }
  }
  return { values, shape, scale, offset };
}

/** The real numbers of a packed array. */
export function decoded({ values, scale, offset }) {
  return Float64Array.from(values, (value) => offset + scale * value);
}

/** Index of the last of the ascending `values`, from `first` to before `end`, that is not above `wanted`; else `first` - 1. */
export function lastAtMost(values, wanted, first = 0, end = values.length) {
  let low = first;
  let high = end;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (values[middle] <= wanted) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}
