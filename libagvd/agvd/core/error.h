//! \file
//! The exceptions of the libraries. Every text says what is wrong, where (file, line or element),
//! and what to do about it. Held by Surface in tests/agvd/mesh.
#pragma once

#include <stdexcept>

namespace agvd {

//! Base of all errors thrown on purpose.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

//! An option is out of its documented range.
class InvalidOption : public Error {
public:
    using Error::Error;
};

//! The mesh (or another input) cannot be used: not finite, not orientable, no face left, ...
class InvalidInput : public Error {
public:
    using Error::Error;
};

//! Given sites cannot be used on this mesh.
class InvalidSites : public InvalidInput {
public:
    using InvalidInput::InvalidInput;
};

//! A file cannot be read or written.
class IoError : public Error {
public:
    using Error::Error;
};

//! The request cannot be met on this input; nothing was produced.
class ConstraintUnmet : public Error {
public:
    using Error::Error;
};

//! The progress callback returned false; the call changed nothing.
class Cancelled : public Error {
public:
    Cancelled() : Error("stopped by the progress callback") {}
};

}  // namespace agvd
