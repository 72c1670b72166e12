import type { Texts } from "../texts.js";
import { crop } from "./crop.js";
import { directions } from "./directions.js";
import { lights } from "./lights.js";
import { mask } from "./mask.js";
import { out } from "./out.js";
import { queue } from "./queue.js";
import { relight } from "./relight.js";
import { solid } from "./solid.js";
import { viewer } from "./viewer.js";

/** All words of the page in German. */
export const de: Texts = {
  crop,
  directions,
  lights,
  mask,
  out,
  queue,
  relight,
  solid,
  viewer,
};
