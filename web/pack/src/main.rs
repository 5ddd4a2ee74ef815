//! Assembles the page: `pack WASM PAGE OUT` reads the module that cargo has built and the folder with the sources of
//! the page, and writes one HTML file that loads no other.

mod module;

use std::fs;
use std::io::Write;
use std::path::Path;

use anyhow::{Context, Result, bail};
use lzma_rust2::{LzmaOptions, LzmaWriter};
use wasm_bindgen_cli_support::Bindgen;

use module::Streams;

/// Maximum size of the page.
const MAX_BYTES: usize = 750_000;

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [wasm, page, out] = &arguments[..] else { bail!("found {arguments:?}, expected WASM PAGE OUT") };
    let mut bindgen = Bindgen::new();
    bindgen.input_path(wasm).no_modules(true)?.typescript(false).remove_name_section(true);
    let mut bound = bindgen.generate_output()?;
    let module = bound.wasm_mut().emit_wasm();
    let page = Path::new(page);
    let read = |name: &str| fs::read_to_string(page.join(name)).with_context(|| format!("cannot read {name}"));
    // Spaces at the beginning of a line are nothing to HTML without preformatted text.
    let style = code(&read("style.css")?).replace(" {", "{");
    let body = format!("<style>\n{style}</style>\n{}", code(&read("body.html")?));
    let (glue, script) = (code(bound.js()), modules(&read)?);
    let streams = Streams::split(&module)?;
    let parts = [&[body.as_bytes(), glue.as_bytes(), script.as_bytes()], &streams.ordered()[..]].concat();
    let packed = compressed(&parts.concat())?;
    let mut end = 0;
    let ends = parts.iter().map(|part| {
        end += part.len();
        end.to_string()
    });
    let ends: Vec<String> = ends.collect();
    let (ends, text) = (ends.join(" "), encoded(&packed));

    let mut html = code(&read("index.html")?);
    let mut fill = |mark: &str, text: &str| {
        let place = format!("<!-- {mark} -->");
        if html.matches(&place).count() != 1 {
            bail!("found {place} in index.html not once, expected it once");
        }
        html = html.replace(&place, text);
        Ok(())
    };
    fill("packed", &format!("<script type=\"text/plain\" id=\"packed\" data-ends=\"{ends}\">{text}</script>"))?;
    // The loader is not compressed; its texts have no such signs.
    let loader = code(&read("loader.js")?).replace(", ", ",").replace(" = ", "=").replace(" + ", "+");
    fill("loader", &format!("<script type=\"module\">\n{loader}</script>"))?;

    if html.len() > MAX_BYTES {
        bail!("the page has {} bytes, expected at most {MAX_BYTES}", html.len());
    }
    fs::write(out, &html).with_context(|| format!("cannot write {out}"))?;
    let (html, module, packed) = (html.len(), module.len(), packed.len());
    println!("{out}: {html} bytes, with the engine of {module} bytes, compressed with the scripts to {packed}");
    Ok(())
}

/// Compresses by LZMA, without a header; the function `decompressed` of the page knows the properties.
fn compressed(bytes: &[u8]) -> Result<Vec<u8>> {
    let nice_len = LzmaOptions::NICE_LEN_MAX;
    let options = LzmaOptions { lc: 1, lp: 0, pb: 0, nice_len, ..LzmaOptions::with_preset(9) };
    let mut writer = LzmaWriter::new_no_header(Vec::new(), &options, false)?;
    writer.write_all(bytes)?;
    Ok(writer.finish()?)
}

/// Writes seven bits as one character: its code modulo 128. The characters that the text of a script cannot hold, zero,
/// carriage return and the less-than sign, are moved up by 256. The function `decoded` of the page reads them.
fn encoded(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(bytes.len() / 7 * 8 + 8);
    for group in bytes.chunks(7) {
        let mut whole = [0; 8];
        whole[1..=group.len()].copy_from_slice(group);
        let number = u64::from_be_bytes(whole);
        for k in 0..=group.len() {
            let code = (number >> (49 - 7 * k) & 127) as u8;
            let is_held = !matches!(code, 0 | b'\r' | b'<');
            text.extend(char::from_u32(u32::from(code) + if is_held { 0 } else { 256 }));
        }
    }
    text
}

/// Joins the modules of the page, in the order of the imports of `main.js`, and `main.js` itself. No two modules may
/// define the same name.
fn modules(read: &impl Fn(&str) -> Result<String>) -> Result<String> {
    let main = read("main.js")?;
    let imported = main.lines().filter(|line| line.starts_with("import "));
    let mut whole = String::new();
    for line in imported {
        let name = line.split("\"./").nth(1).and_then(|rest| rest.strip_suffix("\";"));
        whole += &read(name.with_context(|| format!("found {line}, expected import … from \"./NAME\";"))?)?;
    }
    whole += &main;
    Ok(code(&whole))
}

/// Returns the lines of code of a script or a style sheet, without imports, indents and comments that have lines of
/// their own.
fn code(script: &str) -> String {
    let mut in_comment = false;
    let is_code = |line: &&str| {
        let text = line.trim_start();
        let is_comment = in_comment || text.starts_with("/*") || text.starts_with("//");
        in_comment = is_comment && !text.starts_with("//") && !text.contains("*/");
        !is_comment && !line.starts_with("import ")
    };
    let lines = script.lines().filter(is_code).filter(|line| !line.trim().is_empty());
    lines.flat_map(|line| [line.trim_start().trim_start_matches("export "), "\n"]).collect()
}

#[cfg(test)]
mod tests {
    use super::encoded;

    /// The inverse of `encoded`, as the page has it.
    fn decoded(text: &str) -> Vec<u8> {
        let (mut bytes, mut rest, mut bits) = (Vec::new(), 0, 0);
        for letter in text.chars() {
            rest = (rest << 7 | u32::from(letter) & 127) & 0xffff;
            bits += 7;
            if bits >= 8 {
                bits -= 8;
                bytes.push((rest >> bits) as u8);
            }
        }
        bytes
    }

    #[test]
    fn decoding_inverts_encoding() {
        let bytes: Vec<u8> =
            (0..4000u32).map(|k| (k.wrapping_mul(2_654_435_761) >> 13) as u8).chain([255; 9]).collect();
        for length in [0, 1, 2, 3, 4, 5, 6, 7, 8, 255, bytes.len()] {
            for part in [&bytes[..length], &bytes[bytes.len() - length..]] {
                let text = encoded(part);
                assert!(!text.contains(['<', '\r', '\0']), "{text}");
                assert_eq!(decoded(&text), part);
            }
        }
    }
}
