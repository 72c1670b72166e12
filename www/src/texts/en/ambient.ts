export const ambient = {
  label: "Taken without the lamp (room light only)",
  none: "There is none",
  auto: "Find it by itself",
  thisOne: "It is this one",
  marked: (file: string) => `The light in ${file} is subtracted from the other photographs.`,
  found: (file: string) => `The light in ${file} is subtracted from the photographs.`,
  perhaps:
    "If one of the photographs turns out to show the light of the room alone, it is subtracted from the others.",
  leftOut: (file: string) =>
    `By its name ${file} is one; as long as you say that there is none, it is left out.`,
};
