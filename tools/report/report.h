//! \file
//! Results as JSON for programs and as text for people.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "paper/compare_diagrams.h"
#include "remesh/meshfile/mesh_file.h"
#include "remesh/pipeline/remesh.h"
#include "remesh/quality/evaluate.h"

namespace remesh {

//! What became of the attributes of the input file.
struct AttributeReport {
    std::vector<std::string> carried = {};         //!< "vertex red", "face material", ...
    std::vector<DeclinedAttribute> declined = {};  //!< The file has them, the result does not.
    std::string map_path = {};                     //!< Of the map to the input; empty: none.
};

//! What the caller of remesh() knows about a run.
struct RunInfo {
    std::string version = {};                //!< Of the program.
    std::string input_path = {};             //!< Empty: not a file.
    std::string output_path = {};            //!< Empty: not a file.
    RemeshOptions options = {};              //!< As passed to remesh().
    AttributeReport attributes = {};         //!< What was carried over.
    std::optional<MeshFigures> output = {};  //!< Of the result (measure_figures), if measured.
    std::vector<std::string> warnings = {};  //!< All texts that the caller warned with.
};

//! Why a run has no result.
struct RunFailure {
    int exit_code = 0;       //!< 0: the run was not needed, and the mesh was skipped.
    std::string error = {};  //!< The text for people.
    std::string stage = {};  //!< The last one that began; empty: none.
};

//! What the caller of evaluate() knows about its meshes.
struct EvaluationInfo {
    std::string version = {};        //!< Of the program.
    std::string original_path = {};  //!< Empty: not a file.
    std::string result_path = {};    //!< Empty: not a file.
};

//! A diagram compared with another one or the exact one.
struct Comparison {
    Index sites = 0;                    //!< Of both diagrams.
    DiagramDifference difference = {};  //!< Between the two.
    //! Of either diagram against exact distances; none: not measured.
    std::optional<BisectorError> bisectors_a = {};
    std::optional<BisectorError> bisectors_b = {};  //!< See bisectors_a.
};

//! What the caller of compare_diagrams() knows about its diagrams.
struct ComparisonInfo {
    std::string version = {};  //!< Of the program.
    std::string a = {};        //!< Path.
    std::string b = {};        //!< Path, or "exact".
};

//! A JSON object over several lines. Keys are snake_case and always present; units are in the key
//! (_s, _bytes, _deg, _percent, _percent_of_diagonal). A number that is not finite and a value that
//! was not measured (e.g. without CGAL) are null; the self-intersecting pairs and the components
//! are listed in full.
//! docs/report.md lists all keys.
[[nodiscard]] std::string to_json(const RemeshResult& result, const RunInfo& info = {});
//! The report of a run without a result: the first keys of the above. Reads of `info` version,
//! paths and warnings.
[[nodiscard]] std::string to_json(const RunFailure& failure, const RunInfo& info = {});
//! The report of `remesh-eval`.
[[nodiscard]] std::string to_json(const Evaluation& evaluation, const EvaluationInfo& info = {});
//! The report of `agvd compare`.
[[nodiscard]] std::string to_json(const Comparison& comparison, const ComparisonInfo& info = {});

//! The same for people, several lines without a last line end, in words of any user.
[[nodiscard]] std::string to_text(const RemeshResult& result, const RunInfo& info = {});
//! More of it, for those who know the method; likewise without a last line end.
[[nodiscard]] std::string details_to_text(const RemeshResult& result, const RunInfo& info = {});
//! An evaluation for people, without a last line end.
[[nodiscard]] std::string to_text(const Evaluation& evaluation, const EvaluationInfo& info = {});
//! A comparison for people, without a last line end.
[[nodiscard]] std::string to_text(const Comparison& comparison, const ComparisonInfo& info = {});

//! One line on where distances come from, e.g. "distances: window engine, at most 0.0712 % above
//! exact".
//! \param certified_error  as in Propagation.
[[nodiscard]] std::string to_text(Engine engine, double certified_error);

//! One line, e.g. "repaired: 3 welded vertices, 1 duplicate face", or a statement that no repair
//! was needed.
[[nodiscard]] std::string to_text(const CleanCounts& counts);

}  // namespace remesh
