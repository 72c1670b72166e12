import type { solidPage as en } from "../en/solid_page.js";

export const solidPage: typeof en = {
  title: "Oberfläche in 3D",
  keys: "Ziehen oder Pfeiltasten drehen die Oberfläche, Mausrad, zwei Finger, + und − holen sie heran, 0 dreht sie zurück. Die Lampen sind die von „Neu beleuchten“.",
};
