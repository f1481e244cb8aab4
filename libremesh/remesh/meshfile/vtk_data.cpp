#include "remesh/meshfile/vtk_data.h"

#include <utility>

#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/numbers.h"
#include "remesh/meshfile/polygon_soup.h"

namespace remesh {
namespace {

template <typename T>
double load_as(const char* bytes, std::endian order) {
    return static_cast<double>(load<T>(bytes, order));
}

constexpr std::array vtk_types = {
    VtkType{"char", "Int8", 1, NumberType::Int8, load_as<std::int8_t>},
    VtkType{"unsigned_char", "UInt8", 1, NumberType::UInt8, load_as<std::uint8_t>},
    VtkType{"short", "Int16", 2, NumberType::Int16, load_as<std::int16_t>},
    VtkType{"unsigned_short", "UInt16", 2, NumberType::UInt16, load_as<std::uint16_t>},
    VtkType{"int", "Int32", 4, NumberType::Int32, load_as<std::int32_t>},
    VtkType{"vtkidtype", "", 4, NumberType::Int32, load_as<std::int32_t>},
    VtkType{"unsigned_int", "UInt32", 4, NumberType::UInt32, load_as<std::uint32_t>},
    VtkType{"long", "", 8, NumberType::Int32, load_as<std::int64_t>},
    VtkType{"vtktypeint64", "Int64", 8, NumberType::Int32, load_as<std::int64_t>},
    VtkType{"unsigned_long", "", 8, NumberType::UInt32, load_as<std::uint64_t>},
    VtkType{"vtktypeuint64", "UInt64", 8, NumberType::UInt32, load_as<std::uint64_t>},
    VtkType{"float", "Float32", 4, NumberType::Float32, load_as<float>},
    VtkType{"double", "Float64", 8, NumberType::Float64, load_as<double>}};

// The first type whose member has the value, or nullptr.
template <typename Value>
const VtkType* find_type(const Value& value, const auto VtkType::*member) {
    const auto found = std::ranges::find(vtk_types, value, member);
    return found == vtk_types.end() ? nullptr : found;
}

// Names that PLY gives to what is no attribute.
constexpr std::array reserved_names = {"x",           "y", "z", "nx", "ny", "nz", "vertex_indices",
                                       "vertex_index"};

void add_points(const VtkArray& points, const SourceFile& file, PolygonSoup& soup) {
    soup.positions.reserve(points.values.size() / 3);
    for (std::size_t i = 0; i + 2 < points.values.size(); i += 3) {
        soup.ticker.tick(2);
        const Vec3 p(points.values[i], points.values[i + 1], points.values[i + 2]);
        if (!p.allFinite()) {
            file.fail_unusable(points.offset, "point ", i / 3,
                               " has a coordinate that is not finite; correct or delete the point");
        }
        soup.positions.push_back(p);
    }
}

// From VtkCell::Tetrahedron on.
constexpr std::array volume_cells = {VolumeCell::Tetrahedron, VolumeCell::Hexahedron,
                                     VolumeCell::Hexahedron, VolumeCell::Wedge,
                                     VolumeCell::Pyramid};

// Adds cells to a soup and knows which cell each polygon came from.
class CellReader {
public:
    CellReader(const SourceFile& file, PolygonSoup& soup)
        : file_(file), soup_(soup), volumes_(file) {}

    void add(const VtkCells& cells) {
        cells_ = &cells;
        std::size_t begin = 0;
        for (std::size_t i = 0; i < cells.ends.size(); begin = cells.ends[i++]) {
            add_cell(cells.types.size() == 1 ? cells.types[0] : cells.types[i], begin,
                     cells.ends[i]);
            cell_of_polygon_.resize(soup_.num_polygons(), num_cells_++);
        }
    }

    // To be called when all cells are known.
    void add_surface() {
        const std::vector<std::size_t> volume_of_face = volumes_.add_to(soup_);
        num_surface_faces_ = volume_of_face.size();
        for (const std::size_t i : volume_of_face) cell_of_polygon_.push_back(cell_of_volume_[i]);
    }

    void add_warnings(MeshFile& result) const {
        add_warning(result, volumes_.warning(num_surface_faces_));
        if (num_others_ == 0) return;
        add_warning(result, file_.path.string(), ": ", num_others_,
                    " cells that are neither faces nor linear volumes (vertices, lines, curved "
                    "cells) are skipped");
    }

    [[nodiscard]] const std::vector<Index>& cell_of_polygon() const { return cell_of_polygon_; }
    [[nodiscard]] Index num_cells() const { return num_cells_; }

private:
    void add_cell(VtkCell type, std::size_t begin, std::size_t end) {
        constexpr std::array by_row = {0u, 1u, 3u, 2u, 4u, 5u, 7u, 6u};
        const bool is_by_row = type == VtkCell::Pixel || type == VtkCell::Voxel;
        const auto corner = [&](std::size_t k) {
            return vertex(begin + (is_by_row ? by_row[k] : k));
        };
        const std::size_t count = end - begin;
        soup_.ticker.tick();
        switch (type) {
            case VtkCell::Triangle:
            case VtkCell::Quad:
            case VtkCell::Pixel:
                require_corners(count, type == VtkCell::Triangle ? 3 : 4);
                [[fallthrough]];
            case VtkCell::Polygon:
                for (std::size_t k = 0; k < count; ++k) soup_.add_corner(corner(k), offset());
                return soup_.end_polygon();
            case VtkCell::Strip: {
                StripTriangles strip(soup_);
                for (std::size_t k = 0; k < count; ++k) strip.add(corner(k), offset());
                return strip.end();
            }
            case VtkCell::Tetrahedron:
            case VtkCell::Voxel:
            case VtkCell::Hexahedron:
            case VtkCell::Wedge:
            case VtkCell::Pyramid: {
                const VolumeCell kind =
                    volume_cells[static_cast<std::size_t>(type) -
                                 static_cast<std::size_t>(VtkCell::Tetrahedron)];
                require_corners(count, num_corners(kind));
                for (std::size_t k = 0; k < count; ++k) volumes_.add_corner(corner(k), offset());
                volumes_.end_cell(kind);
                return cell_of_volume_.push_back(num_cells_);
            }
            default:
                ++num_others_;
        }
    }

    void require_corners(std::size_t found, std::size_t needed) const {
        if (found == needed) return;
        file_.fail_damaged(offset(), "cell ", num_cells_, " has ", found, " corners instead of ",
                           needed);
    }

    [[nodiscard]] std::int64_t vertex(std::size_t corner) const {
        const double value = cells_->corners.values[corner];
        if (value == std::floor(value) && std::abs(value) < 1e15) {
            return static_cast<std::int64_t>(value);
        }
        file_.fail_damaged(offset(), "cell ", num_cells_,
                           " has a corner that is not a whole number");
    }
    [[nodiscard]] std::size_t offset() const { return cells_->corners.offset; }

    const SourceFile& file_;
    PolygonSoup& soup_;
    VolumeSurface volumes_;
    const VtkCells* cells_ = nullptr;
    Index num_cells_ = 0;
    std::size_t num_others_ = 0, num_surface_faces_ = 0;
    std::vector<Index> cell_of_polygon_, cell_of_volume_;
};

// A name that is one word, as PLY wants it.
std::string as_word(const std::string& name) {
    std::string word = name.empty() ? "array" : name;
    for (char& c : word) {
        if ((c >= 0 && c <= ' ') || c == '\x7f') c = '_';
    }
    return word;
}

// Text files may hold words for integers that are none.
bool has_values_of(NumberType type, const VtkArray& array) {
    return std::ranges::all_of(array.values, [&](double v) { return is_value_of(type, v); });
}

NumberType type_of(const VtkArray& array) {
    if (array.type->size < 8 || !is_integer(array.type->type)) return array.type->type;
    return has_values_of(array.type->type, array) ? array.type->type : NumberType::Float64;
}

void require_numbers(const VtkArray& array, std::size_t num_elements, const SourceFile& file) {
    if (array.values.size() == num_elements * array.num_components) return;
    file.fail_damaged(array.offset, "array ", in_quotes(array.name), " has ", array.values.size(),
                      " numbers for ", num_elements, " elements with ", array.num_components,
                      " each");
}

// A third coordinate does not count.
void add_texture(const VtkArray& array, const SourceFile& file, PolygonSoup& soup) {
    require_numbers(array, soup.positions.size(), file);
    SoupTexture& texture = soup.texture;
    texture.name = "vertex " + array.name;
    texture.is_of_vertices = true;
    texture.type = is_integer(array.type->type) ? NumberType::Float64 : array.type->type;
    for (std::size_t i = 0; i < array.values.size(); i += array.num_components) {
        soup.ticker.tick();
        texture.add(array.values[i], array.values[i + 1]);
    }
}

MeshAttributes read_attributes(VtkData& data, const CellReader& cells, std::size_t num_points,
                               const SourceFile& file) {
    MeshAttributes attributes{.normals = data.normals, .declined = std::move(data.declined)};
    for (const VtkArray& array : data.of_points) {
        add_array(array, ElementKind::Vertex, num_points, file, attributes);
    }
    for (const VtkArray& array : data.of_cells) {
        add_array(array, ElementKind::Face, cells.num_cells(), file, attributes);
    }
    spread_to_triangles(cells.cell_of_polygon(), attributes.of_faces);
    return attributes;
}

}  // namespace

void add_array(const VtkArray& array, ElementKind kind, std::size_t num_elements,
               const SourceFile& file, MeshAttributes& attributes) {
    const bool is_vertex = kind == ElementKind::Vertex;
    std::vector<Attribute>& target = is_vertex ? attributes.of_vertices : attributes.of_faces;
    const auto decline = [&](const std::string& name, const char* reason) {
        attributes.declined.push_back({(is_vertex ? "vertex " : "face ") + name, reason});
    };
    require_numbers(array, num_elements, file);
    const NumberType type = type_of(array);
    const std::size_t width = array.num_components;
    const bool is_color = type == NumberType::UInt8 && (width == 3 || width == 4) &&
                          find_attribute(target, "red") == nullptr;
    if (!has_values_of(type, array)) {
        return decline(array.name, "some of its values are not of its type");
    }
    if (!is_color && (width == 0 || width > most_vtk_components)) {
        return decline(array.name, "arrays of so many numbers for an element are not carried over");
    }
    for (std::size_t k = 0; k < width; ++k) {
        const std::string name = is_color     ? color_names[k]
                                 : width == 1 ? as_word(array.name)
                                              : as_word(array.name) + '_' + std::to_string(k);
        if (std::ranges::find(reserved_names, name) != reserved_names.end() ||
            find_attribute(target, name) != nullptr) {
            decline(name, "another property has the same name");
            continue;
        }
        Attribute part{.name = name, .type = type};
        part.values.reserve(num_elements);
        for (std::size_t i = k; i < array.values.size(); i += width) {
            part.values.push_back(array.values[i]);
        }
        target.push_back(std::move(part));
    }
}

const VtkType* find_vtk_type(std::string_view name) { return find_type(name, &VtkType::name); }

const VtkType* find_vtk_xml_type(std::string_view name) {
    return name.empty() ? nullptr : find_type(name, &VtkType::xml_name);
}

const VtkType& vtk_type_of(NumberType number) { return *find_type(number, &VtkType::type); }

void VtkArray::read(std::string_view bytes, std::endian order, Ticker& ticker) {
    values.reserve(bytes.size() / type->size);
    for (; !bytes.empty(); bytes.remove_prefix(type->size)) {
        ticker.tick();
        values.push_back(type->load(bytes.data(), order));
    }
}

std::vector<std::size_t> ends_of_cells(const VtkArray& offsets, std::size_t num_corners,
                                       const SourceFile& file) {
    std::vector<std::size_t> ends;
    Ticker ticker = file.ticker;
    double last = 0;
    for (const double end : offsets.values) {
        ticker.tick();
        if (!(end >= last && end <= static_cast<double>(num_corners) && end == std::floor(end))) {
            file.fail_damaged(offsets.offset, "the offset of cell ", ends.size(),
                              " is not in order");
        }
        ends.push_back(static_cast<std::size_t>(end));
        last = end;
    }
    if (last != static_cast<double>(num_corners)) {
        file.fail_damaged(offsets.offset, "the last offset is not the number of corners");
    }
    return ends;
}

std::vector<VtkCell> types_of_cells(const VtkArray& numbers) {
    std::vector<VtkCell> types;
    types.reserve(numbers.values.size());
    for (const double number : numbers.values) {
        const bool is_type = is_value_of(NumberType::UInt8, number);
        types.push_back(VtkCell{is_type ? static_cast<std::uint8_t>(number) : std::uint8_t{0}});
    }
    return types;
}

MeshFile make_mesh(VtkData data, const SourceFile& file) {
    PolygonSoup soup(file, 0);
    if (data.points) add_points(*data.points, file, soup);
    CellReader cells(file, soup);
    for (const VtkCells& group : data.cells) cells.add(group);
    cells.add_surface();
    MeshAttributes attributes;
    if (file.with_attributes) {
        attributes = read_attributes(data, cells, soup.positions.size(), file);
        if (data.texture) add_texture(*data.texture, file, soup);
    }
    MeshFile result = std::move(soup).finish();
    attach(std::move(attributes), result);
    cells.add_warnings(result);
    return result;
}

}  // namespace remesh
