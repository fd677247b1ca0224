#include "ui/commands/scene_commands.h"

#include "core/globe/body_navigation.h"
#include "core/view/navigation.h"
#include "ui/canvas/terrain_view.h"
#include "ui/controllers/annotation_controller.h"
#include "ui/controllers/haptics/haptics_controller.h"
#include "ui/controllers/measure_controller.h"
#include "ui/controllers/session_controller.h"
#include "ui/controllers/vector_overlays.h"
#include "ui/globe/globe_hand_scene.h"
#include "ui/globe/globe_scene.h"
#include "ui/globe/globe_view.h"
#include "ui/panels/layer_model.h"
#include "ui/pictures/globe_pictures.h"
#include "ui/window/status_readout.h"
#include "ui/window/window_actions.h"
#include "ui/window/window_messages.h"

#include <QAction>
#include <QActionGroup>
#include <QMenu>
#include <QWidget>

#include <algorithm>
#include <utility>
#include <variant>

namespace marsview {
namespace {

// Whether the layers are seen as a ball rather than as a landscape: a side of them is longer than
// the body's radius, and some.
bool isWide(const TerrainView& view)
{
    constexpr double kRadii = 1.2;
    const auto ellipsoid = view.map()->info().crs->ellipsoid();
    const SceneBox box = view.ground().box(view.exaggeration());
    const double side_m = std::max(box.maximum.x - box.minimum.x, box.maximum.y - box.minimum.y);
    return ellipsoid && side_m > kRadii * ellipsoid->equatorial_m;
}

// Whether the picture will show all of the map.
bool isWhole(const TerrainView& view)
{
    const SceneBox box = view.ground().box(view.exaggeration());
    const Viewport viewport = view.viewport();
    const double level_m = 0.5 * (box.minimum.z + box.maximum.z);
    for (const double x : {box.minimum.x, box.maximum.x}) {
        for (const double y : {box.minimum.y, box.maximum.y}) {
            const auto pixel = project(view.cameraGoal(), viewport, {x, y, level_m});
            if (!pixel || pixel->x < 0.0 || pixel->x > viewport.width || pixel->y < 0.0 ||
                pixel->y > viewport.height) {
                return false;
            }
        }
    }
    return true;
}

} // namespace

SceneCommands::SceneCommands(const Parts& parts)
    : parts_(parts)
    , globe_scene_(new GlobeScene(parts.globe, &parts.globe))
    , globe_hand_(new GlobeHandScene(parts.globe, &parts.globe))
{
    parts_.globe.addActions(parts_.view.actions()); // their keys
    connectParts();
    showChoices();
}

void SceneCommands::connectParts()
{
    TerrainView* view = &parts_.view;
    connect(parts_.actions.scenes, &QActionGroup::triggered, this,
            [this](QAction* action) { choose(static_cast<SceneChoice>(action->data().toInt())); });
    connect(parts_.actions.globe, &QAction::triggered, this,
            [this](bool is_on) { choose(is_on ? SceneChoice::Globe : SceneChoice::Flat); });
    connect(view, &TerrainView::layersChanged, this, &SceneCommands::follow);
    connect(&parts_.session, &SessionController::sessionChanged, this, &SceneCommands::follow);
    connect(view, &TerrainView::lookChanged, this, &SceneCommands::follow);
    connect(view, &TerrainView::exaggerationChanged, this, &SceneCommands::follow);
    connect(view, &TerrainView::toolChanged, &parts_.globe, &GlobeView::setTool);
    connect(parts_.actions.contact_model_group, &QActionGroup::triggered, this, [this] {
        if (is_globe_shown_) {
            parts_.globe.setContactModel(parts_.view.contactModel());
        }
    });
    // Queued: the tool may have been chosen just now.
    connect(
        &parts_.globe, &GlobeView::touchFailed, this,
        [this](const QString& reason) {
            if (parts_.view.tool() == Tool::Touch) {
                parts_.view.setTool(Tool::Pan);
            }
            parts_.messages.show(reason);
        },
        Qt::QueuedConnection);
    connect(&parts_.globe, &GlobeView::blendingFailed, this,
            [this](const QString& reason) { parts_.messages.show(reason); });
    connect(&parts_.globe, &GlobeView::placed, this, &SceneCommands::rememberHanded);
    connect(&parts_.globe, &GlobeView::failed, this, [this](const QString& reason) {
        choose(SceneChoice::Flat);
        parts_.messages.report(tr("Cannot Show Globe"), reason);
    });
    readOnGlobe();
}

void SceneCommands::readOnGlobe()
{
    GlobeView* globe = &parts_.globe;
    StatusReadout* readout = &parts_.readout;
    // Not after this object: a globe that loses the focus while the window closes reports, too.
    connect(globe, &GlobeView::readingChanged, this,
            [this, globe, readout](const std::optional<BodyScenePoint>& ground) {
                if (!is_globe_shown_) {
                    return;
                }
                readout->setSource(globe->readingSource());
                if (!ground) {
                    readout->setPlace(std::nullopt);
                    return;
                }
                // Positions and elevations are those of the layer in the picture.
                const auto& map = globe->layers()[ground->index].map;
                if (read_map_.lock() != map) {
                    readout->setMaps(map, map);
                    read_map_ = map;
                }
                // Without what blending edges changes.
                const BodyTerrain& terrain = globe->scene().maps()[ground->index];
                const double elevation_m = terrain.elevationOnGrid(ground->hit.grid);
                readout->setPlace(ReadPlace{.hit = {.grid = ground->hit.grid,
                                                    .height_m = elevation_m,
                                                    .t = ground->hit.distance_m},
                                            .screen_pixel_m = globe->metersPerPoint(ground->hit)});
            });
    connect(globe, &GlobeView::detailChanged, readout, &StatusReadout::setDetail);
    connect(globe, &GlobeView::loadingChanged, readout, &StatusReadout::setLoading);
    connect(globe, &GlobeView::problemChanged, readout, &StatusReadout::setProblem);
}

QString SceneCommands::whyNoGlobe() const
{
    if (!parts_.view.map()) {
        return tr("Open a map first");
    }
    if (parts_.view.map()->georeference().body() == nullptr) {
        return tr(
            "Not available: the body of the topmost layer is not known. Set it with Layer › "
            "Set Body, CRS…");
    }
    return {};
}

void SceneCommands::showChoices()
{
    const QString why_not = whyNoGlobe();
    for (QAction* action : parts_.actions.scenes->actions()) {
        const auto choice = static_cast<SceneChoice>(action->data().toInt());
        action->setChecked(choice == choice_);
        if (choice == SceneChoice::Globe) {
            action->setEnabled(why_not.isEmpty());
            const QString tip = why_not.isEmpty()
                                    ? tr("Show all layers of one body where they lie on it")
                                    : why_not;
            action->setStatusTip(tip);
            action->setToolTip(tip);
        }
    }
    QAction& globe = *parts_.actions.globe;
    globe.setChecked(is_globe_shown_);
    globe.setEnabled(is_globe_shown_ || why_not.isEmpty());
    const QString tip = is_globe_shown_ ? tr("Show the flat map again (G)")
                        : why_not.isEmpty()
                            ? tr("Show all layers of one body on it, as a globe (G)")
                            : why_not;
    globe.setStatusTip(tip);
    globe.setToolTip(tip);
}

// The layers are judged again only when there are others: looks change many times a second.
bool SceneCommands::wantsGlobe()
{
    if (choice_ == SceneChoice::Flat || !whyNoGlobe().isEmpty()) {
        return false;
    }
    if (choice_ == SceneChoice::Globe) {
        return true;
    }
    const Session& session = parts_.session.session();
    std::vector<std::weak_ptr<const Map>> visible;
    for (const Layer& layer : session.layers) {
        if (layer.is_visible) {
            visible.emplace_back(layer.map);
        }
    }
    const auto is_same = [](const auto& a, const auto& b) { return a.lock() == b.lock(); };
    if (!std::ranges::equal(visible, judged_, is_same)) {
        judged_ = std::move(visible);
        suits_globe_ = suitsGlobe(session);
    }
    return suits_globe_;
}

void SceneCommands::choose(SceneChoice choice)
{
    choice_ = choice;
    setGlobeShown(wantsGlobe());
    showChoices();
}

std::optional<ViewCamera> SceneCommands::globeCamera() const
{
    if (!is_globe_shown_ || parts_.globe.terrain() == nullptr) {
        return std::nullopt;
    }
    const BodyCamera& camera = parts_.globe.cameraGoal();
    return ViewCamera{.target = camera.target,
                      .elevation_m = camera.height_m / parts_.globe.exaggeration(),
                      .distance_m = camera.distance_m,
                      .azimuth = camera.azimuth,
                      .tilt = camera.tilt,
                      .field_of_view = camera.field_of_view};
}

void SceneCommands::showGlobeFrom(const ViewCamera& camera)
{
    if (!is_globe_shown_) {
        choose(SceneChoice::Globe);
    }
    const auto on_body = bodyCamera(camera, parts_.view.exaggeration());
    if (is_globe_shown_ && on_body) {
        is_handing_ = false; // the flat map has another one
        parts_.globe.setCamera(*on_body);
    }
}

void SceneCommands::flyOnGlobeTo(const ViewCamera& camera)
{
    const auto on_body = bodyCamera(camera, parts_.view.exaggeration());
    if (!is_globe_shown_) {
        showGlobeFrom(camera);
    } else if (on_body) {
        parts_.globe.flyTo(*on_body);
    }
}

void SceneCommands::follow()
{
    read_map_.reset(); // the window shows another map in the status bar
    // Removing the last layer, or a map without a body on top, leads back to the flat map.
    if (choice_ == SceneChoice::Globe && is_globe_shown_ && !whyNoGlobe().isEmpty()) {
        choose(SceneChoice::Flat);
        return;
    }
    if (choice_ == SceneChoice::Automatic) {
        setGlobeShown(wantsGlobe());
    }
    showChoices();
    if (!is_globe_shown_) {
        return;
    }
    parts_.globe.setLook(parts_.view.look());
    parts_.globe.setExaggeration(parts_.view.exaggeration());
    parts_.globe.setContactModel(parts_.view.contactModel());
    parts_.globe.setLayers(shownOnBody());
}

std::vector<ShownLayer> SceneCommands::shownOnBody() const
{
    std::vector<ShownLayer> layers;
    for (const Layer* layer : layersOnBody(parts_.session.session())) {
        layers.push_back({.map = layer->map,
                          .ramp = &rampOf(*layer),
                          .color_range = parts_.session.stretchedRangeOf(*layer),
                          .slope_range = layer->slope_range,
                          .feather_cells = layer->feather_cells});
    }
    return layers;
}

void SceneCommands::setGlobeShown(bool is_shown)
{
    if (is_shown == is_globe_shown_) {
        return;
    }
    is_globe_shown_ = is_shown;
    TerrainView& view = parts_.view;
    GlobeView& globe = parts_.globe;
    const bool has_focus = view.hasFocus() || globe.hasFocus();
    if (is_shown) {
        globe.setTool(view.tool());
        handToGlobe();
        follow();
        drawOn(globe_scene_);
        parts_.haptics.touchOn(globe_hand_);
        parts_.session.showOn(sceneForSession());
        view.hide();
        view.setFocusProxy(&globe); // what begins there begins on the globe
        globe.show();
    } else {
        handToMap();
        globe.setTool(Tool::Pan); // lifts the stylus
        drawOn(nullptr);
        parts_.haptics.touchOn(nullptr);
        parts_.session.showOn(std::nullopt);
        view.setFocusProxy(nullptr);
        globe.hide();
        globe.setLayers({});
        view.show();
    }
    if (has_focus) {
        (is_shown ? static_cast<QWidget&>(globe) : view).setFocus(Qt::OtherFocusReason);
    }
    if (parts_.layer_list != nullptr) {
        parts_.layer_list->setSceneOfBody(is_shown);
    }
    parts_.readout.setPlace(std::nullopt);
    if (!is_shown) {
        view.readAgain();
    }
    Q_EMIT shownChanged(is_shown);
}

OtherScene SceneCommands::sceneForSession() const
{
    GlobeView* globe = &parts_.globe;
    return {.fly_to = [globe](const auto& map) { return globe->flyToLayer(map); },
            .reveal = [globe](const auto& map) { return globe->revealLayer(map); },
            .range_in_picture = [globe](const auto& map) { return globe->rangeInPicture(map); }};
}

void SceneCommands::drawOn(DrawingScene* scene)
{
    parts_.measuring.drawOn(scene);
    parts_.annotating.drawOn(scene);
    parts_.vector_files.drawOn(scene);
}

// Seen whole, a flat map of a planet is much wider than the globe, which is then seen whole, too.
// The same holds for a map that was just opened, unless its opening view shows a place.
void SceneCommands::handToGlobe()
{
    const TerrainView& view = parts_.view;
    if (handed_ && handed_->map.lock() == view.map() && handed_->flat == view.cameraGoal()) {
        parts_.globe.setCamera(handed_->globe); // nothing moved since
        return;
    }
    const bool is_opening = view.isAtOpeningView() && !hasOpeningPlace(view.map()->georeference());
    if (isWide(view) && (is_opening || isWhole(view))) {
        parts_.globe.setHomeCamera();
        is_handing_ = true;
        return;
    }
    const auto camera =
        viewCamera(view.map()->georeference(), view.cameraGoal(), view.exaggeration());
    if (camera && std::holds_alternative<GeographicPoint>(camera->target)) {
        parts_.globe.setCamera(
            withGroundAhead({.target = std::get<GeographicPoint>(camera->target),
                             .height_m = camera->elevation_m * view.exaggeration(),
                             .distance_m = camera->distance_m,
                             .azimuth = camera->azimuth,
                             .tilt = camera->tilt,
                             .field_of_view = camera->field_of_view},
                            *view.map()->info().crs->ellipsoid()));
        is_handing_ = true;
    }
}

// The globe has the flat map's camera, within its own limits.
void SceneCommands::rememberHanded()
{
    if (parts_.globe.terrain() != nullptr && std::exchange(is_handing_, false)) {
        handed_ = {.map = parts_.view.map(),
                   .flat = parts_.view.cameraGoal(),
                   .globe = parts_.globe.cameraGoal()};
    }
}

void SceneCommands::handToMap()
{
    TerrainView& view = parts_.view;
    if (!view.map() || parts_.globe.terrain() == nullptr ||
        parts_.globe.terrain()->map()->info().body != view.map()->info().body) {
        return; // it was never looked at
    }
    const BodyCamera& from = parts_.globe.cameraGoal();
    if (handed_ && handed_->map.lock() == view.map() && handed_->globe == from) {
        view.setCamera(handed_->flat); // nothing moved since
        return;
    }
    const auto camera = orbitCamera(view.map()->georeference(),
                                    {.target = from.target,
                                     .elevation_m = from.height_m / view.exaggeration(),
                                     .distance_m = from.distance_m,
                                     .azimuth = from.azimuth,
                                     .tilt = from.tilt,
                                     .field_of_view = from.field_of_view},
                                    view.exaggeration());
    if (camera) {
        view.setCamera(*camera);
        handed_ = {.map = view.map(), .flat = view.cameraGoal(), .globe = from};
    }
}

} // namespace marsview
