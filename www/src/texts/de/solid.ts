import type { solid as English } from "../en/solid.js";

export const solid: typeof English = {
  show: "Zeigen",
  close: "Schließen",
  making: "Die Oberfläche wird berechnet",
  failed: "Die Oberfläche ließ sich nicht berechnen; der Grund steht unten.",
  noWebgl: "Dieser Browser hat kein WebGL2, das die 3D-Ansicht braucht.",
  kind: "3D-Ansicht",
  surface: "Die Oberfläche in 3D",
};
