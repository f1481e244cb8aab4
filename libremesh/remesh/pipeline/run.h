//! \file
//! The stages of remesh() in their order.
#pragma once

#include "remesh/pipeline/cleaned_input.h"

namespace remesh::detail {

//! \param options  checked.
//! \throw what remesh() throws.
[[nodiscard]] RemeshResult run_stages(const InputMesh& input, const RemeshOptions& options);

}  // namespace remesh::detail
