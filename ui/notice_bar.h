// What is to be told about the map, over its upper edge.
#pragma once

#include <QFrame>
#include <QStringList>

class QLabel;
class QToolButton;

namespace marsview {

/// Hidden while there is nothing to tell, and after it was closed. As high as its text takes.
class NoticeBar final : public QFrame {
    Q_OBJECT

public:
    explicit NoticeBar(QWidget* parent = nullptr);

    /// `action` is what can be done about the first of them, on a button; empty for nothing.
    void setNotices(const QStringList& notices, const QString& action = {});

    /// How much of the map it covers: 0 while hidden.
    int coveredHeight() const;

Q_SIGNALS:
    /// coveredHeight() is another.
    void coverChanged();
    void actionRequested();
    void detailsRequested();

protected:
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

private:
    QLabel* text_ = nullptr;
    QToolButton* action_ = nullptr;
};

} // namespace marsview
