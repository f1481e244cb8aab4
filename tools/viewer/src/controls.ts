// Binds the controls and keys of the page to its state, and shows the state in them.
import type { App, Theme } from "./app";
import { ColorMode, mapGradient } from "./colors";
import { byId, element, inDigits, table } from "./dom";
import { figureTable } from "./pick";

const keys: [string, string][] = [
  ["C", "next colours"], ["W", "wireframe"], ["L", "curves"], ["1 2 3", "show a mesh"],
  ["N P", "next and previous of the worst triangles"], ["R", "reset the view"], ["T", "light or dark"],
  ["← → ↑ ↓", "turn"], ["+ −", "zoom"], ["Esc", "no triangle"], ["?", "these keys"],
];

export function bindControls(app: App): void {
  const color = byId<HTMLSelectElement>("color");
  for (const { mode, name } of app.modes) color.append(element("option", { value: mode }, name));
  color.addEventListener("change", () => app.setMode(color.value as ColorMode));
  const wire = byId<HTMLInputElement>("wire"), lines = byId<HTMLInputElement>("lines");
  wire.addEventListener("change", () => app.setWire(wire.checked));
  lines.addEventListener("change", () => app.setLines(lines.checked));
  byId("reset").addEventListener("click", () => app.reset());
  byId("theme").addEventListener("click", () => app.setTheme(otherTheme(app)));
  byId("help").addEventListener("click", toggleKeys);
  const { layers } = app.content;
  const allKeys = [...keys, ...layers.map(({ key, title }): [string, string] => [key.toUpperCase(), title.toLowerCase()])];
  byId("keys").append(table([], allKeys.map(([key, text]) => [element("kbd", {}, key), text])));
  byId("legend-bar").style.background = mapGradient();
  if (app.panes.length > 1) addPaneSwitches(app);
  else byId("panes").hidden = true;
  for (const { layer, title } of layers) {
    const box = element("input", { type: "checkbox", id: `layer-${layer}` });
    box.addEventListener("change", () => app.setLayer(layer, box.checked));
    byId("layers").append(element("label", { class: "switch" }, box, element("span", {}, title)));
  }
  document.addEventListener("keydown", (event) => pressKey(app, event));
  app.stage.onLayout = () => showTitles(app);
  app.onChange = () => show(app);
}

function otherTheme(app: App): Theme { return app.theme === "dark" ? "light" : "dark"; }

function toggleKeys(): void {
  const list = byId("keys");
  list.hidden = !list.hidden;
  byId("help").setAttribute("aria-expanded", String(!list.hidden));
}

function addPaneSwitches(app: App): void {
  for (const pane of app.panes) {
    const box = element("input", { type: "checkbox", id: `pane-${pane.id}` });
    box.addEventListener("change", () => app.setPane(pane.id, box.checked));
    byId("panes").append(element("label", { class: "switch" }, box, element("span", {}, pane.title)));
  }
}

/** Makes controls, titles and legend tell the state. */
export function show(app: App): void {
  byId<HTMLSelectElement>("color").value = app.mode;
  byId<HTMLInputElement>("wire").checked = app.isWire;
  byId<HTMLInputElement>("lines").checked = app.hasLines;
  byId("theme").textContent = otherTheme(app) === "dark" ? "Dark" : "Light";
  if (app.panes.length > 1) {
    for (const pane of app.panes) byId<HTMLInputElement>(`pane-${pane.id}`).checked = pane.isShown;
  }
  for (const { layer, isShown } of app.content.layers) byId<HTMLInputElement>(`layer-${layer}`).checked = isShown;
  for (const button of document.querySelectorAll<HTMLElement>("[data-worst]")) {
    button.setAttribute("aria-pressed", String(Number(button.dataset.worst) === app.worstIndex));
  }
  showTitles(app);
  showLegend(app);
  showPicked(app);
}

function showTitles(app: App): void {
  byId("titles").replaceChildren(...app.stage.places().map(({ pane, place }) => {
    const { original, result } = app.content.meshes;
    const mesh = pane.id === "result" ? result! : original;
    const faces = inDigits(mesh.corners.length / 3);
    const count = mesh.thinnedFrom > 0
      ? `${faces} faces drawn in place of ${inDigits(mesh.thinnedFrom)}: a remesh of this one`
      : `${faces} faces`;
    const title = element("p", {}, element("span", {}, element("strong", {}, pane.title), count));
    title.style.left = `${place.x}px`;
    title.style.top = `${place.y}px`;
    title.style.maxWidth = `${place.width}px`;
    title.classList.toggle("beside", place.x > 0);
    title.classList.toggle("below", place.y > 0);
    title.style.setProperty("--pane-width", `${place.width}px`);
    title.style.setProperty("--pane-height", `${place.height}px`);
    return title;
  }));
}

function showLegend(app: App): void {
  const { scale } = app;
  byId("legend").hidden = scale === null;
  if (!scale) return;
  byId("legend-title").textContent = scale.title;
  byId("legend-low").textContent = inDigits(scale.low, 3) + scale.unit;
  const middle = scale.low + (scale.high - scale.low) * (scale.isRoot ? 0.25 : 0.5);
  byId("legend-middle").textContent = inDigits(middle, 3) + scale.unit;
  byId("legend-high").textContent = inDigits(scale.high, 3) + scale.unit;
}

function showPicked(app: App): void {
  const box = byId("picked");
  box.hidden = app.picked === null;
  if (!app.picked) return;
  const close = element("button", { type: "button", "aria-label": "Close" }, "×");
  close.addEventListener("click", () => app.clearPick());
  box.replaceChildren(close, figureTable(app.picked.title, app.picked.figures));
}

function nextMode(app: App): void {
  const modes = app.modes.map(({ mode }) => mode);
  app.setMode(modes[(modes.indexOf(app.mode) + 1) % modes.length]);
}

function togglePane(app: App, index: number): void {
  const pane = app.panes[index];
  if (pane) app.setPane(pane.id, !pane.isShown);
}

function pressKey(app: App, event: KeyboardEvent): void {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const isInControl = event.target instanceof HTMLSelectElement;
  // Arrows scroll the column of figures.
  const isOnStage = !isInControl && !byId("figures").contains(document.activeElement);
  const turns: Record<string, () => void> = {
    ArrowLeft: () => app.stage.turn(-0.15, 0), ArrowRight: () => app.stage.turn(0.15, 0),
    ArrowUp: () => app.stage.turn(0, 0.15), ArrowDown: () => app.stage.turn(0, -0.15),
    "+": () => app.stage.zoom(0.85), "=": () => app.stage.zoom(0.85), "-": () => app.stage.zoom(1 / 0.85),
  };
  const others: Record<string, () => void> = {
    c: () => nextMode(app), w: () => app.setWire(!app.isWire), l: () => app.setLines(!app.hasLines),
    1: () => togglePane(app, 0), 2: () => togglePane(app, 1), 3: () => togglePane(app, 2),
    n: () => app.flyToWorst(app.worstIndex + 1),
    p: () => app.flyToWorst(app.worstIndex < 0 ? -1 : app.worstIndex - 1),
    r: () => app.reset(), t: () => app.setTheme(otherTheme(app)), Escape: () => app.clearPick(), "?": toggleKeys,
  };
  for (const { key, layer, isShown } of app.content.layers) others[key] = () => app.setLayer(layer, !isShown);
  const action = (isOnStage ? turns[event.key] : undefined) ??
    (isInControl ? undefined : others[event.key.length === 1 ? event.key.toLowerCase() : event.key]);
  if (!action) return;
  event.preventDefault();
  action();
}
