//! \file
//! A mesh on a surface, edited by flips, splits, collapses and moves that can be undone.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "agvd/mesh/surface.h"
#include "remesh/curves/glue.h"
#include "remesh/placement/placement.h"

namespace remesh::detail {

//! Every edit keeps the topology, and chains of hard edges stay chains of hard edges. No normal
//! turns by more than 60 degrees, and no edge becomes sharper than both 60 degrees and the edges
//! around it were. Edits that would break these rules change nothing.
class EditedMesh {
public:
    struct Face {
        Triangle corner;
        std::array<bool, 3> is_hard{};  //!< k: the edge from corner k to the next one.
        bool is_there = false;
        double quality = 0;  //!< shape_quality(); 1 less if the face points against the surface.
    };
    //! A state to which edits can be undone.
    struct Mark {
        std::size_t faces = 0, vertices = 0, fans = 0;  // Sizes of the journals.
        Index num_faces = 0, num_vertices = 0;
    };

    //! \param surface   outlives this.
    //! \param mobility  #V. Vertices on hard edges are not Free.
    //! \param hard      edges that are never flipped, in one direction or both; must include all
    //!                  edges of a single face.
    EditedMesh(const Surface& surface, const PlacedMesh& mesh, std::span<const Mobility> mobility,
               std::span<const DirectedEdge> hard);

    [[nodiscard]] Index num_faces() const { return static_cast<Index>(faces_.size()); }
    [[nodiscard]] Index num_vertices() const { return static_cast<Index>(vertices_.size()); }
    [[nodiscard]] const Face& face(Index f) const { return faces_[f]; }
    //! In no order; empty: the vertex was removed.
    [[nodiscard]] std::span<const Index> faces_at(Index v) const { return fans_[v]; }
    [[nodiscard]] const Vec3& at(Index v) const { return vertices_[v].at; }
    [[nodiscard]] Mobility mobility(Index v) const { return vertices_[v].mobility; }
    [[nodiscard]] double worst_at(Index v) const;
    //! The neighbours before and after a vertex along its hard edges; no_index: none.
    [[nodiscard]] std::array<Index, 2> hard_neighbours(Index v) const;

    //! Flips the edge from corner k of the face to the next.
    bool flip(Index face, Index k);
    //! \return the new vertex, near the middle of that edge; no_index if it cannot be split.
    Index split(Index face, Index k);
    //! Collapses the edge between two vertices: removes `gone`; `into` stays in place.
    bool collapse(Index gone, Index into);
    //! Moves a vertex along the surface if the worst face around it gets better by more than
    //! `gain`. Does not if its walk is cut off.
    bool move(Index v, const Vec3& step, double gain);
    //! Edges of the surface that all calls of `move` together crossed: their cost.
    [[nodiscard]] std::size_t num_crossings() const { return num_crossings_; }

    [[nodiscard]] Mark mark() const;
    void take_back(const Mark& mark);
    //! Faces changed since the mark, each once.
    //! \param[out] now     the changed faces that exist now.
    //! \param[out] before  the old qualities of those that existed at the mark.
    void changed_since(const Mark& mark, std::vector<Index>& now,
                       std::vector<double>& before) const;

    //! The mesh without removed faces and vertices.
    //! \param[out] numbers  by vertex of the result: its number here.
    [[nodiscard]] PlacedMesh result(std::vector<Index>& numbers) const;

private:
    struct Vertex {
        SurfacePoint point;
        Vec3 offset = Vec3::Zero(), at = offset, facing = offset;
        Mobility mobility = Mobility::Free;
    };
    struct Half {
        Index face = no_index, k = 0;
    };

    void locate(Vertex& vertex) const;
    [[nodiscard]] double quality_of(const Triangle& t) const;
    [[nodiscard]] Vec3 normal_of(const Triangle& t) const;
    void put_face(Index f, const Triangle& corner, const std::array<bool, 3>& is_hard);
    void drop_face(Index f);
    void put_vertex(Index v, const Vertex& vertex);
    void log_fan(Index v) { old_fans_.emplace_back(v, fans_[v]); }
    void measure_around(Index v);
    [[nodiscard]] bool has_corner(Index f, Index v) const;
    [[nodiscard]] std::optional<Half> half_edge(Index from, Index to) const;
    [[nodiscard]] bool are_joined(Index a, Index b) const;
    [[nodiscard]] bool folds(const std::array<Index, 4>& quad, Half first, Half second) const;
    [[nodiscard]] bool may_collapse(Index gone, Index into) const;
    [[nodiscard]] bool find_between(Index a, Index b, bool is_hard, Vertex& vertex) const;
    void split_side(Half side, Index vertex);
    [[nodiscard]] double bend(Index from, Index to) const;
    [[nodiscard]] double largest_bend_at(Index v) const;
    [[nodiscard]] bool keeps_bend(Index from, Index to, double most_before) const;

    const Surface& surface_;
    double mean_length_ = 0;  // Of the initial edges.
    std::size_t num_crossings_ = 0;
    std::vector<Face> faces_;
    std::vector<Vertex> vertices_;          // By vertex.
    std::vector<std::vector<Index>> fans_;  // By vertex: its faces.
    std::vector<std::pair<Index, Face>> old_faces_;
    std::vector<std::pair<Index, Vertex>> old_vertices_;
    std::vector<std::pair<Index, std::vector<Index>>> old_fans_;
};

}  // namespace remesh::detail
