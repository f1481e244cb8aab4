//! \file
//! The head of a PLY file and the values of its elements, in any encoding. Private to the readers.
//! AsciiValues and BinaryValues have the same interface (begin an element, take its values, end
//! it), so that the readers of elements are templates.
#pragma once

#include "remesh/meshfile/numbers.h"
#include "remesh/meshfile/text_scanner.h"

namespace remesh {

using PlyType = NumberType;

struct PlyProperty {
    std::string name;
    PlyType type;
    std::optional<PlyType> size_type = {};  //!< Of a list: the type of its length, an integer one.
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;  //!< As announced; not reliable before the bytes are read.
    std::vector<PlyProperty> properties;

    //! The property of that name, or nullptr.
    [[nodiscard]] const PlyProperty* find(std::string_view property) const;
};

//! The name of a type in a header.
[[nodiscard]] const char* name_of(PlyType type);

struct PlyHeader {
    std::optional<std::endian> byte_order;  //!< None: ascii.
    std::vector<PlyElement> elements = {};  //!< In the order of the data.
    std::size_t size = 0;                   //!< Bytes up to the first datum.
    std::string warning = {};               //!< Lines that were skipped, leniently.
};

//! \throw IoError  by line: no PLY, an unknown type or format, an element without a name, ...
[[nodiscard]] PlyHeader read_ply_header(const SourceFile& file);

//! The mesh of binary data behind a head; binary OFF has the same layout.
//! \throw IoError, InvalidInput  as read_mesh.  \throw Cancelled
[[nodiscard]] MeshFile read_binary_ply(const PlyHeader& header, const SourceFile& file);

[[nodiscard]] inline std::string name_of(const PlyElement& element, std::uint64_t index) {
    return element.name + " " + std::to_string(index) + " of " + std::to_string(element.count);
}

//! The values of an ascii file.
class AsciiValues {
public:
    AsciiValues(const SourceFile& file, const PlyHeader& header)
        : file_(file), scan_(file, header.size, {}) {}

    void begin(const PlyElement& element, std::uint64_t index) {
        if (scan_.find_word()) return;
        scan_.fail_malformed("the file ends before ", name_of(element, index),
                             "; it is truncated: export the file again");
    }
    double real(PlyType) { return scan_.number("a number"); }
    //! The value; nothing if the word is no value of the type.
    std::optional<double> attribute(PlyType type) {
        if (!scan_.has_word()) scan_.fail_expecting("a number");
        const std::optional<double> value = as_number(scan_.rest_of_word());
        return value && is_value_of(type, *value) ? value : std::nullopt;
    }
    std::int64_t integer(PlyType) { return scan_.integer("a whole number"); }
    void skip(PlyType, std::int64_t count) {
        for (; count > 0; --count) {
            if (scan_.word().empty()) scan_.fail_expecting("a number");
        }
    }
    void end() {
        if (!scan_.has_word()) return;
        if (!file_.is_lenient) {
            scan_.fail_malformed(
                "the line has more values than the header announces; write one element on each "
                "line, or pass over the others (remesh and agvd diagram: --lenient)");
        }
        if (num_longer_++ == 0) first_longer_ = scan_.offset();
        scan_.skip_line();
    }
    [[nodiscard]] std::size_t offset() const { return scan_.offset(); }
    //! What was skipped; empty: nothing.
    [[nodiscard]] std::string warning() const {
        if (num_longer_ == 0) return {};
        return file_.place(first_longer_) + std::to_string(num_longer_) +
               " lines have more values than the header announces; these are skipped";
    }

private:
    const SourceFile& file_;
    TextScanner scan_;
    std::size_t num_longer_ = 0, first_longer_ = 0;  // Lines, and where one goes on.
};

//! The values of a binary file.
class BinaryValues {
public:
    BinaryValues(const SourceFile& file, const PlyHeader& header)
        : file_(file), at_(header.size), order_(*header.byte_order) {}

    void begin(const PlyElement& element, std::uint64_t index) {
        element_ = &element;
        index_ = index;
    }
    double real(PlyType type) { return next<double>(type); }
    std::optional<double> attribute(PlyType type) { return next<double>(type); }
    std::int64_t integer(PlyType type) { return next<std::int64_t>(type); }
    void skip(PlyType type, std::int64_t count) {
        // A length has 32 bits at most: the product cannot overflow.
        take(size_of(type) * static_cast<std::size_t>(count));
    }
    void end() {}
    [[nodiscard]] std::size_t offset() const { return at_; }
    [[nodiscard]] static std::string warning() { return {}; }

private:
    const char* take(std::size_t size) {
        if (file_.bytes.size() - at_ < size) {
            file_.fail_malformed(file_.bytes.size(), "the file ends within ",
                                 name_of(*element_, index_),
                                 "; it is truncated: export the file again");
        }
        at_ += size;
        return file_.bytes.data() + at_ - size;
    }

    template <typename Result>
    Result next(PlyType type) {
        return with_type(type, [&]<typename Stored>(Stored) {
            return static_cast<Result>(load<Stored>(take(sizeof(Stored)), order_));
        });
    }

    const SourceFile& file_;
    std::size_t at_;
    std::endian order_;
    const PlyElement* element_ = nullptr;
    std::uint64_t index_ = 0;
};

template <typename Values>
std::int64_t read_length(Values& values, const PlyProperty& list, const SourceFile& file) {
    const std::size_t start = values.offset();
    const std::int64_t length = values.integer(*list.size_type);
    if (length < 0) file.fail_damaged(start, "a list has a negative length");
    return length;
}

template <typename Values>
void skip_property(Values& values, const PlyProperty& property, const SourceFile& file) {
    values.skip(property.type, property.size_type ? read_length(values, property, file) : 1);
}

//! The list of vertices of a face or of strips.
//! \throw IoError  there is none, or its numbers are not whole.
[[nodiscard]] inline const PlyProperty& require_corners(const PlyElement& element,
                                                        const SourceFile& file) {
    const PlyProperty* corners = element.find("vertex_indices");
    if (corners == nullptr) corners = element.find("vertex_index");
    if (corners == nullptr || !corners->size_type || !is_integer(corners->type)) {
        file.fail_damaged(0, "element ", element.name,
                          " lacks a list of whole numbers named vertex_indices");
    }
    return *corners;
}

//! Passes over a whole element.
//! \param index  which one, for errors.
template <typename Values>
void skip_element(Values& values, const PlyElement& element, std::uint64_t index,
                  const SourceFile& file) {
    values.begin(element, index);
    for (const PlyProperty& property : element.properties) skip_property(values, property, file);
    values.end();
}

}  // namespace remesh
