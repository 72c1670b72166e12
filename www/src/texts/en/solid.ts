/** The surface in space. */
export const solid = {
  show: "Show",
  close: "Close",
  making: "Making the surface",
  failed: "The surface could not be made; the reason stands below.",
  noWebgl: "This browser has no WebGL2, which the view in 3D needs.",
  /** The kind of control, for screen readers. */
  kind: "view in 3D",
  surface: "The surface in 3D",
};
