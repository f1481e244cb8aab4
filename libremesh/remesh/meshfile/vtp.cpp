// VTK's XML files: PolyData (.vtp) and UnstructuredGrid (.vtu). The pieces of a file become
// one mesh, piece after piece.

#include <algorithm>
#include <map>
#include <utility>

#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/vtk_data.h"
#include "remesh/meshfile/vtk_xml.h"
#include "remesh/meshfile/vtk_xml_arrays.h"

namespace remesh {
namespace {

// Arrays of points or cells, piece after piece. What not all pieces have is declined.
class PieceArrays {
public:
    void take(std::vector<VtkArray> arrays, std::vector<DeclinedAttribute>& declined,
              const char* kind) {
        std::map<std::string, std::size_t> of_name;
        for (std::size_t i = 0; i < arrays.size(); ++i) of_name.try_emplace(arrays[i].name, i);
        if (std::exchange(is_first_, false)) {
            arrays_ = std::move(arrays);
            return;
        }
        std::erase_if(arrays_, [&](VtkArray& whole) {
            const auto found = of_name.find(whole.name);
            if (found != of_name.end()) {
                const VtkArray part = std::move(arrays[found->second]);
                of_name.erase(found);
                if (part.type == whole.type && part.num_components == whole.num_components) {
                    whole.values.insert(whole.values.end(), part.values.begin(), part.values.end());
                    return false;
                }
            }
            declined.push_back({kind + whole.name, "not all pieces have it"});
            return true;
        });
        for (const auto& [name, array] : of_name) {
            declined.push_back({kind + name, "not all pieces have it"});
        }
    }
    std::vector<VtkArray> finish() && { return std::move(arrays_); }

private:
    std::vector<VtkArray> arrays_;
    bool is_first_ = true;
};

class VtpReader {
public:
    explicit VtpReader(const SourceFile& file)
        : file_(file), xml_(parse_vtk_xml(file)), arrays_(file, xml_) {}

    VtkData read() {
        for (const VtkXmlPiece& piece : xml_.pieces) read_piece(piece);
        data_.points = std::move(points_);
        data_.of_points = std::move(of_points_).finish();
        data_.of_cells = std::move(of_cells_).finish();
        return std::move(data_);
    }

private:
    using Count = std::optional<std::uint64_t>;

    void read_piece(const VtkXmlPiece& piece) {
        const std::uint64_t num_points = read_points(piece);
        std::uint64_t num_cells = 0;
        const auto read = [&](const char* section, const std::string& count, VtkCell type) {
            num_cells += read_cells(piece, section, arrays_.count(count, section, piece.tag), type,
                                    num_points);
        };
        if (xml_.is_grid) {
            read("Cells", piece.num_cells, VtkCell{0});
        } else {
            read("Verts", piece.num_verts, VtkCell::Vertices);
            read("Lines", piece.num_lines, VtkCell::Lines);
            read("Polys", piece.num_polys, VtkCell::Polygon);
            read("Strips", piece.num_strips, VtkCell::Strip);
        }
        num_points_ += num_points;
        if (!file_.with_attributes || (num_points == 0 && num_cells == 0)) return;
        of_points_.take(read_data(piece, "PointData", num_points), data_.declined, "vertex ");
        of_cells_.take(read_data(piece, "CellData", num_cells), data_.declined, "face ");
    }

    static const VtkXmlArray* find(const VtkXmlPiece& piece, std::string_view section,
                                   std::string_view name) {
        const auto found =
            std::find_if(piece.arrays.begin(), piece.arrays.end(), [&](const VtkXmlArray& array) {
                return array.section == section && (name.empty() || array.name == name);
            });
        return found == piece.arrays.end() ? nullptr : &*found;
    }

    // \return how many points the piece has.
    std::uint64_t read_points(const VtkXmlPiece& piece) {
        const Count announced = arrays_.count(piece.num_points, "NumberOfPoints", piece.tag);
        const VtkXmlArray* const found = find(piece, "Points", "");
        if (found == nullptr) {
            if (announced.value_or(0) == 0) return 0;
            file_.fail_malformed(piece.tag, "NumberOfPoints is " + std::to_string(*announced) +
                                                ", but the piece has no array of Points; export "
                                                "the file again");
        }
        VtkArray points = arrays_.read(*found);
        if (points.num_components != 3) arrays_.fail(*found, "it has not three coordinates each");
        require_count(*found, points, announced);
        const std::uint64_t count = points.values.size() / 3;
        if (!points_) {
            points_ = std::move(points);
        } else {
            points_->values.insert(points_->values.end(), points.values.begin(),
                                   points.values.end());
        }
        return count;
    }

    void require_count(const VtkXmlArray& found, const VtkArray& array,
                       const Count& announced) const {
        const std::size_t size = array.values.size(), width = array.num_components;
        const bool is_whole = width != 0 && size % width == 0;
        if (is_whole && (!announced || size / width == *announced)) return;
        arrays_.fail(found, "it has " + std::to_string(size) + " numbers for " +
                                std::to_string(announced.value_or(0)) + " elements with " +
                                std::to_string(width) + " each");
    }

    // \return how many cells the section has.
    std::uint64_t read_cells(const VtkXmlPiece& piece, const char* section, const Count& announced,
                             VtkCell type, std::uint64_t num_points) {
        const VtkXmlArray* const corners = find(piece, section, "connectivity");
        const VtkXmlArray* const ends = find(piece, section, "offsets");
        const VtkXmlArray* const types = xml_.is_grid ? find(piece, section, "types") : nullptr;
        if (corners == nullptr || ends == nullptr || (xml_.is_grid && types == nullptr)) {
            if (announced.value_or(0) == 0) return 0;
            file_.fail_malformed(piece.tag, "there are " + std::to_string(*announced) + " cells (" +
                                                section +
                                                "), but not the arrays that make them; export the "
                                                "file again");
        }
        VtkCells cells{.corners = arrays_.read(*corners), .ends = {}, .types = {type}};
        const VtkArray offsets = arrays_.read(*ends);
        require_count(*ends, offsets, announced);
        cells.ends = ends_of_cells(offsets, 0, cells.corners.values.size(), file_);
        if (types != nullptr) {
            const VtkArray numbers = arrays_.read(*types);
            require_count(*types, numbers, cells.ends.size());
            cells.types = types_of_cells(numbers);
        }
        require_points(*corners, cells.corners, num_points);
        const std::uint64_t count = cells.ends.size();
        if (count > 0) data_.cells.push_back(std::move(cells));
        return count;
    }

    // Corners count from the first point of their piece.
    void require_points(const VtkXmlArray& found, VtkArray& corners, std::uint64_t num_points) {
        for (double& corner : corners.values) {
            arrays_.ticker().tick();
            if (!(corner >= 0 && corner < static_cast<double>(num_points))) {
                file_.fail_unusable(
                    found.tag, "array " + in_quotes(found.name) + " of " + found.section +
                                   " names point " + shown(corner) + ", but the piece has only " +
                                   std::to_string(num_points) +
                                   " points, counted from 0; correct the cell, or export the file "
                                   "again");
            }
            corner += static_cast<double>(num_points_);
        }
    }
    static std::string shown(double number) {
        std::string text = std::to_string(number);
        return text.substr(0, text.find('.'));
    }

    std::vector<VtkArray> read_data(const VtkXmlPiece& piece, std::string_view section,
                                    std::uint64_t count) {
        const bool is_of_points = section == "PointData";
        const char* const kind = is_of_points ? "vertex " : "face ";
        std::vector<VtkArray> result;
        for (const VtkXmlArray& array : piece.arrays) {
            if (array.section != section) continue;
            const VtkType* const type = find_vtk_xml_type(array.type);
            const auto is = [&](const std::string& name) {
                return !name.empty() && array.name == name;
            };
            if (type == nullptr) {
                decline(kind + array.name, "arrays of this type are not carried over");
            } else if (is_of_points && is(piece.normals_of_points)) {
                data_.normals = type->type;
            } else if (is_of_points && is(piece.texture_of_points)) {
                decline(kind + array.name, "texture coordinates are not carried over");
            } else if (!is_of_points && is(piece.normals_of_cells)) {
                decline(kind + array.name, "normals of faces are not carried over");
            } else {
                result.push_back(arrays_.read(array));
                require_count(array, result.back(), count);
            }
        }
        return result;
    }

    void decline(const std::string& name, const char* reason) {
        const auto is_same = [&](const DeclinedAttribute& one) { return one.name == name; };
        if (std::none_of(data_.declined.begin(), data_.declined.end(), is_same)) {
            data_.declined.push_back({name, reason});
        }
    }

    const SourceFile& file_;
    VtkXmlFile xml_;
    VtkXmlArrays arrays_;
    VtkData data_;
    std::optional<VtkArray> points_;
    PieceArrays of_points_, of_cells_;
    std::uint64_t num_points_ = 0;  // Of the pieces before.
};

}  // namespace

VtkData read_vtk_xml(const SourceFile& file) { return VtpReader(file).read(); }

MeshFile read_vtp(SourceFile file) { return make_mesh(read_vtk_xml(file), file); }

}  // namespace remesh
