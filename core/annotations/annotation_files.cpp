#include "core/annotations/annotation_files.h"

#include "core/annotations/drawn_geometry.h"
#include "core/annotations/drawn_json.h"
#include "core/files/raster_path.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <iterator>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <variant>

namespace marsview {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kAnnotationsMax = 100'000;

constexpr std::array kShapes{FeatureShape::Point, FeatureShape::Line, FeatureShape::Polygon};

const char* layerName(FeatureShape shape)
{
    switch (shape) {
    case FeatureShape::Point:
        return "points";
    case FeatureShape::Line:
        return "lines";
    case FeatureShape::Polygon:
        return "polygons";
    }
    return "";
}

FieldValue textValue(const std::string& text)
{
    return text.empty() ? FieldValue() : FieldValue(text);
}

FeatureLayer emptyLayer(const std::string& name)
{
    return {.name = name,
            .fields = {{.name = "name", .type = FieldType::Text},
                       {.name = "note", .type = FieldType::Text},
                       {.name = "color", .type = FieldType::Text},
                       {.name = "symbol", .type = FieldType::Text},
                       {.name = "time", .type = FieldType::Text}},
            .features = {}};
}

Feature featureOf(const Annotation& annotation, const DrawnGeometry& geometry)
{
    Feature feature;
    feature.shape = annotation.shape;
    FeaturePart part;
    switch (annotation.shape) {
    case FeatureShape::Point:
        part.points = geometry.points(annotation.vertices);
        break;
    case FeatureShape::Line:
        part.points = geometry.line(annotation.vertices, LineEnds::Open);
        break;
    case FeatureShape::Polygon:
        part.points = geometry.line(annotation.vertices, LineEnds::Closed);
        break;
    }
    feature.parts.push_back(std::move(part));
    const bool is_point = annotation.shape == FeatureShape::Point;
    feature.values = {textValue(annotation.name), textValue(annotation.note),
                      annotation.color ? FieldValue(colorText(*annotation.color)) : FieldValue(),
                      is_point ? FieldValue(std::string(symbolName(annotation.symbol)))
                               : FieldValue(),
                      timeText(annotation.time)};
    return feature;
}

FeatureCollection collectionOf(const DrawnBody& body,
                               const std::vector<const Annotation*>& annotations,
                               FeatureLayers layers)
{
    FeatureCollection content;
    content.body = bodyNamed(body.name);
    if (content.body != nullptr && body.ellipsoid) {
        content.crs = Crs::geographic(*content.body, *body.ellipsoid);
    } else if (body.ellipsoid) {
        Result<Crs> crs =
            Crs::fromText(fmt::format("+proj=longlat +a={:.17g} +b={:.17g} +no_defs +type=crs",
                                      body.ellipsoid->equatorial_m, body.ellipsoid->polar_m));
        content.crs = crs ? std::optional(std::move(*crs)) : std::nullopt;
    }
    const DrawnGeometry geometry(content.crs);
    const auto add_layer = [&](const std::string& name, std::optional<FeatureShape> shape) {
        FeatureLayer layer = emptyLayer(name);
        for (const Annotation* annotation : annotations) {
            if (!shape || annotation->shape == *shape) {
                layer.features.push_back(featureOf(*annotation, geometry));
            }
        }
        if (!layer.features.empty()) {
            content.layers.push_back(std::move(layer));
        }
    };
    if (layers == FeatureLayers::One) {
        add_layer("annotations", std::nullopt);
    } else {
        for (const FeatureShape shape : kShapes) {
            add_layer(layerName(shape), shape);
        }
    }
    return content;
}

fs::path withSuffix(const fs::path& path, const std::string& suffix)
{
    fs::path named = path;
    named.replace_extension();
    return named.string() + suffix + path.extension().string();
}

// A Shapefile for each shape: "rims-points.shp".
Result<std::vector<std::string>>
writeByShape(std::span<const Annotation> annotations, const fs::path& path, JobMonitor& monitor)
{
    std::vector<std::vector<Annotation>> by_shape;
    for (const FeatureShape shape : kShapes) {
        std::vector<Annotation> same;
        std::copy_if(annotations.begin(), annotations.end(), std::back_inserter(same),
                     [shape](const Annotation& annotation) { return annotation.shape == shape; });
        if (!same.empty()) {
            by_shape.push_back(std::move(same));
        }
    }
    std::vector<std::string> notices;
    for (const std::vector<Annotation>& same : by_shape) {
        const fs::path file =
            by_shape.size() == 1
                ? path
                : withSuffix(path, fmt::format("-{}", layerName(same.front().shape)));
        auto written =
            writeCollections(annotationFeatures(same, FeatureLayers::One), file, monitor);
        if (!written) {
            return written;
        }
        std::move(written->begin(), written->end(), std::back_inserter(notices));
    }
    return notices;
}

// Fields that OGR adds to everything in KML.
constexpr std::array<std::string_view, 9> kKmlFields{"timestamp",    "begin",      "end",
                                                     "altitudemode", "tessellate", "extrude",
                                                     "visibility",   "draworder",  "icon"};

bool isOfKml(const std::string& format, const std::string& field)
{
    return format.ends_with("KML") &&
           std::find(kKmlFields.begin(), kKmlFields.end(), field) != kKmlFields.end();
}

// What the fields of a layer mean.
struct Fields {
    std::optional<std::size_t> name, note, color, symbol, time;
    std::vector<std::string> others; // with values
};

Fields fieldsOf(const FeatureLayer& layer, const std::string& format)
{
    Fields fields;
    std::optional<std::size_t> description;
    for (std::size_t i = 0; i < layer.fields.size(); ++i) {
        const std::string name = lowerCase(layer.fields[i].name);
        const auto take = [i](std::optional<std::size_t>& field) {
            if (!field) {
                field = i;
            }
        };
        if (name == "name") {
            take(fields.name);
        } else if (name == "note") {
            take(fields.note);
        } else if (name == "description") {
            take(description);
        } else if (name == "color") {
            take(fields.color);
        } else if (name == "symbol") {
            take(fields.symbol);
        } else if (name == "time") {
            take(fields.time);
        } else if (!isOfKml(format, name) &&
                   std::any_of(
                       layer.features.begin(), layer.features.end(), [i](const Feature& feature) {
                           return i < feature.values.size() &&
                                  !std::holds_alternative<std::monostate>(feature.values[i]);
                       })) {
            fields.others.push_back(layer.fields[i].name);
        }
    }
    if (!fields.note) {
        fields.note = description;
    }
    return fields;
}

std::string textOf(const Feature& feature, std::optional<std::size_t> field)
{
    if (!field || *field >= feature.values.size()) {
        return {};
    }
    struct Text {
        std::string operator()(std::monostate) const { return {}; }
        std::string operator()(std::int64_t number) const { return fmt::format("{}", number); }
        std::string operator()(double number) const { return fmt::format("{:.15g}", number); }
        std::string operator()(const std::string& text) const { return text; }
    };
    return std::visit(Text{}, feature.values[*field]);
}

// Also as OGR has it where a format has dates: "2027/01/15 08:00:00.125+00".
std::optional<DrawnTime> timeIn(std::string text)
{
    constexpr std::string_view kZone = "+00";
    constexpr std::size_t kDate = 10; // characters
    if (text.size() > kDate && text[4] == '/' && text[7] == '/' && text[kDate] == ' ' &&
        text.ends_with(kZone)) {
        text.replace(text.size() - kZone.size(), kZone.size(), "Z");
        text[4] = text[7] = '-';
        text[kDate] = 'T';
    }
    return timeNamed(text);
}

class Importer {
public:
    Importer(std::string path,
             const VectorFile& file,
             const Georeference& map,
             const Body* map_body)
        : path_(std::move(path))
        , file_(file)
        , crs_(file.content.crs ? file.content.crs : map.crs())
        , body_(drawnBody(map, map_body))
    {}

    Result<ImportedAnnotations> run()
    {
        imported_.notices = file_.notices;
        for (const FeatureLayer& layer : file_.content.layers) {
            if (Status status = addLayer(layer); !status) {
                return std::move(status).error();
            }
        }
        if (imported_.annotations.empty()) {
            return Error{ErrorCode::Invalid, path_ + ": has no points, lines or polygons"};
        }
        if (holes_ > 0) {
            imported_.notices.push_back(fmt::format("{} holes of polygons are left out", holes_));
        }
        if (!others_.empty()) {
            std::string list;
            for (const std::string& name : others_) {
                list += (list.empty() ? "" : ", ") + name;
            }
            imported_.notices.push_back(
                fmt::format("fields without a meaning for annotations are left out: {}", list));
        }
        return std::move(imported_);
    }

private:
    Status addLayer(const FeatureLayer& layer)
    {
        const Fields fields = fieldsOf(layer, file_.format);
        others_.insert(fields.others.begin(), fields.others.end());
        for (const Feature& feature : layer.features) {
            Annotation annotation;
            annotation.shape = feature.shape;
            annotation.name = textOf(feature, fields.name);
            if (annotation.name.empty()) {
                annotation.name = layer.name;
            }
            annotation.note = textOf(feature, fields.note);
            annotation.color = colorNamed(textOf(feature, fields.color));
            annotation.symbol =
                symbolNamed(textOf(feature, fields.symbol)).value_or(MarkSymbol::Circle);
            annotation.time = timeIn(textOf(feature, fields.time)).value_or(DrawnTime{});
            annotation.body = body_;
            if (Status status = addParts(feature, annotation); !status) {
                return status;
            }
        }
        return Done{};
    }

    Status addParts(const Feature& feature, const Annotation& annotation)
    {
        for (const FeaturePart& part : feature.parts) {
            if (part.is_hole) {
                ++holes_;
                continue;
            }
            std::vector<DrawnVertex> vertices;
            for (const MapPoint& point : part.points) {
                const auto vertex = vertexOf(point);
                if (!vertex) {
                    return Error{ErrorCode::OutOfRange,
                                 fmt::format("{}: \"{}\" has a position ({}, {}) outside the "
                                             "projection of its CRS; correct the file",
                                             path_, annotation.name, point.x, point.y)};
                }
                const bool is_apart = annotation.shape == FeatureShape::Point;
                if (is_apart || vertices.empty() || !(vertices.back() == *vertex)) {
                    vertices.push_back(*vertex);
                }
                if (is_apart) {
                    if (Status status = add(annotation, {std::exchange(vertices, {})}); !status) {
                        return status;
                    }
                }
            }
            if (annotation.shape == FeatureShape::Polygon && vertices.size() > 1 &&
                isClosed(part)) {
                vertices.pop_back();
            }
            if (vertices.size() >= verticesNeeded(annotation.shape)) {
                if (Status status = add(annotation, std::move(vertices)); !status) {
                    return status;
                }
            }
        }
        return Done{};
    }

    static bool isClosed(const FeaturePart& part)
    {
        return part.points.front() == part.points.back();
    }

    Status add(Annotation annotation, std::vector<DrawnVertex> vertices)
    {
        if (imported_.annotations.size() == kAnnotationsMax) {
            return Error{ErrorCode::TooLarge,
                         fmt::format("{}: has more than {} points, lines and polygons; open it "
                                     "with File › Open Vector File",
                                     path_, kAnnotationsMax)};
        }
        annotation.vertices = std::move(vertices);
        imported_.annotations.push_back(std::move(annotation));
        return Done{};
    }

    std::optional<DrawnVertex> vertexOf(const MapPoint& point) const
    {
        if (!body_.ellipsoid) {
            return DrawnVertex(point);
        }
        const auto geographic = crs_ ? crs_->toGeographic(point) : std::nullopt;
        return geographic ? std::optional(DrawnVertex(*geographic)) : std::nullopt;
    }

    std::string path_;
    const VectorFile& file_;
    std::optional<Crs> crs_;
    DrawnBody body_;
    ImportedAnnotations imported_;
    std::size_t holes_ = 0;
    std::set<std::string> others_;
};

} // namespace

std::vector<FeatureCollection> annotationFeatures(std::span<const Annotation> annotations,
                                                  FeatureLayers layers)
{
    struct Group {
        DrawnBody body;
        std::vector<const Annotation*> annotations;
    };
    std::vector<Group> groups;
    for (const Annotation& annotation : annotations) {
        if (annotation.vertices.size() < verticesNeeded(annotation.shape)) {
            continue;
        }
        auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& known) {
            return isSameBody(known.body, annotation.body);
        });
        if (group == groups.end()) {
            groups.push_back({.body = annotation.body, .annotations = {}});
            group = std::prev(groups.end());
        }
        group->annotations.push_back(&annotation);
    }
    std::vector<FeatureCollection> collections;
    for (const Group& group : groups) {
        collections.push_back(collectionOf(group.body, group.annotations, layers));
    }
    return collections;
}

std::vector<fs::path> collectionPaths(std::span<const FeatureCollection> collections,
                                      const fs::path& path)
{
    if (collections.size() == 1) {
        return {path};
    }
    std::vector<fs::path> paths;
    std::vector<std::string> suffixes;
    for (const FeatureCollection& content : collections) {
        const std::string suffix =
            fmt::format("-{}", content.body != nullptr ? lowerCase(std::string(content.body->name))
                               : content.crs           ? "body"
                                                       : "map");
        const auto same = std::count(suffixes.begin(), suffixes.end(), suffix);
        suffixes.push_back(suffix);
        paths.push_back(
            withSuffix(path, same > 0 ? fmt::format("{}-{}", suffix, same + 1) : suffix));
    }
    return paths;
}

Result<std::vector<std::string>> writeCollections(std::span<const FeatureCollection> collections,
                                                  const fs::path& path,
                                                  JobMonitor& monitor)
{
    std::vector<std::string> notices;
    const std::vector<fs::path> paths = collectionPaths(collections, path);
    for (std::size_t i = 0; i < paths.size(); ++i) {
        auto written = writeVectorFile(paths[i].string(), collections[i], monitor);
        if (!written) {
            return written;
        }
        std::move(written->begin(), written->end(), std::back_inserter(notices));
    }
    return notices;
}

Result<std::vector<std::string>>
writeAnnotations(std::span<const Annotation> annotations, const fs::path& path, JobMonitor& monitor)
{
    const std::string extension = lowerCase(path.extension().string());
    if (extension == ".shp") {
        return writeByShape(annotations, path, monitor);
    }
    return writeCollections(annotationFeatures(annotations, extension == ".gpkg"
                                                                ? FeatureLayers::ByShape
                                                                : FeatureLayers::One),
                            path, monitor);
}

Result<ImportedAnnotations> annotationsFrom(const std::string& path,
                                            const VectorFile& file,
                                            const Georeference& map,
                                            const Body* map_body)
{
    if (const Status same = checkSameBody(path, file.content, map.crs(), map_body); !same) {
        return same.error();
    }
    const bool is_on_body = map.crs() && map.crs()->ellipsoid();
    if (file.content.crs && !is_on_body) {
        return Error{ErrorCode::Invalid,
                     fmt::format("{}: has the CRS \"{}\", but the map has none; set the map's CRS "
                                 "first",
                                 path, file.content.crs->name())};
    }
    return Importer(path, file, map, map_body).run();
}

} // namespace marsview
