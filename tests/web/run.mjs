// SPDX-License-Identifier: MIT
//
// Runs a test program in the browser:
//   node run.mjs --bin FOLDER --bridge FOLDER PROGRAM [--env NAME=VALUE]... [--file NAME=OUT]... [--disable FEATURE]...
// Prints what it prints; writes files that it wrote into memory to OUT; exits as it exits, with 1 for an error on the
// console, and with 77 and the reason where there is no browser.
import {renameSync, writeFileSync} from 'node:fs';
import {fileURLToPath} from 'node:url';
import path from 'node:path';

import {Browser, findChromium} from './browser.mjs';
import {serve} from './server.mjs';

const here = path.dirname(fileURLToPath(import.meta.url));
const skipped = 77;

function parse(words) {
    const options = {env: {}, files: {}, disabled: []};
    const pair = text => {
        const at = text.indexOf('=');
        return [text.slice(0, at), text.slice(at + 1)];
    };
    while (words.length > 0) {
        const word = words.shift();
        if (word === '--bin') options.bin = words.shift();
        else if (word === '--bridge') options.bridge = words.shift();
        else if (word === '--disable') options.disabled.push(words.shift());
        else if (word === '--env') { const [name, value] = pair(words.shift()); options.env[name] = value; }
        else if (word === '--file') { const [name, out] = pair(words.shift()); options.files[name] = out; }
        else options.program = word;
    }
    return options;
}

async function main() {
    const options = parse(process.argv.slice(2));
    if (!findChromium()) {
        console.log('skipped: there is no Chromium (package chromium; scripts/setup --web)');
        return skipped;
    }
    const server = await serve({'/bin/': options.bin, '/webgpu/': options.bridge, '/': here});
    const browser = await Browser.launch();
    try {
        const errors = [];
        const page = await browser.page({onConsole: (type, text) => {
            if (type === 'error') errors.push(text);
            (type === 'error' || type === 'warning' ? console.error : console.log)(text);
        }});
        await page.open(`${server.url}run.html`);
        const {status, contents, messages} = await page.evaluate(`window.run(${JSON.stringify({
            program: options.program, env: options.env, files: Object.keys(options.files),
            disabledFeatures: options.disabled,
        })})`);
        for (const [name, text] of Object.entries(contents)) {
            writeFileSync(`${options.files[name]}.new`, Buffer.from(text, 'base64'));
            renameSync(`${options.files[name]}.new`, options.files[name]);
        }
        for (const message of messages) console.error(`nobody heard: ${message}`);
        if (errors.length > 0) console.error(`${errors.length} errors on the console`);
        return status !== 0 ? status : errors.length + messages.length > 0 ? 1 : 0;
    } finally {
        await browser.close();
        await server.close();
    }
}

main().then(code => { process.exitCode = code; }, error => {
    console.error(error.message);
    process.exitCode = 1;
});
