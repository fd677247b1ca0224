#include "ui/views/saved_views.h"

#include "core/flight/camera_path.h"
#include "ui/canvas/terrain_view.h"
#include "ui/controllers/session_controller.h"
#include "ui/pictures/flat_pictures.h"
#include "ui/text/coordinate_text.h"
#include "ui/text/sentence.h"
#include "ui/views/view_name.h"
#include "ui/widgets/icons.h"

#include <QAction>
#include <QKeySequence>
#include <QListWidget>
#include <QMenu>

#include <algorithm>
#include <chrono>
#include <utility>
#include <variant>

namespace marsview {
namespace {

constexpr int kNumberedViews = 9;

// Of a flight to a view: longer for more change, but never long.
std::chrono::milliseconds flightTime(double length)
{
    return std::chrono::milliseconds(
        static_cast<int>(std::clamp(500.0 + 350.0 * length, 700.0, 3000.0)));
}

} // namespace

SavedViews::SavedViews(const Parts& parts, QObject* parent)
    : QObject(parent)
    , parts_(parts)
    , thumbnails_(parts.scenes)
    , flight_(parts.scenes)
{
    makeActions();
    fillMenu();
    SavedViewsPanel& panel = parts_.panel;
    panel.setActions(actions_);
    connect(&panel, &SavedViewsPanel::goRequested, this, &SavedViews::goTo);
    connect(&panel, &SavedViewsPanel::nameRequested, this, [this](ViewId id, const QString& name) {
        parts_.session.renameView(id, name);
        showSession(); // a name that is not accepted goes back
    });
    connect(&panel, &SavedViewsPanel::moveRequested, this, [this](ViewId id, std::size_t index) {
        parts_.session.moveView(id, index);
        showSession();
    });
    connect(&panel, &SavedViewsPanel::currentChanged, this, &SavedViews::showEnabled);
    connect(&panel, &SavedViewsPanel::shown, this,
            [this](bool is_shown) { thumbnails_.setWanted(is_shown); });
    connect(&thumbnails_, &ViewThumbnails::drawn, this,
            [this](ViewId id) { parts_.panel.setThumbnail(id, thumbnails_.thumbnail(id)); });
    connect(&parts_.session, &SessionController::sessionChanged, this, &SavedViews::showSession);
    connect(&parts_.view, &TerrainView::mapShown, this, &SavedViews::showEnabled);
    showSession();
}

void SavedViews::makeActions()
{
    const auto make = [this](const QString& text, const QString& icon, const QString& tip) {
        auto* action = new QAction(lineIcon(icon), text, this);
        action->setToolTip(tip);
        return action;
    };
    actions_.save = make(tr("&Save View"), QStringLiteral("save-view"),
                         tr("Save the current camera and exaggeration in the project"));
    actions_.save->setObjectName(QStringLiteral("saveView"));
    actions_.save->setShortcut(QKeySequence(Qt::CTRL | Qt::Key_B));
    actions_.go_to = make(tr("&Go to View"), QStringLiteral("fly"), tr("Fly to the selected view"));
    actions_.update = make(tr("Upda&te View"), QStringLiteral("views"),
                           tr("Update the selected view to the current camera and exaggeration"));
    actions_.rename =
        make(tr("Re&name View"), QStringLiteral("rename"), tr("Rename the selected view"));
    actions_.rename->setShortcut(Qt::Key_F2);
    actions_.move_up =
        make(tr("Move View &Up"), QStringLiteral("move-up"), tr("Move the view up (Alt+Up)"));
    actions_.move_up->setShortcut(QKeySequence(Qt::ALT | Qt::Key_Up));
    actions_.move_down = make(tr("Move View &Down"), QStringLiteral("move-down"),
                              tr("Move the view down (Alt+Down)"));
    actions_.move_down->setShortcut(QKeySequence(Qt::ALT | Qt::Key_Down));
    actions_.remove =
        make(tr("R&emove View"), QStringLiteral("remove"), tr("Remove the selected view (Delete)"));
    actions_.remove->setShortcut(QKeySequence::Delete);
    // The layers have these keys in their list.
    for (QAction* action :
         {actions_.rename, actions_.move_up, actions_.move_down, actions_.remove}) {
        action->setShortcutContext(Qt::WidgetShortcut);
    }
    actions_.fly_through = make(tr("&Fly-Through…"), QStringLiteral("fly-through"),
                                tr("Fly along the saved views or a line, and record it"));
    actions_.fly_through->setObjectName(QStringLiteral("flyThrough"));
    show_panel_ = make(tr("Show &Panel"), QStringLiteral("views"), tr("Show the saved views"));
    show_panel_->setShortcut(QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_B));

    const auto on = [this](QAction* action, auto reaction) {
        connect(action, &QAction::triggered, this, reaction);
    };
    on(actions_.save, [this] { save(); });
    on(actions_.go_to, [this] { goTo(parts_.panel.current()); });
    on(actions_.update, [this] { update(parts_.panel.current()); });
    on(actions_.rename, [this] {
        show_panel_->trigger();
        parts_.panel.editName(parts_.panel.current());
    });
    const auto step = [this](int by) {
        const ViewId id = parts_.panel.current();
        const int row = parts_.panel.list()->currentRow() + by;
        if (row >= 0 && row < parts_.panel.list()->count()) {
            parts_.session.moveView(id, static_cast<std::size_t>(row));
        }
    };
    on(actions_.move_up, [step] { step(-1); });
    on(actions_.move_down, [step] { step(1); });
    on(actions_.remove, [this] { parts_.session.removeView(parts_.panel.current()); });
    on(show_panel_, [this] {
        if (parts_.reveal_panel) {
            parts_.reveal_panel();
        }
        parts_.panel.list()->setFocus(Qt::ShortcutFocusReason);
    });
}

void SavedViews::fillMenu()
{
    menu_ = new QMenu(tr("Saved &Views"), &parts_.menu);
    menu_->menuAction()->setIcon(lineIcon(QStringLiteral("views")));
    parts_.menu.insertMenu(parts_.before, menu_);
    menu_->addAction(actions_.save);
    menu_->addAction(actions_.update);
    menu_->addAction(actions_.rename);
    menu_->addAction(actions_.move_up);
    menu_->addAction(actions_.move_down);
    menu_->addAction(actions_.remove);
    menu_->addSeparator();
    menu_->addAction(actions_.fly_through);
    menu_->addAction(show_panel_);
    menu_->addSeparator();
    for (int i = 0; i < kNumberedViews; ++i) {
        auto* action = new QAction(this);
        action->setShortcut(QKeySequence(Qt::CTRL | static_cast<Qt::Key>(Qt::Key_1 + i)));
        connect(action, &QAction::triggered, this, [this, i] {
            const auto& views = parts_.session.session().views;
            if (static_cast<std::size_t>(i) < views.size()) {
                goTo(views[static_cast<std::size_t>(i)].id);
            }
        });
        menu_->addAction(action);
        numbered_.append(action);
    }
}

void SavedViews::showSession()
{
    const Session& session = parts_.session.session();
    thumbnails_.setSession(session);
    parts_.panel.setViews(session.views);
    for (const SavedView& view : session.views) {
        parts_.panel.setThumbnail(view.id, thumbnails_.thumbnail(view.id));
        parts_.panel.setDescription(view.id, descriptionOf(view));
    }
    for (int i = 0; i < numbered_.size(); ++i) {
        const bool is_there = static_cast<std::size_t>(i) < session.views.size();
        numbered_[i]->setVisible(is_there);
        numbered_[i]->setText(
            is_there ? withoutMnemonics(
                           QString::fromStdString(session.views[static_cast<std::size_t>(i)].name))
                     //: A menu entry for a saved view that does not exist yet; %1 is 1 to 9
                     : tr("Go to View %1").arg(i + 1));
    }
    showEnabled();
}

void SavedViews::showEnabled()
{
    const auto& views = parts_.session.session().views;
    const bool is_map_shown = parts_.view.map() != nullptr;
    const bool is_selected = parts_.panel.current() != ViewId::None;
    const int row = parts_.panel.list()->currentRow();
    actions_.save->setEnabled(is_map_shown);
    actions_.go_to->setEnabled(is_selected);
    actions_.update->setEnabled(is_selected && is_map_shown);
    actions_.rename->setEnabled(is_selected);
    actions_.remove->setEnabled(is_selected);
    actions_.move_up->setEnabled(is_selected && row > 0);
    actions_.move_down->setEnabled(is_selected && row + 1 < static_cast<int>(views.size()));
    actions_.fly_through->setEnabled(is_map_shown);
}

std::optional<ViewCamera> SavedViews::globeCamera() const
{
    return parts_.globe.camera ? parts_.globe.camera() : std::nullopt;
}

std::optional<ViewCamera> SavedViews::currentCamera() const
{
    const TerrainView& view = parts_.view;
    const auto on_globe = globeCamera();
    return on_globe
               ? on_globe
               : viewCamera(view.map()->georeference(), view.cameraGoal(), view.exaggeration());
}

// Empty if the camera looks beyond the map's projection.
std::optional<SavedView> SavedViews::currentView() const
{
    const TerrainView& view = parts_.view;
    const Map& map = *view.map();
    const auto camera = currentCamera();
    if (!camera) {
        return std::nullopt;
    }
    const auto shown = shownLayers(parts_.session.session());
    return SavedView{.camera = *camera,
                     .exaggeration = view.exaggeration(),
                     .layer = shown.empty() ? LayerId::None : shown.front()->id,
                     .body = map.info().body != nullptr ? std::string(map.info().body->name)
                                                        : std::string(),
                     .is_on_globe = globeCamera().has_value()};
}

void SavedViews::save()
{
    const TerrainView& view = parts_.view;
    if (!view.map()) {
        return;
    }
    auto saved = currentView();
    if (!saved) {
        Q_EMIT reported(tr("The view looks beyond the map's projection and cannot be saved"));
        return;
    }
    // What the flat map would show, as far as it reaches.
    const OrbitCamera named =
        orbitCamera(view.map()->georeference(), saved->camera, view.exaggeration())
            .value_or(view.cameraGoal());
    saved->name =
        uniqueViewName(parts_.session.session(),
                       viewNameFor(*view.map(), named, parts_.names ? parts_.names() : NamesOnMap{},
                                   parts_.format()))
            .toStdString();
    const ViewId id = parts_.session.addView(std::move(*saved));
    if (parts_.reveal_panel) {
        parts_.reveal_panel();
    }
    parts_.panel.editName(id);
}

void SavedViews::update(ViewId id)
{
    const SavedView* known = viewOf(parts_.session.session(), id);
    if (known == nullptr || !parts_.view.map()) {
        return;
    }
    auto saved = currentView();
    if (!saved) {
        Q_EMIT reported(tr("The view looks beyond the map's projection and cannot be saved"));
        return;
    }
    saved->id = id;
    saved->name = known->name;
    parts_.session.updateView(*saved);
    //: In the status bar, for a few seconds; %1 is a saved view
    Q_EMIT reported(tr("Updated %1").arg(QString::fromStdString(saved->name)));
}

void SavedViews::goTo(ViewId id)
{
    const SavedView* known = viewOf(parts_.session.session(), id);
    if (known == nullptr) {
        return;
    }
    const SavedView saved = *known;
    flight_.stop();
    if (!parts_.session.prepareView(id)) {
        Q_EMIT reported(
            saved.body.empty()
                //: %1 is a saved view
                ? tr("The layer of %1 is not open").arg(QString::fromStdString(saved.name))
                //: %1 is a saved view, %2 a body
                : tr("%1 is on %2: open a map of it first")
                      .arg(QString::fromStdString(saved.name), QString::fromStdString(saved.body)));
        return;
    }
    // Views of both scenes are the same places: the globe stays for all that are on a body.
    if (parts_.globe.fly && std::holds_alternative<GeographicPoint>(saved.camera.target) &&
        (saved.is_on_globe || globeCamera())) {
        parts_.globe.fly(saved.camera);
        return;
    }
    if (globeCamera()) {
        parts_.globe.leave();
    }
    TerrainView& view = parts_.view;
    const auto goal = sceneCamera(view, parts_.session.session(), saved, view.exaggeration());
    if (!goal) {
        Q_EMIT reported(
            //: %1 is a saved view
            tr("%1 is outside the map's projection").arg(QString::fromStdString(saved.name)));
        return;
    }
    const auto ground = [&view](double east_m, double north_m) {
        return view.ground().height(east_m, north_m) * view.exaggeration();
    };
    const CameraPath path =
        CameraPath::throughCameras({view.camera(), *goal}, FlightPace::SlowAtViews).above(ground);
    flight_.play(path, flightTime(path.length()));
}

QString SavedViews::descriptionOf(const SavedView& view) const
{
    const TerrainView& shown = parts_.view;
    QString place = QString::fromStdString(view.body);
    if (const auto camera = sceneCamera(shown, parts_.session.session(), view, view.exaggeration)) {
        const Map& map = *shown.map();
        place = positionText(parts_.format(), map,
                             map.georeference().sceneFrame().toGrid(camera->target),
                             0.01 * camera->distance_m);
    }
    //: Of a saved view; %1 is a position or a body, %2 a factor
    return tr("%1\nExaggeration ×%2").arg(place, shortNumberText(view.exaggeration, 3));
}

} // namespace marsview
