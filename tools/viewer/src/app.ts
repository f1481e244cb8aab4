// The state of the page, and what changes it. Controls, keys and lists call these functions.
import { Vector3 } from "three";
import { ColorMode, cornerColors, hasMode, NamedMode, Scale, scaleOf } from "./colors";
import { Marker } from "./marker";
import { outlookOn } from "./outlook";
import { Frame, fromDrawn, PageMesh, Point, toDrawn, WorstFace } from "./page_data";
import { faceAlong, faceAt, FaceFigures, figuresOf } from "./pick";
import { cornersOf } from "./shapes";
import { Pane, Ray, sceneOf, sphereOf, Stage } from "./stage";
import { Layer, surfaceMaterial, SurfaceView } from "./surface";

export type Side = "original" | "result";

export interface Picked { side: Side; title: string; figures: FaceFigures }

export type Theme = "light" | "dark";

/** Of the original, and of the result if there is one. */
type OfSides<T> = { original: T; result?: T };

/** What a page shows. */
export interface Content {
  meshes: OfSides<PageMesh>;
  frame: Frame;
  modes: NamedMode[];
  /** Of the result. */
  worst: WorstFace[];
  /** Layers that can be switched: of a diagram. */
  layers: LayerSwitch[];
}

export interface LayerSwitch { layer: Layer; title: string; key: string; isShown: boolean }

export class App {
  readonly stage: Stage;
  mode: ColorMode = "plain";
  isWire = true;
  hasLines = true;
  theme: Theme = "light";
  scale: Scale | null = null;
  picked: Picked | null = null;
  worstIndex = -1;
  /** Called when something has changed. */
  onChange: () => void = () => {};
  readonly modes: NamedMode[];
  private readonly material = surfaceMaterial();
  private readonly views: OfSides<SurfaceView>;
  private readonly markers: Record<Side, Marker> = { original: new Marker(), result: new Marker() };

  constructor(readonly content: Content, canvas: HTMLCanvasElement) {
    const { original, result } = content.meshes;
    this.modes = content.modes.filter(({ mode }) => hasMode(mode, Object.values(content.meshes)));
    this.views = { original: new SurfaceView(original, this.material) };
    if (result) this.views.result = new SurfaceView(result, this.material);
    this.stage = new Stage(canvas, this.makePanes(), sphereOf(Object.values(this.views)));
    this.stage.onPick = (ray) => this.pickAlong(ray);
    this.setMode(this.modes[0].mode);
    this.setLines(true);
    for (const { layer, isShown } of content.layers) this.views.original.showLayer(layer, isShown);
  }

  private get frame(): Frame { return this.content.frame; }

  get panes(): Pane[] { return this.stage.panes; }

  setMode(mode: ColorMode): void {
    this.mode = mode;
    const meshes = Object.values(this.content.meshes);
    this.scale = scaleOf(mode, meshes, this.frame.diagonal);
    for (const view of Object.values(this.views)) {
      view.setColors(cornerColors(mode, view.mesh, () => view.edges, this.scale, this.frame.diagonal));
    }
    this.material.uniforms.lit.value = mode === "plain" ? 1 : 0.7;
    this.changed();
  }

  setWire(isWire: boolean): void {
    this.isWire = isWire;
    this.material.uniforms.wire.value = isWire ? 0.75 : 0;
    this.changed();
  }

  setLines(hasLines: boolean): void {
    this.hasLines = hasLines;
    for (const view of Object.values(this.views)) view.showLines(hasLines);
    this.setTheme(this.theme);
  }

  setLayer(layer: Layer, isShown: boolean): void {
    this.content.layers.find((one) => one.layer === layer)!.isShown = isShown;
    this.views.original.showLayer(layer, isShown);
    this.changed();
  }

  /** One pane at least stays. */
  setPane(id: string, isShown: boolean): void {
    const others = this.panes.filter((pane) => pane.id !== id && pane.isShown);
    for (const pane of this.panes) {
      if (pane.id === id) pane.isShown = isShown || others.length === 0;
    }
    this.stage.resize();
    this.changed();
  }

  setTheme(theme: Theme): void {
    this.theme = theme;
    document.documentElement.dataset.theme = theme;
    const style = getComputedStyle(document.documentElement);
    const color = (name: string) => style.getPropertyValue(`--${name}`).trim();
    this.stage.setBackground(color("stage"));
    for (const view of Object.values(this.views)) {
      view.setLineColors({ crease: color("crease"), boundary: color("boundary"), cell: color("cell"),
                           isoline: color("isoline"), site: color("site"), siteLine: color("site") });
    }
    for (const marker of Object.values(this.markers)) marker.setColor(color("mark"));
    this.changed();
  }

  /** Does before the view moves for the first time what would hold it up then. */
  prepareMotion(): void {
    for (const view of Object.values(this.views)) view.prepareMotion();
  }

  reset(): void {
    this.clearPick();
    this.stage.reset();
  }

  pickAlong({ pane, origin, direction }: Ray): void {
    const side: Side = pane.id === "result" ? "result" : "original";
    const face = faceAlong(this.content.meshes[side]!, origin, direction);
    if (face < 0) return this.clearPick();
    this.pick(side, face);
  }

  clearPick(): void {
    this.picked = null;
    this.worstIndex = -1;
    for (const marker of Object.values(this.markers)) marker.clear();
    this.stage.request();
    this.changed();
  }

  /** Goes to one of the worst triangles; numbers beyond the ends count from the other end. */
  flyToWorst(index: number): void {
    const { worst, meshes: { result } } = this.content;
    if (worst.length === 0 || !result) return;
    const at = (index + worst.length) % worst.length;
    const corners = worst[at].corners.map((corner) => toDrawn(corner, this.frame));
    const face = faceAt(result, corners);
    this.showPane("result");
    this.pick("result", face);
    this.worstIndex = at;
    const points = corners.map((corner) => new Vector3(...corner));
    const middle = points[0].clone().add(points[1]).add(points[2]).divideScalar(3);
    const { direction, distance } = outlookOn(result, face, points, this.stage.camera.up);
    this.stage.fly(middle, direction, distance);
    this.changed();
  }

  /** Goes to the place of a largest distance. */
  flyToPoint(point: Point, side: Side): void {
    this.clearPick();
    this.showPane(side);
    const drawn = new Vector3(...toDrawn(point, this.frame));
    for (const marker of Object.values(this.markers)) marker.markPoint(drawn, 0.02);
    this.stage.fly(drawn, this.stage.camera.position.clone().sub(this.stage.controls.target), 0.5);
  }

  private pick(side: Side, face: number): void {
    this.clearPick();
    const mesh = this.content.meshes[side]!;
    this.markers[side].markTriangle(cornersOf(mesh, face));
    const worst = side === "result" ? this.content.worst : [];
    this.picked = {
      side, title: this.panes.find((pane) => pane.id === side)!.title,
      figures: figuresOf(mesh, face, this.frame, worst),
    };
    this.stage.request();
    this.changed();
  }

  private showPane(id: Side): void {
    if (!this.panes.find((pane) => pane.id === id)?.isShown) this.setPane(id, true);
  }

  private makePanes(): Pane[] {
    const { original, result } = this.views;
    const ofOriginal = sceneOf(original.group, this.markers.original.group);
    if (!result) {
      return [{ id: "original", title: "Diagram", scene: ofOriginal, isShown: true,
                prepare: (isInMotion) => original.setInMotion(isInMotion) }];
    }
    const ofResult = sceneOf(result.group, this.markers.result.group);
    const panes: Pane[] = [
      { id: "original", title: "Original", scene: ofOriginal, isShown: true,
        prepare: (isInMotion) => {
          original.showLayer("cell", false);
          original.setInMotion(isInMotion);
        } },
      { id: "result", title: "Result", scene: ofResult, isShown: true,
        prepare: (isInMotion) => result.setInMotion(isInMotion) },
    ];
    if (original.mesh.cellLines.length > 0) {
      panes.push({ id: "cells", title: "Cells", scene: ofOriginal, isShown: window.innerWidth > 1300,
                   prepare: (isInMotion) => {
                     original.showLayer("cell", true);
                     original.setInMotion(isInMotion);
                   } });
    }
    return panes;
  }

  private changed(): void {
    this.stage.request();
    this.onChange();
  }

  /** What tests and scripts can read. */
  state(): Record<string, unknown> {
    const { camera, controls, frames, isFlying } = this.stage;
    return {
      mode: this.mode, scale: this.scale, wire: this.isWire, lines: this.hasLines, theme: this.theme,
      layers: this.content.layers.filter((one) => one.isShown).map((one) => one.layer),
      panes: this.panes.filter((pane) => pane.isShown).map((pane) => pane.id),
      camera: fromDrawn(camera.position.toArray(), this.frame),
      target: fromDrawn(controls.target.toArray(), this.frame),
      places: this.stage.places().map(({ pane, place }) => ({ id: pane.id, ...place })),
      picked: this.picked, worst: this.worstIndex, frames, isFlying,
    };
  }
}
