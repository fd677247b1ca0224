#include "core/raster/decimated_read.h"

#include "core/base/check.h"
#include "core/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <list>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace marsview {
namespace {

using std::chrono::nanoseconds;

// The longer side of the coarsest preview: enough to distinguish Mars from the Moon, and done in
// seconds on a slow server where every block is a request.
constexpr std::size_t kCoarsestSide = 32;

// The minimum refinement of a finer preview along each side.
constexpr double kStepMin = 1.25;

// An overview with a longer side below this shows less than picked samples would.
constexpr std::size_t kOverviewSideMin = 256;

// The limit on samples read at once to pick a few of them.
constexpr std::size_t kWindowSamplesMax = std::size_t{1} << 22;

GridSize sizeWithin(GridSize whole, std::size_t samples_max)
{
    const double share =
        std::sqrt(static_cast<double>(samples_max) /
                  (static_cast<double>(whole.columns) * static_cast<double>(whole.rows)));
    if (share >= 1.0) {
        return whole;
    }
    const auto part = [share](std::size_t count) {
        return std::max<std::size_t>(2,
                                     static_cast<std::size_t>(static_cast<double>(count) * share));
    };
    GridSize size{part(whole.columns), part(whole.rows)};
    // A map that is very long and narrow.
    size.columns = std::min(size.columns, samples_max / size.rows);
    size.rows = std::min(size.rows, samples_max / size.columns);
    return size;
}

// The finest preview, with the fraction `share` in (0, 1] of its samples along each side.
GridSize partOf(GridSize finest, double share)
{
    const auto part = [share](std::size_t count) {
        const double fewer = std::round(share * static_cast<double>(count));
        return std::clamp<std::size_t>(static_cast<std::size_t>(fewer), 2, count);
    };
    return {part(finest.columns), part(finest.rows)};
}

// The parts whose samples lie in one row, or column, of blocks.
struct BlockRun {
    std::size_t begin = 0;
    std::size_t end = 0;
};

std::vector<BlockRun> blockRuns(std::size_t parts, std::size_t count, std::size_t block)
{
    std::vector<BlockRun> runs;
    for (std::size_t i = 0; i < parts;) {
        const std::size_t number = decimatedPlace(i, parts, count) / block;
        BlockRun run{i, i + 1};
        while (run.end < parts && decimatedPlace(run.end, parts, count) / block == number) {
            ++run.end;
        }
        runs.push_back(run);
        i = run.end;
    }
    return runs;
}

// Picks samples out of blocks.
class Picker {
public:
    Picker(RasterFile& file, const VoidRule& voids, JobMonitor& monitor)
        : file_(file)
        , voids_(voids)
        , monitor_(monitor)
        , whole_({file.info().columns, file.info().rows})
        , block_(file.blockSize())
    {}

    /// The number of blocks that a preview reads.
    double cost(GridSize look) const
    {
        const auto touched = [](std::size_t parts, std::size_t count, std::size_t block) {
            return static_cast<double>(std::min(parts, (count + block - 1) / block));
        };
        return touched(look.columns, whole_.columns, block_.columns) *
               touched(look.rows, whole_.rows, block_.rows);
    }

    /// Empty if `is_late`, polled on any thread, became true.
    Result<std::optional<LoadedSamples>> pick(GridSize look, const std::function<bool()>& is_late)
    {
        Result<SampleGrid> grid = SampleGrid::create(file_.info().type, look.columns, look.rows);
        if (!grid) {
            return std::move(grid).error();
        }
        const std::vector<BlockRun> rows = blockRuns(look.rows, whole_.rows, block_.rows);
        const std::vector<BlockRun> columns =
            blockRuns(look.columns, whole_.columns, block_.columns);
        // One byte per sample: several threads cannot set bits of one word.
        std::vector<std::uint8_t> is_void(look.columns * look.rows);
        std::atomic<bool> is_stopped{false};
        std::atomic<std::size_t> done{0};
        std::optional<Error> failure;
        std::mutex mutex;
        std::list<RasterFile> opened;
        std::vector<RasterFile*> files{&file_}; // that no thread is reading
        const auto take_file = [&]() -> Result<RasterFile*> {
            {
                const std::lock_guard lock(mutex);
                if (!files.empty()) {
                    RasterFile* const file = files.back();
                    files.pop_back();
                    return file;
                }
            }
            Result<RasterFile> file = RasterFile::open(file_.info().path, file_.info().band);
            if (!file) {
                return std::move(file).error();
            }
            const std::lock_guard lock(mutex);
            return &opened.emplace_back(std::move(file).value());
        };
        parallelRanges(rows.size(), 1, [&](std::size_t begin, std::size_t) {
            if (is_stopped || monitor_.isCanceled() || is_late()) {
                is_stopped = true;
                return;
            }
            const Result<RasterFile*> file = take_file();
            Status read = file ? pickRow(**file, *grid, is_void, look, rows[begin], columns)
                               : Status(file.error());
            const std::lock_guard lock(mutex);
            if (!read) {
                failure = std::move(read).error();
                is_stopped = true;
                return;
            }
            files.push_back(*file);
            monitor_.report(static_cast<double>(++done) / static_cast<double>(rows.size()));
        });
        if (failure) {
            return *std::move(failure);
        }
        if (monitor_.isCanceled()) {
            return Error{ErrorCode::Canceled,
                         fmt::format("{}: reading was canceled", file_.info().path)};
        }
        if (is_stopped) {
            return std::optional<LoadedSamples>();
        }
        for (std::size_t i = 0; i < is_void.size(); ++i) {
            if (is_void[i] != 0) {
                grid->markVoid(i % look.columns, i / look.columns);
            }
        }
        const SampleStatistics statistics = grid->applyRule(voids_, 0, look.rows);
        return std::optional(LoadedSamples{std::move(*grid), statistics});
    }

private:
    Status pickRow(RasterFile& file,
                   SampleGrid& grid,
                   std::vector<std::uint8_t>& is_void,
                   GridSize look,
                   const BlockRun& rows,
                   const std::vector<BlockRun>& columns) const
    {
        for (const BlockRun& run : columns) {
            if (monitor_.isCanceled()) {
                break;
            }
            const std::size_t width =
                placeOf(look, run.end - 1, 0).column - placeOf(look, run.begin, 0).column + 1;
            const std::size_t height =
                placeOf(look, 0, rows.end - 1).row - placeOf(look, 0, rows.begin).row + 1;
            // All at once, or each row alone: the file keeps the block in between.
            const std::size_t step =
                width * height <= kWindowSamplesMax ? rows.end - rows.begin : 1;
            for (std::size_t row = rows.begin; row < rows.end; row += step) {
                if (Status picked = pickPart(file, grid, is_void, look, run, {row, row + step});
                    !picked) {
                    return picked;
                }
            }
        }
        return Done{};
    }

    struct Place {
        std::size_t column = 0;
        std::size_t row = 0;
    };
    Place placeOf(GridSize look, std::size_t column, std::size_t row) const
    {
        return {decimatedPlace(column, look.columns, whole_.columns),
                decimatedPlace(row, look.rows, whole_.rows)};
    }

    Status pickPart(RasterFile& file,
                    SampleGrid& grid,
                    std::vector<std::uint8_t>& is_void,
                    GridSize look,
                    const BlockRun& columns,
                    const BlockRun& rows) const
    {
        const Place first = placeOf(look, columns.begin, rows.begin);
        const Place last = placeOf(look, columns.end - 1, rows.end - 1);
        const Result<LoadedSamples> part = file.readWindow(
            {first.column, first.row, last.column - first.column + 1, last.row - first.row + 1},
            voids_);
        if (!part) {
            return part.error();
        }
        part->grid.visit([&](auto view) {
            using T = std::remove_cvref_t<decltype(view(0, 0))>;
            for (std::size_t j = rows.begin; j < rows.end; ++j) {
                std::byte* to = grid.rowData(j);
                for (std::size_t i = columns.begin; i < columns.end; ++i) {
                    const Place at = placeOf(look, i, j);
                    const std::size_t column = at.column - first.column;
                    const std::size_t row = at.row - first.row;
                    const T sample = view(column, row);
                    std::memcpy(to + i * sizeof(T), &sample, sizeof(T));
                    is_void[j * look.columns + i] = part->grid.isVoid(column, row) ? 1 : 0;
                }
            }
        });
        return Done{};
    }

    RasterFile& file_;
    VoidRule voids_;
    JobMonitor& monitor_;
    GridSize whole_;
    GridSize block_;
};

// The largest overview that is not too large; empty if there is no useful one.
std::optional<std::size_t> suitableOverview(const RasterFile& file, std::size_t samples_max)
{
    std::optional<std::size_t> best;
    std::size_t most = 0;
    for (std::size_t i = 0; i < file.overviewCount(); ++i) {
        const GridSize size = file.overviewSize(i);
        const std::size_t samples = size.columns * size.rows;
        if (samples <= samples_max && samples > most && std::min(size.columns, size.rows) >= 2 &&
            std::max(size.columns, size.rows) >= kOverviewSideMin) {
            best = i;
            most = samples;
        }
    }
    return best;
}

// The largest fraction up to 1 that is affordable; `share` is affordable.
template <typename IsAffordable>
double finestAffordable(double share, const IsAffordable& is_affordable)
{
    share = std::min(share, 1.0);
    if (is_affordable(1.0)) {
        return 1.0;
    }
    double too_much = 1.0;
    for (int i = 0; i < 20; ++i) {
        const double middle = 0.5 * (share + too_much);
        (is_affordable(middle) ? share : too_much) = middle;
    }
    return share;
}

nanoseconds clockNow()
{
    return std::chrono::steady_clock::now().time_since_epoch();
}

} // namespace

Result<DecimatedSamples> readDecimated(RasterFile& file,
                                       const VoidRule& voids,
                                       const DecimationLimits& limits,
                                       JobMonitor& monitor)
{
    MARSVIEW_CHECK(limits.samples_max >= 4);
    const GridSize whole{file.info().columns, file.info().rows};
    if (whole.columns * whole.rows > limits.samples_max) {
        if (const auto overview = suitableOverview(file, limits.samples_max)) {
            const GridSize size = file.overviewSize(*overview);
            Result<LoadedSamples> loaded =
                file.readOverview(*overview, {0, 0, size.columns, size.rows}, voids);
            if (!loaded) {
                return std::move(loaded).error();
            }
            return DecimatedSamples{
                .loaded = std::move(*loaded), .is_overview = true, .is_finest = true};
        }
    }
    const auto now = [&limits] { return limits.now ? limits.now() : clockNow(); };
    const nanoseconds begin = now();
    Picker picker(file, voids, monitor);
    const GridSize finest = sizeWithin(whole, limits.samples_max);
    double share = std::min(1.0, static_cast<double>(kCoarsestSide) /
                                     static_cast<double>(std::max(finest.columns, finest.rows)));
    std::optional<LoadedSamples> best;
    while (true) {
        const nanoseconds started = now();
        // A first result is required, however long it takes.
        const auto is_late = [&] { return best && now() - begin > 2 * limits.time_max; };
        auto picked = picker.pick(partOf(finest, share), is_late);
        if (!picked) {
            return std::move(picked).error();
        }
        if (!*picked) {
            break; // keep the best result so far
        }
        best = *std::move(*picked);
        if (!best->statistics.hasSamples() && share < 1.0) {
            best.reset(); // nothing to show yet
            share = std::min(1.0, 2.0 * share);
            continue;
        }
        const auto took = static_cast<double>((now() - started).count());
        const auto left = static_cast<double>((limits.time_max - (now() - begin)).count());
        const double cost = picker.cost(partOf(finest, share));
        const auto is_affordable = [&](double other) {
            return took * picker.cost(partOf(finest, other)) / cost <= left;
        };
        if (share >= 1.0 || !is_affordable(kStepMin * share)) {
            break;
        }
        share = finestAffordable(kStepMin * share, is_affordable);
    }
    const bool is_finest =
        best->grid.columns() == finest.columns && best->grid.rows() == finest.rows;
    return DecimatedSamples{
        .loaded = *std::move(best), .is_overview = false, .is_finest = is_finest};
}

} // namespace marsview
