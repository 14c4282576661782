// SPDX-License-Identifier: MIT
//
// Drives Debian's Chromium, headless, by the DevTools protocol over a pipe: tests need a page, its console and its
// results, and nothing that would have to be downloaded. It is not a library for browsers in general.
import {spawn} from 'node:child_process';
import {existsSync, mkdtempSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import path from 'node:path';

const candidates = [process.env.GNOMON_CHROMIUM, '/usr/bin/chromium', '/usr/bin/chromium-browser'];

/// The browser's program, or null where there is none.
export function findChromium() { return candidates.find(program => program && existsSync(program)) ?? null; }

// SwiftShader draws, so that pictures are the same on all machines; its Vulkan driver ships with Chromium. WebGPU's
// canvases reach the page only where the page is composed by Vulkan as well.
const flags = [
    '--headless=new', '--remote-debugging-pipe', '--no-first-run', '--no-default-browser-check',
    '--disable-background-networking', '--disable-component-update', '--disable-sync', '--mute-audio',
    '--enable-unsafe-webgpu', '--use-webgpu-adapter=swiftshader',
    '--enable-features=Vulkan', '--use-vulkan=swiftshader', '--use-gl=angle', '--use-angle=vulkan',
    '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist', '--enable-gpu-rasterization', '--hide-scrollbars',
];

export class Browser {
    /// `options`: more flags; timeout of a call in milliseconds.
    static async launch({program = findChromium(), more = [], timeout = 600_000} = {}) {
        const profile = mkdtempSync(path.join(tmpdir(), 'gnomon-browser-'));
        const asRoot = process.getuid?.() === 0 ? ['--no-sandbox'] : [];
        const child = spawn(program, [...flags, ...asRoot, ...more, `--user-data-dir=${profile}`, 'about:blank'],
                            {stdio: ['ignore', 'ignore', 'pipe', 'pipe', 'pipe']});
        return new Browser(child, profile, timeout);
    }

    constructor(child, profile, timeout) {
        this.child = child;
        this.profile = profile;
        this.timeout = timeout;
        this.waiting = new Map();
        this.listeners = [];
        this.last = 0;
        this.said = '';
        child.stderr.on('data', text => { this.said = (this.said + text).slice(-4000); });
        let rest = Buffer.alloc(0);
        child.stdio[4].on('data', piece => {
            rest = Buffer.concat([rest, piece]);
            for (let end = rest.indexOf(0); end >= 0; end = rest.indexOf(0)) {
                this.receive(JSON.parse(rest.subarray(0, end).toString()));
                rest = rest.subarray(end + 1);
            }
        });
        this.ended = new Promise(resolve => child.on('exit', resolve));
        this.ended.then(code => {
            for (const {reject} of this.waiting.values()) {
                reject(new Error(`Chromium ended (${code}). It said: ${this.said}`));
            }
        });
    }

    receive(message) {
        if (message.id === undefined) {
            for (const listener of this.listeners) listener(message);
            return;
        }
        const {resolve, reject} = this.waiting.get(message.id);
        this.waiting.delete(message.id);
        if (message.error) reject(new Error(`${message.error.message}: ${message.error.data ?? ''}`));
        else resolve(message.result);
    }

    call(method, params = {}, sessionId = undefined) {
        const id = ++this.last;
        return new Promise((resolve, reject) => {
            const timer = setTimeout(() => reject(new Error(`${method} took longer than ${this.timeout} ms`)), this.timeout);
            const done = settle => value => { clearTimeout(timer); settle(value); };
            this.waiting.set(id, {resolve: done(resolve), reject: done(reject)});
            this.child.stdio[3].write(JSON.stringify({id, method, params, sessionId}) + '\0');
        });
    }

    /// A page of `width` times `height` pixels. `onConsole(type, text)` hears what its console and its errors say.
    async page({width = 1280, height = 720, scale = 1, touch = false, onConsole = () => {}} = {}) {
        const {targetId} = await this.call('Target.createTarget', {url: 'about:blank'});
        const {sessionId} = await this.call('Target.attachToTarget', {targetId, flatten: true});
        const page = new Page(this, sessionId);
        this.listeners.push(message => { if (message.sessionId === sessionId) page.receive(message, onConsole); });
        await page.call('Page.enable');
        await page.call('Runtime.enable');
        await page.call('Log.enable');
        await page.call('Emulation.setDeviceMetricsOverride', {width, height, deviceScaleFactor: scale, mobile: touch});
        if (touch) await page.call('Emulation.setTouchEmulationEnabled', {enabled: true});
        return page;
    }

    async close() {
        this.call('Browser.close').catch(() => {});
        const timer = setTimeout(() => this.child.kill('SIGKILL'), 5000);
        await this.ended;
        clearTimeout(timer);
        rmSync(this.profile, {recursive: true, force: true, maxRetries: 5});
    }
}

export class Page {
    constructor(browser, sessionId) {
        this.browser = browser;
        this.sessionId = sessionId;
        this.events = [];
    }

    call(method, params) { return this.browser.call(method, params, this.sessionId); }

    receive({method, params}, onConsole) {
        if (method === 'Runtime.consoleAPICalled') {
            onConsole(params.type, params.args.map(a => a.value ?? a.description ?? '').join(' '));
        } else if (method === 'Runtime.exceptionThrown') {
            const {exception, text} = params.exceptionDetails;
            onConsole('error', exception?.description ?? text);
        } else if (method === 'Log.entryAdded' && params.entry.level === 'error') {
            onConsole('error', `${params.entry.text} ${params.entry.url ?? ''}`);
        }
        this.events = this.events.filter(event => !(event.method === method && (event.resolve(params), true)));
    }

    event(method) { return new Promise(resolve => this.events.push({method, resolve})); }

    async open(url) {
        const loaded = this.event('Page.loadEventFired');
        const {errorText} = await this.call('Page.navigate', {url});
        if (errorText) throw new Error(`${url}: ${errorText}`);
        await loaded;
    }

    /// What an expression comes to, promises waited for.
    async evaluate(expression) {
        const {result, exceptionDetails} = await this.call(
            'Runtime.evaluate', {expression, awaitPromise: true, returnByValue: true, userGesture: true});
        if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
        return result.value;
    }

    /// The page as PNG.
    async screenshot() {
        const {data} = await this.call('Page.captureScreenshot', {format: 'png'});
        return Buffer.from(data, 'base64');
    }

    mouse(type, x, y, more = {}) {
        return this.call('Input.dispatchMouseEvent', {type, x, y, button: 'left', clickCount: 1, ...more});
    }
}
