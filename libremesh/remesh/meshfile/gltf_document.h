//! \file
//! A glTF file, binary or JSON, and the arrays in its buffers. Private to the reader.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "remesh/meshfile/mesh_file.h"
#include "remesh/meshfile/source_file.h"

namespace remesh {

//! Rows of an array of glTF, which lie in the document's bytes.
struct GltfArray {
    std::uint64_t num_rows = 0;
    std::size_t num_columns = 0;
    NumberType type = NumberType::Float32;
    double largest = 0;      //!< Integer that stands for 1; 0: numbers stand for themselves.
    std::size_t offset = 0;  //!< Of the first row, in the document's bytes.
    std::size_t stride = 0;  //!< From row to row, in bytes.
};

//! Reads members of JSON with errors that name the file. Every index and length is checked before
//! it is used.
class GltfDocument {
public:
    //! \param file  outlives this; gets the bytes of the buffers that it names behind its own.
    //! \throw IoError  no glTF 2.0, truncated, not JSON, needs an unknown extension or a
    //!        buffer that cannot be read.
    explicit GltfDocument(SourceFile& file);

    [[nodiscard]] const nlohmann::json& root() const { return json_; }

    //! Element `index` of the root's list, an object.
    [[nodiscard]] const nlohmann::json& at(const char* list, std::uint64_t index) const;
    //! The member; null if it is missing, or if this is no object.
    [[nodiscard]] static const nlohmann::json& member(const nlohmann::json& object,
                                                      const char* key);
    //! The member, a text; empty if it is none.
    [[nodiscard]] static std::string text(const nlohmann::json& object, const char* key);
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
    [[nodiscard]] GltfArray array(std::uint64_t accessor) const;
    //! A number of it.
    [[nodiscard]] double value(const GltfArray& array, std::uint64_t row, std::size_t column) const;

    //! What a row's errors name: its place in the file, or the file's begin if it lies elsewhere.
    [[nodiscard]] std::size_t place(const GltfArray& array, std::uint64_t row) const;

    //! The bytes of an image.
    //! \throw IoError  they lie in a file that cannot be read.
    [[nodiscard]] std::string image(const nlohmann::json& properties) const;

    template <typename... Parts>
    [[noreturn]] void fail(Parts... parts) const {
        file_.fail_damaged(text_.begin, parts...);
    }

private:
    struct Range {
        std::size_t begin = 0, size = 0;
    };
    void read_chunks();
    void read_buffers();
    [[nodiscard]] Range range_of_view(const nlohmann::json& view, const std::string& name) const;
    //! What a URI stands for: base64 in it, or a file beside this one.
    [[nodiscard]] std::string resource(const std::string& uri) const;

    SourceFile& file_;
    std::size_t file_size_;
    Range text_;  // The JSON.
    nlohmann::json json_;
    Range bin_;                   // Of the chunk, of a binary file.
    std::vector<Range> buffers_;  // In the document's bytes.
};

}  // namespace remesh
