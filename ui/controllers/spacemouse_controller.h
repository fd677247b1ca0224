// A SpaceMouse in the window: it moves the camera of the scene that is shown.
#pragma once

#include "haptics/drivers/spacemouse/spacemouse.h"
#include "ui/controllers/detached_jobs.h"

#include <QObject>
#include <QString>
#include <QTimer>
#include <QWidget>

#include <chrono>
#include <functional>
#include <memory>
#include <vector>

namespace marsview {

class SteeredView;

struct SpaceMouseOptions {
    const HidApi* api = nullptr; // null for hidapi's
    /// How often one is looked for while there is none and the window is in front.
    std::chrono::milliseconds look_interval{3000};
    /// What frames are timed by.
    std::function<std::chrono::steady_clock::time_point()> now = std::chrono::steady_clock::now;
};

/// A widget that a cap steers while it is shown.
struct SteeredWidget {
    QWidget& widget;
    SteeredView& view;
};

/// Opens the first SpaceMouse that is plugged in, and lets its cap move the camera of the view that
/// is shown as long as the window is in front and no dialog is in the way; the first button shows
/// the whole map. Nothing runs while the cap rests. Looking for it and opening it is done on other
/// threads. Lives in the GUI thread; must not outlive the views.
class SpaceMouseController final : public QObject {
    Q_OBJECT

public:
    /// `views` are in one window; there is at least one.
    explicit SpaceMouseController(std::vector<SteeredWidget> views,
                                  const SpaceMouseOptions& options = {},
                                  QObject* parent = nullptr);
    ~SpaceMouseController() override;

    bool isConnected() const noexcept { return mouse_ != nullptr; }
    /// The cap is not at rest, or was not a moment ago.
    bool isAwake() const noexcept { return frame_timer_.isActive(); }

Q_SIGNALS:
    void connected(const QString& name);
    void disconnected(const QString& name);

private:
    void look();
    void take(std::unique_ptr<SpaceMouse> mouse);
    void wake();
    void advance();
    void lose();
    const SteeredWidget& shown() const;
    bool isInFront() const;
    bool isHeard() const;

    std::vector<SteeredWidget> views_;
    SpaceMouseOptions options_;
    QTimer look_timer_; // runs only while there is none
    bool is_looking_ = false;
    std::unique_ptr<SpaceMouse> mouse_;
    QTimer frame_timer_; // runs only while the cap is not at rest
    std::chrono::steady_clock::time_point advanced_{};
    bool is_flying_home_ = false; // though the cap is pushed
    DetachedJobs jobs_;
};

} // namespace marsview
