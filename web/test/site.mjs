// Tests the site in headless Chromium, opened from disk: node site.mjs, after make site. The site loads nothing from
// outside, its search finds pages, and the page runs in it.
import assert from "node:assert/strict";
import { resolve } from "node:path";
import { chromium } from "playwright-core";

const SITE = `file://${resolve(import.meta.dirname, "../../target/site")}`;
const browser = await chromium.launch({
  executablePath: "/usr/bin/chromium", headless: true, args: ["--no-sandbox", "--disable-gpu"],
});
const page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
const complaints = [];
page.on("console", (message) => complaints.push(message.text()));
page.on("pageerror", ({ message }) => complaints.push(message));
page.on("request", (request) => /^(file|data|blob):/.test(request.url())
  || complaints.push(`request ${request.url()}`));

await page.goto(`${SITE}/index.html`);
// The first screen shows the rod on its ground and the link to the guide.
for (const place of ["svg[role=img]", "a.md-button--primary"]) {
  const box = await page.locator(place).first().boundingBox();
  assert.ok(box.y >= 0 && box.y + box.height <= 720, `${place}: ${JSON.stringify(box)}`);
}
const searches = [
  ["index", "coefficient of restitution", "guide/04"], ["guide/01-fall", "drop_height", "scenes"],
  ["index", "penalty", "guide/13"], ["compare", "Nitsche", "compare"], ["index", "restitution", "guide/04"],
  ["numbers", "Hopkinson", "guide/11"],
];
for (const [from, words, found] of searches) {
  // Words that are typed before the search listens are lost: they are typed again, on the page opened anew.
  for (let tries = 3, is_found = false; !is_found; tries -= 1) {
    await page.goto(`${SITE}/${from}.html`);
    await page.fill("[data-md-component=search-query]", words);
    is_found = await page.waitForSelector(`.md-search-result__item a[href*="${found}"]`, {
      state: "attached", timeout: 60000,
    }).then(() => true, (error) => { if (tries === 1) throw error; return false; });
  }
}
// Formulas are drawn, in the fonts beside the site.
for (const [name, count] of [["guide/06-damping", 15], ["guide/02-lattice", 15], ["start", 1], ["index", 1]]) {
  await page.goto(`${SITE}/${name}.html`);
  assert.ok(await page.locator(".md-content .katex").count() >= count, `${name}: formulas`);
  const left = (await page.locator("article > p").allInnerTexts()).filter((text) => /\$|\\|[a-z]_[a-z]\b/.test(text));
  assert.deepEqual(left, [], `${name}: formulas that are not drawn`);
  const fonts = await page.evaluate(() => document.fonts.ready.then((all) => [...all]
    .filter(({ family, status }) => /KaTeX_Math/.test(family) && status === "loaded").length));
  assert.ok(fonts > 0, `${name}: the font of formulas`);
}
// The button of a block copies its commands, without prompts and outputs.
await page.goto(`${SITE}/guide/08-accuracy.html`);
await page.evaluate(() => document.addEventListener("copy", () => {
  window.copied = document.activeElement.value ?? String(getSelection());
}));
const block = page.locator(".language-console", { hasText: "1.5000000001" });
await block.hover();
await block.locator("button").first().click();
assert.equal(await page.evaluate(() => window.copied), [
  "dalembert sample many.toml --times 100,300 --quantity centre --digits 12",
  "sed 's/1.5$/1.5000000001/' many.toml | dalembert sample - --times 100,300 --quantity centre --digits 12",
].join("\n"));
await page.goto(`${SITE}/page.html`);
await page.frameLocator("iframe[title='The page']").locator("#contacts tbody tr").first().waitFor();
assert.deepEqual(complaints, []);
await browser.close();
console.log(`the site: 8 pages, ${searches.length} searches, nothing asked for outside`);
