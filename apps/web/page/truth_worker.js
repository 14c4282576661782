// SPDX-License-Identifier: MIT
//
// A web worker that traces the truth, in an instance of its own of the module that can (truth.cpp). What it is told:
//   {job, masks}          what check.js got from the core; answers {ready: true}
//   {first, rows}         judges these rows; answers {first, rows, judged, band, shadowed, wrong, at}
// or {error}, one sentence.
import createModule from './truth.mjs';

const loading = createModule({printErr: text => console.warn(text)});

/// Where the bytes lie from then on.
function given(module, bytes) {
    const place = module._malloc(Math.max(bytes.byteLength, 1));
    if (place === 0) throw new Error('There is not enough memory for the truth of this view.');
    new Uint8Array(module.asm.memory.buffer).set(new Uint8Array(bytes), place);
    return place;
}

function begin(module, {job, masks}) {
    const places = [given(module, job), given(module, masks)];
    try {
        const error = module.UTF8ToString(
            module._gnomon_truth_begin(places[0], job.byteLength, places[1], masks.byteLength));
        return error ? {error} : {ready: true};
    } finally {
        places.forEach(place => module._free(place));
    }
}

self.addEventListener('message', async ({data}) => {
    try {
        const module = await loading;
        if (data.job) {
            self.postMessage(begin(module, data));
        } else {
            const text = module.UTF8ToString(module._gnomon_truth_judge(data.first, data.rows));
            self.postMessage({...data, ...JSON.parse(text)});
        }
    } catch (error) {
        self.postMessage({error: `The truth cannot be traced: ${error.message}`});
    }
});
