import { AMBIENT, CLAY, EXPOSURE, MOST_LAMPS } from "./shading.js";

/** One triangle that covers everything. */
export const VERTEX = `#version 300 es
void main() {
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}`;

/** The arithmetic of shading.ts; also the one of the file that is handed on, whose normals are colours. */
export const FRAGMENT = `#version 300 es
precision highp float;
uniform sampler2D normals;
uniform sampler2D albedo;
uniform float encoded;        // 1 where normals are stored as colours
uniform vec4 place;           // left, bottom, width, height of the frame
uniform vec3 lamps[${MOST_LAMPS}];    // x, y, brightness
uniform int count;
uniform vec4 look;            // diffuse, specular, exponent, slope
uniform float coloured;
out vec4 colour;

vec3 toSrgb(vec3 linear) {
  vec3 c = clamp(linear, 0.0, 1.0);
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}

void main() {
  vec2 at = (gl_FragCoord.xy - place.xy) / place.zw;
  if (at.x < 0.0 || at.y < 0.0 || at.x > 1.0 || at.y > 1.0) discard;
  at.y = 1.0 - at.y;
  vec4 own = texture(albedo, at);
  vec3 n = texture(normals, at).xyz;
  if (encoded > 0.5) n = own.a < 0.5 ? vec3(0.0) : 2.0 * n - 1.0;
  if (dot(n, n) < 0.25) discard;
  n = normalize(vec3(look.w * n.xy, n.z));
  float scattered = 0.0;
  float reflected = 0.0;
  for (int i = 0; i < ${MOST_LAMPS}; i++) {
    if (i >= count) break;
    vec2 xy = lamps[i].xy;
    vec3 lamp = vec3(xy, sqrt(max(1.0 - dot(xy, xy), 0.0)));
    float facing = dot(n, lamp);
    scattered += lamps[i].z * (max(facing, 0.0) + ${AMBIENT});
    vec3 halfway = normalize(lamp + vec3(0.0, 0.0, 1.0));
    if (facing > 0.0) reflected += lamps[i].z * pow(max(dot(n, halfway), 1e-6), look.z);
  }
  vec3 base = mix(vec3(${CLAY}), own.rgb, coloured);
  colour = vec4(toSrgb(${EXPOSURE} * (look.x * scattered * base + look.y * reflected)), 1.0);
}`;

/** Compiles the program; nothing where the browser cannot. */
export function programOf(gl: WebGL2RenderingContext): WebGLProgram | undefined {
  const program = gl.createProgram();
  for (const [kind, source] of [
    [gl.VERTEX_SHADER, VERTEX],
    [gl.FRAGMENT_SHADER, FRAGMENT],
  ] as const) {
    const shader = gl.createShader(kind);
    if (!shader) return undefined;
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  return gl.getProgramParameter(program, gl.LINK_STATUS) ? program : undefined;
}
