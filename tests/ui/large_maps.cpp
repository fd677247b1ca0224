#include "tests/ui/large_maps.h"

#include <QCoreApplication>
#include <QThread>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <utility>

namespace marsview {
namespace {

// For a raster of several hundred samples per side.
constexpr std::size_t kPreviewSamples = 2500;

SampleStatistics statisticsOf(const Heightfield& heightfield)
{
    const ElevationScale scale = heightfield.scale();
    const HeightRange range = heightfield.range().value_or(HeightRange{});
    SampleStatistics statistics;
    statistics.raw_minimum = (range.minimum_m - scale.offset_m) / scale.gain;
    statistics.raw_maximum = (range.maximum_m - scale.offset_m) / scale.gain;
    statistics.sample_count = heightfield.columns() * heightfield.rows();
    return statistics;
}

// As the level file of a map with nodata has them.
std::vector<std::vector<float>> filledMaximaOf(const FilledHeightfield& filled,
                                               const MinMaxPyramid& bounds)
{
    std::vector<std::vector<float>> maxima_m;
    for (std::size_t level = 0; level < filled.levelCount(); ++level) {
        const std::size_t columns = bounds.columns(level);
        std::vector<float>& maxima = maxima_m.emplace_back();
        for (std::size_t i = 0; i < columns * bounds.rows(level); ++i) {
            maxima.push_back(static_cast<float>(filled.maximum(level, i % columns, i / columns)));
        }
    }
    return maxima_m;
}

} // namespace

MapOpener LargeMaps::opener()
{
    MapOpener opener;
    opener.resources.tiles = tiles_;
    opener.preview = [this](const RasterSpec& spec, const DecimationLimits& limits,
                            JobMonitor& monitor) { return preview(spec, limits, monitor); };
    opener.prepare = [this](const RasterSpec& spec, const MapResources&, JobMonitor& monitor) {
        return prepare(spec, monitor);
    };
    opener.open = [this](const RasterSpec& spec, const MapResources& resources,
                         JobMonitor& monitor) -> Result<std::shared_ptr<const Map>> {
        return isPrepared(spec) ? openTiled(spec, resources, monitor) : preview(spec, {}, monitor);
    };
    return opener;
}

bool LargeMaps::isPrepared(const RasterSpec& spec) const
{
    const std::lock_guard lock(mutex_);
    return std::find(prepared_.begin(), prepared_.end(), spec.path) != prepared_.end();
}

Result<std::shared_ptr<const Map>> LargeMaps::preview(const RasterSpec& spec,
                                                      const DecimationLimits& limits,
                                                      JobMonitor& monitor) const
{
    DecimationLimits some = limits;
    some.samples_max = kPreviewSamples;
    if (are_previews_rough_ && limits.time_max < std::chrono::seconds(1)) {
        some.now = [hours = std::make_shared<std::atomic<int>>(0)] {
            return std::chrono::hours(++*hours);
        };
    } else {
        some.time_max = std::chrono::hours(1);
    }
    return readPreview(spec, some, monitor);
}

void LargeMaps::finishPreparing(const std::optional<Error>& failure)
{
    const std::lock_guard lock(mutex_);
    is_finishing_ = true;
    failure_ = failure;
    changed_.notify_all();
}

void LargeMaps::holdPreparing()
{
    const std::lock_guard lock(mutex_);
    is_finishing_ = false;
}

void LargeMaps::losePrepared()
{
    const std::lock_guard lock(mutex_);
    is_losing_ = true;
}

void LargeMaps::holdTiles(bool is_held)
{
    const std::lock_guard lock(mutex_);
    are_tiles_held_ = is_held;
    changed_.notify_all();
}

void LargeMaps::holdAllTiles(bool is_held)
{
    const std::lock_guard lock(mutex_);
    are_all_tiles_held_ = is_held;
    changed_.notify_all();
}

int LargeMaps::guiReadCount() const
{
    const std::lock_guard lock(mutex_);
    return gui_read_count_;
}

void LargeMaps::failTiles(bool is_failing)
{
    const std::lock_guard lock(mutex_);
    are_tiles_failing_ = is_failing;
}

int LargeMaps::begunCount() const
{
    const std::lock_guard lock(mutex_);
    return begun_count_;
}

int LargeMaps::stoppedCount() const
{
    const std::lock_guard lock(mutex_);
    return stopped_count_;
}

std::vector<std::string> LargeMaps::prepared() const
{
    const std::lock_guard lock(mutex_);
    return prepared_;
}

Status LargeMaps::prepare(const RasterSpec& spec, JobMonitor& monitor)
{
    std::unique_lock lock(mutex_);
    ++begun_count_;
    monitor.report(0.37);
    while (!is_finishing_ && !monitor.isCanceled()) {
        changed_.wait_for(lock, std::chrono::milliseconds(5)); // a cancellation does not notify
    }
    if (monitor.isCanceled()) {
        ++stopped_count_;
        return Error{ErrorCode::Canceled, spec.path + ": preparing was canceled"};
    }
    if (failure_) {
        return *failure_;
    }
    if (!is_losing_) {
        prepared_.push_back(spec.path);
    }
    return Done{};
}

std::optional<Error> LargeMaps::beforeRead(const TileId& id)
{
    std::unique_lock lock(mutex_);
    if (QThread::currentThread() == QCoreApplication::instance()->thread()) {
        ++gui_read_count_;
        if (are_all_tiles_held_) {
            return Error{ErrorCode::Unreadable, "large.asc: read by the thread of the window"};
        }
    }
    changed_.wait(lock, [&] { return !are_all_tiles_held_ && (!are_tiles_held_ || id.level > 0); });
    return are_tiles_failing_ && id.level == 0
               ? std::optional(Error{ErrorCode::Unreadable, "large.asc: the disk is gone"})
               : std::nullopt;
}

Result<std::shared_ptr<const Map>>
LargeMaps::openTiled(const RasterSpec& spec, const MapResources& resources, JobMonitor& monitor)
{
    Result<std::shared_ptr<const Map>> whole = readMap(spec, monitor, std::size_t{1} << 30);
    if (!whole) {
        return whole;
    }
    const Heightfield& heightfield = (*whole)->heightfield();
    const auto source = std::make_shared<const test::GridTileSource>(
        heightfield,
        test::GridTileSource::Options{
            .mean_levels = 2, // as in any tiled file
            .before_read = [this](const TileId& id) { return beforeRead(id); }});
    auto tiles = TiledSamples::open(TiledRaster(*resources.tiles, source));
    if (!tiles) {
        return std::move(tiles).error();
    }
    MapLevels levels;
    levels.layout = source->layout();
    levels.statistics = statisticsOf(heightfield);
    levels.analysis = (*whole)->analysis();
    if (heightfield.samples().hasVoids()) {
        levels.filled_maxima_m = filledMaximaOf(*(*whole)->filled(), levels.analysis->bounds);
    }
    const SampleStatistics statistics = levels.statistics;
    return tiledMap(
        {.spec = spec,
         .file_info = (*whole)->fileInfo(),
         .info = (*whole)->info(),
         .statistics = statistics,
         .heightfield = Heightfield(std::move(*tiles), statistics, heightfield.scale())},
        std::make_shared<const MapLevels>(levels));
}

} // namespace marsview
