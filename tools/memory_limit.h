//! \file
//! How much memory a program may use, and the message if that is not enough.
#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "agvd/propagation/propagate.h"
#include "system/memory.h"

namespace cli {

//! The limit was reached, or the system has no more memory. The text names the stage and a remedy.
class OutOfMemory : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

//! A number of bytes above 0: "1000000", with K, M, G or T for powers of 1024 ("500M", "1.5G"), or
//! a percentage of machine_memory(), above 0 and at most 100 ("60%"). Unset: it is none of these.
[[nodiscard]] std::optional<std::size_t> parse_bytes(std::string_view text);

//! As parse_bytes takes it, with three digits.
[[nodiscard]] std::string format_bytes(std::size_t bytes);

//! How much memory a job may use.
struct MemoryLimit {
    std::size_t bytes = 0;                       //!< 0: as much as the system gives.
    agvd::Engine engine = agvd::Engine::Window;  //!< For the remedy.
};

//! Compares the memory of the process with a limit while a job runs.
class MemoryGuard {
public:
    explicit MemoryGuard(const MemoryLimit& limit) : limit_(limit) {}

    //! Looks at the memory; once it is above the limit, this stays true. Cost: some microseconds.
    [[nodiscard]] bool check();
    //! Whether check() has been true.
    [[nodiscard]] bool is_over() const { return is_over_; }
    //! Call before work that needs at least this many bytes more.
    //! \throw OutOfMemory  the limit would be exceeded; the text tells how much is needed.
    void require(const std::string& stage, std::size_t bytes);
    //! What to throw where is_over(), or where the system has no more memory.
    //! \param stage   empty: not known.
    //! \param needed  how much, if it is known: "some 3.7G, ".
    [[nodiscard]] OutOfMemory error(const std::string& stage, const std::string& needed = {}) const;

private:
    MemoryLimit limit_;
    bool is_over_ = false;
};

//! What to try if a stage needs too much memory.
//! \param stage  its name in logs.
[[nodiscard]] std::string memory_remedy(std::string_view stage, agvd::Engine engine);

}  // namespace cli
