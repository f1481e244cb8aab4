// Reads the data of the page, draws the first picture, then fills in the figures.
import { App, Content } from "./app";
import { diagramModes, reportModes } from "./colors";
import { bindControls, show } from "./controls";
import { fillDiagramFigures } from "./diagram_figures";
import { byId } from "./dom";
import { fillFigures } from "./figures";
import { DiagramData, frameOf, readMesh, readPageData, ReportData } from "./page_data";

declare global {
  interface Window {
    /** For tests and scripts: the state of the page, and a picture drawn at once. */
    remeshPage?: { state(): Record<string, unknown>; render(): void; firstPicture: number };
  }
}

/** @param isWire  whether the wireframe is shown at first */
function open(content: Content, isWire: boolean): App {
  const app = new App(content, byId<HTMLCanvasElement>("canvas"));
  bindControls(app);
  const isDark = window.matchMedia("(prefers-color-scheme: dark)");
  app.setTheme(isDark.matches ? "dark" : "light");
  isDark.addEventListener("change", () => app.setTheme(isDark.matches ? "dark" : "light"));
  app.setWire(isWire);
  app.stage.render();
  byId("message").hidden = true;
  window.remeshPage = {
    state: () => app.state(), render: () => app.stage.render(), firstPicture: performance.now(),
  };
  window.setTimeout(() => app.prepareMotion());
  return app;
}

async function showReport(data: ReportData): Promise<void> {
  byId("original-name").textContent = data.original.name;
  byId("result-name").textContent = data.result.name;
  document.title = `${data.original.name} → ${data.result.name}`;
  const frame = frameOf(data.original);
  const [original, result] = await Promise.all([
    readMesh("original", data.original, frame), readMesh("result", data.result, frame)]);
  const app = open({ meshes: { original, result }, frame, modes: reportModes, worst: data.worst, layers: [] }, true);
  // On narrow screens the list stands below the meshes.
  const showStage = () => byId("stage").scrollIntoView({ block: "nearest" });
  fillFigures(data, {
    flyToWorst: (index) => { showStage(); app.flyToWorst(index); },
    flyToPoint: (point, side) => { showStage(); app.flyToPoint(point, side); },
  });
  show(app);
}

async function showDiagram(data: DiagramData): Promise<void> {
  byId("title").textContent = "Geodesic Voronoi diagram";
  byId("original-name").textContent = data.original.name;
  document.querySelector<HTMLElement>(".arrow")!.hidden = true;
  document.title = `${data.original.name}: diagram`;
  byId("lines").nextElementSibling!.textContent = "Boundary";
  byId("canvas").setAttribute("aria-label", "The diagram on its mesh. Drag to turn, wheel to zoom.");
  const frame = frameOf(data.original);
  const original = await readMesh("original", data.original, frame);
  const app = open({
    meshes: { original }, frame, modes: diagramModes, worst: [],
    layers: [
      { layer: "cell", title: "Bisectors", key: "b", isShown: true },
      { layer: "site", title: "Sites", key: "s", isShown: true },
      { layer: "isoline", title: "Isolines", key: "i", isShown: false },
    ],
  }, false);
  fillDiagramFigures(data);
  show(app);
}

async function start(): Promise<void> {
  const data = readPageData();
  await ("diagram" in data ? showDiagram(data) : showReport(data));
}

start().catch((error: unknown) => {
  const text = error instanceof Error ? error.message : String(error);
  byId("message").textContent = `The page cannot be shown: ${text}`;
  throw error;
});
