// SPDX-License-Identifier: MIT
//
// gnomon-shadows: exact hard shadows for a page's own WebGPU renderer.
//
// The page draws its depth; gnomon counts shadow volumes against it and writes masks: one texture of 32-bit integers with a
// bit a light, or one of bytes a light. The page's shaders look them up where they shade. As everywhere in gnomon 0 is light.
//
// Spaces and units: the world is right- or left-handed, as the page has it; lengths are metres, or whatever unit the page uses
// throughout. Matrices are column-major and multiply column vectors. Clip space is WebGPU's: y up, depth from 0 to 1.
//
// Errors: a TypeError where an argument is something else than it has to be, a RangeError where it is beyond a limit, and an
// Error with `code` for what the device or the camera cannot do. Each message is one sentence, or few, and names the value.
//
// Types of WebGPU come from TypeScript's own "dom" where it has them, else from the package @webgpu/types.

/** Sixteen finite numbers, column by column. */
export type Matrix = Float32Array | Float64Array | readonly number[];
/** Three finite numbers. */
export type Vector = Float32Array | Float64Array | readonly number[];

/** What an Error of this package has in `code`. */
export type ErrorCode = 'invalid-input' | 'validation' | 'unsupported' | 'out-of-memory' | 'device-lost' | 'io' | 'internal';

/** Features that a device must have: "depth32float-stencil8". */
export declare const requiredFeatures: readonly GPUFeatureName[];
/** Features that are used where they are there: "depth-clip-control", for cameras with a far plane. */
export declare const optionalFeatures: readonly GPUFeatureName[];

/**
 * What to ask of `adapter.requestDevice({requiredFeatures})`: all that is required and what there is of the rest.
 * Throws an Error ("unsupported") where the adapter lacks one that is required.
 */
export declare function featuresOf(adapter: GPUAdapter): GPUFeatureName[];

/** How near caps are moved off the surfaces that they lie on; both at least 0. */
export interface CapBias {
    /** In the smallest steps of depth; a whole number. */
    constant: number;
    /** In pixels along the surface. */
    slopeScale: number;
}

export interface ShadowsOptions {
    /**
     * "bits" (the default): one mask of r32uint, bit `light.bit` of which is set where the light does not arrive. Depth has one
     * sample. "shares": a mask of r8unorm for each light, the share of a pixel's samples that it does not arrive at (1 or 0
     * where depth has one sample, else in quarters).
     */
    masks?: 'bits' | 'shares';
    /**
     * For depth from vertex shaders of the page's own: {constant: 4, slopeScale: 1 / 64} where nothing is said. null: none, for
     * those that take positions from `positionWGSL` and `clipFromLocal()`, whose depth has the very bits of shadow volumes.
     */
    capBias?: CapBias | null;
    /** Where gnomon-shadows.wasm is, or its bytes; beside index.js where nothing is said. */
    wasm?: string | URL | ArrayBuffer | ArrayBufferView;
}

/**
 * Shadows on a device of the page's, which stays the page's: errors of WebGPU's are for it to hear, and what was drawn before
 * on its queue is there. Each call has a WebAssembly module and memory of its own; several may share a device.
 * Rejects with an Error ("unsupported") where the device lacks a required feature, and ("internal") where the WebAssembly
 * does not load.
 */
export declare function createShadows(device: GPUDevice, options?: ShadowsOptions): Promise<Shadows>;

export interface MeshOptions {
    /** Three floats a vertex, in the caster's space. Copied. */
    positions: Float32Array;
    /** Three a triangle, counter-clockwise from outside; all vertices in their order where there are none. Copied. */
    indices?: Uint32Array | Uint16Array;
    /**
     * One number a vertex, for meshes that are deformed: vertices at one place are welded only where these are equal too, so
     * give equal numbers to what stays together in every pose.
     */
    identities?: Uint32Array;
}

/** What was found in a mesh. None of it is an error: the shadow is right whatever it says, but open edges cost more. */
export interface MeshReport {
    /** Every edge of every component cancels: two faces that run along it in opposite directions. */
    readonly closed: boolean;
    /** As given. */
    readonly triangles: number;
    /** As given. */
    readonly vertices: number;
    /** Distinct places that triangles use. */
    readonly weldedVertices: number;
    readonly edges: number;
    /** Connected through edges. */
    readonly components: number;
    readonly closedComponents: number;
    /** Of one face. */
    readonly boundaryEdges: number;
    /** Of three faces or more. */
    readonly nonManifoldEdges: number;
    /** Of two faces that run along it the same way. */
    readonly inconsistentEdges: number;
    /** Whose signed sum of faces is not zero. */
    readonly unbalancedEdges: number;
    /** Without an area: they cast nothing. */
    readonly degenerateFaces: number;
}

/** Triangles as shadows need them, for any number of casters. */
export declare class Mesh {
    private constructor();
    readonly report: MeshReport;
    readonly removed: boolean;
    /**
     * The same triangles with other positions, as many as the mesh has vertices: edges and components are not found anew, as
     * they are for another mesh. For skins and morphs; give the result to `caster.setMesh()` and remove the last one.
     */
    deformed(positions: Float32Array): Mesh;
    /** Frees it; casters keep theirs. Does nothing the second time. */
    remove(): void;
}

export interface CasterOptions {
    /** From the mesh's space to the world: affine, mirrored or uneven too. The identity where nothing is said. */
    transform?: Matrix;
    /** Whether it casts; true where nothing is said. */
    visible?: boolean;
    /**
     * Whether all of it is in the depth that is given to render(): drawn, unculled on the side of the light, undiscarded. true
     * where nothing is said; false costs some fill.
     */
    inDepth?: boolean;
    /**
     * "averted" puts the caps of solids on faces where no direct light reaches, for depth from the page's own shaders: then
     * light is to be multiplied by whether the geometric N.L is positive. "facing" where nothing is said.
     */
    nearCaps?: 'facing' | 'averted';
}

/** A mesh somewhere in the world. */
export declare class Caster {
    private constructor();
    /** A copy and a call; what it leads to is worked out by render(). */
    setTransform(transform: Matrix): void;
    setMesh(mesh: Mesh): void;
    /** Whether it casts. */
    visible: boolean;
    readonly removed: boolean;
    /** Does nothing the second time. */
    remove(): void;
}

/** Each kind is told where it is; its colour, cone and falloff are the page's business. */
export interface LightOptions {
    /** A spot light casts as a point light does: its cone dims light and moves no shadow. */
    type: 'point' | 'spot' | 'directional';
    /** In the world, for point and spot lights. */
    position?: Vector;
    /** The way that the light of a directional light goes, of any length but 0. */
    direction?: Vector;
    /** It lights nothing beyond, so that casters beyond are left out; Infinity where nothing is said. */
    range?: number;
}

export declare class Light {
    private constructor();
    /** The light's bit in a mask of bits, and its place among masks of shares. It stays while the light is there. */
    readonly bit: number;
    readonly removed: boolean;
    /** Changes what is named; the rest stays. */
    set(options: Partial<LightOptions>): void;
    /** Its bit is 0 until another light gets it. Does nothing the second time. */
    remove(): void;
}

export interface RenderOptions {
    /**
     * What the page has drawn: 2D, one layer, one mip level.
     *
     * depth32float-stencil8 with usage RENDER_ATTACHMENT: volumes are counted in its stencil, which is 0 afterwards. Give the
     * same texture each time: for another one pipelines are made anew.
     *
     * depth32float, depth24plus, depth24plus-stencil8, or `keepStencil`, with usage TEXTURE_BINDING: it is copied into a
     * texture of gnomon's, by one pass. 32-bit floats keep their bits. What depth24plus stores is the browser's choice; where
     * that is 24 bits, depth should run forward, so that a step is no wider than what the bias moves caps by.
     */
    depth: GPUTexture;
    /** From the world to the camera: rotation and translation, looking along -Z or +Z. */
    view: Matrix;
    /**
     * From the camera to clip space: perspective, off-axis or orthographic. One with a far plane needs the device's feature
     * "depth-clip-control" wherever a caster's shadow could reach the eye.
     */
    projection: Matrix;
    /** The greater depth is nearer, and depth is cleared to 0; false where nothing is said. */
    reversed?: boolean;
    /**
     * All is recorded there, after what is in it, and submitted with it; no pass is open. It is uploaded for at once, so submit
     * it before this view is rendered again. Without one, gnomon submits to the device's queue by itself.
     */
    encoder?: GPUCommandEncoder | null;
    /** Copies depth32float-stencil8 as well, so that its stencil stays; false where nothing is said. */
    keepStencil?: boolean;
}

/** What was drawn, and what it took. */
export interface RenderStats {
    casters: number;
    /** Of a light and a caster. */
    pairs: number;
    /** Without a shadow volume, since it could change nothing. */
    pairsCulled: number;
    /** With one that changes nothing in this view. */
    pairsHidden: number;
    /** Whose silhouette was found anew. */
    pairsRedetected: number;
    /** Whose silhouette stayed. */
    pairsReused: number;
    depthPassPairs: number;
    depthFailPairs: number;
    silhouetteEdges: number;
    /** Milliseconds of finding silhouettes. */
    detectMs: number;
    /** Milliseconds of building volumes. */
    buildMs: number;
    drawCalls: number;
    uploadedBytes: number;
}

export interface Rendered {
    /** Of r32uint and the depth's size: bit `light.bit` of texel (x, y) is set where the light does not arrive at pixel (x, y).
     *  null with masks: "shares". Read it with textureLoad(). */
    mask: GPUTexture | null;
    /** The one above, or with masks: "shares" one of r8unorm for each light, by `light.bit`. */
    masks: readonly GPUTexture[];
    stats: RenderStats;
}

/** A camera with masks of its own: of a split screen, an eye, a mirror. */
export declare class View {
    private constructor();
    /**
     * Writes the masks. They stay the same textures while the depth's size does, and are gnomon's: for another size they are
     * destroyed and others are there. Throws an Error ("unsupported") for
     * a camera that shadow volumes cannot be right in (a scaled view, an oblique near plane, depth that runs the other way than
     * `reversed` says), and an Error where the view is in that encoder already.
     */
    render(options: RenderOptions): Rendered;
    /** Of the last render(). */
    readonly mask: GPUTexture | null;
    /** Of the last render(). */
    readonly masks: readonly GPUTexture[];
    readonly removed: boolean;
    /** Frees its masks, which must not be in an encoder that is still to be submitted. */
    remove(): void;
}

/** Meshes, casters, lights and views. */
export declare class Shadows {
    private constructor();
    readonly device: GPUDevice;
    /** Whether all cameras with a far plane can be drawn ("depth-clip-control"). */
    readonly features: {readonly farPlanes: boolean};
    /** Resolves to one sentence when the device is lost. Then calls throw it ("device-lost"); begin again on another device. */
    readonly lost: Promise<string>;
    /** Finds the mesh's topology: about a microsecond a triangle, once. */
    addMesh(options: MeshOptions): Mesh;
    addCaster(mesh: Mesh, options?: CasterOptions): Caster;
    /** At most 32 at a time: a RangeError beyond. It gets the lowest bit that is free. */
    addLight(options: LightOptions): Light;
    /** Casters and lights are those of all views. */
    addView(): View;
    /** Of a view that is there from the beginning. */
    render(options: RenderOptions): Rendered;
    /** Frees all that gnomon made on the device. Other calls throw from then on; a second one does nothing. */
    dispose(): void;
}

/**
 * WGSL of `fn clip_position(clip_from_local: mat4x4f, p: vec4f) -> vec4f`, by which shadow volumes are put into clip space. A
 * vertex shader that returns it as `@invariant @builtin(position)` has their bits, and needs no `capBias`.
 */
export declare const positionWGSL: string;
/** The matrix for it: projection * view * transform, multiplied in double precision and rounded once. */
export declare function clipFromLocal(projection: Matrix, view: Matrix, transform: Matrix): Float32Array;
