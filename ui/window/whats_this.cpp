#include "ui/window/whats_this.h"

#include "ui/canvas/terrain_view.h"
#include "ui/overlay/compass.h"
#include "ui/overlay/gesture_hint.h"
#include "ui/overlay/globe_overlays.h"
#include "ui/overlay/legend.h"
#include "ui/overlay/map_overlays.h"
#include "ui/overlay/minimap.h"
#include "ui/overlay/scale_bar_view.h"
#include "ui/widgets/notice_bar.h"
#include "ui/window/load_status.h"
#include "ui/window/status_readout.h"
#include "ui/window/window_actions.h"
#include "ui/window/window_docks.h"

#include <QAction>
#include <QCoreApplication>
#include <QDockWidget>
#include <QMenu>

namespace marsview {
namespace {

QString helpTr(const char* text)
{
    return QCoreApplication::translate("WhatsThis", text);
}

// The flat map and the globe have the same parts.
template <typename Overlays>
void explainMap(QWidget& map, const Overlays& overlays)
{
    map.setWhatsThis(helpTr(QT_TRANSLATE_NOOP(
        "WhatsThis",
        "The terrain. A drag with the left button uses the selected tool: pan, touch or orbit. "
        "A drag with the right button turns and tilts, the wheel zooms to the pointer, a double "
        "click flies there, and a right click opens a menu for the place.")));
    overlays.minimap()->setWhatsThis(helpTr(QT_TRANSLATE_NOOP(
        "WhatsThis",
        "The whole topmost map, or all of a body that is seen as a globe. The outline is what the "
        "view shows. Click or drag to look at another place.")));
    overlays.compass()->setWhatsThis(helpTr(QT_TRANSLATE_NOOP(
        "WhatsThis", "The needle points north. Click to turn north to the top.")));
    overlays.scaleBar()->setWhatsThis(helpTr(QT_TRANSLATE_NOOP(
        "WhatsThis", "The length of the bar on the terrain in the middle of the picture.")));
    overlays.legend()->setWhatsThis(helpTr(QT_TRANSLATE_NOOP(
        "WhatsThis",
        "What the colors of the terrain represent. Arrows at the ends mean that values beyond "
        "them have the color of the end.")));
    overlays.hint()->setWhatsThis(helpTr(QT_TRANSLATE_NOOP(
        "WhatsThis",
        "How to move over the map with mouse and keys. Each way that was tried gets a check mark. "
        "Esc closes the hint, and Help › Keys and Mouse lists everything.")));
}

} // namespace

void explainControls(const ExplainedControls& controls)
{
    explainMap(*controls.view, *controls.overlays);
    explainMap(*controls.globe, *controls.globe_overlays);
    controls.notices->setWhatsThis(helpTr(QT_TRANSLATE_NOOP(
        "WhatsThis",
        "A notice about the active layer, the picture, a file or a device. Its button solves the "
        "problem or offers a choice, Details shows where it comes from, and × closes it.")));
    controls.readout->setWhatsThis(helpTr(QT_TRANSLATE_NOOP(
        "WhatsThis",
        "Position and elevation under the pointer or under the stylus of a haptic "
        "device, read from the full-resolution surface, and how far the drawn "
        "surface is off, in pixels.")));
    controls.load_status->setWhatsThis(helpTr(QT_TRANSLATE_NOOP(
        "WhatsThis",
        "Maps that are loading or being built, with their progress and a button to stop.")));
    controls.docks->datasets()->setWhatsThis(helpTr(QT_TRANSLATE_NOOP(
        "WhatsThis",
        "The open maps as layers, topmost first, grouped by body. Tick a layer to show it, "
        "drag it to move it, choose its color ramp below.")));
    controls.docks->georeferencing()->setWhatsThis(helpTr(QT_TRANSLATE_NOOP(
        "WhatsThis",
        "Where the active layer lies: body, ellipsoid, CRS, pixel size, extent and "
        "elevation unit. Set Body, CRS… sets what the file lacks or states wrongly.")));
    controls.docks->haptics()->setWhatsThis(helpTr(QT_TRANSLATE_NOOP(
        "WhatsThis",
        "Haptic devices: connect one, set how the terrain feels, record and replay "
        "touches, and stop all forces.")));
    const WindowActions& actions = *controls.actions;
    actions.open->setWhatsThis(helpTr(QT_TRANSLATE_NOOP(
        "WhatsThis", "Opens any elevation raster that GDAL reads as a new layer.")));
    actions.save_picture->setWhatsThis(helpTr(QT_TRANSLATE_NOOP(
        "WhatsThis", "Saves what the map shows, with legend, compass and scale bar.")));
    actions.home->setWhatsThis(
        helpTr(QT_TRANSLATE_NOOP("WhatsThis", "Shows the whole map from the south.")));
    actions.north->setWhatsThis(
        helpTr(QT_TRANSLATE_NOOP("WhatsThis", "Turns the view until north is at the top.")));
    actions.globe->setWhatsThis(helpTr(QT_TRANSLATE_NOOP(
        "WhatsThis", "Shows all layers of one body where they lie on it, or the flat map again.")));
    actions.light->setWhatsThis(helpTr(QT_TRANSLATE_NOOP(
        "WhatsThis", "Chooses the azimuth and altitude of the light that shades the terrain.")));
}

} // namespace marsview
