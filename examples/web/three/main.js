// SPDX-License-Identifier: MIT
//
// Exact shadows in a page that three.js draws. three.js draws depth first, into a render target; gnomon makes a mask of it, one
// bit a light; and each light gets a shadow node that looks its bit up, in place of a shadow map. Materials, geometry and lights
// are three's own, and nothing else of it knows. What gnomon adds is marked by "guest".
import * as THREE from 'three/webgpu';
import {ivec2, screenCoordinate, select, textureLoad, uint} from 'three/tsl';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';
import {createShadows, featuresOf} from 'gnomon-shadows';  // guest

// guest: one device for both.
const adapter = await navigator.gpu?.requestAdapter();
if (!adapter) throw new Error('This browser has no WebGPU.');
const device = await adapter.requestDevice({requiredFeatures: featuresOf(adapter)});

const canvas = document.querySelector('canvas');
const renderer = new THREE.WebGPURenderer({canvas, device, reversedDepthBuffer: true});  // one sample: bits have one
renderer.toneMapping = THREE.ACESFilmicToneMapping;
renderer.shadowMap.enabled = true;  // guest: so that shadow nodes are asked; no map is drawn
await renderer.init();

const scene = new THREE.Scene();
scene.background = new THREE.Color(0x14161a);
const camera = new THREE.PerspectiveCamera(45, 1, 0.1, 100);
camera.position.set(4.5, 4, 6.5);
const controls = new OrbitControls(camera, canvas);
controls.target.set(0, 0.8, 0);

const add = (geometry, color, position, more = {}) => {
    const mesh = new THREE.Mesh(geometry, new THREE.MeshStandardMaterial({color, roughness: 0.6, ...more}));
    mesh.position.set(...position);
    mesh.receiveShadow = true;
    scene.add(mesh);
    return mesh;
};
add(new THREE.BoxGeometry(30, 0.2, 30), 0xbfbdb6, [0, -0.1, 0], {roughness: 0.9});
const knot = add(new THREE.TorusKnotGeometry(0.6, 0.2, 160, 24), 0xc4552d, [0, 1.5, 0], {roughness: 0.35, metalness: 0.1});
add(new THREE.CylinderGeometry(0.25, 0.35, 1.6, 32), 0x5f7f4f, [-2.2, 0.8, 0.6]);
add(new THREE.BoxGeometry(0.9, 0.9, 0.9), 0x3f6f9f, [1.9, 0.45, 1.1]).rotation.y = 0.6;
add(new THREE.IcosahedronGeometry(0.5, 0), 0xc9a23f, [0.2, 0.5, 2.3]);

const lamp = new THREE.PointLight(0xffd9a0, 40);
const sun = new THREE.DirectionalLight(0xbfd4ff, 0.9);
sun.position.set(-3, 5, -2);
scene.add(lamp, sun, new THREE.HemisphereLight(0x8fa3bf, 0x30281f, 0.25));
const bulb = new THREE.Mesh(new THREE.SphereGeometry(0.06), new THREE.MeshBasicMaterial({color: 0xffe6c0}));
scene.add(bulb);

// ---- guest: every mesh that takes shadows casts them as well.
const shadows = await createShadows(device);
shadows.lost.then(sentence => { document.querySelector('p').textContent = sentence; });
const casters = new Map();
scene.traverse(mesh => {
    if (!mesh.receiveShadow) return;
    const {index, attributes} = mesh.geometry;
    const shadowMesh = shadows.addMesh({positions: attributes.position.array, indices: index?.array});
    casters.set(mesh, shadows.addCaster(shadowMesh));
});

// guest: the mask as a texture of three's, and its bits as shadow nodes.
const mask = new THREE.ExternalTexture();
mask.format = THREE.RedIntegerFormat;
mask.type = THREE.UnsignedIntType;
const worldPosition = light => light.getWorldPosition(new THREE.Vector3());
const lights = [lamp, sun].map(light => {
    const guest = shadows.addLight(light.isDirectionalLight ? {type: 'directional', direction: [0, -1, 0]}
                                                            : {type: 'point', position: [0, 1, 0]});
    const bits = textureLoad(mask, ivec2(screenCoordinate.xy)).r;
    light.castShadow = true;
    light.shadow.shadowNode = select(bits.shiftRight(uint(guest.bit)).bitAnd(uint(1)).equal(uint(0)), 1.0, 0.0);
    return {light, guest};
});

// guest: depth, which three draws into a target of its own.
const depthTexture = new THREE.DepthTexture(1, 1, THREE.FloatType);
const depthTarget = new THREE.RenderTarget(1, 1, {depthTexture});
const depthMaterial = new THREE.MeshBasicMaterial({colorWrite: false});

function drawDepthAndMask() {
    scene.overrideMaterial = depthMaterial;
    bulb.visible = false;
    renderer.setRenderTarget(depthTarget);
    renderer.render(scene, camera);
    renderer.setRenderTarget(null);
    bulb.visible = true;
    scene.overrideMaterial = null;

    for (const [mesh, caster] of casters) caster.setTransform(mesh.matrixWorld.elements);
    for (const {light, guest} of lights) {
        const at = worldPosition(light);
        guest.set(light.isDirectionalLight ? {direction: worldPosition(light.target).sub(at).toArray()} : {position: at.toArray()});
    }
    const drawn = shadows.render({
        depth: renderer.backend.get(depthTexture).texture,
        view: camera.matrixWorldInverse.elements,
        projection: camera.projectionMatrix.elements,
        reversed: renderer.reversedDepthBuffer,
    });
    if (mask.sourceTexture !== drawn.mask) {  // another size, another texture
        mask.dispose();
        mask.sourceTexture = drawn.mask;
        mask.needsUpdate = true;
    }
}

let frames = 0;
renderer.setAnimationLoop(milliseconds => {
    const width = canvas.clientWidth, height = canvas.clientHeight;
    const size = renderer.getSize(new THREE.Vector2());
    if (size.x !== width || size.y !== height) {
        renderer.setPixelRatio(devicePixelRatio);
        renderer.setSize(width, height, false);
        depthTarget.setSize(canvas.width, canvas.height);  // guest
        camera.aspect = width / height;
        camera.fov = camera.aspect < 1 ? 65 : 45;
        camera.updateProjectionMatrix();
    }
    const seconds = milliseconds / 1000;
    knot.rotation.set(0.3 * seconds, 0.5 * seconds, 0);
    lamp.position.set(2.4 * Math.cos(0.6 * seconds), 3.4, 2.4 * Math.sin(0.6 * seconds));
    bulb.position.copy(lamp.position);
    controls.update();

    drawDepthAndMask();  // guest
    renderer.render(scene, camera);
    document.body.dataset.frames = ++frames;
});

export {camera, lights, mask, renderer, scene, shadows};  // for whoever looks at it from outside, as the tests do
