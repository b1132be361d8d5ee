// SPDX-License-Identifier: MIT
// The moment of the execution that is shown, in seconds. It is played back, or live: shortly behind the end
// of the log.

import { Player } from "../page/player";

const kBehind = 1; // seconds by which a live display lags behind the log, so that it does not wait for data
const kTooFar = 3; // seconds of deviation from this lag, above which the display jumps
const kSlowest = 0.25; // seconds per second; positive, so that the display reaches the end of a log that stops growing

export class DrivePlayer extends Player {
  live: boolean;

  constructor(readonly isFollowed: boolean) {
    super(0);
    this.speed = 1;
    this.live = isFollowed;
  }

  get running(): boolean {
    return this.playing || this.live;
  }

  goLive(): void {
    this.playing = false;
    this.live = true;
    this.time = Math.max(0, this.end - kBehind);
  }

  // Pauses a live display; otherwise starts or pauses playing.
  toggle(): void {
    if (this.live) this.live = false;
    else super.toggle();
  }

  go(time: number): void {
    this.live = this.isFollowed && time >= this.end;
    super.go(time);
  }

  step(by: number): void {
    this.live = false;
    super.step(by);
  }

  // Advances by the elapsed seconds. A live display runs at about normal speed, faster or slower to keep its
  // lag behind the end of the log constant.
  advance(seconds: number): void {
    if (!this.live) return super.advance(seconds);
    const off = Math.max(0, this.end - kBehind) - this.time;
    this.time += Math.abs(off) > kTooFar ? off
      : seconds * Math.max(kSlowest, 1 + Math.min(1, off));
    this.time = Math.min(this.time, this.end);
  }
}
