// SPDX-License-Identifier: MIT
//
// The game's page: the loop, and everything that is text. What is done goes to the C++ half (game/game.hpp), which has
// the rules, the menus and the words; what it answers is shown.
//   game.html?level=NAME            courtyard where none is named
//   game.html?replay=NAME&speed=N   the level's recording is watched at once, N times as fast
import {Core} from './core.js';
import {Hands} from './game-hands.js';
import {Quality} from './game-quality.js';

const byId = id => document.getElementById(id);
const root = document.documentElement;
const canvas = byId('canvas');
const stage = byId('stage');
const query = new URLSearchParams(location.search);
const keepsStill = matchMedia('(prefers-reduced-motion: reduce)');

const mostPixels = 2560 * 1440;
const settingsKey = 'gnomon-game';
const qualityKey = 'gnomon-game-quality';
const mostLosses = 3;  // of the device, one after the other
const touchHelp = [
    ['drag, on the left', 'walk'], ['drag, on the right', 'turn the camera'], ['two fingers', 'come nearer'],
    ['run, sneak', 'as long as they are held'],
];

const state = {
    core: null,
    hands: null,
    quality: null,
    answer: null,       // of the last frame
    said: null,         // what the core says once: names, words
    choices: [],        // of menu lines, one a frame
    dirty: true,        // the picture is not what is to be seen
    last: 0,            // when the last frame began
    drawn: null,        // when the device is done with the last frame
    losses: 0,
    over: false,
};

// A browser may keep nothing.
const kept = {
    get(key) { try { return localStorage.getItem(key); } catch { return null; } },
    set(key, value) { try { localStorage.setItem(key, value); } catch { /* then it is forgotten */ } },
};

function say(text) {
    byId('note').textContent = text;
    byId('note').hidden = !text;
}

/// Sets what is another; the browser lays out less.
const shown = new Map();
function show(id, property, value) {
    const key = `${id}.${property}`;
    if (shown.get(key) === value) return;
    shown.set(key, value);
    const element = byId(id);
    if (property === 'text') element.textContent = value;
    else if (property === 'hidden') element.toggleAttribute('hidden', value);
    else if (property.startsWith('aria-') || property === 'd' || property === 'r') element.setAttribute(property, value);
    else element.style[property] = value;
}

// What is shown

function showDisplay(answer) {
    const {display} = answer;
    const plays = answer.screen === 'playing' || answer.screen === 'won' || answer.screen === 'caught';
    show('hud', 'hidden', !plays);
    const mark = answer.screen === 'playing' && display.exit;
    show('exit', 'hidden', !mark);
    if (mark) show('exit', 'transform', `translate(${mark.x.toFixed(1)}px, ${mark.y.toFixed(1)}px) rotate(${mark.turn_rad ?? Math.PI / 2}rad) scale(${mark.turn_rad === undefined ? 0.75 : 1})`);
    show('dread', 'opacity', plays ? (0.75 * display.alarm).toFixed(2) : '0');
    if (!plays) return;
    show('clock', 'text', display.clock);
    show('recording', 'text', answer.watches ? state.said.recording : '');
    for (const [id, name] of [['caption-name', 'name'], ['caption-step', 'first_step'], ['caption-hint', 'hint']]) {
        const alpha = answer.screen === 'playing' && !answer.ended ? display.captions[name] : 0;
        show(id, 'opacity', alpha.toFixed(2));
    }
    const color = display.tint > 0 ? `color-mix(in srgb, var(--alarm) ${Math.round(100 * display.tint)}%, var(--lamp))`
        : display.seen ? 'var(--lamp)' : 'var(--dim)';
    show('meter', 'color', color);
    showEye(display.light);
    const percent = value => `${Math.round(100 * value)}%`;
    byId('light').firstElementChild.style.cssText = `width: ${percent(display.light)}; background: ${display.seen ? 'var(--lamp)' : '#b9b29f'}`;
    byId('alarm').firstElementChild.style.width = percent(display.alarm);
    show('light', 'aria-valuenow', Math.round(100 * display.light));
    show('alarm', 'aria-valuenow', Math.round(100 * display.alarm));
    show('by', 'text', display.seen ? display.by.join(', ') : '');
}

/// Shut in the dark, wide open in the light.
function showEye(open) {
    const lid = Math.max(7, 19 * open).toFixed(1);
    const lashes = 'M-9 2.5l-3 5M0 3.5v5M9 2.5l3 5';
    show('lids', 'd', `M-17 0Q0 ${lid} 17 0` + (open < 0.05 ? lashes : `M-17 0Q0 -${lid} 17 0`));
    show('pupil', 'r', open < 0.05 ? 0 : Math.min(6, 0.42 * lid));
}

/// A line's label steps a setting on, as Enter does; the arrows go either way.
function lineOf({label, value, won}, place, isLast) {
    const item = document.createElement('li');
    item.classList.toggle('last', isLast);
    const button = (text, name, choice) => {
        const element = document.createElement('button');
        element.className = name;
        element.textContent = text;
        element.addEventListener('click', () => state.choices.push({point: place, ...choice}));
        return element;
    };
    const line = button(label, `line${won ? ' won' : ''}`, {accept: true});
    line.addEventListener('focus', () => state.choices.push({point: place}));
    item.addEventListener('pointermove', event => {
        if (event.pointerType === 'mouse' && state.answer.menu.selected !== place) state.choices.push({point: place});
    });
    item.append(line);
    if (value !== undefined) {
        const text = document.createElement('span');
        text.className = 'value';
        text.textContent = value;
        const less = button('‹', 'step', {step: -1});
        const more = button('›', 'step', {step: 1});
        less.setAttribute('aria-label', `${label}: less`);
        more.setAttribute('aria-label', `${label}: more`);
        for (const step of [less, more]) step.tabIndex = -1;
        item.append(less, text, more);
    }
    return item;
}

function showHelp(screen) {
    const touches = state.hands.hasTouched;
    const isShown = screen === 'paused' || screen === 'title';
    let rows = touches ? touchHelp : state.said.keys;
    if (screen === 'title') rows = rows.slice(0, touches ? 2 : 3);
    const key = isShown ? `${screen} ${touches}` : '';
    if (showHelp.key === key) return;
    showHelp.key = key;
    byId('help').replaceChildren(...(isShown ? rows : []).flatMap(([keys, deed]) => {
        const term = document.createElement('dt');
        term.textContent = keys;
        const data = document.createElement('dd');
        data.textContent = deed;
        return [term, data];
    }));
    byId('help').hidden = !isShown;
}

function showMenu(answer) {
    const {menu, screen, figures} = answer;
    const stands = answer.ended !== undefined;
    const hasMenu = screen !== 'playing' || stands;
    const classes = [screen, stands ? 'stands' : '', state.hands.hasTouched ? 'touch' : ''].filter(name => name).join(' ');
    if (root.className !== classes) root.className = classes;
    show('menu', 'hidden', !hasMenu);
    show('pause', 'hidden', screen !== 'playing');
    show('links', 'hidden', screen !== 'title' && screen !== 'paused');
    show('heading', 'text', screen === 'title' ? state.said.title : menu.heading);
    show('words', 'text', screen === 'title' ? state.said.promise : menu.words);
    show('drawn', 'hidden', screen !== 'settings');
    if (screen === 'settings') {
        show('drawn', 'text', `${figures.width}×${figures.height}, ${figures.samples === 1 ? 'one sample' : 'four samples'}, ` +
            `on ${state.adapter}`);
    }
    showHelp(screen);
    const key = JSON.stringify([screen, menu.lines]);
    const lines = byId('lines');
    if (showMenu.key !== key) {
        const isSame = showMenu.screen === screen;
        showMenu.key = key;
        showMenu.screen = screen;
        showMenu.selected = -1;
        const isLast = place => screen === 'settings' && place + 1 === menu.lines.length;
        lines.replaceChildren(...menu.lines.map((line, place) => lineOf(line, place, isLast(place))));
        if (!isSame) canvas.focus({preventScroll: true});
    }
    if (showMenu.selected !== menu.selected && menu.lines.length > 0) {
        showMenu.selected = menu.selected;
        [...lines.children].forEach((item, place) => item.classList.toggle('chosen', place === menu.selected));
        if (!document.activeElement?.closest('a, #top')) lines.children[menu.selected].firstElementChild.focus({preventScroll: true});
    }
}

// Frames

function fit() {
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const [width, height] = [Math.max(stage.clientWidth, 1), Math.max(stage.clientHeight, 1)];
    const pixels = width * height * ratio * ratio;
    const scale = pixels > mostPixels ? ratio * Math.sqrt(mostPixels / pixels) : ratio;
    // What lies over the picture: the meter is below, or above where thumbs are below.
    const margins = !state.hands.hasTouched ? [40, 64, 104] : height > width ? [28, 130, 40] : [28, 84, 40];
    state.dirty = true;
    return state.core.obey('size', {
        width: Math.round(width * scale), height: Math.round(height * scale), shown: [width, height], margins,
        ...state.quality.now,
    });
}

/// On a title that keeps still, in a pause and at an end nothing moves.
function moves(answer) {
    return answer.screen === 'playing' || (answer.behind === 'title' && !keepsStill.matches);
}

async function step(now) {
    const begin = performance.now();
    const before = state.answer;
    const draw = state.dirty || moves(before);
    state.dirty = false;
    const answer = await state.core.obey('frame', {
        seconds: Math.max(0, now - state.last) / 1000, input: state.hands.take(), choice: state.choices.shift() ?? null, draw,
    });
    state.last = now;
    state.answer = answer;
    // What was chosen may look different.
    if (!draw && (answer.screen !== before.screen || JSON.stringify(answer.menu) !== JSON.stringify(before.menu))) state.dirty = true;
    showDisplay(answer);
    showMenu(answer);
    if (answer.settings) kept.set(settingsKey, answer.settings);
    if (!draw) return;
    state.losses = 0;
    document.body.dataset.frames = Number(document.body.dataset.frames ?? 0) + 1;
    state.drawn = state.core.bridge.device.queue.onSubmittedWorkDone().then(() => {
        if (!state.quality.add(performance.now() - begin)) return null;
        kept.set(qualityKey, state.quality.place);
        return fit();
    }).catch(() => {});
}

async function renew() {
    if (++state.losses > mostLosses) throw new Error('The graphics device is lost again and again.');
    state.drawn = null;
    await state.core.renew();
    watchDevice();
    state.quality.forget();
    state.dirty = true;
}

function watchDevice() {
    const {bridge} = state.core;
    bridge.device.lost.then(() => { state.lost = bridge === state.core.bridge; });
}

async function frame(now) {
    try {
        if (state.lost) {
            state.lost = false;
            await renew();
        }
        // No more than one frame ahead of the device: what is pressed is seen soon.
        await state.drawn;
        await step(now);
    } catch (error) {
        // The device that is lost says so a little later; what was asked for then is asked for again.
        await new Promise(resolve => setTimeout(resolve, 50));
        if (!state.lost) {
            state.over = true;
            say(error.message);
            document.body.dataset.failed = error.message;
        }
    }
    if (!state.over) requestAnimationFrame(frame);
}

// Beginning

async function textOf(path) {
    const response = await fetch(path);
    if (!response.ok) throw new Error(`${path} cannot be loaded: the server answers ${response.status}.`);
    return response.text();
}

function showLinks(levels, name) {
    const link = (text, href) => {
        const element = document.createElement('a');
        element.textContent = text;
        element.href = href;
        return element;
    };
    const capital = text => text[0].toUpperCase() + text.slice(1);
    const others = levels.filter(level => level !== name);
    byId('links').replaceChildren(...others.map(level => link(capital(level), `?level=${level}`)), link('The viewer', './'));
}

function listenToCorner() {
    byId('pause').addEventListener('click', () => state.hands.keys.push(['P', true], ['P', false]));
    const full = byId('full');
    full.hidden = !document.fullscreenEnabled;
    full.addEventListener('click', () => {
        const done = document.fullscreenElement ? document.exitFullscreen() : root.requestFullscreen();
        done.catch(error => say(error.message));
    });
}

function showWords(said) {
    document.title = `${said.name} - gnomon`;
    byId('name').textContent = said.name;
    byId('caption-name').textContent = said.name;
    byId('caption-step').textContent = said.first_step;
    byId('caption-hint').textContent = said.hint;
    byId('caption-hint').hidden = !said.hint;
    const [light, alarm] = byId('bar-names').children;
    light.textContent = said.light;
    alarm.textContent = said.alarm;
    byId('light').setAttribute('aria-label', said.light);
    byId('alarm').setAttribute('aria-label', said.alarm);
    byId('light').lastElementChild.style.left = `${100 * said.seen_from}%`;
}

async function begin() {
    const name = query.get('replay') ?? query.get('level') ?? 'courtyard';
    // ?without=FEATURE, for tests: as on an adapter that does not have it.
    state.core = await Core.create({canvas, disabledFeatures: query.getAll('without'), program: './gnomon-game.mjs'});
    const {levels} = await state.core.obey('levels');
    if (!levels.includes(name)) throw new Error(`There is no level "${name.slice(0, 60)}"; there are ${levels.join(', ')}.`);
    const [level, recording] = await Promise.all([textOf(`levels/${name}.json`), textOf(`recordings/${name}.replay`)]);
    state.said = await state.core.obey('level', {
        name, text: level, recording, settings: kept.get(settingsKey), keeps_still: keepsStill.matches,
        speed: Number(query.get('speed') ?? 1) || 1,
    });
    state.adapter = (await state.core.obey('start')).adapter;
    state.quality = new Quality(Number(kept.get(qualityKey)));
    state.hands = new Hands({
        stage, canvas, stick: byId('stick'), sneak: byId('sneak'), run: byId('run'),
        isPlaying: () => state.answer?.screen === 'playing', onFirstTouch: fit,
    });
    watchDevice();
    showWords(state.said);
    showLinks(levels, name);
    listenToCorner();
    await fit();
    new ResizeObserver(fit).observe(stage);
    // The screen's ratio of pixels may have become another.
    addEventListener('resize', fit);
    if (query.has('replay')) await state.core.obey('watch');
    state.answer = await state.core.obey('frame', {seconds: 0, draw: false});
    say(state.said.complaint);
    if (state.said.complaint) setTimeout(() => say(''), 6000);
    state.last = performance.now();
    requestAnimationFrame(frame);
}

window.gnomon = state;
begin().catch(error => {
    say(error.message);
    document.body.dataset.failed = error.message;
});
