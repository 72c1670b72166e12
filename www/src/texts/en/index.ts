import { ambient } from "./ambient.js";
import { capture } from "./capture.js";
import { cropPage } from "./crop_page.js";
import { derive } from "./derive.js";
import { downloads } from "./downloads.js";
import { engine } from "./engine.js";
import { errors } from "./errors.js";
import { fileNotices } from "./file_notices.js";
import { folders } from "./folders.js";
import { intro } from "./intro.js";
import { large } from "./large.js";
import { lightsPage } from "./lights_page.js";
import { maps } from "./maps.js";
import { maskPage } from "./mask_page.js";
import { offline } from "./offline.js";
import { photographs } from "./photographs.js";
import { plan } from "./plan.js";
import { queuePage } from "./queue_page.js";
import { relightPage } from "./relight_page.js";
import { result } from "./result.js";
import { run } from "./run.js";
import { samples } from "./samples.js";
import { session } from "./session.js";
import { settings } from "./settings.js";
import { solidPage } from "./solid_page.js";
import { stack } from "./stack.js";
import { top } from "./top.js";
import { viewerPage } from "./viewer_page.js";

/** All words of the page in English; other languages have the same shape. */
export const en = {
  ambient,
  capture,
  cropPage,
  derive,
  downloads,
  engine,
  errors,
  fileNotices,
  folders,
  intro,
  large,
  lightsPage,
  maps,
  maskPage,
  offline,
  photographs,
  plan,
  queuePage,
  relightPage,
  result,
  run,
  samples,
  session,
  settings,
  solidPage,
  stack,
  top,
  viewerPage,
};
