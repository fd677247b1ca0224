// The stylus that the mouse moves over a body.
#pragma once

#include "core/body/body_mesh.h"
#include "core/body/layered_mesh.h"
#include "core/body/tiled_body_mesh.h"
#include "core/contact/contact_model.h"
#include "haptics/interaction/stylus.h"
#include "haptics/terrain/touch_map.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace marsview {

/// A point of the terrain of a body, in the body-fixed frame, and the local vertical there.
struct BodyAim {
    std::size_t index = 0; // of the surface
    ScenePoint point;
    Vec3 up;
};

/// As Stylus over flat maps: in contact while it presses, free while it hovers, in the direction of
/// the local vertical under the pointer; a grab keeps that state. Positions and forces are in the
/// body-fixed frame. For the GUI thread: an update takes microseconds.
class BodyStylus {
public:
    struct Surface {
        std::shared_ptr<const BodyMesh> mesh; // of a map in memory
        /// Of a map in tiles, and that map. Without this and a mesh, nothing can be pressed yet.
        std::shared_ptr<const TiledBodyMesh> tiled{};
        std::shared_ptr<const Map> map{};
        /// The map joined with others, which is pressed in place of the mesh; null for a map by
        /// itself. Surfaces that share it are one.
        std::shared_ptr<const LayeredMesh> joined{};
        double radius_m = 1.0; // of the sphere of a VirtualProxy

        bool canBePressed() const noexcept { return mesh || tiled; }
    };
    /// Which surface is the terrain at a point, straight above or below it; nothing without
    /// terrain there.
    using SurfaceAt = std::function<std::optional<std::size_t>(const ScenePoint&)>;

    /// The uppermost first. Lifts the stylus.
    void setGround(std::vector<Surface> surfaces, SurfaceAt surface_at);

    /// In contact, the proxy continues from its position.
    void setModel(ContactModelKind kind);
    ContactModelKind model() const noexcept { return kind_; }

    /// The pointer is over this point, where a screen point has the positive length `point_m`.
    /// While the body is grabbed, goal and proxy do not move.
    void aim(const BodyAim& at, const StylusButtons& buttons, double point_m);
    /// Applies tiles loaded since the last call. Returns true if the proxy may have moved. Call it
    /// about thirty times a second while isWaiting().
    bool refresh();
    /// As Stylus::pressAnew().
    void pressAnew();
    /// Whether the surface below the stylus may still change by itself.
    bool isWaiting() const noexcept { return model_ != nullptr && made_ != nullptr; }
    /// The pointer is not over the terrain, or has left the view.
    void lift();
    /// Changes the pressing depth, within bounds, from the next aim on: deeper if factor > 1.
    void deepen(double factor);

    /// Empty while lifted.
    const std::optional<StylusPose>& pose() const noexcept { return pose_; }
    /// The local vertical where the stylus was aimed at last.
    const Vec3& up() const noexcept { return at_.up; }

private:
    std::vector<const Surface*> tilesOf(const Surface& surface) const;
    void makeModel();
    void releaseModel();
    void press(const ScenePoint& goal);
    void keepOnItsSurface(const ScenePoint& goal);
    bool isOnItsSurface(const ScenePoint& proxy) const;
    void updatePose(StylusMode mode, const ScenePoint& goal);

    std::vector<Surface> surfaces_;
    SurfaceAt surface_at_;
    StylusReach reach_;
    BodyAim at_;
    double point_m_ = 1.0;
    ContactModelKind kind_ = kContactModelDefault;
    std::unique_ptr<TouchMap> touch_;     // of tilesOf(), from its first touch on
    std::shared_ptr<ServoMap> made_;      // on touch_; while in contact
    std::shared_ptr<ContactModel> model_; // while in contact
    std::optional<StylusPose> pose_;
};

} // namespace marsview
