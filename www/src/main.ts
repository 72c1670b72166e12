import { byId, wordsOf } from "./dom.js";
import { Engine } from "./engine.js";
import { filesOfDrop, filesOfFolder } from "./files.js";
import { Intro } from "./intro.js";
import { ResultView } from "./result.js";
import { Run } from "./run.js";
import { SampleChoice } from "./sample_choice.js";
import { Settings } from "./settings.js";
import { Stack } from "./stack.js";
import { nameOf } from "./stack_name.js";

const form = byId<HTMLFormElement>("bench");
const intro = new Intro();
const engine = new Engine();
const stack = new Stack(engine, () => {
  run.stackChanged();
  result.stackIs(stack.files);
});
const settings = new Settings(form, {
  device: () => engine.use(settings.device),
  color: () => {
    stack.color = settings.color;
  },
});
const result = new ResultView(engine);
const run = new Run(form, engine, stack, settings, (estimate) => {
  intro.hide();
  const format = settings.options.normalFormat ?? "opengl";
  result.show({ estimate, files: stack.files, name: stackName, format });
});

// What is kept and shown follows this choice at once.
form.addEventListener("change", ({ target }) => {
  if (!(target instanceof HTMLInputElement) || target.name !== "normal-format") return;
  result.turnGreen(settings.options.normalFormat ?? "opengl").catch((error) => run.fail(wordsOf(error)));
});

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
  stack.take(files);
});
// A sample that arrives late must not replace the photographs of a run.
form.addEventListener("submit", () => samples.cancel());

/** Takes files of the user in place of all others. */
function take(files: File[]): void {
  samples.leave();
  settings.returnColor();
  stackName = nameOf(files);
  stack.take(files);
}

connect("pick-files", "files", take);
connect("pick-folder", "folder", (files) => take(filesOfFolder(files)));
connect("add", "more", (files) => {
  samples.leave();
  stack.take(files, true);
});
byId("clear").addEventListener("click", () => take([]));

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
  if (!event.dataTransfer || run.underWay) return;
  try {
    take(await filesOfDrop(event.dataTransfer));
  } catch (error) {
    run.fail(wordsOf(error));
  }
});
