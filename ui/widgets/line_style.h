// A style of Qt with icons that can be read in light and dark themes.
#pragma once

#include <QProxyStyle>

namespace marsview {

/// Draws the glyphs of a style that are black pictures, such as the buttons that close a panel, as
/// line icons in the color of the palette's text.
class LineStyle final : public QProxyStyle {
    Q_OBJECT

public:
    /// `base` is a name of QStyleFactory.
    explicit LineStyle(const QString& base = QStringLiteral("Fusion"));

    QIcon standardIcon(StandardPixmap which,
                       const QStyleOption* option = nullptr,
                       const QWidget* widget = nullptr) const override;
    /// The icon of a menu entry that is highlighted has the color of its text. Checked ones have a
    /// frame of their own.
    void drawControl(ControlElement element,
                     const QStyleOption* option,
                     QPainter* painter,
                     const QWidget* widget = nullptr) const override;
    /// Buttons of dialogs have texts alone: the pictures for them are black.
    int styleHint(StyleHint hint,
                  const QStyleOption* option = nullptr,
                  const QWidget* widget = nullptr,
                  QStyleHintReturn* data = nullptr) const override;
};

} // namespace marsview
