#include "core/tiles/tile_disk_cache.h"

#include "core/tiles/tile_file.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <mutex>
#include <span>
#include <string_view>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

namespace marsview {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExtension = ".tile";
constexpr const char* kUnfinished = ".part";
// A temporary file older than this is left over from a program that ended.
constexpr std::chrono::hours kUnfinishedFor{1};
// After a write error, this many tiles are skipped before the next attempt.
constexpr int kPause = 64;
// How long a tile counts as recently used: marking every use would write on every read.
constexpr std::chrono::minutes kUseResolution{1};

class File {
public:
    File(const std::string& path, int flags)
        : descriptor_(open(path.c_str(), flags | O_CLOEXEC, 0644))
    {}
    ~File()
    {
        if (descriptor_ >= 0) {
            close(descriptor_);
        }
    }
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    int get() const { return descriptor_; }
    bool isOpen() const { return descriptor_ >= 0; }
    bool write(std::span<const std::byte> bytes) const
    {
        while (!bytes.empty()) {
            const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
            if (count < 0 && errno == EINTR) {
                continue;
            }
            if (count <= 0) {
                return false;
            }
            bytes = bytes.subspan(static_cast<std::size_t>(count));
        }
        return true;
    }
    /// Shorter than requested only at the end of the file.
    std::size_t read(std::span<std::byte> bytes) const
    {
        std::size_t done = 0;
        while (done < bytes.size()) {
            const ssize_t count = ::read(descriptor_, bytes.data() + done, bytes.size() - done);
            if (count < 0 && errno == EINTR) {
                continue;
            }
            if (count <= 0) {
                break;
            }
            done += static_cast<std::size_t>(count);
        }
        return done;
    }

private:
    int descriptor_;
};

// FNV-1a. Names the folder of a source; the key itself is in every file.
std::uint64_t hashOf(std::string_view text)
{
    std::uint64_t hash = 0xCBF29CE484222325ULL;
    for (const char c : text) {
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3ULL;
    }
    return hash;
}

struct KeptFile {
    fs::path path;
    fs::file_time_type used;
    std::uint64_t bytes = 0;
};

// Tiles of all programs, finished or not. Files that disappear during the scan are skipped.
std::vector<KeptFile> filesIn(const std::string& folder)
{
    std::vector<KeptFile> files;
    std::error_code ignored;
    for (fs::recursive_directory_iterator entry(folder, ignored), end; !ignored && entry != end;
         entry.increment(ignored)) {
        std::error_code gone;
        const fs::path& path = entry->path();
        if ((path.extension() != kExtension && path.extension() != kUnfinished) ||
            !entry->is_regular_file(gone) || gone) {
            continue;
        }
        KeptFile file{path, entry->last_write_time(gone), 0};
        if (!gone) {
            file.bytes = entry->file_size(gone);
        }
        if (!gone) {
            files.push_back(std::move(file));
        }
    }
    return files;
}

// Removes the file, and its folder if it becomes empty.
bool removeFile(const fs::path& path, std::error_code& failure)
{
    const bool is_removed = fs::remove(path, failure);
    std::error_code ignored;
    if (fs::is_empty(path.parent_path(), ignored) && !ignored) {
        fs::remove(path.parent_path(), ignored);
    }
    return is_removed;
}

} // namespace

struct TileDiskCache::Impl {
    explicit Impl(TileDiskCacheOptions chosen)
        : options_now(std::move(chosen))
    {}

    std::atomic<std::uint64_t> found{0};
    std::atomic<std::uint64_t> missed{0};
    std::atomic<std::uint64_t> damaged{0};
    std::atomic<std::uint64_t> written{0};
    std::atomic<std::uint64_t> removed{0};
    std::atomic<int> pause{0};               // tiles to skip before the next write
    std::atomic<std::uint64_t> temporary{0}; // for names

    mutable std::mutex settings_mutex; // for the next two; held only briefly
    TileDiskCacheOptions options_now;
    std::optional<std::string> trouble;

    std::mutex count_mutex;          // for the following; held while old files are removed
    std::string counted_folder;      // empty: not counted yet
    std::uint64_t bytes_counted = 0; // in the folder at the last count
    std::uint64_t bytes_since = 0;   // written since then

    TileDiskCacheOptions options() const
    {
        const std::lock_guard lock(settings_mutex);
        return options_now;
    }

    std::optional<Tile> load(const std::string& path,
                             const TileId& id,
                             const TileLayout& layout,
                             const std::string& key);
    void store(const std::string& folder,
               const std::string& name,
               const Tile& tile,
               const std::string& key);
    void refuse(int error);
    void countIn(std::uint64_t bytes);
    void trim(const TileDiskCacheOptions& options);
};

std::optional<Tile> TileDiskCache::Impl::load(const std::string& path,
                                              const TileId& id,
                                              const TileLayout& layout,
                                              const std::string& key)
{
    const File file(path, O_RDONLY);
    struct stat status {};
    if (!file.isOpen() || fstat(file.get(), &status) != 0) {
        ++missed;
        return std::nullopt;
    }
    DecodedTileFile decoded;
    if (status.st_size > 0 && static_cast<std::size_t>(status.st_size) <= kTileFileBytesMax) {
        std::vector<std::byte> bytes(static_cast<std::size_t>(status.st_size));
        bytes.resize(file.read(bytes));
        decoded = decodeTileFile(bytes, id, layout, key);
    }
    if (decoded.state == TileFileState::Damaged) {
        ++damaged;
        unlink(path.c_str());
    }
    if (decoded.state != TileFileState::Good) {
        ++missed;
        return std::nullopt;
    }
    ++found;
    const auto age = std::chrono::system_clock::now() -
                     std::chrono::system_clock::from_time_t(status.st_mtim.tv_sec);
    if (age > kUseResolution) {
        futimens(file.get(), nullptr); // now; if not permitted, files age by creation
    }
    return std::move(decoded.tile);
}

void TileDiskCache::Impl::refuse(int error)
{
    pause = kPause;
    const std::lock_guard lock(settings_mutex);
    if (!trouble) {
        trouble = fmt::format(
            "{}: downloaded tiles cannot be cached here ({}) and will be "
            "downloaded again; free space or choose another folder",
            options_now.folder, std::generic_category().message(error));
    }
}

void TileDiskCache::Impl::store(const std::string& folder,
                                const std::string& name,
                                const Tile& tile,
                                const std::string& key)
{
    if (pause > 0) {
        --pause;
        return;
    }
    const std::vector<std::byte> bytes = encodeTileFile(tile, key);
    if (bytes.empty() || bytes.size() > options().bytes_max) {
        return;
    }
    std::error_code failure;
    fs::create_directories(folder, failure);
    if (failure) {
        return refuse(failure.value());
    }
    const std::string unfinished =
        fmt::format("{}/{}-{}-{}{}", folder, name, getpid(), ++temporary, kUnfinished);
    {
        const File file(unfinished, O_WRONLY | O_CREAT | O_EXCL);
        if (!file.isOpen()) {
            // Another program may have removed the folder just now: that is harmless.
            return errno == ENOENT ? void() : refuse(errno);
        }
        if (!file.write(bytes)) {
            const int error = errno;
            unlink(unfinished.c_str());
            return refuse(error);
        }
    }
    const std::string path = fmt::format("{}/{}{}", folder, name, kExtension);
    if (rename(unfinished.c_str(), path.c_str()) != 0) {
        const int error = errno;
        unlink(unfinished.c_str());
        return error == ENOENT ? void() : refuse(error);
    }
    ++written;
    countIn(bytes.size());
}

void TileDiskCache::Impl::countIn(std::uint64_t bytes)
{
    TileDiskCacheOptions now;
    {
        const std::lock_guard lock(settings_mutex);
        trouble.reset();
        now = options_now;
    }
    const std::lock_guard lock(count_mutex);
    bytes_since += bytes;
    if (counted_folder != now.folder || bytes_counted + bytes_since > now.bytes_max ||
        bytes_since > now.bytes_max / 16) {
        trim(now);
    }
}

// Counts all files, including those of other programs, and removes the least recently used ones.
// The caller holds the lock.
void TileDiskCache::Impl::trim(const TileDiskCacheOptions& options)
{
    std::vector<KeptFile> files = filesIn(options.folder);
    const fs::file_time_type now = fs::file_time_type::clock::now();
    std::uint64_t bytes = 0;
    std::error_code gone; // if another program removed it
    std::erase_if(files, [&](const KeptFile& file) {
        if (file.path.extension() == kExtension) {
            bytes += file.bytes;
            return false;
        }
        if (now - file.used > kUnfinishedFor) {
            fs::remove(file.path, gone);
        }
        return true;
    });
    if (bytes > options.bytes_max) {
        std::sort(files.begin(), files.end(),
                  [](const KeptFile& a, const KeptFile& b) { return a.used < b.used; });
        // Some spare room, so that not every tile causes a trim.
        const std::uint64_t wanted = options.bytes_max - options.bytes_max / 8;
        for (const KeptFile& file : files) {
            if (bytes <= wanted) {
                break;
            }
            removed += removeFile(file.path, gone) ? 1U : 0U;
            bytes -= file.bytes;
        }
    }
    counted_folder = options.folder;
    bytes_counted = bytes;
    bytes_since = 0;
}

KeptTiles keptTilesIn(const std::string& folder)
{
    KeptTiles kept;
    for (const KeptFile& file : filesIn(folder)) {
        kept.count += file.path.extension() == kExtension ? 1U : 0U;
        kept.bytes += file.bytes;
    }
    return kept;
}

Status removeKeptTiles(const std::string& folder)
{
    for (const KeptFile& file : filesIn(folder)) {
        std::error_code failure;
        removeFile(file.path, failure);
        if (failure) {
            return Error{ErrorCode::Unreadable, fmt::format("{}: cannot be removed ({})",
                                                            file.path.string(), failure.message())};
        }
    }
    return Done{};
}

TileDiskCache::TileDiskCache(const TileDiskCacheOptions& options)
    : impl_(std::make_unique<Impl>(options))
{}

TileDiskCache::~TileDiskCache() = default;

TileDiskCacheStatistics TileDiskCache::statistics() const
{
    return {.found = impl_->found,
            .missed = impl_->missed,
            .damaged = impl_->damaged,
            .written = impl_->written,
            .removed = impl_->removed};
}

std::optional<std::string> TileDiskCache::trouble() const
{
    const std::lock_guard lock(impl_->settings_mutex);
    return impl_->trouble;
}

std::string TileDiskCache::folder() const
{
    return impl_->options().folder;
}

void TileDiskCache::setFolder(const std::string& folder)
{
    const std::lock_guard lock(impl_->settings_mutex);
    if (folder != impl_->options_now.folder) {
        impl_->options_now.folder = folder;
        impl_->trouble.reset();
        impl_->pause = 0;
    }
}

std::uint64_t TileDiskCache::bytesMax() const
{
    return impl_->options().bytes_max;
}

void TileDiskCache::setBytesMax(std::uint64_t bytes_max)
{
    const std::lock_guard lock(impl_->settings_mutex);
    impl_->options_now.bytes_max = bytes_max;
}

class DiskCachedReader final : public TileReader {
public:
    DiskCachedReader(std::shared_ptr<const TileSource> source,
                     std::shared_ptr<TileDiskCache> cache,
                     std::string key)
        : source_(std::move(source))
        , cache_(std::move(cache))
        , key_(std::move(key))
        , folder_name_(fmt::format("{:016x}", hashOf(key_)))
    {}

    Result<Tile> read(const TileId& id) override
    {
        const std::string name = fmt::format("{}{}-{}-{}", id.kind == TileKind::Means ? 'm' : 's',
                                             id.level, id.column, id.row);
        TileDiskCache::Impl& cache = *cache_->impl_;
        const std::string folder = cache.options().folder + '/' + folder_name_;
        if (std::optional<Tile> tile = cache.load(fmt::format("{}/{}{}", folder, name, kExtension),
                                                  id, source_->layout(), key_)) {
            return std::move(*tile);
        }
        if (!reader_) {
            Result<std::unique_ptr<TileReader>> opened = source_->open();
            if (!opened) {
                return std::move(opened).error();
            }
            reader_ = std::move(opened).value();
        }
        Result<Tile> tile = reader_->read(id);
        if (tile) {
            cache.store(folder, name, *tile, key_);
        }
        return tile;
    }

private:
    std::shared_ptr<const TileSource> source_;
    std::shared_ptr<TileDiskCache> cache_;
    std::string key_;
    std::string folder_name_;
    std::unique_ptr<TileReader> reader_; // null as long as all tiles were on disk
};

namespace {

class DiskCachedSource final : public TileSource {
public:
    DiskCachedSource(std::shared_ptr<const TileSource> source,
                     std::shared_ptr<TileDiskCache> cache,
                     std::string key)
        : source_(std::move(source))
        , cache_(std::move(cache))
        , key_(std::move(key))
    {}

    const TileLayout& layout() const noexcept override { return source_->layout(); }
    const std::string& name() const noexcept override { return source_->name(); }
    Result<std::unique_ptr<TileReader>> open() const override
    {
        return std::unique_ptr<TileReader>(
            std::make_unique<DiskCachedReader>(source_, cache_, key_));
    }

private:
    std::shared_ptr<const TileSource> source_;
    std::shared_ptr<TileDiskCache> cache_;
    std::string key_;
};

} // namespace

std::shared_ptr<const TileSource> cachedOnDisk(std::shared_ptr<const TileSource> source,
                                               std::shared_ptr<TileDiskCache> cache,
                                               const std::string& key)
{
    const TileLayout& layout = source->layout();
    std::string whole = fmt::format("{}\n{} {} {} {}", key, layout.columns, layout.rows,
                                    sampleTypeName(layout.type), kTileSide);
    return std::make_shared<const DiskCachedSource>(std::move(source), std::move(cache),
                                                    std::move(whole));
}

} // namespace marsview
