#include "core/session/annotations.h"

#include "core/names/search_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <span>
#include <string_view>
#include <utility>

namespace marsview {
namespace {

constexpr std::size_t kChunkSize = 1024;

std::optional<std::size_t> fieldNamed(const std::vector<FeatureField>& fields,
                                      std::initializer_list<std::string_view> names)
{
    for (const std::string_view name : names) {
        const auto found =
            std::find_if(fields.begin(), fields.end(), [name](const FeatureField& field) {
                return searchText(field.name) == name;
            });
        if (found != fields.end()) {
            return static_cast<std::size_t>(found - fields.begin());
        }
    }
    return std::nullopt;
}

std::string textOf(const FieldValue& value)
{
    if (const auto* text = std::get_if<std::string>(&value)) {
        return *text;
    }
    if (const auto* whole = std::get_if<std::int64_t>(&value)) {
        return fmt::format("{}", *whole);
    }
    const auto* real = std::get_if<double>(&value);
    return real != nullptr ? fmt::format("{}", *real) : std::string();
}

std::optional<Rgb8> colorOf(const std::string& text)
{
    constexpr std::size_t kLength = 7;
    std::uint32_t bits = 0;
    if (text.size() != kLength || text.front() != '#' ||
        std::from_chars(text.data() + 1, text.data() + kLength, bits, 16).ptr !=
            text.data() + kLength) {
        return std::nullopt;
    }
    return Rgb8{static_cast<std::uint8_t>(bits >> 16), static_cast<std::uint8_t>(bits >> 8),
                static_cast<std::uint8_t>(bits)};
}

bool areDegrees(const FeatureCollection& content)
{
    for (const FeatureLayer& layer : content.layers) {
        for (const Feature& feature : layer.features) {
            for (const FeaturePart& part : feature.parts) {
                if (!std::all_of(part.points.begin(), part.points.end(), [](const MapPoint& p) {
                        return std::abs(p.x) <= 360.0 && std::abs(p.y) <= 90.0;
                    })) {
                    return false;
                }
            }
        }
    }
    return true;
}

// The CRS of coordinates in a file without one.
std::optional<Crs> assumedCrs(const FeatureCollection& content, const std::optional<Crs>& map_crs)
{
    if (map_crs && map_crs->body() != nullptr && map_crs->ellipsoid() && areDegrees(content)) {
        return Crs::geographic(*map_crs->body(), *map_crs->ellipsoid());
    }
    return map_crs;
}

bool isSameSource(const std::optional<Crs>& a, const std::optional<Crs>& b)
{
    return a.has_value() == b.has_value() && (!a || a->wkt() == b->wkt());
}

} // namespace

// The last chunk that does not begin after `id`; the number of chunks if there is none.
std::size_t AnnotationList::chunkOf(std::uint32_t id) const
{
    const auto after = std::partition_point(
        chunks_.begin(), chunks_.end(),
        [id](const std::shared_ptr<const Chunk>& chunk) { return chunk->front().id <= id; });
    return after == chunks_.begin() ? chunks_.size()
                                    : static_cast<std::size_t>(after - chunks_.begin()) - 1;
}

const Annotation* AnnotationList::find(std::uint32_t id) const
{
    const std::size_t chunk = chunkOf(id);
    if (chunk == chunks_.size()) {
        return nullptr;
    }
    const auto at = std::partition_point(chunks_[chunk]->begin(), chunks_[chunk]->end(),
                                         [id](const Annotation& a) { return a.id < id; });
    return at != chunks_[chunk]->end() && at->id == id ? &*at : nullptr;
}

void AnnotationList::forEach(const std::function<void(const Annotation&)>& visit) const
{
    for (const auto& chunk : chunks_) {
        std::for_each(chunk->begin(), chunk->end(), visit);
    }
}

AnnotationList AnnotationList::withAdded(std::vector<Annotation> added) const
{
    AnnotationList list = *this;
    std::shared_ptr<Chunk> chunk;
    if (!added.empty() && !chunks_.empty() && chunks_.back()->size() < kChunkSize) {
        chunk = std::make_shared<Chunk>(*chunks_.back());
        list.chunks_.back() = chunk;
    }
    for (Annotation& annotation : added) {
        if (!chunk || chunk->size() == kChunkSize) {
            chunk = std::make_shared<Chunk>();
            list.chunks_.push_back(chunk);
        }
        annotation.id = list.next_id_++;
        chunk->push_back(std::move(annotation));
        ++list.size_;
    }
    return list;
}

AnnotationList AnnotationList::withReplaced(Annotation annotation) const
{
    if (find(annotation.id) == nullptr) {
        return *this;
    }
    AnnotationList list = *this;
    auto& place = list.chunks_[chunkOf(annotation.id)];
    auto chunk = std::make_shared<Chunk>(*place);
    const auto at = std::find_if(chunk->begin(), chunk->end(),
                                 [&](const Annotation& a) { return a.id == annotation.id; });
    *at = std::move(annotation);
    place = std::move(chunk);
    return list;
}

AnnotationList AnnotationList::without(const std::set<std::uint32_t>& ids) const
{
    AnnotationList list = *this;
    list.size_ = 0;
    for (auto& place : list.chunks_) {
        const auto first = ids.lower_bound(place->front().id);
        if (first != ids.end() && *first <= place->back().id) {
            auto chunk = std::make_shared<Chunk>(*place);
            std::erase_if(*chunk, [&](const Annotation& a) { return ids.contains(a.id); });
            place = std::move(chunk);
        }
        list.size_ += place->size();
    }
    std::erase_if(list.chunks_, [](const auto& chunk) { return chunk->empty(); });
    return list;
}

std::vector<Annotation> annotationsOf(VectorFile file,
                                      const std::string& source_name,
                                      const std::optional<Crs>& map_crs,
                                      const Rgb8& color)
{
    const std::optional<Crs> crs =
        file.content.crs ? file.content.crs : assumedCrs(file.content, map_crs);
    std::vector<Annotation> annotations;
    for (FeatureLayer& layer : file.content.layers) {
        const auto name_field =
            fieldNamed(layer.fields, {"name", "feature_name", "clean_name", "title", "label"});
        const auto note_field =
            fieldNamed(layer.fields, {"note", "description", "comment", "remarks"});
        const auto color_field = fieldNamed(layer.fields, {"color"});
        AnnotationSource source{.name = source_name, .crs = crs};
        std::vector<std::size_t> kept;
        for (std::size_t i = 0; i < layer.fields.size(); ++i) {
            if (i != name_field && i != note_field && i != color_field) {
                kept.push_back(i);
                source.fields.push_back(layer.fields[i]);
            }
        }
        const auto shared = std::make_shared<const AnnotationSource>(std::move(source));
        for (Feature& feature : layer.features) {
            Annotation annotation{.color = color,
                                  .shape = feature.shape,
                                  .parts = std::move(feature.parts),
                                  .source = shared};
            const auto text = [&](const std::optional<std::size_t>& field) {
                return field ? textOf(feature.values[*field]) : std::string();
            };
            annotation.name = text(name_field);
            annotation.note = text(note_field);
            annotation.color = colorOf(text(color_field)).value_or(color);
            for (const std::size_t field : kept) {
                annotation.values.push_back(std::move(feature.values[field]));
            }
            annotations.push_back(std::move(annotation));
        }
    }
    return annotations;
}

Result<FeatureCollection> collectionOf(const AnnotationList& annotations)
{
    // The CRS of all, if they have the same.
    const AnnotationSource* first = nullptr;
    const AnnotationSource* last = nullptr; // most follow others of the same source
    bool is_one_crs = true;
    FeatureLayer layer{.name = "annotations",
                       .fields = {{.name = "name", .type = FieldType::Text},
                                  {.name = "note", .type = FieldType::Text},
                                  {.name = "color", .type = FieldType::Text}},
                       .features = {}};
    const std::size_t own = layer.fields.size();
    std::vector<std::pair<const AnnotationSource*, std::vector<std::size_t>>> sources;
    annotations.forEach([&](const Annotation& annotation) {
        const AnnotationSource* source = annotation.source.get();
        if (source == last) {
            return;
        }
        last = source;
        first = first == nullptr ? source : first;
        is_one_crs = is_one_crs && isSameSource(first->crs, source->crs);
        if (std::any_of(sources.begin(), sources.end(),
                        [source](const auto& known) { return known.first == source; })) {
            return;
        }
        std::vector<std::size_t> columns;
        for (const FeatureField& field : source->fields) {
            const auto known = std::find_if(
                layer.fields.begin() + static_cast<std::ptrdiff_t>(own), layer.fields.end(),
                [&](const FeatureField& other) { return other.name == field.name; });
            columns.push_back(static_cast<std::size_t>(known - layer.fields.begin()));
            if (known == layer.fields.end()) {
                layer.fields.push_back(field);
            } else if (known->type != field.type) {
                known->type = FieldType::Text;
            }
        }
        sources.emplace_back(source, std::move(columns));
    });
    FeatureCollection content;
    if (first != nullptr && first->crs) {
        content.body = first->crs->body();
        content.crs = is_one_crs || content.body == nullptr || !first->crs->ellipsoid()
                          ? first->crs
                          : Crs::geographic(*content.body, *first->crs->ellipsoid());
    }
    std::size_t unplaced = 0;
    annotations.forEach([&](const Annotation& annotation) {
        Feature feature{.shape = annotation.shape, .parts = annotation.parts, .values = {}};
        if (!is_one_crs) {
            for (FeaturePart& part : feature.parts) {
                for (MapPoint& point : part.points) {
                    const auto geographic = annotation.source->crs
                                                ? annotation.source->crs->toGeographic(point)
                                                : std::nullopt;
                    const auto there =
                        geographic && content.crs ? content.crs->toMap(*geographic) : std::nullopt;
                    unplaced += there ? 0U : 1U;
                    point = there.value_or(point);
                }
            }
        }
        feature.values.resize(layer.fields.size());
        feature.values[0] = annotation.name;
        feature.values[1] = annotation.note;
        feature.values[2] = fmt::format("#{:02x}{:02x}{:02x}", annotation.color.red,
                                        annotation.color.green, annotation.color.blue);
        const auto columns = std::find_if(sources.begin(), sources.end(), [&](const auto& known) {
            return known.first == annotation.source.get();
        });
        for (std::size_t i = 0; i < annotation.values.size(); ++i) {
            const std::size_t column = columns->second[i];
            const FieldValue& value = annotation.values[i];
            const bool is_text = layer.fields[column].type == FieldType::Text &&
                                 !std::holds_alternative<std::monostate>(value);
            feature.values[column] = is_text ? FieldValue(textOf(value)) : value;
        }
        layer.features.push_back(std::move(feature));
    });
    if (unplaced > 0) {
        return Error{ErrorCode::Invalid,
                     fmt::format("{} positions cannot be converted to longitude and latitude; save "
                                 "the annotations of each file on their own",
                                 unplaced)};
    }
    content.layers.push_back(std::move(layer));
    return content;
}

} // namespace marsview
