// Gmsh's .msh, versions 2 and 4.1, text or binary: nodes, triangles and quads, or the surface of
// volumes; physical groups are the labels `group` (format: Gmsh's reference manual, "MSH file
// format" and "Legacy formats").

#include <cmath>
#include <set>
#include <utility>

#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/msh_elements.h"
#include "remesh/meshfile/msh_groups.h"
#include "remesh/meshfile/msh_scanner.h"
#include "remesh/meshfile/msh_values.h"

namespace remesh {
namespace {

class MshReader {
public:
    explicit MshReader(SourceFile& file)
        : file_(file), scan_(file), soup_(file, 1), volumes_(file), groups_(file) {}

    MeshFile read() {
        while (const auto section = scan_.next_section()) {
            if (read_section(*section)) {
                scan_.end_section(*section);
            } else {
                skip(*section);
            }
        }
        return finish();
    }

private:
    // \return whether it is a section that is known.
    bool read_section(const std::string& name) {
        if (name == "PhysicalNames") {
            read_names();
        } else if (name == "Nodes") {
            if (nodes_.size() > 0) scan_.fail("the section $Nodes comes twice");
            if (scan_.is_version_2()) {
                read_nodes_2();
            } else {
                read_nodes_4();
            }
            if (const auto twice = nodes_.sort()) {
                file_.fail_unusable(scan_.start(), "several nodes have the number ", *twice,
                                    "; correct them, or export the file again");
            }
        } else if (name == "Elements") {
            if (scan_.is_version_2()) {
                read_elements_2();
            } else {
                read_elements_4();
            }
            faces_.sort();
        } else if (name == "Entities" && !scan_.is_version_2()) {
            scan_.begin_numbers();
            read_entities(false);
        } else if (name == "PartitionedEntities" && !scan_.is_version_2()) {
            scan_.begin_numbers();
            scan_.size("the number of partitions");
            for (std::uint64_t left = scan_.size("the number of ghosts"); left > 0; --left) {
                skip_integers(2);
            }
            read_entities(true);
        } else if (name == "NodeData" && file_.with_attributes && nodes_.size() > 0) {
            of_nodes_.read(scan_, nodes_, soup_.ticker);
        } else if (name == "ElementData" && faces_.size() > 0) {
            of_faces_.read(scan_, faces_, soup_.ticker);
        } else {
            return false;
        }
        return true;
    }

    void skip(const std::string& name) {
        scan_.skip_section(name);
        if (name == "ParametricNodes") {
            scan_.fail("parametric nodes of version 2 are not supported");
        }
        if (file_.with_attributes && name.ends_with("Data")) {
            declined_.push_back(
                {"section " + name, "only values of nodes and faces, behind them, are read"});
        }
    }

    void read_names() {
        for (std::uint64_t left = scan_.text_count("the number of names"); left > 0; --left) {
            soup_.ticker.tick();
            const std::int64_t dimension = scan_.text_integer("the dimension of a group");
            const std::int64_t number = scan_.text_integer("the number of a group");
            groups_.add_name(dimension, in_range(number), scan_.quoted_name());
        }
    }

    // Of these the groups are needed. A part of a partition has them as well.
    void read_entities(bool are_parts) {
        std::array<std::uint64_t, 4> counts;
        for (std::uint64_t& count : counts) count = scan_.size("a number of entities");
        for (int dimension = 0; dimension < 4; ++dimension) {
            for (std::uint64_t left = counts[static_cast<std::size_t>(dimension)]; left > 0;
                 --left) {
                soup_.ticker.tick();
                read_entity(dimension, are_parts);
            }
        }
    }

    void read_entity(int dimension, bool is_part) {
        const std::int64_t number = scan_.integer("the number of an entity");
        if (is_part) {
            // Between parts of a volume there are surfaces, which are none of the mesh.
            if (scan_.integer("a dimension") > dimension)
                between_parts_.insert({dimension, number});
            skip_integers(1);  // Of which it is a part.
            skip_integers(scan_.size("the number of partitions"));
        }
        for (int k = dimension == 0 ? 3 : 6; k > 0; --k) scan_.real("a coordinate of an entity");
        const std::uint64_t num_groups = scan_.size("the number of groups");
        if (num_groups > 0) {
            groups_.add_entity({dimension, number}, read_group("a group"), num_groups > 1);
            skip_integers(num_groups - 1);
        }
        if (dimension > 0) skip_integers(scan_.size("the number of entities around it"));
    }

    void skip_integers(std::uint64_t count) {
        for (; count > 0; --count) {
            soup_.ticker.tick();
            scan_.integer("a number");
        }
    }

    // Without its sign, which is an orientation.
    std::int64_t in_range(std::int64_t group) const {
        if (group >= -INT32_MAX && group <= INT32_MAX) return std::abs(group);
        file_.fail_malformed(scan_.start(),
                             "a group has more than 32 bits; renumber the physical groups");
    }
    std::int64_t read_group(const char* what) { return in_range(scan_.integer(what)); }

    void read_nodes_2() {
        std::uint64_t left = scan_.text_count("the number of nodes");
        scan_.begin_numbers();
        for (; left > 0; --left) {
            nodes_.add(scan_.tag("the number of a node"));
            read_position();
        }
    }

    void read_nodes_4() {
        scan_.begin_numbers();
        std::uint64_t blocks = scan_.size("the number of blocks");
        const std::uint64_t announced = scan_.size("the number of nodes");
        scan_.size("the least number");
        scan_.size("the largest number");
        for (; blocks > 0; --blocks) {
            soup_.ticker.tick();
            const std::int64_t dimension = scan_.integer("a dimension");
            if (dimension < 0 || dimension > 3) scan_.fail("the dimension is ", dimension);
            scan_.integer("an entity");
            const bool is_parametric = scan_.integer("0, or 1 for parametric nodes") != 0;
            const std::uint64_t count = scan_.size("the number of nodes of a block");
            for (std::uint64_t i = 0; i < count; ++i) {
                soup_.ticker.tick();
                nodes_.add(scan_.tag("the number of a node"));
            }
            for (std::uint64_t i = 0; i < count; ++i) {
                read_position();
                for (std::int64_t k = is_parametric ? dimension : 0; k > 0; --k) {
                    scan_.real("a parameter");
                }
            }
        }
        require_count(nodes_.size(), announced, "nodes");
    }

    void require_count(std::uint64_t count, std::uint64_t announced, const char* what) {
        if (count == announced) return;
        scan_.fail("the blocks hold ", count, " ", what, ", but ", announced, " are announced");
    }

    void read_position() {
        soup_.ticker.tick(2);
        Vec3 p;
        for (int k = 0; k < 3; ++k) {
            p[k] = scan_.real("a coordinate");
            if (std::isfinite(p[k])) continue;
            file_.fail_unusable(scan_.start(), "a coordinate of node ", soup_.positions.size(),
                                " (from 0) is not finite; correct or delete the node");
        }
        soup_.positions.push_back(p);
    }

    // A text has the number of an element in front of its type. Binary files have blocks of
    // elements of one type.
    void read_elements_2() {
        std::uint64_t left = scan_.text_count("the number of elements");
        scan_.begin_numbers();
        while (left > 0) {
            std::uint64_t number = scan_.is_binary() ? 0 : scan_.tag("the number of an element");
            const MshType& type = read_type();
            const std::int64_t count =
                scan_.is_binary() ? scan_.integer("the number of elements of a block") : 1;
            if (count < 1 || static_cast<std::uint64_t>(count) > left) {
                scan_.fail("a block has ", count, " of the ", left, " elements that are left");
            }
            left -= static_cast<std::uint64_t>(count);
            const std::int64_t num_tags = scan_.integer("the number of tags");
            if (num_tags < 0) scan_.fail("the number of tags is negative");
            for (std::int64_t i = 0; i < count; ++i) {
                if (scan_.is_binary()) number = scan_.tag("the number of an element");
                const std::int64_t group = num_tags > 0 ? read_group("a physical group") : 0;
                skip_integers(static_cast<std::uint64_t>(std::max(num_tags, std::int64_t{1}) - 1));
                read_element(type, number, group);
            }
        }
    }

    void read_elements_4() {
        scan_.begin_numbers();
        std::uint64_t blocks = scan_.size("the number of blocks");
        const std::uint64_t announced = scan_.size("the number of elements");
        scan_.size("the least number");
        scan_.size("the largest number");
        std::uint64_t num_read = 0;
        for (; blocks > 0; --blocks) {
            soup_.ticker.tick();
            const std::int64_t dimension = scan_.integer("a dimension");
            const MshGroups::Entity entity{dimension, scan_.integer("an entity")};
            const std::int64_t group = groups_.of(entity);
            const bool is_kept = !between_parts_.contains(entity);
            const MshType& type = read_type();
            const std::uint64_t count = scan_.size("the number of elements of a block");
            for (std::uint64_t i = 0; i < count; ++i, ++num_read) {
                const std::uint64_t number = scan_.tag("the number of an element");
                read_element(type, number, group, is_kept);
            }
        }
        require_count(num_read, announced, "elements");
    }

    const MshType& read_type() {
        const std::int64_t number = scan_.integer("the type of an element");
        const auto* const type = std::ranges::find(msh_types, number, &MshType::number);
        if (type != std::end(msh_types)) return *type;
        file_.fail_malformed(scan_.start(), "elements of type ", number,
                             " are not supported; save the mesh with elements of order 1");
    }

    void read_element(const MshType& type, std::uint64_t number, std::int64_t group,
                      bool is_kept = true) {
        is_kept = is_kept && type.dimension >= 2;
        for (std::size_t k = 0; k < type.num_nodes; ++k) {
            soup_.ticker.tick();
            const std::uint64_t node = scan_.tag("a node of an element");
            if (k >= type.num_corners || !is_kept) continue;
            const auto vertex = nodes_.find(node);
            if (!vertex) {
                file_.fail_unusable(scan_.start(), "element ", number, " names node ", node,
                                    ", which is not among the ", nodes_.size(),
                                    " nodes before it; correct the element, or export the file "
                                    "again");
            }
            const auto corner = static_cast<std::int64_t>(*vertex);
            if (type.dimension == 2) {
                soup_.add_corner(corner, scan_.start());
            } else {
                volumes_.add_corner(corner, scan_.start());
            }
        }
        if (!is_kept) return;
        if (type.dimension == 2) {
            soup_.end_polygon();
        } else {
            volumes_.end_cell(type.cell);
        }
        if (type.num_nodes > type.num_corners) ++num_curved_;
        if (!file_.with_attributes) return;
        (type.dimension == 2 ? face_groups_ : volume_groups_).push_back(static_cast<double>(group));
        if (type.dimension == 2) faces_.add(number);
    }

    MeshFile finish() {
        const std::int64_t dimension = soup_.num_polygons() > 0 ? 2 : 3;
        const std::vector<std::size_t> cell_of_face = volumes_.add_to(soup_);
        if (file_.with_attributes) {
            for (const std::size_t cell : cell_of_face)
                face_groups_.push_back(volume_groups_[cell]);
        }
        const std::size_t num_nodes = soup_.positions.size(), num_faces = soup_.num_polygons();
        MeshFile result = std::move(soup_).finish();
        MeshAttributes attributes;
        attributes.declined = std::move(declined_);
        if (std::ranges::count(face_groups_, 0) < std::ssize(face_groups_)) {
            groups_.add_to(attributes, dimension, std::move(face_groups_));
            add_warning(result, groups_.warning());
        }
        of_nodes_.add_to(attributes, num_nodes, file_);
        of_faces_.add_to(attributes, num_faces, file_);
        attach(std::move(attributes), result);
        add_warning(result, volumes_.warning(cell_of_face.size()));
        if (num_curved_ > 0) {
            add_warning(result, file_.path.string(), ": ",
                        detail::counted(num_curved_, "curved element"),
                        ": read as flat ones, by their corners");
        }
        return result;
    }

    SourceFile& file_;
    MshScanner scan_;
    PolygonSoup soup_;
    VolumeSurface volumes_;
    MshTags nodes_, faces_;
    MshGroups groups_;
    std::set<MshGroups::Entity> between_parts_;
    std::size_t num_curved_ = 0;
    std::vector<double> face_groups_, volume_groups_;
    MshValues of_nodes_{ElementKind::Vertex}, of_faces_{ElementKind::Face};
    std::vector<DeclinedAttribute> declined_;
};

}  // namespace

MeshFile read_msh(SourceFile file) { return MshReader(file).read(); }

}  // namespace remesh
