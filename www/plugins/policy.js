/** What the page may do: everything from its own server, and nothing from elsewhere. */
const POLICY = {
  "default-src": "'none'",
  // The module is compiled from bytes.
  "script-src": "'self' 'wasm-unsafe-eval'",
  "style-src": "'self'",
  "img-src": "'self' blob: data:",
  "connect-src": "'self' blob: data:",
  "worker-src": "'self'",
  "manifest-src": "'self'",
  "base-uri": "'none'",
  "form-action": "'none'",
};

/**
 * Writes the content security policy into the built page; the development server's own scripts would not pass it.
 * @returns {import("vite").Plugin}
 */
export function policy() {
  const content = Object.entries(POLICY)
    .map((words) => words.join(" "))
    .join("; ");
  return {
    name: "policy",
    apply: "build",
    // First of all: it counts for what follows it.
    transformIndexHtml: () => [
      { tag: "meta", attrs: { "http-equiv": "Content-Security-Policy", content }, injectTo: "head-prepend" },
    ],
  };
}
