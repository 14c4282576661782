// SPDX-License-Identifier: MIT
//
// The game's page in the browser, as somebody plays it:
//   node game.mjs --site FOLDER --out FOLDER [--frames N]
import assert from 'node:assert/strict';

import {check, claim, option} from './visitor.mjs';

const frames = Number(option('--frames', '600'));
const small = {width: 320, height: 180};
const phone = {width: 390, height: 844, scale: 1, touch: true};

// A yard with a lamp over whoever begins, in place of the courtyard: caught within half a second.
const brightYard = JSON.stringify({
    format: 'gnomon-level 1', name: 'The Bright Yard', size_m: [10, 10], player: {at: [0, 0]}, exit: {at: [4, 4]},
    seen_lux: 1, caught_after_s: 0.3, lamps: [{at: [0.5, 3, 0.5], candela: 80, range_m: 12}],
});
const inBrightYard = `const plainFetch = fetch;
    fetch = (path, ...more) => String(path).endsWith('courtyard.json')
        ? Promise.resolve(new Response(${JSON.stringify(brightYard)})) : plainFetch(path, ...more);`;

const game = (text, test, more = {}) => claim(text, test, {path: 'game.html', ...small, ...more});

/// A picture in most of its pixels, however slow the device.
async function keep(visitor, name) {
    await visitor.evaluate('gnomon.quality.add = () => false; gnomon.quality.place = 2; dispatchEvent(new Event("resize"))');
    await visitor.nextFrame();
    await visitor.keepPicture(name);
}

const screenOf = visitor => visitor.evaluate('gnomon.answer.screen');
const isOn = (visitor, screen) => visitor.until(`gnomon.answer.screen === '${screen}'`, 60);
const linesOf = visitor => visitor.evaluate("[...document.querySelectorAll('#lines .line')].map(line => line.textContent)");
const display = visitor => visitor.evaluate('gnomon.answer.display');

async function key(visitor, type, code) {
    const keys = {
        Enter: ['Enter', 13], Escape: ['Escape', 27], ArrowDown: ['ArrowDown', 40], ArrowRight: ['ArrowRight', 39],
        ShiftLeft: ['Shift', 16], KeyR: ['r', 82], KeyW: ['w', 87],
    };
    const [name, number] = keys[code];
    await visitor.page.call('Input.dispatchKeyEvent', {type, code, key: name, windowsVirtualKeyCode: number});
}

/// Down and up again, with frames between.
async function press(visitor, code) {
    await key(visitor, 'rawKeyDown', code);
    await visitor.nextFrame();
    await key(visitor, 'keyUp', code);
    await visitor.nextFrame();
}

const touch = (visitor, type, points) =>
    visitor.page.call('Input.dispatchTouchEvent', {type, touchPoints: points.map(([x, y, id = 0]) => ({x, y, id}))});

const middleOf = (visitor, selector) => visitor.evaluate(`(() => {
    const box = document.querySelector(${JSON.stringify(selector)}).getBoundingClientRect();
    return [box.x + box.width / 2, box.y + box.height / 2];
})()`);

async function tap(visitor, selector) {
    const at = await middleOf(visitor, selector);
    await touch(visitor, 'touchStart', [at]);
    await touch(visitor, 'touchEnd', []);
    await visitor.nextFrame();
}

async function play(visitor) {
    await press(visitor, 'Enter');
    await isOn(visitor, 'playing');
}

const fitsTheScreen = async visitor => {
    const fits = await visitor.evaluate('document.documentElement.scrollWidth <= innerWidth && document.documentElement.scrollHeight <= innerHeight');
    assert.ok(fits, 'it is larger than the screen');
};

game('the title is there, with the level playing behind it', async visitor => {
    assert.equal(await visitor.evaluate('document.body.dataset.failed ?? ""'), '');
    assert.equal(await screenOf(visitor), 'title');
    assert.equal(await visitor.evaluate("document.getElementById('heading').textContent"), 'GNOMON');
    assert.deepEqual(await linesOf(visitor), ['The Courtyard', 'Watch it played', 'Settings']);
    assert.equal(await visitor.note(), '');
    const before = await display(visitor);
    await visitor.until(`gnomon.answer.display.clock !== '${before.clock}'`);
    await visitor.nextFrame(4);
    await keep(visitor, 'game-title.png');
}, {width: 960, height: 540});

game('keys begin it; the first step starts the clock, and a key that is held walks', async visitor => {
    await play(visitor);
    const start = await display(visitor);
    assert.equal(start.clock, '0:00.0');
    assert.ok(await visitor.evaluate('gnomon.answer.waits'));
    await visitor.nextFrame(10);
    assert.equal((await display(visitor)).clock, '0:00.0', 'it waits');
    await key(visitor, 'rawKeyDown', 'KeyW');
    await visitor.until(`gnomon.answer.display.at[1] < ${start.at[1] - 0.5}`, 20);
    await visitor.nextFrame(5);
    await keep(visitor, 'game-play.png');
    await key(visitor, 'keyUp', 'KeyW');
    await visitor.until(`gnomon.answer.display.clock > '${(await display(visitor)).clock.slice(0, -1)}9'`, 20);
    const stood = await display(visitor);
    await visitor.nextFrame(4);
    const stands = await display(visitor);
    assert.deepEqual(stands.at, stood.at, 'who lets go stands');
    assert.notEqual(stands.clock, stood.clock);
    await press(visitor, 'KeyR');
    assert.deepEqual((await display(visitor)).at, start.at);
    assert.equal((await display(visitor)).clock, '0:00.0');
}, {width: 640, height: 360});

game('it pauses when the page loses the keyboard, and what was held is let go', async visitor => {
    await play(visitor);
    await key(visitor, 'rawKeyDown', 'KeyW');
    await visitor.until("gnomon.answer.display.clock > '0:00.3'", 20);
    await visitor.evaluate("dispatchEvent(new Event('blur'))");
    await isOn(visitor, 'paused');
    const {clock, at} = await display(visitor);
    await visitor.nextFrame(10);
    assert.equal((await display(visitor)).clock, clock);
    assert.equal(await visitor.evaluate("document.getElementById('heading').textContent"), 'PAUSED');
    assert.deepEqual(await linesOf(visitor), ['Go on', 'Once more', 'Settings', 'Back to the title']);
    await keep(visitor, 'game-paused.png');
    await press(visitor, 'Enter');
    assert.equal(await screenOf(visitor), 'playing');
    await visitor.nextFrame(12);
    const after = await display(visitor);
    assert.notEqual(after.clock, clock);
    assert.ok(Math.hypot(after.at[0] - at[0], after.at[1] - at[1]) < 0.5, 'it walks on by itself');
    await visitor.evaluate("document.getElementById('pause').click()");
    await isOn(visitor, 'paused');
    await press(visitor, 'Escape');
    assert.equal(await screenOf(visitor), 'playing');
}, {width: 660, height: 372});

game('fingers begin it, walk by a stick, run by a button and turn the camera', async visitor => {
    await fitsTheScreen(visitor);
    await keep(visitor, 'game-title-narrow.png');
    await tap(visitor, '#lines .line');
    await isOn(visitor, 'playing');
    await visitor.nextFrame(8);
    await keep(visitor, 'game-play-narrow.png');
    const start = await display(visitor);
    await touch(visitor, 'touchStart', [[90, 700]]);
    await touch(visitor, 'touchMove', [[90, 640]]);
    await visitor.until(`gnomon.answer.display.at[1] < ${start.at[1] - 0.4}`, 30);
    assert.ok(await visitor.evaluate("document.getElementById('stick').classList.contains('held')"));
    const [runX, runY] = await middleOf(visitor, '#run');
    const walked = await visitor.evaluate('gnomon.answer.display.at[1]');
    await touch(visitor, 'touchStart', [[90, 640], [runX, runY, 1]]);
    assert.ok(await visitor.evaluate("document.getElementById('run').classList.contains('held')"));
    await visitor.until(`gnomon.answer.display.at[1] < ${walked - 0.5}`, 30);
    await keep(visitor, 'game-run-narrow.png');
    await touch(visitor, 'touchEnd', []);
    await visitor.until("!document.getElementById('run').classList.contains('held')");
    const exit = await visitor.evaluate('gnomon.answer.display.exit');
    await touch(visitor, 'touchStart', [[320, 400]]);
    await touch(visitor, 'touchMove', [[220, 400]]);
    await touch(visitor, 'touchEnd', []);
    await visitor.nextFrame();
    const turned = await visitor.evaluate('gnomon.answer.display.exit');
    assert.ok(Math.hypot(turned.x - exit.x, turned.y - exit.y) > 5, 'the camera did not turn');
    await fitsTheScreen(visitor);
    await tap(visitor, '#pause');
    await isOn(visitor, 'paused');
    await keep(visitor, 'game-paused-narrow.png');
}, phone);

game('a phone on its side has all of it', async visitor => {
    await fitsTheScreen(visitor);
    await keep(visitor, 'game-title-landscape.png');
    await tap(visitor, '#lines .line');
    await isOn(visitor, 'playing');
    await touch(visitor, 'touchStart', [[120, 280]]);
    await touch(visitor, 'touchMove', [[150, 240]]);
    await visitor.until("gnomon.answer.display.clock > '0:01.0'", 30);
    await keep(visitor, 'game-play-landscape.png');
    await fitsTheScreen(visitor);
    const apart = await visitor.evaluate(`(() => {
        const boxes = ['#stick', '#sneak', '#run', '#meter', '#pause'].map(id => document.querySelector(id).getBoundingClientRect());
        return boxes.every((a, i) => a.left >= 0 && a.right <= innerWidth && a.bottom <= innerHeight &&
            boxes.every((b, k) => i >= k || i === 1 || a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top));
    })()`);
    assert.ok(apart, 'something lies on something else');
    await touch(visitor, 'touchEnd', []);
    await tap(visitor, '#pause');
    await isOn(visitor, 'paused');
    await keep(visitor, 'game-paused-landscape.png');
}, {...phone, width: 844, height: 390});

game('a gamepad begins it, walks and pauses; pulled out, it pauses as well', async visitor => {
    await visitor.evaluate('pad.buttons[0].pressed = true');
    await isOn(visitor, 'playing');
    await visitor.evaluate('pad.buttons[0].pressed = false');
    const start = await display(visitor);
    await visitor.evaluate('pad.axes[1] = -1');
    await visitor.until(`gnomon.answer.display.at[1] < ${start.at[1] - 0.3}`, 20);
    await visitor.evaluate('pad.buttons[9].pressed = true');
    await isOn(visitor, 'paused');
    await visitor.evaluate('pad.buttons[9].pressed = false; pad.axes[1] = 0');
    await visitor.nextFrame(3);
    await visitor.evaluate('pad.buttons[9].pressed = true');
    await isOn(visitor, 'playing');
    await visitor.evaluate("pad.connected = false; dispatchEvent(new Event('gamepaddisconnected'))");
    await isOn(visitor, 'paused');
}, {before: `const pad = {connected: true, mapping: 'standard', axes: [0, 0, 0, 0],
    buttons: Array.from({length: 17}, () => ({pressed: false, value: 0}))};
    navigator.getGamepads = () => [pad];`});

for (const name of ['courtyard', 'barracks', 'dockyard']) {
    game(`the recording of ${name} wins in the browser, too`, async visitor => {
        const {outcome, ticks, hash} = await visitor.evaluate("gnomon.core.obey('replay')");
        assert.equal(outcome, 'won');
        console.log(`        ${name}: ${ticks} ticks, hash ${hash}`);
    }, {path: `game.html?level=${name}`});
}

game('a recording that is watched wins, its end stands, and the title comes back', async visitor => {
    assert.equal(await screenOf(visitor), 'playing');
    assert.equal(await visitor.evaluate("document.getElementById('recording').textContent"), 'a recording');
    await visitor.until('gnomon.answer.ended', 60);
    assert.equal(await visitor.evaluate('gnomon.answer.ended.outcome'), 'won');
    await visitor.nextFrame();
    assert.equal(await visitor.evaluate("document.getElementById('heading').textContent"), 'UNSEEN');
    assert.match(await visitor.evaluate("document.getElementById('words').textContent"), /^The Courtyard in 0:22\.9/);
    await keep(visitor, 'game-watched.png');
    await isOn(visitor, 'title');
}, {path: 'game.html?replay=courtyard&speed=20', width: 640, height: 360});

game('who is caught is told by what, and begins once more', async visitor => {
    await play(visitor);
    await key(visitor, 'rawKeyDown', 'KeyW');
    await visitor.until("document.getElementById('by').textContent === 'lamp'", 20);
    await isOn(visitor, 'caught');
    await key(visitor, 'keyUp', 'KeyW');
    await visitor.nextFrame();
    assert.equal(await visitor.evaluate("document.getElementById('heading').textContent"), 'CAUGHT');
    assert.match(await visitor.evaluate("document.getElementById('words').textContent"), /^The light found you after 0:0\d\.\d\.$/);
    assert.deepEqual(await linesOf(visitor), ['Once more', 'Back to the title']);
    await keep(visitor, 'game-caught.png');
    await press(visitor, 'Enter');
    assert.equal(await screenOf(visitor), 'playing');
    assert.deepEqual((await display(visitor)).clock, '0:00.0');
    assert.equal((await display(visitor)).alarm, 0);
}, {before: inBrightYard, width: 960, height: 540});

game('with another device it goes on where it was', async visitor => {
    await play(visitor);
    await key(visitor, 'rawKeyDown', 'KeyW');
    await visitor.until("gnomon.answer.display.clock > '0:00.5'", 20);
    for (let i = 0; i < 3; ++i) {
        const {clock, at} = await display(visitor);
        await visitor.evaluate('window.lostOne = gnomon.core.bridge; gnomon.core.bridge.device.destroy()');
        await visitor.until('gnomon.core.bridge !== lostOne', 20);
        await visitor.nextFrame(5);
        const after = await display(visitor);
        assert.ok(after.clock > clock && after.at[1] < at[1], 'it does not go on');
        assert.ok(Math.abs(after.at[1] - at[1]) < 4, 'it began anew');
    }
    assert.equal(await visitor.note(), '');
    await key(visitor, 'keyUp', 'KeyW');
    await keep(visitor, 'game-after-loss.png');
});

game('settings are remembered', async visitor => {
    await press(visitor, 'ArrowDown');
    await press(visitor, 'ArrowDown');
    await press(visitor, 'Enter');
    await isOn(visitor, 'settings');
    await press(visitor, 'ArrowDown');
    await press(visitor, 'ArrowRight');
    const value = "document.querySelectorAll('#lines .value')[1].textContent";
    assert.equal(await visitor.evaluate(value), '1');
    await keep(visitor, 'game-settings.png');
    await press(visitor, 'Escape');
    await isOn(visitor, 'title');
    assert.equal(await visitor.evaluate('gnomon.answer.figures.samples'), 1);
    await visitor.page.open(`${visitor.url}game.html`);
    await visitor.until('document.body.dataset.frames > 0');
    assert.equal(await visitor.evaluate('gnomon.answer.figures.samples'), 1);
    await visitor.evaluate("localStorage.setItem('gnomon-game', '{broken')");
    await visitor.page.open(`${visitor.url}game.html`);
    await visitor.until('document.body.dataset.frames > 0');
    assert.match(await visitor.note(), /^The settings that this browser has kept: the JSON is broken.*\.$/);
    await visitor.evaluate('localStorage.clear()');
}, {width: 760, height: 430});

game('a slow device is given fewer pixels, and a quick one all of them again', async visitor => {
    const [slow, quick, steady] = await visitor.evaluate(`(async () => {
        const {Quality} = await import('./game-quality.js');
        const after = (quality, ms, times) => { for (let i = 0; i < times; ++i) quality.add(ms); return quality.now; };
        const quality = new Quality();
        return [after(quality, 200, 200), after(quality, 4, 2000), after(quality, 16, 500)];
    })()`);
    assert.ok(slow.share < 0.4 && slow.samples === 1, JSON.stringify(slow));
    assert.deepEqual(quick, {share: 1, samples: 4});
    assert.deepEqual(steady, quick);
    // And what it says is done.
    await visitor.evaluate(`gnomon.quality.step(9); gnomon.quality.add = () => false; dispatchEvent(new Event('resize'))`);
    await visitor.until('gnomon.answer.figures.width === 109', 20);
    assert.equal(await visitor.evaluate('gnomon.answer.figures.samples'), 1);
});

game('who wants nothing to move sees a title that keeps still', async visitor => {
    await visitor.page.call('Emulation.setEmulatedMedia', {features: [{name: 'prefers-reduced-motion', value: 'reduce'}]});
    await visitor.page.open(`${visitor.url}game.html`);
    await visitor.until('document.body.dataset.frames > 0');
    const {clock} = await display(visitor);
    await visitor.evaluate('new Promise(resolve => setTimeout(resolve, 400))');
    assert.equal((await display(visitor)).clock, clock);
    await play(visitor);
    assert.equal(await screenOf(visitor), 'playing');
});

game(`memory is steady over ${frames} frames`, async visitor => {
    const beginAnew = () => visitor.evaluate("gnomon.core.obey('watch')");
    await visitor.evaluate('gnomon.quality.add = () => false');
    // All that the level shows once, and then once more, while what was there before is still there.
    for (let i = 0; i < 2; ++i) {
        await isOn(visitor, 'title');
        await beginAnew();
        await visitor.nextFrame();
    }
    const measure = () => visitor.evaluate(`({
        memory: gnomon.core.module.asm.memory.buffer.byteLength,
        objects: Object.values(gnomon.core.bridge.objects).reduce((n, table) => n + table.filter(o => o).length, 0),
        places: Object.values(gnomon.core.bridge.objects).reduce((n, table) => n + table.length, 0),
    })`);
    const begin = await visitor.evaluate('Number(document.body.dataset.frames)');
    let early = null;
    for (let part = 1; part <= 4; ++part) {
        await visitor.until(`document.body.dataset.frames > ${begin + frames * part / 4}`, 120);
        early ??= await measure();
        await beginAnew();
        await visitor.nextFrame(3);
    }
    assert.deepEqual(await measure(), early);
}, {path: 'game.html?replay=courtyard&speed=6', width: 160, height: 90});

game('a level that is none is one sentence', async visitor => {
    assert.equal(await visitor.note(), 'There is no level "cellar"; there are courtyard, barracks, dockyard.');
}, {path: 'game.html?level=cellar'});

game('without WebGPU it says so', async visitor => {
    assert.match(await visitor.note(), /^WebGPU is missing: .*\.$/);
    await visitor.keepPicture('game-without-webgpu.png');
}, {before: "Object.defineProperty(navigator, 'gpu', {value: undefined})"});

game('without depth32float-stencil8 it says what is missing', async visitor => {
    assert.match(await visitor.note(), /lacks depth32float-stencil8.*\.$/);
}, {path: 'game.html?without=depth32float-stencil8'});

check();
