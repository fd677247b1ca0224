// A window with the simulated haptic device.
#pragma once

#include "tests/ui/map_window.h"
#include "tests/ui/test_device.h"
#include "ui/controllers/haptics/haptics_controller.h"

#include <memory>

namespace marsview {

/// Base of tests that move a simulated device over a map in a window.
class HandWindowTest : public MapWindowTest {
protected:
    void makeWindow(const QSize& size,
                    WindowOptions::Geometry geometry = testWindowOptions().geometry)
    {
        WindowOptions options = testWindowOptions();
        options.geometry = geometry;
        options.make_drivers = testDrivers(hand_);
        MapWindowTest::makeWindow(size, options);
    }
    HapticsController& haptics() { return window_->haptics(); }
    DeviceSession& device() { return haptics().device(); }
    /// Requires a running loop.
    LoopState state() { return device().loop()->state(); }
    bool isConnectedSoon()
    {
        return waitFor([&] { return device().connection() == HapticsConnection::Connected; });
    }
    bool connectTo(const QString& uri)
    {
        device().connectTo(uri);
        return isConnectedSoon();
    }

    std::shared_ptr<TestHand> hand_ = std::make_shared<TestHand>();
};

} // namespace marsview
