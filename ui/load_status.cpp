#include "ui/load_status.h"

#include "ui/controllers/session_controller.h"
#include "ui/text/number_text.h"

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
        if (is_loading_) {
            Q_EMIT cancelRequested();
        } else {
            Q_EMIT stopPreparingRequested();
        }
    });
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(label_);
    layout->addWidget(bar_);
    layout->addWidget(cancel_);
    showWhatGoesOn();
}

void LoadStatus::showReport(const LoadReport& report)
{
    is_loading_ = true;
    showWhatGoesOn();
    const QString file = isolated(QFileInfo(report.file).fileName());
    QString text;
    if (report.count > 1) {
        //: %1 is a file, %2 which one it is of %3 files
        text = tr("%1 (%2 of %3)").arg(file).arg(report.position).arg(report.count);
    } else {
        //: In the status bar: %1 is a file
        text = tr("Reading %1").arg(file);
    }
    label_->setToolTip(report.file);
    label_->setText(label_->fontMetrics().elidedText(text, Qt::ElideMiddle, kLabelWidth));
    bar_->setValue(static_cast<int>(std::lround(report.fraction * 100.0)));
}

void LoadStatus::endLoading()
{
    is_loading_ = false;
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
    preparing_text_ = sentence.arg(
        isolated(metrics.elidedText(QFileInfo(path).fileName(), Qt::ElideMiddle, room)), rest);
    preparing_tip_ = path;
    if (progress.waiting_count > 0) {
        //: Tool tip: %1 is a file, %n the number of maps whose turn is after it
        preparing_tip_ = tr("%1\n%n more waiting", nullptr, progress.waiting_count).arg(path);
    }
    preparing_fraction_ = progress.fraction;
    showWhatGoesOn();
}

void LoadStatus::endPreparing()
{
    is_preparing_ = false;
    showWhatGoesOn();
}

void LoadStatus::showWhatGoesOn()
{
    setVisible(is_loading_ || is_preparing_);
    const bool is_loading = is_loading_ || !is_preparing_;
    // As wide for every file.
    label_->setFixedWidth(is_loading ? kLabelWidth : kPreparingLabelWidth);
    bar_->setFixedWidth(is_loading ? kBarWidth : kPreparingBarWidth);
    bar_->setTextVisible(is_loading);
    cancel_->setAccessibleName(is_loading ? tr("Cancel Loading") : tr("Stop Building"));
    cancel_->setToolTip(is_loading ? tr("Cancel loading (Esc)")
                                   : tr("Stop building overviews; it can be resumed later"));
    if (!is_loading) {
        label_->setText(preparing_text_);
        label_->setToolTip(preparing_tip_);
        bar_->setValue(static_cast<int>(std::lround(preparing_fraction_ * 100.0)));
    }
}

} // namespace marsview
