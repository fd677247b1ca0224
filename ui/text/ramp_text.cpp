#include "ui/text/ramp_text.h"

#include "core/base/check.h"

#include <QCoreApplication>
#include <QImage>
#include <QPixmap>

#include <algorithm>
#include <array>
#include <string_view>

namespace marsview {
namespace {

constexpr QSize kIconSize{48, 12};

struct NamedRamp {
    std::string_view name;
    const char* text;
};

constexpr std::array kRampNames{
    //: A color ramp from blue to rose, as the sky at sunrise
    NamedRamp{"dawn", QT_TRANSLATE_NOOP("ColorRamp", "Dawn")},
    //: A color ramp through purple and red to straw yellow
    NamedRamp{"ember", QT_TRANSLATE_NOOP("ColorRamp", "Ember")},
    //: The color ramp of atlases: green lowlands, brown mountains
    NamedRamp{"hypsometric", QT_TRANSLATE_NOOP("ColorRamp", "Hypsometric")},
    //: A color ramp from violet through teal to lime green
    NamedRamp{"lagoon", QT_TRANSLATE_NOOP("ColorRamp", "Lagoon")},
    //: A color ramp of the colors of Mars
    NamedRamp{"rust", QT_TRANSLATE_NOOP("ColorRamp", "Rust")},
    //: A color ramp from dark to light gray
    NamedRamp{"grey", QT_TRANSLATE_NOOP("ColorRamp", "Gray")},
    //: A color ramp with different colors below and above the elevation 0
    NamedRamp{"datum", QT_TRANSLATE_NOOP("ColorRamp", "Diverging (at 0)")},
};

} // namespace

QString rampName(const ColorRamp& ramp)
{
    const auto* hit = std::find_if(kRampNames.begin(), kRampNames.end(),
                                   [&ramp](const NamedRamp& n) { return n.name == ramp.name; });
    MARSVIEW_CHECK(hit != kRampNames.end());
    return QCoreApplication::translate("ColorRamp", hit->text);
}

QIcon rampIcon(const ColorRamp& ramp)
{
    const auto colors = sampledRamp(ramp);
    QImage image(kIconSize, QImage::Format_RGB32);
    for (int x = 0; x < image.width(); ++x) {
        const auto i = static_cast<std::size_t>(x * 255 / (image.width() - 1));
        for (int y = 0; y < image.height(); ++y) {
            image.setPixelColor(x, y, colorFrom(colors[i]));
        }
    }
    return {QPixmap::fromImage(image)};
}

QColor colorFrom(Rgb8 color)
{
    return {color.red, color.green, color.blue};
}

} // namespace marsview
