import { ambient } from "./ambient.js";
import { capture } from "./capture.js";
import { crop } from "./crop.js";
import { cropPage } from "./crop_page.js";
import { derive } from "./derive.js";
import { directions } from "./directions.js";
import { downloads } from "./downloads.js";
import { engine } from "./engine.js";
import { errors } from "./errors.js";
import { fileNotices } from "./file_notices.js";
import { folders } from "./folders.js";
import { intro } from "./intro.js";
import { large } from "./large.js";
import { lights } from "./lights.js";
import { lightsPage } from "./lights_page.js";
import { maps } from "./maps.js";
import { mask } from "./mask.js";
import { maskPage } from "./mask_page.js";
import { offline } from "./offline.js";
import { out } from "./out.js";
import { photographs } from "./photographs.js";
import { plan } from "./plan.js";
import { queue } from "./queue.js";
import { queuePage } from "./queue_page.js";
import { relight } from "./relight.js";
import { relightPage } from "./relight_page.js";
import { result } from "./result.js";
import { run } from "./run.js";
import { samples } from "./samples.js";
import { session } from "./session.js";
import { settings } from "./settings.js";
import { solid } from "./solid.js";
import { solidPage } from "./solid_page.js";
import { stack } from "./stack.js";
import { top } from "./top.js";
import { viewer } from "./viewer.js";
import { viewerPage } from "./viewer_page.js";

/** All words of the page in English; other languages have the same shape. */
export const en = {
  ambient,
  capture,
  crop,
  cropPage,
  derive,
  directions,
  downloads,
  engine,
  errors,
  fileNotices,
  folders,
  intro,
  large,
  lights,
  lightsPage,
  maps,
  mask,
  maskPage,
  offline,
  out,
  photographs,
  plan,
  queue,
  queuePage,
  relight,
  relightPage,
  result,
  run,
  samples,
  session,
  settings,
  solid,
  solidPage,
  stack,
  top,
  viewer,
  viewerPage,
};
