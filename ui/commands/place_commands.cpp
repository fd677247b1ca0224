#include "ui/commands/place_commands.h"

#include "core/geo/extent.h"
#include "core/session/measurement.h"
#include "ui/canvas/terrain_view.h"
#include "ui/commands/map_menu.h"
#include "ui/commands/name_search.h"
#include "ui/commands/preference_commands.h"
#include "ui/commands/shown_maps.h"
#include "ui/commands/vector_tools.h"
#include "ui/controllers/annotation_controller.h"
#include "ui/controllers/measure_controller.h"
#include "ui/controllers/session_controller.h"
#include "ui/controllers/vector_overlays.h"
#include "ui/globe/globe_view.h"
#include "ui/overlay/map_overlays.h"
#include "ui/widgets/coordinate_field.h"
#include "ui/window/main_tool_bar.h"
#include "ui/window/status_readout.h"
#include "ui/window/window_actions.h"

#include <QAction>
#include <QClipboard>
#include <QGuiApplication>
#include <QLineEdit>
#include <QMainWindow>
#include <QMenu>

#include <algorithm>
#include <cmath>
#include <optional>

namespace marsview {

PlaceCommands::PlaceCommands(const Parts& parts)
    : parts_(parts)
    , map_menu_(makeMenu())
    , globe_menu_(makeGlobeMenu())
    , features_({.window = parts.window,
                 .measuring = parts.measuring,
                 .annotating = parts.annotating,
                 .overlays = parts.vector_files.overlays()})
{
    const WindowActions& actions = parts_.actions;
    connect(actions.go_to_place, &QAction::triggered, this, &PlaceCommands::goToPlace);
    connect(actions.find_name, &QAction::triggered, this, &PlaceCommands::findName);
    connect(actions.add_point, &QAction::triggered, this, [this] { askPoint(parts_.measuring); });
    connect(actions.add_annotation_point, &QAction::triggered, this,
            [this] { askPoint(parts_.annotating); });
    connect(actions.copy_coordinates, &QAction::triggered, this, [this] { copyCoordinates(); });
    connect(&parts_.tool_bar, &MainToolBar::entryCompleted, this, [this] {
        QWidget& map = parts_.globe.isHidden() ? static_cast<QWidget&>(parts_.view) : parts_.globe;
        map.setFocus(Qt::OtherFocusReason);
    });
    connectReadout();
    connectClicks();
}

void PlaceCommands::connectClicks()
{
    connect(&parts_.view, &TerrainView::clicked, &features_,
            [this](QPointF position) { features_.pick(*map_menu_, parts_.view, position); });
    connect(&parts_.globe, &GlobeView::clicked, &features_,
            [this](QPointF position) { features_.pick(*globe_menu_, parts_.globe, position); });
}

// Children of the window alone: the view loses the focus while the window is being destroyed.
void PlaceCommands::connectReadout()
{
    TerrainView* view = &parts_.view;
    StatusReadout* readout = &parts_.readout;
    connect(view, &TerrainView::pointerMoved, readout,
            [view, readout, globe = &parts_.globe](const std::optional<RayHit>& hit) {
                if (!globe->isHidden()) {
                    return; // it is read instead
                }
                readout->setSource(view->readingSource());
                readout->setPlace(
                    hit ? std::optional(
                              ReadPlace{.hit = *hit, .screen_pixel_m = view->metersPerPoint(*hit)})
                        : std::nullopt);
            });
    connect(view, &TerrainView::detailChanged, readout, &StatusReadout::setDetail);
    connect(view, &TerrainView::loadingChanged, readout, &StatusReadout::setLoading);
    connect(view, &TerrainView::problemChanged, readout, &StatusReadout::setProblem);
    connect(readout, &StatusReadout::focusChanged, view, &TerrainView::setReadElsewhere);
    readout->setCopyAction(parts_.actions.copy_coordinates);
    QMenu* formats = parts_.actions.coordinate_format;
    connect(formats, &QMenu::aboutToShow, readout, [formats, readout] {
        formats->clear();
        readout->fillMenu(*formats);
    });
}

template <typename Drawing>
void PlaceCommands::addPlace(Drawing& drawing, const MenuPlace& place)
{
    if (const auto vertex = vertexAt(place.map->georeference(), place.grid)) {
        drawing.addPlace({.vertex = *vertex, .map = place.map});
    }
}

MapMenu* PlaceCommands::makeMenu()
{
    TerrainView* view = &parts_.view;
    // On the topmost map's grid, which is that of the scene.
    const auto on_scene = [view](const MenuPlace& place) {
        return view->map()->georeference().toGrid(place.grid, place.map->georeference());
    };
    const MapMenu::Source source{
        .place_at = [view](QPointF position) -> std::optional<MenuPlace> {
            const auto ground = view->placeUnder(position);
            const auto hit = view->surfaceAt(position);
            if (!ground || !hit) {
                return std::nullopt;
            }
            return MenuPlace{.map = view->ground().maps()[ground->index].map,
                             .grid = ground->grid,
                             .point_m = view->metersPerPoint(*hit)};
        },
        .fly_here =
            [view, on_scene](const MenuPlace& place) {
                RayHit hit;
                hit.grid = on_scene(place);
                view->flyNearer(hit);
            },
        .center_here = [view,
                        on_scene](const MenuPlace& place) { view->flyTo(on_scene(place), 0.0); },
        .is_shown =
            [view](const std::shared_ptr<const Map>& map) {
                const auto& maps = view->ground().maps();
                return std::any_of(maps.begin(), maps.end(),
                                   [&](const SceneMap& shown) { return shown.map == map; });
            }};
    auto* menu = new MapMenu(
        *view, source, [this](const MenuPlace& place) { return factsAt(place); }, beginnings(),
        extras());
    connect(view, &TerrainView::menuRequested, menu, &MapMenu::open);
    return menu;
}

MapMenu* PlaceCommands::makeGlobeMenu()
{
    GlobeView* globe = &parts_.globe;
    const auto geographic = [](const MenuPlace& place) {
        return place.map->georeference().toGeographic(place.grid);
    };
    const MapMenu::Source source{
        .place_at = [globe](QPointF position) -> std::optional<MenuPlace> {
            const auto ground = globe->placeAt(position);
            if (!ground) {
                return std::nullopt;
            }
            return MenuPlace{.map = globe->scene().maps()[ground->index].map(),
                             .grid = ground->hit.grid,
                             .point_m = globe->metersPerPoint(ground->hit)};
        },
        .fly_here =
            [globe, geographic](const MenuPlace& place) {
                if (const auto target = geographic(place)) {
                    globe->flyNearer(*target);
                }
            },
        .center_here =
            [globe, geographic](const MenuPlace& place) {
                if (const auto target = geographic(place)) {
                    globe->flyTo(*target, 0.0);
                }
            },
        .is_shown =
            [globe](const std::shared_ptr<const Map>& map) {
                const auto& maps = globe->scene().maps();
                return std::any_of(maps.begin(), maps.end(),
                                   [&](const BodyTerrain& shown) { return shown.map() == map; });
            }};
    auto* menu = new MapMenu(
        *globe, source, [this](const MenuPlace& place) { return factsAt(place); }, beginnings(),
        extras());
    connect(globe, &GlobeView::menuRequested, menu, &MapMenu::open);
    return menu;
}

MapMenu::Beginnings PlaceCommands::beginnings()
{
    return {.measure =
                [this](const MenuPlace& place) {
                    parts_.measuring.begin(MeasurementKind::Distance);
                    addPlace(parts_.measuring, place);
                },
            .annotate =
                [this](const MenuPlace& place) {
                    parts_.annotating.begin(FeatureShape::Point);
                    addPlace(parts_.annotating, place);
                }};
}

MapMenu::Extras PlaceCommands::extras()
{
    return {.stretch_to_view = parts_.actions.stretch_to_view,
            .has_pin = [this] { return parts_.overlays.isPlaceMarked(); },
            .remove_pin = [this] { parts_.overlays.clearMark(); }};
}

PlaceFacts PlaceCommands::factsAt(const MenuPlace& place) const
{
    const Preferences& preferences = parts_.preferences.preferences();
    const auto& layers = parts_.session.session().layers;
    const auto layer = std::find_if(layers.begin(), layers.end(),
                                    [&](const Layer& known) { return known.map == place.map; });
    PlaceFacts facts = placeFacts(
        *place.map, layer != layers.end() ? QString::fromStdString(layer->name) : QString(),
        place.grid, {.format = preferences.coordinates, .unit = preferences.height_unit});
    const auto vertex = vertexAt(place.map->georeference(), place.grid);
    if (!vertex) {
        return facts;
    }
    for (const VectorOverlays::Hit& hit :
         parts_.vector_files.overlays().featuresAt(*vertex, kFeatureReachPoints * place.point_m)) {
        facts.facts.push_back({.name = tr("Vector file"), .value = hit.file});
        for (const auto& [name, value] : hit.attributes) {
            facts.facts.push_back({.name = name, .value = value});
        }
    }
    return facts;
}

void PlaceCommands::findName()
{
    QLineEdit& field = parts_.tool_bar.searchField();
    if (!field.isVisible()) {
        goToPlace();
        return;
    }
    field.setFocus(Qt::ShortcutFocusReason);
    field.selectAll();
}

GoToDialog* PlaceCommands::makeDialog()
{
    auto* dialog =
        new GoToDialog(shownMaps(parts_.view, parts_.globe), parts_.preferences.preferences(),
                       last_place_, parts_.names.namesOnMap(), &parts_.window);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    const auto remember = [this, dialog] { last_place_ = dialog->entry(); };
    connect(dialog, &GoToDialog::nameChosen, this, remember);
    connect(dialog, &GoToDialog::placeChosen, this, remember);
    return dialog;
}

void PlaceCommands::goToPlace()
{
    if (shownMaps(parts_.view, parts_.globe).empty()) {
        return;
    }
    GoToDialog* dialog = makeDialog();
    connect(dialog, &GoToDialog::nameChosen, &parts_.names, &NameSearch::goTo);
    connect(dialog, &GoToDialog::placeChosen, this, [this](const FoundPlace& found) {
        const Georeference& georeference = found.map->georeference();
        if (parts_.globe.isHidden()) {
            // The flat map ends at its outermost samples.
            const auto grid =
                onTopmost(parts_.view, *found.map, clampedToSamples(georeference, found.grid));
            if (grid) {
                parts_.view.goTo(*grid);
            }
            parts_.overlays.markPlace(grid);
        } else if (const auto place = georeference.toGeographic(found.grid)) {
            parts_.globe.flyTo(*place, 0.0);
            parts_.overlays.markPlace(onTopmost(parts_.view, *found.map, found.grid), place);
        }
    });
    dialog->open();
}

template <typename Drawing>
void PlaceCommands::askPoint(Drawing& drawing)
{
    if (shownMaps(parts_.view, parts_.globe).empty()) {
        return;
    }
    GoToDialog* dialog = makeDialog();
    dialog->setTexts(tr("Add Point"), tr("&Add"));
    connect(dialog, &GoToDialog::nameChosen, this, [this, &drawing](const PlaceName& place) {
        if (const auto map = parts_.names.mapAt(place)) {
            addPlace(drawing, {.map = map, .grid = *map->georeference().toGrid(place.position)});
        }
    });
    connect(dialog, &GoToDialog::placeChosen, this, [&drawing](const FoundPlace& place) {
        addPlace(drawing, {.map = place.map, .grid = place.grid});
    });
    dialog->open();
}

void PlaceCommands::copyCoordinates()
{
    const QString text = parts_.readout.plainPosition();
    if (!text.isEmpty()) {
        QGuiApplication::clipboard()->setText(text);
        parts_.readout.coordinateField()->showCopied();
    }
}

void PlaceCommands::copyCoordinates(GridPoint grid)
{
    if (!parts_.view.map()) {
        return;
    }
    const Map& map = *parts_.view.map();
    const double height_m = map.heightfield().heightNow(grid);
    QGuiApplication::clipboard()->setText(plainPositionText(
        parts_.preferences.preferences().coordinates, map, grid,
        parts_.view.metersPerPoint(
            {.grid = grid, .height_m = std::isfinite(height_m) ? height_m : 0.0})));
    parts_.readout.coordinateField()->showCopied();
}

} // namespace marsview
