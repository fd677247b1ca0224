#include "ui/widgets/notice_bar.h"

#include "ui/widgets/icons.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QMenu>
#include <QStyle>
#include <QToolButton>

#include <algorithm>

namespace marsview {
namespace {

// Whether two lists of notices look the same on the bar.
bool isShownAlike(const QList<Notice>& a, const QList<Notice>& b)
{
    const auto is_same_action = [](const NoticeAction& x, const NoticeAction& y) {
        return x.text == y.text;
    };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [&](const Notice& x, const Notice& y) {
                          return x.id == y.id && x.text == y.text && x.menu_text == y.menu_text &&
                                 (x.show_details != nullptr) == (y.show_details != nullptr) &&
                                 std::equal(x.actions.begin(), x.actions.end(), y.actions.begin(),
                                            y.actions.end(), is_same_action);
                      });
}

} // namespace

NoticeBar::NoticeBar(QWidget* parent)
    : QFrame(parent)
    , text_(new QLabel(this))
    , action_(new QToolButton(this))
    , action_menu_(new QMenu(action_))
    , details_(new QToolButton(this))
    , next_(new QToolButton(this))
{
    setAccessibleName(tr("Notices"));
    setFrameShape(QFrame::NoFrame);
    setAutoFillBackground(true);
    setBackgroundRole(QPalette::ToolTipBase);
    setForegroundRole(QPalette::ToolTipText);
    text_->setObjectName(QStringLiteral("noticeText"));
    text_->setForegroundRole(QPalette::ToolTipText);
    // A sentence names a file and says what to do: it wraps rather than being cut short.
    text_->setWordWrap(true);
    text_->setTextFormat(Qt::PlainText);
    text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    QSizePolicy policy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    policy.setHeightForWidth(true);
    text_->setSizePolicy(policy);
    auto* icon = new QLabel(this);
    const int side = style()->pixelMetric(QStyle::PM_SmallIconSize);
    icon->setPixmap(style()->standardIcon(QStyle::SP_MessageBoxInformation).pixmap(side, side));
    action_->setObjectName(QStringLiteral("noticeAction"));
    action_->setAccessibleName(tr("Action")); // until a notice names its own
    action_->setPopupMode(QToolButton::InstantPopup);
    action_->setFocusPolicy(Qt::TabFocus);
    details_->setObjectName(QStringLiteral("noticeDetails"));
    details_->setText(tr("Details"));
    details_->setToolTip(tr("Show where the notice comes from"));
    details_->setAutoRaise(true);
    details_->setFocusPolicy(Qt::TabFocus);
    next_->setObjectName(QStringLiteral("noticeNext"));
    next_->setToolTip(tr("Show the next notice"));
    next_->setAutoRaise(true);
    next_->setFocusPolicy(Qt::TabFocus);
    auto* close = new QToolButton(this);
    close->setObjectName(QStringLiteral("noticeClose"));
    close->setIcon(lineIcon(QStringLiteral("close")));
    close->setAutoRaise(true);
    close->setFocusPolicy(Qt::TabFocus);
    close->setAccessibleName(tr("Close Notice"));
    close->setToolTip(tr("Close this notice"));
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(8, 2, 4, 2);
    layout->addWidget(icon);
    layout->addWidget(text_, 1);
    layout->addWidget(action_);
    layout->addWidget(details_);
    layout->addWidget(next_);
    layout->addWidget(close);
    connect(action_, &QToolButton::clicked, this, [this] {
        if (action_->menu() == nullptr) {
            Q_EMIT actionRequested(notices_[shown_].id, 0);
        }
    });
    connect(details_, &QToolButton::clicked, this,
            [this] { Q_EMIT detailsRequested(notices_[shown_].id); });
    connect(next_, &QToolButton::clicked, this,
            [this] { showNotice((shown_ + 1) % static_cast<int>(notices_.size())); });
    connect(close, &QToolButton::clicked, this,
            [this] { Q_EMIT closeRequested(notices_[shown_].id); });
    hide();
}

void NoticeBar::setNotices(const QList<Notice>& notices)
{
    if (isShownAlike(notices, notices_)) {
        return;
    }
    const QString shown_id = notices_.isEmpty() ? QString() : notices_[shown_].id;
    const bool is_same_first =
        !notices.isEmpty() && !notices_.isEmpty() && notices.front().id == notices_.front().id;
    notices_ = notices;
    if (notices_.isEmpty()) {
        shown_ = 0;
        hide();
        return;
    }
    const auto shown =
        std::find_if(notices_.begin(), notices_.end(),
                     [&shown_id](const Notice& notice) { return notice.id == shown_id; });
    showNotice(is_same_first && shown != notices_.end() ? static_cast<int>(shown - notices_.begin())
                                                        : 0);
    show();
}

void NoticeBar::showNotice(int index)
{
    shown_ = index;
    const Notice& notice = notices_[index];
    text_->setText(notice.text);
    QStringList all;
    for (const Notice& each : notices_) {
        all.append(each.text);
    }
    text_->setToolTip(all.join(QLatin1Char('\n')));
    action_menu_->clear();
    const bool has_menu = notice.actions.size() > 1;
    action_->setMenu(has_menu ? action_menu_ : nullptr);
    if (has_menu) {
        for (int i = 0; i < notice.actions.size(); ++i) {
            QAction* entry = action_menu_->addAction(notice.actions[i].text);
            connect(entry, &QAction::triggered, this,
                    [this, id = notice.id, i] { Q_EMIT actionRequested(id, i); });
        }
        action_->setText(notice.menu_text);
    } else {
        action_->setText(notice.actions.isEmpty() ? QString() : notice.actions.front().text);
    }
    if (!action_->text().isEmpty()) {
        action_->setAccessibleName(action_->text());
    }
    action_->setVisible(!notice.actions.isEmpty());
    details_->setVisible(notice.show_details != nullptr);
    const QLocale locale;
    const auto count = static_cast<int>(notices_.size());
    //: On a button that shows the next notice: %1 is its number, %2 how many notices there are
    next_->setText(tr("%1 of %2 ›").arg(locale.toString(index + 1), locale.toString(count)));
    next_->setAccessibleName(tr("Next Notice"));
    next_->setVisible(count > 1);
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
