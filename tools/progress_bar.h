//! \file
//! Shows how far a run is: as one line on a terminal, or as lines for another program.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

namespace cli {

//! How progress is shown on stderr.
enum class ProgressForm {
    Bar,   //!< A bar, if that is a terminal.
    Json,  //!< Lines of JSON, whatever it is.
};

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

//! Such as {"progress": 0.420, "stage": "relax", "run": 2}, without a line end.
[[nodiscard]] std::string progress_json(const ProgressState& state);

//! Draws the line on stderr, and removes it. Lines of JSON stay.
class ProgressBar {
public:
    //! A bar that is not shown does nothing.
    //! \param is_shown  whether a terminal gets a bar.
    ProgressBar(bool is_shown, ProgressForm form);
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;
    ~ProgressBar() { clear(); }

    [[nodiscard]] bool is_shown() const { return is_shown_; }
    void draw(const ProgressState& state);
    void clear();

private:
    ProgressForm form_;
    bool is_shown_;
    std::string line_;  // As on the screen now; empty: none.
};

}  // namespace cli
