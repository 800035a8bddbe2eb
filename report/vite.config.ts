import { defineConfig } from "vite";
import { viteSingleFile } from "vite-plugin-singlefile";

// One file without references to others: recoil puts the data of runs into it.
export default defineConfig({
  plugins: [viteSingleFile()],
  build: { target: "es2022" },
});
