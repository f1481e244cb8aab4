//! \file
//! A run on the outside of the caller's mesh in place of the mesh.
#pragma once

#include "remesh/pipeline/cleaned_input.h"

namespace remesh::detail {

//! run_stages() of the wrap, with sites on the caller's mesh.
//! \param options  checked; with a wrap.
//! \throw what remesh() throws.
[[nodiscard]] RemeshResult run_wrapped(const InputMesh& input, const RemeshOptions& options);

}  // namespace remesh::detail
