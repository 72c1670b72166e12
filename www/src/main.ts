import { AmbientChoice } from "./ambient.js";
import { areArchives, capturesOf } from "./archives/archives.js";
import { showCaptureHelp } from "./capture_help.js";
import type { Capture, Found } from "./captures.js";
import { CropChoice } from "./crop/choice.js";
import { byId } from "./dom.js";
import { Engine } from "./engine.js";
import { filesOfDrop, filesOfFolder, numbered } from "./files.js";
import { FolderChoice } from "./folder_choice.js";
import { Intro } from "./intro.js";
import { LanguageChoice } from "./language_choice.js";
import { SizeChoice } from "./large/size.js";
import { isChanged, LightHand } from "./lights/hand.js";
import { toCsv } from "./lights/light_text.js";
import { Rigs } from "./lights/rigs.js";
import type { Format } from "./maps.js";
import { MaskSetting } from "./mask/setting.js";
import { Offline } from "./offline.js";
import { Queue } from "./queue/queue.js";
import { type Outcome, ResultView } from "./result.js";
import { Run } from "./run.js";
import { SampleChoice } from "./sample_choice.js";
import type { Bench } from "./session/bench.js";
import { Session } from "./session/session.js";
import { Settings } from "./settings.js";
import { Stack } from "./stack.js";
import { nameOf } from "./stack_name.js";
import { translatePage } from "./texts/page.js";
import { texts } from "./texts/texts.js";

translatePage();

const form = byId<HTMLFormElement>("bench");
const intro = new Intro();
const engine = new Engine(() => offline.keep());
const stack = new Stack(engine, {
  changed() {
    intro.rest(stack.files.length > 0);
    size.wait();
    run.stackChanged();
    result.stackIs(stack.files);
    offline.look();
    // Files are kept once they are out of their archives.
    if (stack.files.length === 0) session.changed("stack");
    else session.begun();
  },
  planned() {
    run.stackPlanned();
    ambient.renew();
    void size.renew();
    session.changed("stack");
  },
  pictured: () => hand.pictured(),
});
const ambient = new AmbientChoice(stack);
const rigs = new Rigs();
const settings = new Settings(form, rigs, ambient, {
  device: () => engine.use(settings.device),
  color: () => {
    stack.color = settings.color;
  },
  any: () => session.changed("settings"),
});
const result = new ResultView(engine);
const crop = new CropChoice(engine, stack, () => {
  size.cropped();
  // Else the stack is kept with all that is known of it once it is planned.
  if (stack.planned) session.changed("stack");
});
const size = new SizeChoice(form, engine, stack, settings, crop);
const run = new Run(form, engine, stack, settings, size, (done) => {
  show({ ...done, files: stack.files, name: stackName, format: format() });
});

/** Which way green points in what is kept and shown. */
function format(): Format {
  return settings.options.normalFormat ?? "opengl";
}

/** The result that is shown. */
let outcome: Outcome | undefined;
function show(shown: Outcome): void {
  intro.hide();
  outcome = shown;
  run.resume(shown.taken);
  queue.shows(shown);
  result.show(shown);
  hand.show(shown.estimate);
  session.changed("outcome");
}

// What is kept and shown follows this choice at once.
form.addEventListener("change", ({ target }) => {
  if (!(target instanceof HTMLInputElement) || target.name !== "normal-format") return;
  turnGreen();
});

function turnGreen(): void {
  result.turnGreen(format()).catch((error) => run.fail(error));
}

run.stackPlanned();
showCaptureHelp();
const hand = new LightHand({
  stack,
  rigs,
  again: (files, options) => run.again(files, { ...settings.optionsOfPart, ...options }),
  shine: (x, y) => result.shineFrom(x, y),
  changed: () => session.changed("hand"),
});
new MaskSetting(engine, stack, settings);

/** Connects a button with the file input that it stands for. */
function connect(button: string, input: string, take: (files: File[]) => void): void {
  const picker = byId<HTMLInputElement>(input);
  byId(button).addEventListener("click", () => picker.click());
  picker.addEventListener("change", () => {
    take([...(picker.files ?? [])]);
    // Choosing the same files again must be noticed too.
    picker.value = "";
  });
}

/** What people call the stack. */
let stackName = "";
const samples = new SampleChoice((files, { color, title }) => {
  settings.lendColor(color);
  stackName = title;
  replace(files);
  folders.forget();
});
// A sample that arrives late must not replace the photographs of a run.
form.addEventListener("submit", () => samples.cancel());
// While the estimator computes, the page has nothing to do.
form.addEventListener("submit", () => setTimeout(() => result.prepare()));

/** Takes files in place of all others; a mask and lights that were chosen for those go with them. */
function replace(files: File[]): void {
  if (stack.files.length > 0) settings.forgetFiles();
  crop.forget();
  stack.take(files);
}

/** Takes files of the user in place of all others. */
function take(files: File[]): void {
  samples.leave();
  settings.returnColor();
  stackName = nameOf(files);
  folders.forget();
  replace(files);
}
const queue = new Queue({
  engine,
  settings,
  size,
  run,
  format,
  show: showOf,
  changed: () => session.changed("queue"),
});
const folders = new FolderChoice(take, (captures, own) => void queue.start(captures, own));

/** Shows a result of the queue, and puts its stack on the bench. */
function showOf(shown: Outcome, captures: readonly Capture[], capture: Capture): void {
  const { files } = stack;
  const same = files.length === shown.files.length && files.every((file, at) => file === shown.files[at]);
  if (!same) take([...shown.files]);
  stackName = shown.name;
  folders.taken(captures, capture);
  show(shown);
  if (format() !== shown.format) turnGreen();
}

/** Takes what was found; where that is archives, what is found in them. */
async function takeFound(found: Found): Promise<void> {
  const [only, another] = found.captures;
  if (!only || another || !areArchives(only.files)) {
    folders.found(found);
    return;
  }
  folders.wait(texts.folders.lookingIntoArchive);
  try {
    const inside = await capturesOf(only.files);
    if (run.underWay) run.ignore();
    else folders.found(inside ?? found);
  } catch (error) {
    folders.wait("");
    run.fail(error);
  }
}

const session = new Session({
  bench: () => ({
    name: stackName || nameOf(stack.files),
    photographs: stack.photographs.length,
    files: stack.files,
    crop: crop.kept,
    settings: settings.kept,
    outcome,
    hand: hand.held,
    queue: queue.kept,
  }),
  restore,
  keptQueue: (term) => queue.keptFor(term),
  cleared: () => queue.sweep(),
});

/** Puts the session that was kept on the bench. */
function restore(bench: Bench): void {
  take([...bench.files]);
  stackName = bench.name;
  crop.restore(bench.crop);
  settings.restore(bench.settings);
  if (bench.outcome) {
    show(bench.outcome);
    // The photographs may have changed after it.
    result.stackIs(stack.files);
    if (bench.hand) hand.hold(bench.hand);
    if (format() !== bench.outcome.format) turnGreen();
  } else if (bench.hand && isChanged(bench.hand)) {
    // Their result was too large to be kept: the next one begins with them.
    settings.handLights(new File([toCsv(bench.hand.lights)], "lights.csv", { type: "text/csv" }));
  }
  if (bench.queue) queue.restore(bench.queue, bench.outcome);
}

new LanguageChoice({
  busy: () => run.underWay,
  keep: () => session.keep(() => queue.lasts),
});

// Nothing is lost with an empty bench.
const offline = new Offline(() => stack.files.length === 0 && outcome === undefined && !run.underWay);

connect("pick-files", "files", (files) => {
  if (areArchives(files)) void takeFound({ captures: [{ folder: "", files }] });
  else take(files);
});
connect("pick-folder", "folder", (files) => void takeFound(filesOfFolder(files)));
connect("add", "more", (files) => {
  samples.leave();
  stack.take(files, true);
});
byId("clear").addEventListener("click", () => take([]));

/** Pictures out of the clipboard are added: they come one at a time. */
addEventListener("paste", ({ clipboardData }) => {
  const pasted = [...(clipboardData?.files ?? [])];
  if (pasted.length === 0 || document.querySelector("dialog[open]")) return;
  if (run.underWay) {
    run.ignore();
    return;
  }
  samples.leave();
  stack.take(numbered(pasted, stack.files), true);
});

// Anywhere on the page: a file that misses its target would replace the page.
const page = document.documentElement;
page.addEventListener("dragover", (event) => {
  event.preventDefault();
  page.classList.add("dragging");
});
page.addEventListener("dragleave", (event) => {
  if (event.relatedTarget === null) page.classList.remove("dragging");
});
page.addEventListener("drop", async (event) => {
  event.preventDefault();
  page.classList.remove("dragging");
  if (!event.dataTransfer) return;
  if (run.underWay) {
    run.ignore();
    return;
  }
  try {
    await takeFound(await filesOfDrop(event.dataTransfer));
  } catch (error) {
    run.fail(error);
  }
});
