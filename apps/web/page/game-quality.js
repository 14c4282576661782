// SPDX-License-Identifier: MIT
//
// Quality: how much of what the settings allow is drawn, so that frames come as often as ticks do where the device is slow:
// fewer pixels, then one sample, then fewer pixels still. It reads no clock.

const steps = [
    {share: 1, samples: 4}, {share: 0.8, samples: 4}, {share: 0.8, samples: 1}, {share: 0.6, samples: 1},
    {share: 0.45, samples: 1}, {share: 0.34, samples: 1},
];
const slowMs = 26;   // that the middle one of a few frames takes: fewer
const quickMs = 8;   // of many frames: more, at least half of what a sixtieth holds being left
const fewFrames = 12;
const manyFrames = 90;
const warmUp = 3;    // frames after a change, which make textures and pipelines

const median = values => [...values].sort((a, b) => a - b)[values.length >> 1];

export class Quality {
    constructor(place = 0) {
        this.place = Math.min(Math.max(Math.trunc(place) || 0, 0), steps.length - 1);
        this.forget();
    }

    get now() { return steps[this.place]; }

    forget() {
        this.times = [];
        this.skipped = 0;
    }

    /// What a frame took, until the device was done with it. Whether `now` is another one.
    add(ms) {
        if (this.skipped < warmUp) {
            ++this.skipped;
            return false;
        }
        this.times.push(ms);
        if (this.times.length > manyFrames) this.times.shift();
        if (this.times.length >= fewFrames && this.place + 1 < steps.length) {
            const recent = median(this.times.slice(-fewFrames));
            if (recent > slowMs) return this.step(recent > 3 * slowMs ? 2 : 1);
        }
        if (this.times.length >= manyFrames && this.place > 0 && median(this.times) < quickMs) return this.step(-1);
        return false;
    }

    step(by) {
        this.place = Math.min(Math.max(this.place + by, 0), steps.length - 1);
        this.forget();
        return true;
    }
}
