#include "remesh/meshfile/xml_reader.h"

#include <expat.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <new>

namespace remesh {
namespace {

constexpr std::size_t xml_chunk_size = 1 << 16;
// Of a tag or a comment. Each chunk that does not end it makes expat read it again.
constexpr std::size_t longest_token = 1 << 22;
constexpr char separator = '|';  // No name has it.

// Calls a visitor from within expat, through which no exception may pass: it is kept, and expat
// stops.
class ExpatReader {
public:
    ExpatReader(const SourceFile& file, XmlVisitor& visitor)
        : file_(file),
          visitor_(visitor),
          ticker_(file.ticker),
          parser_(::XML_ParserCreateNS(nullptr, separator), ::XML_ParserFree) {
        if (!parser_) throw std::bad_alloc();
        ::XML_SetUserData(parser_.get(), this);
        ::XML_SetElementHandler(parser_.get(), on_begin, on_end);
        ::XML_SetStartNamespaceDeclHandler(parser_.get(), on_declaration);
        ::XML_SetStartDoctypeDeclHandler(parser_.get(), on_document_type);
    }

    void read() {
        for (std::size_t offset = 0; offset < file_.bytes.size() && !is_done_;) {
            ticker_.poll();
            const std::size_t size = std::min(xml_chunk_size, file_.bytes.size() - offset);
            const bool is_last = offset + size == file_.bytes.size();
            const XML_Status status =
                ::XML_Parse(parser_.get(), file_.bytes.data() + offset, static_cast<int>(size),
                            is_last ? XML_TRUE : XML_FALSE);
            if (thrown_) std::rethrow_exception(thrown_);
            if (status == XML_STATUS_ERROR && !is_done_) fail();
            offset += size;
            if (!is_done_ && offset > place() + longest_token) {
                file_.fail_damaged(place(), "a tag is longer than ", longest_token, " bytes");
            }
        }
    }

private:
    [[noreturn]] void fail() const {
        switch (::XML_GetErrorCode(parser_.get())) {
            case XML_ERROR_NO_MEMORY:
                throw std::bad_alloc();
            case XML_ERROR_NO_ELEMENTS:
            case XML_ERROR_UNCLOSED_TOKEN:
            case XML_ERROR_PARTIAL_CHAR:
            case XML_ERROR_UNCLOSED_CDATA_SECTION:
                file_.fail_malformed(
                    file_.bytes.size(),
                    "the XML ends too early; the file is truncated: export it again");
            default:
                file_.fail_malformed(place(), "this is not well-formed XML (",
                                     ::XML_ErrorString(::XML_GetErrorCode(parser_.get())),
                                     "); check the file's extension, or export it again");
        }
    }

    // Of what is read now; of the first byte that is not read yet, between chunks.
    [[nodiscard]] std::size_t place() const {
        return static_cast<std::size_t>(
            std::max<XML_Index>(0, ::XML_GetCurrentByteIndex(parser_.get())));
    }
    [[nodiscard]] std::size_t place_behind() const {
        return place() + static_cast<std::size_t>(::XML_GetCurrentByteCount(parser_.get()));
    }

    template <typename Call>
    void guard(const Call& call) noexcept {
        if (thrown_ || is_done_) return;
        try {
            ticker_.tick(8);
            call();
        } catch (...) {
            thrown_ = std::current_exception();
        }
        if (thrown_ || is_done_) ::XML_StopParser(parser_.get(), XML_FALSE);
    }

    static ExpatReader& reader(void* data) { return *static_cast<ExpatReader*>(data); }

    static void on_begin(void* data, const XML_Char* name, const XML_Char** attributes) {
        reader(data).guard([&] { reader(data).begin(name, attributes); });
    }
    static void on_end(void* data, const XML_Char* /*name*/) {
        ExpatReader& self = reader(data);
        self.guard([&] { self.visitor_.end(--self.depth_, self.place(), self.place_behind()); });
    }
    static void on_declaration(void* data, const XML_Char* prefix, const XML_Char* uri) {
        reader(data).guard([&] {
            reader(data).visitor_.declare(prefix == nullptr ? "" : prefix,
                                          uri == nullptr ? "" : uri);
        });
    }
    static void on_document_type(void* data, const XML_Char* /*name*/, const XML_Char* /*system*/,
                                 const XML_Char* /*public*/, int /*has_subset*/) {
        reader(data).guard([&] {
            reader(data).file_.fail_malformed(
                reader(data).place(),
                "the XML has a document type, which files of this format have not; export the file "
                "again, or delete the line with DOCTYPE");
        });
    }

    void begin(const XML_Char* name, const XML_Char** attributes) {
        const auto split = [](std::string_view full, std::string_view& space,
                              std::string_view& local) {
            const std::size_t at = full.rfind(separator);
            space = at == std::string_view::npos ? std::string_view() : full.substr(0, at);
            local = at == std::string_view::npos ? full : full.substr(at + 1);
        };
        split(name, tag_.space, tag_.name);
        tag_.attributes.clear();
        for (; *attributes != nullptr; attributes += 2) {
            XmlAttribute& attribute = tag_.attributes.emplace_back();
            split(attributes[0], attribute.space, attribute.name);
            attribute.value = attributes[1];
        }
        tag_.depth = depth_++;
        tag_.begin = place();
        tag_.end = place_behind();
        is_done_ = !visitor_.begin(tag_);
    }

    const SourceFile& file_;
    XmlVisitor& visitor_;
    Ticker ticker_;
    std::unique_ptr<XML_ParserStruct, void (*)(XML_Parser)> parser_;
    std::exception_ptr thrown_;
    bool is_done_ = false;
    std::size_t depth_ = 0;  // Of elements that are open.
    XmlTag tag_;
};

}  // namespace

bool knows_xml() { return true; }

void read_xml(const SourceFile& file, XmlVisitor& visitor) { ExpatReader(file, visitor).read(); }

}  // namespace remesh
