//! \file
//! The program `remesh` as a process, in a folder of its own.
#pragma once

#include "support/scratch.h"

class Remesh : public Scratch {
protected:
    [[nodiscard]] static process::Outcome remesh(std::vector<std::string> arguments,
                                                 const process::Options& options = {}) {
        return run(REMESH_PROGRAM, std::move(arguments), options);
    }
};
