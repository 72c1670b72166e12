import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import { complaints } from "./support/axe.js";
import { greyPng } from "./support/files.js";
import { Page } from "./support/page.js";
import { source } from "./support/source.js";

const { en } = await source("texts/en/index.ts");
const { de } = await source("texts/de/index.ts");

/** All words of a table that are no functions. @param {unknown} table @returns {string[]} */
const wordsIn = (table) =>
  typeof table === "string" ? [table] : Object.values(Object(table)).flatMap(wordsIn);

const german = new Set(wordsIn(de));
const onlyEnglish = wordsIn(en).filter((words) => !german.has(words));

const small = /** @type {const} */ (["x", "y", "both"]).map((lit, index) =>
  greyPng(`00${index + 1}.png`, 32, 32, 200, lit),
);

test("what a system shows of the installed page has the words of the page", async () => {
  const path = new URL("../public/manifest.webmanifest", import.meta.url);
  const { description, description_localized } = JSON.parse(await readFile(path, "utf8"));
  assert.equal(description, en.top.description);
  assert.deepEqual(description_localized, { de: de.top.description });
});

/** @type {Page} */
let page;
/** @type {import("playwright-core").Page} */
let tab;

before(async () => {
  page = await Page.open({ webgpu: false, locale: "de-DE" });
  tab = page.page;
});
after(() => page.close());

/** Words of the English table that the page says, seen or hidden; those that are marked as English may be so. */
function leftovers() {
  return tab.evaluate((english) => {
    const known = new Set(english);
    const said = [...document.querySelectorAll("html :not([lang=en] *)")].flatMap((element) => [
      ...[...element.childNodes].filter(({ nodeType }) => nodeType === Node.TEXT_NODE),
      ...["aria-label", "aria-roledescription", "title", "alt", "placeholder", "content"].flatMap(
        (name) => element.getAttributeNode(name) ?? [],
      ),
    ]);
    return said.map(({ nodeValue }) => (nodeValue ?? "").trim()).filter((words) => known.has(words));
  }, onlyEnglish);
}

/** What is cut off or too wide on a small screen. */
async function tooWide() {
  await tab.setViewportSize({ width: 360, height: 800 });
  const wide = await tab.evaluate(() => [
    ...[...document.querySelectorAll("main :is(span, button, p, label, h2, h3, b)")]
      .filter((element) => !element.closest(".thumbnails") && !element.matches(".samples *"))
      .filter(({ scrollWidth, clientWidth }) => clientWidth > 0 && scrollWidth > clientWidth + 1)
      .map(({ textContent }) => textContent),
    ...(document.documentElement.scrollWidth > innerWidth ? ["the page"] : []),
  ]);
  await tab.setViewportSize({ width: 1280, height: 900 });
  return wide;
}

test("a German browser gets a German page", async () => {
  assert.equal(await tab.getAttribute("html", "lang"), "de");
  assert.equal(await tab.textContent("#settings-title"), "Einstellungen");
  assert.equal(await tab.textContent("#engine-words"), "Bereit auf der CPU");
  assert.equal(await tab.textContent("#start-why"), de.stack.none);
  assert.equal(await tab.getAttribute("#bench", "aria-label"), "Fotos und Einstellungen");
  assert.deepEqual(await leftovers(), []);
  assert.deepEqual(await complaints(tab, "html"), []);
  assert.deepEqual(await tooWide(), []);
});

test("what the estimator does and doubts is said in German, and its own words are marked as English", async () => {
  await page.quick();
  await page.upload([...small, { name: "notes.docx", bytes: new Uint8Array([80, 75]) }]);
  await page.thumbnails(3);
  assert.equal(await tab.textContent("#stack-words"), "3 Fotos · 1 andere Datei");
  assert.match((await tab.textContent("#stack-notes")) ?? "", /^Ausgelassen: notes\.docx \(kein Bild\)/);
  assert.equal(await page.estimate(), "");
  assert.match((await tab.textContent("#status")) ?? "", /^Fertig in \d+,\d s\.$/);
  assert.match((await tab.textContent("#facts")) ?? "", /3 mit 32 × 32 Pixeln.*QualitätSchnell/);
  const plan = await tab.locator("#plan li").allTextContents();
  assert.equal(plan[0], "Fotos: 3 (nach Namen): 001.png bis 003.png");
  assert.match(plan.join("\n"), /nichts in den Fotos sagt, wie sich ihre Zahlen zum Licht verhalten/i);
  assert.doesNotMatch(plan.join("\n"), /\b(the|is|photographs)\b/);
  assert.deepEqual(await leftovers(), []);
  assert.deepEqual(await complaints(tab, "html"), []);
  assert.deepEqual(await tooWide(), []);

  const coming = tab.waitForEvent("download");
  await tab.click("#share");
  const shared = await readFile(await (await coming).path(), "utf8");
  assert.match(shared, /<html lang="de">/);
  assert.match(shared, /<canvas [^>]*aria-label="Das Objekt unter einer Lampe"/);
  assert.match(shared, /<label>Glanz </);
  assert.doesNotMatch(shared, /\{\{/);

  await page.choose("lights", { name: "lights.txt", bytes: new TextEncoder().encode("0 0 1\n") });
  const problem = await page.estimate();
  assert.ok(problem?.startsWith(`${de.errors.before.input}: lights.txt: `), problem ?? "");
  assert.match((await tab.textContent("#run-problem [lang=en]")) ?? "", /lights/);
  await tab.click('label:has(input[name="lights"][value="auto"])');
});

test("another language is kept, and nothing on the page is lost with the change", async () => {
  await tab.selectOption("#language", "en");
  await tab.waitForSelector('html[lang="en"] #result:visible');
  assert.equal(await tab.textContent("#settings-title"), "Settings");
  await tab.waitForSelector('#stack-words:text-is("3 photographs · 1 other file")');
  assert.match((await tab.textContent("#facts")) ?? "", /3 of 32 × 32 pixels/);
  await tab.reload();
  await tab.waitForSelector("#session:visible");
  assert.match((await tab.textContent("#session-words")) ?? "", /^Go on with 001\.png … .* \(3 photographs/);
  await tab.selectOption("#language", "de");
  await tab.waitForSelector('html[lang="de"] #session:visible');
});

test("photographs that cannot be kept stay, and the page says that it waits with the other language", async () => {
  const other = await tab.context().newPage();
  await other.goto(tab.url());
  await other.setInputFiles(
    "#files",
    small.map(({ name, bytes }) => ({ name, mimeType: "", buffer: Buffer.from(bytes) })),
  );
  await other.waitForSelector('#stack-words:text-is("3 Fotos")');
  await other.selectOption("#language", "en");
  await other.waitForSelector("#language-words:visible");
  assert.equal(await other.textContent("#language-words"), de.top.languageLater);
  assert.equal(await other.textContent("#stack-words"), "3 Fotos");
  await other.close();
  page.assertQuiet();
});
