#include "core/prepare/tile_rows.h"

#include "core/base/check.h"
#include "core/base/parallel.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace marsview {
namespace {

// Distributes rows until the end, an error or a cancel.
class RowQueue {
public:
    RowQueue(const RowSpan& rows, const JobMonitor& monitor)
        : rows_(rows)
        , monitor_(monitor)
        , next_(rows.first)
    {}

    std::optional<std::size_t> take()
    {
        const std::lock_guard lock(mutex_);
        const bool is_late = next_ > rows_.first && std::chrono::steady_clock::now() >= rows_.until;
        if (failure_ || is_late || next_ == rows_.end || monitor_.isCanceled()) {
            return std::nullopt;
        }
        return next_++;
    }
    void fail(Error error)
    {
        const std::lock_guard lock(mutex_);
        if (!failure_) {
            failure_ = std::move(error);
        }
    }
    // Call when no thread takes rows any more.
    Result<std::size_t> outcome() &&
    {
        if (monitor_.isCanceled()) {
            return Error{ErrorCode::Canceled, "canceled"};
        }
        if (failure_) {
            return std::move(*failure_);
        }
        return next_;
    }

private:
    const RowSpan rows_;
    const JobMonitor& monitor_;
    std::mutex mutex_;
    std::size_t next_;
    std::optional<Error> failure_; // the first
};

} // namespace

Result<std::unique_ptr<TileReader>> TileReaders::take()
{
    {
        const std::lock_guard lock(mutex_);
        if (!idle_.empty()) {
            std::unique_ptr<TileReader> reader = std::move(idle_.back());
            idle_.pop_back();
            return reader;
        }
    }
    return source_.open();
}

Result<std::size_t>
TileReaders::eachRow(const RowSpan& rows, const Work& work, const JobMonitor& monitor)
{
    MARSVIEW_CHECK(rows.first <= rows.end);
    RowQueue queue(rows, monitor);
    const auto run = [&](std::size_t, std::size_t) {
        std::optional<std::size_t> row = queue.take();
        if (!row) {
            return;
        }
        Result<std::unique_ptr<TileReader>> reader = take();
        if (!reader) {
            return queue.fail(std::move(reader).error());
        }
        for (; row; row = queue.take()) {
            if (Status done = work(**reader, *row); !done) {
                queue.fail(std::move(done).error());
            }
        }
        const std::lock_guard lock(mutex_);
        idle_.push_back(std::move(reader).value());
    };
    // One part per thread; the queue distributes the rows.
    parallelRanges(std::min(rows.end - rows.first, threads_max_), 1, run, threads_max_);
    return std::move(queue).outcome();
}

Result<Tile>
readTile(TileReader& reader, const TileSource& source, const TileId& id, const JobMonitor& monitor)
{
    if (monitor.isCanceled()) {
        return Error{ErrorCode::Canceled, "canceled"};
    }
    auto tile = reader.read(id);
    MARSVIEW_CHECK(!tile || (tile->samples.type() == source.layout().type &&
                             tile->samples.columns() == source.layout().tileWidth(id) &&
                             tile->samples.rows() == source.layout().tileHeight(id)));
    if (tile && tile->samples.hasVoids() && !source.layout().has_voids) {
        return Error{
            ErrorCode::Invalid,
            fmt::format("{}: has voids that it did not have when it was opened; open it again",
                        source.name())};
    }
    return tile;
}

} // namespace marsview
