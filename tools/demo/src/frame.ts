// The frame that shows meshes: the viewer of report pages, with what can be told without the program.
import { App } from "../../viewer/src/app";
import { bindControls, show } from "../../viewer/src/controls";
import { byId, card, inDigits, table } from "../../viewer/src/dom";
import type { PageMesh } from "../../viewer/src/page_data";
import { faceShapes } from "../../viewer/src/shapes";
import { contentOf, Shown } from "./shown";

declare global {
  interface Window {
    /** Called once by the page around. @param result  null: there is none yet */
    showMeshes(original: Shown, result: Shown | null, theme: string): void;
    /** For tests, as in the viewer. */
    remeshPage?: { state(): Record<string, unknown>; render(): void; firstPicture: number };
  }
}

function figuresOf(mesh: PageMesh): string[] {
  const { quality, angle } = faceShapes(mesh);
  const mean = (values: Float32Array) => values.reduce((sum, x) => sum + x, 0) / values.length;
  const least = (values: Float32Array) => values.reduce((low, x) => Math.min(low, x), Infinity);
  return [
    inDigits(mesh.positions.length / 3), inDigits(mesh.corners.length / 3), inDigits(mean(quality), 3), inDigits(least(quality), 3),
    inDigits(mean(angle), 3), inDigits(least(angle), 3),
  ];
}

window.showMeshes = (original, result, theme) => {
  const content = contentOf(original, result ?? original);
  byId("original-name").textContent = original.name;
  byId("result-name").textContent = result?.name ?? "";
  document.querySelector<HTMLElement>(".arrow")!.hidden = result === null;
  const app = new App(content, byId<HTMLCanvasElement>("canvas"));
  bindControls(app);
  if (result === null) {
    app.setPane("result", false);
    byId("panes").hidden = true;
  }
  app.setTheme(theme === "dark" ? "dark" : "light");
  app.setWire(true);
  app.stage.render();
  byId("message").hidden = true;
  const rows = ["Vertices", "Faces", "Q, mean", "Q, least", "Smallest angle, mean (°)", "Smallest angle (°)"];
  const { original: before, result: after } = content.meshes;
  const columns = result ? [before, after!] : [before];
  const figures = columns.map(figuresOf);
  byId("figures").append(card("Mesh", table(["", "Original", "Result"].slice(0, 1 + columns.length),
    rows.map((name, i) => [name, ...figures.map((column) => column[i])]))));
  show(app);
  window.remeshPage = { state: () => app.state(), render: () => app.stage.render(), firstPicture: performance.now() };
};
