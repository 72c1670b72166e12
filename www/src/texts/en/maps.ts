export const maps = {
  relit: "Relit",
  normals: { opengl: "Normals, green is up", directx: "Normals, green is down" },
  albedo: "Albedo",
  depth: "Depth",
  expectedErrors: "Expected error of the normals",
  trueErrors: (file: string) => `Error of the normals against ${file}`,
  distrust: "Where to distrust",
  comparing: (done: number, of: number) => `Comparing photographs: ${done} of ${of}`,
  residual: "Residual of the replayed photograph",
  photographs: "Photographs",
  /** What the numbers of a map are. */
  channels: { depth: "depth", degrees: "degrees", difference: "difference in %" },
};
