// SPDX-License-Identifier: MIT
// Time of a drive in seconds: played back, or live.

import { Player } from "../page/player";

const kBehind = 1; // seconds by which a live display is behind the log, so that it never waits for data
const kTooFar = 3; // seconds
const kSlowest = 0.25; // seconds per second: the end of the log is reached even if it no longer grows

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

  // Pauses a live display.
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

  // At normal speed, slightly faster or slower to stay at a constant distance from the end of the log.
  advance(seconds: number): void {
    if (!this.live) return super.advance(seconds);
    const off = Math.max(0, this.end - kBehind) - this.time;
    this.time += Math.abs(off) > kTooFar ? off
      : seconds * Math.max(kSlowest, 1 + Math.min(1, off));
    this.time = Math.min(this.time, this.end);
  }
}
