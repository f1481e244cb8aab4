//! \file
//! Some of the cells of a diagram.
#pragma once

#include "agvd/diagram/arc_store.h"

namespace agvd {

//! A bit for each site; no_index is in no set.
class CellSet {
public:
    CellSet(Index num_sites, bool has_all) : has_(num_sites, has_all ? 1 : 0) {}

    [[nodiscard]] bool has(Index site) const { return site != no_index && has_[site] != 0; }
    void insert(Index site) {
        if (site != no_index) has_[site] = 1;
    }
    //! Whether there were any new ones.
    bool insert(const CellSet& other);
    //! The cells that reach into a listed face.
    void insert_those_in(Index face, const ArcStore& arcs);

private:
    std::vector<std::uint8_t> has_;
};

//! All faces, or some of them, ascending.
class FaceList {
public:
    //! All.
    explicit FaceList(Index num_faces) : size_(num_faces) {}
    //! Those that any of the cells reaches into, as far as they hang together with one of these
    //! faces. Cost: O(seeds + faces), and a pass over #F bytes.
    FaceList(const Surface& surface, const EdgeLabels& labels, const ArcStore& arcs,
             const CellSet& cells, std::span<const Index> seeds);

    [[nodiscard]] Index size() const { return size_; }
    [[nodiscard]] Index operator[](Index i) const { return faces_.empty() ? i : faces_[i]; }

private:
    Index size_ = 0;
    std::vector<Index> faces_;  // Empty: all, if any.
};

}  // namespace agvd
