// Which names of places a picture of the terrain shows, and where.
#pragma once

#include "core/names/gazetteer.h"
#include "core/session/body_terrain.h"
#include "core/session/scene_surface.h"
#include "core/view/label_placement.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace marsview {

/// Whether no terrain is between the eye and a place on the terrain, with a tolerance of three
/// points of the screen.
bool isVisible(const SceneSurface& ground,
               const CameraPose& camera,
               const Viewport& viewport,
               double exaggeration,
               ScenePoint place,
               double pixels_per_point = 1.0);

/// The same in the scene of a body.
bool isVisible(const BodyScene& ground,
               const CameraPose& camera,
               const Viewport& viewport,
               double exaggeration,
               ScenePoint place,
               double pixels_per_point = 1.0);

/// The size of a label in pixels, and how it lies.
struct LabelSize {
    double width_px = 0.0;
    double height_px = 0.0;
};

/// A name in a picture.
struct NameLabel {
    std::size_t name = 0; // index in the gazetteer
    LabelBox box{};
    PixelPoint place{}; // of the middle of what it names
    LabelAnchor anchor = LabelAnchor::Area;
    double across_px = 0.0; // the diameter of what it names, in the picture; 0: unknown
};

struct NameLabelOptions {
    Viewport viewport{};
    double pixels_per_point = 1.0;
    double exaggeration = 1.0;
    std::span<const LabelBox> obstacles = {};
};

/// The names of a gazetteer on the terrain of a scene, flat or on its body. Not copyable; one
/// thread at a time.
class NameLabels {
public:
    /// Finds where in the scene the names are: some 10 ms for ten thousand names on a projected
    /// map.
    NameLabels(std::shared_ptr<const Gazetteer> names, const SceneSurface& ground);
    NameLabels(std::shared_ptr<const Gazetteer> names, const BodyScene& ground);

    const Gazetteer& names() const noexcept { return *names_; }
    /// Names that are on a map of the scene.
    std::size_t count() const noexcept { return places_.size(); }

    /// The labels of a picture. What looks larger comes first: size and distance both count.
    /// Narrow features, as scarps and troughs, count less than their length, mountains more, and
    /// most the highest ones.
    /// Features need a diameter of 20 points in the picture, lettered craters 48. Names without a
    /// size count as 50 km, or, if no name has a size, are shown at any distance. At most one label
    /// for each 30,000 square points, 5 to 60 in all. Labels do not overlap each other nor the
    /// obstacles. A place that the terrain hides has none. Labels of the
    /// picture before are preferred a little, so that they do not flicker while the camera moves.
    ///
    /// `size_of` returns the size of a label that spans `across_px`.
    std::vector<NameLabel>
    inPicture(const CameraPose& camera,
              const NameLabelOptions& options,
              const std::function<LabelSize(std::size_t name, double across_px)>& size_of);

private:
    struct Place {
        std::size_t name = 0;
        ScenePoint foot; // at height 0
        Vec3 up;
        double height_m = 0.0; // as read last
        bool was_shown = false;

        ScenePoint point(double exaggeration) const
        {
            return foot + up * (height_m * exaggeration);
        }
    };

    double heightAt(const Place& place) const;
    HeightRange range() const;

    std::shared_ptr<const Gazetteer> names_;
    SceneSurface flat_;
    BodyScene body_;            // or this; the other is empty
    std::vector<Place> places_; // the largest first
};

} // namespace marsview
