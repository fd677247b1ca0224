#include "ui/widgets/reserved_label.h"

#include <QStyle>

#include <algorithm>

namespace marsview {

ReservedLabel::ReservedLabel(const QString& longest, QWidget* parent)
    : QLabel(parent)
    , longest_(longest)
{
    setTextFormat(Qt::PlainText);
    // By the layout: a number alone has no direction, and would be put to the left in any layout.
    setAlignment(QStyle::visualAlignment(layoutDirection(), Qt::AlignLeft) | Qt::AlignAbsolute |
                 Qt::AlignVCenter);
    setTextInteractionFlags(Qt::TextSelectableByMouse);
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Preferred);
}

void ReservedLabel::setLongest(const QString& longest)
{
    if (longest != longest_) {
        longest_ = longest;
        updateGeometry();
    }
}

void ReservedLabel::setHint(const QString& hint)
{
    hint_ = hint;
    elide();
}

void ReservedLabel::setWholeText(const QString& text)
{
    whole_ = text;
    elide();
}

QSize ReservedLabel::sizeHint() const
{
    const QMargins margins = contentsMargins();
    return {fontMetrics().horizontalAdvance(longest_) + margins.left() + margins.right() + 4,
            QLabel::minimumSizeHint().height()};
}

QSize ReservedLabel::minimumSizeHint() const
{
    return {std::min(sizeHint().width(), fontMetrics().horizontalAdvance(QLatin1Char('0')) * 8),
            QLabel::minimumSizeHint().height()};
}

void ReservedLabel::resizeEvent(QResizeEvent* event)
{
    QLabel::resizeEvent(event);
    elide();
}

void ReservedLabel::elide()
{
    const QString shown =
        fontMetrics().elidedText(whole_, Qt::ElideRight, std::max(0, contentsRect().width()));
    setText(shown);
    setToolTip(shown == whole_ ? hint_ : whole_);
}

} // namespace marsview
