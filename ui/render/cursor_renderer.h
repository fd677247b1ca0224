// Drawing the cursor: a small solid in the scene, its shadow on the ground, and the spring that
// ties it to the hand.
#pragma once

#include "core/base/result.h"
#include "core/view/camera.h"

#include <memory>
#include <optional>
#include <vector>

namespace marsview {

/// Red, as in the paper's figures.
constexpr float kCursorRed = 0.86F;
constexpr float kCursorGreen = 0.10F;
constexpr float kCursorBlue = 0.08F;

/// As in section 4.2 of the paper "Large Haptic Topographic Maps".
enum class CursorShape {
    Sphere,     // in free space
    Cone,       // on the ground: its tip points at the place
    FlatSphere, // while the map is moved
    LongSphere, // while the map is zoomed
};

/// The directions of a cursor, of length 1 and perpendicular to each other, right-handed.
struct CursorAxes {
    Vec3 right{1.0, 0.0, 0.0};
    Vec3 ahead{0.0, 1.0, 0.0};
    Vec3 up{0.0, 0.0, 1.0};
};

/// All in coordinates of the scene. Sizes stay the same on screen.
struct CursorPicture {
    CursorShape shape = CursorShape::Sphere;
    ScenePoint position; // the middle of a sphere, the tip of the cone
    CursorAxes axes{};
    std::optional<ScenePoint> goal{}; // where the hand is, when the ground keeps it from there
    std::vector<ScenePoint> shadow{}; // a ring on the ground, counterclockwise; may be empty
    double pixels_per_point = 1.0;    // of the screen
};

/// Every call needs the context current in which it was created, the destructor included. Leaves no
/// program, buffer or vertex array bound.
class CursorRenderer {
public:
    static Result<std::unique_ptr<CursorRenderer>> create();
    ~CursorRenderer();
    CursorRenderer(const CursorRenderer&) = delete;
    CursorRenderer& operator=(const CursorRenderer&) = delete;

    /// Draws over a picture of the terrain in the bound frame buffer. Terrain in front of the
    /// cursor hides it; the spring and the goal show through the terrain.
    void draw(const CursorPicture& cursor,
              const CameraPose& camera,
              const Viewport& viewport,
              const ClipRange& clip);

private:
    struct Impl;
    explicit CursorRenderer(std::unique_ptr<Impl> impl);

    std::unique_ptr<Impl> impl_;
};

/// Where the terrain may hide a cursor, or its shadow.
PixelArea areaOfCursor(const CursorPicture& cursor, const CameraPose& camera, const Viewport& size);

} // namespace marsview
