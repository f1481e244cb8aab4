//! \file
//! Decodes the arrays of an XML file of VTK. Private to the reader of .vtp.
#pragma once

#include <cstdint>
#include <optional>

#include "remesh/meshfile/byte_source.h"
#include "remesh/meshfile/vtk_data.h"
#include "remesh/meshfile/vtk_xml.h"

namespace remesh {

class VtkXmlArrays {
public:
    //! Both outlive this.
    VtkXmlArrays(const SourceFile& file, const VtkXmlFile& xml)
        : file_(file), xml_(xml), ticker_(file.ticker) {}

    //! The numbers of an array. Memory follows the bytes that are there.
    //! \throw IoError  truncated, damaged, of an unknown type or encoding.
    //! \throw Cancelled
    [[nodiscard]] VtkArray read(const VtkXmlArray& array);

    //! A count that an attribute gives; nothing if it is empty.
    //! \throw IoError  it is no whole number.
    [[nodiscard]] std::optional<std::uint64_t> count(const std::string& text, const char* what,
                                                     std::size_t offset) const;

    //! Throws IoError that names the array. The remedy is added.
    [[noreturn]] void fail(const VtkXmlArray& array, const std::string& text) const;

    Ticker& ticker() { return ticker_; }

private:
    void read_text(const VtkXmlArray& array, VtkArray& result);
    void read_bytes(const VtkXmlArray& array, ByteSource source, VtkArray& result);
    [[nodiscard]] ByteSource appended(const VtkXmlArray& array) const;
    std::string unpack(const VtkXmlArray& array, ByteSource& source, std::uint64_t num_blocks);
    std::uint64_t take_count(const VtkXmlArray& array, ByteSource& source);

    const SourceFile& file_;
    const VtkXmlFile& xml_;
    Ticker ticker_;
    std::string buffer_;
};

}  // namespace remesh
