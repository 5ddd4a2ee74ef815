//! Assembles the page: `pack WASM PAGE OUT` reads the module that cargo has built and the folder with the sources of
//! the page, and writes one HTML file that loads no other.

use std::fs;
use std::io::Write;
use std::path::Path;

use anyhow::{Context, Result, bail};
use base64::{Engine, engine::general_purpose::STANDARD};
use flate2::{Compression, write::GzEncoder};
use wasm_bindgen_cli_support::Bindgen;

/// Maximum size of the page.
const MAX_BYTES: usize = 750_000;

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [wasm, page, out] = &arguments[..] else { bail!("found {arguments:?}, expected WASM PAGE OUT") };
    let mut bindgen = Bindgen::new();
    bindgen.input_path(wasm).no_modules(true)?.typescript(false).remove_name_section(true);
    let mut bound = bindgen.generate_output()?;
    let module = bound.wasm_mut().emit_wasm();
    let mut packed = GzEncoder::new(Vec::new(), Compression::best());
    packed.write_all(&module)?;
    let packed = packed.finish()?;

    let page = Path::new(page);
    let read = |name: &str| fs::read_to_string(page.join(name)).with_context(|| format!("cannot read {name}"));
    let mut html = read("index.html")?;
    let mut fill = |mark: &str, text: &str| {
        let place = format!("<!-- {mark} -->");
        if html.matches(&place).count() != 1 {
            bail!("found {place} in index.html not once, expected it once");
        }
        html = html.replace(&place, text);
        Ok(())
    };
    fill("style", &format!("<style>\n{}</style>", read("style.css")?))?;
    fill("glue", &format!("<script id=\"glue\">\n{}</script>", bound.js()))?;
    fill("engine", &format!("<script type=\"text/plain\" id=\"engine\">{}</script>", STANDARD.encode(&packed)))?;
    fill("script", &format!("<script type=\"module\">\n{}</script>", modules(&read)?))?;

    if html.len() > MAX_BYTES {
        bail!("the page has {} bytes, expected at most {MAX_BYTES}", html.len());
    }
    fs::write(out, &html).with_context(|| format!("cannot write {out}"))?;
    let (html, module, packed) = (html.len(), module.len(), packed.len());
    println!("{out}: {html} bytes, with the engine of {module} bytes, compressed to {packed}");
    Ok(())
}

/// Joins the modules of the page, in the order of the imports of `main.js`, and `main.js` itself. No two of them may
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
    let lines = whole.lines().filter(|line| !line.starts_with("import "));
    Ok(lines.flat_map(|line| [line.strip_prefix("export ").unwrap_or(line), "\n"]).collect())
}
