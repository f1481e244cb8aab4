#include "terms.h"

namespace cli {
namespace {

bool is_of_word(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.' || c == '/';
}

bool begins_word(std::string_view text, std::size_t at) {
    return at == 0 || !is_of_word(text[at - 1]);
}

void replace_words(std::string& text, const Term& term) {
    const auto [given, replacement] = term;
    for (std::size_t at = text.find(given); at != std::string::npos; at = text.find(given, at)) {
        const std::size_t end = at + given.size();
        // A full stop may end the sentence.
        if (begins_word(text, at) &&
            (end == text.size() || text[end] == '.' || !is_of_word(text[end]))) {
            text.replace(at, given.size(), replacement);
        }
        ++at;
    }
}

// The name of an option that begins at `at`, in the style.
void join_words(std::string& text, std::size_t at, NameStyle style) {
    for (; at < text.size() && is_of_word(text[at]); ++at) {
        if (text[at] != '-') continue;
        if (style == NameStyle::Snake) {
            text[at] = '_';
            continue;
        }
        text.erase(at, 1);
        if (at < text.size() && text[at] >= 'a' && text[at] <= 'z') {
            text[at] = static_cast<char>(text[at] - 'a' + 'A');
        }
    }
}

}  // namespace

std::string in_terms(std::string text, std::span<const Term> terms, NameStyle style) {
    for (const Term& term : terms) replace_words(text, term);
    for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--", at + 1)) {
        if (!begins_word(text, at)) continue;
        text.erase(at, 2);
        join_words(text, at, style);
    }
    return text;
}

}  // namespace cli
