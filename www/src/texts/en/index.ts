/** All words of the page in English; other languages have the same shape. */
export const en = {};
