#include "ui/window/window_docks.h"

#include <QAction>
#include <QApplication>
#include <QDockWidget>
#include <QMainWindow>
#include <QScopedValueRollback>
#include <QSettings>
#include <QStyle>

#include <algorithm>
#include <array>

namespace marsview {
namespace {

constexpr int kStateVersion = 3; // of saveState(); raise when docks or toolbars change meaning

constexpr int kDockShareOfWidth = 3;      // for the panels of both sides
constexpr int kDockShareOfWidthAlone = 4; // for those of one side
constexpr int kDockWidthMin = 200;
constexpr int kDockWidthMax = 300;

// The control of a panel that had the focus last; at first the first one; null if there is none.
QWidget* focusTargetIn(const QWidget& panel)
{
    const auto can_take = [&panel](const QWidget* widget) {
        return panel.isAncestorOf(widget) && widget->isVisible() && widget->isEnabled() &&
               (widget->focusPolicy() & Qt::TabFocus) == Qt::TabFocus;
    };
    if (QWidget* last = panel.focusWidget(); last != nullptr && can_take(last)) {
        return last;
    }
    QWidget* const start = panel.nextInFocusChain();
    QWidget* widget = start;
    while (widget != nullptr && !can_take(widget)) {
        widget = widget->nextInFocusChain();
        if (widget == start) {
            return nullptr;
        }
    }
    return widget;
}

bool isDocked(const QDockWidget& dock)
{
    return dock.isVisibleTo(dock.parentWidget()) && !dock.isFloating();
}

} // namespace

WindowDocks::WindowDocks(QMainWindow& window, const DockContents& contents)
    : QObject(&window)
    , window_(window)
{
    makeDock(datasets_, tr("Layers"), QStringLiteral("datasetDock"), contents.datasets);
    makeDock(views_, tr("Views"), QStringLiteral("viewsDock"), contents.views);
    makeDock(georeferencing_, tr("Georeferencing"), QStringLiteral("georeferencingDock"),
             contents.georeferencing);
    makeDock(haptics_, tr("Haptics"), QStringLiteral("hapticsDock"), contents.haptics);
    window_.addDockWidget(Qt::LeftDockWidgetArea, datasets_.widget);
    window_.addDockWidget(Qt::LeftDockWidgetArea, views_.widget);
    window_.tabifyDockWidget(datasets_.widget, views_.widget);
    views_.widget->hide();
    window_.addDockWidget(Qt::RightDockWidgetArea, georeferencing_.widget);
    window_.addDockWidget(Qt::RightDockWidgetArea, haptics_.widget);
    window_.tabifyDockWidget(georeferencing_.widget, haptics_.widget);
    haptics_.widget->hide();
    measurements_ = makeDockBelow(tr("Measurements"), QStringLiteral("measurementsDock"),
                                  contents.measurements);
    annotations_ =
        makeDockBelow(tr("Annotations"), QStringLiteral("annotationsDock"), contents.annotations);
    window_.tabifyDockWidget(measurements_, annotations_);
    measurements_->hide();
    annotations_->hide();
    for (const Dock* dock : all()) {
        connect(dock->widget, &QDockWidget::topLevelChanged, this, &WindowDocks::fit);
        connect(dock->widget, &QDockWidget::dockLocationChanged, this, &WindowDocks::fit);
    }
    datasets_.turn = ++turn_; // rather this one, where there is room for one
    fit();
}

QDockWidget* WindowDocks::makeDockBelow(const QString& title, const QString& name, QWidget* content)
{
    auto* dock = new QDockWidget(title, &window_);
    dock->setObjectName(name);
    dock->setAllowedAreas(Qt::BottomDockWidgetArea | Qt::TopDockWidgetArea);
    dock->setWidget(content);
    window_.addDockWidget(Qt::BottomDockWidgetArea, dock);
    return dock;
}

void WindowDocks::makeDock(Dock& dock, const QString& title, const QString& name, QWidget* content)
{
    dock.widget = new QDockWidget(title, &window_);
    dock.widget->setObjectName(name);
    dock.widget->setAllowedAreas(Qt::LeftDockWidgetArea | Qt::RightDockWidgetArea);
    dock.widget->setWidget(content);
    dock.widget->setMinimumWidth(kDockWidthMin);
    connect(dock.widget->toggleViewAction(), &QAction::triggered, this,
            [this, &dock](bool is_checked) { userToggled(dock, is_checked); });
}

void WindowDocks::userToggled(Dock& dock, bool is_visible)
{
    dock.is_folded = false;
    if (is_visible) {
        dock.turn = ++turn_;
    }
    fit();
}

void WindowDocks::reveal(QDockWidget& widget)
{
    widget.show();
    widget.raise();
    for (Dock* dock : all()) {
        if (dock->widget == &widget) {
            userToggled(*dock, true);
        }
    }
}

void WindowDocks::moveFocus(QWidget& map, FocusStep step)
{
    QList<QWidget*> stops = {&map};
    for (QDockWidget* dock : {datasets_.widget, views_.widget, georeferencing_.widget,
                              haptics_.widget, measurements_, annotations_}) {
        if (dock->isVisibleTo(&window_)) {
            stops.append(dock);
        }
    }
    const QWidget* focus = QApplication::focusWidget();
    qsizetype at = 0; // outside map and panels, the circle starts at the map
    for (qsizetype i = 1; i < stops.size(); ++i) {
        if (focus != nullptr && stops[i]->isAncestorOf(focus)) {
            at = i;
        }
    }
    const qsizetype stride = step == FocusStep::Next ? 1 : stops.size() - 1;
    for (qsizetype i = 0; i < stops.size(); ++i) {
        at = (at + stride) % stops.size();
        QWidget* stop = stops[at];
        if (stop == &map) {
            map.window()->activateWindow(); // a floating panel may be active
            map.setFocus(Qt::ShortcutFocusReason);
            return;
        }
        stop->raise();
        if (QWidget* target = focusTargetIn(*qobject_cast<QDockWidget*>(stop)->widget())) {
            target->activateWindow();
            target->setFocus(Qt::ShortcutFocusReason);
            return;
        }
    }
}

void WindowDocks::fold(Dock& dock, bool is_folded)
{
    if (dock.is_folded != is_folded) {
        dock.is_folded = is_folded;
        dock.widget->setVisible(!is_folded);
    }
}

void WindowDocks::fit()
{
    if (is_fitting_) {
        return;
    }
    const QScopedValueRollback fitting(is_fitting_, true);
    std::array<Dock*, 4> by_turn = all();
    std::stable_sort(by_turn.begin(), by_turn.end(),
                     [](const Dock* a, const Dock* b) { return a->turn > b->turn; });
    const int separator =
        window_.style()->pixelMetric(QStyle::PM_DockWidgetSeparatorExtent, nullptr, &window_);
    const int width_max = window_.width() / kDockShareOfWidth - 2 * separator; // of all panels
    // Each side that is in use takes its width once, however many panels are on it.
    bool is_left_used = false;
    bool is_right_used = false;
    int sides = 0;
    for (Dock* dock : by_turn) {
        if (!isDocked(*dock->widget) && !dock->is_folded) {
            continue; // closed by the user, or floating
        }
        bool& is_used = window_.dockWidgetArea(dock->widget) == Qt::RightDockWidgetArea
                            ? is_right_used
                            : is_left_used;
        const int sides_with_it = sides + (is_used ? 0 : 1);
        // What the user asked for last stays, even in a narrow window.
        const bool has_room = sides_with_it * kDockWidthMin <= width_max;
        const bool is_asked_for = dock == by_turn.front() && dock->turn > 1;
        fold(*dock, !has_room && !is_asked_for);
        if (!dock->is_folded) {
            is_used = true;
            sides = sides_with_it;
        }
    }
    const int width = std::clamp(
        std::min(width_max / std::max(1, sides), window_.width() / kDockShareOfWidthAlone),
        kDockWidthMin, kDockWidthMax);
    QList<QDockWidget*> docked;
    QList<int> widths;
    for (Dock* dock : by_turn) {
        dock->widget->setMaximumWidth(dock->widget->isFloating() ? QWIDGETSIZE_MAX
                                                                 : std::max(width, kDockWidthMin));
        if (isDocked(*dock->widget)) {
            docked.append(dock->widget);
            widths.append(width);
        }
    }
    window_.resizeDocks(docked, widths, Qt::Horizontal);
}

void WindowDocks::save(QSettings& settings)
{
    // A folded panel counts as open.
    const QScopedValueRollback fitting(is_fitting_, true);
    for (Dock* dock : all()) {
        fold(*dock, false);
    }
    settings.setValue(QStringLiteral("window/state"), window_.saveState(kStateVersion));
}

void WindowDocks::restore(const QSettings& settings)
{
    {
        const QScopedValueRollback fitting(is_fitting_, true); // panels are restored one by one
        window_.restoreState(settings.value(QStringLiteral("window/state")).toByteArray(),
                             kStateVersion);
    }
    fit();
}

} // namespace marsview
