#include "ui/overlay/overlay_layout.h"

#include "ui/overlay/compass.h"
#include "ui/overlay/force_meter.h"
#include "ui/overlay/gesture_hint.h"
#include "ui/overlay/legend.h"
#include "ui/overlay/minimap.h"
#include "ui/overlay/scale_bar_view.h"

#include <QEvent>
#include <QScopedValueRollback>
#include <QStyle>
#include <QWidget>

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace marsview {
namespace {

constexpr int kMargin = 10; // to the edges of the map
constexpr int kSpacing = 8; // between overlays

constexpr QSize kMinimapLargest(220, 160);
constexpr double kMinimapWidthShare = 0.3; // of the map's, at most
constexpr double kMinimapHeightShare = 0.35;

constexpr int kBarLongest = 130;
constexpr double kBarWidthShare = 0.25;
constexpr int kBarShortest = 40;

} // namespace

OverlayLayout::OverlayLayout(QWidget* host, const OverlayParts& parts)
    : QObject(host)
    , host_(host)
    , parts_(parts)
    , entries_{Entry{parts.minimap},   Entry{parts.legend},      Entry{parts.compass},
               Entry{parts.scale_bar}, Entry{parts.force_meter}, Entry{parts.hint}}
{
    for (const Entry& entry : entries_) {
        if (entry.widget != nullptr) {
            entry.widget->setParent(host);
        }
    }
    host->installEventFilter(this);
    if (parts.minimap != nullptr) {
        connect(parts.minimap, &Minimap::roomChanged, this, &OverlayLayout::arrange);
    }
    if (parts.legend != nullptr) {
        connect(parts.legend, &Legend::roomChanged, this, &OverlayLayout::arrange);
    }
    if (parts.scale_bar != nullptr) {
        connect(parts.scale_bar, &ScaleBarView::roomChanged, this, &OverlayLayout::arrange);
    }
    if (parts.force_meter != nullptr) {
        connect(parts.force_meter, &ForceMeter::roomChanged, this, &OverlayLayout::arrange);
    }
    arrange();
}

void OverlayLayout::setWanted(QWidget* part, bool is_wanted)
{
    for (Entry& entry : entries_) {
        if (entry.widget == part) {
            entry.is_wanted = is_wanted;
        }
    }
    arrange();
}

bool OverlayLayout::isWanted(const QWidget* part) const
{
    return std::any_of(entries_.begin(), entries_.end(), [part](const Entry& entry) {
        return entry.widget == part && entry.is_wanted;
    });
}

void OverlayLayout::setCovered(int height)
{
    if (height != covered_height_) {
        covered_height_ = height;
        arrange();
    }
}

bool OverlayLayout::isNeeded(const QWidget* part) const
{
    return part != nullptr && isWanted(part) && !part->sizeHint().isEmpty();
}

bool OverlayLayout::eventFilter(QObject* watched, QEvent* event)
{
    if (watched == host_ &&
        (event->type() == QEvent::Resize || event->type() == QEvent::FontChange ||
         event->type() == QEvent::LayoutDirectionChange || event->type() == QEvent::StyleChange)) {
        arrange();
    }
    return QObject::eventFilter(watched, event);
}

void OverlayLayout::arrange()
{
    if (is_arranging_) {
        return; // a part changed its room because it was given another
    }
    const QScopedValueRollback<bool> guard(is_arranging_, true);
    // Where a part is shown, Qt first finishes pending layouts, which may resize the host.
    QRect room;
    do {
        room = host_->rect();
        placeParts(room);
    } while (host_->rect() != room);
}

void OverlayLayout::placeParts(const QRect& room)
{
    const QRect inside = room.adjusted(kMargin, covered_height_ + kMargin, -kMargin, -kMargin);
    std::vector<QRect> taken;
    // Shows a part there, in left-to-right terms, or hides it.
    const auto put = [&](QWidget* part, QPoint top_left) {
        const QRect place(top_left, part->sizeHint());
        const bool fits =
            inside.contains(place) &&
            std::none_of(taken.begin(), taken.end(), [&](const QRect& other) {
                return other.adjusted(-kSpacing, -kSpacing, kSpacing, kSpacing).intersects(place);
            });
        if (fits) {
            taken.push_back(place);
            part->setGeometry(QStyle::visualRect(host_->layoutDirection(), room, place));
        }
        part->setVisible(fits);
        return fits;
    };
    const auto hide = [](QWidget* part) {
        if (part != nullptr) {
            part->hide();
        }
    };

    // The most important overlay first. right + 1 is the first pixel outside.
    const int right = inside.right() + 1;
    const int bottom = inside.bottom() + 1;
    int free_right = right;
    if (parts_.scale_bar != nullptr) {
        parts_.scale_bar->setLongestBar(
            std::clamp(static_cast<int>(room.width() * kBarWidthShare), kBarShortest, kBarLongest));
    }
    if (isNeeded(parts_.scale_bar)) {
        const QSize size = parts_.scale_bar->sizeHint();
        if (put(parts_.scale_bar, {right - size.width(), bottom - size.height()})) {
            free_right = right - size.width() - kSpacing;
        }
    } else {
        hide(parts_.scale_bar);
    }
    if (isNeeded(parts_.compass)) {
        const QSize size = parts_.compass->sizeHint();
        put(parts_.compass, {free_right - size.width(), bottom - size.height()});
    } else {
        hide(parts_.compass);
    }
    if (parts_.minimap != nullptr) {
        parts_.minimap->setLargestSize(QSize(static_cast<int>(room.width() * kMinimapWidthShare),
                                             static_cast<int>(room.height() * kMinimapHeightShare))
                                           .boundedTo(kMinimapLargest));
    }
    if (isNeeded(parts_.minimap)) {
        put(parts_.minimap, {right - parts_.minimap->sizeHint().width(), inside.top()});
    } else {
        hide(parts_.minimap);
    }
    if (isNeeded(parts_.legend)) {
        put(parts_.legend, {inside.left(), bottom - parts_.legend->sizeHint().height()});
    } else {
        hide(parts_.legend);
    }
    if (isNeeded(parts_.hint)) {
        std::any_of(GestureHint::kForms.begin(), GestureHint::kForms.end(),
                    [&](GestureHint::Form form) {
                        parts_.hint->setForm(form);
                        return put(parts_.hint, inside.topLeft());
                    });
    } else {
        hide(parts_.hint);
    }
    // Last, so that it moves nothing: as low as it can be, then as near to the middle.
    if (isNeeded(parts_.force_meter)) {
        const QSize size = parts_.force_meter->sizeHint();
        const int middle = inside.left() + (inside.width() - size.width()) / 2;
        std::vector<int> bottoms{bottom};
        std::vector<int> lefts{middle};
        for (const QRect& other : taken) {
            bottoms.push_back(other.top() - kSpacing);
            lefts.push_back(other.left() - kSpacing - size.width());
            lefts.push_back(other.right() + 1 + kSpacing);
        }
        std::sort(bottoms.rbegin(), bottoms.rend());
        std::sort(lefts.begin(), lefts.end(),
                  [middle](int a, int b) { return std::abs(a - middle) < std::abs(b - middle); });
        std::any_of(bottoms.begin(), bottoms.end(), [&](int lower) {
            return std::any_of(lefts.begin(), lefts.end(), [&](int left) {
                return put(parts_.force_meter, {left, lower - size.height()});
            });
        });
    } else {
        hide(parts_.force_meter);
    }
}

} // namespace marsview
