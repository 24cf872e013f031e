/** When a frame is drawn, and how finely: only when something moved, coarsely where the processor does it. */

import { WebGLRenderer } from "three";

const SLOW_MS = 60; // frames that come so late are too dear
const STANDS_MS = 300;

export class Painter {
  readonly renderer: WebGLRenderer | null;
  /** Drawn by the processor, for want of a graphics card. */
  readonly soft: boolean;
  private frames = 0;
  private waiting = false;
  private coarse = false; // since more frames are coming
  private late = 0; // how late frames come, smoothed [ms]
  private settling = 0;

  constructor(canvas: HTMLCanvasElement, private readonly draw: (renderer: WebGLRenderer) => void) {
    let renderer: WebGLRenderer | null = null, soft = false;
    try {
      soft = drawnInSoftware();
      renderer = new WebGLRenderer({ canvas, antialias: !soft, alpha: true, preserveDrawingBuffer: true });
      renderer.debug.checkShaderErrors = false; // asking for them stalls the first frame
    } catch {
      // no WebGL: the rest of the page stands without it
    }
    this.renderer = renderer;
    this.soft = soft;
    renderer?.setPixelRatio(this.ratio());
  }

  /**
   * Without a graphics card a frame costs tens of milliseconds, most of it by the pixel: while things move they are
   * drawn coarsely, and once more finely when they stand. A card that falls behind is treated likewise.
   */
  private ratio(): number {
    const fine = this.soft ? 2 : Math.min(2, devicePixelRatio);
    return this.coarse ? Math.min(fine, this.soft ? 0.8 : 1) : fine;
  }

  /** Draw with the next frame. */
  invalidate(): void {
    if (this.waiting) return;
    this.waiting = true;
    const asked = performance.now();
    requestAnimationFrame(() => {
      this.waiting = false;
      this.late += 0.2 * (Math.min(500, performance.now() - asked) - this.late);
      clearTimeout(this.settling);
      if (this.frames > 2 && (this.soft || this.late > SLOW_MS)) {
        this.coarse = true;
        this.settling = window.setTimeout(() => this.finely(), STANDS_MS);
      }
      this.paint();
    });
  }

  /** At once, and as finely as it can be. */
  finely(): void {
    this.coarse = false;
    this.paint();
  }

  private paint(): void {
    const { renderer } = this;
    if (!renderer) return;
    if (renderer.getPixelRatio() !== this.ratio()) renderer.setPixelRatio(this.ratio());
    this.frames++;
    this.draw(renderer);
  }

  /** Give the graphics card back. */
  end(): void {
    clearTimeout(this.settling);
    this.renderer?.dispose();
    this.renderer?.forceContextLoss();
  }
}

/** Whether WebGL is the processor's work here. */
function drawnInSoftware(): boolean {
  const gl = document.createElement("canvas").getContext("webgl");
  const names = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = gl && names ? String(gl.getParameter(names.UNMASKED_RENDERER_WEBGL)) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}
