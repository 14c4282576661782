// SPDX-License-Identifier: MIT
//
// A web worker that traces the truth, in an instance of its own of the module that can (truth.cpp). What it is told:
//   {job}                 what check.js got from the core; answers {ready: true}
//   {first, rows, masks}  judges the masks of these rows; answers {first, rows, judged, band, shadowed, wrong, at}
// or {error}, one sentence.
import createModule from './truth.mjs';

const loading = createModule({printErr: text => console.warn(text)});

/// What `action(place, size)` answers, a text, while the bytes lie there.
function withBytes(module, bytes, action) {
    const place = module._malloc(Math.max(bytes.byteLength, 1));
    if (place === 0) throw new Error('There is not enough memory for the truth of this view.');
    try {
        new Uint8Array(module.asm.memory.buffer).set(new Uint8Array(bytes), place);
        return module.UTF8ToString(action(place, bytes.byteLength));
    } finally {
        module._free(place);
    }
}

self.addEventListener('message', async ({data: {job, first, rows, masks}}) => {
    try {
        const module = await loading;
        if (job) {
            const error = withBytes(module, job, (place, size) => module._gnomon_truth_begin(place, size));
            self.postMessage(error ? {error} : {ready: true});
        } else {
            const text = withBytes(
                module, masks, (place, size) => module._gnomon_truth_judge(first, rows, place, size));
            self.postMessage({first, rows, ...JSON.parse(text)});
        }
    } catch (error) {
        self.postMessage({error: `The truth cannot be traced: ${error.message}`});
    }
});
