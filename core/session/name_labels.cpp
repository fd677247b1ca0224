#include "core/session/name_labels.h"

#include "core/globe/body_camera.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>
#include <utility>

namespace marsview {
namespace {

// The least diameter in the picture, in points of the screen.
constexpr double kAcrossPointsMin = 20.0;
constexpr double kLetteredAcrossPointsMin = 48.0;

// A feature this many times as wide as the picture is not what the picture shows.
constexpr double kPicturesAcrossMax = 12.0;

constexpr double kUnknownDiameterM = 50e3;

constexpr std::size_t kRequestsMax = 400; // the largest
// Square points of the screen for each label, so that the terrain stays in sight between them.
constexpr double kPointsPerLabel = 30e3;
constexpr double kLabelsMin = 5.0;
constexpr double kLabelsMax = 60.0;
constexpr double kGapPoints = 6.0;
constexpr double kPointClearPoints = 6.0;
constexpr double kShownBefore = 1.25; // counts as so much larger
constexpr double kHighest = 2.5;    // times more for the highest mountain than for one half as high
constexpr double kLiftPoints = 3.0; // of the place for the ray that looks for it

// The gazetteers state the length of narrow features as their diameter.
double weightOf(PlaceKind kind)
{
    switch (kind) {
    case PlaceKind::CraterChain:
    case PlaceKind::Ridge:
    case PlaceKind::Scarp:
    case PlaceKind::Trough:
        return 0.3;
    case PlaceKind::Valley:
        return 0.6;
    case PlaceKind::Mountain:
        return 1.5;
    default:
        return 1.0;
    }
}

// Mountains are landmarks by their height rather than by their width.
double weightOf(PlaceKind kind, double height_m, const HeightRange& heights)
{
    const double weight = weightOf(kind);
    if (kind != PlaceKind::Mountain) {
        return weight;
    }
    const double half_m = 0.5 * (heights.maximum_m - heights.minimum_m);
    const double rise = half_m > 0.0 ? (height_m - heights.minimum_m) / half_m - 1.0 : 0.0;
    return weight * (1.0 + kHighest * std::clamp(rise, 0.0, 1.0));
}

// A feature in the picture.
struct Seen {
    std::size_t place = 0; // index
    double across_px = 0.0;
    double importance = 0.0;
};

// The camera of one picture.
class Picture {
public:
    Picture(const CameraPose& camera, const NameLabelOptions& options)
        : camera_(camera)
        , viewport_(options.viewport)
        , eye_(camera.eye)
        , axes_(camera.axes)
        , pixels_at_unit_(0.5 * viewport_.height / std::tan(0.5 * camera.field_of_view.radians()))
    {}

    // In pixels for a meter across; nothing where the point is not in the picture.
    std::optional<double> scaleAt(const ScenePoint& point) const
    {
        const Vec3 to = point - eye_;
        const double depth_m = dot(to, axes_.forward);
        if (!(depth_m > 0.0)) {
            return std::nullopt;
        }
        const double scale = pixels_at_unit_ / depth_m;
        return std::abs(dot(to, axes_.right)) * scale <= 0.5 * viewport_.width &&
                       std::abs(dot(to, axes_.up)) * scale <= 0.5 * viewport_.height
                   ? std::optional(scale)
                   : std::nullopt;
    }
    std::optional<PixelPoint> pixel(const ScenePoint& point) const
    {
        return project(camera_, viewport_, point);
    }

private:
    const CameraPose& camera_;
    Viewport viewport_;
    ScenePoint eye_;
    CameraAxes axes_;
    double pixels_at_unit_;
};

} // namespace

namespace {

template <typename Ground>
bool isVisibleOn(const Ground& ground,
                 const CameraPose& camera,
                 double exaggeration,
                 const ScenePoint& place)
{
    const Vec3 to = place - camera.eye;
    const double distance_m = length(to);
    const auto hit =
        ground.cast({.origin = camera.eye, .direction = to * (1.0 / distance_m)}, exaggeration);
    if constexpr (std::is_same_v<Ground, BodyScene>) {
        return !hit || hit->hit.distance_m >= distance_m;
    } else {
        return !hit || hit->distance_m >= distance_m;
    }
}

// Above the terrain, or the ray may hit it just before the place.
double liftM(const CameraPose& camera,
             const Viewport& viewport,
             const ScenePoint& place,
             double pixels_per_point)
{
    return kLiftPoints * pixels_per_point * metersPerPixel(camera, viewport, place);
}

} // namespace

bool isVisible(const SceneSurface& ground,
               const CameraPose& camera,
               const Viewport& viewport,
               double exaggeration,
               ScenePoint place,
               double pixels_per_point)
{
    place.z += liftM(camera, viewport, place, pixels_per_point);
    return isVisibleOn(ground, camera, exaggeration, place);
}

bool isVisible(const BodyScene& ground,
               const CameraPose& camera,
               const Viewport& viewport,
               double exaggeration,
               ScenePoint place,
               double pixels_per_point)
{
    const Vec3 up = localAxes(ground.ellipsoid(), placeOf(place, ground.ellipsoid()).foot).up;
    return isVisibleOn(ground, camera, exaggeration,
                       place + up * liftM(camera, viewport, place, pixels_per_point));
}

NameLabels::NameLabels(std::shared_ptr<const Gazetteer> names, const SceneSurface& ground)
    : names_(std::move(names))
    , flat_(ground)
{
    if (flat_.isEmpty()) {
        return;
    }
    const Georeference& scene = flat_.maps().front().map->georeference();
    const SceneBox box = flat_.box(1.0);
    for (std::size_t i = 0; i < names_->names().size(); ++i) {
        const auto grid = scene.toGrid(names_->names()[i].position);
        if (!grid) {
            continue;
        }
        const ScenePoint point = scene.sceneFrame().toScene(*grid, 0.0);
        if (point.x >= box.minimum.x && point.x <= box.maximum.x && point.y >= box.minimum.y &&
            point.y <= box.maximum.y) {
            places_.push_back({.name = i, .foot = {point.x, point.y, 0.0}, .up = {0.0, 0.0, 1.0}});
        }
    }
    for (Place& place : places_) {
        const double height_m = heightAt(place);
        place.height_m = std::isfinite(height_m) ? height_m : 0.0;
    }
}

NameLabels::NameLabels(std::shared_ptr<const Gazetteer> names, const BodyScene& ground)
    : names_(std::move(names))
    , body_(ground)
{
    if (body_.isEmpty()) {
        return;
    }
    for (std::size_t i = 0; i < names_->names().size(); ++i) {
        const GeographicPoint& position = names_->names()[i].position;
        const double height_m = body_.height(position);
        if (std::isfinite(height_m)) {
            places_.push_back({.name = i,
                               .foot = targetOf({.target = position}, body_.ellipsoid()),
                               .up = localAxes(body_.ellipsoid(), position).up,
                               .height_m = height_m});
        }
    }
}

double NameLabels::heightAt(const Place& place) const
{
    return body_.isEmpty() ? flat_.height(place.foot.x, place.foot.y)
                           : body_.height(names_->names()[place.name].position);
}

HeightRange NameLabels::range() const
{
    if (!body_.isEmpty()) {
        return body_.range();
    }
    const SceneBox box = flat_.box(1.0);
    return {box.minimum.z, box.maximum.z};
}

std::vector<NameLabel>
NameLabels::inPicture(const CameraPose& camera,
                      const NameLabelOptions& options,
                      const std::function<LabelSize(std::size_t, double)>& size_of)
{
    const Picture picture(camera, options);
    const double scale = options.pixels_per_point;
    const bool has_sizes = names_->hasSizes();
    const double across_px_max = kPicturesAcrossMax * options.viewport.width;
    const HeightRange heights = range();
    std::vector<Seen> seen;
    for (std::size_t i = 0; i < places_.size(); ++i) {
        const Place& place = places_[i];
        const PlaceName& name = names_->names()[place.name];
        const ScenePoint point = place.point(options.exaggeration);
        if (!body_.isEmpty() && !(dot(camera.eye - point, place.up) > 0.0)) {
            continue; // behind the horizon
        }
        const auto pixels_per_m = picture.scaleAt(point);
        if (!pixels_per_m) {
            continue;
        }
        const double diameter_m = name.diameter_m > 0.0 ? name.diameter_m
                                  : has_sizes           ? kUnknownDiameterM
                                                        : 0.0;
        const double across_px = diameter_m * *pixels_per_m;
        const double least =
            name.kind == PlaceKind::LetteredCrater ? kLetteredAcrossPointsMin : kAcrossPointsMin;
        if (has_sizes &&
            (across_px * weightOf(name.kind) < least * scale || across_px > across_px_max)) {
            continue;
        }
        seen.push_back({.place = i,
                        .across_px = name.diameter_m > 0.0 ? across_px : 0.0,
                        .importance = (has_sizes ? across_px : *pixels_per_m) *
                                      weightOf(name.kind, place.height_m, heights) *
                                      (place.was_shown ? kShownBefore : 1.0)});
    }
    const std::size_t count = std::min(seen.size(), kRequestsMax);
    std::partial_sort(seen.begin(), seen.begin() + static_cast<std::ptrdiff_t>(count), seen.end(),
                      [](const Seen& a, const Seen& b) {
                          return a.importance != b.importance ? a.importance > b.importance
                                                              : a.place < b.place;
                      });
    seen.resize(count);
    std::vector<LabelRequest> requests;
    std::vector<ScenePoint> points;
    std::vector<Seen> requested;
    for (const Seen& feature : seen) {
        Place& place = places_[feature.place];
        const double height_m = heightAt(place);
        if (!std::isfinite(height_m)) {
            continue; // no terrain there
        }
        place.height_m = height_m;
        const ScenePoint point = place.point(options.exaggeration);
        const auto pixel = picture.pixel(point);
        if (!pixel) {
            continue;
        }
        const LabelSize size = size_of(place.name, feature.across_px);
        const bool is_area = feature.across_px > 0.0;
        requests.push_back({.place = *pixel,
                            .width_px = size.width_px,
                            .height_px = size.height_px,
                            .anchor = is_area ? LabelAnchor::Area : LabelAnchor::Point,
                            .clear_px = is_area ? 0.0 : kPointClearPoints * scale});
        points.push_back(point);
        requested.push_back(feature);
    }
    const double square_points =
        static_cast<double>(options.viewport.width) * options.viewport.height / (scale * scale);
    const auto placed =
        placeLabels(requests,
                    {.viewport = options.viewport,
                     .gap_px = kGapPoints * scale,
                     .count_max = static_cast<std::size_t>(
                         std::clamp(square_points / kPointsPerLabel, kLabelsMin, kLabelsMax)),
                     .obstacles = options.obstacles},
                    [&](std::size_t index) {
                        return body_.isEmpty()
                                   ? isVisible(flat_, camera, options.viewport,
                                               options.exaggeration, points[index], scale)
                                   : isVisible(body_, camera, options.viewport,
                                               options.exaggeration, points[index], scale);
                    });
    for (Place& place : places_) {
        place.was_shown = false;
    }
    std::vector<NameLabel> labels;
    for (const PlacedLabel& label : placed) {
        const Seen& feature = requested[label.request];
        Place& place = places_[feature.place];
        place.was_shown = true;
        labels.push_back({.name = place.name,
                          .box = label.box,
                          .place = requests[label.request].place,
                          .anchor = requests[label.request].anchor,
                          .across_px = feature.across_px});
    }
    return labels;
}

} // namespace marsview
