//! \file
//! The version of these libraries. CMake reads it from here.
//! Held by Version.HeadersLibraryAndPackageAgree in tests/agvd/core.
#pragma once

namespace agvd {

inline constexpr int version_major = 0;          //!< First part of `version`.
inline constexpr int version_minor = 1;          //!< Second part: with it the interface may change.
inline constexpr int version_patch = 0;          //!< Third part.
inline constexpr const char* version = "0.1.0";  //!< Of the headers.

//! The version of the library that is linked or loaded. It should be that of the headers; a
//! program that finds another one was compiled for another library.
[[nodiscard]] const char* library_version();

}  // namespace agvd
