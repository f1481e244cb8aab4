// Draws the panes side by side with one camera for all, so that they always show the same view.
import {
  Box3, Color, Object3D, PerspectiveCamera, Raycaster, Scene, Sphere, Vector2, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { pixelRatio, viewport } from "./lines";

export interface Pane {
  id: string;
  title: string;
  scene: Scene;
  isShown: boolean;
  /** Called before each picture. @param isInMotion  it must be drawn quickly. */
  prepare(isInMotion: boolean): void;
}

interface Place { x: number; y: number; width: number; height: number }

const fieldOfView = 32;
// Milliseconds.
const flightTime = 450;
const restTime = 160;  // After the last change of the view.
const slowFrame = 45;
const softwareRatioInMotion = 0.5;
const pause = 600;  // Pictures in motion that are farther apart belong to two motions.

/** A ray through a pane, in the coordinates of the meshes. */
export interface Ray { pane: Pane; origin: Vector3; direction: Vector3 }

export class Stage {
  readonly camera = new PerspectiveCamera(fieldOfView, 1, 0.01, 1000);
  readonly controls: OrbitControls;
  frames = 0;
  isFlying = false;
  onPick: (ray: Ray) => void = () => {};
  onLayout: (places: { pane: Pane; place: Place }[]) => void = () => {};
  private readonly renderer: WebGLRenderer;
  private readonly background = new Color();
  private isRequested = false;
  private isInMotion = false;
  private restTimer = 0;
  private lastMotion = 0;  // When the last picture in motion was drawn.
  private isAtHome = false;  // The view is that of reset().
  private readonly isSoftware: boolean;
  private isSlow: boolean;

  constructor(private readonly canvas: HTMLCanvasElement, readonly panes: Pane[],
              private readonly sphere: Sphere) {
    this.renderer = new WebGLRenderer({ canvas, antialias: false, powerPreference: "high-performance" });
    this.renderer.setScissorTest(true);
    this.isSoftware = this.isSlow = isDrawnBySoftware(this.renderer.getContext());
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.addEventListener("change", () => this.move());
    this.controls.addEventListener("start", () => { this.isAtHome = false; });
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.listenForPicks();
    this.resize();
    this.reset();
  }

  setBackground(color: string): void {
    this.background.set(color);
    this.request();
  }

  /** Draws with the next frame of the browser, however often it is called before. */
  request(): void {
    if (this.isRequested) return;
    this.isRequested = true;
    requestAnimationFrame(() => {
      this.isRequested = false;
      if (this.isInMotion) this.watchTime();
      this.render(this.isInMotion && this.isSlow);
    });
  }

  // The view has changed, and may do so again at once.
  private move(): void {
    this.isInMotion = true;
    window.clearTimeout(this.restTimer);
    this.restTimer = window.setTimeout(() => {
      this.isInMotion = false;
      this.request();
    }, restTime);
    this.request();
  }

  // The time from picture to picture tells how long drawing takes.
  private watchTime(): void {
    const now = performance.now();
    if (now - this.lastMotion > slowFrame && now - this.lastMotion < pause) this.isSlow = true;
    this.lastMotion = now;
  }

  /** @param isQuick  dense meshes may be drawn coarsely, and with fewer pixels. */
  render(isQuick = false): void {
    this.setPixelRatio(isQuick);
    const places = this.places();
    const { near, far } = this.depths();
    this.camera.near = near;
    this.camera.far = far;
    for (const { pane, place } of places) {
      const fromBelow = this.canvas.clientHeight - place.y - place.height;
      this.renderer.setViewport(place.x, fromBelow, place.width, place.height);
      this.renderer.setScissor(place.x, fromBelow, place.width, place.height);
      this.renderer.setClearColor(this.background);
      this.camera.aspect = place.width / place.height;
      this.camera.updateProjectionMatrix();
      viewport.value.set(place.width, place.height);
      pane.prepare(isQuick);
      this.renderer.render(pane.scene, this.camera);
    }
    ++this.frames;
  }

  /** Looks at everything from the front. */
  reset(): void {
    const { center, radius } = this.sphere;
    this.fly(center, new Vector3(0.45, 0.32, 0.83), this.distanceFor(radius), true);
    this.isAtHome = true;
  }

  /** Looks at a point along the direction from it to the camera. */
  fly(target: Vector3, from: Vector3, distance: number, isAtOnce = prefersStill()): void {
    const position = target.clone().addScaledVector(from.clone().normalize(), distance);
    if (isAtOnce) return this.place(position, target);
    const startPosition = this.camera.position.clone(), startTarget = this.controls.target.clone();
    const start = performance.now();
    this.isFlying = true;
    const step = () => {
      const share = Math.min(1, (performance.now() - start) / flightTime);
      const eased = share * share * (3 - 2 * share);
      this.place(startPosition.clone().lerp(position, eased), startTarget.clone().lerp(target, eased));
      this.isFlying = share < 1;
      if (this.isFlying) requestAnimationFrame(step);
    };
    step();
  }

  turn(right: number, up: number): void {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const axis = new Vector3().crossVectors(this.camera.up, offset).normalize();
    const turned = offset.clone().applyAxisAngle(this.camera.up, -right).applyAxisAngle(axis, -up);
    if (Math.abs(turned.clone().normalize().dot(this.camera.up)) > 0.995) return;
    this.place(this.controls.target.clone().add(turned), this.controls.target);
  }

  zoom(factor: number): void {
    const offset = this.camera.position.clone().sub(this.controls.target).multiplyScalar(factor);
    this.place(this.controls.target.clone().add(offset), this.controls.target);
  }

  resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.setPixelRatio(false);
    this.renderer.setSize(clientWidth, clientHeight, false);
    if (this.isAtHome) this.reset();
    this.onLayout(this.places());
    this.request();
  }

  // Two samples a side smooth the edges where drawing is quick.
  private setPixelRatio(isQuick: boolean): void {
    const ratio = this.isSoftware ? (isQuick ? softwareRatioInMotion : 1)
                                  : Math.max(2, Math.min(window.devicePixelRatio, 3));
    if (ratio === pixelRatio.value) return;
    pixelRatio.value = ratio;
    this.renderer.setPixelRatio(ratio);
  }

  /** In CSS pixels, from the top. */
  places(): { pane: Pane; place: Place }[] {
    const shown = this.panes.filter((pane) => pane.isShown);
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const isWide = width >= height || shown.length === 1;
    return shown.map((pane, i) => {
      const size = (isWide ? width : height) / shown.length;
      const begin = Math.round(i * size), end = Math.round((i + 1) * size);
      const place = isWide ? { x: begin, y: 0, width: end - begin, height }
                           : { x: 0, y: begin, width, height: end - begin };
      return { pane, place };
    });
  }

  private place(position: Vector3, target: Vector3): void {
    this.isAtHome = false;
    this.camera.position.copy(position);
    this.controls.target.copy(target);
    this.controls.update();
    this.request();
  }

  private distanceFor(radius: number): number {
    const [first] = this.places();
    const aspect = first ? first.place.width / first.place.height : 1;
    const half = Math.tan(fieldOfView * Math.PI / 360) * Math.min(1, aspect);
    return 0.92 * radius / Math.sin(Math.atan(half));
  }

  private depths(): { near: number; far: number } {
    const distance = this.camera.position.distanceTo(this.sphere.center);
    const radius = 1.05 * this.sphere.radius;
    const toTarget = this.camera.position.distanceTo(this.controls.target);
    const near = Math.max(distance - radius, Math.min(0.02 * toTarget, 0.2 * radius));
    return { near, far: distance + radius };
  }

  private listenForPicks(): void {
    const down = new Vector2();
    this.canvas.addEventListener("pointerdown", (event) => down.set(event.clientX, event.clientY));
    this.canvas.addEventListener("pointerup", (event) => {
      if (down.distanceTo(new Vector2(event.clientX, event.clientY)) > 4) return;
      const box = this.canvas.getBoundingClientRect();
      const ray = this.rayAt(event.clientX - box.left, event.clientY - box.top);
      if (ray) this.onPick(ray);
    });
  }

  private rayAt(x: number, y: number): Ray | null {
    for (const { pane, place } of this.places()) {
      const u = (x - place.x) / place.width, v = (y - place.y) / place.height;
      if (u < 0 || u > 1 || v < 0 || v > 1) continue;
      this.camera.aspect = place.width / place.height;
      this.camera.updateProjectionMatrix();
      this.camera.updateMatrixWorld();  // The view may have changed since the last picture.
      const caster = new Raycaster();
      caster.setFromCamera(new Vector2(2 * u - 1, 1 - 2 * v), this.camera);
      return { pane, origin: caster.ray.origin, direction: caster.ray.direction };
    }
    return null;
  }
}

// Whether the processor draws.
function isDrawnBySoftware(context: WebGLRenderingContext | WebGL2RenderingContext): boolean {
  const names = context.getExtension("WEBGL_debug_renderer_info");
  const name = names ? String(context.getParameter(names.UNMASKED_RENDERER_WEBGL)) : "";
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}

function prefersStill(): boolean {
  return window.matchMedia("(prefers-reduced-motion: reduce)").matches;
}

export function sphereOf(objects: { sphere: Sphere }[]): Sphere {
  const box = new Box3();
  for (const { sphere } of objects) box.union(sphere.getBoundingBox(new Box3()));
  const all = box.getBoundingSphere(new Sphere());
  all.radius = Math.max(...objects.map((o) => o.sphere.radius + o.sphere.center.distanceTo(all.center)));
  return all;
}

export function sceneOf(...objects: Object3D[]): Scene {
  const scene = new Scene();
  scene.add(...objects);
  return scene;
}
