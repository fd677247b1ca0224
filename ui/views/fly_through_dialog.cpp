#include "ui/views/fly_through_dialog.h"

#include "ui/text/number_text.h"
#include "ui/widgets/icons.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDir>
#include <QDoubleSpinBox>
#include <QFileDialog>
#include <QFormLayout>
#include <QGroupBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QPushButton>
#include <QScopedValueRollback>
#include <QSlider>
#include <QSpinBox>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <utility>
#include <variant>

namespace marsview {
namespace {

constexpr int kSliderSteps = 1000;
constexpr double kSecondsMax = 3600.0;
// Seconds for a change of the picture by its width.
constexpr double kCalmSeconds = 1.5;

constexpr std::array kRecordingSizes{QSize{1280, 720}, QSize{1920, 1080}, QSize{3840, 2160}};
constexpr std::array kRecordingRates{24, 25, 30, 60};

enum RecordingFormat { Video, Pictures };

QString clockText(double seconds)
{
    const int whole = static_cast<int>(std::lround(seconds));
    return QStringLiteral("%1:%2").arg(whole / 60).arg(whole % 60, 2, 10, QLatin1Char('0'));
}

} // namespace

FlyThroughDialog::FlyThroughDialog(const Parts& parts, QWidget* parent)
    : QDialog(parent)
    , parts_(parts)
    , flight_(parts.scenes)
    , source_(new QComboBox(this))
    , pace_(new QComboBox(this))
    , distance_(new QDoubleSpinBox(this))
    , tilt_(new QSpinBox(this))
    , duration_(new QDoubleSpinBox(this))
    , play_(new QToolButton(this))
    , slider_(new QSlider(Qt::Horizontal, this))
    , time_(new QLabel(this))
    , format_(new QComboBox(this))
    , size_(new QComboBox(this))
    , rate_(new QComboBox(this))
    //: In a recording
    , legend_(new QCheckBox(tr("&Legend"), this))
    //: In a recording: names of places, graticule, measurements
    , labels_(new QCheckBox(tr("L&abels and lines on the map"), this))
    , note_(new QLabel(this))
    , record_(new QPushButton(tr("&Record…"), this))
    , form_(new QFormLayout)
{
    setObjectName(QStringLiteral("flyThroughDialog"));
    setWindowTitle(tr("Fly-Through"));
    makePathRows(*form_);
    auto* player = new QHBoxLayout;
    play_->setObjectName(QStringLiteral("play"));
    play_->setFocusPolicy(Qt::StrongFocus);
    play_->setIconSize({20, 20});
    slider_->setRange(0, kSliderSteps);
    slider_->setPageStep(kSliderSteps / 20);
    slider_->setMinimumWidth(220);
    slider_->setAccessibleName(tr("Position in the fly-through"));
    player->addWidget(play_);
    player->addWidget(slider_, 1);
    player->addWidget(time_);

    auto* recording = new QGroupBox(tr("Recording"), this);
    auto* record_form = new QFormLayout(recording);
    makeRecordRows(*record_form);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
    buttons->addButton(record_, QDialogButtonBox::ActionRole);
    note_->setWordWrap(true);
    auto* layout = new QVBoxLayout(this);
    layout->addLayout(form_);
    layout->addLayout(player);
    layout->addWidget(note_);
    layout->addWidget(recording);
    layout->addWidget(buttons);
    layout->setSizeConstraint(QLayout::SetFixedSize);

    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    connect(play_, &QToolButton::clicked, this, &FlyThroughDialog::playOrPause);
    connect(slider_, &QSlider::valueChanged, this, &FlyThroughDialog::seek);
    connect(record_, &QPushButton::clicked, this, &FlyThroughDialog::chooseFile);
    connect(&flight_, &CameraFlight::moved, this, [this](double share) {
        const QScopedValueRollback filling(is_filling_, true);
        slider_->setValue(static_cast<int>(std::lround(share * kSliderSteps)));
        showState();
    });
    connect(&flight_, &CameraFlight::finished, this, &FlyThroughDialog::showState);
    connect(&flight_, &CameraFlight::interrupted, this, &FlyThroughDialog::showState);
    refresh();
}

void FlyThroughDialog::makePathRows(QFormLayout& form)
{
    source_->setObjectName(QStringLiteral("path"));
    source_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    form.addRow(tr("&Path"), source_);
    //: Speed of a fly-through
    pace_->addItem(tr("Slower at each view"), static_cast<int>(FlightPace::SlowAtViews));
    //: Speed of a fly-through
    pace_->addItem(tr("Constant"), static_cast<int>(FlightPace::Constant));
    form.addRow(tr("&Speed"), pace_);
    distance_->setDecimals(3);
    distance_->setRange(0.001, 1e7);
    distance_->setGroupSeparatorShown(true);
    distance_->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
    //: Kilometers, after a number
    distance_->setSuffix(tr(" km"));
    form.addRow(tr("&Distance"), distance_);
    tilt_->setRange(0, 85);
    tilt_->setSuffix(QStringLiteral("°"));
    tilt_->setToolTip(tr("0° looks straight down, 85° along the ground"));
    form.addRow(tr("&Tilt"), tilt_);
    duration_->setRange(1.0, kSecondsMax);
    duration_->setDecimals(1);
    //: Seconds, after a number
    duration_->setSuffix(tr(" s"));
    form.addRow(tr("D&uration"), duration_);
    connect(source_, &QComboBox::currentIndexChanged, this, [this] {
        if (!is_filling_) {
            is_duration_chosen_ = false;
            planAgain();
        }
    });
    const auto plan = [this] {
        if (!is_filling_) {
            planAgain();
        }
    };
    connect(pace_, &QComboBox::currentIndexChanged, this, plan);
    connect(distance_, &QDoubleSpinBox::valueChanged, this, plan);
    connect(tilt_, &QSpinBox::valueChanged, this, plan);
    connect(duration_, &QDoubleSpinBox::valueChanged, this, [this] {
        if (!is_filling_) {
            is_duration_chosen_ = true;
            flight_.stop();
            showState();
        }
    });
}

void FlyThroughDialog::makeRecordRows(QFormLayout& form)
{
    const bool has_video = !FlyThroughRecorder::videoProgram().isEmpty();
    format_->setObjectName(QStringLiteral("format"));
    if (has_video) {
        //: Format of a recording
        format_->addItem(tr("Video (MP4)"), Video);
    }
    //: Format of a recording
    format_->addItem(tr("Numbered pictures (PNG)"), Pictures);
    form.addRow(tr("&Format"), format_);
    if (!has_video) {
        auto* hint =
            new QLabel(tr("Videos need the program ffmpeg, which is not installed."), this);
        hint->setForegroundRole(QPalette::PlaceholderText);
        hint->setWordWrap(true);
        form.addRow(QString(), hint);
    }
    for (const QSize& size : kRecordingSizes) {
        //: Size of a picture: %1 × %2 pixels
        size_->addItem(leftToRight(tr("%1 × %2").arg(size.width()).arg(size.height())), size);
    }
    size_->setCurrentIndex(1);
    form.addRow(tr("Si&ze"), size_);
    for (const int rate : kRecordingRates) {
        //: Frames per second
        rate_->addItem(leftToRight(tr("%1 fps").arg(rate)), rate);
    }
    rate_->setCurrentIndex(2);
    form.addRow(tr("Frame rat&e"), rate_);
    legend_->setChecked(true);
    form.addRow(tr("Include"), legend_);
    form.addRow(QString(), labels_);
    connect(rate_, &QComboBox::currentIndexChanged, this, &FlyThroughDialog::showState);
    connect(format_, &QComboBox::currentIndexChanged, this, &FlyThroughDialog::showState);
}

bool FlyThroughDialog::isLine() const
{
    return source_->currentIndex() > 0;
}

std::vector<SceneCamera> FlyThroughDialog::viewCameras() const
{
    std::vector<SceneCamera> cameras;
    const Session& session = parts_.session();
    for (const SavedView& view : session.views) {
        if (const auto camera = scene().cameraFor(session, view, scene().style().exaggeration)) {
            cameras.push_back(*camera);
        }
    }
    return cameras;
}

void FlyThroughDialog::refresh()
{
    {
        const QScopedValueRollback filling(is_filling_, true);
        const QString before = source_->currentText();
        const bool was_line = isLine();
        lines_ = parts_.lines ? parts_.lines() : std::vector<FlightLine>{};
        source_->clear();
        source_->addItem(tr("Saved views"));
        for (const FlightLine& line : lines_) {
            source_->addItem(line.name);
        }
        const int known = was_line ? source_->findText(before) : -1;
        // With too few views, a line is what there is to fly along.
        source_->setCurrentIndex(known > 0                                     ? known
                                 : viewCameras().size() < 2 && !lines_.empty() ? 1
                                                                               : 0);
        if (distance_->value() <= distance_->minimum()) {
            std::visit(
                [this](const auto& camera) {
                    distance_->setValue(camera.distance_m / 1000.0);
                    tilt_->setValue(std::clamp(qRound(camera.tilt.degrees()), 30, 75));
                },
                scene().camera());
        }
    }
    planAgain();
}

void FlyThroughDialog::planAgain()
{
    flight_.stop();
    path_.reset();
    if (isLine()) {
        const FlightLine& line = lines_[static_cast<std::size_t>(source_->currentIndex() - 1)];
        const Angle field_of_view =
            std::visit([](const auto& camera) { return camera.field_of_view; }, scene().camera());
        path_ = scene().pathAlong(line.points, {.distance_m = distance_->value() * 1000.0,
                                                .tilt = Angle::degrees(tilt_->value()),
                                                .field_of_view = field_of_view});
    } else if (const auto cameras = viewCameras(); cameras.size() >= 2) {
        path_ = scene().pathThrough(cameras, static_cast<FlightPace>(pace_->currentData().toInt()));
    }
    if (path_) {
        if (!is_duration_chosen_) {
            const QScopedValueRollback filling(is_filling_, true);
            duration_->setValue(std::clamp(std::round(kCalmSeconds * path_->length()), 4.0, 300.0));
        }
    }
    showState();
}

std::optional<CameraPath> FlyThroughDialog::path() const
{
    return path_;
}

double FlyThroughDialog::share() const
{
    return static_cast<double>(slider_->value()) / kSliderSteps;
}

void FlyThroughDialog::showState()
{
    const bool is_line = isLine();
    form_->setRowVisible(pace_, !is_line);
    form_->setRowVisible(distance_, is_line);
    form_->setRowVisible(tilt_, is_line);
    const bool is_playing = flight_.isPlaying();
    play_->setIcon(lineIcon(is_playing ? QStringLiteral("pause") : QStringLiteral("play")));
    play_->setAccessibleName(is_playing ? tr("Pause") : tr("Play"));
    play_->setToolTip(is_playing ? tr("Pause") : tr("Play from here"));
    play_->setEnabled(path_.has_value());
    slider_->setEnabled(path_.has_value());
    record_->setEnabled(path_.has_value());
    //: Of a fly-through: %1 is the time that has passed, %2 all of it
    time_->setText(
        tr("%1 / %2").arg(clockText(share() * duration_->value()), clockText(duration_->value())));
    if (!path_) {
        note_->setText(
            tr("Save at least two views of this map with Ctrl+B, or measure a distance "
               "or a profile to fly along."));
    } else {
        note_->setText(
            tr("%1 pictures")
                .arg(countText(static_cast<std::size_t>(recordingOptions().frame_count))));
    }
}

RecordingOptions FlyThroughDialog::recordingOptions() const
{
    RecordingOptions options;
    options.size = size_->currentData().toSize();
    options.frames_per_s = rate_->currentData().toInt();
    options.frame_count =
        std::max(2, static_cast<int>(std::lround(duration_->value() * options.frames_per_s)));
    options.has_legend = legend_->isChecked();
    options.has_labels = labels_->isChecked();
    return options;
}

void FlyThroughDialog::playOrPause()
{
    if (flight_.isPlaying()) {
        flight_.stop();
    } else if (path_) {
        const double from = slider_->value() < kSliderSteps ? share() : 0.0;
        flight_.play(*path_, std::chrono::milliseconds(std::lround(1000.0 * duration_->value())),
                     from);
    }
    showState();
}

void FlyThroughDialog::seek(int value)
{
    if (is_filling_ || !path_) {
        return;
    }
    flight_.stop();
    PictureScene& flown = parts_.scenes.of(*path_);
    flown.setCamera(flown.cameraOn(*path_, static_cast<double>(value) / kSliderSteps));
    showState();
}

void FlyThroughDialog::chooseFile()
{
    flight_.stop();
    const bool is_video = format_->currentData().toInt() == Video;
    auto* dialog = new QFileDialog(this, tr("Record Fly-Through"),
                                   parts_.folder ? parts_.folder() : QDir::homePath());
    dialog->setObjectName(QStringLiteral("recordDialog"));
    dialog->setAcceptMode(QFileDialog::AcceptSave);
    dialog->setNameFilter(is_video ? tr("MP4 video (*.mp4)") : tr("PNG pictures (*.png)"));
    dialog->setDefaultSuffix(is_video ? QStringLiteral("mp4") : QStringLiteral("png"));
    //: The name of a recording's file, without its extension
    dialog->selectFile(tr("fly-through") +
                       (is_video ? QStringLiteral(".mp4") : QStringLiteral(".png")));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& file) {
        if (path_) {
            Q_EMIT recordRequested(*path_, file, recordingOptions());
        }
    });
    dialog->open();
    showState();
}

void FlyThroughDialog::hideEvent(QHideEvent* event)
{
    QDialog::hideEvent(event);
    flight_.stop();
    showState();
}

} // namespace marsview
