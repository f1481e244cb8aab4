// The border of the module: JavaScript writes a request into its memory, calls, and reads the
// answer. Errors become answers, in the terms of JavaScript's callers.
#include <cstdlib>
#include <exception>
#include <new>
#include <optional>

#include "agvd/core/error.h"
#include "calls.h"
#include "terms.h"

namespace npm {
namespace {

struct Call {
    const char* name;
    Answer (*run)(const Request&);
};

constexpr Call calls[] = {{"remesh", call_remesh},
                          {"voronoi", call_voronoi},
                          {"distances", call_distances},
                          {"read", call_read},
                          {"write", call_write}};

// What differs by more than the style of names; longer ones first.
constexpr cli::Term terms[] = {
    {"(remesh and agvd diagram: --lenient)", "(lenient: true)"},
    {"(remesh: --from for an input, --to for the output)", "(format)"},
    {"more or fewer --samples", "another n"},
    {"more --samples", "a larger n"},
    {"fewer --samples", "a smaller n"},
    {"--samples", "n"},
    {"--boundary free", "boundary: 'free'"},
    {"--relax 0", "relax: 0"},
    {"--delaunay extrinsic", "delaunay: 'extrinsic'"},
    {"--delaunay off", "delaunay: 'off'"},
    {"--keep-labels", "faceLabels"},
    {"num_samples", "n"},
    {"num_faces", "faces"},
    {"is_adaptive", "adaptive"},
    {"target_lengths", "sizing"},
    {"face_lengths", "faceSizing"},
    {"densities", "density"},
    {"relax_steps", "relax"},
    {"feature_angle", "features"},
    {"feature_edges", "featureEdges"},
    {"face_labels", "faceLabels"},
    {"texture_seams", "uv"},
    {"max_error", "maxError"},
    {"steiner_points", "steinerPoints"},
    {"drop_components", "dropComponents"},
    {"fill_holes", "fillHoles"},
    {"lock_boundary", "lockBoundary"},
    {"min_edge", "minEdge"},
    {"max_edge", "maxEdge"},
};

std::string in_terms_of_javascript(const std::string& text) {
    return cli::in_terms(text, terms, cli::NameStyle::Camel);
}

void translate_warnings(Json& warnings) {
    for (Json& text : warnings) text = in_terms_of_javascript(text.get<std::string>());
}

Answer answer_to(const Request& request) {
    const std::string name = request.json()["call"];
    for (const Call& call : calls) {
        if (name != call.name) continue;
        Answer answer = call.run(request);
        if (answer.json.contains("warnings")) translate_warnings(answer.json["warnings"]);
        if (answer.json.contains("report")) translate_warnings(answer.json["report"]["warnings"]);
        return answer;
    }
    throw std::logic_error("there is no function " + name);
}

Answer failed(const char* name, const std::string& text) {
    Answer answer;
    answer.json["error"] = {{"name", name}, {"message", in_terms_of_javascript(text)}};
    return answer;
}

Answer run(std::string_view text) {
    try {
        return answer_to(Request(text));
    } catch (const agvd::InvalidOption& error) {
        return failed("InvalidOption", error.what());
    } catch (const agvd::InvalidSites& error) {
        return failed("InvalidSites", error.what());
    } catch (const agvd::InvalidInput& error) {
        return failed("InvalidInput", error.what());
    } catch (const agvd::ConstraintUnmet& error) {
        return failed("ConstraintUnmet", error.what());
    } catch (const agvd::Cancelled& error) {
        return failed("Cancelled", error.what());
    } catch (const agvd::IoError& error) {
        return failed("FileError", error.what());
    } catch (const std::bad_alloc&) {
        return failed("OutOfMemory",
                      "not enough memory: the module has 4 GB at most, and the page or the system "
                      "may give less; use fewer --samples or a coarser input");
    } catch (const std::exception& error) {
        return failed("Error", error.what());
    }
}

// Of the last call, until the next one or forget().
struct Kept {
    Answer answer;
    std::string text;
};
std::optional<Kept>& kept() {
    static std::optional<Kept> last;
    return last;
}

}  // namespace
}  // namespace npm

extern "C" {

//! Memory for a request or one of its arrays; nullptr: there is none.
__attribute__((export_name("allocate"))) void* remesh_allocate(std::size_t size) {
    return std::malloc(size);
}

__attribute__((export_name("release"))) void remesh_release(void* memory) { std::free(memory); }

//! \return the number of bytes of the answer's text.
__attribute__((export_name("call"))) std::size_t remesh_call(const char* text, std::size_t length) {
    npm::Answer answer = npm::run({text, length});
    std::string of_answer = answer.text();
    npm::kept() = {std::move(answer), std::move(of_answer)};
    return npm::kept()->text.size();
}

//! Where the answer's text is.
__attribute__((export_name("answer"))) const char* remesh_answer() {
    return npm::kept()->text.data();
}

//! Frees the answer.
__attribute__((export_name("forget"))) void remesh_forget() { npm::kept().reset(); }

}  // extern "C"
