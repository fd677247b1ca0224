#include "core/prepare/parts/stored_tiles.h"

#include "core/base/deflate.h"

#include <algorithm>
#include <utility>

namespace marsview {

Status storeAgain(std::vector<StoredTile> tiles,
                  const FileBytes* file,
                  const PartRows& part,
                  OrderedTiles& ordered)
{
    std::sort(tiles.begin(), tiles.end(),
              [](const StoredTile& a, const StoredTile& b) { return a.place < b.place; });
    auto next = tiles.begin();
    for (std::size_t row = part.first; row < part.end; ++row) {
        for (; file != nullptr && next != tiles.end() && next->place.tile_row == row; ++next) {
            auto bytes = file->read(next->from.offset, next->from.bytes);
            if (!bytes) {
                return std::move(bytes).error();
            }
            if (crc32Of({bytes->data(), bytes->size()}) != next->from.checksum) {
                return Error{ErrorCode::Damaged, file->path() + ": is damaged"};
            }
            ordered.put(next->place,
                        std::vector<std::byte>(bytes->data(), bytes->data() + bytes->size()),
                        std::move(next->stored));
        }
        if (Status written = ordered.done(row); !written) {
            return written;
        }
    }
    return Done{};
}

} // namespace marsview
