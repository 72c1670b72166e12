import { runnerImport } from "vite";

/** An opening tag of index.html, its name and its attributes; those have their values in double quotes. */
const TAG = /<([a-z][a-z0-9]*)((?:\s+[a-z][a-z-]*(?:="[^"]*")?)*)\s*\/?>/g;

/**
 * Writes the English words of `src/texts/en` into index.html, so that they are there before any script runs: `data-text` names
 * the content of an element, which must be empty, `data-text-attributes` those of attributes, as `title:room.key; ...`.
 * Both stay, for other languages (`src/texts/page.ts`).
 * @returns {import("vite").Plugin}
 */
export function texts() {
  let root = "";
  return {
    name: "texts",
    configResolved(config) {
      root = config.root;
    },
    transformIndexHtml: {
      order: "pre",
      async handler(html) {
        const { module } = await runnerImport("/src/texts/en/index.ts", {
          root,
          configFile: false,
          logLevel: "silent",
        });
        return filled(html, module.en);
      },
    },
  };
}

/** @param {string} html @param {object} table */
function filled(html, table) {
  return html.replace(TAG, (tag, _name, attributes, at) => {
    const content = /\sdata-text="([^"]*)"/.exec(attributes)?.[1];
    const named = /\sdata-text-attributes="([^"]*)"/.exec(attributes)?.[1];
    const added = (named?.split("; ") ?? []).map((pair) => {
      const [attribute, key = ""] = pair.split(":");
      return ` ${attribute}="${escaped(words(table, key))}"`;
    });
    const opened = tag.replace(/\s*\/?>$/, (end) => `${added.join("")}${end}`);
    if (content === undefined) return opened;
    if (!html.startsWith("</", at + tag.length))
      throw new Error(`index.html: the element of ${content} is not empty`);
    return opened + escaped(words(table, content));
  });
}

/** @param {any} table @param {string} key `room.key` */
function words(table, key) {
  const found = key.split(".").reduce((part, name) => part?.[name], table);
  if (typeof found !== "string") throw new Error(`index.html: the table of words has no ${key}`);
  return found;
}

/** @param {string} text */
function escaped(text) {
  return text.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll('"', "&quot;");
}
