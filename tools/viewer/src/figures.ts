// The side column: figures as the reports of remesh and remesh-eval have them.
import { byId, card, element, inDigits, table } from "./dom";
import { histogramChart } from "./histogram";
import type { PageData, Point, Report, ReportData } from "./page_data";

/** What clicks in the column do. */
export interface FigureActions {
  flyToWorst(index: number): void;
  flyToPoint(point: Point, side: "original" | "result"): void;
}

export function fillFigures(data: ReportData, actions: FigureActions): void {
  byId("figures").append(
    meshCard(data), distanceCard(data, actions), worstCard(data, actions), histogramCard(data),
    topologyCard(data), ...settingsCards(data));
  fillBadges(data);
}

function fillBadges(data: ReportData): void {
  const { result, topology_kept: isKept } = data.evaluation;
  const badge = (text: string, kind = "") => element("li", kind ? { class: kind } : {}, text);
  byId("badges").append(
    badge(`${inDigits(result.vertices)} vertices`), badge(`${inDigits(result.faces)} faces`),
    badge(isKept ? "topology kept" : "topology changed", isKept ? "good" : "bad"));
  const pairs = result.self_intersecting_pairs;
  if (pairs !== null && pairs > 0) {
    byId("badges").append(badge(`${inDigits(pairs)} pairs of faces intersect`, "bad"));
  }
}

type Row = [string, string, number];  // Name, key of the report, digits.

function rowsOf(data: ReportData, rows: Row[]): string[][] {
  const { original, result } = data.evaluation;
  return rows.map(([name, key, digits]) =>
    [name, inDigits(original[key], digits), inDigits(result[key], digits)]);
}

function meshCard(data: ReportData): HTMLElement {
  return card("Mesh", table(["", "Original", "Result"], rowsOf(data, [
    ["Vertices", "vertices", 4], ["Faces", "faces", 4], ["Q, mean", "mean_quality", 4],
    ["Q, least", "min_quality", 4], ["Smallest angle, mean (°)", "mean_min_angle_deg", 4],
    ["Smallest angle (°)", "min_angle_deg", 4], ["Largest angle (°)", "max_angle_deg", 4],
    ["Faces with an angle below 30° (%)", "faces_below_30_deg_percent", 3],
    ["Vertices of valence 6 (%)", "valence_6_percent", 3],
    ["Edge length, deviation / mean", "edge_length_variation", 3],
    ["Edges that are not Delaunay", "non_delaunay_edges", 4],
    ["Faces without area", "faces_without_area", 4],
    ["Intersecting pairs of faces", "self_intersecting_pairs", 4],
  ])));
}

function distanceCard(data: ReportData, actions: FigureActions): HTMLElement {
  const distance = data.evaluation.distance;
  if (!data.farthest) {
    return card("Distance", element("p", {}, "Not measured: the program was built without CGAL. " +
      "The colours show the distance of each vertex."));
  }
  const cells = (side: Report) => ["mean", "rms", "max"].map((kind) =>
    inDigits(side[`${kind}_percent_of_diagonal`], 3));
  const { from_original: ofOriginal, from_result: ofResult } = data.farthest;
  const place = (side: "original" | "result", point: Point) => {
    const button = element("button", { type: "button", class: "link", "data-farthest": side }, "show");
    button.addEventListener("click", () => actions.flyToPoint(point, side));
    return button;
  };
  return card("Distance, % of the diagonal",
    table(["", "Mean", "RMS", "Largest", ""], [
      ["Original to result", ...cells(distance.original_to_result), place("original", ofOriginal)],
      ["Result to original", ...cells(distance.result_to_original), place("result", ofResult)],
      ["Both", ...cells(distance.two_sided), ""],
    ]),
    element("p", { class: "note" }, `Diagonal ${inDigits(distance.original_diagonal_mesh_units, 6)}, ` +
      `${inDigits(distance.samples_per_surface)} points on each surface.`));
}

function worstCard(data: ReportData, actions: FigureActions): HTMLElement {
  const list = element("ol", { class: "worst", start: "1" });
  data.worst.forEach((worst, index) => {
    const button = element("button", { type: "button", "data-worst": String(index) },
      element("span", { class: "rank" }, String(index + 1)),
      element("span", {}, `Face ${inDigits(worst.face)}`),
      element("span", {}, `Q ${inDigits(worst.quality, 3)}`),
      element("span", {}, `${inDigits(worst.min_angle_deg, 3)}°`));
    button.addEventListener("click", () => actions.flyToWorst(index));
    list.append(element("li", {}, button));
  });
  return card("Worst triangles of the result", list,
    element("p", { class: "note" }, "Click one to see it. Faces are counted from 0."));
}

function histogramCard(data: ReportData): HTMLElement {
  const { original, result } = data.histograms;
  return card("Histograms",
    element("p", { class: "note keys-of-chart" }, element("span", { class: "key-bar" }), "Result ",
            element("span", { class: "key-line" }), "Original"),
    histogramChart({ title: "Angles", unit: "°", ticks: [0, 30, 60, 90, 120, 150, 180] },
                   result.angle, original.angle),
    histogramChart({ title: "Quality Q", unit: "", ticks: [0, 0.25, 0.5, 0.75, 1] },
                   result.quality, original.quality),
    histogramChart({ title: "Edge length over target", unit: "", ticks: [0, 0.5, 1, 1.5, 2, 2.5], isOpenEnded: true },
                   result.edge, original.edge),
    histogramChart({ title: "Valence", unit: "", ticks: [0, 2, 4, 6, 8, 10, 12], isOpenEnded: true },
                   result.valence, original.valence));
}

function topologyCard(data: ReportData): HTMLElement {
  const { original, result } = data.evaluation;
  const yes = (value: boolean) => value ? "yes" : "no";
  return card("Topology", table(["", "Original", "Result"], [
    ["Manifold", yes(original.manifold), yes(result.manifold)],
    ["Oriented", yes(original.oriented), yes(result.oriented)],
    ...rowsOf(data, [["Components", "component_count", 4], ["Genus", "genus", 4],
                     ["Boundary loops", "boundary_loops", 4],
                     ["Euler characteristic", "euler_characteristic", 4]]),
  ]), element("p", { class: "note" }, "The original after its repair."));
}

function settingsCards(data: ReportData): HTMLElement[] {
  const cards = [...warningCards(data.run?.warnings ?? []),
                 commandCard(data, data.run ? [`seed ${data.run.options.seed}`] : [])];
  if (data.run) {
    cards.push(detailsOf("Settings", data.run.options));
    cards.push(detailsOf("Repairs of the input", data.run.input_repair));
  } else {
    cards.push(detailsOf("Repairs of the original", data.evaluation.original_repair));
  }
  return cards;
}

export function warningCards(warnings: string[]): HTMLElement[] {
  if (warnings.length === 0) return [];
  return [card("Warnings", element("ul", {}, ...warnings.map((w) => element("li", {}, w))))];
}

/** @param more  texts behind the version */
export function commandCard({ command, version }: PageData, more: string[]): HTMLElement {
  const note = element("p", { class: "note" }, [`Version ${version}`, ...more].join(", "));
  return card("How it was made", ...(command ? [element("pre", { id: "command", tabindex: "0" }, command)] : []), note);
}

function detailsOf(title: string, values: Report): HTMLElement {
  const rows: [string, string][] = [];
  const add = (prefix: string, object: Report) => {
    for (const [key, value] of Object.entries(object)) {
      const name = prefix + key.replaceAll("_", " ");
      if (value !== null && typeof value === "object") add(`${name}: `, value);
      else rows.push([name, typeof value === "number" ? inDigits(value, 8) : String(value ?? "–")]);
    }
  };
  add("", values);
  return element("section", { class: "card" },
    element("details", {}, element("summary", {}, element("h2", {}, title)), table([], rows)));
}
