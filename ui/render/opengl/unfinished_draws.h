// Bounds the memory of a software driver, which keeps triangles until they are drawn.
#pragma once

#include <cstddef>
#include <deque>
#include <epoxy/gl.h>

namespace marsview {

/// Sends draws to the driver in pieces, and waits where too many of them are not finished: the
/// thread that prepares triangles may be far ahead of those that draw them. Use with the same
/// context current.
class UnfinishedDraws {
public:
    UnfinishedDraws() = default;
    ~UnfinishedDraws();
    UnfinishedDraws(const UnfinishedDraws&) = delete;
    UnfinishedDraws& operator=(const UnfinishedDraws&) = delete;

    /// After a draw of so many triangles.
    void add(std::size_t triangles);

private:
    void waitForOldest();

    std::deque<GLsync> sent_;
    std::size_t unsent_ = 0; // triangles
};

} // namespace marsview
