// SPDX-License-Identifier: MIT
//
// The page: what is clicked, dragged and dropped becomes orders for the core, and its answers become text.
import {Check} from './check.js';
import {Core} from './core.js';

const byId = id => document.getElementById(id);
const canvas = byId('canvas');
const stage = byId('stage');

const overlayNames = {
    volumes: 'volumes', silhouettes: 'silhouettes', caps: 'caps', wireframe: 'wireframe', count: 'counts', fill: 'fill',
};
const demos = ['still-life', 'pillars', 'room', 'walk'];
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
    wanted: null,          // the scene that is being loaded
    figures: null,         // of the last frame
};

function say(text) {
    const note = byId('note');
    note.textContent = text;
    note.hidden = !text;
}

const leavesTheView = new Set(['press', 'release']);

/// Orders one thing of the core and draws; what goes wrong is said.
async function order(what, details) {
    if (!leavesTheView.has(what)) state.check.viewChanged();
    try {
        const answer = await state.core.obey(what, details);
        state.dirty = true;
        return answer;
    } catch (error) {
        say(error.message);
        return null;
    }
}

async function load(source, name) {
    say(`Loading ${name} …`);
    state.wanted = {source, name};
    const answer = await order('load', {source});
    if (!answer && state.over) return;  // the next device gets it
    state.wanted = null;
    if (!answer) return;
    state.animated = answer.animated;
    byId('play').hidden = !answer.animated;
    const lights = answer.lights.length;
    byId('facts').textContent = `${answer.triangles.toLocaleString('en')} triangles, ` +
        `${lights} ${lights === 1 ? 'light' : 'lights'}`;
    say(answer.messages.length > 0 ? answer.messages[0] : '');
}

// Pixels of the picture a pixel of the page.
function scale() {
    const wanted = Math.min(window.devicePixelRatio || 1, 2);
    const pixels = stage.clientWidth * stage.clientHeight * wanted * wanted;
    return pixels > mostPixels ? wanted * Math.sqrt(mostPixels / pixels) : wanted;
}

async function fit() {
    const width = Math.max(1, Math.round(stage.clientWidth * scale()));
    const height = Math.max(1, Math.round(stage.clientHeight * scale()));
    if (width === state.width && height === state.height) return;
    Object.assign(state, {width, height});
    await order('size', {width, height});
}

// Drawing

const milliseconds = value => `${value.toFixed(value < 10 ? 2 : 1)} ms`;

function showFigures(figures) {
    const rows = [
        ['frame', milliseconds(figures.frame_ms)],
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
    byId('marks').replaceChildren(...figures.lights.filter(light => light).map(({x, y, sun}) => {
        const mark = document.createElement('i');
        mark.className = sun ? 'sun' : 'lamp';
        mark.style.left = `${x / scale()}px`;
        mark.style.top = `${y / scale()}px`;
        return mark;
    }));
}

async function frame(now) {
    const seconds = Math.min((now - state.last) / 1000, 0.1);
    state.last = now;
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

// What is done to the picture

function listenToPointers() {
    const pointers = new Map();
    const at = event => {
        const box = canvas.getBoundingClientRect();
        return {x: (event.clientX - box.left) * scale(), y: (event.clientY - box.top) * scale()};
    };
    const middle = () => {
        const [a, b] = [...pointers.values()];
        return b ? {x: (a.x + b.x) / 2, y: (a.y + b.y) / 2} : a;
    };
    const spread = () => {
        const [a, b] = [...pointers.values()];
        return b ? Math.hypot(a.x - b.x, a.y - b.y) : 0;
    };
    let apart = 0;
    // A light's disc is caught by what is a little larger than a finger, or than an arrow.
    const begin = (event, pan) => order(
        'press', {...middle(), pan, reach: (event.pointerType === 'touch' ? 24 : 12) * scale()});
    canvas.addEventListener('pointerdown', event => {
        canvas.setPointerCapture(event.pointerId);
        pointers.set(event.pointerId, at(event));
        canvas.classList.add('held');
        apart = spread();
        begin(event, pointers.size > 1 || event.button !== 0);
    });
    canvas.addEventListener('pointermove', event => {
        if (!pointers.has(event.pointerId)) return;
        pointers.set(event.pointerId, at(event));
        if (pointers.size > 1) {
            const now = spread();
            if (apart > 0 && now > 0) order('zoom', {notches: Math.log(now / apart) / Math.log(1 / 0.9)});
            apart = now;
        }
        order('drag', {...middle(), along_ground: event.shiftKey});
    });
    const end = event => {
        if (!pointers.delete(event.pointerId)) return;
        order('release');
        if (pointers.size > 0) begin(event, false);
        else canvas.classList.remove('held');
    };
    canvas.addEventListener('pointerup', end);
    canvas.addEventListener('pointercancel', end);
    canvas.addEventListener('contextmenu', event => event.preventDefault());
    canvas.addEventListener('wheel', event => {
        event.preventDefault();
        const notch = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 100 : 3;
        order('zoom', {notches: -event.deltaY / notch});
    }, {passive: false});
    canvas.addEventListener('keydown', event => {
        const turns = {ArrowLeft: [-5, 0], ArrowRight: [5, 0], ArrowUp: [0, 5], ArrowDown: [0, -5]};
        if (turns[event.key]) {
            order('look', {yaw_deg: turns[event.key][0], pitch_deg: turns[event.key][1]});
        } else if (event.key === '+' || event.key === '-') {
            order('zoom', {notches: event.key === '+' ? 1 : -1});
        } else {
            return;
        }
        event.preventDefault();
    });
}

async function open(file) {
    if (!file) return;
    if (!file.name.toLowerCase().endsWith('.glb')) {
        say(`${file.name} is no .glb: a page can read models of one file only.`);
        return;
    }
    const path = state.core.keepFile(file.name, new Uint8Array(await file.arrayBuffer()));
    await load(path, file.name);
}

function listenToFiles() {
    byId('file').addEventListener('change', async event => {
        await open(event.target.files[0]);
        event.target.value = '';  // so that the same one can be chosen again
    });
    const over = event => {
        event.preventDefault();
        stage.classList.add('over');
    };
    stage.addEventListener('dragover', over);
    stage.addEventListener('dragleave', () => stage.classList.remove('over'));
    stage.addEventListener('drop', event => {
        event.preventDefault();
        stage.classList.remove('over');
        open(event.dataTransfer.files[0]);
    });
}

function listenToControls(scenes) {
    const select = byId('scene');
    const sorted = [...demos.filter(name => scenes.includes(name)), ...scenes.filter(name => !demos.includes(name))];
    select.replaceChildren(...sorted.map(name => new Option(name.replaceAll('-', ' '), name)));
    select.addEventListener('change', () => load(`builtin:${select.value}`, select.value));
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
        if (state.wanted) await load(state.wanted.source, state.wanted.name);
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
        showDevice(await state.core.obey('start'));
    } catch (error) {
        fail(error.message);
        return;
    }
    document.body.dataset.devices = 1;
    state.check = new Check({core: state.core, freeze});
    watchDevice();
    const {scenes} = await state.core.obey('scenes');
    listenToControls(scenes);
    listenToPointers();
    listenToFiles();
    await fit();
    await load(`builtin:${byId('scene').value}`, byId('scene').value);
    requestAnimationFrame(frame);
}

window.gnomon = state;
main();
