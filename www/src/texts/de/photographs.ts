import type { photographs as en } from "../en/photographs.js";

export const photographs: typeof en = {
  bench: "Fotos und Einstellungen",
  title: "Fotos",
  drop: "Ordner oder Bilder hierher ziehen",
  dropWhat: "ein Objekt, eine feste Kamera, eine bewegte Lampe; mindestens drei",
  chooseImages: "Bilder wählen",
  chooseFolder: "Ordner wählen",
  images: "Bilder des Satzes",
  folder: "Ordner des Satzes",
  more: "Weitere Bilder",
  gone: "Es ist nicht mehr unter den Dateien.",
};
