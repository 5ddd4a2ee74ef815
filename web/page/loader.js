// Unpacks what `pack` has compressed, and starts the page: its body with its style, the glue of the engine, the script,
// and the engine itself.

/** Decodes characters of seven bits each to bytes; `pack` writes them. */
function decoded(text) {
  const bytes = new Uint8Array(Math.floor((text.length * 7) / 8));
  let [rest, bits, end] = [0, 0, 0];
  for (let k = 0; k < text.length; k += 1) {
    rest = ((rest << 7) | (text.charCodeAt(k) & 127)) & 0xffff;
    bits += 7;
    if (bits >= 8) bytes[end++] = rest >> (bits -= 8);
  }
  return bytes;
}

/**
 * Decompresses a raw LZMA stream with lc = 1, lp = 0 and pb = 0 to `size` bytes. The format is that of the LZMA
 * specification of the 7-zip project: a range coder with adaptive bits, whose contexts lie one after the other in
 * `chances`.
 */
function decompressed(data, size) {
  const out = new Uint8Array(size);
  // Contexts, each from its first index: twelve states for six kinds of bits, distances, lengths, literals.
  const [MATCH, REPEAT, FIRST, SECOND, THIRD, LONG, SLOT, DISTANCE, ALIGN, LENGTH, AGAIN, LITERAL] =
    [0, 12, 24, 36, 48, 60, 72, 328, 443, 459, 733, 1007];
  const chances = new Uint16Array(LITERAL + 2 * 0x300).fill(1024);
  // The first byte is zero.
  let [range, code, at] = [2 ** 32 - 1, 0, 5];
  for (let k = 1; k < 5; k += 1) code = code * 256 + data[k];

  const refill = () => {
    if (range >= 2 ** 24) return;
    range *= 256;
    code = code * 256 + data[at++];
  };
  const bit = (k) => {
    const chance = chances[k];
    const bound = (range >>> 11) * chance;
    const one = code >= bound ? 1 : 0;
    chances[k] = one ? chance - (chance >> 5) : chance + ((2048 - chance) >> 5);
    range = one ? range - bound : bound;
    if (one) code -= bound;
    refill();
    return one;
  };
  const number = (from, bits) => {
    let node = 1;
    for (let k = 0; k < bits; k += 1) node = 2 * node + bit(from + node);
    return node - 2 ** bits;
  };
  const reversed = (from, bits) => {
    let [node, value] = [1, 0];
    for (let k = 0; k < bits; k += 1) {
      const next = bit(from + node);
      node = 2 * node + next;
      value += next << k;
    }
    return value;
  };
  const even = (bits) => {
    let value = 0;
    for (let k = 0; k < bits; k += 1) {
      range >>>= 1;
      value *= 2;
      if (code >= range) {
        code -= range;
        value += 1;
      }
      refill();
    }
    return value;
  };
  const length = (from) => {
    if (!bit(from)) return 2 + number(from + 2, 3);
    return bit(from + 1) ? 18 + number(from + 18, 8) : 10 + number(from + 10, 3);
  };
  const distance = (count) => {
    const slot = number(SLOT + 64 * Math.min(count - 2, 3), 6);
    if (slot < 4) return slot;
    const bits = (slot >> 1) - 1;
    const base = (2 + (slot & 1)) * 2 ** bits;
    if (slot < 14) return base + reversed(DISTANCE + base - slot, bits);
    return base + even(bits - 4) * 16 + reversed(ALIGN, 4);
  };

  let [state, end, last] = [0, 0, [0, 0, 0, 0]];
  while (end < size) {
    if (!bit(MATCH + state)) {
      const from = LITERAL + 0x300 * (end ? out[end - 1] >> 7 : 0);
      let letter = 1;
      // After a match, the byte that would have continued it selects the contexts as long as its bits agree.
      for (let known = state < 7 ? -1 : out[end - last[0] - 1]; known >= 0 && letter < 256;) {
        const expected = (known >> 7) & 1;
        const next = bit(from + 256 * (1 + expected) + letter);
        letter = 2 * letter + next;
        known = next === expected ? (known << 1) & 255 : -1;
      }
      while (letter < 256) letter = 2 * letter + bit(from + letter);
      out[end++] = letter;
      state = state < 4 ? 0 : state - (state < 10 ? 3 : 6);
      continue;
    }
    let count;
    if (!bit(REPEAT + state)) {
      count = length(LENGTH);
      last = [distance(count), ...last.slice(0, 3)];
      state = state < 7 ? 7 : 10;
    } else {
      let which = 0;
      let single = false;
      if (!bit(FIRST + state)) single = !bit(LONG + state);
      else if (!bit(SECOND + state)) which = 1;
      else which = 2 + bit(THIRD + state);
      last.unshift(...last.splice(which, 1));
      count = single ? 1 : length(AGAIN);
      state = (single ? 9 : 8) + (state < 7 ? 0 : single ? 2 : 3);
    }
    for (; count > 0; count -= 1, end += 1) out[end] = out[end - last[0] - 1];
  }
  return out;
}

/** Adds a script to the page, which runs it. */
function run(type, textContent) {
  document.body.append(Object.assign(document.createElement("script"), { type, textContent }));
}

try {
  const { textContent, dataset } = document.getElementById("packed");
  const ends = dataset.ends.split(" ").map(Number);
  const bytes = decompressed(decoded(textContent), ends.at(-1));
  const parts = ends.map((end, k) => bytes.slice(ends[k - 1] ?? 0, end));
  const [body, glue, script] = parts.splice(0, 3).map((part) => new TextDecoder().decode(part));
  globalThis.unpacked = { glue, parts };
  document.body.insertAdjacentHTML("afterbegin", body);
  run("", glue);
  run("module", script);
} catch (error) {
  document.body.append(`This browser cannot run the page: ${error.message}`);
}
