//! \file
//! Options of `remesh` and `remesh-eval` for people: a page and a picture of original and result.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli.h"
#include "page/page.h"
#include "remesh/meshfile/atomic_file.h"

namespace cli {

struct PageArguments {
    std::filesystem::path html;     //!< Empty: none.
    std::filesystem::path picture;  //!< Empty: none.
    std::string command;            //!< The command line: see page::to_shell.
};

//! Adds --html and --picture. \param arguments  outlives `app`.
void add_page_options(CLI::App& app, PageArguments& arguments);

//! Whether the original is needed after the result is made.
[[nodiscard]] bool wants_pages(const PageArguments& arguments);

//! \param option  such as "--html".
//! \throw agvd::InvalidOption  the file would be the standard output.
void check_page_option(const char* option, const std::filesystem::path& path);

//! Call before the long work.
//! \throw agvd::InvalidOption  this build cannot make what is asked for, or it would go to the
//!        standard output.
void check_page_options(const PageArguments& arguments);

//! The first property of faces that holds labels, as one number each. Empty: there is none.
[[nodiscard]] page::FaceLabels labels_for_page(const remesh::MeshAttributes& attributes);

//! Red, green and blue of the vertices, from 0 to 255. Empty: they have no colours.
[[nodiscard]] std::vector<page::VertexValues> colors_for_page(
    const remesh::MeshAttributes& attributes);

//! The files that are asked for.
//! \param page  without version and command, which are added.
//! \throw agvd::Cancelled  the progress callback returned false.
[[nodiscard]] std::vector<remesh::FileContent> make_pages(const PageArguments& arguments,
                                                          page::Page page,
                                                          const agvd::Progress& progress);

}  // namespace cli
