export const top = {
  title: "Normalight",
  description: "Photographs under a moving lamp to lights and surface normals, in your browser.",
  tagline: "Photographs under a moving lamp become lights and surface normals.",
  language: "Language / Sprache",
  /** The choice is kept, but what is on the page would be lost with a reload. */
  languageLater:
    "What is here cannot be kept over a reload: the page speaks this language when it is opened again.",
};
