// A line above the map for what was assumed or corrected while opening it.
#pragma once

#include <QFrame>
#include <QStringList>

class QLabel;

namespace marsview {

/// Hidden while there is nothing to tell, and after it was closed.
class NoticeBar final : public QFrame {
    Q_OBJECT

public:
    explicit NoticeBar(QWidget* parent = nullptr);

    void setNotices(const QStringList& notices);

Q_SIGNALS:
    void detailsRequested();

private:
    QLabel* text_ = nullptr;
};

} // namespace marsview
