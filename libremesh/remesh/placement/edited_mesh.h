//! \file
//! A mesh on a surface whose edges are flipped, split and collapsed, and steps taken back.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "agvd/mesh/surface.h"
#include "remesh/features/close_rim.h"
#include "remesh/placement/placed_mesh.h"

namespace remesh::detail {

//! Where a vertex may go: along the surface, along its boundary, or nowhere.
enum class Mobility : std::uint8_t { Free, Boundary, Fixed };

//! Every step leaves a manifold of the same topology, hard edges stay chains of hard edges, and no
//! normal turns by more than 60 degrees, nor does an edge become sharper than that and than those
//! around were. Steps that would do otherwise change nothing.
class EditedMesh {
public:
    struct Face {
        agvd::Triangle corner;
        //! Bit k: the edge from corner k to the next one is hard.
        std::uint8_t hard = 0;
        bool is_there = false;
        double quality = 0;  //!< shape_quality(); less by 1 where it faces against the surface.
    };
    //! Where steps can be taken back to.
    struct Mark {
        std::size_t faces = 0, places = 0, fans = 0;  // Of the journals.
        agvd::Index num_faces = 0, num_vertices = 0;
    };

    //! \param surface   outlives this.
    //! \param mobility  #V. Vertices on hard edges are not Free.
    //! \param hard      edges that are no longer flipped, in one direction or both; those with one
    //!                  face alone must be among them.
    EditedMesh(const agvd::Surface& surface, const PlacedMesh& mesh,
               std::span<const Mobility> mobility, std::span<const DirectedEdge> hard);

    [[nodiscard]] agvd::Index num_faces() const { return static_cast<agvd::Index>(faces_.size()); }
    [[nodiscard]] agvd::Index num_vertices() const {
        return static_cast<agvd::Index>(places_.size());
    }
    [[nodiscard]] const Face& face(agvd::Index f) const { return faces_[f]; }
    //! In no order; none: the vertex is gone.
    [[nodiscard]] std::span<const agvd::Index> faces_at(agvd::Index v) const { return fans_[v]; }
    [[nodiscard]] const agvd::Vec3& at(agvd::Index v) const { return places_[v].at; }
    [[nodiscard]] Mobility mobility(agvd::Index v) const { return places_[v].mobility; }
    [[nodiscard]] double worst_at(agvd::Index v) const;
    //! Before and after a vertex along its hard edges; no_index where there is none.
    [[nodiscard]] std::array<agvd::Index, 2> hard_neighbours(agvd::Index v) const;

    //! The edge from corner k of the face to the next.
    bool flip(agvd::Index face, agvd::Index k);
    //! \return the new vertex, near the middle of that edge; no_index if it cannot be split.
    agvd::Index split(agvd::Index face, agvd::Index k);
    //! The edge between two vertices: `gone` goes, `into` stays where it is.
    bool collapse(agvd::Index gone, agvd::Index into);
    //! Takes a step along the surface if the worst face around gets better by more than `gain`.
    bool move(agvd::Index v, const agvd::Vec3& step, double gain);

    [[nodiscard]] Mark mark() const;
    void take_back(const Mark& mark);
    //! Faces that were changed since, each once.
    //! \param[out] now     those that are there.
    //! \param[out] before  quality of those that were there, as it was.
    void changed_since(const Mark& mark, std::vector<agvd::Index>& now,
                       std::vector<double>& before) const;

    //! Without what is gone.
    //! \param[out] numbers  those of the vertices here.
    [[nodiscard]] PlacedMesh result(std::vector<agvd::Index>& numbers) const;

private:
    struct Place {
        agvd::SurfacePoint point;
        agvd::Vec3 offset = agvd::Vec3::Zero(), at = offset, facing = offset;
        Mobility mobility = Mobility::Free;
    };
    struct Half {
        agvd::Index face = agvd::no_index, k = 0;
    };

    void locate(Place& place) const;
    [[nodiscard]] double quality_of(const agvd::Triangle& t) const;
    [[nodiscard]] agvd::Vec3 normal_of(const agvd::Triangle& t) const;
    void put_face(agvd::Index f, const agvd::Triangle& corner, std::uint8_t hard);
    void drop_face(agvd::Index f);
    void put_place(agvd::Index v, const Place& place);
    void log_fan(agvd::Index v) { old_fans_.emplace_back(v, fans_[v]); }
    void measure_around(agvd::Index v);
    [[nodiscard]] bool has_corner(agvd::Index f, agvd::Index v) const;
    [[nodiscard]] std::optional<Half> half_edge(agvd::Index from, agvd::Index to) const;
    [[nodiscard]] bool are_joined(agvd::Index a, agvd::Index b) const;
    [[nodiscard]] bool folds(const std::array<agvd::Index, 4>& quad, Half first, Half second) const;
    [[nodiscard]] bool may_collapse(agvd::Index gone, agvd::Index into) const;
    [[nodiscard]] bool place_between(agvd::Index a, agvd::Index b, bool is_hard,
                                     Place& place) const;
    void split_side(Half side, agvd::Index vertex);
    [[nodiscard]] double bend(agvd::Index from, agvd::Index to) const;
    [[nodiscard]] double largest_bend_at(agvd::Index v) const;
    [[nodiscard]] bool keeps_bend(agvd::Index from, agvd::Index to, double most_before) const;

    const agvd::Surface& surface_;
    double mean_length_ = 0;  // Of the edges at first.
    std::vector<Face> faces_;
    std::vector<Place> places_;                   // By vertex.
    std::vector<std::vector<agvd::Index>> fans_;  // By vertex: its faces.
    std::vector<std::pair<agvd::Index, Face>> old_faces_;
    std::vector<std::pair<agvd::Index, Place>> old_places_;
    std::vector<std::pair<agvd::Index, std::vector<agvd::Index>>> old_fans_;
};

}  // namespace remesh::detail
