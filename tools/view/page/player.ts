// SPDX-License-Identifier: MIT
// The moment that is shown, and playback.

export const kSpeeds = [0.25, 0.5, 1, 2, 4, 8, 16, 32, 64]; // steps (for a drive: seconds) per second

export class Player {
  time = 0; // in steps; fractional while it plays
  playing = false;
  loop = false;
  speed = 4;

  constructor(public end: number) {}

  // Whether time advances by itself.
  get running(): boolean {
    return this.playing;
  }

  toggle(): void {
    if (!this.playing && this.time >= this.end) this.time = 0;
    this.playing = !this.playing && this.end > 0;
  }

  // Goes to a moment. If the plan plays, it continues from there.
  go(time: number): void {
    this.time = Math.min(this.end, Math.max(0, time));
  }

  // Pauses, and moves to a whole step, `by` steps forward (or back, if negative).
  step(by: number): void {
    this.playing = false;
    const from = by > 0 ? Math.floor(this.time) : Math.ceil(this.time);
    this.go(from + by);
  }

  faster(by: number): void {
    const at = kSpeeds.findIndex((speed) => speed >= this.speed);
    this.speed = kSpeeds[Math.min(kSpeeds.length - 1, Math.max(0, at + by))];
  }

  // Advances by the elapsed seconds, at most 0.25: a longer gap means that the page was hidden.
  advance(seconds: number): void {
    if (!this.playing) return;
    this.time += Math.min(seconds, 0.25) * this.speed;
    if (this.time < this.end) return;
    if (this.loop) {
      this.time = this.end > 0 ? this.time % this.end : 0;
    } else {
      this.time = this.end;
      this.playing = false;
    }
  }
}
