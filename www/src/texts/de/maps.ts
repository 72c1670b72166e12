import type { maps as en } from "../en/maps.js";

export const maps: typeof en = {
  relit: "Neu beleuchtet",
  normals: { opengl: "Normalen, Grün ist oben", directx: "Normalen, Grün ist unten" },
  albedo: "Albedo",
  depth: "Tiefe",
  expectedErrors: "Zu erwartender Fehler der Normalen",
  trueErrors: (file) => `Fehler der Normalen gegen ${file}`,
  distrust: "Wo Zweifel angebracht sind",
  comparing: (done, of) => `Fotos werden verglichen: ${done} von ${of}`,
  residual: "Abweichung vom gezeigten Foto",
  photographs: "Fotos",
  channels: { depth: "Tiefe", degrees: "Grad", difference: "Abweichung in %" },
};
