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
const searches = [["index", "coefficient of restitution", "guide/04"], ["guide/01-fall", "drop_height", "scenes"]];
for (const [from, words, found] of searches) {
  await page.goto(`${SITE}/${from}.html`);
  await page.fill("[data-md-component=search-query]", words);
  await page.waitForSelector(`.md-search-result__item a[href*="${found}"]`, { state: "attached", timeout: 120000 });
}
await page.goto(`${SITE}/page.html`);
await page.frameLocator("iframe[title='The page']").locator("#contacts tbody tr").first().waitFor();
assert.deepEqual(complaints, []);
await browser.close();
console.log("the site: 3 pages, 2 searches, nothing asked for outside");
