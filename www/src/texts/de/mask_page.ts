import type { maskPage as en } from "../en/mask_page.js";

export const maskPage: typeof en = {
  title: "Maske",
  wholeFrame: "Ganzes Bild",
  file: "Maskenbild",
  draw: "Auf dem Foto zeichnen …",
};
