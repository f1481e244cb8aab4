//! \file
//! The two chunks of a binary glTF file, and the arrays in them. Private to the reader.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "remesh/io/source_file.h"

namespace remesh {

//! Rows of an array of glTF, which lie in the file.
struct GlbArray {
    std::uint64_t num_rows = 0;
    std::size_t num_columns = 0;
    bool is_normalized = false;  //!< Integers stand for numbers up to 1.
    std::int64_t component_type = 0;
    std::size_t offset = 0;  //!< Of the first row, in the file.
    std::size_t stride = 0;  //!< From row to row, in bytes.
};

//! Reads members of JSON with errors that name the file. Every index and length is checked before
//! it is used.
class GlbContainer {
public:
    //! \param file  outlives this.
    //! \throw agvd::IoError  no binary glTF 2.0, truncated, not JSON, needs an unknown extension.
    explicit GlbContainer(SourceFile& file);

    [[nodiscard]] const nlohmann::json& root() const { return json_; }

    //! Element `index` of the root's list, an object.
    [[nodiscard]] const nlohmann::json& at(const char* list, std::uint64_t index) const;
    //! The member, a list; an empty one if it is missing.
    [[nodiscard]] const nlohmann::json& list(const nlohmann::json& object, const char* key) const;
    //! The member, a whole number from 0; nothing if it is missing.
    [[nodiscard]] std::optional<std::uint64_t> number(const nlohmann::json& object,
                                                      const char* key) const;
    //! The member, a list of `count` finite numbers; nothing if it is missing.
    [[nodiscard]] std::optional<std::vector<double>> numbers(const nlohmann::json& object,
                                                             const char* key,
                                                             std::size_t count) const;

    //! An accessor whose rows all lie in the file.
    [[nodiscard]] GlbArray array(std::uint64_t accessor) const;
    //! A number of it; with is_normalized from -1 to 1.
    [[nodiscard]] double value(const GlbArray& array, std::uint64_t row, std::size_t column) const;

    [[noreturn]] void fail(const std::string& text) const;

private:
    SourceFile& file_;
    nlohmann::json json_;
    std::size_t bin_begin_ = 0, bin_size_ = 0;
};

}  // namespace remesh
