// SPDX-License-Identifier: MIT
// The time of a drive, in seconds: played, or live, which is as it comes.

import { Player } from "../page/player";

const kBehind = 1; // seconds that a live picture is behind the log, so that it need not wait for it
const kTooFar = 3; // seconds
const kSlowest = 0.25; // seconds a second: what came last is shown also if nothing comes after it

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

  // Of one that is live: it stands still.
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

  // As fast as time itself, and a little faster or slower to stay near to what comes.
  advance(seconds: number): void {
    if (!this.live) return super.advance(seconds);
    const off = Math.max(0, this.end - kBehind) - this.time;
    this.time += Math.abs(off) > kTooFar ? off
      : seconds * Math.max(kSlowest, 1 + Math.min(1, off));
    this.time = Math.min(this.time, this.end);
  }
}
