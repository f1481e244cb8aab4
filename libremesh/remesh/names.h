//! \file
//! Code of libremesh names what libagvd has without its namespace.
#pragma once

namespace agvd {}
namespace remesh {
using namespace agvd;
}  // namespace remesh
