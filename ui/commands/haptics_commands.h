// The commands on haptic devices: the Haptics menu, and what later windows know of the device.
#pragma once

#include "haptics/device/crash_marker.h"

#include <QObject>

#include <optional>

namespace marsview {

class HapticsController;
class HapticsPanel;
class SessionController;
class WindowDocks;
class WindowMessages;
struct WindowActions;

/// Remembers the settings and, so that a driver that ends the program does not do so at every
/// start, whether a device is connected. GUI thread; must not outlive its parts.
class HapticsCommands final : public QObject {
    Q_OBJECT

public:
    struct Parts {
        const WindowActions& actions;
        const SessionController& session;
        HapticsController& haptics;
        HapticsPanel& panel;
        WindowDocks& docks;
        WindowMessages& messages;
        bool is_remembered = false; // settings and device, for later windows
    };

    explicit HapticsCommands(const Parts& parts);
    ~HapticsCommands() override;

    enum class LastDevice { Connect, Leave };

    /// Connects to the device of the settings, unless it is a simulated one, or the program ended
    /// while one was connected.
    void connectToRemembered(LastDevice last);
    /// Lets go of the device.
    void close();

Q_SIGNALS:
    /// The state of the device, of a recording or of the emergency stop.
    void changed();

private:
    void connectRecorder();
    void connectActions();
    void showState();
    void markConnection();

    Parts parts_;
    std::optional<CrashMarker> connection_marker_; // while a device is connected
};

} // namespace marsview
