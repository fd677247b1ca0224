// A window for tests, with maps to open in it.
#pragma once

#include "tests/ui/test_map.h"
#include "tests/ui/timeout.h"
#include "ui/canvas/terrain_view.h"
#include "ui/main_window.h"

#include <QApplication>
#include <QEvent>
#include <QPointF>
#include <QSize>
#include <QTest>

#include <gtest/gtest.h>

#include <memory>

namespace marsview {

/// Base of tests that work in a window with a map.
class MapWindowTest : public testing::Test {
protected:
    static constexpr QSize kSmall{820, 600};
    static constexpr QSize kWithPanels{1100, 700};

    void makeWindow(const QSize& size, const WindowOptions& options = testWindowOptions())
    {
        window_ = std::make_unique<MainWindow>(options);
        window_->resize(size);
        window_->show();
        QApplication::setActiveWindow(window_.get()); // there is no window manager
    }
    /// The map gets the keyboard focus.
    bool focusMap()
    {
        view().setFocus();
        return waitFor([this] { return view().hasFocus(); });
    }
    /// The pointer leaves the map.
    void leaveTheMap()
    {
        QEvent leave(QEvent::Leave);
        QApplication::sendEvent(&view(), &leave);
    }
    TerrainView& view() { return *window_->view(); }
    QPointF middle() { return QRectF(view().rect()).center(); }
    template <typename F>
    static bool waitFor(F condition)
    {
        return QTest::qWaitFor(condition, kTimeout);
    }

    TestMaps maps_;
    std::unique_ptr<MainWindow> window_;
};

} // namespace marsview
