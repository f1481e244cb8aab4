//! \file
//! Physical groups of Gmsh: labels of faces. Private to the reader and writer of .msh.
#pragma once

#include <map>
#include <utility>

#include "remesh/meshfile/mesh_file.h"
#include "remesh/meshfile/source_file.h"

namespace remesh {

//! What the labels are called. OBJ and 3MF keep those of this name, with what their values are
//! called.
inline constexpr const char* msh_group_name = "group";

//! The groups of a file. 0 is none.
class MshGroups {
public:
    using Entity = std::pair<std::int64_t, std::int64_t>;  //!< Dimension and number.

    //! \param file  named in warnings; outlives this.
    explicit MshGroups(const SourceFile& file) : file_(file) {}

    void add_name(std::int64_t dimension, std::int64_t group, std::string name) {
        names_[{dimension, group}] = std::move(name);
    }
    //! \param has_more  whether the entity is in other groups as well.
    void add_entity(const Entity& entity, std::int64_t group, bool has_more) {
        of_entity_[entity] = group;
        has_several_ = has_several_ || (has_more && entity.first >= 2);
    }
    //! The first group of an entity.
    [[nodiscard]] std::int64_t of(const Entity& entity) const {
        const auto found = of_entity_.find(entity);
        return found == of_entity_.end() ? 0 : found->second;
    }

    //! Adds the labels of faces with what they are called. Groups without a name are called by
    //! their number if others have a name.
    //! \param dimension  of the elements that had these groups.
    void add_to(MeshAttributes& attributes, std::int64_t dimension, std::vector<double> groups);

    //! Of entities in several groups; empty if there are none.
    [[nodiscard]] std::string warning() const;

private:
    const SourceFile& file_;
    std::map<Entity, std::string> names_;  // By dimension and group.
    std::map<Entity, std::int64_t> of_entity_;
    bool has_several_ = false;
};

}  // namespace remesh
