// SPDX-License-Identifier: MIT
//
// What callers hand over, looked at before anything is done with it. Each function gives what it was given in the form that is
// wanted, or throws a TypeError (it is something else) or a RangeError (it is beyond a limit) of one sentence, which names the
// place, the value and what would be right.

/// A value in a few words.
export function words(value) {
    if (value === null || value === undefined) return String(value);
    if (typeof value === 'string') return JSON.stringify(value);
    if (typeof value === 'function') return 'a function';
    if (typeof value !== 'object') return String(value);
    const name = value.constructor?.name ?? 'object';
    return typeof value.length === 'number' ? `${name} of ${value.length}` : `${/^[AEIOU]/.test(name) ? 'an' : 'a'} ${name}`;
}

/// An object of options, none of which is unknown: a misspelt one would go unnoticed.
export function options(value, known, place) {
    if (value === null || typeof value !== 'object') throw new TypeError(`${place} takes an object, not ${words(value)}.`);
    const unknown = Object.keys(value).find(name => !known.includes(name));
    if (unknown !== undefined) throw new TypeError(`${place} knows no "${unknown}": it takes ${known.join(', ')}.`);
    return value;
}

export function boolean(value, place) {
    if (typeof value !== 'boolean') throw new TypeError(`${place} is ${words(value)} instead of true or false.`);
    return value;
}

export function number(value, place, {min = -Infinity, max = Infinity} = {}) {
    if (typeof value !== 'number') throw new TypeError(`${place} is ${words(value)} instead of a number.`);
    if (!(value >= min && value <= max)) throw new RangeError(`${place} is ${value}, which is not within ${min} and ${max}.`);
    return value;
}

function numbers(value, count, place) {
    if (!Array.isArray(value) && !(ArrayBuffer.isView(value) && 'length' in value)) {
        throw new TypeError(`${place} is ${words(value)} instead of an array of ${count} numbers.`);
    }
    if (value.length !== count) throw new RangeError(`${place} has ${value.length} numbers instead of ${count}.`);
    for (let i = 0; i < count; ++i) {
        if (!Number.isFinite(value[i])) throw new RangeError(`${place}[${i}] is ${words(value[i])}, which is no finite number.`);
    }
    return value;
}

export function vector(value, place) { return numbers(value, 3, place); }

/// Column by column.
export function matrix(value, place) { return numbers(value, 16, place); }

/// One whose last row is 0, 0, 0, 1.
export function pose(value, place) {
    const m = matrix(value, place);
    if (m[3] !== 0 || m[7] !== 0 || m[11] !== 0 || m[15] !== 1) {
        throw new RangeError(`${place} has the last row ${m[3]}, ${m[7]}, ${m[11]}, ${m[15]} instead of 0, 0, 0, 1: it is to ` +
                             'hold its columns one after another, and no projection.');
    }
    return m;
}

/// Three floats a vertex.
export function positions(value, place) {
    if (!(value instanceof Float32Array)) throw new TypeError(`${place} is ${words(value)} instead of a Float32Array.`);
    if (value.length % 3 !== 0) throw new RangeError(`${place} has ${value.length} floats, which are not three a vertex.`);
    return value;
}

/// As a Uint32Array; all vertices in their order where there are none.
export function indices(value, vertices, place) {
    if (value === undefined || value === null) return Uint32Array.from({length: vertices}, (_, i) => i);
    if (value instanceof Uint32Array) return value;
    if (value instanceof Uint16Array) return new Uint32Array(value);
    throw new TypeError(`${place} is ${words(value)} instead of a Uint32Array or a Uint16Array.`);
}

export function identities(value, vertices, place) {
    if (value === undefined || value === null) return null;
    if (!(value instanceof Uint32Array)) throw new TypeError(`${place} is ${words(value)} instead of a Uint32Array.`);
    if (value.length !== vertices) throw new RangeError(`${place} has ${value.length} numbers for ${vertices} vertices.`);
    return value;
}

export function device(value, place) {
    if (typeof value?.createCommandEncoder !== 'function' || !value.features || !value.queue) {
        throw new TypeError(`${place} takes a GPUDevice, not ${words(value)}.`);
    }
    return value;
}

export function encoder(value, place) {
    if (value === undefined || value === null) return null;
    if (typeof value.beginRenderPass !== 'function') {
        throw new TypeError(`${place} is ${words(value)} instead of a GPUCommandEncoder.`);
    }
    return value;
}
