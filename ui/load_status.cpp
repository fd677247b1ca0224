#include "ui/load_status.h"

#include "ui/session_controller.h"

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

} // namespace

LoadStatus::LoadStatus(QWidget* parent)
    : QWidget(parent)
    , label_(new QLabel(this))
    , bar_(new QProgressBar(this))
{
    label_->setAccessibleName(tr("What is loading"));
    // As wide for every file and stage.
    label_->setFixedWidth(kLabelWidth);
    label_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    bar_->setAccessibleName(tr("Progress of loading"));
    bar_->setRange(0, 100);
    bar_->setFixedWidth(kBarWidth);
    auto* cancel = new QToolButton(this);
    cancel->setObjectName(QStringLiteral("cancelLoading"));
    cancel->setText(QStringLiteral("✕"));
    cancel->setAutoRaise(true);
    cancel->setAccessibleName(tr("Cancel Loading"));
    cancel->setToolTip(tr("Cancel loading (Esc)"));
    connect(cancel, &QToolButton::clicked, this, &LoadStatus::cancelRequested);
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(label_);
    layout->addWidget(bar_);
    layout->addWidget(cancel);
    hide();
}

void LoadStatus::showReport(const LoadReport& report)
{
    const QString file = QFileInfo(report.file).fileName();
    QString text;
    if (report.count > 1) {
        //: %1 is a file, %2 which one it is of %3 files
        text = tr("%1 (%2 of %3)").arg(file).arg(report.position).arg(report.count);
    } else {
        //: In the status bar: %1 is a file
        text = report.progress.stage == LoadStage::Reading ? tr("Reading %1") : tr("Preparing %1");
        text = text.arg(file);
    }
    label_->setToolTip(report.file);
    label_->setText(label_->fontMetrics().elidedText(text, Qt::ElideMiddle, kLabelWidth));
    bar_->setValue(static_cast<int>(std::lround(report.progress.fraction * 100.0)));
    show();
}

} // namespace marsview
