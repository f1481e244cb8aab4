// The side column of a diagram.
import { byId, card, element, inDigits, table } from "./dom";
import { commandCard, warningCards } from "./figures";
import { histogramChart } from "./histogram";
import type { DiagramData } from "./page_data";

export function fillDiagramFigures(data: DiagramData): void {
  byId("figures").append(...warningCards(data.diagram.warnings), diagramCard(data), histogramCard(data),
                         commandCard(data, [`engine ${data.diagram.engine}`]));
  const { sites, voronoi_edges: edges } = data.diagram.figures;
  byId("badges").append(element("li", {}, `${inDigits(sites)} sites`), element("li", {}, `${inDigits(edges)} Voronoi edges`));
}

function diagramCard({ diagram, original }: DiagramData): HTMLElement {
  const { figures, certified_error: error, isoline_step: step } = diagram;
  const row = (name: string, key: string, digits = 4) => [name, inDigits(figures[key], digits)];
  return card("Diagram", table([], [
    ["Faces of the mesh", inDigits(original.thinned_from ?? original.faces)],
    row("Sites", "sites"), row("Voronoi vertices", "voronoi_vertices"), row("Voronoi edges", "voronoi_edges"),
    row("Sites without a cell", "empty_cells"), row("Cells that are no discs", "cells_that_are_no_discs"),
    row("Vertices that no site reaches", "unreached_vertices"),
    row("Largest distance", "largest_distance_mesh_units"), row("Area", "area_square_mesh_units"),
    row("Area of a cell, mean", "mean_cell_area_square_mesh_units"),
    row("Area of a cell, least", "least_cell_area_square_mesh_units"),
    row("Area of a cell, largest", "largest_cell_area_square_mesh_units"),
    ["Certified error of distances (%)", inDigits(error === null ? null : 100 * error, 2)],
    ["Distance of the isolines", step > 0 ? inDigits(step) : "–"],
  ]), element("p", { class: "note" }, "Lengths are in units of the mesh."));
}

function histogramCard({ diagram }: DiagramData): HTMLElement {
  const { area, neighbours } = diagram.histograms;
  return card("Histograms",
    histogramChart({ title: "Area of a cell over the mean", unit: "", ticks: [0, 0.5, 1, 1.5, 2, 2.5], isOpenEnded: true }, area),
    histogramChart({ title: "Neighbours of a cell", unit: "", ticks: [0, 2, 4, 6, 8, 10, 12], isOpenEnded: true }, neighbours));
}
