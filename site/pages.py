"""What `make site` adds to the pages of docs/: first steps from the README, the help of each command, the schema, the
examples, the library's front page, pictures with their commands, the catalogue of hard cases, and the page of the
classroom."""

import html
import json
import re
import subprocess
import tempfile
from pathlib import Path

from mkdocs.structure.files import File

ROOT = Path(__file__).parent.parent
# Files of the repository that pages link to.
FILES = ["examples/*.csv", "examples/*.toml", "python/examples/*.py", "CITATION.cff", "LICENSE-*", "crates/plot/src/draw/font/LICENSE"]
COMMAND = ROOT / "target/debug/dalembert"
KATEX = ROOT / "web/test/node_modules/katex/dist"
FORMULA = re.compile(r'(?s)<(span|div) class="arithmatex">\\([(\[])(.*?)\\[)\]]</\1>')
COMMANDS = "solve sample plot reference explain cost compare sweep regimes orbits figures check scenes cite".split()
GALLERY = {
    "A periodic rod": "plot doyen-ern-piperno -o periodic.svg",
    "Damping": "plot figure-4-r01 figure-4-r03 --quantity stress,h -o damping.svg",
    "Restitution": "plot figure-4-r01 figure-4-r02 figure-4-r03 --quantity restitution -o restitution.svg",
    "A landing without speed": "plot mu-1-period-36 --quantity xt --to 36 -o tangential.svg",
    "Velocity along the rod": "plot paper-strong --quantity xt --field velocity -o velocity.svg",
    "Rays that multiply": "plot mu-3-2-chaotic --quantity xt --to 40 -o rays.svg",
    "Motions that repeat themselves": "orbits first-nonsmooth-mode --finest 30 -o backbone.svg",
    "A fixed top": "plot getfem-dynamic-contact -o fixed.svg",
    "A real rod": "plot steel-bar -o steel.svg",
    "When and whether a rod bounces": "regimes -o regimes.svg",
}


def run(arguments, **options):
    return subprocess.run([COMMAND, *arguments.split()], check=True, capture_output=True, text=True, **options).stdout


def commands():
    """The help of every command, as it is printed."""
    helps = (f"## {name}\n\n```text\n{run(f'{name} --help')}```\n" for name in COMMANDS)
    return "# Commands\n\n`dalembert help COMMAND` prints the same.\n\n" + "\n".join(helps)


def examples():
    parts = []
    for path in sorted((ROOT / "examples").glob("*.rs")):
        parts.append(f"## {path.stem}\n\n`cargo run --example {path.stem}`\n\n```rust\n{path.read_text()}```\n")
    return "# Examples in Rust\n\n" + "\n".join(parts)


def rust():
    """The front page of the crate's documentation, without its links."""
    lines = (ROOT / "src/lib.rs").read_text().splitlines()
    text = "\n".join(line[4:] for line in lines if line.startswith("//!")).replace("```\nuse ", "```rust\nuse ")
    text = re.sub(r"\[(`[^`]+`)\](?!\()", r"\1", re.sub(r"(?m)^# Ok.*\n", "", text))
    add = "```sh\ncargo add dalembert --path ../dalembert\n```"
    last = "`cargo doc --open` in a clone shows every item, with its source and accuracy."
    return f"# The library for Rust\n\n{add}\n\n{text}\n\n{last}\n"


def gallery(files, config):
    parts = ["# Gallery", "Each picture is drawn by the command below it when this site is built."]
    with tempfile.TemporaryDirectory() as folder:
        for title, line in GALLERY.items():
            run(line, cwd=folder)
            name = line.split()[-1]
            files.append(File.generated(config, f"gallery/{name}", content=(Path(folder) / name).read_text()))
            parts.append(f"## {title}\n\n![{title}](gallery/{name})\n\n```sh\ndalembert {line}\n```")
    return "\n\n".join(parts) + "\n"


def colour(strain, most):
    """Blue in compression, red in tension, white without strain."""
    share = max(-1.0, min(1.0, strain / most))
    ends = (33, 102, 172) if share < 0 else (178, 24, 43)
    return "#" + "".join(f"{round(247 + (end - 247) * abs(share)):02x}" for end in ends)


def rod():
    """One period of the bar of Doyen, Ern and Piperno as an animated SVG, from values of the program."""
    period = "--times 0..16/3:129 --points 0..10:11 --side right"
    table = json.loads(run(f"reference doyen-ern-piperno {period} --format json"))
    names = [column["name"] for column in table["columns"]]
    rows = [dict(zip(names, row)) for row in table["rows"]]
    frames = [rows[k : k + 11] for k in range(0, len(rows), 11)]
    most = max(abs(row["strain"]) for row in rows)
    height = lambda row: 16.0 - (row["x"] + row["u"])
    animate = '<animate attributeName="{}" dur="8s" repeatCount="indefinite" values="{}"/>'
    parts = []
    for k in range(10):
        pairs = [(frame[k], frame[k + 1]) for frame in frames]
        tops = ";".join(f"{height(upper):.3f}" for _, upper in pairs)
        sizes = ";".join(f"{height(lower) - height(upper) + 0.02:.3f}" for lower, upper in pairs)
        fills = ";".join(colour((lower["strain"] + upper["strain"]) / 2, most) for lower, upper in pairs)
        moving = [("y", tops), ("height", sizes), ("fill", fills)]
        body = "".join(animate.format(name, values) for name, values in moving)
        first = " ".join(f'{name}="{values.split(";")[0]}"' for name, values in moving)
        parts.append(f'<rect x="4" width="2" {first}>{body}</rect>')
    ground = '<rect x="0" y="16" width="10" height="0.6" fill="#888"/>'
    return (
        '<svg viewBox="0 0 10 17" style="max-height: 20rem; width: 100%" role="img" '
        f'aria-label="An elastic bar bounces on the ground">{ground}{"".join(parts)}</svg>'
    )


def on_files(files, config):
    readme = (ROOT / "README.md").read_text().replace("](docs/", "](").replace("# dalembert", "# First steps", 1)
    readme = re.sub(r"(?m)^# Ok::.*\n", "", readme)
    pages = {
        "index.md": (ROOT / "site/index.md").read_text().replace("<!-- rod -->", rod()),
        "start.md": readme,
        "commands.md": commands(),
        "examples.md": examples(),
        "gallery.md": gallery(files, config),
        "python.md": (ROOT / "python/README.md").read_text() + "\n## Reference\n\n::: dalembert\n",
        "check.md": run("check --format markdown"),
        "rust.md": rust(),
        "schema.md": f"# JSON schema\n\n`dalembert schema` prints it.\n\n```json\n{run('schema')}```\n",
        "changes.md": (ROOT / "CHANGELOG.md").read_text(),
    }
    for name, text in pages.items():
        files.append(File.generated(config, name, content=text))
    kept = {f"files/{path.name}": path for pattern in FILES for path in ROOT.glob(pattern)}
    kept |= {"live.html": ROOT / "target/page/dalembert.html", "assets/search.js": ROOT / "site/search.js"}
    kept |= {"assets/site.css": ROOT / "site/site.css", "assets/katex.css": KATEX / "katex.min.css"}
    kept |= {f"assets/fonts/{path.name}": path for path in KATEX.glob("fonts/*.woff2")}
    for name, path in kept.items():
        files.append(File.generated(config, name, content=path.read_bytes()))
    return files


def on_page_markdown(markdown, page, **_):
    """Links to files of the repository lead to pages of the site, or to the files in it."""
    if page.file.src_uri == "page.md":
        title, rest = markdown.split("\n", 1)
        markdown = (
            f'{title}\n\n[The page by itself](live.html), which you may also save.\n'
            '\n<iframe src="live.html" title="The page" style="width: 100%; height: 48rem; border: 0"></iframe>\n'
            f'{rest}'
        )
    here = "../" if page.file.src_uri.startswith("guide/") else ""
    for link, target in [
        (r"examples/(\w+)\.rs", r"examples.md#\1"),
        (r"examples", "examples.md"),
        (r"python/README\.md", "python.md"),
        (r"CHANGELOG\.md", "changes.md"),
        (r"(?:[\w-]+/)*([\w-]+\.(?:py|csv|toml|cff)|LICENSE[\w-]*)", r"files/\1"),
    ]:
        markdown = re.sub(rf"\]\((?:\.\./)*{link}\)", rf"]({here}{target})", markdown)
    markdown = re.sub(r"\]\((?:\.\./)+README\.md\)", f"]({here}start.md)", markdown)
    return re.sub(r"\[([^\]]*)\]\((?:\.\./)*CONTRIBUTING\.md\)", r"`\1`", markdown)


def with_formulas(content):
    """Returns a page with its formulas drawn, so that readers need neither script nor net. The search skips them."""
    found = [[html.unescape(text).strip(), bracket == "["] for _, bracket, text in FORMULA.findall(content)]
    node = ["node", ROOT / "site/formulas.mjs"]
    done = subprocess.run(node, check=True, stdout=subprocess.PIPE, input=json.dumps(found), text=True)
    drawn = iter(json.loads(done.stdout))
    content = FORMULA.sub(lambda match: f"<{match[1]} data-search-exclude>{next(drawn)}</{match[1]}>", content)
    assert "arithmatex" not in content, "a formula is left: see with_formulas"
    return content


def with_copied_commands(found):
    """Returns a block of commands and outputs whose button copies the commands alone."""
    lines = html.unescape(re.sub(r"<[^>]+>", "", found[0])).splitlines()
    commands = "\n".join(line[2:] for line in lines if line.startswith("$ "))
    return found[0].replace("<div ", f'<div data-copy="{html.escape(commands)}" ', 1)


def on_page_content(content, **_):
    """Formulas are drawn, and what the buttons of blocks copy is set."""
    content = with_formulas(content) if "arithmatex" in content else content
    return re.sub(r'(?s)<div class="language-console highlight">.*?</div>', with_copied_commands, content)


def on_post_page(output, page, **_):
    """The theme has the search of pages that are opened from disk from the net; here it is a file beside them."""
    here = "../" if page.file.src_uri.startswith("guide/") else ""
    outside = "https://unpkg.com/iframe-worker/shim"
    assert outside in output, "the theme has changed: see on_post_page"
    return output.replace(outside, f"{here}assets/search.js")
