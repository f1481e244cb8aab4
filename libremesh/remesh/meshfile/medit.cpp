// Medit's .mesh, ascii: vertices, triangles and quadrilaterals, or the surface of tetrahedra and
// the like; their references are the labels `ref`. Edges, of which ridges are some, are feature
// edges; corners, required vertices and required edges are locked (format: Frey, "MEDIT: an
// interactive mesh visualization software", INRIA RT-0253, 2001).

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "remesh/meshfile/formats.h"
#include "remesh/meshfile/polygon_soup.h"
#include "remesh/meshfile/text_scanner.h"

namespace remesh {
namespace {

constexpr const char* ref_name = "ref";

// A list of the file. Those that are skipped have some numbers for each element.
struct MeditList {
    enum class Kind {
        Vertices,
        Faces,
        Volumes,
        Edges,
        Ridges,  // They are among the edges.
        RequiredEdges,
        RequiredVertices,
        PassedOver
    };
    std::string_view keyword;
    Kind kind;
    std::size_t size = 0;  // Corners or numbers of an element.
    VolumeCell cell = {};
};
constexpr MeditList medit_lists[] = {
    {"Vertices", MeditList::Kind::Vertices},
    {"Triangles", MeditList::Kind::Faces, 3},
    {"Quadrilaterals", MeditList::Kind::Faces, 4},
    {"Tetrahedra", MeditList::Kind::Volumes, 4, VolumeCell::Tetrahedron},
    {"Hexahedra", MeditList::Kind::Volumes, 8, VolumeCell::Hexahedron},
    {"Prisms", MeditList::Kind::Volumes, 6, VolumeCell::Wedge},
    {"Pyramids", MeditList::Kind::Volumes, 5, VolumeCell::Pyramid},
    {"Edges", MeditList::Kind::Edges},
    {"Ridges", MeditList::Kind::Ridges},
    {"RequiredEdges", MeditList::Kind::RequiredEdges},
    {"RequiredVertices", MeditList::Kind::RequiredVertices},
    {"Corners", MeditList::Kind::RequiredVertices},
    {"RequiredTriangles", MeditList::Kind::PassedOver, 1},
    {"RequiredQuadrilaterals", MeditList::Kind::PassedOver, 1},
    {"RequiredTetrahedra", MeditList::Kind::PassedOver, 1},
    {"Normals", MeditList::Kind::PassedOver, 3},
    {"NormalAtVertices", MeditList::Kind::PassedOver, 2},
    {"NormalAtTriangleVertices", MeditList::Kind::PassedOver, 3},
    {"NormalAtQuadrilateralVertices", MeditList::Kind::PassedOver, 3},
    {"Tangents", MeditList::Kind::PassedOver, 3},
    {"TangentAtVertices", MeditList::Kind::PassedOver, 2},
    {"TangentAtEdges", MeditList::Kind::PassedOver, 3}};

using Edge = std::array<Index, 2>;

Edge in_order(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

// Sorted, each once.
std::vector<Edge> edges_of(const TriangleMesh& mesh) {
    std::vector<Edge> edges;
    for (const auto& [a, b, c] : mesh.triangles) {
        edges.insert(edges.end(), {in_order(a, b), in_order(b, c), in_order(c, a)});
    }
    return distinct(std::move(edges));
}

class MeditReader {
public:
    explicit MeditReader(const SourceFile& file)
        : file_(file), scan_(file, 0, {.comment = '#'}), soup_(file, 1), volumes_(file) {}

    MeshFile read() {
        expect("MeshVersionFormatted");
        next();
        if (const std::int64_t version = scan_.integer("a version"); version < 1 || version > 4) {
            fail("unknown version ", version);
        }
        expect("Dimension");
        next();
        if (scan_.integer("the dimension") != 3) {
            file_.fail_malformed(
                start_,
                "the mesh does not have three dimensions; export it with three coordinates");
        }
        while (scan_.find_word()) {
            start_ = scan_.offset();
            const std::string_view keyword = scan_.word();
            if (keyword == "End") return finish();
            read_list(keyword);
        }
        if (soup_.num_polygons() == 0 && volumes_.num_cells() == 0) {
            scan_.fail_malformed(
                "the file ends without 'End' and without a face; it is truncated: export it again");
        }
        MeshFile result = finish();
        add_warning(result, file_.place(scan_.offset()),
                    "the file ends without 'End'; its lists are complete, and are read");
        return result;
    }

private:
    template <typename... Parts>
    [[noreturn]] void fail(Parts... parts) const {
        file_.fail_damaged(start_, parts...);
    }

    // Goes to the next word, on whatever line.
    void next() {
        if (!scan_.find_word()) {
            scan_.fail_malformed("the file ends too early; it is truncated: export the file again");
        }
        start_ = scan_.offset();
    }

    void expect(std::string_view keyword) {
        next();
        const std::string_view word = scan_.word();
        if (word == keyword) return;
        file_.fail_malformed(start_, "expected '", keyword, "', found ", in_quotes(word),
                             "; check that the file is a Medit mesh (.mesh, not .meshb)");
    }

    std::int64_t integer(const char* what) {
        next();
        return scan_.integer(what);
    }

    void read_list(std::string_view keyword) {
        const auto* const list = std::ranges::find(medit_lists, keyword, &MeditList::keyword);
        if (list == std::end(medit_lists)) {
            file_.fail_malformed(
                start_, "unknown keyword ", in_quotes(keyword),
                "; save the file with vertices, triangles and quadrilaterals only");
        }
        next();
        const std::uint64_t count = scan_.count("the number of elements");
        if (list->kind == MeditList::Kind::PassedOver && keyword.starts_with("Required") &&
            count > 0) {
            warnings_.push_back(std::string(keyword) + " are skipped");
        }
        for (std::uint64_t i = 0; i < count; ++i) {
            soup_.ticker.tick(2);
            read_element(*list);
        }
    }

    void read_element(const MeditList& list) {
        switch (list.kind) {
            case MeditList::Kind::Vertices:
                return read_vertex();
            case MeditList::Kind::Faces:
                for (std::size_t k = 0; k < list.size; ++k) soup_.add_corner(corner(), start_);
                soup_.end_polygon();
                return read_ref(face_refs_);
            case MeditList::Kind::Volumes:
                for (std::size_t k = 0; k < list.size; ++k) volumes_.add_corner(corner(), start_);
                volumes_.end_cell(list.cell);
                return read_ref(volume_refs_);
            case MeditList::Kind::Edges:
                edges_.push_back({integer("a number from 1"), integer("a vertex")});
                return skip(1);
            case MeditList::Kind::Ridges:
                integer("a number from 1");
                return;
            case MeditList::Kind::RequiredEdges:
                return required_edges_.push_back(integer("a number from 1"));
            case MeditList::Kind::RequiredVertices:
                return required_vertices_.push_back(integer("a number from 1"));
            case MeditList::Kind::PassedOver:
                return skip(list.size);
        }
    }

    void read_vertex() {
        Vec3 p;
        for (int k = 0; k < 3; ++k) {
            next();
            p[k] = scan_.number("a coordinate");
            if (!std::isfinite(p[k])) {
                file_.fail_unusable(start_,
                                    "a coordinate is not finite; correct or delete the vertex");
            }
        }
        soup_.positions.push_back(p);
        read_ref(vertex_refs_);
    }

    // From 0.
    std::int64_t corner() {
        const std::int64_t vertex = integer("a corner");
        if (vertex != 0) return vertex - 1;
        file_.fail_unusable(start_,
                            "a face or cell names vertex 0, but Medit counts vertices from 1; "
                            "correct it, or export the file again");
    }

    void read_ref(std::vector<double>& refs) {
        const std::int64_t ref = integer("a reference");
        if (ref < INT32_MIN || ref > INT32_MAX) {
            file_.fail_malformed(start_,
                                 "a reference has more than 32 bits; renumber the references");
        }
        if (file_.with_attributes) refs.push_back(static_cast<double>(ref));
    }

    void skip(std::size_t count) {
        for (; count > 0; --count) {
            next();
            static_cast<void>(scan_.number("a number"));
        }
    }

    // References that are all 0 say nothing.
    static void add(std::vector<double> refs, std::vector<Attribute>& attributes) {
        if (std::ranges::count(refs, 0) == std::ssize(refs)) return;
        attributes.push_back(
            {.name = ref_name, .type = NumberType::Int32, .values = std::move(refs)});
    }

    // Edges that no face has, and vertices that are in none, are left out. So are edges that are
    // all those of the mesh: these say nothing.
    void finish_kept(MeshFile& result) {
        std::size_t num_missing = 0;
        const std::vector<Edge> all = edges_.empty() ? std::vector<Edge>() : edges_of(result.mesh);
        const auto add = [&](std::int64_t number, std::vector<Edge>& edges) {
            Edge edge{no_index, no_index};
            if (number >= 1 && number <= static_cast<std::int64_t>(edges_.size())) {
                const auto [a, b] = edges_[static_cast<std::size_t>(number - 1)];
                if (std::min(a, b) >= 1 && std::max(a, b) < no_index) {
                    edge = in_order(static_cast<Index>(a - 1), static_cast<Index>(b - 1));
                }
            }
            if (std::binary_search(all.begin(), all.end(), edge)) {
                edges.push_back(edge);
            } else {
                ++num_missing;
            }
        };
        for (std::size_t i = 1; i <= edges_.size(); ++i) {
            add(static_cast<std::int64_t>(i), result.feature_edges);
        }
        for (const std::int64_t number : required_edges_) add(number, result.locked_edges);
        const std::set<std::int64_t> wanted(required_vertices_.begin(), required_vertices_.end());
        std::set<Index> locked;
        for (const Triangle& t : result.mesh.triangles) {
            for (const Index v : t) {
                if (wanted.contains(v + std::int64_t{1})) locked.insert(v);
            }
        }
        num_missing += wanted.size() - locked.size();
        result.locked.assign(locked.begin(), locked.end());
        if (num_missing > 0) {
            warnings_.push_back(std::to_string(num_missing) +
                                " edges, corners or required vertices that are in no face are "
                                "skipped");
        }
        if (!all.empty() && result.feature_edges.size() >= all.size()) {
            warnings_.emplace_back("its edges are those of all faces, so none is a feature edge");
            result.feature_edges.clear();
        }
    }

    MeshFile finish() {
        const std::vector<std::size_t> cell_of_face = volumes_.add_to(soup_);
        if (file_.with_attributes) {
            for (const std::size_t cell : cell_of_face) face_refs_.push_back(volume_refs_[cell]);
        }
        MeshFile result = std::move(soup_).finish();
        MeshAttributes attributes;
        add(std::move(vertex_refs_), attributes.of_vertices);
        add(std::move(face_refs_), attributes.of_faces);
        attach(std::move(attributes), result);
        add_warning(result, volumes_.warning(cell_of_face.size()));
        finish_kept(result);
        for (const std::string& warning : warnings_) {
            add_warning(result, file_.path.string(), ": ", warning);
        }
        return result;
    }

    const SourceFile& file_;
    TextScanner scan_;
    PolygonSoup soup_;
    VolumeSurface volumes_;
    std::size_t start_ = 0;  // Of the word that is being read.
    std::vector<double> vertex_refs_, face_refs_, volume_refs_;
    // What is to be kept, with the file's numbers from 1.
    std::vector<std::array<std::int64_t, 2>> edges_;
    std::vector<std::int64_t> required_edges_, required_vertices_;
    std::vector<std::string> warnings_;
};

std::int64_t reference(const Attribute* refs, std::size_t element) {
    if (refs == nullptr || !is_value_of(NumberType::Int32, refs->values[element])) return 0;
    return static_cast<std::int64_t>(refs->values[element]);
}

}  // namespace

// NOLINTNEXTLINE(performance-unnecessary-value-param): all readers have this type.
MeshFile read_medit(SourceFile file) { return MeditReader(file).read(); }

bool medit_holds(const Attribute& attribute, ElementKind kind, const MeshAttributes& all) {
    const Attribute* const refs =
        labels_to_write(kind == ElementKind::Vertex ? all.of_vertices : all.of_faces, ref_name);
    return refs != nullptr && refs->name == attribute.name;
}

std::string format_medit(const MeshView& mesh, const MeshAttributes& attributes, Ticker ticker) {
    const Attribute* const vertex_refs = labels_to_write(attributes.of_vertices, ref_name);
    const Attribute* const face_refs = labels_to_write(attributes.of_faces, ref_name);
    std::string bytes = "MeshVersionFormatted 2\nDimension 3\nVertices\n" +
                        std::to_string(mesh.positions.size()) + '\n';
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        ticker.tick(4);
        append_line(bytes, "", mesh.positions[v]);
        append_to_line(bytes, std::array{reference(vertex_refs, v)});
    }
    bytes += "Triangles\n" + std::to_string(mesh.triangles.size()) + '\n';
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        ticker.tick(2);
        const auto& [a, b, c] = mesh.triangles[f];
        append_line(
            bytes, "",
            std::array<std::int64_t, 4>{a + 1ll, b + 1ll, c + 1ll, reference(face_refs, f)});
    }
    return bytes + "End\n";
}

}  // namespace remesh
