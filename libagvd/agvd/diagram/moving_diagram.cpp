#include "agvd/diagram/moving_diagram.h"

#include "agvd/diagram/diagram_builder.h"

namespace agvd {

class MovingDiagram::State {
public:
    State(const Surface& surface, MovingSites sites, const DiagramOptions& options)
        : sites_(std::move(sites)), builder_(surface, options) {
        build();
    }

    void update(const SiteChanges& changes) {
        const auto num_sites = static_cast<Index>(sites_.sites().size());
        sites_.update(changes);
        if (!changes.removed.empty()) builder_.renumber({num_sites, changes.removed});
        build();
    }

    [[nodiscard]] const MovingSites& sites() const { return sites_; }
    [[nodiscard]] const Diagram& diagram() const { return diagram_; }

private:
    void build() {
        builder_.build(sites_.sites(), sites_.propagation(), sites_.changed_faces(), diagram_);
    }

    MovingSites sites_;
    DiagramBuilder builder_;
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
