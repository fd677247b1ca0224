#include "core/files/gdal_runtime.h"
#include "core/vector/vector_file.h"
#include "core/vector/vector_formats.h"

#include <cpl_string.h>
#include <ogr_spatialref.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <memory>
#include <set>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace marsview {
namespace {

namespace fs = std::filesystem;

// A folder next to the target, removed with its content: files are renamed out of it when all are
// complete.
class StagingFolder {
public:
    explicit StagingFolder(const fs::path& target)
        : path_(target.parent_path() /
                fmt::format(".{}.{}.part", target.filename().string(), getpid()))
    {
        std::error_code failure;
        fs::remove_all(path_, failure);
        has_begun_ = fs::create_directory(path_, failure);
        why_ = failure.message();
    }
    ~StagingFolder()
    {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    StagingFolder(const StagingFolder&) = delete;
    StagingFolder& operator=(const StagingFolder&) = delete;

    const fs::path& path() const { return path_; }
    bool hasBegun() const { return has_begun_; }
    const std::string& why() const { return why_; }

private:
    fs::path path_;
    bool has_begun_ = false;
    std::string why_;
};

OGRwkbGeometryType typeOf(FeatureShape shape, bool is_multiple)
{
    switch (shape) {
    case FeatureShape::Point:
        return is_multiple ? wkbMultiPoint : wkbPoint;
    case FeatureShape::Line:
        return is_multiple ? wkbMultiLineString : wkbLineString;
    case FeatureShape::Polygon:
        return is_multiple ? wkbMultiPolygon : wkbPolygon;
    }
    return wkbUnknown;
}

class Writer {
public:
    Writer(fs::path path,
           const FeatureCollection& content,
           VectorFormat format,
           JobMonitor& monitor)
        : path_(std::move(path))
        , content_(content)
        , format_(format)
        , monitor_(monitor)
    {}

    Result<std::vector<std::string>> run()
    {
        if (Status fits = checkFits(); !fits) {
            return std::move(fits).error();
        }
        if (Status placed = choosePlacement(); !placed) {
            return std::move(placed).error();
        }
        ensureGdal();
        const StagingFolder folder(path_);
        if (!folder.hasBegun()) {
            return fault(ErrorCode::Unreadable,
                         fmt::format("cannot be written to its folder ({}); choose another folder",
                                     folder.why()));
        }
        const fs::path staged = folder.path() / path_.filename();
        const GdalMessages messages;
        if (Status written = write(staged.string(), messages); !written) {
            return std::move(written).error();
        }
        if (messages.hasFailed()) {
            return fault(ErrorCode::Unreadable, "cannot be written: " + messages.firstFailure(""));
        }
        noteWarnings(messages);
        if (format_ == VectorFormat::Kml) {
            if (Status hinted = setKmlHint(staged); !hinted) {
                return std::move(hinted).error();
            }
        }
        if (Status moved = publish(folder.path()); !moved) {
            return std::move(moved).error();
        }
        return std::move(notices_);
    }

private:
    Error fault(ErrorCode code, const std::string& why) const
    {
        return {code, path_.string() + ": " + why};
    }

    Status checkFits() const
    {
        const bool is_single = format_ != VectorFormat::GeoPackage && format_ != VectorFormat::Kml;
        if (is_single && content_.layers.size() != 1) {
            return fault(ErrorCode::Unsupported,
                         fmt::format("the format holds one layer, but there are {}; choose "
                                     "GeoPackage",
                                     content_.layers.size()));
        }
        if (format_ != VectorFormat::Shapefile) {
            return Done{};
        }
        const auto& features = content_.layers.front().features;
        const bool is_mixed =
            std::any_of(features.begin(), features.end(), [&](const Feature& feature) {
                return feature.shape != features.front().shape;
            });
        return is_mixed
                   ? Status(fault(ErrorCode::Unsupported,
                                  "a Shapefile holds points, lines or polygons, not several of "
                                  "them; choose GeoPackage"))
                   : Status(Done{});
    }

    // The CRS of the file, and whether coordinates are converted to it.
    Status choosePlacement()
    {
        crs_ = content_.crs;
        if (format_ != VectorFormat::GeoJson && format_ != VectorFormat::Kml) {
            return Done{};
        }
        const char* const name = format_ == VectorFormat::Kml ? "KML" : "GeoJSON";
        if (!content_.crs || content_.crs->kind() == CrsKind::Local) {
            return fault(
                ErrorCode::Unsupported,
                fmt::format("{} needs longitude and latitude, but the CRS is unknown; choose "
                            "GeoPackage",
                            name));
        }
        crs_ = content_.body != nullptr ? commonGeographic(*content_.body) : std::nullopt;
        if (!crs_ || (format_ == VectorFormat::Kml && kmlTarget() == nullptr)) {
            return fault(ErrorCode::Unsupported,
                         fmt::format("{} cannot state the body {}; choose GeoPackage", name,
                                     content_.body != nullptr ? std::string(content_.body->name)
                                                              : std::string("of this CRS")));
        }
        is_converted_ = true;
        return Done{};
    }

    // The target of KML's hint; empty for the Earth, null for a body that has none.
    const char* kmlTarget() const
    {
        return content_.body->name == "Earth"  ? ""
               : content_.body->name == "Mars" ? "mars"
               : content_.body->name == "Moon" ? "moon"
                                               : nullptr;
    }

    Status write(const std::string& staged, const GdalMessages& messages)
    {
        GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName(driverOf(format_));
        if (driver == nullptr) {
            return fault(ErrorCode::Unsupported,
                         fmt::format("this GDAL has no driver for {}; choose another format",
                                     driverOf(format_)));
        }
        const GDALDatasetUniquePtr dataset(
            driver->Create(staged.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
        if (!dataset) {
            return fault(ErrorCode::Unreadable, "cannot be written: " + messages.firstFailure(""));
        }
        const std::size_t count = content_.layers.size();
        for (std::size_t i = 0; i < count; ++i) {
            const JobPart part(monitor_, static_cast<double>(i) / static_cast<double>(count),
                               static_cast<double>(i + 1) / static_cast<double>(count));
            if (Status status = writeLayer(*dataset, content_.layers[i], messages); !status) {
                return status;
            }
        }
        return Done{};
    }

    Status
    writeLayer(GDALDataset& dataset, const FeatureLayer& source, const GdalMessages& messages)
    {
        std::unique_ptr<OGRSpatialReference, void (*)(OGRSpatialReference*)> reference(
            nullptr, [](OGRSpatialReference* r) { r->Release(); });
        // OGR would convert KML from Mars to the Earth, which PROJ refuses.
        if (crs_ && format_ != VectorFormat::Kml) {
            reference.reset(new OGRSpatialReference);
            reference->SetFromUserInput(crs_->wkt().c_str());
            reference->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
        }
        CPLStringList options;
        const bool is_points =
            std::all_of(source.features.begin(), source.features.end(), [](const Feature& f) {
                return f.shape == FeatureShape::Point && f.parts.front().points.size() == 1;
            });
        if (format_ == VectorFormat::Csv) {
            options.SetNameValue("GEOMETRY", is_points ? "AS_XY" : "AS_WKT");
            options.SetNameValue("CREATE_CSVT", "YES"); // and a .prj file with the CRS
        }
        if (format_ == VectorFormat::Shapefile) {
            options.SetNameValue("ENCODING", "UTF-8");
        }
        if (format_ == VectorFormat::GeoJson) {
            options.SetNameValue("COORDINATE_PRECISION", "15");
        }
        const std::string name = source.name.empty() ? path_.stem().string() : source.name;
        OGRLayer* const layer =
            dataset.CreateLayer(name.c_str(), reference.get(), commonType(source), options.List());
        if (layer == nullptr) {
            return fault(ErrorCode::Unreadable, "cannot be written: " + messages.firstFailure(""));
        }
        for (const FeatureField& field : source.fields) {
            OGRFieldDefn definition(field.name.c_str(),
                                    field.type == FieldType::Integer ? OFTInteger64
                                    : field.type == FieldType::Real  ? OFTReal
                                                                     : OFTString);
            layer->CreateField(&definition);
        }
        const bool has_transaction = dataset.StartTransaction() == OGRERR_NONE;
        for (std::size_t i = 0; i < source.features.size(); ++i) {
            if (Status status = writeFeature(*layer, source, i, messages); !status) {
                return status;
            }
            constexpr std::size_t kFeaturesBetweenLooks = 256;
            if (i % kFeaturesBetweenLooks == 0) {
                if (monitor_.isCanceled()) {
                    return fault(ErrorCode::Canceled, "writing was canceled");
                }
                monitor_.report(static_cast<double>(i) /
                                static_cast<double>(source.features.size()));
            }
        }
        if (has_transaction && dataset.CommitTransaction() != OGRERR_NONE) {
            return fault(ErrorCode::Unreadable, "cannot be written: " + messages.firstFailure(""));
        }
        return Done{};
    }

    // Of all features; unknown if they differ, which a Shapefile cannot.
    OGRwkbGeometryType commonType(const FeatureLayer& layer) const
    {
        if (format_ == VectorFormat::Csv) {
            const bool is_points =
                std::all_of(layer.features.begin(), layer.features.end(),
                            [](const Feature& f) { return f.shape == FeatureShape::Point; });
            return is_points ? wkbPoint : wkbUnknown;
        }
        std::set<OGRwkbGeometryType> types;
        for (const Feature& feature : layer.features) {
            types.insert(typeOf(feature.shape, isMultiple(feature)));
        }
        if (types.empty()) {
            return wkbPoint;
        }
        if (types.size() == 1) {
            return *types.begin();
        }
        return format_ == VectorFormat::Shapefile ? typeOf(layer.features.front().shape, true)
                                                  : wkbUnknown;
    }

    static bool isMultiple(const Feature& feature)
    {
        if (feature.shape == FeatureShape::Point) {
            return feature.parts.front().points.size() > 1;
        }
        return std::count_if(feature.parts.begin(), feature.parts.end(),
                             [](const FeaturePart& part) { return !part.is_hole; }) > 1;
    }

    Status writeFeature(OGRLayer& layer,
                        const FeatureLayer& source,
                        std::size_t index,
                        const GdalMessages& messages)
    {
        const Feature& feature = source.features[index];
        const OGRFeatureUniquePtr written(OGRFeature::CreateFeature(layer.GetLayerDefn()));
        const std::size_t fields = std::min(
            feature.values.size(), static_cast<std::size_t>(layer.GetLayerDefn()->GetFieldCount()));
        for (std::size_t i = 0; i < fields; ++i) {
            const int field = static_cast<int>(i);
            if (const auto* whole = std::get_if<std::int64_t>(&feature.values[i])) {
                written->SetField(field, static_cast<GIntBig>(*whole));
            } else if (const auto* real = std::get_if<double>(&feature.values[i])) {
                written->SetField(field, *real);
            } else if (const auto* text = std::get_if<std::string>(&feature.values[i])) {
                written->SetField(field, text->c_str());
            }
        }
        Result<std::unique_ptr<OGRGeometry>> geometry = geometryOf(feature, index);
        if (!geometry) {
            return std::move(geometry).error();
        }
        written->SetGeometryDirectly(geometry->release());
        if (layer.CreateFeature(written.get()) != OGRERR_NONE) {
            return fault(ErrorCode::Unreadable, fmt::format("feature {} cannot be written: {}",
                                                            index + 1, messages.firstFailure("")));
        }
        return Done{};
    }

    Result<std::unique_ptr<OGRGeometry>> geometryOf(const Feature& feature, std::size_t index) const
    {
        const bool is_multiple = isMultiple(feature);
        std::unique_ptr<OGRGeometry> whole(
            OGRGeometryFactory::createGeometry(typeOf(feature.shape, is_multiple)));
        OGRPolygon* polygon = nullptr; // of the last outer ring
        for (const FeaturePart& part : feature.parts) {
            OGRLinearRing curve;
            for (const MapPoint& point : part.points) {
                const auto place = placed(point);
                if (!place) {
                    return fault(ErrorCode::OutOfRange,
                                 fmt::format("feature {} has a position ({}, {}) outside its map "
                                             "projection",
                                             index + 1, point.x, point.y));
                }
                curve.addPoint(place->x, place->y);
            }
            addPart(feature.shape, is_multiple, part.is_hole, curve, *whole, polygon);
        }
        return whole;
    }

    static void addPart(FeatureShape shape,
                        bool is_multiple,
                        bool is_hole,
                        const OGRLinearRing& curve,
                        OGRGeometry& whole,
                        OGRPolygon*& polygon)
    {
        switch (shape) {
        case FeatureShape::Point:
            for (int i = 0; i < curve.getNumPoints(); ++i) {
                OGRPoint point(curve.getX(i), curve.getY(i));
                if (is_multiple) {
                    whole.toMultiPoint()->addGeometry(&point);
                } else {
                    *whole.toPoint() = point;
                }
            }
            break;
        case FeatureShape::Line: {
            OGRLineString line;
            line.addSubLineString(&curve);
            if (is_multiple) {
                whole.toMultiLineString()->addGeometry(&line);
            } else {
                *whole.toLineString() = line;
            }
            break;
        }
        case FeatureShape::Polygon:
            if (!is_multiple) {
                polygon = whole.toPolygon();
            } else if (!is_hole) {
                OGRPolygon empty;
                whole.toMultiPolygon()->addGeometry(&empty);
                OGRMultiPolygon& all = *whole.toMultiPolygon();
                polygon = all.getGeometryRef(all.getNumGeometries() - 1);
            }
            if (polygon != nullptr) {
                OGRLinearRing ring(curve);
                ring.setCoordinateDimension(2);
                ring.closeRings();
                polygon->addRing(&ring);
            }
            break;
        }
    }

    std::optional<MapPoint> placed(MapPoint point) const
    {
        if (!is_converted_) {
            return point;
        }
        const auto geographic = content_.crs->toGeographic(point);
        if (!geographic) {
            return std::nullopt;
        }
        auto place = crs_->toMap(*geographic);
        return place;
    }

    void noteWarnings(const GdalMessages& messages)
    {
        for (const std::string& warning : messages.warnings()) {
            if (std::find(notices_.begin(), notices_.end(), warning) == notices_.end()) {
                notices_.push_back(warning);
            }
        }
    }

    // As Google Earth writes it.
    Status setKmlHint(const fs::path& staged) const
    {
        const std::string target = kmlTarget();
        if (target.empty()) {
            return Done{};
        }
        std::ifstream in(staged, std::ios::binary);
        std::string text(std::istreambuf_iterator<char>(in), {});
        const std::size_t element = text.find("<kml");
        const std::size_t end = text.find('>', element);
        if (element == std::string::npos || end == std::string::npos) {
            return fault(ErrorCode::Unreadable, "cannot be written: no KML element");
        }
        text.insert(end, fmt::format(" hint=\"target={}\"", target));
        std::ofstream out(staged, std::ios::binary | std::ios::trunc);
        out << text;
        return out.flush() ? Status(Done{})
                           : Status(fault(ErrorCode::Unreadable,
                                          "cannot be written; free some disk space"));
    }

    // The main file last: until then, a file from before is whole.
    Status publish(const fs::path& folder) const
    {
        std::vector<fs::path> files;
        for (const auto& entry : fs::directory_iterator(folder)) {
            files.push_back(entry.path());
        }
        std::sort(files.begin(), files.end(), [this](const fs::path& a, const fs::path& b) {
            const bool is_a_main = a.filename() == path_.filename();
            const bool is_b_main = b.filename() == path_.filename();
            return is_a_main != is_b_main ? is_b_main : a < b;
        });
        for (const fs::path& file : files) {
            std::error_code failure;
            fs::rename(file, path_.parent_path() / file.filename(), failure);
            if (failure) {
                return fault(
                    ErrorCode::Unreadable,
                    fmt::format("cannot be replaced ({}); choose another name", failure.message()));
            }
        }
        return Done{};
    }

    fs::path path_;
    const FeatureCollection& content_;
    VectorFormat format_;
    JobMonitor& monitor_;
    std::optional<Crs> crs_;
    bool is_converted_ = false;
    std::vector<std::string> notices_;
};

} // namespace

Result<std::vector<std::string>>
writeVectorFile(const std::string& path, const FeatureCollection& content, JobMonitor& monitor)
{
    const std::optional<VectorFormat> format = vectorFormatOf(path);
    if (!format) {
        return Error{ErrorCode::Unsupported,
                     path +
                         ": the name ends in none of .gpkg, .geojson, .kml, .shp and .csv; choose "
                         "one of them"};
    }
    return Writer(fs::absolute(path), content, *format, monitor).run();
}

} // namespace marsview
