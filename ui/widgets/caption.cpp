#include "ui/widgets/caption.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QStyle>

namespace marsview {

QFont captionFont(QFont font)
{
    constexpr double kSize = 0.88;
    font.setPointSizeF(font.pointSizeF() * kSize);
    return font;
}

QLabel* makeCaption(const QString& text, QWidget* parent)
{
    auto* caption = new QLabel(text, parent);
    caption->setForegroundRole(QPalette::PlaceholderText);
    caption->setFont(captionFont(caption->font()));
    // By the layout: Qt goes by the letters of the text, which may be of another language.
    caption->setAlignment(QStyle::visualAlignment(caption->layoutDirection(), Qt::AlignLeft) |
                          Qt::AlignAbsolute | Qt::AlignVCenter);
    return caption;
}

QHBoxLayout* makeCaptionLine(QLabel* caption, QLabel* value)
{
    auto* line = new QHBoxLayout;
    line->addWidget(caption);
    line->addWidget(value, 1);
    value->setAlignment(Qt::AlignTrailing | Qt::AlignVCenter);
    return line;
}

} // namespace marsview
