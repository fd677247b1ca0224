// A label whose width does not follow its text.
#pragma once

#include <QLabel>

namespace marsview {

/// Wants the width of a text that is as long as any that is usual, and cuts short what is longer.
/// Gives way where there is no room.
class ReservedLabel final : public QLabel {
    Q_OBJECT

public:
    explicit ReservedLabel(const QString& longest, QWidget* parent = nullptr);

    void setLongest(const QString& longest);
    /// Whole, whatever is to be seen of it.
    void setWholeText(const QString& text);
    const QString& wholeText() const noexcept { return whole_; }

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    void elide();

    QString longest_;
    QString whole_;
};

} // namespace marsview
