//! The module taken apart into streams of like bytes, which compress better by a ninth: the instructions, the indices
//! of local variables, the offsets of loads, and so on. The function `joined` of the page puts it together again.

use anyhow::{Context, Result, bail, ensure};

/// Streams of a module; [`Streams::split`] fills them.
#[derive(Default)]
pub struct Streams {
    /// All sections but that of the code, of which only the number of functions is left.
    sections: Vec<u8>,
    /// Kinds of local variables, instructions and their operands, if these have no stream of their own.
    code: Vec<u8>,
    /// Types of blocks.
    types: Vec<u8>,
    /// Indices of local variables.
    locals: Vec<u8>,
    /// Indices of called functions.
    calls: Vec<u8>,
    /// Offsets of loads.
    loads: Vec<u8>,
    /// Offsets of stores.
    stores: Vec<u8>,
    /// Constants of 32 bits.
    integers: Vec<u8>,
    /// Constants of floating point.
    floats: Vec<u8>,
}

/// Unread bytes of a module.
struct Input<'a>(&'a [u8]);

impl<'a> Input<'a> {
    /// Returns the next `count` bytes.
    fn bytes(&mut self, count: usize) -> Result<&'a [u8]> {
        let (bytes, rest) = self.0.split_at_checked(count).context("the module ends within a section")?;
        self.0 = rest;
        Ok(bytes)
    }

    /// Returns a number in the format LEB128 and its bytes. A number beyond 32 bits is a constant, of which only the
    /// bytes are used.
    fn number(&mut self) -> Result<(usize, &'a [u8])> {
        let count = self.0.iter().position(|byte| byte & 0x80 == 0).context("the module ends within a number")? + 1;
        let bytes = self.bytes(count)?;
        let digits = bytes.iter().take(5).rev();
        Ok((digits.fold(0, |number, byte| number << 7 | usize::from(byte & 0x7f)), bytes))
    }

    /// Moves a number to a stream and returns it.
    fn number_to(&mut self, stream: &mut Vec<u8>) -> Result<usize> {
        let (number, bytes) = self.number()?;
        stream.extend(bytes);
        Ok(number)
    }
}

impl Streams {
    /// Takes a module apart.
    ///
    /// # Errors
    ///
    /// Fails if the module uses an instruction beyond the second version of WebAssembly, or one of its vectors.
    pub fn split(module: &[u8]) -> Result<Self> {
        let (mut streams, mut input) = (Streams::default(), Input(module));
        streams.sections.extend(input.bytes(8)?);
        while !input.0.is_empty() {
            let kind = input.bytes(1)?;
            let (length, length_bytes) = input.number()?;
            let mut section = Input(input.bytes(length)?);
            streams.sections.extend(kind);
            if kind == [10] {
                let functions = section.number_to(&mut streams.sections)?;
                for _ in 0..functions {
                    streams.function(&mut section)?;
                }
                ensure!(section.0.is_empty(), "found bytes after the last function");
            } else {
                streams.sections.extend([length_bytes, section.0].concat());
            }
        }
        Ok(streams)
    }

    /// Takes a function apart. Its length follows from its last instruction.
    fn function(&mut self, section: &mut Input) -> Result<()> {
        let length = section.number()?.0;
        let mut input = Input(section.bytes(length)?);
        for _ in 0..input.number_to(&mut self.code)? {
            input.number_to(&mut self.code)?;
            self.code.extend(input.bytes(1)?);
        }
        let mut depth = 1;
        while depth > 0 {
            let instruction = input.bytes(1)?[0];
            self.code.push(instruction);
            let (operands, stream) = match instruction {
                0x02..=0x04 => {
                    depth += 1;
                    (1, &mut self.types)
                }
                0x0b => {
                    depth -= 1;
                    continue;
                }
                0x0c | 0x0d | 0x23..=0x26 | 0x3f | 0x40 | 0x42 | 0xd0 => (1, &mut self.code),
                0x0e => (input.number_to(&mut self.code)? + 1, &mut self.code),
                0x10 => (1, &mut self.calls),
                0x11 => (2, &mut self.code),
                0x20..=0x22 => (1, &mut self.locals),
                0x28..=0x3e => {
                    input.number_to(&mut self.code)?;
                    (1, if instruction < 0x36 { &mut self.loads } else { &mut self.stores })
                }
                0x41 => (1, &mut self.integers),
                0x43 | 0x44 => {
                    self.floats.extend(input.bytes(if instruction == 0x43 { 4 } else { 8 })?);
                    continue;
                }
                0xfc => match input.number_to(&mut self.code)? {
                    0..=7 => continue,
                    8 | 10 | 12 | 14 => (2, &mut self.code),
                    9 | 11 | 13 | 15..=17 => (1, &mut self.code),
                    other => bail!("found the instruction 0xfc {other}, which `Streams::split` does not know"),
                },
                0x00 | 0x01 | 0x05 | 0x0f | 0x1a | 0x1b | 0x45..=0xc4 | 0xd1 => continue,
                other => bail!("found the instruction {other:#04x}, which `Streams::split` does not know"),
            };
            for _ in 0..operands {
                input.number_to(stream)?;
            }
        }
        ensure!(input.0.is_empty(), "found bytes after the end of a function");
        Ok(())
    }

    /// Returns the streams in the order in which the page reads them.
    pub fn ordered(&self) -> [&[u8]; 9] {
        let Self { sections, code, types, locals, calls, loads, stores, integers, floats } = self;
        [sections, code, types, locals, calls, loads, stores, integers, floats]
    }
}
