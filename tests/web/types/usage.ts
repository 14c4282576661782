// SPDX-License-Identifier: MIT
//
// What a host in TypeScript writes, and what the types have to refuse: package_files.mjs checks it with tsc --strict.
import {
    clipFromLocal, createShadows, featuresOf, positionWGSL, requiredFeatures,
    type Caster, type CapBias, type ErrorCode, type Light, type Mesh, type RenderStats, type Shadows, type View,
} from 'gnomon-shadows';

export async function host(adapter: GPUAdapter, depth: GPUTexture, encoder: GPUCommandEncoder): Promise<number> {
    const device: GPUDevice = await adapter.requestDevice({requiredFeatures: featuresOf(adapter)});
    const bias: CapBias = {constant: 4, slopeScale: 0};
    const shadows: Shadows = await createShadows(device, {masks: 'bits', capBias: bias, wasm: new URL('https://localhost/x.wasm')});
    await createShadows(device, {capBias: null, wasm: new Uint8Array(8)});
    const mesh: Mesh = shadows.addMesh({positions: new Float32Array(9), indices: new Uint16Array([0, 1, 2])});
    const open: boolean = !mesh.report.closed;
    const caster: Caster = shadows.addCaster(mesh, {transform: new Float64Array(16), nearCaps: open ? 'facing' : 'averted'});
    caster.setTransform([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
    caster.setMesh(mesh.deformed(new Float32Array(9)));
    caster.visible = false;
    const light: Light = shadows.addLight({type: 'directional', direction: [0, -1, 0]});
    light.set({type: 'point', position: new Float32Array(3), range: 20});
    const view: View = shadows.addView();
    const matrix = clipFromLocal(new Float32Array(16), new Float32Array(16), new Float32Array(16));
    const {mask, masks, stats} = view.render({depth, view: matrix, projection: matrix, reversed: true, encoder, keepStencil: false});
    const told: RenderStats = stats;
    const texture: GPUTexture | undefined = mask ?? masks[light.bit];
    texture?.createView();
    shadows.lost.then(sentence => console.log(sentence.length));
    const code: ErrorCode = 'device-lost';
    for (const thing of [mesh, caster, light, view]) thing.remove();
    shadows.dispose();
    return told.pairs + positionWGSL.length + requiredFeatures.length + code.length;
}

export async function refused(device: GPUDevice): Promise<void> {
    // @ts-expect-error: an option that there is not
    const shadows = await createShadows(device, {mask: 'bits'});
    // @ts-expect-error: positions are floats
    const mesh = shadows.addMesh({positions: [0, 0, 0]});
    // @ts-expect-error: no such kind of light
    shadows.addLight({type: 'area', position: [0, 0, 0]});
    // @ts-expect-error: casters are made by addCaster()
    new (Object(mesh).constructor as typeof Caster)();
    // @ts-expect-error: a report is read
    mesh.report.closed = true;
    // @ts-expect-error: the camera is missing
    shadows.render({depth: device.createTexture({size: [1, 1], format: 'depth32float', usage: 16})});
}
