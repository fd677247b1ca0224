#include "ui/notice_bar.h"

#include "ui/icons.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QStyle>
#include <QToolButton>

namespace marsview {

NoticeBar::NoticeBar(QWidget* parent)
    : QFrame(parent)
    , text_(new QLabel(this))
    , action_(new QToolButton(this))
{
    setAccessibleName(tr("Notices about the map"));
    setFrameShape(QFrame::NoFrame);
    setAutoFillBackground(true);
    setBackgroundRole(QPalette::ToolTipBase);
    setForegroundRole(QPalette::ToolTipText);
    text_->setObjectName(QStringLiteral("noticeText"));
    text_->setForegroundRole(QPalette::ToolTipText);
    // A failure's sentence names a file and says what to do: it is read whole, not cut short.
    text_->setWordWrap(true);
    text_->setTextFormat(Qt::PlainText);
    QSizePolicy policy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    policy.setHeightForWidth(true);
    text_->setSizePolicy(policy);
    auto* icon = new QLabel(this);
    const int side = style()->pixelMetric(QStyle::PM_SmallIconSize);
    icon->setPixmap(style()->standardIcon(QStyle::SP_MessageBoxInformation).pixmap(side, side));
    action_->setObjectName(QStringLiteral("noticeAction"));
    action_->setAccessibleName(tr("What can be done about the notice"));
    auto* details = new QToolButton(this);
    details->setText(tr("Details"));
    details->setAutoRaise(true);
    auto* close = new QToolButton(this);
    close->setIcon(lineIcon(QStringLiteral("close")));
    close->setAutoRaise(true);
    close->setAccessibleName(tr("Close Notices"));
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(8, 2, 4, 2);
    layout->addWidget(icon);
    layout->addWidget(text_, 1);
    layout->addWidget(action_);
    layout->addWidget(details);
    layout->addWidget(close);
    connect(action_, &QToolButton::clicked, this, &NoticeBar::actionRequested);
    connect(details, &QToolButton::clicked, this, &NoticeBar::detailsRequested);
    connect(close, &QToolButton::clicked, this, &QWidget::hide);
    hide();
}

void NoticeBar::setNotices(const QStringList& notices, const QString& action)
{
    action_->setText(action);
    action_->setVisible(!action.isEmpty());
    if (!action.isEmpty()) {
        action_->setAccessibleName(action);
    }
    if (notices.isEmpty()) {
        hide();
        return;
    }
    const int more = static_cast<int>(notices.size()) - 1;
    text_->setText(more == 0 ? notices.front()
                             //: %1 is a sentence about the map, %n how many further ones there are
                             : tr("%1 (and %n more)", nullptr, more).arg(notices.front()));
    text_->setToolTip(notices.join(QLatin1Char('\n')));
    show();
}

int NoticeBar::coveredHeight() const
{
    return isHidden() ? 0 : height();
}

void NoticeBar::showEvent(QShowEvent* event)
{
    QFrame::showEvent(event);
    Q_EMIT coverChanged();
}

void NoticeBar::hideEvent(QHideEvent* event)
{
    QFrame::hideEvent(event);
    Q_EMIT coverChanged();
}

void NoticeBar::resizeEvent(QResizeEvent* event)
{
    QFrame::resizeEvent(event);
    Q_EMIT coverChanged();
}

} // namespace marsview
