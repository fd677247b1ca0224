#include "ui/panels/layer_delegate.h"

#include "ui/panels/layer_model.h"
#include "ui/text/ramp_text.h"
#include "ui/widgets/caption.h"

#include <QAbstractItemView>
#include <QApplication>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>

#include <algorithm>
#include <array>

namespace marsview {
namespace {

constexpr int kMargin = 6;
constexpr int kGap = 4;
constexpr int kHistogramHeight = 20;
constexpr int kRampHeight = 4;

// A plain or a sea would press everything else flat: bars end at this many times the mean.
constexpr double kBarMax = 6.0;

QColor mixed(const QColor& a, const QColor& b, double share_of_b)
{
    const auto mix = [share_of_b](int x, int y) { return qRound(x + (y - x) * share_of_b); };
    return {mix(a.red(), b.red()), mix(a.green(), b.green()), mix(a.blue(), b.blue())};
}

int viewWidth(const QStyleOptionViewItem& option)
{
    const auto* view = qobject_cast<const QAbstractItemView*>(option.widget);
    return view != nullptr ? view->viewport()->width() : option.rect.width();
}

} // namespace

struct LayerDelegate::Places {
    QRect check;
    QRect name;
    QRect facts;
    QRect histogram;
    QRect ramp;
    QRect note;
    QRect show; // the button; empty if there is none
    int height = 0;
};

namespace {

QString showText()
{
    //: On a button in the row of a layer that the view does not show
    return LayerDelegate::tr("Show");
}

} // namespace

LayerDelegate::LayerDelegate(LayerModel& model, QObject* parent)
    : QStyledItemDelegate(parent)
    , model_(model)
{}

LayerDelegate::Places LayerDelegate::placesOf(const QStyleOptionViewItem& option,
                                              const QModelIndex& index) const
{
    const QStyle* style = option.widget != nullptr ? option.widget->style() : QApplication::style();
    const QFontMetrics big(option.font);
    const QFontMetrics small(captionFont(option.font));
    const int side = style->pixelMetric(QStyle::PM_IndicatorWidth, &option, option.widget);
    const int line = std::max(side, big.height());
    const int left = kMargin + side + kGap;
    const int width = std::max(1, viewWidth(option) - left - kMargin);
    int y = kMargin;
    Places places;
    places.check = QRect(kMargin, y + (line - side) / 2, side, side);
    places.name = QRect(left, y, width, line);
    y += line + 1;
    const QString size = index.data(LayerModel::SizeRole).toString();
    const QString range = index.data(LayerModel::RangeRole).toString();
    const bool is_one_line =
        small.horizontalAdvance(size) + 2 * kMargin + small.horizontalAdvance(range) <= width;
    places.facts = QRect(left, y, width, small.height() * (is_one_line ? 1 : 2));
    y += places.facts.height() + 2;
    places.histogram = QRect(left, y, width, kHistogramHeight);
    y += kHistogramHeight;
    places.ramp = QRect(left, y, width, kRampHeight);
    y += kRampHeight;
    const QString note = index.data(LayerModel::NoteRole).toString();
    if (!note.isEmpty()) {
        y += kGap;
        const bool has_button = index.data(LayerModel::CanShowRole).toBool();
        const QSize button = has_button ? QSize(small.horizontalAdvance(showText()) + 4 * kGap,
                                                small.height() + kGap + 2)
                                        : QSize(0, 0);
        const int note_width = std::max(1, width - button.width() - (has_button ? kMargin : 0));
        const int note_height =
            small.boundingRect(QRect(0, 0, note_width, 1000), Qt::TextWordWrap, note).height();
        const int height = std::max(note_height, button.height());
        places.note = QRect(left, y + (height - note_height) / 2, note_width, note_height);
        places.show = QRect(QPoint(left + width - button.width(), y), button);
        y += height;
    }
    places.height = y + kMargin;
    const QPoint origin = option.rect.topLeft();
    const bool is_mirrored = option.direction == Qt::RightToLeft;
    for (QRect* place : {&places.check, &places.name, &places.facts, &places.histogram,
                         &places.ramp, &places.note, &places.show}) {
        if (is_mirrored) {
            place->moveLeft(viewWidth(option) - place->left() - place->width());
        }
        place->translate(origin);
    }
    return places;
}

QSize LayerDelegate::sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const
{
    QStyleOptionViewItem full = option;
    initStyleOption(&full, index);
    if (index.data(LayerModel::IsHeaderRole).toBool()) {
        return {120, QFontMetrics(captionFont(full.font)).height() + 2 * kMargin};
    }
    return {120, placesOf(full, index).height};
}

void LayerDelegate::paint(QPainter* painter,
                          const QStyleOptionViewItem& option,
                          const QModelIndex& index) const
{
    QStyleOptionViewItem full = option;
    initStyleOption(&full, index);
    if (index.data(LayerModel::IsHeaderRole).toBool()) {
        paintHeader(*painter, full, index);
        return;
    }
    const Places places = placesOf(full, index);
    const QStyle* style = full.widget != nullptr ? full.widget->style() : QApplication::style();
    const bool is_shown = index.data(LayerModel::IsShownRole).toBool();
    const bool is_active = index.data(LayerModel::IsActiveRole).toBool();

    painter->save();
    const QPalette& palette = full.palette;
    const QColor base = palette.color(QPalette::Base);
    const QColor accent = palette.color(QPalette::Highlight);
    // The active layer is tinted rather than filled, so that its colors stay recognizable.
    painter->fillRect(full.rect, is_active ? mixed(base, accent, 0.22) : base);
    if (is_active) {
        const bool is_mirrored = full.direction == Qt::RightToLeft;
        painter->fillRect(QRect(is_mirrored ? full.rect.right() - 2 : full.rect.left(),
                                full.rect.top(), 3, full.rect.height()),
                          accent);
    }
    painter->setPen(mixed(base, palette.color(QPalette::Text), 0.15));
    painter->drawLine(full.rect.bottomLeft(), full.rect.bottomRight());

    QStyleOptionButton check;
    check.rect = places.check;
    check.palette = palette;
    // A layer that the view cannot show has a dash in a dim box: neither shown nor hidden.
    check.state = full.checkState == Qt::PartiallyChecked ? QStyle::State_NoChange
                  : full.checkState == Qt::Checked        ? QStyle::State_Enabled | QStyle::State_On
                                                   : QStyle::State_Enabled | QStyle::State_Off;
    if (full.checkState == Qt::PartiallyChecked) {
        check.palette.setCurrentColorGroup(QPalette::Disabled);
    }
    style->drawPrimitive(QStyle::PE_IndicatorCheckBox, &check, painter, full.widget);

    const QColor text =
        is_shown ? palette.color(QPalette::Text) : mixed(palette.color(QPalette::Text), base, 0.4);
    const QColor quiet = mixed(palette.color(QPalette::Text), base, is_shown ? 0.25 : 0.4);
    QFont name_font = full.font;
    name_font.setWeight(is_active ? QFont::DemiBold : QFont::Normal);
    painter->setFont(name_font);
    painter->setPen(text);
    const Qt::Alignment leading = QStyle::visualAlignment(full.direction, Qt::AlignLeft);
    const Qt::Alignment trailing = QStyle::visualAlignment(full.direction, Qt::AlignRight);
    painter->drawText(places.name, static_cast<int>(leading | Qt::AlignVCenter),
                      QFontMetrics(name_font).elidedText(index.data().toString(), Qt::ElideMiddle,
                                                         places.name.width()));

    const QFont small = captionFont(full.font);
    const QFontMetrics metrics(small);
    painter->setFont(small);
    painter->setPen(quiet);
    const QString size = index.data(LayerModel::SizeRole).toString();
    const QString range = index.data(LayerModel::RangeRole).toString();
    if (places.facts.height() < 2 * metrics.height()) {
        painter->drawText(places.facts, static_cast<int>(leading | Qt::AlignVCenter), size);
        painter->drawText(places.facts, static_cast<int>(trailing | Qt::AlignVCenter), range);
    } else {
        painter->drawText(places.facts, static_cast<int>(leading | Qt::AlignTop), size);
        painter->drawText(places.facts, static_cast<int>(leading | Qt::AlignBottom),
                          metrics.elidedText(range, Qt::ElideMiddle, places.facts.width()));
    }

    painter->setOpacity(is_shown ? 1.0 : 0.45);
    paintHistogram(*painter, places.histogram, index);
    const auto colors = sampledRamp(model_.rampAt(index));
    for (int x = 0; x < places.ramp.width(); ++x) {
        const auto i = static_cast<std::size_t>(x * 255 / std::max(1, places.ramp.width() - 1));
        painter->fillRect(places.ramp.left() + x, places.ramp.top(), 1, places.ramp.height(),
                          colorFrom(colors[i]));
    }
    painter->setOpacity(1.0);

    painter->setPen(palette.color(QPalette::Text));
    painter->drawText(places.note, static_cast<int>(leading) | Qt::TextWordWrap,
                      index.data(LayerModel::NoteRole).toString());
    if (!places.show.isEmpty()) {
        paintShowButton(*painter, full, places.show);
    }

    if ((full.state & QStyle::State_HasFocus) != 0) {
        painter->setPen(QPen(accent, 2));
        painter->drawRect(full.rect.adjusted(1, 1, -1, -2));
    }
    painter->restore();
}

// A heading on the color of the window, so that it separates the groups.
void LayerDelegate::paintHeader(QPainter& painter,
                                const QStyleOptionViewItem& option,
                                const QModelIndex& index) const
{
    painter.save();
    const QPalette& palette = option.palette;
    painter.fillRect(option.rect, palette.color(QPalette::Window));
    painter.setPen(mixed(palette.color(QPalette::Base), palette.color(QPalette::Text), 0.15));
    painter.drawLine(option.rect.bottomLeft(), option.rect.bottomRight());
    QFont font = captionFont(option.font);
    font.setWeight(QFont::DemiBold);
    painter.setFont(font);
    painter.setPen(palette.color(QPalette::WindowText));
    painter.drawText(option.rect.adjusted(kMargin, 0, -kMargin, 0),
                     static_cast<int>(QStyle::visualAlignment(option.direction, Qt::AlignLeft) |
                                      Qt::AlignVCenter),
                     index.data().toString());
    painter.restore();
}

void LayerDelegate::paintShowButton(QPainter& painter,
                                    const QStyleOptionViewItem& option,
                                    const QRect& place) const
{
    const QStyle* style = option.widget != nullptr ? option.widget->style() : QApplication::style();
    QStyleOptionButton button;
    button.rect = place;
    button.palette = option.palette;
    button.state = QStyle::State_Enabled | QStyle::State_Raised;
    button.direction = option.direction;
    style->drawControl(QStyle::CE_PushButtonBevel, &button, &painter, option.widget);
    painter.setPen(option.palette.color(QPalette::ButtonText));
    painter.drawText(place, Qt::AlignCenter, showText());
}

QRect LayerDelegate::showButtonOf(const QStyleOptionViewItem& option,
                                  const QModelIndex& index) const
{
    QStyleOptionViewItem full = option;
    initStyleOption(&full, index);
    return index.data(LayerModel::IsHeaderRole).toBool() ? QRect() : placesOf(full, index).show;
}

void LayerDelegate::paintHistogram(QPainter& painter,
                                   const QRect& place,
                                   const QModelIndex& index) const
{
    const auto histogram = model_.histogramAt(index);
    if (!histogram || histogram->counts.empty()) {
        return;
    }
    const auto colors = sampledRamp(model_.rampAt(index));
    const auto& counts = histogram->counts;
    const double mean =
        static_cast<double>(histogram->sample_count) / static_cast<double>(counts.size());
    const double top = std::min(
        static_cast<double>(*std::max_element(counts.begin(), counts.end())), kBarMax * mean);
    if (!(top > 0.0)) {
        return;
    }
    for (int x = 0; x < place.width(); ++x) {
        const auto bin =
            static_cast<std::size_t>(x) * counts.size() / static_cast<std::size_t>(place.width());
        const double share = std::min(1.0, static_cast<double>(counts[bin]) / top);
        // What there is at all can be seen.
        const int height = counts[bin] == 0 ? 0 : std::max(1, qRound(share * place.height()));
        const auto i = static_cast<std::size_t>(x * 255 / std::max(1, place.width() - 1));
        painter.fillRect(place.left() + x, place.bottom() + 1 - height, 1, height,
                         colorFrom(colors[i]));
    }
}

void LayerDelegate::updateEditorGeometry(QWidget* editor,
                                         const QStyleOptionViewItem& option,
                                         const QModelIndex& index) const
{
    QStyleOptionViewItem full = option;
    initStyleOption(&full, index);
    editor->setGeometry(placesOf(full, index).name);
}

bool LayerDelegate::editorEvent(QEvent* event,
                                QAbstractItemModel* model,
                                const QStyleOptionViewItem& option,
                                const QModelIndex& index)
{
    if (index.data(LayerModel::IsHeaderRole).toBool()) {
        return false;
    }
    const auto toggle = [model, &index] {
        // The user can only hide a layer that the view cannot show even alone.
        const bool is_hidden = index.data(Qt::CheckStateRole).toInt() == Qt::Unchecked ||
                               index.data(LayerModel::CanShowRole).toBool();
        return model->setData(index, is_hidden ? Qt::Checked : Qt::Unchecked, Qt::CheckStateRole);
    };
    switch (event->type()) {
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonRelease:
    case QEvent::MouseButtonDblClick: {
        const auto* mouse = static_cast<QMouseEvent*>(event);
        QStyleOptionViewItem full = option;
        initStyleOption(&full, index);
        const Places places = placesOf(full, index);
        const QRect check = places.check.adjusted(-kGap, -kGap, kGap, kGap);
        const QPoint position = mouse->position().toPoint();
        if (mouse->button() != Qt::LeftButton ||
            (!check.contains(position) && !places.show.contains(position))) {
            return false;
        }
        return event->type() != QEvent::MouseButtonRelease || toggle();
    }
    case QEvent::KeyPress: {
        const int key = static_cast<QKeyEvent*>(event)->key();
        return (key == Qt::Key_Space || key == Qt::Key_Select) && toggle();
    }
    default:
        return false;
    }
}

} // namespace marsview
