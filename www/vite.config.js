import { defineConfig } from "vite";

export default defineConfig({
  // Relative addresses: the page runs from any folder of any server.
  base: "./",
  build: { target: "es2023", chunkSizeWarningLimit: 1000 },
  // The package's worker is a module.
  worker: { format: "es" },
});
