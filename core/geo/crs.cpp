#include "core/geo/crs.h"

#include "core/base/check.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <mutex>
#include <numbers>

namespace marsview {
namespace {

struct TransformationDeleter {
    void operator()(OGRCoordinateTransformation* t) const
    {
        OGRCoordinateTransformation::DestroyCT(t);
    }
};
using Transformation = std::unique_ptr<OGRCoordinateTransformation, TransformationDeleter>;

// PROJ reports an error for every point outside a projection's domain; callers get an empty result
// instead.
class QuietErrors {
public:
    QuietErrors() { CPLPushErrorHandler(CPLQuietErrorHandler); }
    ~QuietErrors()
    {
        CPLPopErrorHandler();
        CPLErrorReset();
    }
    QuietErrors(const QuietErrors&) = delete;
    QuietErrors& operator=(const QuietErrors&) = delete;
};

bool containsText(std::string_view text, std::string_view lower_case_word)
{
    const auto is_same = [](char a, char b) {
        return std::tolower(static_cast<unsigned char>(a)) == b;
    };
    return std::search(text.begin(), text.end(), lower_case_word.begin(), lower_case_word.end(),
                       is_same) != text.end();
}

std::string exportWkt(const OGRSpatialReference& srs)
{
    char* text = nullptr;
    const std::array<const char*, 3> options{"FORMAT=WKT2_2019", "MULTILINE=NO", nullptr};
    srs.exportToWkt(&text, options.data());
    std::string wkt = text != nullptr ? text : "";
    CPLFree(text);
    return wkt;
}

// Formats without CRS names leave a placeholder; describe the system instead.
std::string nameOf(const OGRSpatialReference& srs)
{
    std::string name = srs.GetName() != nullptr ? srs.GetName() : "";
    if (!name.empty() && name != "unnamed" && name != "unknown" && name != "Unknown") {
        return name;
    }
    const char* geographic = srs.GetAttrValue("GEOGCS");
    const std::string base = geographic != nullptr ? geographic : "unnamed";
    int is_north = 0;
    if (const int zone = srs.GetUTMZone(&is_north)) {
        return fmt::format("{} / UTM zone {}{}", base, zone, is_north != 0 ? "N" : "S");
    }
    const char* method = srs.GetAttrValue("PROJECTION");
    return method != nullptr ? fmt::format("{} / {}", base, method) : base;
}

// Which of the first two axes is x, and the direction of each.
struct AxisLayout {
    bool is_swapped = false; // the first axis is y
    double east_sign = 1.0;
    double north_sign = 1.0;
};

AxisLayout layoutOf(const OGRSpatialReference& srs)
{
    OGRAxisOrientation first = OAO_Other;
    OGRAxisOrientation second = OAO_Other;
    srs.GetAxis(nullptr, 0, &first);
    srs.GetAxis(nullptr, 1, &second);
    const auto is_meridional = [](OGRAxisOrientation o) {
        return o == OAO_North || o == OAO_South;
    };
    const auto is_zonal = [](OGRAxisOrientation o) { return o == OAO_East || o == OAO_West; };
    AxisLayout layout;
    // Polar systems call both axes "north" or "south", along two meridians; of these, UPS
    // (EPSG:32661 and 32761) lists its northing first, and OGR reports that.
    layout.is_swapped =
        (is_meridional(first) && is_zonal(second)) ||
        (is_meridional(first) && is_meridional(second) && srs.EPSGTreatsAsNorthingEasting() != 0);
    const OGRAxisOrientation x_axis = layout.is_swapped ? second : first;
    const OGRAxisOrientation y_axis = layout.is_swapped ? first : second;
    // The two axes of a polar system keep their direction.
    if (is_zonal(x_axis) && is_meridional(y_axis)) {
        layout.east_sign = x_axis == OAO_West ? -1.0 : 1.0;
        layout.north_sign = y_axis == OAO_South ? -1.0 : 1.0;
    }
    return layout;
}

void setEastNorthOrder(OGRSpatialReference& srs)
{
    srs.SetDataAxisToSRSAxisMapping(layoutOf(srs).is_swapped ? std::vector<int>{2, 1}
                                                             : std::vector<int>{1, 2});
}

bool hasSphericalAxes(const OGRSpatialReference& srs)
{
    return containsText(exportWkt(srs), "cs[spherical");
}

std::string angularUnitName(const OGRSpatialReference& srs)
{
    const char* name = nullptr;
    srs.GetAngularUnits(&name);
    return name != nullptr ? name : "degree";
}

bool isCylindrical(const OGRSpatialReference& srs)
{
    const char* method = srs.GetAttrValue("PROJECTION");
    if (method == nullptr) {
        return false;
    }
    constexpr std::array kMethods{
        SRS_PT_EQUIRECTANGULAR,          SRS_PT_MERCATOR_1SP,       SRS_PT_MERCATOR_2SP,
        SRS_PT_CYLINDRICAL_EQUAL_AREA,   SRS_PT_MILLER_CYLINDRICAL, SRS_PT_GALL_STEREOGRAPHIC,
        SRS_PT_MERCATOR_AUXILIARY_SPHERE};
    return std::any_of(kMethods.begin(), kMethods.end(),
                       [method](const char* m) { return EQUAL(m, method); });
}

} // namespace

bool GeographicArea::contains(GeographicPoint point) const noexcept
{
    if (point.latitude < south || point.latitude > north) {
        return false;
    }
    constexpr double kTurn = 2.0 * std::numbers::pi;
    const auto eastOfWest = [this](Angle longitude) {
        const double turn = std::remainder(longitude.radians() - west.radians(), kTurn);
        return turn < 0.0 ? turn + kTurn : turn;
    };
    return eastOfWest(point.longitude) <= eastOfWest(east);
}

struct Crs::Impl {
    OGRSpatialReference srs;
    OGRSpatialReference base; // the underlying geographic system, x = longitude, y = latitude
    std::string name;
    std::string wkt;
    CrsKind kind = CrsKind::Local;
    std::optional<Ellipsoid> ellipsoid;
    const Body* body = nullptr;
    LatitudeKind latitude_kind = LatitudeKind::Planetographic;
    double unit = 1.0;
    std::string unit_name;
    AxisLayout axes;
    std::optional<double> turn;
    double south_pole_y = -std::numeric_limits<double>::infinity(); // if x is periodic
    double north_pole_y = std::numeric_limits<double>::infinity();
    std::optional<GeographicArea> area_of_use;
    MapPoint false_origin{};
    std::optional<VerticalUnit> vertical_unit;
    std::string vertical_datum_name;
    std::vector<std::string> notices;

    // The base system: radians per unit, prime meridian, axes.
    double base_unit_rad = std::numbers::pi / 180.0;
    double base_meridian_rad = 0.0;
    double base_east_sign = 1.0;

    mutable std::mutex mutex; // guards the two below: a transformation serves one thread at a time
    Transformation to_base;
    Transformation from_base;

    // Converts base coordinates, in the base system's unit, to the frame of the program.
    GeographicPoint fromBase(double x, double y) const
    {
        const Angle longitude =
            Angle::radians(base_east_sign * x * base_unit_rad + base_meridian_rad);
        const Angle latitude = Angle::radians(y * base_unit_rad);
        return {longitude, latitude_kind == LatitudeKind::Planetographic
                               ? ellipsoid->planetocentric(latitude)
                               : latitude};
    }

    // The same for the map coordinates of a geographic system. Empty beyond the poles, except
    // within the rounding error of a geotransform.
    std::optional<GeographicPoint> fromAngles(MapPoint map) const
    {
        constexpr double kSlack = 1.0 + 1e-12;
        const double pole = std::numbers::pi / 2.0 / base_unit_rad;
        if (!std::isfinite(map.x) || !(std::abs(map.y) <= pole * kSlack)) {
            return std::nullopt;
        }
        return fromBase(map.x, std::clamp(map.y, -pole, pole));
    }

    MapPoint toBase(GeographicPoint p) const
    {
        const Angle latitude = latitude_kind == LatitudeKind::Planetographic
                                   ? ellipsoid->planetographic(p.latitude)
                                   : p.latitude;
        return {base_east_sign * (p.longitude.radians() - base_meridian_rad) / base_unit_rad,
                latitude.radians() / base_unit_rad};
    }

    std::optional<MapPoint> transform(OGRCoordinateTransformation& t, double x, double y) const
    {
        const std::scoped_lock lock(mutex);
        const QuietErrors quiet;
        int is_success = 0;
        t.Transform(1, &x, &y, nullptr, &is_success);
        if (is_success == 0 || !std::isfinite(x) || !std::isfinite(y)) {
            return std::nullopt;
        }
        return MapPoint{x, y};
    }

    std::optional<MapPoint> inverse(MapPoint map) const;

    void readBase();
    void readVertical();
    void readAreaOfUse();
    Status readHorizontal();
};

// Map to base coordinates. PROJ's inverses stop at their own tolerances, which leaves 10 µm in
// polar stereographic projections and 2 cm in equal-area ones on Mars' ellipsoid; its forward
// equations are good to rounding. So the inverse is polished with Newton steps on the forward
// equations.
std::optional<MapPoint> Crs::Impl::inverse(MapPoint map) const
{
    // Labels round their scale, which puts the edge of a global map slightly beyond the pole.
    constexpr double kBeyondPoleShareMax = 1e-4;
    const double pole_y = std::clamp(map.y, south_pole_y, north_pole_y);
    if (std::abs(map.y - pole_y) <= kBeyondPoleShareMax * std::abs(pole_y)) {
        map.y = pole_y;
    }
    std::optional<MapPoint> best = transform(*to_base, map.x, map.y);
    if (!best) {
        return std::nullopt;
    }
    struct Residual {
        double x, y;
        double size() const { return std::hypot(x, y); }
    };
    const auto residual = [&](MapPoint at) -> std::optional<Residual> {
        const auto image = transform(*from_base, at.x, at.y);
        if (!image) {
            return std::nullopt;
        }
        // A cylindrical map may extend beyond its first turn.
        const double dx = map.x - image->x;
        return Residual{turn ? std::remainder(dx, *turn) : dx, map.y - image->y};
    };
    constexpr int kStepsMax = 3;
    const double good_enough =
        2.0 * std::numeric_limits<double>::epsilon() * std::hypot(map.x, map.y);
    std::optional<Residual> error = residual(*best);
    for (int step = 0; step < kStepsMax && error && error->size() > good_enough; ++step) {
        // Derivatives by finite differences. The step is a few meters on the ground, away from the
        // pole.
        const double h = 1e-6 / base_unit_rad;
        const double h_y = best->y > 0.0 ? -h : h;
        const auto east = residual({best->x + h, best->y});
        const auto north = residual({best->x, best->y + h_y});
        if (!east || !north) {
            break;
        }
        const double xx = (error->x - east->x) / h;
        const double yx = (error->y - east->y) / h;
        const double xy = (error->x - north->x) / h_y;
        const double yy = (error->y - north->y) / h_y;
        const double determinant = xx * yy - xy * yx;
        const MapPoint next{best->x + (error->x * yy - error->y * xy) / determinant,
                            best->y + (error->y * xx - error->x * yx) / determinant};
        if (!std::isfinite(next.x) || !std::isfinite(next.y)) {
            break; // at a pole, where longitude is undefined
        }
        const auto next_error = residual(next);
        if (!next_error || next_error->size() >= error->size()) {
            break; // rounding, or a fold at the edge of the projection
        }
        best = next;
        error = next_error;
    }
    // If the forward projection of the result is elsewhere, the position is beyond the edge of the
    // projection.
    constexpr double kAstrayShareOfRadius = 1e-6;
    const double astray = kAstrayShareOfRadius * ellipsoid->equatorial_m / unit;
    return error && error->size() < astray ? best : std::nullopt;
}

// Reads the unit, meridian and axes of the underlying geographic system.
void Crs::Impl::readBase()
{
    const AxisLayout base_axes = layoutOf(base);
    setEastNorthOrder(base);
    base_east_sign = base_axes.east_sign;
    base_unit_rad = base.GetAngularUnits();
    if (hasSphericalAxes(base)) {
        // OGR does not report the unit of a spherical system; the registries contain only degrees.
        base_unit_rad = std::numbers::pi / 180.0;
        latitude_kind = LatitudeKind::Planetocentric;
    }
    base_meridian_rad = base.GetPrimeMeridian() * std::numbers::pi / 180.0;
    ellipsoid = Ellipsoid{base.GetSemiMajor(), base.GetSemiMinor()};
    if (ellipsoid->flattening() < 1e-12) {
        ellipsoid->polar_m = ellipsoid->equatorial_m;
    }
    const auto attribute = [this](const char* key) {
        const char* value = base.GetAttrValue(key);
        return std::string(value != nullptr ? value : "");
    };
    const std::string words = name + " / " + std::string(base.GetName() ? base.GetName() : "") +
                              " / " + attribute("DATUM") + " / " + attribute("SPHEROID");
    body = bodyMentioned(words);
    const auto has_plausible_radius = [this] {
        constexpr double kFactorMax = 1.3; // small bodies are irregular
        const double ratio = ellipsoid->equatorial_m / body->ellipsoid.equatorial_m;
        return ratio < kFactorMax && ratio > 1.0 / kFactorMax;
    };
    if (body == nullptr || !has_plausible_radius()) {
        body = bodyOfRadius(ellipsoid->equatorial_m);
    }
}

void Crs::Impl::readVertical()
{
    if (srs.IsCompound() == 0 && srs.IsVertical() == 0) {
        return;
    }
    const char* datum = srs.GetAttrValue("VERT_CS");
    vertical_datum_name = datum != nullptr ? datum : "";
    const char* vertical_name = nullptr;
    const double meters = srs.GetTargetLinearUnits("VERT_CS", &vertical_name);
    vertical_unit = verticalUnitFrom(vertical_name != nullptr ? vertical_name : "");
    if (!vertical_unit && meters > 0.0 && vertical_name != nullptr) {
        vertical_unit = VerticalUnit{vertical_name, meters};
    }
}

// The registry has degrees, whatever the unit of the system.
void Crs::Impl::readAreaOfUse()
{
    double west = 0.0;
    double south = 0.0;
    double east = 0.0;
    double north = 0.0;
    constexpr double kUnknown = -1000.0; // of each bound, as PROJ has it
    const bool is_known = srs.GetAreaOfUse(&west, &south, &east, &north, nullptr) &&
                          west != kUnknown && south != kUnknown;
    constexpr double kTurn = 360.0;
    if (is_known && east - west < kTurn) {
        area_of_use = GeographicArea{.west = Angle::degrees(west),
                                     .south = Angle::degrees(south),
                                     .east = Angle::degrees(east),
                                     .north = Angle::degrees(north)};
    }
}

Status Crs::Impl::readHorizontal()
{
    axes = layoutOf(srs);
    setEastNorthOrder(srs);
    const bool is_spherical = srs.IsProjected() == 0 && hasSphericalAxes(srs);
    if (srs.IsGeocentric() != 0 && !is_spherical) {
        return Error{
            ErrorCode::Unsupported,
            fmt::format("CRS \"{}\" is geocentric; a map needs a geographic or projected one",
                        name)};
    }
    if (srs.IsLocal() != 0 ||
        (srs.IsProjected() == 0 && srs.IsGeographic() == 0 && !is_spherical)) {
        const char* local_unit = nullptr;
        unit = srs.GetLinearUnits(&local_unit);
        unit_name = local_unit != nullptr ? local_unit : "metre";
        notices.push_back(
            fmt::format("CRS \"{}\" has no body, so its coordinates are read as lengths; set "
                        "another CRS to get longitude and latitude",
                        name));
        return Done{};
    }
    if (srs.IsGeographic() != 0 && srs.IsDerivedGeographic() == 0) {
        kind = CrsKind::Geographic;
        base = srs;
        readBase();
        // GeoTIFF stores the name of systems such as IAU_2015:49902, but not their spherical axes.
        if (containsText(name, "ocentric")) {
            latitude_kind = LatitudeKind::Planetocentric;
        }
    } else if (is_spherical) {
        kind = CrsKind::Geographic;
        base = srs;
        readBase();
    } else {
        kind = CrsKind::Projected;
        const char* linear_unit = nullptr;
        unit = srs.GetTargetLinearUnits("PROJCS", &linear_unit);
        unit_name = linear_unit != nullptr ? linear_unit : "metre";
        // Old planetary products write a scale factor of 0 to mean "none".
        if (srs.IsProjected() != 0 && srs.FindProjParm(SRS_PP_SCALE_FACTOR) >= 0 &&
            srs.GetNormProjParm(SRS_PP_SCALE_FACTOR, 1.0) == 0.0) {
            srs.SetNormProjParm(SRS_PP_SCALE_FACTOR, 1.0);
            notices.emplace_back("the projection's scale factor is 0, which is invalid; 1 is used");
        }
        if (srs.IsDerivedGeographic() != 0) {
            // OGR has no access to the underlying system: it reports the rotated one as its own
            // base.
            return Error{ErrorCode::Unsupported,
                         fmt::format("CRS \"{}\" has a rotated pole, which is not supported; warp "
                                     "the map to a plain geographic or projected CRS",
                                     name)};
        }
        const std::unique_ptr<OGRSpatialReference> geographic(srs.CloneGeogCS());
        if (!geographic) {
            return Error{ErrorCode::Unsupported,
                         fmt::format("CRS \"{}\" has no underlying geographic system", name)};
        }
        base = *geographic;
        readBase();
        false_origin = {srs.GetProjParm(SRS_PP_FALSE_EASTING, 0.0),
                        srs.GetProjParm(SRS_PP_FALSE_NORTHING, 0.0)};
        const QuietErrors quiet;
        to_base.reset(OGRCreateCoordinateTransformation(&srs, &base));
        from_base.reset(OGRCreateCoordinateTransformation(&base, &srs));
        if (!to_base || !from_base) {
            return Error{ErrorCode::Unsupported, fmt::format("PROJ cannot compute CRS \"{}\": {}",
                                                             name, CPLGetLastErrorMsg())};
        }
        return Done{};
    }
    unit = base_unit_rad;
    const char* angular_unit = nullptr;
    srs.GetAngularUnits(&angular_unit);
    unit_name = angular_unit != nullptr && !is_spherical ? angular_unit : "degree";
    turn = 2.0 * std::numbers::pi / base_unit_rad;
    return Done{};
}

Crs::Crs(std::shared_ptr<const Impl> impl)
    : impl_(std::move(impl))
{}

Result<Crs> Crs::fromText(const std::string& text)
{
    const QuietErrors quiet;
    OGRSpatialReference srs;
    if (srs.SetFromUserInput(text.c_str(),
                             OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS_get()) !=
        OGRERR_NONE) {
        return Error{
            ErrorCode::Invalid,
            fmt::format("unknown CRS \"{}\"; enter an EPSG or IAU code, a PROJ string or WKT",
                        text)};
    }
    if (srs.IsVertical() != 0 && srs.IsCompound() == 0) {
        return Error{ErrorCode::Unsupported,
                     fmt::format("CRS \"{}\" is vertical: it has heights, but no positions; a map "
                                 "needs a geographic or projected one",
                                 nameOf(srs))};
    }
    return fromSpatialReference(srs);
}

Result<Crs> Crs::fromSpatialReference(const OGRSpatialReference& reference)
{
    auto impl = std::make_shared<Impl>();
    impl->srs = reference;
    impl->name = nameOf(reference);
    impl->wkt = exportWkt(reference);
    impl->readVertical();
    impl->readAreaOfUse();
    impl->srs.DemoteTo2D(nullptr);
    if (impl->srs.IsCompound() != 0) {
        impl->srs.StripVertical();
    }
    Status horizontal = impl->readHorizontal();
    if (!horizontal) {
        return std::move(horizontal).error();
    }
    if (impl->to_base && isCylindrical(impl->srs)) {
        const double meridian = impl->srs.GetNormProjParm(SRS_PP_CENTRAL_MERIDIAN, 0.0);
        const auto origin = impl->transform(*impl->from_base, meridian, 0.0);
        const auto quarter = impl->transform(*impl->from_base, meridian + 90.0, 0.0);
        if (origin && quarter) {
            impl->turn = 4.0 * std::abs(quarter->x - origin->x);
        }
        const double right_angle = std::numbers::pi / 2.0 / impl->base_unit_rad;
        const auto north = impl->transform(*impl->from_base, meridian, right_angle);
        const auto south = impl->transform(*impl->from_base, meridian, -right_angle);
        if (north && south) {
            impl->north_pole_y = std::max(north->y, south->y);
            impl->south_pole_y = std::min(north->y, south->y);
        }
    }
    return Crs(std::move(impl));
}

Crs Crs::geographic(const Body& body, const Ellipsoid& ellipsoid)
{
    OGRSpatialReference srs;
    const std::string body_name(body.name);
    const std::string name =
        body_name + (body.latitude == LatitudeKind::Planetocentric ? " / Ocentric" : " / Ographic");
    const double inverse_flattening = ellipsoid.isSphere() ? 0.0 : 1.0 / ellipsoid.flattening();
    srs.SetGeogCS(name.c_str(), body_name.c_str(), body_name.c_str(), ellipsoid.equatorial_m,
                  inverse_flattening);
    Result<Crs> crs = fromSpatialReference(srs);
    MARSVIEW_CHECK(crs.has_value());
    return std::move(crs).value();
}

Result<Crs> Crs::onEllipsoid(const Ellipsoid& ellipsoid, const std::string& body_name) const
{
    if (impl_->kind == CrsKind::Local) {
        return Error{ErrorCode::Invalid,
                     fmt::format("CRS \"{}\" is local and has no ellipsoid", name())};
    }
    if (!(ellipsoid.polar_m > 0.0) || !(ellipsoid.equatorial_m >= ellipsoid.polar_m) ||
        !std::isfinite(ellipsoid.equatorial_m)) {
        return Error{
            ErrorCode::OutOfRange,
            fmt::format("an equatorial radius of {} m and a polar radius of {} m are impossible; "
                        "give a polar radius above 0 and not above the equatorial one",
                        ellipsoid.equatorial_m, ellipsoid.polar_m)};
    }
    OGRSpatialReference srs = impl_->srs;
    const bool is_centric =
        impl_->kind == CrsKind::Geographic && impl_->latitude_kind == LatitudeKind::Planetocentric;
    const std::string geographic_name = body_name + (is_centric ? " / Ocentric" : " / Ographic");
    const double inverse_flattening = ellipsoid.isSphere() ? 0.0 : 1.0 / ellipsoid.flattening();
    // In degrees for every unit of the system.
    const double meridian_deg = impl_->base_meridian_rad * 180.0 / std::numbers::pi;
    const QuietErrors quiet;
    bool is_moved =
        srs.SetGeogCS(geographic_name.c_str(), body_name.c_str(), body_name.c_str(),
                      ellipsoid.equatorial_m, inverse_flattening, nullptr, meridian_deg,
                      angularUnitName(impl_->base).c_str(), impl_->base_unit_rad) == OGRERR_NONE;
    if (is_moved && impl_->kind == CrsKind::Geographic && impl_->base_east_sign < 0.0) {
        // A geographic system gets new axes with its new datum; a projected one keeps its own.
        is_moved =
            srs.SetAxes(nullptr, "Latitude", OAO_North, "Longitude", OAO_West) == OGRERR_NONE;
    }
    if (!is_moved) {
        return Error{ErrorCode::Unsupported,
                     fmt::format("CRS \"{}\" cannot be moved to another ellipsoid", name())};
    }
    return fromSpatialReference(srs);
}

const std::string& Crs::name() const
{
    return impl_->name;
}
const std::string& Crs::wkt() const
{
    return impl_->wkt;
}
CrsKind Crs::kind() const
{
    return impl_->kind;
}
const std::optional<Ellipsoid>& Crs::ellipsoid() const
{
    return impl_->ellipsoid;
}
const Body* Crs::body() const
{
    return impl_->body;
}
LatitudeKind Crs::latitudeKind() const
{
    return impl_->latitude_kind;
}
double Crs::unit() const
{
    return impl_->unit;
}
const std::string& Crs::unitName() const
{
    return impl_->unit_name;
}
double Crs::eastSign() const
{
    return impl_->axes.east_sign;
}
double Crs::northSign() const
{
    return impl_->axes.north_sign;
}
const std::optional<double>& Crs::turn() const
{
    return impl_->turn;
}
const std::optional<GeographicArea>& Crs::areaOfUse() const
{
    return impl_->area_of_use;
}
MapPoint Crs::falseOrigin() const
{
    return impl_->false_origin;
}
const std::optional<VerticalUnit>& Crs::verticalUnit() const
{
    return impl_->vertical_unit;
}
const std::string& Crs::verticalDatumName() const
{
    return impl_->vertical_datum_name;
}
const std::vector<std::string>& Crs::notices() const
{
    return impl_->notices;
}

std::optional<GeographicPoint> Crs::toGeographic(MapPoint map) const
{
    switch (impl_->kind) {
    case CrsKind::Geographic:
        return impl_->fromAngles(map);
    case CrsKind::Projected:
        if (const auto base = impl_->inverse(map)) {
            return impl_->fromBase(base->x, base->y);
        }
        return std::nullopt;
    case CrsKind::Local:
        return std::nullopt;
    }
    return std::nullopt;
}

std::optional<MapPoint> Crs::toMap(GeographicPoint geographic) const
{
    switch (impl_->kind) {
    case CrsKind::Geographic:
        return impl_->toBase(geographic);
    case CrsKind::Projected: {
        MapPoint base = impl_->toBase(geographic);
        // PROJ refuses longitudes beyond 10 rad, and callers may pass any number of turns.
        base.x = std::remainder(base.x, 2.0 * std::numbers::pi / impl_->base_unit_rad);
        return impl_->transform(*impl_->from_base, base.x, base.y);
    }
    case CrsKind::Local:
        return std::nullopt;
    }
    return std::nullopt;
}

} // namespace marsview
