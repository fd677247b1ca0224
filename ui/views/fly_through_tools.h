// Fly-throughs in the window: the dialog, what there is to fly along, the recorder.
#pragma once

#include "ui/pictures/picture_scenes.h"
#include "ui/views/fly_through_dialog.h"
#include "ui/views/fly_through_recorder.h"

#include <QObject>
#include <QPointer>
#include <QString>
#include <QTimer>

class QAction;
class QWidget;

namespace marsview {

class MeasureController;
class SessionController;

/// GUI thread; must not outlive what it is made of.
class FlyThroughTools final : public QObject {
    Q_OBJECT

public:
    struct Parts {
        QWidget& window;
        SessionController& session;
        PictureScenes scenes;
        MeasureController& measuring;
        QAction& open; // opens the dialog
    };

    explicit FlyThroughTools(const Parts& parts, QObject* parent = nullptr);
    ~FlyThroughTools() override;

    /// Opens the dialog, or brings it to the front.
    void open();
    /// Null while it is closed.
    FlyThroughDialog* dialog() const noexcept { return dialog_; }
    FlyThroughRecorder& recorder() noexcept { return recorder_; }

private:
    std::vector<FlightLine> lines() const;
    QString folder() const;

    Parts parts_;
    FlyThroughRecorder recorder_;
    QPointer<FlyThroughDialog> dialog_;
    QTimer refresh_timer_; // gathers changes
    QString folder_;       // of the last recording
};

} // namespace marsview
