// The bar over the upper edge of the map that shows notices, one at a time.
#pragma once

#include "ui/widgets/notice.h"

#include <QFrame>

class QLabel;
class QMenu;
class QToolButton;

namespace marsview {

/// Hidden without notices. As high as the text of the notice that is shown.
class NoticeBar final : public QFrame {
    Q_OBJECT

public:
    explicit NoticeBar(QWidget* parent = nullptr);

    /// Shows the first, and the others on request. The one that is shown stays if it is still among
    /// them and the first is the same as before.
    void setNotices(const QList<Notice>& notices);

    /// How much of the map it covers: 0 while hidden.
    int coveredHeight() const;

Q_SIGNALS:
    /// coveredHeight() changed.
    void coverChanged();
    /// `action` is an index of the notice's actions.
    void actionRequested(const QString& id, int action);
    void detailsRequested(const QString& id);
    void closeRequested(const QString& id);

protected:
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

private:
    void showNotice(int index);

    QList<Notice> notices_;
    int shown_ = 0; // index of the notice that is shown
    QLabel* text_ = nullptr;
    QToolButton* action_ = nullptr;
    QMenu* action_menu_ = nullptr;
    QToolButton* details_ = nullptr;
    QToolButton* next_ = nullptr;
};

} // namespace marsview
