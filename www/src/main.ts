import { AmbientChoice } from "./ambient.js";
import { showCaptureHelp } from "./capture_help.js";
import { byId, wordsOf } from "./dom.js";
import { Engine } from "./engine.js";
import { filesOfDrop, filesOfFolder, numbered } from "./files.js";
import { FolderChoice } from "./folder_choice.js";
import { Intro } from "./intro.js";
import { SizeChoice } from "./large/size.js";
import { isChanged, LightHand } from "./lights/hand.js";
import { toCsv } from "./lights/light_text.js";
import { Rigs } from "./lights/rigs.js";
import { MaskSetting } from "./mask/setting.js";
import { Offline } from "./offline.js";
import { type Outcome, ResultView } from "./result.js";
import { Run } from "./run.js";
import { SampleChoice } from "./sample_choice.js";
import type { Bench } from "./session/bench.js";
import { Session } from "./session/session.js";
import { Settings } from "./settings.js";
import { Stack } from "./stack.js";
import { nameOf } from "./stack_name.js";

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
const size = new SizeChoice(form, engine, stack, settings);
const run = new Run(form, engine, stack, settings, size, (done) => {
  const format = settings.options.normalFormat ?? "opengl";
  show({ ...done, files: stack.files, name: stackName, format });
});

/** The result that is shown. */
let outcome: Outcome | undefined;
function show(shown: Outcome): void {
  intro.hide();
  outcome = shown;
  result.show(shown);
  hand.show(shown.estimate);
  session.changed("outcome");
}

// What is kept and shown follows this choice at once.
form.addEventListener("change", ({ target }) => {
  if (!(target instanceof HTMLInputElement) || target.name !== "normal-format") return;
  result.turnGreen(settings.options.normalFormat ?? "opengl").catch((error) => run.fail(wordsOf(error)));
});

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
const folders = new FolderChoice(take);

const session = new Session({
  bench: () => ({
    name: stackName || nameOf(stack.files),
    photographs: stack.photographs.length,
    files: stack.files,
    settings: settings.kept,
    outcome,
    hand: hand.held,
  }),
  restore,
});

/** Puts the session that was kept on the bench. */
function restore(bench: Bench): void {
  take([...bench.files]);
  stackName = bench.name;
  settings.restore(bench.settings);
  if (bench.outcome) {
    show(bench.outcome);
    run.resume(bench.outcome.times);
    // The photographs may have changed after it.
    result.stackIs(stack.files);
    if (bench.hand) hand.hold(bench.hand);
    const format = settings.options.normalFormat ?? "opengl";
    if (format !== bench.outcome.format) result.turnGreen(format).catch((error) => run.fail(wordsOf(error)));
  } else if (bench.hand && isChanged(bench.hand)) {
    // Their result was too large to be kept: the next one begins with them.
    settings.handLights(new File([toCsv(bench.hand.lights)], "lights.csv", { type: "text/csv" }));
  }
}

// Nothing is lost with an empty bench.
const offline = new Offline(() => stack.files.length === 0 && outcome === undefined && !run.underWay);

connect("pick-files", "files", take);
connect("pick-folder", "folder", (files) => folders.found(filesOfFolder(files)));
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
    folders.found(await filesOfDrop(event.dataTransfer));
  } catch (error) {
    run.fail(wordsOf(error));
  }
});
