export const offline = {
  reload: "Reload",
  kept: "This page is kept in this browser and works without a network.",
  newVersion: "A new version is here: reload to use it.",
  newVersionWaits:
    "A new version is here. Other windows still use the one before: close them, then reload to use it.",
};
