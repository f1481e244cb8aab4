//! \file
//! Tracing faces while a propagation still runs.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "agvd/diagram/mainland.h"
#include "agvd/diagram/own_places.h"
#include "agvd/diagram/stages.h"
#include "agvd/propagation/retirement.h"

namespace agvd {

//! Builds a diagram of faces that come as they retire ([meng2023] Algorithm 1). A vertex gets its
//! last label when all faces around it have come, and a face is traced when its corners have
//! theirs. Its relays are dropped when it and its neighbours are traced and lie on the mainland, as
//! only islands are traced again. With a chord all relays stay.
//!
//! Positions of mixed faces are in the order in which they come, until finish() sorts them.
class DiagramTracer {
public:
    //! Keeps references to the surface and the options.
    DiagramTracer(const Surface& surface, std::span<const SurfacePoint> sites,
                  const PropagationOptions& propagating, const DiagramOptions& options);
    DiagramTracer(const DiagramTracer&) = delete;
    DiagramTracer& operator=(const DiagramTracer&) = delete;

    void add(RetiredFaces&& retired, Poller& poller);
    //! When all faces have come.
    //! \return nothing if relays are needed that were dropped.
    [[nodiscard]] std::optional<Diagram> finish() &&;

    //! Held at once.
    [[nodiscard]] std::size_t most_relays() const { return most_relays_; }

private:
    enum class FaceState : std::uint8_t { Coming, Waiting, Ready, Traced, Done };

    // Element and place, ascending.
    using PlacesAt = std::vector<std::pair<Index, Index>>;

    void store(const RetiredFaces& retired);
    [[nodiscard]] std::vector<Index> finished_vertices(std::span<const Index> faces);
    void add_own_places(const PlacesAt& places_at, Index element);
    void label(const StageInput& input, std::span<const Index> vertices);
    [[nodiscard]] std::vector<Index> ready_faces(std::span<const Index> vertices);
    [[nodiscard]] std::vector<Index> edges_of_ready_faces(std::span<const Index> positions) const;
    void drop_relays();
    [[nodiscard]] bool is_done(Index face) const;
    void sort_by_face();

    [[nodiscard]] StageInput input(const SitePlacement& placement, Poller& poller) const {
        return {surface_,       own_.points,          own_.sites,
                placement,      propagation_,         options_.chord_tolerance,
                options_.chord, options_.num_threads, poller};
    }
    [[nodiscard]] bool is_mixed(Index face) const {
        return parts_.labels.mixed_index[face] != no_index;
    }
    // Of the face at a position.
    [[nodiscard]] FaceState& state(Index position) {
        return state_[propagation_.mixed_faces[position]];
    }
    void order_by_face(std::vector<Index>& positions) const;

    const Surface& surface_;
    const DiagramOptions& options_;
    SitePlaces places_;
    PlacesAt at_vertices_, in_faces_;
    SitePlaces own_;           // What is known to own its place.
    Propagation propagation_;  // Mixed faces and relays.
    DiagramParts parts_;
    Mainland mainland_;
    std::vector<FaceState> state_;         // #F
    std::vector<Index> faces_left_;        // #V: around, that have not come.
    std::vector<std::uint8_t> is_wanted_;  // #V: 0 between calls.
    std::vector<Index> held_;              // Positions that have relays, in their order.
    std::size_t most_relays_ = 0;
};

//! Runs the Steiner engine and traces what it leaves behind.
//! \return nothing if relays that were dropped would be needed; in a build without that engine
//!         always.
[[nodiscard]] std::optional<TracedDiagram> trace_behind_front(const Surface& surface,
                                                              std::span<const SurfacePoint> sites,
                                                              const PropagationOptions& propagating,
                                                              const DiagramOptions& options);

}  // namespace agvd
