// SPDX-License-Identifier: MIT
//
// Hands: what keyboard, mouse, fingers and gamepads did since the last frame, as plain data for the game's C++ half
// (game/given_input.hpp), which knows what keys mean. Fingers are a gamepad: a stick under the left thumb, two triggers
// under the right one.

// By their place on a US keyboard, as input::name_of() calls them.
const keyNames = {
    ArrowLeft: 'Left', ArrowRight: 'Right', ArrowUp: 'Up', ArrowDown: 'Down', Space: 'Space', Enter: 'Enter', Escape: 'Escape',
    Backspace: 'Backspace', ShiftLeft: 'LeftShift', ShiftRight: 'RightShift', ControlLeft: 'LeftControl',
    ControlRight: 'RightControl', NumpadEnter: 'Enter',
};
for (const letter of 'WASDQECRPV') keyNames[`Key${letter}`] = letter;
// With Control, which sneaks, these walk on; all others are the browser's then.
const walkKeys = ['W', 'A', 'S', 'D', 'Q', 'E', 'C', 'Left', 'Right', 'Up', 'Down'];

// The Gamepad API's standard mapping, in the order of input::Gamepad::buttons.
const padButtons = [0, 1, 2, 3, 4, 5, 8, 9, 16, 10, 11, 12, 15, 13, 14];

const stickRadius = 46;  // pixels by which a thumb tilts it wholly
const pixelsANotch = 100;
const pinchANotch = Math.log(1.08);

export class Hands {
    /// `isPlaying`: whether fingers walk and turn, or are the menu's.
    constructor({stage, canvas, stick, sneak, run, isPlaying, onFirstTouch}) {
        this.isPlaying = isPlaying;
        this.onFirstTouch = onFirstTouch;
        this.stick = stick;
        this.hasTouched = matchMedia('(pointer: coarse)').matches;
        this.holdsControl = false;
        this.pointers = new Map();  // that turn the camera
        this.thumb = null;          // {id, x, y, dx, dy}
        this.pulled = {sneak: false, run: false};
        this.clear();
        this.listenToKeys();
        this.listenToPointers(stage, canvas);
        this.listenToButtons({sneak, run});
        addEventListener('blur', () => this.lose());
        document.addEventListener('visibilitychange', () => { if (document.hidden) this.lose(); });
        addEventListener('gamepaddisconnected', () => this.lose());
        document.documentElement.classList.toggle('touch', this.hasTouched);
    }

    clear() {
        this.keys = [];
        this.turn = [0, 0];
        this.scroll = 0;
        this.lost = false;
    }

    /// Everything that is held is let go, and whoever plays cannot go on.
    lose() {
        this.clear();
        this.lost = true;
        this.holdsControl = false;
        this.pointers.clear();
        this.letGoThumb();
        this.pull('sneak', false);
        this.pull('run', false);
    }

    /// Since the last call.
    take() {
        const {keys, turn, scroll, lost} = this;
        this.clear();
        return {keys, turn, scroll, lost, gamepad: this.gamepad()};
    }

    gamepad() {
        const real = [...navigator.getGamepads?.() ?? []].find(pad => pad?.connected && pad.mapping === 'standard');
        if (!real && !this.hasTouched) return null;
        const value = place => real?.buttons[place]?.value ?? 0;
        const axis = place => real?.axes[place] ?? 0;
        return {
            left: this.thumb ? [this.thumb.dx, this.thumb.dy] : [axis(0), axis(1)],
            right: [axis(2), axis(3)],
            triggers: [this.pulled.sneak ? 1 : value(6), this.pulled.run ? 1 : value(7)],
            buttons: padButtons.flatMap((theirs, ours) => (real?.buttons[theirs]?.pressed ? [ours] : [])),
        };
    }

    listenToKeys() {
        const take = (event, pressed) => {
            const name = keyNames[event.code];
            if (event.key === 'Control') this.holdsControl = pressed;
            if (!name || event.altKey || event.metaKey) return;
            if (event.ctrlKey && event.key !== 'Control' && pressed && !walkKeys.includes(name)) return;
            // Links and the buttons in the corner are the browser's.
            const isTheirs = event.target.closest?.('a, #top') && (name === 'Enter' || name === 'Space');
            if (isTheirs) return;
            event.preventDefault();
            this.keys.push([name, pressed]);
        };
        addEventListener('keydown', event => take(event, true));
        addEventListener('keyup', event => take(event, false));
        // Control and W close a page, and nobody can forbid it: so it asks.
        addEventListener('beforeunload', event => {
            if (this.holdsControl && this.isPlaying()) event.preventDefault();
        });
    }

    listenToPointers(stage, canvas) {
        const spread = () => {
            const [a, b] = [...this.pointers.values()];
            return b ? Math.hypot(a.x - b.x, a.y - b.y) : 0;
        };
        canvas.addEventListener('pointerdown', event => {
            this.touched(event.pointerType === 'touch');
            if (!this.isPlaying()) return;
            // A pointer may be gone by now.
            try { canvas.setPointerCapture(event.pointerId); } catch { /* and then moves are heard all the same */ }
            const place = {x: event.clientX, y: event.clientY};
            const isLeft = event.clientX < stage.clientWidth * 0.45;
            if (event.pointerType === 'touch' && isLeft && !this.thumb) {
                this.thumb = {id: event.pointerId, ...place, dx: 0, dy: 0};
                this.showStick();
            } else {
                this.pointers.set(event.pointerId, place);
            }
        });
        canvas.addEventListener('pointermove', event => {
            if (this.thumb?.id === event.pointerId) {
                const x = (event.clientX - this.thumb.x) / stickRadius;
                const y = (event.clientY - this.thumb.y) / stickRadius;
                const tilt = Math.max(1, Math.hypot(x, y));
                Object.assign(this.thumb, {dx: x / tilt, dy: y / tilt});
                this.showStick();
                return;
            }
            const before = this.pointers.get(event.pointerId);
            if (!before) return;
            const apart = spread();
            const count = this.pointers.size;
            this.turn[0] += (event.clientX - before.x) / count;
            this.turn[1] += (event.clientY - before.y) / count;
            Object.assign(before, {x: event.clientX, y: event.clientY});
            if (apart > 0 && spread() > 0) this.scroll += Math.log(spread() / apart) / pinchANotch;
        });
        const end = event => {
            this.pointers.delete(event.pointerId);
            if (this.thumb?.id === event.pointerId) this.letGoThumb();
        };
        canvas.addEventListener('pointerup', end);
        canvas.addEventListener('pointercancel', end);
        stage.addEventListener('contextmenu', event => event.preventDefault());
        canvas.addEventListener('wheel', event => {
            event.preventDefault();
            this.scroll -= event.deltaY / (event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? pixelsANotch : 3);
        }, {passive: false});
    }

    listenToButtons(buttons) {
        for (const [name, button] of Object.entries(buttons)) {
            this.buttons = {...this.buttons, [name]: button};
            button.addEventListener('pointerdown', event => {
                this.touched(event.pointerType === 'touch');
                this.pull(name, true);
            });
            for (const type of ['pointerup', 'pointercancel', 'pointerleave']) {
                button.addEventListener(type, () => this.pull(name, false));
            }
        }
    }

    touched(byFinger) {
        if (!byFinger || this.hasTouched) return;
        this.hasTouched = true;
        document.documentElement.classList.add('touch');
        this.onFirstTouch();
    }

    pull(name, held) {
        this.pulled[name] = held;
        this.buttons[name].classList.toggle('held', held);
    }

    letGoThumb() {
        this.thumb = null;
        this.showStick();
    }

    showStick() {
        const {stick, thumb} = this;
        stick.classList.toggle('held', thumb !== null);
        stick.style.inset = thumb ? `${thumb.y - 58}px auto auto ${thumb.x - 58}px` : '';
        stick.firstElementChild.style.transform =
            thumb ? `translate(${thumb.dx * stickRadius}px, ${thumb.dy * stickRadius}px)` : '';
    }
}
