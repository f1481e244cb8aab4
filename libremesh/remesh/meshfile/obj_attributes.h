//! \file
//! Colours and labels of an OBJ file. Private to the reader.
#pragma once

#include <array>
#include <map>

#include "remesh/meshfile/polygon_soup.h"
#include "remesh/meshfile/text_colors.h"
#include "remesh/meshfile/text_scanner.h"

namespace remesh {

class ObjAttributes {
public:
    //! \param is_wanted  false: everything is passed over.
    explicit ObjAttributes(bool is_wanted) : is_wanted_(is_wanted) {}

    //! The words behind a vertex's coordinates: three are a colour, one is a weight.
    void take_color(std::size_t vertex, TextScanner& scan);

    //! The coordinates behind vt: a second one may be missing, a third one does not count.
    void take_texture(TextScanner& scan, SoupTexture& texture) const;

    //! Any other statement than v, vt and f.
    //! \param num_polygons  before it.
    void take(std::string_view statement, std::size_t num_polygons, TextScanner& scan);

    [[nodiscard]] bool is_wanted() const { return is_wanted_; }

    //! All attributes; those of faces have a value for each polygon.
    [[nodiscard]] MeshAttributes finish(std::size_t num_vertices, std::size_t num_polygons) &&;

private:
    // What usemtl, g or o say: a label for each polygon from the statement on.
    struct Labels {
        const char* statement;
        const char* name;  // Of the attribute.
        std::vector<double> values = {};
        std::vector<std::string> names = {};
        std::map<std::string, std::size_t, std::less<>> number = {};
        std::size_t current = 0;

        void begin(const std::string& label, std::size_t num_polygons);
    };

    bool is_wanted_;
    bool has_normals_ = false;
    TextColors colors_;
    std::array<Labels, 3> labels_ = {Labels{"usemtl", "material"}, Labels{"g", "group"},
                                     Labels{"o", "object"}};
    std::vector<std::string> material_files_;
};

}  // namespace remesh
