#include "ui/window/window_docks.h"

#include <QAction>
#include <QApplication>
#include <QChildEvent>
#include <QDockWidget>
#include <QMainWindow>
#include <QPushButton>
#include <QScopedValueRollback>
#include <QSettings>
#include <QStyle>
#include <QTabBar>
#include <QToolButton>

#include <algorithm>
#include <array>
#include <utility>

namespace marsview {
namespace {

constexpr int kStateVersion = 3; // of saveState(); raise when docks or toolbars change meaning

constexpr int kDockShareOfWidth = 3;      // for the panels of both sides
constexpr int kDockShareOfWidthAlone = 4; // for those of one side
constexpr int kDockWidthMin = 200;
constexpr int kDockWidthAloneMin = 260; // where a third of the window is wider
constexpr int kDockWidthMax = 300;

// The control of a panel that had the focus last; the first one at first, and where that was a
// button, which a key would press at once. Null if there is none.
QWidget* focusTargetIn(const QWidget& panel)
{
    const auto can_take = [&panel](const QWidget* widget) {
        return panel.isAncestorOf(widget) && widget->isVisible() && widget->isEnabled() &&
               (widget->focusPolicy() & Qt::TabFocus) == Qt::TabFocus;
    };
    if (QWidget* last = panel.focusWidget(); last != nullptr && can_take(last) &&
                                             qobject_cast<QPushButton*>(last) == nullptr &&
                                             qobject_cast<QToolButton*>(last) == nullptr) {
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
    window_.installEventFilter(this);
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
    connect(measurements_, &QDockWidget::visibilityChanged, this,
            &WindowDocks::giveMeasurementsHeight);
    for (Dock* dock : all()) {
        connect(dock->widget, &QDockWidget::topLevelChanged, this, &WindowDocks::fit);
        connect(dock->widget, &QDockWidget::dockLocationChanged, this,
                [this, dock] { userMoved(*dock); });
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

// The window makes them when panels become tabs. F6 goes through the panels.
bool WindowDocks::eventFilter(QObject* watched, QEvent* event)
{
    if (watched == &window_ && event->type() == QEvent::ChildPolished) {
        if (auto* tabs = qobject_cast<QTabBar*>(static_cast<QChildEvent*>(event)->child())) {
            tabs->setFocusPolicy(Qt::NoFocus);
        }
    }
    return QObject::eventFilter(watched, event);
}

void WindowDocks::fold(Dock& dock, bool is_folded)
{
    if (dock.is_folded != is_folded) {
        dock.is_folded = is_folded;
        dock.widget->setVisible(!is_folded);
    }
}

Qt::DockWidgetArea WindowDocks::homeOf(const Dock& dock) const
{
    return dock.left_side.value_or(window_.dockWidgetArea(dock.widget));
}

// As a tab of the panels that are there.
void WindowDocks::moveTo(Dock& dock, Qt::DockWidgetArea side)
{
    const Qt::DockWidgetArea home = homeOf(dock);
    const bool is_visible = dock.widget->isVisibleTo(&window_);
    const std::array<Dock*, 4> docks = all();
    const auto other = std::find_if(docks.begin(), docks.end(), [&](const Dock* each) {
        return each != &dock && window_.dockWidgetArea(each->widget) == side &&
               !each->widget->isFloating();
    });
    if (other != docks.end()) {
        window_.tabifyDockWidget((*other)->widget, dock.widget);
    } else {
        window_.addDockWidget(side, dock.widget);
    }
    dock.widget->setVisible(is_visible);
    dock.left_side = side == home ? std::nullopt : std::optional(home);
}

void WindowDocks::gather(const Dock& host, Qt::DockWidgetArea side)
{
    bool is_moved = false;
    for (Dock* dock : all()) {
        if (!dock->widget->isFloating() && window_.dockWidgetArea(dock->widget) != side) {
            moveTo(*dock, side);
            is_moved = true;
        }
    }
    if (is_moved) { // otherwise the user has chosen the tab
        host.widget->raise();
    }
}

void WindowDocks::moveHome()
{
    for (Dock* dock : all()) {
        if (dock->left_side) {
            moveTo(*dock, *dock->left_side);
        }
    }
}

void WindowDocks::userMoved(Dock& dock)
{
    if (!is_fitting_) {
        dock.left_side.reset();
        fit();
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
    Dock& latest = *by_turn.front();
    const auto is_open = [](const Dock* dock) {
        return isDocked(*dock->widget) || dock->is_folded;
    };
    // What the user asked for last stays, even in a very narrow window.
    const bool is_asked_for = latest.turn > 1 && is_open(&latest);
    const bool has_room = kDockWidthMin <= width_max;
    for (Dock* dock : by_turn) {
        if (is_open(dock)) {
            fold(*dock, !has_room && !(is_asked_for && dock == &latest));
        }
    }
    const auto host = std::find_if(by_turn.begin(), by_turn.end(), [](const Dock* dock) {
        return isDocked(*dock->widget); // the latest panel that is open
    });
    if (host == by_turn.end()) {
        return;
    }
    const Qt::DockWidgetArea side = homeOf(**host);
    int sides = 1;
    for (const Dock* dock : by_turn) {
        if (isDocked(*dock->widget) && homeOf(*dock) != side) {
            sides = 2;
        }
    }
    if (sides == 2 && 2 * kDockWidthMin > width_max) {
        sides = 1;
        gather(**host, side);
    } else {
        moveHome();
    }
    const int width_alone = std::max(window_.width() / kDockShareOfWidthAlone, kDockWidthAloneMin);
    const int width =
        std::clamp(std::min(width_max / sides, width_alone), kDockWidthMin, kDockWidthMax);
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
    // A folded panel counts as open, on its own side.
    const QScopedValueRollback fitting(is_fitting_, true);
    for (Dock* dock : all()) {
        fold(*dock, false);
    }
    moveHome();
    settings.setValue(QStringLiteral("window/state"), window_.saveState(kStateVersion));
}

void WindowDocks::restore(const QSettings& settings)
{
    {
        const QScopedValueRollback fitting(is_fitting_, true); // panels are restored one by one
        moveHome();
        has_height_ = settings.contains(QStringLiteral("window/state"));
        window_.restoreState(settings.value(QStringLiteral("window/state")).toByteArray(),
                             kStateVersion);
        for (QDockWidget* dock : {measurements_, annotations_}) {
            if (dock->isVisibleTo(&window_)) {
                dock->hide();
                held_back_.append(dock);
            }
        }
    }
    fit();
}

void WindowDocks::showRestored(QDockWidget& dock)
{
    if (held_back_.removeOne(&dock)) {
        dock.show();
    }
}

// By itself, the layout gives it the least that it can do with, in which a profile is flat.
void WindowDocks::giveMeasurementsHeight(bool is_visible)
{
    if (is_visible && !std::exchange(has_height_, true)) {
        const int height_max = window_.height() * 36 / 100;
        window_.resizeDocks({measurements_},
                            {std::min(measurements_->sizeHint().height(), height_max)},
                            Qt::Vertical);
    }
}

void WindowDocks::showForTool(QDockWidget& dock)
{
    if (dock.isHidden()) {
        for_tool_.append(&dock);
    }
    dock.show();
    dock.raise();
}

void WindowDocks::hideForTool(QDockWidget& dock)
{
    if (for_tool_.removeAll(&dock) > 0) {
        dock.hide();
    }
}

} // namespace marsview
