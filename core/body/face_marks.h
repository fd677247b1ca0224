// Marks of the faces of a map.
#pragma once

#include "core/base/check.h"
#include "core/body/body_mesh.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace marsview {

/// One bit per face, not set at first. A map with a rim (TiledRim) may have more faces than memory
/// has bits: only its faces within two cells of the border can be marked.
class FaceMarks {
public:
    explicit FaceMarks(const BodyMesh& mesh)
        : is_of_rim_(mesh.rim() != nullptr)
        , columns_(mesh.cellColumns())
        , rows_(mesh.cellRows())
        , marks_(is_of_rim_ ? 2 * 2 * kWidth * (columns_ + rows_) : mesh.faceCount(), false)
    {}

    bool operator[](BodyIndex face) const noexcept
    {
        const BodyIndex at = placeOf(face);
        return at != BodyMesh::kNone && marks_[at];
    }
    void set(BodyIndex face)
    {
        const BodyIndex at = placeOf(face);
        MARSVIEW_CHECK(at != BodyMesh::kNone);
        marks_[at] = true;
    }
    bool isAny() const noexcept
    {
        return std::find(marks_.begin(), marks_.end(), true) != marks_.end();
    }

private:
    static constexpr BodyIndex kWidth = 2; // cells, at each side

    // Along a side of `count` cells; kNone farther than kWidth from its ends.
    static BodyIndex besideEnd(BodyIndex at, BodyIndex count) noexcept
    {
        return at < kWidth ? at : at + kWidth >= count ? at + 2 * kWidth - count : BodyMesh::kNone;
    }
    BodyIndex placeOf(BodyIndex face) const noexcept
    {
        if (!is_of_rim_) {
            return face;
        }
        const BodyIndex cell = face / 2;
        const BodyIndex row = cell / columns_;
        const BodyIndex column = cell - row * columns_;
        if (row >= rows_) { // a triangle that closes a pole
            return BodyMesh::kNone;
        }
        if (const BodyIndex at = besideEnd(row, rows_); at != BodyMesh::kNone) {
            return 2 * (at * columns_ + column) + face % 2;
        }
        const BodyIndex at = besideEnd(column, columns_);
        return at == BodyMesh::kNone ? at
                                     : 2 * (2 * kWidth * columns_ + at * rows_ + row) + face % 2;
    }

    bool is_of_rim_;
    BodyIndex columns_; // of cells
    BodyIndex rows_;
    std::vector<bool> marks_;
};

} // namespace marsview
