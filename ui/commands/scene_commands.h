// The scene of the window: the flat map, or the globe in its place.
#pragma once

#include "core/globe/body_camera.h"
#include "core/session/map.h"
#include "core/session/project.h"
#include "core/session/saved_view.h"
#include "ui/canvas/shown_layer.h"

#include <QObject>
#include <QString>

#include <memory>
#include <optional>
#include <vector>

namespace marsview {

class AnnotationController;
class DrawingScene;
class GlobeHandScene;
class GlobeScene;
class GlobeView;
class HapticsController;
class LayerModel;
class MainToolBar;
class MeasureController;
struct OtherScene;
class SessionController;
class StatusReadout;
class TerrainView;
class VectorOverlays;
class WindowMessages;
struct WindowActions;

/// Shows the globe in place of the flat map, which stays as it is behind it. The globe has all
/// visible layers of the topmost one's body, whatever their CRS; look and exaggeration are the flat
/// map's, and the camera is handed over both ways. GUI thread; must not outlive its parts.
class SceneCommands final : public QObject {
    Q_OBJECT

public:
    struct Parts {
        const WindowActions& actions;
        TerrainView& view;
        GlobeView& globe;
        SessionController& session;
        HapticsController& haptics;
        StatusReadout& readout;
        WindowMessages& messages;
        MeasureController& measuring;
        AnnotationController& annotating;
        VectorOverlays& vector_files;
        /// Which layers are in the picture, as people see it; may be null.
        LayerModel* layer_list = nullptr;
    };

    explicit SceneCommands(const Parts& parts);

    /// What View › Scene has. Automatic is the globe where it suits the layers: see suitsGlobe().
    SceneChoice choice() const noexcept { return choice_; }
    void choose(SceneChoice choice);
    bool isGlobeShown() const noexcept { return is_globe_shown_; }
    /// Where the camera of the globe will be when it has come to rest; empty while it is not shown.
    std::optional<ViewCamera> globeCamera() const;
    /// Shows the globe from there, at once or by a flight. Ignored if the globe cannot be shown.
    void showGlobeFrom(const ViewCamera& camera);
    void flyOnGlobeTo(const ViewCamera& camera);

Q_SIGNALS:
    /// The globe or the flat map is shown now.
    void shownChanged(bool is_globe);

private:
    void connectParts();
    void showChoices();
    void setGlobeShown(bool is_shown);
    void follow();
    std::vector<ShownLayer> shownOnBody() const;
    void handToGlobe();
    void rememberHanded();
    void handToMap();
    void readOnGlobe();
    OtherScene sceneForSession() const;
    void drawOn(DrawingScene* scene);
    /// Why the globe cannot be shown; empty where it can.
    QString whyNoGlobe() const;
    bool wantsGlobe();

    // The cameras of both when one got the other's.
    struct HandedCamera {
        std::weak_ptr<const Map> map;
        OrbitCamera flat;
        BodyCamera globe;
    };
    Parts parts_;
    GlobeScene* globe_scene_;    // a child of the globe
    GlobeHandScene* globe_hand_; // the same
    SceneChoice choice_ = SceneChoice::Automatic;
    std::vector<std::weak_ptr<const Map>> judged_; // visible layers, top first
    bool suits_globe_ = false;                     // suitsGlobe() for them
    bool is_globe_shown_ = false;
    std::optional<HandedCamera> handed_;
    bool is_handing_ = false;           // until the globe has a layer
    std::weak_ptr<const Map> read_map_; // that positions in the status bar are on
};

} // namespace marsview
