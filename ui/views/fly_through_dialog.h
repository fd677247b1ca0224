// Planning, playing and recording a fly-through.
#pragma once

#include "core/flight/camera_path.h"
#include "core/session/session.h"
#include "ui/pictures/picture_scenes.h"
#include "ui/views/camera_flight.h"
#include "ui/views/fly_through_recorder.h"

#include <QDialog>
#include <QString>

#include <functional>
#include <optional>
#include <vector>

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QLabel;
class QPushButton;
class QSlider;
class QSpinBox;
class QToolButton;

namespace marsview {

/// A line that can be flown along.
struct FlightLine {
    QString name;
    std::vector<ScenePoint> points; // as they lie on the terrain; at least two
};

/// Plays in the scene that is shown while it is open; what it asks to record is the path that it
/// would play. Not modal: the map can be moved between two flights. GUI thread; outlived by what it
/// is made of.
class FlyThroughDialog final : public QDialog {
    Q_OBJECT

public:
    struct Parts {
        PictureScenes scenes;
        std::function<const Session&()> session;
        std::function<std::vector<FlightLine>()> lines;
        std::function<QString()> folder; // where recordings go first
    };

    explicit FlyThroughDialog(const Parts& parts, QWidget* parent = nullptr);

    /// The session, the lines or the layers shown may have changed.
    void refresh();
    /// The path that is chosen; empty with fewer than two views that the picture can show.
    std::optional<CameraPath> path() const;
    RecordingOptions recordingOptions() const;

    CameraFlight& flight() noexcept { return flight_; }
    QComboBox* source() const noexcept { return source_; }
    QToolButton* playButton() const noexcept { return play_; }
    QSlider* slider() const noexcept { return slider_; }
    QDoubleSpinBox* duration() const noexcept { return duration_; }
    QComboBox* pace() const noexcept { return pace_; }
    QComboBox* format() const noexcept { return format_; }
    QPushButton* recordButton() const noexcept { return record_; }

Q_SIGNALS:
    /// A file was chosen.
    void
    recordRequested(const CameraPath& path, const QString& file, const RecordingOptions& options);

protected:
    void hideEvent(QHideEvent* event) override;

private:
    void makePathRows(QFormLayout& form);
    void makeRecordRows(QFormLayout& form);
    bool isLine() const;
    PictureScene& scene() const { return parts_.scenes.shown(); }
    std::vector<SceneCamera> viewCameras() const;
    void planAgain();
    void showState();
    void playOrPause();
    void seek(int value);
    void chooseFile();
    double share() const;

    Parts parts_;
    CameraFlight flight_;
    std::vector<FlightLine> lines_;
    std::optional<CameraPath> path_;
    bool is_duration_chosen_ = false; // by the user
    bool is_filling_ = false;
    QComboBox* source_ = nullptr;
    QComboBox* pace_ = nullptr;
    QDoubleSpinBox* distance_ = nullptr;
    QSpinBox* tilt_ = nullptr;
    QDoubleSpinBox* duration_ = nullptr;
    QToolButton* play_ = nullptr;
    QSlider* slider_ = nullptr;
    QLabel* time_ = nullptr;
    QComboBox* format_ = nullptr;
    QComboBox* size_ = nullptr;
    QComboBox* rate_ = nullptr;
    QCheckBox* legend_ = nullptr;
    QCheckBox* labels_ = nullptr;
    QLabel* note_ = nullptr;
    QPushButton* record_ = nullptr;
    QFormLayout* form_ = nullptr;
};

} // namespace marsview
