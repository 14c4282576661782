// SPDX-License-Identifier: MIT
//
// The link between emscripten_bridge.cpp and bridge.js, for Emscripten's linker (--js-library): each import is a method
// of Module.gnomonBridge, which the page has made. What waits is suspended by the browser (JavaScript Promise
// Integration), so that nothing has to be instrumented and calls that do not wait cost what they cost.
mergeInto(LibraryManager.library, {
    gnomon_webgpu_text: function(which, out) {
        // 0: what the device can do; 1: the last error; 2: the oldest message, which is then forgotten.
        var bridge = Module['gnomonBridge'];
        if (!bridge) return 0;
        if (out === 0) {
            var text = which === 0 ? JSON.stringify(bridge.describe()) : which === 1 ? bridge.error : bridge.messages.shift();
            bridge.encoded = new TextEncoder().encode(text || '');
        } else {
            HEAPU8.set(bridge.encoded, out);
        }
        return bridge.encoded.length;
    },
    gnomon_webgpu_create: function(kind, index, text, length) {
        return Module['gnomonBridge'].create(kind, index, new TextDecoder().decode(HEAPU8.subarray(text, text + length)));
    },
    gnomon_webgpu_destroy: function(kind, index) { Module['gnomonBridge'].destroy(kind, index); },
    gnomon_webgpu_write_buffer: function(index, offset, data, size) {
        return Module['gnomonBridge'].writeBuffer(index, offset, HEAPU8.buffer, data, size);
    },
    gnomon_webgpu_write_texture: function(index, mip_level, data, size) {
        return Module['gnomonBridge'].writeTexture(index, mip_level, HEAPU8.buffer, data, size);
    },
    gnomon_webgpu_submit: function(words, count) {
        return Module['gnomonBridge'].submit(HEAPU8.buffer, words, count);
    },
    gnomon_webgpu_present: function(index) { return Module['gnomonBridge'].present(index); },

    gnomon_webgpu_read_buffer: function(index, offset, out, size) {
        return Module['gnomonBridge'].readBuffer(index, offset, function() { return HEAPU8.buffer; }, out, size);
    },
    gnomon_webgpu_read_texture: function(index, aspect, out, size) {
        return Module['gnomonBridge'].readTexture(index, aspect, function() { return HEAPU8.buffer; }, out, size);
    },
    gnomon_webgpu_read_query_set: function(index, out) {
        return Module['gnomonBridge'].readQuerySet(index, function() { return HEAPU8.buffer; }, out);
    },
    gnomon_webgpu_wait_idle: function() { return Module['gnomonBridge'].waitIdle(); },

    $gnomonWebGPUSuspending__postset:
        "if (typeof WebAssembly.Suspending === 'function') {" +
        '  _gnomon_webgpu_read_buffer = new WebAssembly.Suspending(_gnomon_webgpu_read_buffer);' +
        '  _gnomon_webgpu_read_texture = new WebAssembly.Suspending(_gnomon_webgpu_read_texture);' +
        '  _gnomon_webgpu_read_query_set = new WebAssembly.Suspending(_gnomon_webgpu_read_query_set);' +
        '  _gnomon_webgpu_wait_idle = new WebAssembly.Suspending(_gnomon_webgpu_wait_idle);' +
        '}',
    $gnomonWebGPUSuspending__deps: ['gnomon_webgpu_read_buffer', 'gnomon_webgpu_read_texture',
                                    'gnomon_webgpu_read_query_set', 'gnomon_webgpu_wait_idle'],
    $gnomonWebGPUSuspending: {},
    gnomon_webgpu_text__deps: ['$gnomonWebGPUSuspending'],
});
