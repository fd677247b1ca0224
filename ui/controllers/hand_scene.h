// The scene that a hand touches, with a haptic device or the mouse: the flat map, or the globe.
#pragma once

#include "core/globe/body_camera.h"
#include "core/session/map.h"
#include "haptics/interaction/stylus.h"
#include "haptics/loop/camera_link.h"
#include "haptics/terrain/servo_map.h"

#include <QObject>
#include <QString>

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace marsview {

/// The maps of a view as a hand touches them, and the camera that the hand moves. Places are those
/// of the scene that the view draws: the body-fixed frame on the globe; elevations are exaggerated.
/// GUI thread.
class HandScene : public QObject {
    Q_OBJECT

public:
    using QObject::QObject;

    /// Goals of recordings are longitude, latitude and elevation.
    virtual bool isOnBody() const = 0;
    /// A device is connected to this scene, or no longer.
    virtual void setInUse(bool is_in_use) = 0;

    // Maps.

    /// Top first. Empty while none is shown or ready to be touched.
    virtual std::vector<std::shared_ptr<const Map>> maps() const = 0;
    /// With which they are touched.
    virtual double exaggeration() const = 0;
    /// False for a map that is only shown.
    virtual bool canTouch(std::size_t index) const = 0;
    /// Why there are none to touch; empty where there are, or no reason is known.
    virtual QString whyNone() const = 0;
    /// The uppermost one straight below or above a hand.
    virtual std::optional<std::size_t> mapAt(const ScenePoint& hand) const = 0;
    /// What is touched from now on, of those that can be.
    virtual void touch(std::size_t index) = 0;
    /// Nothing is.
    virtual void release() = 0;
    /// Which is touched; empty for none, or if it is not shown any more.
    virtual std::optional<std::size_t> touched() const = 0;
    /// The surface of this map, as it is now, is the one that is touched: alone, or joined with
    /// others.
    virtual bool isTouched(std::size_t index) const = 0;
    /// Why maps on top of each other are touched one by one; empty if they are not.
    virtual QString whyApart() const = 0;
    /// The touched map with a new model.
    virtual std::shared_ptr<ServoMap> make(ContactModelKind kind) const = 0;

    // Camera and workspace. Only with maps.

    /// The workspace covers what the camera sees.
    virtual void fit(const WorkspaceBox& workspace, LoopSettings& settings) = 0;
    /// After something else than the hand has moved the camera: CameraLink::keeps().
    virtual bool keepsWorkspace() = 0;
    /// CameraLink::follow().
    virtual LinkStep
    follow(const LoopFrame& loop, const WorkspaceBox& workspace, LoopSettings& settings) = 0;
    /// The part of the workspace, level, above which a simulated hand strokes within the picture;
    /// empty where hardly any terrain is in it.
    virtual std::optional<WorkspaceBox> strokes(const WorkspaceBox& workspace) const = 0;
    /// The highest terrain there, in workspace meters.
    virtual double highestTerrainIn(const WorkspaceBox& rectangle) const = 0;

    // The view.

    /// No map is shown. The rest is only for a view that shows one.
    virtual bool isEmpty() const = 0;
    /// In which the workspace covers what the camera sees.
    virtual WorkspaceFrame fittedFrame(const WorkspaceBox& workspace) const = 0;
    /// Of the terrain.
    virtual HeightRange heightRange() const = 0;
    virtual double heightOf(const ScenePoint& place) const = 0;
    /// The device's stylus; nothing for none.
    virtual void show(const std::optional<StylusPose>& pose) = 0;
    /// The stylus drawn, the device's or the mouse's.
    virtual const std::optional<StylusPose>& shownStylus() const = 0;
    virtual bool isInPicture(const ScenePoint& place) const = 0;
    /// The camera is on its way.
    virtual bool isMoving() const = 0;
    virtual SceneCamera cameraGoal() const = 0;
    /// Ignored if it is a camera of another scene.
    virtual void flyTo(const SceneCamera& camera) = 0;
    virtual void flyToPlace(const ScenePoint& place) = 0;
    /// The chosen tool places points: the first button of the stylus is for it.
    virtual bool isPlacing() const = 0;
    virtual void pressStylus(const ScenePoint& place) = 0;
    virtual void releaseStylus() = 0;

Q_SIGNALS:
    void mapsChanged();
    void exaggerationChanged();
    /// Camera or size of the picture.
    void sightChanged();
    void pictureCompleted();
    void stylusMoved();
    /// The grab key was pressed or released for the device.
    void grabbingChanged(bool is_grabbing);
    void toolChanged();
};

} // namespace marsview
