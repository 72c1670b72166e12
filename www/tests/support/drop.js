/** @typedef {import("./files.js").TestFile} TestFile */

/**
 * Drops files and folders on the page as a browser hands them over: playwright cannot drop folders.
 * Paths in the names are folders; a name that ends with a slash is an empty one.
 * @param {import("playwright-core").Page} tab @param {TestFile[]} files
 */
export async function drop(tab, files) {
  const list = files.map(({ name, bytes }) => ({ name, base64: Buffer.from(bytes).toString("base64") }));
  await tab.evaluate((all) => {
    /** @typedef {{ name: string, isFile: boolean, isDirectory: boolean, children: Map<string, Entry> }} Entry */
    /** @param {string} name @param {File} [file] @returns {Entry} */
    const entry = (name, file) => {
      const children = new Map();
      let read = false;
      const made = { name, isFile: file !== undefined, isDirectory: file === undefined, children };
      return Object.assign(made, {
        ...(file ? { file: (/** @type {(file: File) => void} */ done) => done(file) } : {}),
        createReader: () => ({
          readEntries(/** @type {(entries: Entry[]) => void} */ done) {
            done(read ? [] : [...children.values()]);
            read = true;
          },
        }),
      });
    };
    const root = entry("");
    for (const { name, base64 } of all) {
      const parts = name.split("/");
      const last = parts.pop() ?? "";
      let at = root;
      for (const part of parts) {
        const folder = at.children.get(part) ?? entry(part);
        at.children.set(part, folder);
        at = folder;
      }
      const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
      if (last) at.children.set(last, entry(last, new File([bytes], last)));
    }
    const items = [...root.children.values()].map((child) => ({ webkitGetAsEntry: () => child }));
    const event = new Event("drop", { bubbles: true, cancelable: true });
    Object.defineProperty(event, "dataTransfer", { value: { items, files: [] } });
    document.body.dispatchEvent(event);
  }, list);
}
