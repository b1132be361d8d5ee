// SPDX-License-Identifier: MIT
// Follows a growing log by requesting new data from the server of the page.

const kPause = 1000; // milliseconds between requests, by default

export interface Listener {
  begin(): void; // a log starts: the first one, or one that replaces it
  add(text: string, isAll: boolean): void; // isAll: the text ends at the current end of the log
  state(isLive: boolean): void; // whether the server responds
}

// Requests the log from an offset on. With each answer the server sends the next offset and the identity of
// the file, which changes when a new run replaces the log.
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

  // Requests data once. Returns whether the log has more data already.
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
