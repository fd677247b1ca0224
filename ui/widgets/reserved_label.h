// A label whose width does not follow its text.
#pragma once

#include <QLabel>

namespace marsview {

/// As wide as the longest usual text. Longer texts are elided, with the whole text as a tool tip.
/// It shrinks in a narrow window.
class ReservedLabel : public QLabel {
    Q_OBJECT

public:
    explicit ReservedLabel(const QString& longest, QWidget* parent = nullptr);

    void setLongest(const QString& longest);
    /// The tool tip while nothing is elided.
    void setHint(const QString& hint);
    /// The text is stored whole, however much of it fits.
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
    QString hint_;
};

} // namespace marsview
