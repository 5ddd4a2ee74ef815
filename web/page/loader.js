// Unpacks what `pack` has compressed, and starts the page: the glue of the engine, the script, and the engine itself.

/** Decodes five characters to four bytes; `pack` writes them. The last group may be shorter. */
function decoded(text) {
  const bytes = new Uint8Array(Math.floor((text.length * 4) / 5));
  for (let k = 0; k * 5 < text.length; k += 1) {
    let group = 0;
    for (let j = 0; j < 5; j += 1) {
      // The codes pass over the less-than sign and the backslash.
      const code = text.charCodeAt(5 * k + j);
      group = group * 85 + (Number.isNaN(code) ? 84 : code - 35 - (code > 60) - (code > 92));
    }
    for (let j = 0; j < 4; j += 1) bytes[4 * k + j] = Math.floor(group / 2 ** (24 - 8 * j)) % 256;
  }
  return bytes;
}

/** Adds a script to the page, which runs it. */
function run(type, text) {
  const script = document.createElement("script");
  document.body.append(Object.assign(script, { type, textContent: text }));
}

try {
  const { textContent, dataset } = document.getElementById("packed");
  const stream = new Blob([decoded(textContent)]).stream().pipeThrough(new DecompressionStream("gzip"));
  const bytes = await new Response(stream).arrayBuffer();
  const ends = dataset.ends.split(" ").map(Number);
  const [glue, script] = [bytes.slice(0, ends[0]), bytes.slice(...ends)].map((part) => new TextDecoder().decode(part));
  globalThis.unpacked = { glue, module: bytes.slice(ends[1]) };
  run("", glue);
  run("module", script);
} catch (error) {
  document.getElementById("status").textContent =
    `This browser cannot run the page, which needs DecompressionStream: ${error.message}`;
}
