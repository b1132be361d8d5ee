// SPDX-License-Identifier: MIT
// A log that grows: asks the server that the page came from, and nobody else, for what is new.

const kPause = 1000; // milliseconds, where nobody says another

export interface Listener {
  begin(): void; // the log is another one now, or begins anew
  add(text: string, isAll: boolean): void; // does the text end where the log ends now?
  state(isLive: boolean): void; // does the server answer?
}

// The server says from where on what it sends is, and which file it is of: a new run is a new one.
export class Follower {
  private offset = 0;
  private file = "";

  constructor(private readonly listener: Listener, private readonly pause = kPause) {}

  async run(): Promise<void> {
    for (;;) {
      const more = await this.ask();
      if (!more) await new Promise((resolve) => setTimeout(resolve, this.pause));
    }
  }

  // Is there more to come at once?
  private async ask(): Promise<boolean> {
    try {
      const answer = await fetch(`log?from=${this.offset}&file=${encodeURIComponent(this.file)}`);
      if (!answer.ok) throw new Error(String(answer.status));
      const file = answer.headers.get("X-Log") ?? "";
      const size = Number(answer.headers.get("X-Size"));
      if (file !== this.file) this.listener.begin();
      if (file !== this.file) this.offset = 0;
      this.file = file;
      const bytes = await answer.text();
      this.offset = Number(answer.headers.get("X-End"));
      if (bytes !== "") this.listener.add(bytes, this.offset >= size);
      this.listener.state(true);
      return this.offset < size;
    } catch {
      this.listener.state(false);
      return false;
    }
  }
}
