// Smooth motions of the camera through several cameras, or along a line on the terrain.
//
// Everything is in scene meters, on the flat map or in the body-fixed frame. Between two cameras
// the motion is the one of least apparent change: far flights climb, cross, and descend (van Wijk
// and Nuij, "Smooth and efficient zooming and panning", 2003).
#pragma once

#include "core/globe/body_camera.h"
#include "core/globe/body_navigation.h"
#include "core/view/camera.h"
#include "core/view/navigation.h"

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace marsview {

/// How fast a camera moves along its path.
enum class FlightPace {
    Constant,   // the picture changes equally fast all the way
    SlowAtViews // comes to rest at every camera of the path
};

/// A flight along a line.
struct LineFlight {
    double distance_m = 1.0;           // of the camera from the line, > 0
    Angle tilt = Angle::degrees(65.0); // 0 looks straight down
    Angle field_of_view = Angle::degrees(40.0);
};

/// A camera as a function of time. It and its first derivative are continuous. Immutable.
class CameraPath {
public:
    /// Through all of `cameras`, of which there is at least one, in their order.
    static CameraPath throughCameras(const std::vector<OrbitCamera>& cameras, FlightPace pace);
    /// The same over a body: the targets follow great circles.
    static CameraPath
    throughCameras(const std::vector<BodyCamera>& cameras, FlightPace pace, const Ellipsoid& body);
    /// Looks along a line of at least two different points, from behind the point that it follows,
    /// with constant speed over the ground. Corners are rounded over half the distance.
    static CameraPath alongLine(const std::vector<ScenePoint>& line, const LineFlight& flight);
    /// The same over a body, along points of the body-fixed frame.
    static CameraPath
    alongLine(const std::vector<ScenePoint>& line, const LineFlight& flight, const Ellipsoid& body);

    /// The same motion, raised where the eye would be lower than a fortieth of its distance above
    /// the terrain. Calls `ground` some thousand times.
    CameraPath above(const GroundQuery& ground) const;
    CameraPath above(const BodyGround& ground) const;

    bool isOnBody() const noexcept { return body_.has_value(); }
    /// `share` of the time, 0 to 1; values outside mean the ends. Of a path over the flat map.
    OrbitCamera at(double share) const;
    /// The same of a path over a body.
    BodyCamera bodyCameraAt(double share) const;
    /// How much the picture changes from beginning to end: about 1 for a motion by the width of the
    /// picture, or for zooming by a factor of 4. 0 if nothing moves.
    double length() const noexcept { return length_; }
    /// The shares of time at which the cameras of throughCameras() are reached; 0 and 1 for a line.
    const std::vector<double>& stops() const noexcept { return stops_; }

private:
    /// Target, logarithm of the distance, azimuth, tilt, field of view. On a body, the target is
    /// given by its direction from the center, a radius long, and its height, which comes last.
    static constexpr std::size_t kParts = 8;
    using Parts = std::array<double, kParts>;
    struct Knot {
        double s = 0.0; // increases from knot to knot
        Parts value{};
        Parts slope{};
    };
    /// How much each part counts in the length of a motion.
    struct Weights {
        double pan = 1.0;
        double zoom = 1.0;
        double turn = 1.0;
    };

    static Parts partsOf(const OrbitCamera& camera);
    static Parts partsOf(const BodyCamera& camera, const Ellipsoid& body);
    static OrbitCamera cameraOf(const Parts& parts);
    static BodyCamera bodyCameraOf(const Parts& parts);
    static double lengthBetween(const Parts& from, const Parts& to, const Weights& weights);
    void addFlight(std::vector<Parts>& points, const Parts& from, const Parts& to) const;
    void flyThrough(const std::vector<Parts>& cameras, FlightPace pace);
    void followLine(const std::vector<Parts>& line, const LineFlight& flight);
    double headingAlong(const Parts& behind, const Parts& at, const Parts& ahead) const;
    Parts partsAt(double share) const;
    void lift(const std::function<double(double share)>& missing_m);
    void setKnots(const std::vector<Parts>& points, const Weights& weights);
    void setClock(const Weights& weights);
    double clockSpeed(double s, const Weights& weights) const;
    double parameterAt(double time) const;
    /// Parts and their slopes at `s`.
    Knot knotAt(double s) const;
    double paced(double share) const;
    double liftAt(double share) const;

    std::optional<Ellipsoid> body_; // empty for the flat map
    std::vector<Knot> knots_;
    /// Time as a function of the parameter.
    struct Tick {
        double s = 0.0;
        double time = 0.0;
        double speed = 1.0; // of time by parameter
    };
    std::vector<Tick> clock_;
    double length_ = 0.0;
    FlightPace pace_ = FlightPace::Constant;
    std::vector<double> stops_;
    std::vector<double> lift_m_; // at equal steps of the share; empty: none
    std::vector<double> lift_slope_;
};

} // namespace marsview
