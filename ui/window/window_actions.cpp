#include "ui/window/window_actions.h"

#include "core/session/layer_groups.h"
#include "core/session/measurement.h"
#include "ui/canvas/terrain_view.h"
#include "ui/text/contact_model_text.h"
#include "ui/text/core_text.h"
#include "ui/text/ramp_text.h"
#include "ui/widgets/icons.h"
#include "ui/window/action_icons.h"

#include <QActionGroup>
#include <QCoreApplication>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QShortcut>
#include <QUndoStack>
#include <QWhatsThis>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

namespace marsview {
namespace {

QString tr(const char* text)
{
    return QCoreApplication::translate("marsview::WindowActions", text);
}

struct StepAction {
    NavigationStep step;
    const char* text;
    Qt::Key key;
};

constexpr std::array kStepActions{
    StepAction{NavigationStep::ZoomIn, QT_TRANSLATE_NOOP("marsview::WindowActions", "Zoom &In"),
               Qt::Key_PageUp},
    StepAction{NavigationStep::ZoomOut, QT_TRANSLATE_NOOP("marsview::WindowActions", "Zoom &Out"),
               Qt::Key_PageDown},
    StepAction{NavigationStep::PanLeft, QT_TRANSLATE_NOOP("marsview::WindowActions", "Pan &Left"),
               Qt::Key_Left},
    StepAction{NavigationStep::PanRight, QT_TRANSLATE_NOOP("marsview::WindowActions", "Pan &Right"),
               Qt::Key_Right},
    StepAction{NavigationStep::PanAway,
               QT_TRANSLATE_NOOP("marsview::WindowActions", "Pan &Forward"), Qt::Key_Up},
    StepAction{NavigationStep::PanNearer, QT_TRANSLATE_NOOP("marsview::WindowActions", "Pan &Back"),
               Qt::Key_Down},
    StepAction{NavigationStep::TurnLeft, QT_TRANSLATE_NOOP("marsview::WindowActions", "&Turn Left"),
               Qt::Key_Q},
    StepAction{NavigationStep::TurnRight,
               QT_TRANSLATE_NOOP("marsview::WindowActions", "T&urn Right"), Qt::Key_E},
    StepAction{NavigationStep::TiltUp, QT_TRANSLATE_NOOP("marsview::WindowActions", "Tilt U&p"),
               Qt::Key_R},
    StepAction{NavigationStep::TiltDown, QT_TRANSLATE_NOOP("marsview::WindowActions", "Tilt &Down"),
               Qt::Key_F},
};

struct ShadingAction {
    ShadingMode mode;
    const char* text;
};

constexpr std::array kShadingActions{
    //: Colors by elevation, with light and shade
    ShadingAction{ShadingMode::Tint,
                  QT_TRANSLATE_NOOP("marsview::WindowActions", "&Shaded Relief")},
    //: Light and shade alone
    ShadingAction{ShadingMode::Hillshade,
                  QT_TRANSLATE_NOOP("marsview::WindowActions", "&Hillshade")},
    //: Colors by steepness
    ShadingAction{ShadingMode::Slope, QT_TRANSLATE_NOOP("marsview::WindowActions", "S&lope")},
};

struct StretchAction {
    StretchKind kind;
    const char* text;
    const char* tip;
    const char* slope_tip = nullptr; // with colors by slope, for those that slopes have
};

constexpr std::array kStretchActions{
    StretchAction{StretchKind::Automatic,
                  //: A color stretch: ignores the rarest elevations at either end
                  QT_TRANSLATE_NOOP("marsview::WindowActions", "&Automatic"),
                  QT_TRANSLATE_NOOP("marsview::WindowActions",
                                    "Spread the color ramp over all but the rarest half percent of "
                                    "elevations at either end"),
                  QT_TRANSLATE_NOOP("marsview::WindowActions",
                                    "Spread the color ramp over all but the steepest percent of "
                                    "the slopes")},
    StretchAction{StretchKind::Full,
                  //: A color stretch
                  QT_TRANSLATE_NOOP("marsview::WindowActions", "&Full Range"),
                  QT_TRANSLATE_NOOP("marsview::WindowActions",
                                    "Spread the color ramp from the lowest to the highest "
                                    "elevation of the layer")},
    StretchAction{StretchKind::Percentile,
                  //: A color stretch: so many percent are cut off at either end
                  QT_TRANSLATE_NOOP("marsview::WindowActions", "&Percentile…"),
                  QT_TRANSLATE_NOOP("marsview::WindowActions",
                                    "Cut off a percentage of the elevations at either end")},
    StretchAction{StretchKind::Fixed,
                  //: A color stretch: minimum and maximum are typed
                  QT_TRANSLATE_NOOP("marsview::WindowActions", "&Minimum and Maximum…"),
                  QT_TRANSLATE_NOOP("marsview::WindowActions",
                                    "Enter the values at the ends of the color ramp"),
                  QT_TRANSLATE_NOOP("marsview::WindowActions",
                                    "Enter the slopes at the ends of the color ramp")},
};

const StretchAction& stretchAction(StretchKind kind)
{
    return *std::find_if(kStretchActions.begin(), kStretchActions.end(),
                         [kind](const StretchAction& action) { return action.kind == kind; });
}

StretchKind shownStretch(const Layer& layer, ShadingMode mode)
{
    if (mode != ShadingMode::Slope) {
        return layer.stretch.kind;
    }
    return layer.slope_range ? StretchKind::Fixed : StretchKind::Automatic;
}

} // namespace

WindowActions::WindowActions(QMainWindow& window, QWidget& map, QUndoStack& undo_stack)
{
    makeFileMenu(window);
    makeEditMenu(window, undo_stack);
    makeViewMenu(window, map);
    makeMapMenu(window);
    makeMeasureMenu(window);
    makeAnnotateMenu(window);
    makeLayerMenu(window);
    makeHapticsMenu(window);
    makeHelpMenu(window);
    auto* open_menus = new QShortcut(Qt::Key_F10, &window);
    QObject::connect(open_menus, &QShortcut::activated, window.menuBar(), [bar = window.menuBar()] {
        bar->setActiveAction(bar->actions().constFirst());
    });
    setIcons(*this);
    for_shown_ +=
        {save_picture,    home, north, go_to_place, find_name, exaggerate_more, exaggerate_less,
         copy_coordinates};
    for_shown_ += steps;
    showSession({});
    showContactModel(kContactModelDefault);
}

void WindowActions::makeFileMenu(QMainWindow& window)
{
    QMenu* menu = window.menuBar()->addMenu(tr("&File"));
    file = menu;
    open = menu->addAction(tr("&Open…"));
    open->setShortcut(QKeySequence::Open);
    open->setToolTip(tr("Open a map as a new layer (%1)")
                         .arg(open->shortcut().toString(QKeySequence::NativeText)));
    open_folder = menu->addAction(tr("Open &Folder…"));
    open_folder->setShortcut(QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_O));
    open_folder->setToolTip(tr("Open the adjoining rasters in a folder as one map"));
    open_address = menu->addAction(tr("Open &Address…"));
    open_address->setShortcut(QKeySequence(Qt::CTRL | Qt::Key_U));
    open_address->setToolTip(tr("Open a cloud-optimized GeoTIFF on a server"));
    open_names = menu->addAction(tr("Open Na&mes…"));
    open_names->setToolTip(tr("Open a file of named points to find and show on the map"));
    open_names->setEnabled(false);
    open_vector = menu->addAction(tr("Open Vector Fi&le…"));
    open_vector->setShortcut(QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_V));
    open_vector->setToolTip(tr("Draw points, lines and polygons of a file on the terrain"));
    open_vector->setEnabled(false);
    recent = menu->addMenu(tr("Open &Recent"));
    bundled = menu->addMenu(tr("Open &Bundled Map"));
    menu->addSeparator();
    save_picture = menu->addAction(tr("Save &Picture…"));
    save_picture->setShortcut(QKeySequence(Qt::CTRL | Qt::Key_P));
    save_picture->setToolTip(tr("Save what the map shows as a picture"));
    menu->addSeparator();
    cancel_loading = menu->addAction(tr("&Cancel Loading"));
    cancel_loading->setShortcut(Qt::Key_Escape);
    cancel_loading->setEnabled(false);
    stop_preparing = menu->addAction(tr("S&top Building Overviews"));
    stop_preparing->setToolTip(
        tr("Stop building the overviews of a large map; it can be resumed later"));
    stop_preparing->setEnabled(false);
    menu->addSeparator();
    quit = menu->addAction(tr("&Quit"));
    quit->setShortcut(QKeySequence::Quit);
    quit->setMenuRole(QAction::QuitRole);
}

void WindowActions::makeEditMenu(QMainWindow& window, QUndoStack& undo_stack)
{
    QMenu* menu = window.menuBar()->addMenu(tr("&Edit"));
    QAction* undo = undo_stack.createUndoAction(&window, tr("&Undo"));
    undo->setShortcut(QKeySequence::Undo);
    undo->setIcon(lineIcon(QStringLiteral("undo")));
    undo->setProperty(kKeyTextProperty, tr("Undo")); // without what would be undone
    menu->addAction(undo);
    QAction* redo = undo_stack.createRedoAction(&window, tr("&Redo"));
    redo->setShortcut(QKeySequence::Redo);
    redo->setIcon(lineIcon(QStringLiteral("redo")));
    redo->setProperty(kKeyTextProperty, tr("Redo"));
    menu->addAction(redo);
    menu->addSeparator();
    copy_coordinates = menu->addAction(tr("&Copy Coordinates"));
    copy_coordinates->setShortcut(QKeySequence(Qt::CTRL | Qt::SHIFT | Qt::Key_C));
    copy_coordinates->setStatusTip(
        tr("Copy the position under the pointer, or under the crosshair, to the clipboard"));
    menu->addSeparator();
    preferences = menu->addAction(tr("&Preferences…"));
    // Few desktops other than macOS set this one.
    preferences->setShortcut(QKeySequence(Qt::CTRL | Qt::Key_Comma));
    preferences->setMenuRole(QAction::PreferencesRole);
}

void WindowActions::makeViewMenu(QMainWindow& window, QWidget& map)
{
    QMenu* menu = window.menuBar()->addMenu(tr("&View"));
    view_menu = menu;
    const auto add_key = [&map](QAction* action, const QList<QKeySequence>& sequences) {
        action->setShortcuts(sequences);
        action->setShortcutContext(Qt::WidgetShortcut);
        map.addAction(action);
    };
    home = menu->addAction(tr("&Home"));
    home->setToolTip(tr("Show the whole map from the south (Home)"));
    add_key(home, {Qt::Key_Home});
    north = menu->addAction(tr("&North Up"));
    north->setIconText(tr("North"));
    north->setToolTip(tr("Turn north to the top (N)"));
    add_key(north, {Qt::Key_N});
    go_to_place = menu->addAction(tr("&Go to Place…"));
    go_to_place->setToolTip(tr("Go to a name or a coordinate"));
    go_to_place->setShortcut(QKeySequence(Qt::CTRL | Qt::Key_G));
    find_name = menu->addAction(tr("Fin&d Name"));
    find_name->setToolTip(tr("Search for the name of a place"));
    find_name->setShortcut(QKeySequence::Find);
    coordinate_format = menu->addMenu(tr("Coordinate &Format"));
    menu->addSeparator();
    makeSceneMenu(window, *menu);
    add_key(globe, {Qt::Key_G});
    makeToolMenu(window, *menu, map);
    QMenu* move = menu->addMenu(tr("&Move"));
    for (const StepAction& entry : kStepActions) {
        QAction* action = move->addAction(tr(entry.text));
        action->setData(static_cast<int>(entry.step));
        add_key(action, {entry.key});
        steps.append(action);
    }
    menu->addSeparator();
    exaggerate_more = menu->addAction(tr("E&xaggerate More"));
    add_key(exaggerate_more, {Qt::Key_Plus, Qt::Key_Equal});
    exaggerate_less = menu->addAction(tr("Exaggerate &Less"));
    add_key(exaggerate_less, {Qt::Key_Minus});
    menu->addSeparator();
    panels = menu->addMenu(tr("&Panels"));
    next_panel = panels->addAction(tr("&Next Panel"));
    next_panel->setShortcut(Qt::Key_F6);
    next_panel->setToolTip(tr("Move the keyboard focus to the next panel or the map"));
    previous_panel = panels->addAction(tr("&Previous Panel"));
    previous_panel->setShortcut(Qt::SHIFT | Qt::Key_F6);
    previous_panel->setToolTip(tr("Move the keyboard focus to the previous panel or the map"));
    panels->addSeparator();
    full_screen = menu->addAction(tr("Full &Screen"));
    full_screen->setShortcut(Qt::Key_F11);
    full_screen->setCheckable(true);
}

void WindowActions::makeSceneMenu(QMainWindow& window, QMenu& view)
{
    //: How the terrain is laid out: in a plane, or on its body
    QMenu* menu = view.addMenu(tr("Sc&ene"));
    menu->setToolTipsVisible(true);
    scenes = new QActionGroup(&window);
    const auto add = [&](const QString& text, const QString& tip) {
        QAction* action = menu->addAction(text);
        action->setCheckable(true);
        action->setChecked(scenes->actions().isEmpty());
        action->setData(static_cast<int>(scenes->actions().size()));
        action->setToolTip(tip);
        action->setStatusTip(tip);
        scenes->addAction(action);
    };
    //: A scene: the one that suits the layers
    add(tr("&Automatic"), tr("The globe where layers have several CRSs or cover a tenth of their "
                             "body, otherwise the flat map"));
    //: A scene
    add(tr("&Flat Map"), tr("Lay the topmost layer out in the plane of its CRS"));
    //: A scene: the topmost layer where it lies on its body
    add(tr("&Globe"), tr("Show the topmost layer where it lies on its body"));
    menu->addSeparator();
    //: In the menu of scenes: shows the globe, or the flat map again
    globe = menu->addAction(tr("&Switch to Globe or Back"));
    globe->setIconText(tr("Globe"));
    globe->setCheckable(true);
}

void WindowActions::makeToolMenu(QMainWindow& window, QMenu& view, QWidget& map)
{
    //: What the left mouse button does
    QMenu* menu = view.addMenu(tr("&Tool"));
    tools = new QActionGroup(&window);
    for (const ToolInfo& info : toolInfos()) {
        QAction* action = menu->addAction(info.text());
        action->setCheckable(true);
        action->setData(static_cast<int>(info.tool));
        action->setToolTip(info.tip());
        action->setWhatsThis(info.whatsThis());
        action->setShortcut(info.key);
        action->setShortcutContext(Qt::WidgetShortcut);
        map.addAction(action);
        tools->addAction(action);
    }
}

void WindowActions::makeMapMenu(QMainWindow& window)
{
    QMenu* menu = window.menuBar()->addMenu(tr("&Map"));
    shading = menu->addMenu(tr("&Shading"));
    shading_group = new QActionGroup(&window);
    for (const ShadingAction& entry : kShadingActions) {
        QAction* action = shading->addAction(tr(entry.text));
        action->setCheckable(true);
        action->setData(static_cast<int>(entry.mode));
        shading_group->addAction(action);
    }
    shading->addSeparator();
    contours = shading->addAction(tr("&Contour Lines"));
    contours->setCheckable(true);
    contour_interval = shading->addAction(tr("Contour &Interval…"));
    contour_interval->setToolTip(tr("Enter the elevation between two contour lines"));
    ramps = menu->addMenu(tr("&Color Ramp"));
    ramp_group = new QActionGroup(&window);
    const auto add_ramp = [this](const QString& text, const QString& name) {
        QAction* action = ramps->addAction(text);
        action->setCheckable(true);
        action->setData(name);
        ramp_group->addAction(action);
        return action;
    };
    //: A color ramp: the one that suits the map's body
    add_ramp(tr("Automatic"), {});
    ramps->addSeparator();
    for (const ColorRamp& ramp : colorRamps()) {
        add_ramp(rampName(ramp), textFrom(ramp.name))->setIcon(rampIcon(ramp));
    }
    makeStretchMenu(window, *menu);
    light = menu->addAction(tr("&Light…"));
    light->setToolTip(tr("Choose where the light comes from"));
}

void WindowActions::makeLayerMenu(QMainWindow& window)
{
    QMenu* menu = window.menuBar()->addMenu(tr("&Layer"));
    toggle_visibility = menu->addAction(tr("Show La&yer"));
    toggle_visibility->setCheckable(true);
    layer.go_to = menu->addAction(tr("&Go to Layer"));
    layer.rename = menu->addAction(tr("Re&name Layer"));
    layer.rename->setShortcut(Qt::Key_F2);
    layer.rename->setShortcutContext(Qt::WidgetShortcut);
    layer.move_up = menu->addAction(tr("Move Layer &Up"));
    layer.move_up->setShortcut(QKeySequence(Qt::ALT | Qt::Key_Up));
    layer.move_up->setShortcutContext(Qt::WidgetShortcut);
    layer.move_down = menu->addAction(tr("Move Layer &Down"));
    layer.move_down->setShortcut(QKeySequence(Qt::ALT | Qt::Key_Down));
    layer.move_down->setShortcutContext(Qt::WidgetShortcut);
    //: Of layers that overlap
    layer.finest_first = menu->addAction(tr("&Finest Layer on Top"));
    layer.finest_first->setCheckable(true);
    layer.finest_first->setStatusTip(
        tr("Where layers overlap, show, read and touch the one with the smallest pixels, instead "
           "of the upper one in the list"));
    menu->addSeparator();
    layer.prepare = menu->addAction(tr("&Build Overviews"));
    layer.prepare->setToolTip(tr("Build the overviews of a large map, to see and touch all of it"));
    export_contours = menu->addAction(tr("E&xport Contours…"));
    export_contours->setToolTip(
        tr("Save the contours of the layer at full resolution as a vector file"));
    override_georeferencing = menu->addAction(tr("Set Body, &CRS…"));
    override_georeferencing->setToolTip(
        tr("Set body, CRS, elevation unit and more for a file that lacks them"));
    menu->addSeparator();
    vector_files = menu->addMenu(tr("&Vector Files"));
    vector_files->menuAction()->setStatusTip(tr("Show, find, color or close open vector files"));
    vector_files->setEnabled(false);
    menu->addSeparator();
    layer.remove = menu->addAction(tr("R&emove Layer"));
    layer.remove->setIconText(tr("Remove"));
    layer.remove->setShortcut(QKeySequence::Delete);
    layer.remove->setShortcutContext(Qt::WidgetShortcut);
    layer.open = open;
}

void WindowActions::makeStretchMenu(QMainWindow& window, QMenu& map)
{
    stretches = map.addMenu(tr("Color S&tretch"));
    stretch_group = new QActionGroup(&window);
    for (const StretchAction& entry : kStretchActions) {
        QAction* action = stretches->addAction(tr(entry.text));
        action->setCheckable(true);
        action->setData(static_cast<int>(entry.kind));
        action->setStatusTip(tr(entry.tip));
        stretch_group->addAction(action);
    }
    stretches->addSeparator();
    stretch_to_view = stretches->addAction(tr("&Stretch to Current View"));
    edit_stretch = stretches->addAction(tr("&Edit Stretch…"));
    edit_stretch->setStatusTip(tr("Show the histogram of the layer with the ends of the stretch"));
}

void WindowActions::makeHapticsMenu(QMainWindow& window)
{
    QMenu* menu = window.menuBar()->addMenu(tr("Ha&ptics"));
    contact_models = menu->addMenu(tr("&Contact Model"));
    contact_models->menuAction()->setStatusTip(
        tr("How the point of contact follows the stylus over the terrain"));
    contact_model_group = new QActionGroup(&window);
    for (const ContactModelWords& entry : contactModelWords()) {
        QAction* action = contact_models->addAction(tr(entry.text));
        action->setCheckable(true);
        action->setData(static_cast<int>(entry.model));
        action->setStatusTip(tr(entry.tip));
        contact_model_group->addAction(action);
    }
    contact_sound = menu->addAction(tr("So&und of Touch"));
    contact_sound->setCheckable(true);
    contact_sound->setStatusTip(
        tr("Hear the terrain that is touched: the force as a tone, its roughness as a hiss"));
    haptic_devices = menu->addAction(tr("&Devices…"));
    haptic_devices->setStatusTip(tr("Connect a haptic device and set stiffness and force"));
    menu->addSeparator();
    record_touch = menu->addAction(tr("&Record Touch…"));
    record_touch->setStatusTip(tr("Record the motion of the device's stylus in a file"));
    record_touch->setEnabled(false);
    replay_touch = menu->addAction(tr("Re&play Touch…"));
    replay_touch->setStatusTip(tr("Play back a recording in place of a device"));
    save_flight = menu->addAction(tr("Save Diagnostic &Log…"));
    save_flight->setStatusTip(
        tr("Save the last ten seconds of the device, tick by tick, for troubleshooting"));
    save_flight->setEnabled(false);
    menu->addSeparator();
    emergency_stop = menu->addAction(tr("Emergency &Stop"));
    emergency_stop->setShortcuts(
        {QKeySequence(Qt::CTRL | Qt::Key_Period), QKeySequence(Qt::Key_Pause)});
    emergency_stop->setShortcutContext(Qt::ApplicationShortcut);
    emergency_stop->setStatusTip(tr("Switch all forces off at once"));
    emergency_stop->setEnabled(false);
}

void WindowActions::makeHelpMenu(QMainWindow& window)
{
    QMenu* menu = window.menuBar()->addMenu(tr("&Help"));
    guide = menu->addAction(tr("User &Guide"));
    guide->setShortcut(QKeySequence::HelpContents);
    keys = menu->addAction(tr("&Keys and Mouse"));
    keys->setShortcut(QKeySequence(Qt::CTRL | Qt::Key_F1));
    whats_this = QWhatsThis::createAction(&window);
    whats_this->setText(tr("&What's This?"));
    menu->addAction(whats_this);
    menu->addSeparator();
    about = menu->addAction(tr("&About MarsView"));
    about->setMenuRole(QAction::AboutRole);
}

void WindowActions::showContactModel(ContactModelKind model)
{
    for (QAction* action : contact_model_group->actions()) {
        action->setChecked(action->data().toInt() == static_cast<int>(model));
    }
}

void WindowActions::showTool(Tool tool, MeasurementKind kind)
{
    for (QAction* action : tools->actions()) {
        action->setChecked(action->data().toInt() == static_cast<int>(tool));
    }
    for (QAction* action : measure_kinds->actions()) {
        const bool is_next = action->data().toInt() == static_cast<int>(kind);
        action->setChecked(tool == Tool::Measure && is_next);
        if (is_next) {
            showKind(Tool::Measure, action->text());
        }
    }
}

// What a tool makes, below its description.
void WindowActions::showKind(Tool tool, const QString& kind)
{
    for (const ToolInfo& info : toolInfos()) {
        if (info.tool == tool) {
            tools->actions()
                .at(&info - toolInfos().data())
                ->setToolTip(QStringLiteral("%1\n%2").arg(info.tip(), QString(kind).remove(u'&')));
        }
    }
}

void WindowActions::makeMeasureMenu(QMainWindow& window)
{
    measure = window.menuBar()->addMenu(tr("Mea&sure"));
    measure_kinds = new QActionGroup(&window);
    measure_kinds->setExclusionPolicy(QActionGroup::ExclusionPolicy::ExclusiveOptional);
    struct Entry {
        MeasurementKind kind;
        const char* text;
        const char* tip;
    };
    for (const Entry& entry : {
             Entry{MeasurementKind::Profile, QT_TR_NOOP("&Profile"),
                   QT_TR_NOOP("Click along a line: its elevations, lengths and slopes")},
             Entry{MeasurementKind::Distance, QT_TR_NOOP("&Distance"),
                   QT_TR_NOOP("Click along a line: its length on the body and along the terrain")},
             Entry{MeasurementKind::Area, QT_TR_NOOP("&Area and Volume"),
                   QT_TR_NOOP("Click around an area: its size, and the volume above and below the "
                              "plane through its border")},
             Entry{MeasurementKind::Attitude, QT_TR_NOOP("&Strike and Dip"),
                   QT_TR_NOOP("Click three or more points on a layer of rock: the plane through "
                              "them")},
             Entry{MeasurementKind::Crater, QT_TR_NOOP("&Crater"),
                   QT_TR_NOOP("Click three or more points on the rim: diameter and depth")},
             Entry{MeasurementKind::Slope, QT_TR_NOOP("&Elevation and Slope"),
                   QT_TR_NOOP("Click a point: its elevation, slope and aspect")},
         }) {
        QAction* action = measure->addAction(tr(entry.text));
        action->setStatusTip(tr(entry.tip));
        action->setCheckable(true);
        action->setData(static_cast<int>(entry.kind));
        measure_kinds->addAction(action);
        for_shown_.append(action);
    }
    measure->addSeparator();
    add_point = measure->addAction(tr("Add Point &by Coordinates…"));
    add_point->setStatusTip(tr("Type the coordinates of the next point, or a name"));
    for_shown_.append(add_point);
    finish_measurement = measure->addAction(tr("&Finish Measurement"));
    finish_measurement->setStatusTip(tr("The next click begins another measurement"));
    remove_measurement = measure->addAction(tr("&Remove Measurement"));
    remove_measurements = measure->addAction(tr("Remove A&ll Measurements"));
    measure->addSeparator();
    showTool(Tool::Pan, MeasurementKind::Profile);
}

void WindowActions::showShape(Tool tool, FeatureShape shape)
{
    for (QAction* action : annotation_shapes->actions()) {
        const bool is_next = action->data().toInt() == static_cast<int>(shape);
        action->setChecked(tool == Tool::Annotate && is_next);
        if (is_next) {
            showKind(Tool::Annotate, action->text());
        }
    }
}

void WindowActions::makeAnnotateMenu(QMainWindow& window)
{
    annotate = window.menuBar()->addMenu(tr("&Annotate"));
    annotation_shapes = new QActionGroup(&window);
    annotation_shapes->setExclusionPolicy(QActionGroup::ExclusionPolicy::ExclusiveOptional);
    struct Entry {
        FeatureShape shape;
        const char* text;
        const char* tip;
    };
    for (const Entry& entry : {
             //: An annotation
             Entry{FeatureShape::Point, QT_TR_NOOP("&Point"),
                   QT_TR_NOOP("Click to mark a place with a symbol and a name")},
             //: An annotation
             Entry{FeatureShape::Line, QT_TR_NOOP("&Line"),
                   QT_TR_NOOP("Click along a line; a double click finishes it")},
             //: An annotation
             Entry{FeatureShape::Polygon, QT_TR_NOOP("P&olygon"),
                   QT_TR_NOOP("Click around an area; a double click finishes it")},
         }) {
        QAction* action = annotate->addAction(tr(entry.text));
        action->setStatusTip(tr(entry.tip));
        action->setCheckable(true);
        action->setData(static_cast<int>(entry.shape));
        annotation_shapes->addAction(action);
        for_shown_.append(action);
    }
    annotate->addSeparator();
    add_annotation_point = annotate->addAction(tr("Add Point &by Coordinates…"));
    add_annotation_point->setStatusTip(tr("Type the coordinates of the next point, or a name"));
    for_shown_.append(add_annotation_point);
    finish_annotation = annotate->addAction(tr("&Finish Annotation"));
    finish_annotation->setStatusTip(tr("The next click begins another annotation"));
    remove_annotations = annotate->addAction(tr("&Remove Annotations"));
    remove_annotations->setStatusTip(
        tr("Remove the annotations that are selected in the panel; Undo brings them back"));
    annotate->addSeparator();
    import_annotations = annotate->addAction(tr("&Import…"));
    import_annotations->setStatusTip(
        tr("Add the points, lines and polygons of a GeoPackage, GeoJSON, KML, Shapefile or CSV "
           "file"));
    for_shown_.append(import_annotations);
    export_annotations = annotate->addAction(tr("&Export…"));
    export_annotations->setStatusTip(
        tr("Save the annotations as GeoPackage, GeoJSON, KML, Shapefile or CSV"));
    annotate->addSeparator();
}

void WindowActions::showSession(const Session& session)
{
    const Layer* active = activeLayer(session);
    const std::vector<LayerState> states = placement(session);
    const std::size_t index = indexOf(session, session.active);
    const bool is_any_shown =
        std::find(states.begin(), states.end(), LayerState::Shown) != states.end();
    for (QAction* action : std::as_const(for_shown_)) {
        action->setEnabled(is_any_shown);
    }
    coordinate_format->setEnabled(is_any_shown);
    for (QAction* action : {layer.rename, layer.remove, toggle_visibility, override_georeferencing,
                            export_contours}) {
        action->setEnabled(active != nullptr);
    }
    layer.prepare->setEnabled(false); // the window knows
    layer.go_to->setEnabled(active != nullptr);
    layer.move_up->setEnabled(indexBeside(session, session.active, GroupStep::Up).has_value());
    layer.move_down->setEnabled(indexBeside(session, session.active, GroupStep::Down).has_value());
    toggle_visibility->setChecked(active != nullptr && states[index] == LayerState::Shown);
    ramp_group->setEnabled(active != nullptr);
    for (QAction* action : ramp_group->actions()) {
        action->setChecked(active != nullptr &&
                           action->data().toString() == QString::fromStdString(active->ramp));
    }
    const bool is_slope = session.look.mode == ShadingMode::Slope;
    for (QAction* action : stretch_group->actions()) {
        const auto kind = static_cast<StretchKind>(action->data().toInt());
        const bool is_for_slopes = kind == StretchKind::Automatic || kind == StretchKind::Fixed;
        action->setEnabled(active != nullptr);
        action->setVisible(!is_slope || is_for_slopes);
        const StretchAction& entry = stretchAction(kind);
        action->setStatusTip(
            tr(is_slope && entry.slope_tip != nullptr ? entry.slope_tip : entry.tip));
        action->setChecked(active != nullptr && kind == shownStretch(*active, session.look.mode));
    }
    stretch_to_view->setVisible(!is_slope);
    edit_stretch->setEnabled(active != nullptr);
    for (QAction* action : shading_group->actions()) {
        action->setChecked(action->data().toInt() == static_cast<int>(session.look.mode));
    }
    contours->setChecked(session.look.has_contours);
    layer.finest_first->setChecked(session.order == LayerOrder::FinestFirst);
}

void WindowActions::showStretchToView(bool has_layer, bool is_in_picture) const
{
    stretch_to_view->setEnabled(is_in_picture);
    stretch_to_view->setStatusTip(
        is_in_picture || !has_layer
            ? tr("Spread the color ramp over the elevations that the picture shows now")
            //: Why an entry of the menu cannot be chosen
            : tr("Not available: the selected layer is not in the picture. Show it first"));
}

} // namespace marsview
