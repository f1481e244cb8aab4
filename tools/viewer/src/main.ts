// Reads the data of the page, draws the first picture, then fills in the figures.
import { App } from "./app";
import { bindControls, show } from "./controls";
import { byId } from "./dom";
import { fillFigures } from "./figures";
import { readMesh, readPageData } from "./page_data";

declare global {
  interface Window {
    /** For tests and scripts: the state of the page, and a picture drawn at once. */
    remeshPage?: { state(): Record<string, unknown>; render(): void; firstPicture: number };
  }
}

async function start(): Promise<void> {
  const data = readPageData();
  byId("original-name").textContent = data.original.name;
  byId("result-name").textContent = data.result.name;
  document.title = `${data.original.name} → ${data.result.name}`;
  const [original, result] = await Promise.all([readMesh("original", data), readMesh("result", data)]);
  const app = new App(data, { original, result }, byId<HTMLCanvasElement>("canvas"));
  bindControls(app);
  const isDark = window.matchMedia("(prefers-color-scheme: dark)");
  app.setTheme(isDark.matches ? "dark" : "light");
  isDark.addEventListener("change", () => app.setTheme(isDark.matches ? "dark" : "light"));
  app.setWire(true);
  app.stage.render();
  byId("message").hidden = true;
  window.remeshPage = {
    state: () => app.state(), render: () => app.stage.render(), firstPicture: performance.now(),
  };
  // On narrow screens the list stands below the meshes.
  const showStage = () => byId("stage").scrollIntoView({ block: "nearest" });
  fillFigures(data, {
    flyToWorst: (index) => { showStage(); app.flyToWorst(index); },
    flyToPoint: (point, side) => { showStage(); app.flyToPoint(point, side); },
  });
  show(app);
}

start().catch((error: unknown) => {
  const text = error instanceof Error ? error.message : String(error);
  byId("message").textContent = `The page cannot be shown: ${text}`;
  throw error;
});
