import { since } from "../numbers.js";

export const session = {
  here: "Kept on this device only.",
  restore: "Restore",
  forget: "Forget",
  goOn: (name: string, photographs: number, time: number) =>
    `Go on with ${name} (${photographs === 1 ? "1 photograph" : `${photographs} photographs`}, from ${since(time)})`,
  kept: "Kept on this device for a reload, until you clear them or take others.",
  otherWindow: "Another window's photographs are kept for a reload, not these.",
  notKept: (reason: string) => `These photographs are not kept for a reload: ${reason}.`,
  stillKept: (reason: string) => `The photographs are still kept: ${reason}`,
  unread: (reason: string) => `What was kept cannot be read: ${reason}`,
  missing: "photographs are missing.",
  full: "this browser has no room left",
  tooLarge: (needed: string, free: string) => `they have ${needed}, and this browser takes ${free} more`,
};
