#include "agvd/diagram/label_line.h"

#include <algorithm>

#include "agvd/diagram/single_crossing.h"

namespace agvd {

void label_line(std::span<const LineRelay> relays, LineId line, const LabelledSegment& segment,
                LineScratch& scratch, std::vector<Crossing>& out) {
    const auto& [length, site_at_start, site_at_end] = segment;
    if (site_at_start != site_at_end) {
        const auto single = find_single_crossing(relays, length, site_at_start, site_at_end);
        if (single) {
            out.push_back(
                {single->at / length, single->distance, site_at_start, site_at_end, line});
            return;
        }
    }
    std::vector<LabelInterval>& intervals = scratch.intervals;
    label_envelope(relays, segment, scratch.envelope, intervals);
    for (std::size_t i = 0; i + 1 < intervals.size(); ++i) {
        const Index before = intervals[i].site;
        const Index after = intervals[i + 1].site;
        const double x = intervals[i].end * length;
        const double distance =
            std::max(distance_on_line(relays, before, x), distance_on_line(relays, after, x));
        out.push_back({intervals[i].end, distance, before, after, line});
    }
}

}  // namespace agvd
