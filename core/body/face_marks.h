// Marks of the faces of a map.
#pragma once

#include "core/base/check.h"
#include "core/body/body_mesh.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace marsview {

/// One bit per face, not set at first. Bits are stored in pages of 4096 cells of a row, and only
/// where some are set, since a map in tiles may have more faces than memory has bits: 1 KB per
/// page, and 4 bytes per 4096 cells of the map once a bit is set. Looking one up takes the same
/// time everywhere.
class FaceMarks {
public:
    explicit FaceMarks(const BodyMesh& mesh)
        : face_count_(mesh.faceCount())
        , words_(kPageWords, 0) // the page without marks
    {}

    bool operator[](BodyIndex face) const noexcept
    {
        return !pages_.empty() &&
               (words_[wordOf(pages_[face / kPageFaces], face)] >> (face % kWordFaces) & 1U) != 0U;
    }
    void set(BodyIndex face)
    {
        MARSVIEW_CHECK(face < face_count_);
        if (pages_.empty()) {
            pages_.resize(face_count_ / kPageFaces + 1, 0);
        }
        std::uint32_t& page = pages_[face / kPageFaces];
        if (page == 0) {
            page = static_cast<std::uint32_t>(words_.size() / kPageWords);
            words_.resize(words_.size() + kPageWords, 0);
        }
        words_[wordOf(page, face)] |= std::uint64_t{1} << (face % kWordFaces);
    }
    /// Of a map of any size, in a page.
    void setAll()
    {
        words_.assign(2 * kPageWords, 0);
        std::fill(words_.begin() + kPageWords, words_.end(), ~std::uint64_t{0});
        pages_.assign(face_count_ / kPageFaces + 1, 1);
    }
    bool isAny() const noexcept { return !pages_.empty(); }

private:
    static constexpr std::size_t kWordFaces = 64;
    static constexpr std::size_t kPageWords = 128;
    static constexpr std::size_t kPageFaces = kPageWords * kWordFaces;

    static std::size_t wordOf(std::uint32_t page, BodyIndex face) noexcept
    {
        return page * kPageWords + face / kWordFaces % kPageWords;
    }

    std::size_t face_count_;
    std::vector<std::uint32_t> pages_; // by their first face; empty while no bit is set
    std::vector<std::uint64_t> words_;
};

} // namespace marsview
