import type { queuePage as en } from "../en/queue_page.js";

export const queuePage: typeof en = {
  title: "Sätze",
  zip: "Alles als ein ZIP",
  forget: "Verwerfen",
};
