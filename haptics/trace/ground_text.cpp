#include "haptics/trace/ground_text.h"

#include "core/base/plain_number.h"

#include <charconv>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <limits>
#include <system_error>
#include <type_traits>

namespace marsview {
namespace {

struct Writer {
    std::string operator()(const GroundPart& part) const { return mapText("part", part); }
    std::string operator()(const GroundBelow& below) const { return mapText("below", below.map); }
    static std::string mapText(const char* kind, const GroundPart& part)
    {
        const SceneFrame& frame = part.frame;
        return fmt::format("{}/{}/{}/{}/{}/{}/{}/{}/{}/{}/{}/{}", kind, part.part, part.columns,
                           part.rows, asText(part.ellipsoid.equatorial_m),
                           asText(part.ellipsoid.polar_m), asText(frame.origin.column),
                           asText(frame.origin.row), asText(frame.east_per_column),
                           asText(frame.east_per_row), asText(frame.north_per_column),
                           asText(frame.north_per_row));
    }
    std::string operator()(const GroundLevel& level) const
    {
        const ShownTiles& shown = level.shown;
        return fmt::format("level/{}/{}/{}/{}/{}/{:x}{}", level.level, shown.first_column,
                           shown.first_row, shown.columns, shown.rows, shown.is_there,
                           indexText(level.map));
    }
    std::string operator()(const GroundTile& tile) const
    {
        return fmt::format("tile/{}/{}/{}/{}{}", tile.id.level, tile.id.column, tile.id.row,
                           asText(tile.weight), indexText(tile.map));
    }
    static std::string indexText(const std::optional<std::uint32_t>& map)
    {
        return map ? fmt::format("/{}", *map) : std::string();
    }
    std::string operator()(const GroundFelt& felt) const
    {
        return fmt::format("felt/{}", felt.changed_part);
    }
};

// Parses the numbers of a word in order; an invalid number makes the word invalid.
class Reader {
public:
    explicit Reader(std::string_view word)
        : rest_(word)
    {}

    std::string_view text()
    {
        if (is_at_end_) {
            is_fine_ = false;
            return {};
        }
        const std::size_t slash = rest_.find('/');
        const std::string_view result = rest_.substr(0, slash);
        is_at_end_ = slash == std::string_view::npos;
        rest_.remove_prefix(is_at_end_ ? rest_.size() : slash + 1);
        return result;
    }
    template <typename T>
    void take(T& value, int base = 10)
    {
        const std::string_view word = text();
        if constexpr (std::is_floating_point_v<T>) {
            const auto number = parseNumber(word);
            is_fine_ = is_fine_ && number.has_value();
            value = number.value_or(0.0);
        } else {
            const auto [end, error] =
                std::from_chars(word.data(), word.data() + word.size(), value, base);
            is_fine_ = is_fine_ && error == std::errc() && end == word.data() + word.size();
        }
    }
    template <typename T>
    void takeLast(std::optional<T>& value)
    {
        if (!is_at_end_) {
            take(value.emplace());
        }
    }
    bool isDone() const { return is_fine_ && is_at_end_; }

private:
    std::string_view rest_;
    bool is_at_end_ = false;
    bool is_fine_ = true;
};

std::optional<GroundRecord> parseRecord(std::string_view word)
{
    Reader reader(word);
    const std::string_view kind = reader.text();
    GroundRecord record;
    if (kind == "part" || kind == "below") {
        GroundPart part;
        SceneFrame& frame = part.frame;
        reader.take(part.part);
        reader.take(part.columns);
        reader.take(part.rows);
        for (double* value : {&part.ellipsoid.equatorial_m, &part.ellipsoid.polar_m,
                              &frame.origin.column, &frame.origin.row, &frame.east_per_column,
                              &frame.east_per_row, &frame.north_per_column, &frame.north_per_row}) {
            reader.take(*value);
        }
        record = kind == "part" ? GroundRecord(part) : GroundBelow{part};
        return reader.isDone() && frame.isSound() ? std::optional(record) : std::nullopt;
    } else if (kind == "level") {
        GroundLevel level;
        reader.take(level.level);
        reader.take(level.shown.first_column);
        reader.take(level.shown.first_row);
        reader.take(level.shown.columns);
        reader.take(level.shown.rows);
        reader.take(level.shown.is_there, 16);
        reader.takeLast(level.map);
        record = level;
    } else if (kind == "tile") {
        GroundTile tile;
        reader.take(tile.id.level);
        reader.take(tile.id.column);
        reader.take(tile.id.row);
        reader.take(tile.weight);
        reader.takeLast(tile.map);
        const bool is_weight = tile.weight >= 0.0 && tile.weight < 1.0;
        record = tile;
        return reader.isDone() && is_weight ? std::optional(record) : std::nullopt;
    } else if (kind == "felt") {
        GroundFelt felt;
        reader.take(felt.changed_part);
        record = felt;
    } else {
        return std::nullopt;
    }
    return reader.isDone() ? std::optional(record) : std::nullopt;
}

} // namespace

std::string groundText(const GroundRecord& record)
{
    return std::visit(Writer{}, record);
}

std::optional<std::vector<GroundRecord>> parseGround(std::string_view cell)
{
    std::vector<GroundRecord> records;
    while (!cell.empty()) {
        const std::size_t blank = cell.find(' ');
        const auto record = parseRecord(cell.substr(0, blank));
        if (!record) {
            return std::nullopt;
        }
        records.push_back(*record);
        cell.remove_prefix(blank == std::string_view::npos ? cell.size() : blank + 1);
    }
    return records;
}

} // namespace marsview
