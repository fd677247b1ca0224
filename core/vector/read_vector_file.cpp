#include "core/files/gdal_runtime.h"
#include "core/vector/vector_file.h"
#include "core/vector/vector_formats.h"

#include <ogrsf_frmts.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <set>
#include <utility>

namespace marsview {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kCoordinatesMax = 50'000'000;

class Reader {
public:
    Reader(std::string path, JobMonitor& monitor)
        : path_(std::move(path))
        , monitor_(monitor)
    {}

    Result<VectorFile> run()
    {
        std::error_code failure;
        if (!fs::exists(path_, failure)) {
            return fault(ErrorCode::NotFound, "does not exist");
        }
        if (!fs::is_regular_file(path_, failure)) {
            return fault(ErrorCode::Unsupported, "is not a regular file; choose a vector file");
        }
        ensureGdal();
        const GdalMessages messages;
        const std::array<const char*, 8> drivers{"GPKG",           "GeoJSON", "LIBKML", "KML",
                                                 "ESRI Shapefile", "CSV",     nullptr,  nullptr};
        const std::array<const char*, 6> options{"X_POSSIBLE_NAMES=lon,longitude,long,x,easting",
                                                 "Y_POSSIBLE_NAMES=lat,latitude,y,northing",
                                                 "GEOM_POSSIBLE_NAMES=wkt,geom,geometry",
                                                 "KEEP_GEOM_COLUMNS=NO",
                                                 "AUTODETECT_TYPE=YES",
                                                 nullptr};
        const GDALDatasetUniquePtr dataset(GDALDataset::Open(
            path_.c_str(), GDAL_OF_VECTOR | GDAL_OF_VERBOSE_ERROR, drivers.data(), options.data()));
        if (!dataset) {
            return fault(ErrorCode::Unsupported,
                         fmt::format("cannot be read ({}); choose a GeoPackage, GeoJSON, KML, "
                                     "Shapefile or CSV file",
                                     messages.firstFailure("unknown format")));
        }
        file_.format = dataset->GetDriverName();
        const int count = dataset->GetLayerCount();
        for (int i = 0; i < count; ++i) {
            const JobPart part(monitor_, static_cast<double>(i) / count,
                               static_cast<double>(i + 1) / count);
            if (Status status = readLayer(*dataset->GetLayer(i)); !status) {
                return std::move(status).error();
            }
        }
        // Reading an incomplete file ends like a complete one, with a message.
        if (messages.hasFailed()) {
            return fault(ErrorCode::Unreadable,
                         fmt::format("is damaged ({}); fetch it again", messages.firstFailure("")));
        }
        if (file_.format == "LIBKML" || file_.format == "KML") {
            if (Status status = setKmlBody(); !status) {
                return std::move(status).error();
            }
        }
        if (left_out_ > 0) {
            file_.notices.push_back(fmt::format(
                "{} features have no point, line or polygon and are left out", left_out_));
        }
        if (file_.content.crs) {
            file_.content.body = file_.content.crs->body();
        }
        return std::move(file_);
    }

private:
    Error fault(ErrorCode code, const std::string& why) const { return {code, path_ + ": " + why}; }

    Status readLayer(OGRLayer& source)
    {
        if (Status status = readCrs(source); !status) {
            return status;
        }
        FeatureLayer layer{.name = source.GetName(), .fields = {}, .features = {}};
        OGRFeatureDefn& definition = *source.GetLayerDefn();
        for (int i = 0; i < definition.GetFieldCount(); ++i) {
            const OGRFieldDefn& field = *definition.GetFieldDefn(i);
            const OGRFieldType type = field.GetType();
            layer.fields.push_back({field.GetNameRef(), type == OFTInteger || type == OFTInteger64
                                                            ? FieldType::Integer
                                                        : type == OFTReal ? FieldType::Real
                                                                          : FieldType::Text});
        }
        const GIntBig total = source.GetFeatureCount(FALSE);
        source.ResetReading();
        for (GIntBig number = 0;; ++number) {
            const OGRFeatureUniquePtr feature(source.GetNextFeature());
            if (!feature) {
                break;
            }
            addFeature(*feature, layer);
            if (coordinates_ > kCoordinatesMax) {
                return fault(ErrorCode::TooLarge,
                             fmt::format("has more than {} coordinates; choose a part of it",
                                         kCoordinatesMax));
            }
            constexpr GIntBig kFeaturesBetweenLooks = 256;
            if (number % kFeaturesBetweenLooks == 0) {
                if (monitor_.isCanceled()) {
                    return fault(ErrorCode::Canceled, "reading was canceled");
                }
                if (total > 0) {
                    monitor_.report(
                        std::min(1.0, static_cast<double>(number) / static_cast<double>(total)));
                }
            }
        }
        file_.content.layers.push_back(std::move(layer));
        return Done{};
    }

    Status readCrs(OGRLayer& source)
    {
        const OGRSpatialReference* const reference = source.GetSpatialRef();
        if (reference == nullptr || reference->IsEmpty() != 0) {
            return Done{};
        }
        Result<Crs> crs = Crs::fromSpatialReference(*reference);
        if (!crs) {
            return fault(ErrorCode::Unsupported, crs.error().message);
        }
        if (file_.content.crs && file_.content.crs->wkt() != crs->wkt()) {
            return fault(
                ErrorCode::Unsupported,
                fmt::format("has layers in different CRSs, \"{}\" and \"{}\"; save them in "
                            "one CRS",
                            file_.content.crs->name(), crs->name()));
        }
        file_.content.crs = std::move(*crs);
        return Done{};
    }

    // OGR reports WGS 84 for every KML file.
    Status setKmlBody()
    {
        const Body* const body = bodyOfKml(path_);
        std::optional<Crs> crs = body != nullptr ? commonGeographic(*body) : std::nullopt;
        if (!crs) {
            return fault(
                ErrorCode::Unsupported,
                "its hint names no body with maps; choose a file on the Earth, Mars or the "
                "Moon");
        }
        file_.content.crs = std::move(crs);
        return Done{};
    }

    void addFeature(OGRFeature& source, FeatureLayer& layer)
    {
        Feature feature;
        const OGRGeometry* const geometry = source.GetGeometryRef();
        bool has_shape = false;
        if (geometry != nullptr && geometry->IsEmpty() == 0) {
            const std::unique_ptr<OGRGeometry> straight(geometry->getLinearGeometry());
            if (straight) {
                has_shape = addGeometry(*straight, feature);
            }
        }
        if (!has_shape) {
            ++left_out_;
            return;
        }
        for (int i = 0; i < static_cast<int>(layer.fields.size()); ++i) {
            feature.values.push_back(valueOf(source, i, layer.fields[static_cast<std::size_t>(i)]));
        }
        layer.features.push_back(std::move(feature));
    }

    static FieldValue valueOf(OGRFeature& source, int index, const FeatureField& field)
    {
        if (source.IsFieldSetAndNotNull(index) == 0) {
            return {};
        }
        switch (field.type) {
        case FieldType::Integer:
            return std::int64_t{source.GetFieldAsInteger64(index)};
        case FieldType::Real:
            return source.GetFieldAsDouble(index);
        case FieldType::Text:
            return std::string(source.GetFieldAsString(index));
        }
        return {};
    }

    // False for a geometry of another kind, or of several kinds.
    bool addGeometry(const OGRGeometry& geometry, Feature& feature)
    {
        switch (wkbFlatten(geometry.getGeometryType())) {
        case wkbPoint: {
            const OGRPoint& point = *geometry.toPoint();
            if (feature.parts.empty()) {
                feature.shape = FeatureShape::Point;
                feature.parts.emplace_back();
            }
            feature.parts.front().points.push_back({point.getX(), point.getY()});
            ++coordinates_;
            return feature.shape == FeatureShape::Point;
        }
        case wkbLineString:
            return addCurve(*geometry.toLineString(), FeatureShape::Line, false, feature);
        case wkbPolygon: {
            const OGRPolygon& polygon = *geometry.toPolygon();
            if (polygon.getExteriorRing() == nullptr ||
                !addCurve(*polygon.getExteriorRing(), FeatureShape::Polygon, false, feature)) {
                return false;
            }
            for (int i = 0; i < polygon.getNumInteriorRings(); ++i) {
                addCurve(*polygon.getInteriorRing(i), FeatureShape::Polygon, true, feature);
            }
            return true;
        }
        case wkbMultiPoint:
        case wkbMultiLineString:
        case wkbMultiPolygon:
        case wkbGeometryCollection: {
            bool is_one_kind = true;
            for (const OGRGeometry* part : *geometry.toGeometryCollection()) {
                is_one_kind = addGeometry(*part, feature) && is_one_kind;
            }
            return is_one_kind && !feature.parts.empty();
        }
        default:
            return false;
        }
    }

    bool addCurve(const OGRSimpleCurve& curve, FeatureShape shape, bool is_hole, Feature& feature)
    {
        if (!feature.parts.empty() && feature.shape != shape) {
            return false;
        }
        feature.shape = shape;
        FeaturePart part{.points = {}, .is_hole = is_hole};
        for (int i = 0; i < curve.getNumPoints(); ++i) {
            part.points.push_back({curve.getX(i), curve.getY(i)});
        }
        coordinates_ += part.points.size();
        feature.parts.push_back(std::move(part));
        return true;
    }

    std::string path_;
    JobMonitor& monitor_;
    VectorFile file_;
    std::size_t coordinates_ = 0;
    std::size_t left_out_ = 0;
};

std::string bodyName(const Body* body, const std::optional<Crs>& crs)
{
    if (body != nullptr) {
        const bool has_article = body->name == "Earth" || body->name == "Moon";
        return (has_article ? "the " : "") + std::string(body->name);
    }
    return crs && crs->ellipsoid()
               ? fmt::format("a body of radius {:.6g} km", crs->ellipsoid()->equatorial_m / 1e3)
               : std::string("an unknown body");
}

} // namespace

bool isVectorFile(const std::string& path)
{
    std::error_code failure;
    const auto format = vectorFormatOf(path);
    if (!format || *format == VectorFormat::Csv || !fs::is_regular_file(path, failure)) {
        return false;
    }
    if (*format != VectorFormat::GeoPackage) {
        return true;
    }
    ensureGdal();
    const GdalMessages messages; // discarded
    const std::array<const char*, 2> drivers{"GPKG", nullptr};
    const GDALDatasetUniquePtr dataset(
        GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR, drivers.data()));
    return dataset && dataset->GetLayerCount() > 0;
}

Result<VectorFile> readVectorFile(const std::string& path, JobMonitor& monitor)
{
    return Reader(path, monitor).run();
}

Status checkSameBody(const std::string& path,
                     const FeatureCollection& content,
                     const std::optional<Crs>& map_crs,
                     const Body* map_body)
{
    bool is_same = content.body == map_body;
    if (!is_same && (content.body == nullptr || map_body == nullptr)) {
        constexpr double kRadiusTolerance = 0.01;
        const auto radius_m = [](const Body* body, const std::optional<Crs>& crs) {
            return crs && crs->ellipsoid() ? crs->ellipsoid()->equatorial_m
                   : body != nullptr       ? body->ellipsoid.equatorial_m
                                           : 0.0;
        };
        const double a = radius_m(content.body, content.crs);
        const double b = radius_m(map_body, map_crs);
        is_same = a == 0.0 || b == 0.0 || std::abs(a / b - 1.0) <= kRadiusTolerance;
    }
    if (is_same) {
        return Done{};
    }
    return Error{ErrorCode::Invalid,
                 fmt::format("{}: is on {}, but the map is on {}; if the file states a wrong CRS, "
                             "set the right one, for example with ogr2ogr -a_srs",
                             path, bodyName(content.body, content.crs),
                             bodyName(map_body, map_crs))};
}

std::optional<Crs> likelyCrs(const FeatureCollection& content, const Body* map_body)
{
    const bool is_plain = content.crs && content.crs->kind() == CrsKind::Geographic &&
                          content.body != nullptr && content.body->name == "Earth";
    if (!is_plain || map_body == nullptr || map_body == content.body) {
        return std::nullopt;
    }
    return commonGeographic(*map_body);
}

} // namespace marsview
