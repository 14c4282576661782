// SPDX-License-Identifier: MIT
//
// The page: what is clicked, dragged and dropped becomes orders for the core, and its answers become text.
import {Check} from './check.js';
import {Core} from './core.js';
import {listenToFiles} from './files.js';
import {listenToKeys, listenToPointers} from './pointers.js';

const byId = id => document.getElementById(id);
const canvas = byId('canvas');
const stage = byId('stage');

const overlayNames = {
    volumes: 'volumes', silhouettes: 'silhouettes', caps: 'caps', wireframe: 'wireframe', count: 'counts', fill: 'fill',
};
const demos = ['pillars', 'still-life', 'room', 'walk'];  // the first one is seen first; its light can be caught
const mostPixels = 4096 * 2304;

const state = {
    core: null,
    check: null,
    dirty: true,           // something changed since the last frame
    turning: false,
    playing: true,
    animated: false,
    last: 0,               // when the last frame began
    over: false,           // there is no device now
    losses: [],            // when devices were lost
    wanted: null,          // the scene that was asked for last, until it is there: {name, source or file}
    shown: null,           // likewise, of what is there
    figures: null,         // of the last frame
    width: 0,              // of the picture, in pixels
    height: 0,
    ratio: 0,              // of the screen's pixels to the page's, when the picture got its size
};

let begin;
const started = new Promise(resolve => { begin = resolve; });  // there is a core, and it has a scene to load

function say(text) {
    const note = byId('note');
    note.hidden = !text;
    if (note.textContent !== text) note.textContent = text;
}

/// What was found of the view stays true: each technique is checked, and debug views are drawn over it.
function leavesTheView(what, details) {
    const unseen = ['overlays', 'technique'];
    return what === 'press' || what === 'release' ||
        (what === 'options' && Object.keys(details).every(name => unseen.includes(name)));
}

/// Orders one thing of the core and draws; what goes wrong is said.
async function order(what, details) {
    if (!leavesTheView(what, details)) state.check.viewChanged();
    try {
        const answer = await state.core.obey(what, details);
        state.dirty = true;
        return answer;
    } catch (error) {
        say(error.message);
        return null;
    }
}

/// What is asked for last is what is there in the end; where that fails, what was there before.
async function load(wanted) {
    state.wanted = wanted;
    state.check.setLoading(true);
    say(`Loading ${wanted.name} …`);
    let sentence = '';
    try {
        const answer = await state.core.load(wanted);
        const first = !state.shown;
        state.check.viewChanged();
        state.shown = wanted;
        state.dirty = true;
        state.animated = answer.animated;
        byId('play').hidden = !answer.animated;
        const lights = answer.lights.length;
        byId('facts').textContent = `${answer.triangles.toLocaleString('en')} triangles, ` +
            `${lights} ${lights === 1 ? 'light' : 'lights'}`;
        showMarks(answer.lights);
        if (first && byId('samples').checked) await order('options', {samples: 4});
        sentence = answer.messages[0] ?? '';
    } catch (error) {
        if (state.over || state.core.bridge.lost) return;  // the next device gets it
        sentence = error.message;
    }
    if (state.wanted !== wanted) return;
    state.wanted = null;
    state.check.setLoading(false);
    say(sentence);
    if (state.shown) showName(state.shown);
}

/// The box names what is there: one of the scenes, or the visitor's file, which it has for as long.
function showName({name, file}) {
    const select = byId('scene');
    select.querySelector('.given')?.remove();
    if (file) {
        const option = new Option(name, name);
        option.className = 'given';
        select.prepend(option);
    }
    select.value = name;
}

/// Pixels of the picture a pixel of the page.
const scale = () => state.width / Math.max(1, stage.clientWidth);

function wantedScale() {
    const wanted = Math.min(window.devicePixelRatio || 1, 2);
    const pixels = stage.clientWidth * stage.clientHeight * wanted * wanted;
    return pixels > mostPixels ? wanted * Math.sqrt(mostPixels / pixels) : wanted;
}

async function fit() {
    state.ratio = window.devicePixelRatio;
    const wanted = wantedScale();
    const width = Math.max(1, Math.round(stage.clientWidth * wanted));
    const height = Math.max(1, Math.round(stage.clientHeight * wanted));
    if (width === state.width && height === state.height) return;
    Object.assign(state, {width, height});
    await order('size', {width, height});
}

// Drawing

const milliseconds = value => `${value.toFixed(value < 10 ? 2 : 1)} ms`;

function showFigures(figures) {
    const rows = [
        [state.core.waits ? 'frame' : 'frame, without the device', milliseconds(figures.frame_ms)],
        ['silhouettes found', milliseconds(figures.detect_ms)],
        ['volumes built', milliseconds(figures.build_ms)],
        ['commands recorded', milliseconds(figures.record_ms)],
        [state.core.waits ? 'device' : 'submitted', milliseconds(figures.device_ms)],
        ['pairs', figures.pairs],
        ['found anew', figures.pairs_redetected],
        ['kept', figures.pairs_reused],
        ['left out', figures.pairs_culled],
        ['depth-pass, depth-fail', `${figures.zpass_pairs}, ${figures.zfail_pairs}`],
        ['silhouette edges', figures.silhouette_edges.toLocaleString('en')],
        ['uploaded', `${(figures.upload_bytes / 1024).toFixed(1)} KiB`],
        ['draw calls', figures.draw_calls],
    ];
    byId('figures').replaceChildren(...rows.flatMap(([name, value]) => {
        const term = document.createElement('dt');
        term.textContent = name;
        const data = document.createElement('dd');
        data.textContent = value;
        return [term, data];
    }));
    figures.lights.forEach((light, place) => {
        const mark = byId('marks').children[place];
        // What is beside the picture is not to be seen, so neither to be focused.
        mark.hidden = !light || light.x < 0 || light.x > state.width || light.y < 0 || light.y > state.height;
        if (mark.hidden) return;
        mark.className = light.sun ? 'sun' : 'lamp';
        mark.style.left = `${100 * light.x / state.width}%`;
        mark.style.top = `${100 * light.y / state.height}%`;
    });
}

/// One for each light, hidden until it is known where it is.
function showMarks(lights) {
    byId('marks').replaceChildren(...lights.map(({name}) => {
        const mark = document.createElement('i');
        mark.hidden = true;
        mark.tabIndex = 0;
        mark.setAttribute('role', 'application');
        mark.setAttribute('aria-label', `Light ${name}. Arrows move it, with Shift along the ground.`);
        return mark;
    }));
}

async function frame(now) {
    const seconds = Math.min((now - state.last) / 1000, 0.1);
    state.last = now;
    // A screen of another resolution may leave the stage as large as it was.
    if (window.devicePixelRatio !== state.ratio) fit();
    const moving = isMoving();
    if (!state.over && (state.dirty || moving)) {
        state.dirty = false;
        if (moving) state.check.viewChanged();
        try {
            if (state.turning) await state.core.obey('turn', {yaw_deg: 30 * seconds});
            const figures = await state.core.obey(
                'draw', {seconds: state.animated && state.playing ? seconds : 0, wait: state.core.waits});
            state.figures = figures;
            showFigures(figures);
            document.body.dataset.startMs ??= Math.round(performance.now());
            document.body.dataset.frames = Number(document.body.dataset.frames ?? 0) + 1;
        } catch (error) {
            if (!state.over) say(error.message);
        }
    }
    requestAnimationFrame(frame);
}

const isMoving = () => state.turning || (state.animated && state.playing);

/// Whatever moves stands still, as if its button had been pressed.
function freeze() {
    for (const id of ['turn', 'play']) {
        if (byId(id).getAttribute('aria-pressed') === 'true' && !byId(id).hidden) byId(id).click();
    }
}

async function savePicture() {
    // A canvas holds its picture until the frame is over, so it is drawn and taken at once.
    await state.core.obey('draw', {wait: false});
    const blob = await new Promise(resolve => canvas.toBlob(resolve, 'image/png'));
    const link = document.createElement('a');
    link.href = URL.createObjectURL(blob);
    link.download = 'gnomon.png';
    link.click();
    URL.revokeObjectURL(link.href);
}

// Files

async function open(file) {
    await started;
    if (!file.name.toLowerCase().endsWith('.glb')) {
        say(`${file.name} is no .glb: a page can read models of one file only.`);
        return;
    }
    await load({name: file.name, file});
}

const builtin = name => ({name, source: `builtin:${name}`});

function listenToControls(scenes) {
    const select = byId('scene');
    const sorted = [...demos.filter(name => scenes.includes(name)), ...scenes.filter(name => !demos.includes(name))];
    select.replaceChildren(...sorted.map(name => new Option(name.replaceAll('-', ' '), name)));
    select.addEventListener('change', () => load(builtin(select.value)));
    const toggle = (id, action) => byId(id).addEventListener('click', event => {
        const pressed = event.target.getAttribute('aria-pressed') !== 'true';
        event.target.setAttribute('aria-pressed', pressed);
        action(pressed);
    });
    byId('frame').addEventListener('click', () => order('frame'));
    toggle('turn', pressed => { state.turning = pressed; });
    toggle('play', pressed => { state.playing = pressed; });
    byId('shot').addEventListener('click', () => savePicture().catch(error => say(error.message)));
    byId('overlays').replaceChildren(...Object.entries(overlayNames).map(([name, text]) => {
        const label = document.createElement('label');
        const box = document.createElement('input');
        box.type = 'checkbox';
        box.id = `show-${name}`;
        box.addEventListener('change', () => order('options', {overlays: {[name]: box.checked}}));
        label.append(box, text);
        return label;
    }));
    byId('technique').addEventListener('change', event => order('options', {technique: event.target.value}));
    byId('samples').addEventListener('change', event => order('options', {samples: event.target.checked ? 4 : 1}));
    byId('ground').addEventListener('change', event => order('options', {ground: event.target.checked}));
    byId('fold').addEventListener('click', event => {
        const folded = byId('panel').classList.toggle('folded');
        event.target.textContent = folded ? 'Show' : 'Hide';
        event.target.setAttribute('aria-expanded', !folded);
    });
    new ResizeObserver(fit).observe(stage);
}

// The device

const mostLosses = 5;
const lossesWithin = 30_000;

function showDevice({adapter}) { byId('adapter').textContent = `WebGPU on ${adapter}`; }

/// A processor draws, for which four samples are a lot.
const isSoftware = ({adapter}) =>
    Boolean(state.core.bridge.info?.isFallbackAdapter) || /swiftshader|llvmpipe|lavapipe|basic render/i.test(adapter);

/// When the device is lost the page goes on with another one; unless each is lost at once.
function watchDevice() {
    state.core.bridge.device.lost.then(async () => {
        state.over = true;
        state.check.viewChanged();
        const now = performance.now();
        state.losses = [...state.losses.filter(before => now - before < lossesWithin), now];
        if (state.losses.length > mostLosses) {
            say(`The graphics device was lost ${mostLosses + 1} times in half a minute; loading the page anew may help.`);
            return;
        }
        say('The graphics device is lost; the page goes on with a new one …');
        try {
            showDevice(await state.core.renew());
        } catch (error) {
            say(`The graphics device is lost, and there is no new one: ${error.message}`);
            return;
        }
        watchDevice();
        state.over = false;
        state.dirty = true;
        say('');
        if (state.wanted) await load(state.wanted);
        document.body.dataset.devices = Number(document.body.dataset.devices) + 1;
    });
}

/// There is nothing to look at and nothing to do.
function fail(sentence) {
    say(sentence);
    document.body.classList.add('failed');
    document.body.dataset.failed = sentence;
    for (const id of ['canvas', 'controls', 'fold']) byId(id).hidden = true;
    byId('about').hidden = false;
}

async function main() {
    try {
        // ?without=FEATURE, for tests: as on an adapter that does not have it.
        const disabledFeatures = new URLSearchParams(location.search).getAll('without');
        state.core = await Core.create({canvas, disabledFeatures});
        const device = await state.core.obey('start');
        showDevice(device);
        byId('samples').checked = !isSoftware(device);
    } catch (error) {
        fail(error.message);
        return;
    }
    document.body.dataset.devices = 1;
    state.check = new Check({core: state.core, freeze});
    watchDevice();
    const {scenes} = await state.core.obey('scenes');
    listenToControls(scenes);
    listenToPointers({canvas, scale, order});
    listenToKeys({canvas, marks: byId('marks'), scale, order});
    await fit();
    const loading = load(builtin(byId('scene').value));
    begin();
    await loading;
    requestAnimationFrame(frame);
}

window.gnomon = state;
listenToFiles({input: byId('file'), stage, open});
main();
