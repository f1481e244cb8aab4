//! \file
//! What both formats of VTK share, and VTK's XML. Private to the writers of meshes and diagrams.
#pragma once

#include <array>
#include <map>
#include <span>

#include "remesh/meshfile/numbers.h"
#include "remesh/meshfile/vtk_data.h"

namespace remesh {

//! Colours make one array of bytes, "wind_0", "wind_1" and so on one array "wind", every other
//! attribute an array of its own.
struct VtkOutputArray {
    std::string name;
    NumberType type;
    std::vector<const Attribute*> parts;  //!< One for each component.
    bool is_color = false;
};

//! The arrays of some attributes, which outlive them.
[[nodiscard]] std::vector<VtkOutputArray> arrays_of(const std::vector<Attribute>& attributes);

//! Appends the numbers of all elements.
void append_values(const VtkOutputArray& array, std::size_t num_elements, std::endian order,
                   Ticker& ticker, std::string& bytes);

//! The text as the value of an attribute. What XML cannot hold becomes '_'.
[[nodiscard]] std::string xml_escaped(std::string_view text);

//! One piece, little endian; arrays are appended as they are ("raw"), not compressed.
class VtpWriter {
public:
    //! \param is_grid  UnstructuredGrid, whose Cells are triangles; else PolyData.
    explicit VtpWriter(bool is_grid = false) : is_grid_(is_grid) {}

    //! A section, such as Points, and its attributes with a blank before each.
    void begin_section(const char* name, const std::string& attributes = {});
    void end_section();

    //! \param type  "Float64", ...
    //! \return where to append the numbers, before the next call.
    std::string& begin_array(const std::string& name, const char* type, std::size_t num_components);
    void end_array();

    //! An array of T with as many rows as there are items; row_of(i) gives the numbers of row i.
    template <typename T, typename RowOf>
    void add_array(const std::string& name, const char* type, std::size_t num_components,
                   std::size_t num_rows, Ticker& ticker, const RowOf& row_of) {
        std::string& bytes = begin_array(name, type, num_components);
        std::array<T, 64> some;
        std::size_t count = 0;
        const auto store = [&] {
            append_numbers<T>(bytes, std::span(some).first(count));
            count = 0;
        };
        for (std::size_t i = 0; i < num_rows; ++i) {
            ticker.tick();
            for (const auto value : row_of(i)) {
                if (count == some.size()) store();
                some[count++] = static_cast<T>(value);
            }
        }
        store();
        end_array();
    }

    //! An array of all the numbers, row after row.
    template <typename T>
    void add_numbers(const std::string& name, const char* type, std::size_t num_components,
                     std::span<const T> numbers) {
        append_numbers<T>(begin_array(name, type, num_components), numbers);
        end_array();
    }

    //! The section of points.
    void add_points(std::span<const Vec3> points, Ticker& ticker) {
        num_points_ = points.size();
        begin_section("Points");
        add_array<double>("Points", "Float64", 3, points.size(), ticker,
                          [&](std::size_t p) { return points[p]; });
        end_section();
    }

    //! A section of cells, such as Polys; corners_of(i) gives the points of cell i.
    template <typename CornersOf>
    void add_cells(const char* section, std::size_t num_cells, Ticker& ticker,
                   const CornersOf& corners_of) {
        std::vector<std::size_t> ends;
        ends.reserve(num_cells);
        num_cells_[section] = num_cells;
        begin_section(section);
        add_array<std::int64_t>("connectivity", "Int64", 1, num_cells, ticker, [&](std::size_t i) {
            auto corners = corners_of(i);
            ends.push_back((ends.empty() ? 0 : ends.back()) + corners.size());
            return corners;
        });
        add_array<std::int64_t>("offsets", "Int64", 1, num_cells, ticker,
                                [&](std::size_t i) { return std::array{ends[i]}; });
        if (is_grid_) {
            add_array<std::uint8_t>("types", "UInt8", 1, num_cells, ticker,
                                    [](std::size_t) { return std::array{VtkCell::Triangle}; });
        }
        end_section();
    }

    //! The whole file's bytes.
    [[nodiscard]] std::string finish() &&;

private:
    bool is_grid_;
    std::size_t num_points_ = 0;
    std::map<std::string_view, std::size_t> num_cells_;  // By section.
    std::string xml_;                                    // Of the sections.
    std::string data_;                                   // Behind the '_' of AppendedData.
    std::string section_;                                // The section that is open.
    std::size_t array_begin_ = 0;  // In the data, of the one that is open: its size comes first.
};

}  // namespace remesh
