// The border of the module: JavaScript writes a request into its memory, calls, and reads the
// answer. Errors become answers, in the terms of JavaScript's callers.
#include <cstdlib>
#include <exception>
#include <new>
#include <optional>

#include "agvd/core/error.h"
#include "calls.h"
#include "javascript_terms.h"

namespace npm {
namespace {

struct Call {
    const char* name;
    Answer (*run)(const Request&);
};

constexpr Call calls[] = {{"remesh", call_remesh},       {"voronoi", call_voronoi},
                          {"distances", call_distances}, {"creases", call_creases},
                          {"read", call_read},           {"write", call_write}};

Answer answer_to(const Request& request) {
    const std::string name = request.json()["call"];
    for (const Call& call : calls) {
        if (name == call.name) return call.run(request);
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
