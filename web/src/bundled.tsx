// What bundlers begin with (the condition "module"). Vite's development server would bundle an entry named .js
// beforehand, up to version 7 without its worker and its module; it leaves alone what is named .jsx.
export * from "./index.js";
