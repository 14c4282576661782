// SPDX-License-Identifier: MIT
//
// A page in the browser, as somebody uses it, and what is claimed of it: each claim is a line of the output, and has a visit
// of its own. Exits with 1 where a claim does not hold or the console has an error, and with 77 and the reason where there is
// no browser.
//   node FILE --site FOLDER --out FOLDER [--only TEXT]
// Pictures of the page go to --out, to be looked at. --only takes the claims that have TEXT in them.
import assert from 'node:assert/strict';
import {mkdirSync, writeFileSync} from 'node:fs';
import path from 'node:path';

import {Browser, findChromium} from './browser.mjs';
import {serve} from './server.mjs';

const skipped = 77;

/// Leads here as well (`host` of a claim).
export const otherHost = 'gnomon.test';

/// What follows `name` among the arguments.
export function option(name, otherwise) {
    const at = process.argv.indexOf(name);
    return at < 0 ? otherwise : process.argv[at + 1];
}

const site = option('--site');
const out = option('--out');

class Visitor {
    constructor(browser, url) {
        this.browser = browser;
        this.url = url;
        this.errors = [];
    }

    async come(more = {}) {
        this.page = await this.browser.page({...more, onConsole: (type, text) => {
            if (type === 'error') this.errors.push(text);
        }});
        if (more.before) await this.page.call('Page.addScriptToEvaluateOnNewDocument', {source: more.before});
        const url = more.host ? this.url.replace('127.0.0.1', more.host) : this.url;
        await this.page.open(url + (more.path ?? ''));
        await this.until('document.body.dataset.frames > 0 || document.body.dataset.failed');
    }

    evaluate(expression) { return this.page.evaluate(expression); }

    async until(expression, seconds = 120) {
        await this.evaluate(`new Promise((resolve, reject) => {
            const begin = performance.now();
            const look = () => {
                if (${expression}) resolve();
                else if (performance.now() - begin > ${seconds * 1000}) reject(new Error(${JSON.stringify(expression)} + ' does not come true'));
                else setTimeout(look, 20);
            };
            look();
        })`);
    }

    /// The figures of a frame that is drawn from now on.
    async nextFrame(times = 2) {
        const now = await this.evaluate('Number(document.body.dataset.frames)');
        await this.evaluate('gnomon.dirty = true');
        for (let i = 1; i <= times; ++i) {
            await this.until(`document.body.dataset.frames >= ${now + i}`);
            await this.evaluate('gnomon.dirty = true');
        }
        return this.figures();
    }

    figures() {
        return this.evaluate(`Object.fromEntries([...document.querySelectorAll('#figures dt')].map(
            term => [term.textContent, term.nextElementSibling.textContent]))`);
    }

    note() { return this.evaluate("document.getElementById('note').hidden ? '' : document.getElementById('note').textContent"); }

    /// Does what a control does, and waits for what comes of it.
    async choose(id, value) {
        await this.evaluate(`(() => {
            const element = document.getElementById(${JSON.stringify(id)});
            if (element.type === 'checkbox') element.checked = ${JSON.stringify(value)};
            else element.value = ${JSON.stringify(value)};
            element.dispatchEvent(new Event('change'));
        })()`);
        await this.evaluate('gnomon.core.last');
        return this.nextFrame();
    }

    async keepPicture(name) {
        mkdirSync(out, {recursive: true});
        writeFileSync(path.join(out, name), await this.page.screenshot());
    }

    async leave() { await this.page.call('Page.close'); }
}

const claims = [];

/// `test` gets the visitor of a page that has drawn or failed. `more`: path (of the page in the site, with its query), width,
/// height, scale, touch, `before`, a script that runs before the page's own, and `host`, by which it is served: one that
/// browsers do not trust as they trust this machine.
export function claim(text, test, more = {}) {
    claims.push({text, test, more});
}

async function checkAll() {
    if (!findChromium()) {
        console.log('skipped: there is no Chromium (package chromium; scripts/setup --web)');
        return skipped;
    }
    const server = await serve({'/': site});
    const browser = await Browser.launch({timeout: 660_000, more: [`--host-resolver-rules=MAP ${otherHost} 127.0.0.1`]});
    let failed = 0;
    try {
        const only = option('--only', '');
        for (const {text, test, more} of claims.filter(claim => claim.text.includes(only))) {
            const visitor = new Visitor(browser, server.url);
            const begin = performance.now();
            try {
                // Small, since a processor draws; the panel is beside the picture from 720 on.
                await visitor.come({width: 760, height: 360, ...more});
                await test(visitor);
                assert.deepEqual(visitor.errors, [], 'errors on the console');
                console.log(`ok      ${text} (${((performance.now() - begin) / 1000).toFixed(1)} s)`);
            } catch (error) {
                ++failed;
                console.log(`FAILED  ${text}: ${error.message}`);
                if (visitor.errors.length > 0) console.log(`        console: ${visitor.errors.join('; ')}`);
            }
            await visitor.leave().catch(() => {});
        }
    } finally {
        await browser.close();
        await server.close();
    }
    return failed > 0 ? 1 : 0;
}

/// Checks what was claimed.
export function check() {
    checkAll().then(code => { process.exitCode = code; }, error => {
        console.error(error.message);
        process.exitCode = 1;
    });
}
