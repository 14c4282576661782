// SPDX-License-Identifier: MIT
//
// The C++ half (viewer.hpp says which orders there are) as an object: orders one after another, since the core is in the
// middle of one while it waits for the device.
import {canWait, createBridge} from './bridge.js';
import createModule from './gnomon.mjs';

export class Core {
    /// Throws an Error of one sentence where the browser cannot do it.
    static async create({canvas, disabledFeatures = []}) {
        const bridge = await createBridge({canvas, disabledFeatures});
        const module = await createModule({
            gnomonBridge: bridge,
            print: text => console.log(text),
            printErr: text => console.warn(text),
        });
        return new Core(module, bridge);
    }

    constructor(module, bridge) {
        this.module = module;
        this.bridge = bridge;
        this.last = Promise.resolve();
        this.call = canWait() ? bridge.waiting(module.asm.gnomon_web_obey) : module.asm.gnomon_web_obey;
        this.waits = canWait();
    }

    /// The answer to an order; throws the sentence of its error.
    obey(what, order = {}) {
        const answer = this.last.then(() => this.obeyNow({...order, do: what}));
        this.last = answer.catch(() => {});
        return answer;
    }

    async obeyNow(order) {
        const {module} = this;
        const text = JSON.stringify(order);
        const size = module.lengthBytesUTF8(text) + 1;
        const place = module._malloc(size);
        try {
            module.stringToUTF8(text, place, size);
            const answer = JSON.parse(module.UTF8ToString(await this.call(place)));
            if (answer.error) throw new Error(answer.error);
            return answer;
        } finally {
            module._free(place);
        }
    }

    /// A file that the page was given, under a name that "load" takes.
    keepFile(name, bytes) {
        const path = `/given/${name.replaceAll('/', '_')}`;
        if (!this.module.FS.analyzePath('/given').exists) this.module.FS.mkdir('/given');
        for (const old of this.module.FS.readdir('/given')) {
            if (!old.startsWith('.')) this.module.FS.unlink(`/given/${old}`);
        }
        this.module.FS.writeFile(path, bytes);
        return path;
    }
}
