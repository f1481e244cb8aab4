//! \file
//! One line on a terminal that shows how far a run is.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

namespace cli {

//! What the line shows.
struct ProgressState {
    double fraction = 0;  //!< Of the whole, in [0, 1].
    std::string stage;
    int run = 1;  //!< Shown from 2 on.
    std::chrono::seconds elapsed{0};
    std::optional<std::chrono::seconds> left;  //!< Unset: not known.
};

//! Such as "[#####      ]  42 %  relax, run 2  0:12, 0:17 left". The bar gets what the text leaves,
//! up to 30 columns; on narrow terminals it is left out, and the text cut.
//! \param width  columns of the terminal; the line has fewer, so that none wraps.
[[nodiscard]] std::string progress_line(const ProgressState& state, std::size_t width);

//! Draws the line on stderr, and removes it.
class ProgressBar {
public:
    //! A bar that is not shown does nothing.
    explicit ProgressBar(bool is_shown);
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;
    ~ProgressBar() { clear(); }

    [[nodiscard]] bool is_shown() const { return is_shown_; }
    void draw(const ProgressState& state);
    void clear();

private:
    bool is_shown_;
    std::string line_;  // As on the screen now; empty: none.
};

}  // namespace cli
