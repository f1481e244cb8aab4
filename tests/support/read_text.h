//! \file
//! Reads a mesh out of a string, for tests of the readers.
#pragma once

#include <gtest/gtest.h>

#include "agvd/core/error.h"
#include "remesh/meshfile/formats.h"

namespace texts {

//! The result of read_mesh for a file `name` with these bytes; in memory, as disks are slow.
[[nodiscard]] inline remesh::MeshFile read_bytes(const std::string& name, const std::string& bytes,
                                                 bool with_attributes = false) {
    return remesh::require_format({name}).read(
        {.path = name, .bytes = bytes, .with_attributes = with_attributes});
}

//! Expects an error of type E that names the file and has all of `words` in its text.
template <typename E>
void expect_error(const std::string& name, const std::string& bytes,
                  const std::vector<std::string>& words, bool with_attributes = false) {
    try {
        static_cast<void>(read_bytes(name, bytes, with_attributes));
        ADD_FAILURE() << "read without complaint:\n" << bytes.substr(0, 200);
    } catch (const E& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find(name), std::string::npos) << text;
        EXPECT_NE(text.find(';'), std::string::npos) << "no remedy: " << text;
        for (const std::string& word : words) {
            EXPECT_NE(text.find(word), std::string::npos)
                << '"' << word << "\" is not in: " << text;
        }
    } catch (const std::exception& error) {
        ADD_FAILURE() << "another type of error: " << error.what();
    }
}

}  // namespace texts
