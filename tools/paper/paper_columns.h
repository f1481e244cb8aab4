//! \file
//! The columns of the paper's evaluation, and tables with all methods of a case in one row.
#pragma once

#include <span>

#include "bench/report.h"

namespace bench::paper {

[[nodiscard]] std::vector<Column> case_columns();   //!< Mesh, faces, sites, method.
[[nodiscard]] std::vector<Column> cost_columns();   //!< Time and memory.
[[nodiscard]] std::vector<Column> ratio_columns();  //!< Both over those of exact windows.
[[nodiscard]] std::vector<Column> error_columns();
[[nodiscard]] std::vector<Column> label_columns();  //!< Errors of labels, by CGAL.
[[nodiscard]] std::vector<Column> code_columns();   //!< Of other codes: how far from ours.

[[nodiscard]] std::vector<Column> join(std::initializer_list<std::vector<Column>> parts);

//! Adds to each row of one case time_over_exact and memory_over_exact: over the row "window exact".
//! \pre there is one.
void add_ratios(std::span<nlohmann::ordered_json> rows);

//! The rows as a Markdown table, all methods of a case in one of its rows.
//!
//! \param same   what tells the cases apart; columns of their own.
//! \param by     a column for each of these and each method; none where it is 0 throughout.
[[nodiscard]] std::string methods_side_by_side(const std::vector<Column>& same,
                                               const std::vector<Column>& by,
                                               const nlohmann::ordered_json& rows);

}  // namespace bench::paper
