//! \file
//! What the parallel loops call. Private.
#pragma once

namespace agvd {

//! What a loop calls: refers to any callable, which must outlive the loop. Unlike std::function it
//! allocates nothing, and no code is made to copy or destroy the callable.
template <typename... Args>
class LoopBody {
public:
    template <typename Body>
    LoopBody(const Body& body)
        : body_(&body),
          call_([](const void* of, Args... args) { (*static_cast<const Body*>(of))(args...); }) {}
    void operator()(Args... args) const { call_(body_, args...); }

private:
    const void* body_;
    void (*call_)(const void*, Args...);
};

}  // namespace agvd
