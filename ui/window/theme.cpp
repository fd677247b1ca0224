#include "ui/window/theme.h"

#include "ui/widgets/line_style.h"

#include <QApplication>
#include <QStyle>
#include <QToolTip>

namespace marsview {
namespace {

struct Colors {
    QColor window;
    QColor base;
    QColor alternate;
    QColor button;
    QColor text;
    QColor disabled;
    QColor placeholder;
    QColor accent;
    QColor accent_text;
    QColor link;
    QColor tip;
    QColor tip_text;
    // The edges of Fusion's frames, from light to dark.
    QColor light;
    QColor midlight;
    QColor mid;
    QColor dark;
    QColor shadow;
};

QPalette paletteFrom(const Colors& c)
{
    QPalette palette;
    palette.setColor(QPalette::Window, c.window);
    palette.setColor(QPalette::Base, c.base);
    palette.setColor(QPalette::AlternateBase, c.alternate);
    palette.setColor(QPalette::Button, c.button);
    for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText}) {
        palette.setColor(role, c.text);
        palette.setColor(QPalette::Disabled, role, c.disabled);
    }
    palette.setColor(QPalette::BrightText, QColor(255, 120, 100));
    palette.setColor(QPalette::PlaceholderText, c.placeholder);
    palette.setColor(QPalette::Highlight, c.accent);
    palette.setColor(QPalette::HighlightedText, c.accent_text);
    palette.setColor(QPalette::Disabled, QPalette::Highlight, c.mid);
    palette.setColor(QPalette::Disabled, QPalette::HighlightedText, c.text);
    palette.setColor(QPalette::Link, c.link);
    palette.setColor(QPalette::LinkVisited, c.link);
    palette.setColor(QPalette::ToolTipBase, c.tip);
    palette.setColor(QPalette::ToolTipText, c.tip_text);
    palette.setColor(QPalette::Light, c.light);
    palette.setColor(QPalette::Midlight, c.midlight);
    palette.setColor(QPalette::Mid, c.mid);
    palette.setColor(QPalette::Dark, c.dark);
    palette.setColor(QPalette::Shadow, c.shadow);
    return palette;
}

bool isDark(const QPalette& palette)
{
    return palette.color(QPalette::Window).lightness() <
           palette.color(QPalette::WindowText).lightness();
}

} // namespace

QPalette lightPalette()
{
    return paletteFrom({.window = QColor(241, 241, 239),
                        .base = QColor(255, 255, 255),
                        .alternate = QColor(246, 246, 244),
                        .button = QColor(235, 235, 233),
                        .text = QColor(32, 33, 36),
                        .disabled = QColor(124, 125, 128),
                        .placeholder = QColor(108, 109, 112),
                        .accent = QColor(176, 74, 38),
                        .accent_text = QColor(255, 255, 255),
                        .link = QColor(150, 58, 28),
                        .tip = QColor(255, 248, 226),
                        .tip_text = QColor(32, 33, 36),
                        .light = QColor(255, 255, 255),
                        .midlight = QColor(248, 248, 246),
                        .mid = QColor(196, 196, 194),
                        .dark = QColor(160, 160, 158),
                        .shadow = QColor(112, 112, 110)});
}

QPalette darkPalette()
{
    return paletteFrom({.window = QColor(37, 38, 42),
                        .base = QColor(27, 28, 31),
                        .alternate = QColor(33, 34, 38),
                        .button = QColor(52, 54, 59),
                        .text = QColor(228, 228, 226),
                        .disabled = QColor(136, 138, 142),
                        .placeholder = QColor(150, 152, 156),
                        .accent = QColor(200, 92, 52),
                        .accent_text = QColor(255, 255, 255),
                        .link = QColor(240, 150, 110),
                        .tip = QColor(66, 60, 46),
                        .tip_text = QColor(240, 236, 224),
                        .light = QColor(78, 80, 86),
                        .midlight = QColor(64, 66, 71),
                        .mid = QColor(72, 74, 80),
                        .dark = QColor(22, 23, 25),
                        .shadow = QColor(10, 10, 12)});
}

void useLineStyle()
{
    if (qobject_cast<LineStyle*>(QApplication::style()) == nullptr) {
        QApplication::setStyle(new LineStyle);
    }
}

void applyTheme(Theme theme)
{
    static const bool kIsDesktopDark = isDark(QApplication::palette());
    const bool is_dark = theme == Theme::Dark || (theme == Theme::System && kIsDesktopDark);
    const QPalette palette = is_dark ? darkPalette() : lightPalette();
    QApplication::setPalette(palette);
    QToolTip::setPalette(palette);
}

} // namespace marsview
