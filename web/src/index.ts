/**
 * Photographs of one object under unknown, moving lights to lights and surface normals, in the browser.
 *
 * @packageDocumentation
 */
export { type ErrorCode, type ErrorKind, NormalightError } from "./errors.js";
export { Normalight } from "./normalight.js";
export * from "./types.js";
