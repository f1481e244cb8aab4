#include "agvd/update/moving_diagram.h"

#include <optional>
#include <utility>

#include "agvd/update/update_diagram.h"

namespace agvd {

class MovingDiagram::State {
public:
    State(const Surface& surface, MovingSites sites, DiagramOptions options)
        : surface_(surface), options_(std::move(options)), sites_(std::move(sites)) {
        build();
    }

    void update(const SiteChanges& changes) {
        const auto num_sites = static_cast<Index>(sites_.sites().size());
        sites_.update(changes);
        if (kept_ && !changes.removed.empty()) {
            renumber(Renumbering(num_sites, changes.removed), *kept_);
        }
        build();
    }

    [[nodiscard]] const MovingSites& sites() const { return sites_; }
    [[nodiscard]] const Diagram& diagram() const { return diagram_; }

private:
    void build() {
        std::optional<KeptDiagram> kept = std::exchange(kept_, {});  // None if anything throws.
        Poller poller(options_.progress);
        poller.poll();
        const SitePlacement placement(surface_, sites_.sites());
        const StageInput input{surface_,
                               sites_.sites(),
                               placement,
                               sites_.propagation(),
                               options_.chord_tolerance,
                               options_.num_threads,
                               poller};
        if (!kept || is_wasteful(kept->parts)) {
            kept.reset();
            kept.emplace(build_kept_diagram(input, diagram_));
        } else {
            update_diagram(input, sites_.changed_faces(), *kept, diagram_);
        }
        kept_ = std::move(kept);
    }

    const Surface& surface_;
    DiagramOptions options_;
    MovingSites sites_;
    std::optional<KeptDiagram> kept_;  // None: the next diagram is built from the start.
    Diagram diagram_;
};

MovingDiagram::MovingDiagram(const Surface& surface, const SurfaceLayout& layout,
                             std::vector<SurfacePoint> sites, const PropagationOptions& propagation,
                             const DiagramOptions& options)
    : state_(std::make_unique<State>(
          surface, MovingSites(surface, layout, std::move(sites), propagation), options)) {}
MovingDiagram::MovingDiagram(MovingDiagram&&) noexcept = default;
MovingDiagram& MovingDiagram::operator=(MovingDiagram&&) noexcept = default;
MovingDiagram::~MovingDiagram() = default;

void MovingDiagram::update(const SiteChanges& changes) { state_->update(changes); }
const MovingSites& MovingDiagram::sites() const { return state_->sites(); }
const Diagram& MovingDiagram::diagram() const { return state_->diagram(); }

}  // namespace agvd
