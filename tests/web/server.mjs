// SPDX-License-Identifier: MIT
//
// Serves files on the loopback, each folder under a name: what a page needs that file: may not load. By itself:
//   node server.mjs FOLDER [PORT]
import {createReadStream, statSync} from 'node:fs';
import http from 'node:http';
import path from 'node:path';
import {pathToFileURL} from 'node:url';

const types = {
    '.html': 'text/html; charset=utf-8', '.css': 'text/css', '.js': 'text/javascript', '.mjs': 'text/javascript',
    '.wasm': 'application/wasm', '.json': 'application/json', '.png': 'image/png', '.svg': 'image/svg+xml',
    '.glb': 'model/gltf-binary', '.ts': 'text/plain',
};

// Isolated pages have clocks of 5 microseconds instead of 100. Browsers isolate those alone whose address they trust.
const isolating = {'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp'};
const trusted = /^(localhost|127\.0\.0\.1)(:|$)/;

/// `folders`: {'/name/': folder}, looked up by the longest name. Gives {url, close()}; port 0 is any free one.
export async function serve(folders, port = 0) {
    const names = Object.keys(folders).sort((a, b) => b.length - a.length);
    const server = http.createServer((request, response) => {
        let name = decodeURIComponent(new URL(request.url, 'http://localhost').pathname);
        if (name.endsWith('/')) name += 'index.html';
        const prefix = names.find(n => name.startsWith(n));
        const root = prefix && path.resolve(folders[prefix]);
        const file = prefix && path.join(root, name.slice(prefix.length));
        const stat = file?.startsWith(root + path.sep) && statSync(file, {throwIfNoEntry: false});
        if (!stat?.isFile()) {
            response.writeHead(404).end(`${name} is not here.`);
            return;
        }
        // Asked for each time, sent only where it has changed: so browsers may keep what they compiled.
        const tag = `"${stat.size.toString(36)}-${Math.round(stat.mtimeMs).toString(36)}"`;
        if (request.headers['if-none-match'] === tag) {
            response.writeHead(304, {'ETag': tag}).end();
            return;
        }
        response.writeHead(200, {
            'Content-Type': types[path.extname(file)] ?? 'application/octet-stream',
            'Content-Length': stat.size,
            'Cache-Control': 'no-cache',
            ...(trusted.test(request.headers.host) ? isolating : {}),
            'ETag': tag,
        });
        createReadStream(file).pipe(response);
    });
    await new Promise((resolve, reject) => {
        server.on('error', reject);
        server.listen(port, '127.0.0.1', resolve);
    });
    return {url: `http://127.0.0.1:${server.address().port}/`, close: () => new Promise(resolve => server.close(resolve))};
}

if (process.argv[1] && import.meta.url === pathToFileURL(process.argv[1]).href) {
    const [folder = '.', port = '8080'] = process.argv.slice(2);
    const {url} = await serve({'/': folder}, Number(port));
    console.log(`${folder} is served on ${url}`);
}
