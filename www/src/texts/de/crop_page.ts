import type { cropPage as en } from "../en/crop_page.js";

export const cropPage: typeof en = {
  remove: "Ganzes Bild nehmen",
};
