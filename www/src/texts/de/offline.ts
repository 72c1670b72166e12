import type { offline as en } from "../en/offline.js";

export const offline: typeof en = {
  reload: "Neu laden",
  kept: "Diese Seite ist in diesem Browser gespeichert und läuft auch ohne Netzwerk.",
  newVersion: "Eine neue Version ist da: Laden Sie die Seite neu, um sie zu benutzen.",
  newVersionWaits:
    "Eine neue Version ist da. Andere Fenster benutzen noch die bisherige: Schließen Sie diese, und laden Sie dann neu.",
};
