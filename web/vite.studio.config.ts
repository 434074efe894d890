import { defineConfig } from "vite";

/** The studio's page: files beside each other, with relative addresses, for its own server. */
export default defineConfig({
  base: "./",
  build: {
    outDir: "dist-studio",
    emptyOutDir: true,
    modulePreload: { polyfill: false },
    assetsInlineLimit: 1 << 14,
    chunkSizeWarningLimit: 1500,
    license: false,
    rolldownOptions: { input: "studio.html" },
  },
});
