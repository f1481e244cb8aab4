#include "agvd/diagram/moving_diagram.h"

#include <optional>

#include "agvd/diagram/earlier_parts.h"

namespace agvd {

class MovingDiagram::State {
public:
    State(const Surface& surface, MovingSites sites, DiagramOptions options)
        : surface_(surface), sites_(std::move(sites)), options_(std::move(options)) {
        build();
    }

    void update(const SiteChanges& changes) {
        sites_.update(changes);
        if (!changes.removed.empty()) can_take_over_ = false;
        build();
    }

    [[nodiscard]] const MovingSites& sites() const { return sites_; }
    [[nodiscard]] const Diagram& diagram() const { return diagram_; }

private:
    void build() {
        std::optional<EarlierParts> earlier;
        if (can_take_over_) earlier.emplace(surface_, parts_, sites_.changed_faces());
        can_take_over_ = false;  // Not after a call that throws.
        DiagramParts parts;
        diagram_ = build_diagram(surface_, sites_.sites(), sites_.propagation(), options_,
                                 earlier ? &*earlier : nullptr, parts);
        parts_ = std::move(parts);
        can_take_over_ = true;
    }

    const Surface& surface_;
    MovingSites sites_;
    DiagramOptions options_;
    DiagramParts parts_;
    bool can_take_over_ = false;
    Diagram diagram_;
};

MovingDiagram::MovingDiagram(const Surface& surface, const SurfaceLayout& layout,
                             std::vector<SurfacePoint> sites, const PropagationOptions& propagation,
                             DiagramOptions options)
    : state_(std::make_unique<State>(surface,
                                     MovingSites(surface, layout, std::move(sites), propagation),
                                     std::move(options))) {}
MovingDiagram::MovingDiagram(MovingDiagram&&) noexcept = default;
MovingDiagram& MovingDiagram::operator=(MovingDiagram&&) noexcept = default;
MovingDiagram::~MovingDiagram() = default;

void MovingDiagram::update(const SiteChanges& changes) { state_->update(changes); }
const MovingSites& MovingDiagram::sites() const { return state_->sites(); }
const Diagram& MovingDiagram::diagram() const { return state_->diagram(); }

}  // namespace agvd
