// SPDX-License-Identifier: MIT
//
// What is done to the picture by mouse, fingers and keys, as orders for the core.

const arrows = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};
const degreesOfKey = 5;
const pixelsOfKey = 24;

/// `scale()`: pixels of the picture a pixel of the page. `order(what, details)` is obeyed one after another.
export function listenToPointers({canvas, scale, order}) {
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
    canvas.addEventListener('pointerdown', event => {
        canvas.setPointerCapture(event.pointerId);
        pointers.set(event.pointerId, at(event));
        canvas.classList.add('held');
        apart = spread();
        // A light's disc is caught by what is a little larger than a finger, or than an arrow.
        const reach = (event.pointerType === 'touch' ? 24 : 12) * scale();
        order('press', {...middle(), pan: pointers.size > 1 || event.button !== 0, reach});
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
        // The finger that stays goes on with the camera, whatever it happens to lie on.
        if (pointers.size > 0) order('press', {...middle(), pan: false, reach: 0});
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
}

/// Keys on the canvas move the camera, keys on a light's mark in `marks` the light.
export function listenToKeys({canvas, marks, scale, order}) {
    const listen = (element, action) => element.addEventListener('keydown', event => {
        // Those are the browser's: its own zoom, back and forth.
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        if (action(event)) event.preventDefault();
    });
    listen(canvas, ({key, shiftKey}) => {
        const notches = {'+': 1, '=': 1, '-': -1}[key];
        if (notches) return order('zoom', {notches});
        if (!arrows[key]) return null;
        const [x, y] = arrows[key];  // where the camera goes, so that the picture goes the other way
        return shiftKey ? order('pan', {x: -x * pixelsOfKey * scale(), y: -y * pixelsOfKey * scale()})
                        : order('look', {yaw_deg: x * degreesOfKey, pitch_deg: y * degreesOfKey});
    });
    listen(marks, ({key, shiftKey, target}) => {
        if (!arrows[key]) return null;
        const [x, y] = arrows[key].map(side => side * pixelsOfKey / 2 * scale());
        return order('push', {place: [...marks.children].indexOf(target), x, y, along_ground: shiftKey});
    });
}
