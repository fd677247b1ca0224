// A window with the simulated haptic device.
#pragma once

#include "tests/ui/test_device.h"
#include "tests/ui/test_map.h"
#include "tests/ui/timeout.h"
#include "ui/controllers/haptics_controller.h"
#include "ui/main_window.h"

#include <QApplication>
#include <QSize>
#include <QTest>

#include <gtest/gtest.h>

#include <memory>

namespace marsview {

/// Base of tests that move a simulated device over a map in a window.
class HandWindowTest : public testing::Test {
protected:
    static constexpr QSize kSmall{1000, 700};
    static constexpr QSize kWithPanels{1280, 800};

    void makeWindow(const QSize& size,
                    WindowOptions::Geometry geometry = testWindowOptions().geometry)
    {
        WindowOptions options = testWindowOptions();
        options.geometry = geometry;
        options.make_drivers = testDrivers(hand_);
        window_ = std::make_unique<MainWindow>(options);
        window_->resize(size);
        window_->show();
        QApplication::setActiveWindow(window_.get()); // without a window manager
    }
    HapticsController& haptics() { return window_->haptics(); }
    TerrainView& view() { return *window_->view(); }
    /// Requires a running loop.
    LoopState state() { return haptics().loop()->state(); }
    template <typename F>
    static bool waitFor(F condition)
    {
        return QTest::qWaitFor(condition, kTimeout);
    }
    bool isConnectedSoon()
    {
        return waitFor([&] { return haptics().connection() == HapticsConnection::Connected; });
    }
    bool connectTo(const QString& uri)
    {
        haptics().connectTo(uri);
        return isConnectedSoon();
    }

    TestMaps maps_;
    std::shared_ptr<TestHand> hand_ = std::make_shared<TestHand>();
    std::unique_ptr<MainWindow> window_;
};

} // namespace marsview
