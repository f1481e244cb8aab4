//! \file
//! Numbers and words of a text file, line by line. Private to the readers; inline, as every number
//! of a file passes through here.
#pragma once

#include <fast_float/fast_float.h>

#include <array>
#include <optional>

#include "agvd/core/types.h"
#include "remesh/meshfile/source_file.h"

namespace remesh {

//! The text as a number, correctly rounded, which may be infinite or NaN; nothing if it is
//! something else.
[[nodiscard]] inline std::optional<double> as_number(std::string_view text) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    const char* const end = text.data() + text.size();
    double value = 0;
    const auto [last, error] = fast_float::from_chars(text.data(), end, value);
    if (error != std::errc{} || last != end) return std::nullopt;
    return value;
}

//! The text as a whole number of a type; nothing if it is something else.
template <typename Whole>
[[nodiscard]] std::optional<Whole> as_whole(std::string_view text) {
    const char* const end = text.data() + text.size();
    Whole value = 0;
    const auto [last, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || last != end) return std::nullopt;
    return value;
}

class TextScanner {
public:
    struct Rules {
        char comment = '\n';     //!< From this character on, a line is not read; '\n': none.
        bool continues = false;  //!< A backslash at the end of a line joins it with the next one.
    };

    //! The file must outlive the scanner. A byte order mark is skipped.
    TextScanner(const SourceFile& file, std::size_t begin, Rules rules)
        : file_(file),
          begin_(file.bytes.data()),
          at_(begin_ + begin),
          end_(begin_ + file.bytes.size()),
          rules_(rules) {
        take("\xEF\xBB\xBF");
    }

    [[nodiscard]] std::size_t offset() const { return static_cast<std::size_t>(at_ - begin_); }

    //! Goes on at an offset, such as behind binary data.
    void go_to(std::size_t offset) { at_ = begin_ + offset; }

    //! True if a word is left on this line.
    [[nodiscard]] bool has_word() {
        skip_blanks();
        return at_ != end_ && !is_line_end(*at_) && *at_ != rules_.comment;
    }

    //! Goes to the next word on this line or a later one; false at the end of the file.
    [[nodiscard]] bool find_word() {
        while (!has_word()) {
            if (at_ == end_) return false;
            skip_line();
        }
        return true;
    }

    //! Passes over the rest of the line.
    void skip_line() {
        while (at_ != end_ && !is_line_end(*at_)) ++at_;
        if (at_ != end_) ++at_;
    }

    //! The next word of this line; empty if there is none.
    std::string_view word() { return has_word() ? rest_of_word() : std::string_view(); }

    //! The remaining words of this line with one blank between them. As skip_line() does, it ends
    //! where the line ends, even if that is joined with the next one.
    std::string words() {
        std::string text;
        for (; at_ != end_ && !is_line_end(*at_) && *at_ != rules_.comment; ++at_) {
            if (!is_blank(*at_)) {
                text += *at_;
            } else if (!text.empty() && text.back() != ' ') {
                text += ' ';
            }
        }
        if (text.ends_with(' ')) text.pop_back();
        return text;
    }

    //! What comes before the next blank, comment or line end.
    std::string_view rest_of_word() {
        const char* const first = at_;
        while (!is_separator(at_)) ++at_;
        return {first, static_cast<std::size_t>(at_ - first)};
    }

    //! Passes over `text` if it comes next, without regard to what follows it.
    bool take(std::string_view text) {
        if (!std::string_view(at_, static_cast<std::size_t>(end_ - at_)).starts_with(text)) {
            return false;
        }
        at_ += text.size();
        return true;
    }

    //! The next number of this line, correctly rounded; may be infinite or NaN.
    double number(const char* what) {
        if (!has_word()) fail_expecting(what);  // from_chars would pass over line ends.
        const char* first = at_;
        if (end_ - first > 1 && *first == '+' && first[1] != '-') ++first;
        double value = 0;
        const auto [last, error] = fast_float::from_chars(first, end_, value);
        if (error != std::errc{} || !is_separator(last)) fail_expecting(what);
        at_ = last;
        return value;
    }

    //! The words on the rest of this line as numbers.
    struct Numbers {
        std::array<double, 9> values{};
        std::size_t count = 0;   //!< Values behind these are 0.
        bool is_broken = false;  //!< Some word is no number; its value is 0.
    };
    //! \param most  words that are read, up to 9.
    Numbers numbers(std::size_t most) {
        Numbers result;
        for (; result.count < most && has_word(); ++result.count) {
            const std::optional<double> value = as_number(rest_of_word());
            result.is_broken = result.is_broken || !value;
            result.values[result.count] = value.value_or(0);
        }
        return result;
    }

    //! The next whole number of this line.
    //! \param stop  may follow it like a blank.
    std::int64_t integer(const char* what, char stop = ' ') {
        skip_blanks();
        std::int64_t value = 0;
        const auto [last, error] = std::from_chars(at_, end_, value);
        if (error == std::errc::result_out_of_range) {
            file_.fail_unusable(offset(), what,
                                " is too large; correct it, or export the file again");
        }
        if (error != std::errc{} || (!is_separator(last) && *last != stop)) {
            fail_expecting(what);
        }
        at_ = last;
        return value;
    }

    //! The next integer, which must not be negative.
    std::uint64_t count(const std::string& what) {
        const std::size_t start = offset();
        const std::int64_t value = integer(what.c_str());
        if (value < 0) file_.fail_damaged(start, what, " is negative");
        return static_cast<std::uint64_t>(value);
    }

    //! The next three numbers of this line, finite; or so many, and 0 for the others.
    Vec3 point(int num_coordinates = 3) {
        const std::size_t start = offset();
        Vec3 p(0, 0, 0);
        for (int k = 0; k < num_coordinates; ++k) p[k] = number("a coordinate");
        if (!p.allFinite()) {
            file_.fail_unusable(start,
                                "a coordinate is not finite (NaN, infinite or beyond double "
                                "precision); correct or delete it");
        }
        return p;
    }

    template <typename... Parts>
    [[noreturn]] void fail_malformed(Parts... parts) const {
        file_.fail_malformed(offset(), parts...);
    }
    template <typename... Parts>
    [[noreturn]] void fail_damaged(Parts... parts) const {
        file_.fail_damaged(offset(), parts...);
    }

    [[noreturn]] void fail_expecting(const char* what) {
        const std::size_t start = offset();
        const std::string_view found = word();
        file_.fail_malformed(start, "expected ", what, ", found ",
                             (!found.empty() ? in_quotes(found)
                              : at_ == end_  ? "the end of the file, which may be truncated"
                                             : "the end of the line"),
                             "; correct the line, or export the file again");
    }

private:
    [[nodiscard]] static bool is_line_end(char c) { return c == '\n' || c == '\r'; }
    [[nodiscard]] static bool is_blank(char c) {
        return c == ' ' || c == '\t' || c == '\v' || c == '\f';
    }
    [[nodiscard]] bool is_separator(const char* p) const {
        return p == end_ || is_blank(*p) || is_line_end(*p) || *p == rules_.comment || is_joint(p);
    }
    [[nodiscard]] bool is_joint(const char* p) const {
        return *p == '\\' && rules_.continues && p + 1 != end_ && is_line_end(p[1]);
    }

    void skip_blanks() {
        for (; at_ != end_; ++at_) {
            if (is_joint(at_)) {
                const bool is_crlf = at_ + 2 != end_ && at_[1] == '\r' && at_[2] == '\n';
                at_ += is_crlf ? 2 : 1;
            } else if (!is_blank(*at_)) {
                return;
            }
        }
    }

    const SourceFile& file_;
    const char* begin_;
    const char* at_;
    const char* end_;
    Rules rules_;
};

}  // namespace remesh
