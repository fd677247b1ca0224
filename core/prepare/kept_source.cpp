#include "core/prepare/kept_source.h"

#include "core/levels/level_file.h"

#include <filesystem>
#include <system_error>
#include <utility>

namespace marsview {
namespace {

class KeptSource final : public TileSource, public std::enable_shared_from_this<KeptSource> {
public:
    KeptSource(std::shared_ptr<const TileSource> source, KeptMap map)
        : source_(std::move(source))
        , map_(std::move(map))
        , made_(whenMade())
    {}

    const TileLayout& layout() const noexcept override { return source_->layout(); }
    const std::string& name() const noexcept override { return source_->name(); }

    Result<std::unique_ptr<TileReader>> open() const override
    {
        Result<std::unique_ptr<TileReader>> reader = source_->open();
        if (!reader) {
            return whenMade() == made_ ? std::move(reader)
                                       : Result<std::unique_ptr<TileReader>>(rebuiltError());
        }
        return std::unique_ptr<TileReader>(
            std::make_unique<Reader>(std::move(reader).value(), shared_from_this()));
    }

private:
    class Reader final : public TileReader {
    public:
        Reader(std::unique_ptr<TileReader> reader, std::shared_ptr<const KeptSource> source)
            : reader_(std::move(reader))
            , source_(std::move(source))
        {}

        Result<Tile> read(const TileId& id) override
        {
            Result<Tile> tile = reader_->read(id);
            if (!tile && isDamageToKept(tile.error(), source_->map_.is_copy) && isStillSo(id)) {
                // If it cannot be noted, the message alone has to suffice.
                static_cast<void>(
                    source_->map_.folder.noteDamage(source_->map_.path, tile.error().message));
            }
            return tile;
        }

    private:
        // A temporary lack of memory or files is not damage.
        bool isStillSo(const TileId& id) const
        {
            const Result<std::unique_ptr<TileReader>> again = source_->source_->open();
            return again && !(*again)->read(id);
        }

        std::unique_ptr<TileReader> reader_;
        std::shared_ptr<const KeptSource> source_;
    };

    // Open readers continue with the old files, and their checksums are still valid. New readers
    // would not match the rebuilt files, so opening one is an error.
    Error rebuiltError() const
    {
        return {ErrorCode::Invalid,
                name() +
                    ": was found damaged and has been rebuilt since it was opened; open it again"};
    }

    std::filesystem::file_time_type whenMade() const
    {
        std::error_code gone;
        return std::filesystem::last_write_time(LevelFile::pathFor(map_.path), gone);
    }

    std::shared_ptr<const TileSource> source_;
    KeptMap map_;
    std::filesystem::file_time_type made_; // of the level file, when this was opened
};

} // namespace

std::shared_ptr<const TileSource> keptSource(std::shared_ptr<const TileSource> source, KeptMap map)
{
    return std::make_shared<const KeptSource>(std::move(source), std::move(map));
}

bool isDamageToKept(const Error& error, bool is_copy)
{
    // Damaged levels report Invalid, a damaged raster Unreadable.
    return error.code == ErrorCode::Invalid || (is_copy && error.code == ErrorCode::Unreadable);
}

} // namespace marsview
