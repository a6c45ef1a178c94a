import type * as THREE from 'three';

const SAMPLES = 4;

/**
 * Smooth edges by several samples a pixel. Where a processor draws instead of graphics hardware, they take longer than all the
 * rest of a picture; so they can be left out while something moves.
 */
export class Smoothing {
  /** Whether the browser draws in software. */
  readonly software: boolean;
  private readonly gl: WebGL2RenderingContext;
  private buffer: WebGLFramebuffer | null = null;
  private stores: WebGLRenderbuffer[] = [];
  private width = 0;
  private height = 0;

  /** The renderer itself smooths nothing: `antialias` is off. */
  constructor(private readonly renderer: THREE.WebGLRenderer) {
    this.gl = renderer.getContext() as WebGL2RenderingContext;
    const info = this.gl.getExtension('WEBGL_debug_renderer_info');
    const name = info ? String(this.gl.getParameter(info.UNMASKED_RENDERER_WEBGL)) : '';
    this.software = /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
  }

  render(scene: THREE.Scene, camera: THREE.Camera, smooth: boolean): void {
    const { gl, renderer } = this;
    if (!smooth || !this.prepare()) return renderer.render(scene, camera);
    renderer.state.bindFramebuffer(gl.FRAMEBUFFER, this.buffer);
    renderer.render(scene, camera);
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, this.buffer);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, null);
    const { width, height } = this;
    gl.disable(gl.SCISSOR_TEST);
    gl.blitFramebuffer(0, 0, width, height, 0, 0, width, height, gl.COLOR_BUFFER_BIT, gl.NEAREST);
    gl.invalidateFramebuffer(gl.READ_FRAMEBUFFER, [gl.COLOR_ATTACHMENT0, gl.DEPTH_ATTACHMENT]);
    // What was bound behind the renderer's back.
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, null);
    renderer.state.bindFramebuffer(gl.FRAMEBUFFER, null);
  }

  /** A buffer as large as the canvas; false where there is none. */
  private prepare(): boolean {
    const { gl } = this;
    const { drawingBufferWidth: width, drawingBufferHeight: height } = gl;
    if (this.buffer && width === this.width && height === this.height) return true;
    gl.deleteFramebuffer(this.buffer);
    for (const store of this.stores) gl.deleteRenderbuffer(store);
    this.buffer = gl.createFramebuffer();
    [this.width, this.height] = [width, height];
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.buffer);
    const samples = Math.min(SAMPLES, gl.getParameter(gl.MAX_SAMPLES) as number);
    this.stores = (
      [
        [gl.RGBA8, gl.COLOR_ATTACHMENT0],
        [gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT],
      ] as const
    ).map(([format, place]) => {
      const store = gl.createRenderbuffer() as WebGLRenderbuffer;
      gl.bindRenderbuffer(gl.RENDERBUFFER, store);
      gl.renderbufferStorageMultisample(gl.RENDERBUFFER, samples, format, width, height);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, store);
      return store;
    });
    const complete = gl.checkFramebufferStatus(gl.FRAMEBUFFER) === gl.FRAMEBUFFER_COMPLETE;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.bindRenderbuffer(gl.RENDERBUFFER, null);
    if (!complete) this.width = 0;
    return complete;
  }
}
