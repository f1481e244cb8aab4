#include "remesh/meshfile/msh_values.h"

namespace remesh {
namespace {

// What stands in front of the values.
struct ValuesHead {
    std::string name;
    std::size_t num_components = 1;
    std::uint64_t count = 0;  // Of elements.
};

ValuesHead read_head(MshScanner& scan) {
    ValuesHead head;
    const std::uint64_t num_texts = scan.text_count("the number of names");
    for (std::uint64_t i = 0; i < num_texts; ++i) {
        std::string text = scan.quoted_name();
        if (i == 0) head.name = std::move(text);  // The next one is a scheme of interpolation.
    }
    for (std::uint64_t left = scan.text_count("the number of reals"); left > 0; --left) {
        scan.text_real("a real");  // Such as a time.
    }
    const std::uint64_t num_integers = scan.text_count("the number of integers");
    if (num_integers < 3) scan.fail("values have fewer than three integers");
    scan.text_integer("a time step");
    const std::uint64_t components = scan.text_count("the number of components");
    if (components < 1 || components > most_vtk_components) {
        scan.fail("values of ", components, " components are not supported");
    }
    head.num_components = static_cast<std::size_t>(components);
    head.count = scan.text_count("the number of values");
    for (std::uint64_t left = num_integers - 3; left > 0; --left) scan.text_integer("an integer");
    scan.begin_numbers();
    return head;
}

}  // namespace

void MshValues::read(MshScanner& scan, const MshTags& elements, Ticker& ticker) {
    const ValuesHead head = read_head(scan);
    const std::size_t offset = scan.start();
    std::vector<std::size_t> places;  // Of the values, which are in the order of the section.
    std::vector<double> values;
    for (std::uint64_t i = 0; i < head.count; ++i) {
        const std::int64_t tag = scan.integer("the number of a node or an element");
        const auto place = elements.find(static_cast<std::uint64_t>(tag));
        if (place) places.push_back(*place);
        for (std::size_t k = 0; k < head.num_components; ++k) {
            ticker.tick();
            const double value = scan.real("a value");
            if (place) values.push_back(value);
        }
    }
    std::vector<bool> is_given(elements.size());
    for (const std::size_t place : places) is_given[place] = true;
    if (std::ranges::find(is_given, false) != is_given.end()) {
        const bool is_vertex = kind_ == ElementKind::Vertex;
        declined_.push_back(
            {(is_vertex ? "vertex " : "face ") + head.name,
             is_vertex ? "not all nodes have a value" : "not all faces have a value"});
        return;
    }
    VtkArray& array = arrays_.emplace_back(VtkArray{.name = head.name,
                                                    .type = &vtk_type_of(NumberType::Float64),
                                                    .num_components = head.num_components,
                                                    .offset = offset});
    array.values.resize(elements.size() * head.num_components);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t place = places[i / head.num_components];
        array.values[place * head.num_components + i % head.num_components] = values[i];
    }
}

void MshValues::add_to(MeshAttributes& attributes, std::size_t num_elements,
                       const SourceFile& file) const {
    for (const VtkArray& array : arrays_) {
        add_array(array, kind_, num_elements, file, attributes);
    }
    attributes.declined.insert(attributes.declined.end(), declined_.begin(), declined_.end());
}

}  // namespace remesh
