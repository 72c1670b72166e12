// Makes docs/picture.png: photographs, estimated lights, normals and albedo of rendered objects.
//
//   for name in statue glossy relief; do
//     normalight render --recipe models/recipes/sample-$name.toml --count 1 --images 16 --size 220 --bits 16 --out OUT/$name
//     normalight estimate OUT/$name/Images/scene000000/rendered --mask OUT/$name/Images/scene000000/scene000000_mask.png \
//       --out OUT/$name/result
//   done
//   NORMALIGHT_CHROMIUM=/usr/bin/chromium node docs/picture.js OUT
import { readFile } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

const OBJECTS = ["statue", "glossy", "relief"];
const PHOTOGRAPHS = ["001", "006", "011"];
const SIDE = 132;

const [folder] = process.argv.slice(2);
if (folder === undefined) throw new Error("expected the folder with the rendered objects");

/** A file as an address that needs no server. @param {string} path @param {string} type */
async function address(path, type = "image/png") {
  return `data:${type};base64,${(await readFile(`${folder}/${path}`)).toString("base64")}`;
}

/** One object's row. @param {string} name */
async function row(name) {
  const [scene, result] = [`${name}/Images/scene000000`, `${name}/result`];
  const mask = await address(`${scene}/scene000000_mask.png`);
  /** @param {string} path */
  const object = async (path, style = "") =>
    `<div style="mask: url(${mask}) luminance 0 / 100%"><img src="${await address(path)}" style="${style}"></div>`;
  const lights = await address(`${result}/lights.svg`, "image/svg+xml");
  return [
    // Photographs hold linear light, which screens show too dark.
    ...(await Promise.all(
      PHOTOGRAPHS.map((photo) => object(`${scene}/rendered/${photo}.png`, "filter: url(#screen)")),
    )),
    `<div><img src="${lights}"></div>`,
    await object(`${result}/normals.png`),
    await object(`${result}/albedo.png`),
  ].join("");
}

const gamma = ["R", "G", "B"].map((channel) => `<feFunc${channel} type="gamma" exponent="0.4545"/>`).join("");
const titles = ["photographs, one lamp each", "lights", "normals", "albedo"];
const html = `
<style>
  body { margin: 0; background: white; font: 15px sans-serif; color: #333; text-align: center }
  main { display: grid; grid-template-columns: repeat(6, ${SIDE}px); gap: 6px; padding: 8px; width: max-content }
  main > h2 { font: inherit; margin: 0 } main > h2:first-child { grid-column: span 3 }
  div, img { width: ${SIDE}px; height: ${SIDE}px; display: block }
</style>
<svg width="0" height="0" style="position: absolute"><filter id="screen" color-interpolation-filters="sRGB">
  <feComponentTransfer>${gamma}</feComponentTransfer></filter></svg>
<main>${titles.map((title) => `<h2>${title}</h2>`).join("")}${(await Promise.all(OBJECTS.map(row))).join("")}</main>`;

const { NORMALIGHT_CHROMIUM: executablePath } = process.env;
if (executablePath === undefined) throw new Error("NORMALIGHT_CHROMIUM names no browser");
const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
try {
  const page = await browser.newPage({ viewport: { width: 900, height: 600 } });
  await page.setContent(html, { waitUntil: "load" });
  await page.locator("main").screenshot({ path: fileURLToPath(new URL("picture.png", import.meta.url)) });
} finally {
  await browser.close();
}
