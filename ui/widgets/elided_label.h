// One line of text that is elided in the middle if it does not fit.
#pragma once

#include <QLabel>

namespace marsview {

/// Its text() is the whole text, which the tool tip shows too. Aligned as a QLabel is. Takes the
/// focus; Ctrl+C and the context menu copy the whole text.
class ElidedLabel final : public QLabel {
    Q_OBJECT

public:
    explicit ElidedLabel(const QString& text, QWidget* parent = nullptr);

    QSize sizeHint() const override;
    QSize minimumSizeHint() const override;

protected:
    void paintEvent(QPaintEvent* event) override;

private:
    void copy() const;
};

} // namespace marsview
