#include "ui/window/load_status.h"

#include "ui/controllers/session_controller.h"
#include "ui/text/number_text.h"
#include "ui/widgets/progress_value.h"

#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QToolButton>

#include <cmath>

namespace marsview {
namespace {

constexpr int kLabelWidth = 150; // pixels
constexpr int kBarWidth = 110;
constexpr int kPreparingLabelWidth = 400;
constexpr int kPreparingBarWidth = 70;

} // namespace

LoadStatus::LoadStatus(QWidget* parent)
    : QWidget(parent)
    , label_(new QLabel(this))
    , bar_(new QProgressBar(this))
    , cancel_(new QToolButton(this))
{
    label_->setAccessibleName(tr("Loading"));
    label_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    bar_->setAccessibleName(tr("Progress of loading"));
    bar_->setRange(0, 100);
    cancel_->setObjectName(QStringLiteral("cancelLoading"));
    cancel_->setText(QStringLiteral("✕"));
    cancel_->setAutoRaise(true);
    connect(cancel_, &QToolButton::clicked, this, [this] {
        switch (work()) {
        case Work::None:
            break;
        case Work::Loading:
            Q_EMIT cancelRequested();
            break;
        case Work::Files:
            Q_EMIT cancelFileWorkRequested();
            break;
        case Work::Saving:
            Q_EMIT cancelSavingRequested();
            break;
        case Work::Preparing:
            Q_EMIT stopPreparingRequested();
            break;
        }
    });
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(label_);
    layout->addWidget(bar_);
    layout->addWidget(cancel_);
    cancel_->setAccessibleName(tr("Cancel Loading"));
    showWhatGoesOn();
}

LoadStatus::Work LoadStatus::work() const
{
    return is_loading_     ? Work::Loading
           : is_at_files_  ? Work::Files
           : is_saving_    ? Work::Saving
           : is_preparing_ ? Work::Preparing
                           : Work::None;
}

void LoadStatus::showReport(const LoadReport& report)
{
    is_loading_ = true;
    const QString file = isolated(QFileInfo(report.file).fileName());
    const QString text = report.count > 1
                             //: %1 is a file, %2 which one it is of %3 files
                             ? tr("%1 (%2 of %3)").arg(file).arg(report.position).arg(report.count)
                             //: In the status bar: %1 is a file
                             : tr("Reading %1").arg(file);
    loading_ = {.text = label_->fontMetrics().elidedText(text, Qt::ElideMiddle, kLabelWidth),
                .tip = report.file,
                .percent = static_cast<int>(std::lround(report.fraction * 100.0))};
    showWhatGoesOn();
}

void LoadStatus::endLoading()
{
    is_loading_ = false;
    showWhatGoesOn();
}

void LoadStatus::showFileWork(const QString& text, const QString& file, double share)
{
    is_at_files_ = true;
    files_ = {.text = label_->fontMetrics().elidedText(text, Qt::ElideMiddle, kLabelWidth),
              .tip = file,
              .percent = static_cast<int>(share * 100.0)};
    showWhatGoesOn();
}

void LoadStatus::endFileWork()
{
    is_at_files_ = false;
    showWhatGoesOn();
}

void LoadStatus::showSaving(const QString& file, double share)
{
    is_saving_ = true;
    const QString name = isolated(QFileInfo(file).fileName());
    const QString text = share < 1.0
                             //: In the status bar: %1 is the file of a picture
                             ? tr("Drawing %1").arg(name)
                             //: In the status bar: %1 is the file of a picture
                             : tr("Writing %1").arg(name);
    saving_ = {.text = label_->fontMetrics().elidedText(text, Qt::ElideMiddle, kLabelWidth),
               .tip = file,
               .percent = share < 1.0 ? std::optional(static_cast<int>(share * 100.0))
                                      : std::nullopt}; // nothing reports how far writing is
    showWhatGoesOn();
}

void LoadStatus::endSaving()
{
    is_saving_ = false;
    showWhatGoesOn();
}

void LoadStatus::showPreparing(const PrepareProgress& progress)
{
    is_preparing_ = true;
    const QString path = QString::fromStdString(progress.spec.path);
    // Not before it is done.
    const int percent = static_cast<int>(std::floor(progress.fraction * 100.0));
    QString rest = leftToRight(tr("%1 %").arg(percent));
    if (progress.left) {
        //: The share that is done and the time left: "37 %, 4 min left"
        rest = tr("%1, %2").arg(rest, timeLeftText(*progress.left));
    }
    //: In the status bar: %1 is a file, %2 the progress
    const QString sentence = tr("Building overviews of %1: %2");
    const QFontMetrics metrics = label_->fontMetrics();
    const int room =
        kPreparingLabelWidth - metrics.horizontalAdvance(sentence.arg(QString(), rest));
    preparing_.text = sentence.arg(
        isolated(metrics.elidedText(QFileInfo(path).fileName(), Qt::ElideMiddle, room)), rest);
    preparing_.tip = path;
    if (progress.waiting_count > 0) {
        //: Tool tip: %1 is a file, %n the number of maps whose turn is after it
        preparing_.tip = tr("%1\n%n more waiting", nullptr, progress.waiting_count).arg(path);
    }
    preparing_.percent = static_cast<int>(std::lround(progress.fraction * 100.0));
    showWhatGoesOn();
}

void LoadStatus::endPreparing()
{
    is_preparing_ = false;
    showWhatGoesOn();
}

void LoadStatus::showWhatGoesOn()
{
    const Work now = work();
    setVisible(now != Work::None);
    const bool is_preparing = now == Work::Preparing;
    // As wide for every file.
    label_->setFixedWidth(is_preparing ? kPreparingLabelWidth : kLabelWidth);
    bar_->setFixedWidth(is_preparing ? kPreparingBarWidth : kBarWidth);
    bar_->setTextVisible(!is_preparing);
    switch (now) {
    case Work::None:
        break;
    case Work::Loading:
        cancel_->setAccessibleName(tr("Cancel Loading"));
        cancel_->setToolTip(tr("Cancel loading (Esc)"));
        showProgress(loading_);
        break;
    case Work::Files:
        cancel_->setAccessibleName(tr("Cancel"));
        cancel_->setToolTip(tr("Cancel (Esc)"));
        showProgress(files_);
        break;
    case Work::Saving:
        cancel_->setAccessibleName(tr("Cancel Saving"));
        cancel_->setToolTip(tr("Cancel saving the picture (Esc)"));
        showProgress(saving_);
        break;
    case Work::Preparing:
        cancel_->setAccessibleName(tr("Stop Building"));
        cancel_->setToolTip(tr("Stop building overviews; it can be resumed later"));
        showProgress(preparing_);
        break;
    }
}

void LoadStatus::showProgress(const Shown& shown)
{
    label_->setText(shown.text);
    label_->setToolTip(shown.tip);
    bar_->setRange(0, shown.percent ? 100 : 0); // busy without a percentage
    showValue(*bar_, shown.percent.value_or(0));
}

} // namespace marsview
