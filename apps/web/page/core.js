// SPDX-License-Identifier: MIT
//
// The C++ half (viewer.hpp and game/game.hpp say which orders there are) as an object: orders one after another, since the
// core is in the middle of one while it waits for the device.
import {canWait, createBridge} from './bridge.js';

export class Core {
    /// `program`: the module that obeys. Throws an Error of one sentence where the browser cannot do it.
    static async create({canvas, disabledFeatures = [], program = './gnomon.mjs'}) {
        // Neither needs the other until the first order.
        const making = import(program).then(({default: createModule}) => createModule(
            {print: text => console.log(text), printErr: text => console.warn(text)}));
        making.catch(() => {});  // heard below, or nobody's business where there is no device
        const bridge = await createBridge({canvas, disabledFeatures});
        const module = await making.catch(error => {
            throw new Error(`The page's program does not load: ${error.message.replace(/\.$/, '')}.`);
        });
        return new Core(module, bridge, {canvas, disabledFeatures});
    }

    constructor(module, bridge, options) {
        this.module = module;
        this.options = options;
        this.last = Promise.resolve();
        this.waits = canWait();
        this.attach(bridge);
    }

    attach(bridge) {
        this.bridge = bridge;
        this.module.gnomonBridge = bridge;
        const {gnomon_web_obey} = this.module.asm;
        this.call = this.waits ? bridge.waiting(gnomon_web_obey) : gnomon_web_obey;
    }

    /// The answer to an order; throws the sentence of its error. Its member `bytes`, where it has one, holds copies.
    obey(what, order = {}) { return this.afterwards(() => this.obeyNow({...order, do: what})); }

    /// Goes on with a new device, with all that the core knows, after the old one was lost. The answer of "start"; throws
    /// as create() does.
    renew() {
        return this.afterwards(async () => {
            await this.obeyNow({do: 'stop'});  // while what it lets go of is still the old bridge's
            this.attach(await createBridge(this.options));
            return this.obeyNow({do: 'start'});
        });
    }

    afterwards(action) {
        const done = this.last.then(action);
        this.last = done.catch(() => {});
        return done;
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
            for (const name in answer.bytes) {
                const [at, length] = answer.bytes[name];
                answer.bytes[name] = module.asm.memory.buffer.slice(at, at + length);
            }
            return answer;
        } finally {
            module._free(place);
        }
    }

    /// The answer of "load": of a source that the core knows, or of a File of the visitor's, of which no copy stays.
    load({source, file}) {
        if (!file) return this.obey('load', {source});
        return this.afterwards(async () => {
            const bytes = await file.arrayBuffer().catch(error => {
                throw new Error(`${file.name} cannot be read: ${error.message.replace(/\.$/, '')}.`);
            });
            const {FS} = this.module;
            const path = `/given/${file.name.replaceAll('/', '_')}`;  // its name is in what the core says of it
            if (!FS.analyzePath('/given').exists) FS.mkdir('/given');
            FS.writeFile(path, new Uint8Array(bytes));
            try {
                return await this.obeyNow({do: 'load', source: path});
            } finally {
                FS.unlink(path);
            }
        });
    }
}
