// The layout of the overlays.
#pragma once

#include <QObject>
#include <QRect>

#include <array>

class QWidget;

namespace marsview {

class Compass;
class ForceMeter;
class GestureHint;
class Legend;
class Minimap;
class ScaleBarView;

/// The overlays on the map. Any may be null.
struct OverlayParts {
    Minimap* minimap = nullptr;
    Legend* legend = nullptr;
    Compass* compass = nullptr;
    ScaleBarView* scale_bar = nullptr;
    ForceMeter* force_meter = nullptr;
    GestureHint* hint = nullptr;
};

/// Keeps overlays in the corners of a widget: the minimap in the upper right, compass and scale bar
/// in the lower right, the legend in the lower left, the hint in the upper left, the force meter at
/// the bottom in the middle, or as near to that as possible. Mirrored in right-to-left layouts. No
/// two overlap: in a small view the hint loses lines and is hidden first, then the legend, the
/// minimap, the compass and the scale bar. Showing or hiding the force meter neither moves nor
/// hides another overlay.
class OverlayLayout final : public QObject {
    Q_OBJECT

public:
    /// Makes the parts children of `host`, which owns them from then on. This object must not
    /// outlive them: best a child of `host`, too.
    OverlayLayout(QWidget* host, const OverlayParts& parts);

    /// Whether a part may be seen at all; true to begin with.
    void setWanted(QWidget* part, bool is_wanted);
    bool isWanted(const QWidget* part) const;
    /// So much of the host's upper edge is covered by something else.
    void setCovered(int height);

    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    struct Entry {
        QWidget* widget = nullptr;
        bool is_wanted = true;
    };

    void arrange();
    void placeParts(const QRect& room);
    bool isNeeded(const QWidget* part) const;

    QWidget* host_ = nullptr;
    OverlayParts parts_;
    std::array<Entry, 6> entries_;
    int covered_height_ = 0;
    bool is_arranging_ = false;
};

} // namespace marsview
