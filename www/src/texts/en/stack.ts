export const stack = {
  add: "Add",
  clear: "Clear",
  notes: "What is left out or doubtful",
  list: "The files of the stack; arrow keys move, Delete removes",
  remove: (file: string) => `Remove ${file}`,
  roomLight: "room light",
  none: "Choose three photographs or more.",
  noPhotograph: "There is no photograph among these files; three are needed.",
  tooFew: (photographs: number) =>
    `${photographs === 1 ? "One photograph is" : "Two photographs are"} not enough: three are needed.`,
  photographs: (count: number) => (count === 1 ? "1 photograph" : `${count} photographs`),
  ambient: (file: string) => `without the lamp ${file}`,
  mask: (file: string) => `mask ${file}`,
  others: (count: number) => (count === 1 ? "1 other file" : `${count} other files`),
  archives: (names: readonly string[]) => `out of ${names.join(", ")}`,
};
