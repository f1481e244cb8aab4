//! \file
//! Reads XML tag by tag, so that memory does not grow with the text. Private to the readers.
//! Without expat (AGVD_WITH_EXPAT=OFF) XML is refused.
#pragma once

#include <optional>
#include <vector>

#include "remesh/meshfile/source_file.h"

namespace remesh {

struct XmlAttribute {
    std::string_view space;  //!< The URI of its namespace; mostly empty.
    std::string_view name, value;
};

//! The begin of an element. The views live as long as the call that gets it.
struct XmlTag {
    std::string_view space;  //!< The URI of its namespace; empty: none.
    std::string_view name;   //!< Without a prefix.
    std::vector<XmlAttribute> attributes;
    std::size_t depth = 0;           //!< How many elements it is in.
    std::size_t begin = 0, end = 0;  //!< Its place in the text: its '<', behind its '>'.

    [[nodiscard]] std::optional<std::string_view> find(std::string_view attribute,
                                                       std::string_view namespace_uri = {}) const {
        for (const XmlAttribute& one : attributes) {
            if (one.name == attribute && one.space == namespace_uri) return one.value;
        }
        return std::nullopt;
    }
};

//! Gets the tags of a text in order. What it throws ends the reading.
class XmlVisitor {
public:
    //! \return false: the rest of the text is not read.
    virtual bool begin(const XmlTag& tag) = 0;
    //! The end of the element that began last and has not ended.
    //! \param at, behind  of its closing tag; both the end of an empty element's only tag.
    virtual void end(std::size_t /*depth*/, std::size_t /*at*/, std::size_t /*behind*/) {}
    //! A prefix of a namespace, before the tag that declares it.
    virtual void declare(std::string_view /*prefix*/, std::string_view /*uri*/) {}

protected:
    ~XmlVisitor() = default;
};

//! Whether this build reads XML.
[[nodiscard]] bool knows_xml();

//! Text between tags is checked and skipped: it stands in the file's bytes.
//! \throw IoError  the text is not well-formed, has a document type (entities may be huge), a
//!        tag of megabytes, or this build cannot read XML.
//! \throw Cancelled  as the ticker of the file says.
void read_xml(const SourceFile& file, XmlVisitor& visitor);

}  // namespace remesh
