#include "ui/window/window_memory.h"

#include "ui/overlay/map_overlays.h"
#include "ui/window/window_docks.h"

#include <QAction>
#include <QMainWindow>
#include <QSettings>

namespace marsview {
namespace {

QString geometryKey()
{
    return QStringLiteral("window/geometry");
}

QString overlayKey(const QAction& action)
{
    return QStringLiteral("overlays/%1").arg(action.objectName());
}

QString hintKey()
{
    return QStringLiteral("hint/isDismissed");
}

} // namespace

void restoreWindow(QMainWindow& window, WindowDocks& docks, MapOverlays& overlays)
{
    const QSettings settings;
    window.restoreGeometry(settings.value(geometryKey()).toByteArray());
    docks.restore(settings);
    for (QAction* action : overlays.visibilityActions() + overlays.terrainActions()) {
        action->setChecked(settings.value(overlayKey(*action), action->isChecked()).toBool());
    }
}

void saveWindow(QMainWindow& window, WindowDocks& docks, const MapOverlays& overlays)
{
    QSettings settings;
    window.setWindowState(window.windowState().setFlag(Qt::WindowFullScreen, false));
    settings.setValue(geometryKey(), window.saveGeometry());
    docks.save(settings);
    for (const QAction* action : overlays.visibilityActions() + overlays.terrainActions()) {
        settings.setValue(overlayKey(*action), action->isChecked());
    }
}

void offerHintOnce(MapOverlays& overlays)
{
    if (QSettings().value(hintKey(), false).toBool()) {
        return;
    }
    QObject::connect(&overlays, &MapOverlays::hintDismissed, &overlays,
                     [] { QSettings().setValue(hintKey(), true); });
    overlays.offerHint();
}

} // namespace marsview
