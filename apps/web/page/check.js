// SPDX-License-Identifier: MIT
//
// Checking a view: what each technique takes for it, and how many of its pixels are wrong. The core draws the masks; workers
// trace the truth of the same triangles, lights and view, row by row, and judge them. Milliseconds are taken before, while
// no worker is in the way.

const byId = id => document.getElementById(id);

/// How far from a true edge a pixel must be to be judged, in pixels: a software rasteriser's places are that coarse.
const band = 1 / 8;
const rounds = 3;
const mostFramesOfRound = 10;
const measuringMs = 10_000;  // for all techniques together, where frames are not slower than that
const pixelsOfPart = 20_000;
const mostWorkers = 4;
const mostBytes = 512 * 2 ** 20;  // of all workers, each of which has the triangles
const mostRings = 200;
const mostMarked = 100_000;  // of a technique; all are counted

// "none" is drawn without shadows: what all of them are compared with.
const techniques = [
    {id: 'auto', name: 'auto', shape: 'circle'},
    {id: 'zpass', name: 'depth-pass', shape: 'square'},
    {id: 'zfail', name: 'depth-fail', shape: 'triangle'},
    {id: 'none', name: 'no shadows', shape: 'cross'},
];
const judgedOnes = techniques.filter(({id}) => id !== 'none');

/// The middle one, or what lies between the two; with the least and the most.
function spreadOf(values) {
    const sorted = [...values].sort((a, b) => a - b);
    const half = sorted.length / 2;
    return {ms: (sorted[Math.ceil(half) - 1] + sorted[Math.floor(half)]) / 2, least: sorted[0], most: sorted.at(-1)};
}
const count = number => number.toLocaleString('en');
const milliseconds = value => value.toFixed(value < 10 ? 2 : value < 100 ? 1 : 0);

class Cancelled extends Error {}

/// Traces in as many workers as there are processors to spare. `part(answer)` hears of each part, in no order.
class Tracing {
    constructor({width, height, samples, lights, bytes}) {
        this.width = width;
        this.height = height;
        this.bytes = bytes;
        this.next = 0;
        this.rowsOfPart = Math.max(1, Math.round(pixelsOfPart / (width * samples * lights)));
        const parts = Math.ceil(height / this.rowsOfPart);
        const spare = Math.max(1, (navigator.hardwareConcurrency || 2) - 1);
        const copies = Math.max(1, Math.floor(mostBytes / bytes.job.byteLength));
        this.count = Math.min(spare, mostWorkers, parts, copies);
        this.workers = [];
    }

    run(part) {
        let left = this.height;
        return new Promise((resolve, reject) => {
            this.reject = reject;
            for (let i = 0; i < this.count; ++i) {
                const worker = new Worker(new URL('truth_worker.js', import.meta.url), {type: 'module'});
                this.workers.push(worker);
                worker.addEventListener('error', event => reject(new Error(
                    `The worker that traces the truth does not start: ${event.message || 'the browser does not say why'}.`)));
                worker.addEventListener('message', ({data}) => {
                    if (data.error) return reject(new Error(data.error));
                    if (data.rows) {
                        part(data);
                        left -= data.rows;
                        if (left <= 0) resolve();
                    }
                    if (this.next < this.height) {
                        const first = this.next;
                        const rows = Math.min(this.rowsOfPart, this.height - first);
                        this.next += rows;
                        const masks = this.masksOf(first, rows);
                        worker.postMessage({first, rows, masks}, [masks]);
                    }
                });
                worker.postMessage({job: this.bytes.job});
            }
        }).finally(() => this.workers.forEach(worker => worker.terminate()));
    }

    /// These rows of all masks, one after another.
    masksOf(first, rows) {
        const masks = new Uint8Array(this.bytes.masks);
        const [ofMask, ofRows] = [this.width * this.height, this.width * rows];
        const part = new Uint8Array(masks.length / ofMask * ofRows);
        for (let mask = 0; mask * ofMask < masks.length; ++mask) {
            const begin = mask * ofMask + first * this.width;
            part.set(masks.subarray(begin, begin + ofRows), mask * ofRows);
        }
        return part.buffer;
    }

    cancel() { this.reject?.(new Cancelled()); }
}

export class Check {
    /// `freeze()` is called before anything is measured: the view must stand still.
    constructor({core, freeze}) {
        this.core = core;
        this.freeze = freeze;
        this.generation = 0;  // of the view
        this.running = false;
        this.loading = false;
        this.stale = false;   // what was found is of an earlier view
        byId('check').addEventListener('click', () => this.running ? this.cancel() : this.run());
        this.showButton();
        if (!core.waits) {
            this.say('To check a view, masks are read back, which needs JavaScript Promise Integration; this browser does not ' +
                'have it.');
        }
    }

    /// What was found is of another view from now on; what runs ends.
    viewChanged() {
        ++this.generation;
        this.clearMarks();
        if (this.running) {
            this.cancel('The view has changed, so the check has ended.');
        } else if (this.result && !this.stale) {
            this.stale = true;
            byId('check-result').classList.add('stale');
            this.say('Of an earlier view.');
        }
    }

    /// While a scene is loading there is no view to begin with.
    setLoading(loading) {
        this.loading = loading;
        this.showButton();
    }

    cancel(reason = 'The check was ended.') {
        this.reason = reason;
        ++this.generation;
        this.tracing?.cancel();
    }

    async run() {
        this.freeze();
        const {generation} = this;
        this.running = true;
        this.forget();
        this.showButton();
        document.body.dataset.check = 'running';
        try {
            await this.find(() => { if (this.generation !== generation) throw new Cancelled(); });
            document.body.dataset.check = 'done';
        } catch (error) {
            document.body.dataset.check = 'ended';
            this.say(error instanceof Cancelled ? this.reason : error.message);
            this.forget();
        } finally {
            this.running = false;
            this.tracing = null;
            this.showButton();
            byId('check-progress').hidden = true;
        }
    }

    /// Nothing is known of any view.
    forget() {
        this.result = null;
        this.stale = false;
        byId('check-result').classList.remove('stale');
        byId('check-result').hidden = true;
        this.clearMarks();
    }

    async find(stillWanted) {
        this.progress(0, 'Drawing …');
        const times = Object.fromEntries(techniques.map(({id}) => [id, []]));
        const {frame_ms: [first]} = await this.core.obey('measure', {technique: 'auto', frames: 1});
        // One more is drawn each time, which finds what the others know.
        const frames = Math.floor(measuringMs / (rounds * techniques.length * first)) - 1;
        const framesOfRound = Math.max(1, Math.min(frames, mostFramesOfRound));
        for (let round = 0; round < rounds; ++round) {
            for (const {id} of techniques) {
                const {frame_ms} = await this.core.obey('measure', {technique: id, frames: framesOfRound});
                stillWanted();
                times[id].push(...frame_ms);
                this.progress(0, `Drawing round ${round + 1} of ${rounds} …`);
            }
        }
        const drawn = await this.core.obey('masks', {techniques: judgedOnes.map(({id}) => id), band_px: band});
        stillWanted();
        const result = {
            ...drawn, frames: rounds * framesOfRound, traced: 0, judged: 0, band: 0, begin: performance.now(),
            rows: techniques.map(technique => ({...technique, ...spreadOf(times[technique.id]), wrong: 0, at: []})),
        };
        delete result.bytes;
        this.result = result;
        this.show();
        this.tracing = new Tracing(drawn);
        await this.tracing.run(part => {
            result.traced += part.rows;
            result.judged += part.judged;
            result.band += part.band;
            judgedOnes.forEach(({id}, i) => {
                const row = result.rows.find(r => r.id === id);
                row.wrong += part.wrong[i];
                row.at.push(...part.at[i].slice(0, mostMarked - row.at.length));
            });
            result.rows.find(r => r.id === 'none').wrong += part.shadowed;
            this.show();
        });
        result.seconds = (performance.now() - result.begin) / 1000;
        this.show();
    }

    // What is seen of it

    say(text, live = 'polite') {
        const note = byId('check-note');
        if (note.textContent === text) return;
        note.setAttribute('aria-live', live);
        note.textContent = text;
    }

    showButton() {
        byId('check').textContent = this.running ? 'Stop' : 'Check this view';
        byId('check').disabled = !this.core.waits || (this.loading && !this.running);
    }

    progress(share, text) {
        const bar = byId('check-progress');
        bar.hidden = false;
        bar.value = share;
        this.say(text, 'off');  // the bar says it to those who listen
    }

    show() {
        const {result} = this;
        const share = result.traced / result.height;
        const size = `${result.width} × ${result.height} pixels` + (result.samples > 1 ? ` of ${result.samples} samples` : '') +
            (result.lights > 1 ? ` for each of ${result.lights} lights` : '');
        if (!result.seconds) {
            const seconds = (performance.now() - result.begin) / 1000;
            const left = share > 0.02 ? `, about ${Math.ceil(seconds * (1 - share) / share)} s left` : '';
            this.progress(share, `Tracing the truth of ${size}: ${Math.floor(share * 100)} %${left}.`);
        }
        byId('check-result').hidden = false;
        byId('check-rows').replaceChildren(...result.rows.map(row => {
            const line = document.createElement('tr');
            line.dataset.technique = row.id;
            const name = document.createElement('th');
            name.scope = 'row';
            name.append(picture(16, 16, marker(row, 8, 8)), row.name);
            const range = [row.least, row.most].map(value => value.toFixed(value < 10 ? 2 : 0)).join('–');
            const cells = [milliseconds(row.ms), range, count(row.wrong)].map(text => {
                const cell = document.createElement('td');
                cell.textContent = text;
                return cell;
            });
            cells[1].className = 'range';
            line.append(name, ...cells);
            return line;
        }));
        byId('check-plot').replaceChildren(plot(result.rows));
        byId('check-how').textContent = `ms: the median of ${result.frames} frames of the still view, one at a time, each with the ` +
            'wait for the device; beside it the fastest and the slowest.';
        if (!result.seconds) return;
        const [auto] = result.rows;
        this.say(
            `auto: ${milliseconds(auto.ms)} ms, ${count(auto.wrong)} wrong of ${count(result.judged)} judged ` +
            `${result.samples > 1 ? 'samples' : 'pixels'} (${count(result.band)} in the band, 1/${1 / band} pixel round ` +
            `true edges). Of ${size}, traced in ${result.seconds.toFixed(1)} s.`);
        this.mark();
    }

    /// Rings round the wrong pixels of a technique, in the picture.
    mark() {
        const {result} = this;
        const canvas = byId('wrong');
        canvas.hidden = false;
        canvas.width = result.width;
        canvas.height = result.height;
        const context = canvas.getContext('2d');
        const scale = result.width / Math.max(1, canvas.clientWidth);
        let marked = 0;
        for (const row of [...result.rows].reverse()) {
            const places = [...new Set(row.at)];
            marked += places.length;
            const color = getComputedStyle(byId('check-rows')).getPropertyValue(`--${row.id}`);
            for (const at of places) {
                const x = at % result.width + 0.5;
                const y = Math.floor(at / result.width) + 0.5;
                context.fillStyle = color;
                context.fillRect(x - 0.5, y - 0.5, 1, 1);
                if (places.length > mostRings) continue;
                for (const [style, width] of [['#14171c', 4], [color, 2]]) {
                    context.strokeStyle = style;
                    context.lineWidth = width * scale;
                    context.beginPath();
                    context.arc(x, y, 9 * scale, 0, 2 * Math.PI);
                    context.stroke();
                }
            }
        }
        canvas.hidden = marked === 0;
    }

    clearMarks() { byId('wrong').hidden = true; }
}

// Pictures in SVG

function svg(name, attributes = {}, ...children) {
    const element = document.createElementNS('http://www.w3.org/2000/svg', name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    element.append(...children);
    return element;
}

function picture(width, height, ...children) {
    return svg('svg', {viewBox: `0 0 ${width} ${height}`, width, height, 'aria-hidden': true}, ...children);
}

/// Told apart by shape, and by colour.
function marker({id, shape}, x, y) {
    const paths = {
        circle: 'M-5 0a5 5 0 1 0 10 0a5 5 0 1 0 -10 0z', square: 'M-4.5 -4.5h9v9h-9z', triangle: 'M0 -5.5L5.5 4.5H-5.5z',
        cross: 'M-4.5 -4.5L4.5 4.5M4.5 -4.5L-4.5 4.5',
    };
    return svg('path', {d: paths[shape], transform: `translate(${x} ${y})`, class: `marker ${id}`});
}

/// Milliseconds to the right, from 0; wrong pixels upwards, from 0 and then by powers of ten.
function plot(rows) {
    const [width, height, left, bottom, top, right] = [252, 150, 40, 34, 12, 18];
    const decades = Math.max(2, Math.ceil(Math.log10(Math.max(1, ...rows.map(row => row.wrong))) + 1e-9));
    const step = niceStep(Math.max(...rows.map(row => row.ms)) * 1.05);
    const steps = Math.ceil(Math.max(...rows.map(row => row.ms)) * 1.05 / step);
    const x = ms => left + (width - left - right) * ms / (step * steps);
    // 0 has a place of its own, below 1.
    const level = wrong => wrong === 0 ? 0 : 1 + Math.log10(wrong);
    const y = wrong => height - bottom - (height - bottom - top) * level(wrong) / (decades + 1);
    const parts = [];
    const label = (text, at) => svg('text', at, text);
    for (let power = -1; power <= decades; ++power) {
        const wrong = power < 0 ? 0 : 10 ** power;
        parts.push(svg('path', {d: `M${left} ${y(wrong)}H${width - right}`, class: 'grid'}));
        if (power === -1 || power % 2 === 0 || decades < 4) {
            const text = wrong >= 1e6 ? `${wrong / 1e6} M` : wrong >= 1000 ? `${wrong / 1000} k` : String(wrong);
            parts.push(label(text, {x: left - 6, y: y(wrong) + 4, 'text-anchor': 'end'}));
        }
    }
    for (let i = 0; i <= steps; ++i) {
        parts.push(svg('path', {d: `M${x(i * step)} ${height - bottom}v4`, class: 'axis'}));
        parts.push(label(String(Number((i * step).toPrecision(3))),
                         {x: x(i * step), y: height - bottom + 16, 'text-anchor': 'middle'}));
    }
    parts.push(svg('path', {d: `M${left} ${top}V${height - bottom}H${width - right}`, class: 'axis'}));
    parts.push(label('ms a frame', {x: width - right, y: height - 3, 'text-anchor': 'end'}));
    parts.push(label('wrong', {x: left + 5, y: top + 2}));
    for (const row of [...rows].reverse()) parts.push(marker(row, x(row.ms), y(row.wrong)));
    const words = rows.map(row => `${row.name}: ${milliseconds(row.ms)} ms, ${row.wrong} wrong`).join('; ');
    return svg('svg', {viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': words}, ...parts);
}

/// Such that about four of them are `range`.
function niceStep(range) {
    const rough = Math.max(range, 1e-3) / 4;
    const power = 10 ** Math.floor(Math.log10(rough));
    return [1, 2, 5, 10].find(step => step * power >= rough) * power;
}
