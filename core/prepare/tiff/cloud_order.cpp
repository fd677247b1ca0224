#include "core/prepare/tiff/cloud_order.h"

#include "core/prepare/tiff/tiff_stream.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <memory>
#include <utility>

namespace marsview {
namespace {

// The position of the first tile of a page and of the last.
std::pair<std::uint64_t, std::uint64_t> extentOf(const TiffTiles& tiles, std::size_t page)
{
    const std::size_t count = tiles.pages()[page].tile_columns * tiles.pages()[page].tile_rows;
    return {tiles.offsetOf(page, 0), tiles.offsetOf(page, count - 1)};
}

Status write(const TiffStreamJob& job, const std::string& path, JobMonitor& monitor)
{
    Result<std::unique_ptr<ByteStream>> to = ByteStream::open(path);
    if (!to) {
        return std::move(to).error();
    }
    Status written = streamTiff(job, **to, monitor);
    return written ? (*to)->finish() : written;
}

} // namespace

std::vector<std::vector<std::size_t>> pagesFromCoarsest(const std::vector<TiffPage>& pages)
{
    std::vector<std::vector<std::size_t>> ordered;
    for (std::size_t i = 0; i < pages.size(); ++i) {
        if (!pages[i].is_mask) {
            ordered.push_back({i});
        }
    }
    std::sort(ordered.begin(), ordered.end(), [&pages](const auto& a, const auto& b) {
        const TiffPage& left = pages[a.front()];
        const TiffPage& right = pages[b.front()];
        return std::pair(left.rows, left.columns) < std::pair(right.rows, right.columns);
    });
    for (std::vector<std::size_t>& level : ordered) {
        for (std::size_t i = 0; i < pages.size(); ++i) {
            if (pages[i].is_mask && pages[i].columns == pages[level.front()].columns &&
                pages[i].rows == pages[level.front()].rows) {
                level.push_back(i);
            }
        }
    }
    return ordered;
}

bool isOrderedForCloud(const std::string& path)
{
    const Result<TiffTiles> tiles = TiffTiles::open(path, TiffTiles::Access::Read);
    if (!tiles) {
        return false;
    }
    std::uint64_t end = 0;
    for (const std::vector<std::size_t>& level : pagesFromCoarsest(tiles->pages())) {
        const auto [first, last] = extentOf(*tiles, level.front());
        if (first <= end || last < first) {
            return false;
        }
        end = last;
    }
    return true;
}

Status orderForCloud(const std::string& from, const std::string& to, JobMonitor& monitor)
{
    const Result<TiffTiles> tiles = TiffTiles::open(from, TiffTiles::Access::Read);
    if (!tiles) {
        return tiles.error();
    }
    TiffStreamJob job{.skeleton = from,
                      .skeleton_bytes = std::numeric_limits<std::uint64_t>::max(),
                      .files = {&*tiles},
                      .tiles = {},
                      .names = {from},
                      .remedies = {}};
    for (const std::vector<std::size_t>& level : pagesFromCoarsest(tiles->pages())) {
        const TiffPage& page = tiles->pages()[level.front()];
        for (std::size_t row = 0; row < page.tile_rows; ++row) {
            for (const std::size_t of : level) {
                for (std::size_t column = 0; column < page.tile_columns; ++column) {
                    const std::size_t tile = row * page.tile_columns + column;
                    job.tiles.push_back({.page = static_cast<std::uint32_t>(of), .tile = tile});
                    job.skeleton_bytes = std::min(job.skeleton_bytes, tiles->offsetOf(of, tile));
                }
            }
        }
    }
    Status written = write(job, to, monitor);
    if (!written) {
        std::remove(to.c_str());
    }
    return written;
}

} // namespace marsview
