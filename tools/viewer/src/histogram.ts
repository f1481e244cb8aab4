// Histograms: bars, and those of the original as a line.
import { element, inDigits, svg } from "./dom";
import type { Histogram } from "./page_data";

const width = 340, height = 108, floor = 88;

export interface HistogramText { title: string; unit: string; ticks: number[]; isOpenEnded?: boolean }

export function histogramChart(text: HistogramText, result: Histogram, original: Histogram | null = null): HTMLElement {
  const shares = (histogram: Histogram) => {
    const sum = histogram.counts.reduce((a, b) => a + b, 0) || 1;
    return histogram.counts.map((count) => count / sum);
  };
  const before = original ? shares(original) : [], after = shares(result);
  const most = Math.max(...before, ...after, 1e-9);
  const bin = width / after.length;
  const y = (share: number) => floor - share / most * (floor - 8);
  const bars = after.map((share, i) => svg("rect", {
    class: "bar", x: i * bin + 0.5, width: Math.max(bin - 1, 0.5), y: y(share), height: floor - y(share),
  }, svg("title", {}, barText(text, result, i, share))));
  const path = before.map((share, i) => `${i === 0 ? "M" : "L"}${i * bin} ${y(share)}h${bin}`).join("");
  const chart = svg("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", class: "histogram" },
    svg("title", {}, original ? `${text.title}: bars of the result, line of the original` : text.title), ...bars,
    ...(original ? [svg("path", { class: "before", d: path })] : []),
    svg("line", { class: "axis", x1: 0, x2: width, y1: floor, y2: floor }),
    ...text.ticks.map((tick) => tickAt(tick, (tick - result.low) / result.width * bin, text.unit)));
  return element("figure", {}, element("figcaption", {}, text.title), chart);
}

function tickAt(tick: number, x: number, unit: string): SVGElement {
  const anchor = x < 8 ? "start" : x > width - 8 ? "end" : "middle";
  return svg("text", { class: "tick", x, y: floor + 15, "text-anchor": anchor }, `${tick}${unit}`);
}

function barText(text: HistogramText, histogram: Histogram, bin: number, share: number): string {
  const low = histogram.low + bin * histogram.width;
  const isLast = bin === histogram.counts.length - 1 && text.isOpenEnded;
  const range = isLast ? `${inDigits(low)}${text.unit} and more`
                       : `${inDigits(low)} to ${inDigits(low + histogram.width)}${text.unit}`;
  return `${range}: ${inDigits(100 * share, 3)} %, ${histogram.counts[bin].toLocaleString("en")}`;
}
