// A line above the map for what was assumed or corrected while opening it.
#pragma once

#include <QFrame>
#include <QStringList>

class QLabel;
class QToolButton;

namespace marsview {

/// Hidden while there is nothing to tell, and after it was closed.
class NoticeBar final : public QFrame {
    Q_OBJECT

public:
    explicit NoticeBar(QWidget* parent = nullptr);

    /// `action` is what can be done about the first of them, on a button; empty for nothing.
    void setNotices(const QStringList& notices, const QString& action = {});

Q_SIGNALS:
    void actionRequested();
    void detailsRequested();

private:
    QLabel* text_ = nullptr;
    QToolButton* action_ = nullptr;
};

} // namespace marsview
