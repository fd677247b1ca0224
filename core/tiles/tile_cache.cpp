#include "core/tiles/tile_cache.h"

#include "core/base/check.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <list>
#include <mutex>
#include <stop_token>
#include <thread>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace marsview {
namespace {

using Clock = std::chrono::steady_clock;

// A failed tile is retried after this long, then after twice as long, and so on: a server usually
// recovers soon, and a failing disk must not be hammered.
constexpr std::chrono::milliseconds kFirstPause{100};
constexpr std::chrono::milliseconds kLongestPause{10'000};

struct Key {
    std::uint64_t raster = 0;
    TileId id;
    bool operator==(const Key&) const = default;
};

struct KeyHash {
    std::size_t operator()(const Key& key) const noexcept
    {
        return TileIdHash{}(key.id) ^ static_cast<std::size_t>(key.raster * 0x9E3779B97F4A7C15ULL);
    }
};

struct Failure {
    Error error;
    int attempts = 0;
    Clock::time_point retry_at;
};

} // namespace

// The state of one raster in the cache. Lives as long as a TiledRaster refers to it.
struct TiledRasterState {
    std::shared_ptr<TileCache::Impl> cache;
    std::uint64_t number = 0;
    std::atomic<std::uint64_t> generation{0};

    TiledRasterState(std::shared_ptr<TileCache::Impl> shared,
                     std::shared_ptr<const TileSource> source);
    ~TiledRasterState();
    TiledRasterState(const TiledRasterState&) = delete;
    TiledRasterState& operator=(const TiledRasterState&) = delete;
};

struct TileRequests::Impl {
    TiledRaster raster; // keeps it alive
    TileUrgency urgency;
    std::function<void()> notify;
    // The following are guarded by the cache's mutex.
    std::vector<TileId> requested;
    std::size_t first_open = 0; // all requested tiles before this one are resident
    int notifications = 0;      // running
};

struct TileCache::Impl {
    // The idle readers of a raster.
    struct Source {
        std::shared_ptr<const TileSource> source;
        std::vector<std::unique_ptr<TileReader>> readers;
        TiledRasterState* state = nullptr;
    };
    struct Entry {
        std::shared_ptr<const Tile> tile;
        std::list<Key>::iterator use;
    };

    mutable std::mutex mutex;
    std::condition_variable_any has_work;
    std::condition_variable has_result;

    std::size_t bytes_max = 0;
    TileCacheStatistics statistics;
    std::uint64_t next_raster = 1;
    std::unordered_map<std::uint64_t, Source> sources;
    std::unordered_map<Key, Entry, KeyHash> entries;
    std::list<Key> uses; // most recently used first
    std::unordered_set<Key, KeyHash> in_work;
    std::unordered_map<Key, Failure, KeyHash> failures;
    std::vector<TileRequests::Impl*> requests;

    // Call all of the following with the mutex locked.

    std::shared_ptr<const Tile> use(const Key& key)
    {
        const auto known = entries.find(key);
        if (known == entries.end()) {
            return nullptr;
        }
        uses.splice(uses.begin(), uses, known->second.use);
        return known->second.tile;
    }

    void keep(const Key& key, std::shared_ptr<const Tile> tile)
    {
        statistics.bytes_held += tile->bytes();
        uses.push_front(key);
        entries[key] = {.tile = std::move(tile), .use = uses.begin()};
        failures.erase(key);
        evict();
    }

    void forget(std::unordered_map<Key, Entry, KeyHash>::iterator entry)
    {
        statistics.bytes_held -= entry->second.tile->bytes();
        uses.erase(entry->second.use);
        entries.erase(entry);
    }

    // Tiles in use elsewhere stay: evicting them would free no memory.
    void evict()
    {
        auto oldest = uses.end();
        while (statistics.bytes_held > bytes_max && oldest != uses.begin()) {
            --oldest;
            const auto entry = entries.find(*oldest);
            if (entry->second.tile.use_count() > 1) {
                continue;
            }
            const auto next = std::next(oldest);
            forget(entry);
            ++statistics.evicted;
            oldest = next;
        }
    }

    // The most urgent tile that can be loaded now, at least as urgent as `least`. If there is none,
    // `wake_at` is the time of the next retry.
    std::optional<Key> next(TileUrgency least, std::optional<Clock::time_point>& wake_at)
    {
        const Clock::time_point now = Clock::now();
        for (const TileUrgency urgency :
             {TileUrgency::Hand, TileUrgency::View, TileUrgency::Ahead}) {
            if (urgency > least) {
                break;
            }
            for (TileRequests::Impl* request : requests) {
                if (request->urgency != urgency) {
                    continue;
                }
                bool is_open = false;
                for (std::size_t i = request->first_open; i < request->requested.size(); ++i) {
                    const Key key{request->raster.number_, request->requested[i]};
                    if (entries.contains(key)) {
                        request->first_open = is_open ? request->first_open : i + 1;
                        continue;
                    }
                    is_open = true;
                    if (in_work.contains(key)) {
                        continue;
                    }
                    const auto failure = failures.find(key);
                    if (failure != failures.end() && failure->second.retry_at > now) {
                        wake_at = std::min(wake_at.value_or(failure->second.retry_at),
                                           failure->second.retry_at);
                        continue;
                    }
                    return key;
                }
            }
        }
        return std::nullopt;
    }

    // Reads one tile with the mutex unlocked, and stores it or its error. No other thread may be
    // loading the tile.
    Result<std::shared_ptr<const Tile>> load(const Key& key, std::unique_lock<std::mutex>& lock)
    {
        Source& source = sources.at(key.raster);
        const std::shared_ptr<const TileSource> opened = source.source;
        std::unique_ptr<TileReader> reader;
        if (!source.readers.empty()) {
            reader = std::move(source.readers.back());
            source.readers.pop_back();
        }
        in_work.insert(key);
        lock.unlock();
        Result<std::shared_ptr<const Tile>> outcome = readTile(*opened, reader, key.id);
        lock.lock();
        in_work.erase(key);
        // The raster may have been removed during the read.
        const auto known = sources.find(key.raster);
        if (outcome) {
            ++statistics.loaded;
            if (known != sources.end()) {
                keep(key, *outcome);
                known->second.state->generation.fetch_add(1, std::memory_order_release);
            }
        } else {
            ++statistics.failed;
            if (known != sources.end()) {
                Failure& failure = failures[key];
                const auto pause =
                    std::min(kLongestPause, kFirstPause * (1 << std::min(failure.attempts, 10)));
                failure = {.error = outcome.error(),
                           .attempts = failure.attempts + 1,
                           .retry_at = Clock::now() + pause};
            }
        }
        if (known != sources.end() && reader) {
            known->second.readers.push_back(std::move(reader));
        }
        has_result.notify_all();
        return outcome;
    }

    // Call without the mutex. A reader that failed is not reused, because its open file may be in a
    // bad state.
    static Result<std::shared_ptr<const Tile>>
    readTile(const TileSource& source, std::unique_ptr<TileReader>& reader, const TileId& id)
    {
        try {
            if (!reader) {
                Result<std::unique_ptr<TileReader>> opened = source.open();
                if (!opened) {
                    return std::move(opened).error();
                }
                reader = std::move(opened).value();
            }
            Result<Tile> tile = reader->read(id);
            if (!tile) {
                reader.reset();
                return std::move(tile).error();
            }
            return std::make_shared<const Tile>(std::move(tile).value());
        } catch (const std::bad_alloc&) {
            reader.reset();
            return Error{ErrorCode::TooLarge,
                         source.name() + ": not enough memory for a tile of it"};
        } catch (const std::exception& exception) {
            reader.reset();
            return Error{ErrorCode::Unreadable, source.name() + ": " + exception.what()};
        }
    }

    void notifyRequests(const Key& key, std::unique_lock<std::mutex>& lock)
    {
        std::vector<TileRequests::Impl*> affected;
        for (TileRequests::Impl* request : requests) {
            if (request->notify && request->raster.number_ == key.raster &&
                std::find(request->requested.begin(), request->requested.end(), key.id) !=
                    request->requested.end()) {
                ++request->notifications;
                affected.push_back(request);
            }
        }
        lock.unlock();
        for (TileRequests::Impl* request : affected) {
            request->notify();
        }
        lock.lock();
        for (TileRequests::Impl* request : affected) {
            --request->notifications;
        }
        if (!affected.empty()) {
            has_result.notify_all();
        }
    }

    void run(const std::stop_token& stop, TileUrgency least)
    {
        std::unique_lock lock(mutex);
        while (!stop.stop_requested()) {
            std::optional<Clock::time_point> wake_at;
            const std::optional<Key> key = next(least, wake_at);
            if (key) {
                // The result is in the cache or among the failures.
                static_cast<void>(load(*key, lock));
                notifyRequests(*key, lock);
            } else if (wake_at) {
                has_work.wait_until(lock, stop, *wake_at, [] { return false; });
            } else {
                std::optional<Clock::time_point> ignored;
                has_work.wait(lock, stop, [&] {
                    return next(least, ignored).has_value() || ignored.has_value();
                });
            }
        }
    }

    bool isMissing(const TileRequests::Impl& request, const TileId& id) const
    {
        const Key key{request.raster.number_, id};
        return !entries.contains(key) && (!failures.contains(key) || in_work.contains(key));
    }
};

TiledRasterState::TiledRasterState(std::shared_ptr<TileCache::Impl> shared,
                                   std::shared_ptr<const TileSource> source)
    : cache(std::move(shared))
{
    const std::lock_guard lock(cache->mutex);
    number = cache->next_raster++;
    cache->sources[number] = {.source = std::move(source), .readers = {}, .state = this};
}

TiledRasterState::~TiledRasterState()
{
    std::vector<std::unique_ptr<TileReader>> closed; // destroyed without the lock
    const std::lock_guard lock(cache->mutex);
    for (auto entry = cache->entries.begin(); entry != cache->entries.end();) {
        const auto next = std::next(entry);
        if (entry->first.raster == number) {
            cache->forget(entry);
        }
        entry = next;
    }
    std::erase_if(cache->failures,
                  [this](const auto& item) { return item.first.raster == number; });
    closed = std::move(cache->sources.at(number).readers);
    cache->sources.erase(number);
}

// The loader threads of a cache.
struct TileCache::Loaders {
    Loaders(const std::shared_ptr<Impl>& impl, std::size_t count)
    {
        for (std::size_t i = 0; i < count; ++i) {
            start(impl, TileUrgency::Ahead);
        }
        // One more for TileUrgency::Hand only: all others may be waiting for a slow server.
        if (count > 1) {
            start(impl, TileUrgency::Hand);
        }
    }
    // Stops all threads at once: their destructors alone would stop and join them one by one.
    ~Loaders()
    {
        for (std::jthread& thread : threads_) {
            thread.request_stop();
        }
    }
    Loaders(const Loaders&) = delete;
    Loaders& operator=(const Loaders&) = delete;

private:
    void start(const std::shared_ptr<Impl>& impl, TileUrgency least)
    {
        threads_.emplace_back(
            [impl, least](const std::stop_token& stop) { impl->run(stop, least); });
    }

    std::vector<std::jthread> threads_;
};

TileCache::TileCache(const TileCacheOptions& options)
    : impl_(std::make_shared<Impl>())
{
    MARSVIEW_CHECK(options.loader_threads > 0);
    impl_->bytes_max = options.bytes_max;
    loaders_ = std::make_shared<Loaders>(impl_, options.loader_threads);
}

TileCache::~TileCache() = default;

std::size_t TileCache::bytesMax() const
{
    const std::lock_guard lock(impl_->mutex);
    return impl_->bytes_max;
}

void TileCache::setBytesMax(std::size_t bytes_max)
{
    const std::lock_guard lock(impl_->mutex);
    impl_->bytes_max = bytes_max;
    impl_->evict();
}

TileCacheStatistics TileCache::statistics() const
{
    const std::lock_guard lock(impl_->mutex);
    return impl_->statistics;
}

void TileCache::clear()
{
    const std::lock_guard lock(impl_->mutex);
    impl_->statistics.bytes_held = 0;
    impl_->entries.clear();
    impl_->uses.clear();
    impl_->failures.clear();
    for (TileRequests::Impl* request : impl_->requests) {
        request->first_open = 0;
    }
    impl_->has_work.notify_all();
}

TiledRaster::TiledRaster(const TileCache& cache, std::shared_ptr<const TileSource> source)
    : TiledRaster(cache.impl_, cache.loaders_, std::move(source))
{}

TiledRaster TiledRaster::with(std::shared_ptr<const TileSource> source) const
{
    return {cache_, loaders_, std::move(source)};
}

TiledRaster::TiledRaster(std::shared_ptr<TileCache::Impl> cache,
                         std::shared_ptr<TileCache::Loaders> loaders,
                         std::shared_ptr<const TileSource> source)
    : cache_(std::move(cache))
    , loaders_(std::move(loaders))
    , source_(std::move(source))
{
    MARSVIEW_CHECK(source_ != nullptr);
    state_ = std::make_shared<TiledRasterState>(cache_, source_);
    number_ = state_->number;
}

std::shared_ptr<const Tile> TiledRaster::find(const TileId& id) const
{
    const std::lock_guard lock(cache_->mutex);
    return cache_->use({number_, id});
}

Result<std::shared_ptr<const Tile>> TiledRaster::get(const TileId& id) const
{
    MARSVIEW_CHECK(layout().contains(id));
    const Key key{number_, id};
    std::unique_lock lock(cache_->mutex);
    cache_->has_result.wait(lock, [&] { return !cache_->in_work.contains(key); });
    if (std::shared_ptr<const Tile> tile = cache_->use(key)) {
        return tile;
    }
    Result<std::shared_ptr<const Tile>> outcome = cache_->load(key, lock);
    cache_->notifyRequests(key, lock);
    return outcome;
}

std::optional<Error> TiledRaster::failure(const TileId& id) const
{
    const std::lock_guard lock(cache_->mutex);
    const auto known = cache_->failures.find({number_, id});
    return known == cache_->failures.end() ? std::nullopt : std::optional(known->second.error);
}

std::uint64_t TiledRaster::generation() const noexcept
{
    return state_->generation.load(std::memory_order_acquire);
}

TileRequests::TileRequests(const TiledRaster& raster,
                           TileUrgency urgency,
                           std::function<void()> notify)
    : impl_(std::make_shared<Impl>(
          Impl{.raster = raster, .urgency = urgency, .notify = std::move(notify), .requested = {}}))
{
    TileCache::Impl& cache = *raster.cache_;
    const std::lock_guard lock(cache.mutex);
    cache.requests.push_back(impl_.get());
}

TileRequests::~TileRequests()
{
    TileCache::Impl& cache = *impl_->raster.cache_;
    std::unique_lock lock(cache.mutex);
    std::erase(cache.requests, impl_.get());
    cache.has_result.wait(lock, [this] { return impl_->notifications == 0; });
}

void TileRequests::request(std::span<const TileId> tiles)
{
    TileCache::Impl& cache = *impl_->raster.cache_;
    {
        const std::lock_guard lock(cache.mutex);
        const std::unordered_set<TileId, TileIdHash> still(tiles.begin(), tiles.end());
        for (const TileId& id : impl_->requested) {
            const Key key{impl_->raster.number_, id};
            if (!still.contains(id) && !cache.entries.contains(key) &&
                !cache.in_work.contains(key)) {
                ++cache.statistics.canceled;
            }
        }
        impl_->requested.assign(tiles.begin(), tiles.end());
        impl_->first_open = 0;
        // The most urgent are marked as used last, so that they stay the longest.
        for (auto id = tiles.rbegin(); id != tiles.rend(); ++id) {
            MARSVIEW_CHECK(impl_->raster.layout().contains(*id));
            cache.use({impl_->raster.number_, *id});
        }
    }
    cache.has_work.notify_all();
}

void TileRequests::waitForPending() const
{
    TileCache::Impl& cache = *impl_->raster.cache_;
    std::unique_lock lock(cache.mutex);
    cache.has_result.wait(lock, [&] {
        return std::none_of(impl_->requested.begin(), impl_->requested.end(),
                            [&](const TileId& id) { return cache.isMissing(*impl_, id); });
    });
}

std::size_t TileRequests::missingCount() const
{
    TileCache::Impl& cache = *impl_->raster.cache_;
    const std::lock_guard lock(cache.mutex);
    return static_cast<std::size_t>(
        std::count_if(impl_->requested.begin(), impl_->requested.end(),
                      [&](const TileId& id) { return cache.isMissing(*impl_, id); }));
}

} // namespace marsview
