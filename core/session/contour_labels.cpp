#include "core/session/contour_labels.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <utility>

namespace marsview {
namespace {

constexpr double kGridPoints = 44.0;       // between the rays that look for contours
constexpr double kApartPoints = 30.0;      // between labels
constexpr double kSameApartPoints = 220.0; // between labels of one elevation
constexpr std::size_t kContourLabelsMax = 40;
constexpr int kContourBisections = 7;
// How far, in intervals, the contour may be from the ends of its text.
constexpr double kStraightness = 0.35;

struct ContourHit {
    std::size_t map = 0;
    double elevation_m = 0.0;
    ScenePoint place{};
};

// The terrain that a ray of a picture meets.
using TerrainCast = std::function<std::optional<ContourHit>(const Ray& ray)>;

// Finds contours in one picture.
class ContourSearch {
public:
    // `maps` are those that hits have the indexes of.
    ContourSearch(TerrainCast cast,
                  const std::vector<const Map*>& maps,
                  const CameraPose& pose,
                  const TerrainLook& look,
                  const ContourLabelOptions& options)
        : cast_(std::move(cast))
        , pose_(pose)
        , options_(options)
    {
        const double pixel_m = metersPerPixel(pose, options.viewport);
        for (const Map* map : maps) {
            intervals_m_.push_back(
                contourInterval(look, map->heightfield().range().value_or(HeightRange{}), pixel_m,
                                options.exaggeration));
        }
    }

    double interval(std::size_t map) const { return intervals_m_[map]; }

    std::optional<ContourHit> at(PixelPoint pixel) const
    {
        return cast_(pickRay(pose_, options_.viewport, pixel));
    }

    // Where the only index contour between two pixels is, if the terrain runs on between them.
    std::optional<std::pair<double, PixelPoint>>
    crossing(PixelPoint a,
             const std::optional<ContourHit>& at_a,
             PixelPoint b,
             const std::optional<ContourHit>& at_b) const
    {
        if (!at_a || !at_b || at_a->map != at_b->map || !(interval(at_a->map) > 0.0)) {
            return std::nullopt;
        }
        const double step_m = kIndexContour * interval(at_a->map);
        const double low = std::floor(at_a->elevation_m / step_m);
        const double high = std::floor(at_b->elevation_m / step_m);
        if (std::abs(high - low) != 1.0) {
            return std::nullopt;
        }
        const double elevation_m = std::max(low, high) * step_m;
        ContourHit first = *at_a;
        ContourHit second = *at_b;
        for (int i = 0; i < kContourBisections; ++i) {
            const PixelPoint middle{(a.x + b.x) / 2.0, (a.y + b.y) / 2.0};
            const auto hit = at(middle);
            if (!hit || hit->map != first.map) {
                return std::nullopt;
            }
            if ((hit->elevation_m < elevation_m) == (first.elevation_m < elevation_m)) {
                a = middle;
                first = *hit;
            } else {
                b = middle;
                second = *hit;
            }
        }
        // A jump from one ridge to another is no contour.
        if (std::abs(first.elevation_m - second.elevation_m) > 0.5 * interval(first.map)) {
            return std::nullopt;
        }
        return std::pair(elevation_m, PixelPoint{(a.x + b.x) / 2.0, (a.y + b.y) / 2.0});
    }

    // The label at a point of a contour; empty where the contour bends too much along the text.
    std::optional<ContourLabel>
    labelAt(double elevation_m, PixelPoint middle, double width_px, double height_px) const
    {
        const double probe = 3.0 * options_.pixels_per_point;
        const auto left = at({middle.x - probe, middle.y});
        const auto right = at({middle.x + probe, middle.y});
        const auto above = at({middle.x, middle.y - probe});
        const auto below = at({middle.x, middle.y + probe});
        if (!left || !right || !above || !below) {
            return std::nullopt;
        }
        const double across = right->elevation_m - left->elevation_m;
        const double down = below->elevation_m - above->elevation_m;
        if (!(std::hypot(across, down) > 0.0)) {
            return std::nullopt;
        }
        double angle = std::atan2(-across, down); // along the contour
        if (std::abs(angle) > std::numbers::pi / 2.0) {
            angle = std::remainder(angle + std::numbers::pi, 2.0 * std::numbers::pi);
        }
        const double half = width_px / 2.0;
        const PixelPoint along{std::cos(angle), std::sin(angle)};
        const PixelPoint a{middle.x - half * along.x, middle.y - half * along.y};
        const PixelPoint b{middle.x + half * along.x, middle.y + half * along.y};
        const auto from = at(a);
        const auto to = at(b);
        if (!from || !to || from->map != left->map || to->map != left->map) {
            return std::nullopt;
        }
        const double away_m = std::max(std::abs(from->elevation_m - elevation_m),
                                       std::abs(to->elevation_m - elevation_m));
        if (away_m > kStraightness * interval(left->map)) {
            return std::nullopt;
        }
        ContourLabel label{.elevation_m = elevation_m,
                           .from = from->place,
                           .to = to->place,
                           .middle = middle,
                           .angle_rad = angle,
                           .box = {}};
        const double x = half * std::abs(along.x) + height_px / 2.0 * std::abs(along.y);
        const double y = half * std::abs(along.y) + height_px / 2.0 * std::abs(along.x);
        label.box = {middle.x - x, middle.y - y, middle.x + x, middle.y + y};
        return label;
    }

private:
    TerrainCast cast_;
    CameraPose pose_;
    const ContourLabelOptions& options_;
    std::vector<double> intervals_m_; // of each map
};

LabelBox grown(const LabelBox& box, double by)
{
    return {box.left - by, box.top - by, box.right + by, box.bottom + by};
}

bool isInPicture(const LabelBox& box, const Viewport& viewport)
{
    return box.left >= 0.0 && box.top >= 0.0 && box.right <= viewport.width &&
           box.bottom <= viewport.height;
}

std::vector<ContourLabel> labelsBy(const ContourSearch& search,
                                   const ContourLabelOptions& options,
                                   double height_px,
                                   const std::function<double(double elevation_m)>& width_of)
{
    std::vector<ContourLabel> labels;
    const double step = kGridPoints * options.pixels_per_point;
    const auto columns = static_cast<std::size_t>(options.viewport.width / step) + 1;
    const auto rows = static_cast<std::size_t>(options.viewport.height / step) + 1;
    const auto pixel_of = [step](std::size_t column, std::size_t row) {
        return PixelPoint{(static_cast<double>(column) + 0.5) * step,
                          (static_cast<double>(row) + 0.5) * step};
    };
    std::vector<std::optional<ContourHit>> hits;
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            hits.push_back(search.at(pixel_of(column, row)));
        }
    }
    const double apart = kApartPoints * options.pixels_per_point;
    const double same_apart = kSameApartPoints * options.pixels_per_point;
    const auto has_room = [&](const ContourLabel& label) {
        const LabelBox room = grown(label.box, apart);
        return isInPicture(label.box, options.viewport) &&
               std::none_of(
                   options.obstacles.begin(), options.obstacles.end(),
                   [&](const LabelBox& obstacle) { return obstacle.overlaps(label.box); }) &&
               std::none_of(labels.begin(), labels.end(), [&](const ContourLabel& other) {
                   return room.overlaps(other.box) ||
                          (other.elevation_m == label.elevation_m &&
                           std::hypot(other.middle.x - label.middle.x,
                                      other.middle.y - label.middle.y) < same_apart);
               });
    };
    const auto try_between = [&](std::size_t column, std::size_t row, std::size_t to_column,
                                 std::size_t to_row) {
        if (to_column >= columns || to_row >= rows || labels.size() >= kContourLabelsMax) {
            return;
        }
        const auto found =
            search.crossing(pixel_of(column, row), hits[row * columns + column],
                            pixel_of(to_column, to_row), hits[to_row * columns + to_column]);
        if (!found) {
            return;
        }
        if (const auto label =
                search.labelAt(found->first, found->second, width_of(found->first), height_px);
            label && has_room(*label)) {
            labels.push_back(*label);
        }
    };
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < columns; ++column) {
            try_between(column, row, column, row + 1);
            try_between(column, row, column + 1, row);
        }
    }
    return labels;
}

} // namespace

std::vector<ContourLabel> contourLabels(const SceneSurface& ground,
                                        const OrbitCamera& camera,
                                        const TerrainLook& look,
                                        const ContourLabelOptions& options,
                                        double height_px,
                                        const std::function<double(double elevation_m)>& width_of)
{
    if (!look.has_contours || ground.isEmpty()) {
        return {};
    }
    std::vector<const Map*> maps;
    for (const SceneMap& map : ground.maps()) {
        maps.push_back(map.map.get());
    }
    const auto cast = [&](const Ray& ray) -> std::optional<ContourHit> {
        const auto hit = ground.cast(ray, options.exaggeration);
        if (!hit) {
            return std::nullopt;
        }
        return ContourHit{.map = hit->index,
                          .elevation_m = hit->height_m,
                          .place = ground.maps()[hit->index].frame.toScene(
                              hit->grid, hit->height_m * options.exaggeration)};
    };
    return labelsBy(ContourSearch(cast, maps, CameraPose(camera), look, options), options,
                    height_px, width_of);
}

std::vector<ContourLabel> contourLabels(const BodyScene& ground,
                                        const CameraPose& pose,
                                        const TerrainLook& look,
                                        const ContourLabelOptions& options,
                                        double height_px,
                                        const std::function<double(double elevation_m)>& width_of)
{
    if (!look.has_contours || ground.isEmpty()) {
        return {};
    }
    std::vector<const Map*> maps;
    for (const BodyTerrain& map : ground.maps()) {
        maps.push_back(map.map().get());
    }
    const auto cast = [&](const Ray& ray) -> std::optional<ContourHit> {
        const auto point = ground.cast(ray, options.exaggeration);
        if (!point) {
            return std::nullopt;
        }
        return ContourHit{.map = point->index,
                          .elevation_m = point->hit.height_m,
                          .place = ray.at(point->hit.distance_m)};
    };
    return labelsBy(ContourSearch(cast, maps, pose, look, options), options, height_px, width_of);
}

std::optional<ContourLabel>
labelIn(ContourLabel label, const CameraPose& pose, const Viewport& viewport)
{
    const auto from = project(pose, viewport, label.from);
    const auto to = project(pose, viewport, label.to);
    if (!from || !to) {
        return std::nullopt;
    }
    const PixelPoint middle{(from->x + to->x) / 2.0, (from->y + to->y) / 2.0};
    const double dx = middle.x - label.middle.x;
    const double dy = middle.y - label.middle.y;
    label.middle = middle;
    label.box = {label.box.left + dx, label.box.top + dy, label.box.right + dx,
                 label.box.bottom + dy};
    label.angle_rad = std::atan2(to->y - from->y, to->x - from->x);
    if (std::abs(label.angle_rad) > std::numbers::pi / 2.0) {
        label.angle_rad =
            std::remainder(label.angle_rad + std::numbers::pi, 2.0 * std::numbers::pi);
    }
    return isInPicture(label.box, viewport) ? std::optional(label) : std::nullopt;
}

} // namespace marsview
