import { defineConfig } from "vite";
import { offline } from "./plugins/offline.js";
import { policy } from "./plugins/policy.js";
import { texts } from "./plugins/texts.js";

export default defineConfig({
  // Relative addresses: the page runs from any folder of any server.
  base: "./",
  // One page: what is missing is an error, not that page again.
  appType: "mpa",
  build: { target: "es2023", chunkSizeWarningLimit: 1000 },
  // The package's worker is a module.
  worker: { format: "es" },
  plugins: [texts(), policy(), offline()],
});
