// The engine's module, which `pack` has taken apart into streams of like bytes.

/** Puts the module together from its streams; `Streams` of `pack` has them in this order. */
export function joined(parts) {
  const [sections, code, types, locals, calls, loads, stores, integers, floats] = parts.map((bytes) => ({ bytes, at: 0 }));
  const module = [];
  const copy = (stream, count) => {
    for (let k = 0; k < count; k += 1) module.push(stream.bytes[stream.at++]);
  };
  const number = (stream) => {
    let value = 0;
    for (let shift = 0; ; shift += 7) {
      const byte = stream.bytes[stream.at++];
      module.push(byte);
      value |= (byte & 127) << shift;
      if (byte < 128) return value;
    }
  };
  /** Puts the length of all that `write` writes before it, in five bytes. */
  const measured = (write) => {
    const start = module.push(0, 0, 0, 0, 0);
    write();
    const length = module.length - start;
    for (let k = 0; k < 5; k += 1) module[start - 5 + k] = ((length >> (7 * k)) & 127) + (k < 4 ? 128 : 0);
  };
  const operands = (instruction) => {
    const many = (count) => { for (let k = 0; k < count; k += 1) number(code); };
    if (instruction < 5) number(types);
    else if (instruction === 0x0e) many(number(code) + 1);
    else if (instruction === 0x10) number(calls);
    else if (instruction === 0x11) many(2);
    else if (instruction >= 0x20 && instruction <= 0x22) number(locals);
    else if (instruction >= 0x28 && instruction <= 0x3e) {
      number(code);
      number(instruction < 0x36 ? loads : stores);
    } else if (instruction === 0x41) number(integers);
    else if (instruction === 0x43) copy(floats, 4);
    else if (instruction === 0x44) copy(floats, 8);
    else if (instruction === 0xfc) many([2, 1, 2, 1, 2, 1, 2, 1, 1, 1][number(code) - 8] ?? 0);
    else if ([0x0c, 0x0d, 0x23, 0x24, 0x25, 0x26, 0x3f, 0x40, 0x42, 0xd0].includes(instruction)) number(code);
  };
  const body = () => {
    for (let kinds = number(code); kinds > 0; kinds -= 1) {
      number(code);
      copy(code, 1);
    }
    for (let depth = 1; depth > 0;) {
      const instruction = code.bytes[code.at];
      copy(code, 1);
      if (instruction >= 2 && instruction <= 4) depth += 1;
      if (instruction === 0x0b) depth -= 1;
      if (instruction > 1) operands(instruction);
    }
  };
  copy(sections, 8);
  while (sections.at < sections.bytes.length) {
    const kind = sections.bytes[sections.at];
    copy(sections, 1);
    if (kind === 10) measured(() => { for (let count = number(sections); count > 0; count -= 1) measured(body); });
    else copy(sections, number(sections));
  }
  return Uint8Array.from(module).buffer;
}
