/** A worker that the test plays. */
export class Played {
  asked = [];
  terminated = false;
  onmessage = null;
  onerror = null;
  postMessage(message) {
    this.asked.push(message);
  }
  terminate() {
    this.terminated = true;
  }
  say(data) {
    this.onmessage({ data });
  }
}
