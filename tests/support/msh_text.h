//! \file
//! Makes files of Gmsh: the same numbers as text or in binary.
#pragma once

#include <initializer_list>
#include <ostream>
#include <string>

#include "remesh/meshfile/numbers.h"
#include "remesh/meshfile/packed.h"

namespace msh {

//! Texts: the head of a file, its nodes, its element.
inline const std::string text_2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
inline const std::string text_4 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
inline const std::string three_nodes_2 = "$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n";
inline const std::string three_nodes_4 =
    "$Nodes\n1 3 1 3\n2 1 0 3\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n$EndNodes\n";
inline const std::string one_triangle_2 = "$Elements\n1\n1 2 2 0 1 1 2 3\n$EndElements\n";
inline const std::string one_triangle_4 = "$Elements\n1 1 1 1\n2 1 2 1\n1 1 2 3\n$EndElements\n";

struct Form {
    bool is_version_2 = false;
    bool is_binary = false;
    std::endian order = std::endian::little;
    int size = 8;  //!< Bytes of a size_t.
};

inline std::ostream& operator<<(std::ostream& out, const Form& form) {
    return out << (form.is_version_2 ? "2.2" : "4.1") << (form.is_binary ? " binary " : " text ")
               << (form.order == std::endian::big ? "big endian " : "") << form.size;
}

class Text {
public:
    explicit Text(const Form& form) : form_(form) {
        bytes_ = std::string("$MeshFormat\n") + (form.is_version_2 ? "2.2 " : "4.1 ") +
                 (form.is_binary ? "1 " : "0 ") + std::to_string(form.size) + "\n";
        if (form.is_binary) integers({1});
        end_line();
        raw("$EndMeshFormat\n");
    }

    Text& raw(const std::string& text) {
        bytes_ += text;
        return *this;
    }
    //! Behind binary numbers, or at the end of a line of text.
    Text& end_line() {
        if (!bytes_.ends_with('\n') || form_.is_binary) bytes_ += '\n';
        return *this;
    }
    Text& integers(std::initializer_list<int> values) {
        for (const int value : values) number(std::int32_t{value});
        return *this;
    }
    Text& sizes(std::initializer_list<std::uint64_t> values) {
        for (const std::uint64_t value : values) {
            if (form_.size == 4) {
                number(static_cast<std::uint32_t>(value));
            } else {
                number(value);
            }
        }
        return *this;
    }
    Text& reals(std::initializer_list<double> values) {
        for (const double value : values) number(value);
        return *this;
    }
    //! Of nodes and elements.
    Text& tags(std::initializer_list<int> values) {
        if (form_.is_version_2) return integers(values);
        for (const int value : values) sizes({static_cast<std::uint64_t>(value)});
        return *this;
    }
    [[nodiscard]] const std::string& bytes() const { return bytes_; }
    [[nodiscard]] const Form& form() const { return form_; }

private:
    template <typename Number>
    void number(Number value) {
        if (form_.is_binary) return remesh::append(bytes_, value, form_.order);
        remesh::append_shortest(bytes_, value);
        bytes_ += ' ';
    }

    Form form_;
    std::string bytes_;
};

}  // namespace msh
