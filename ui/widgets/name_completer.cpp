#include "ui/widgets/name_completer.h"

#include "ui/text/number_text.h"
#include "ui/text/place_name_text.h"

#include <QAbstractItemView>
#include <QEvent>
#include <QLineEdit>
#include <QScreen>
#include <QStandardItemModel>

#include <algorithm>
#include <utility>

namespace marsview {
namespace {

constexpr std::size_t kListedMax = 12;

// Wide enough for names with kind and size below a narrow field.
constexpr int kPopupWidthMin = 320;

// So many matches are looked through for places that are on the map.
constexpr std::size_t kMatchesMax = 400;

} // namespace

std::vector<PlaceName> NamesOnMap::find(const QString& text, std::size_t count_max) const
{
    std::vector<PlaceName> found;
    if (!names) {
        return found;
    }
    for (const std::size_t index : names->find(text.toStdString(), kMatchesMax)) {
        const PlaceName& place = names->names()[index];
        if (!is_on_map || is_on_map(place)) {
            found.push_back(place);
            if (found.size() == count_max) {
                break;
            }
        }
    }
    return found;
}

QString noMatchText(const QString& text, const NamesOnMap& names, const Body* body)
{
    if (!names.names) {
        return noNamesText(body);
    }
    const auto elsewhere = names.names->find(text.toStdString(), 1);
    return elsewhere.empty() ? notFoundText(text, *names.names)
                             : outsideMapText(names.names->names()[elsewhere.front()]);
}

NameCompleter::NameCompleter(QLineEdit& field)
    : QCompleter(&field)
    , model_(new QStandardItemModel(this))
{
    setModel(model_);
    setCompletionMode(QCompleter::UnfilteredPopupCompletion);
    setCompletionRole(Qt::UserRole);
    setMaxVisibleItems(static_cast<int>(kListedMax));
    popup()->setMinimumWidth(kPopupWidthMin);
    popup()->setAccessibleName(tr("Matching names"));
    list_ = popup();
    list_->installEventFilter(this);
    // Before the field shows the list.
    connect(&field, &QLineEdit::textEdited, this, &NameCompleter::fill);
    // Later: the list is still open, and the field is about to take the text.
    connect(this, QOverload<const QModelIndex&>::of(&QCompleter::activated), this,
            [this](const QModelIndex& index) {
                const auto row = static_cast<std::size_t>(index.row());
                if (row < listed_.size()) {
                    QMetaObject::invokeMethod(
                        this, [this, place = listed_[row]] { Q_EMIT chosen(place); },
                        Qt::QueuedConnection);
                }
            });
    field.setCompleter(this);
}

void NameCompleter::setNames(NamesOnMap names)
{
    names_ = std::move(names);
    fill({});
}

void NameCompleter::fill(const QString& text)
{
    listed_ = names_.find(text, kListedMax);
    model_->clear();
    const auto add = [this](const QString& line, const QString& name) {
        auto* item = new QStandardItem(line); // owned by the model
        item->setData(name, Qt::UserRole);
        item->setFlags(name.isEmpty() ? Qt::NoItemFlags : Qt::ItemIsEnabled | Qt::ItemIsSelectable);
        model_->appendRow(item);
    };
    for (const PlaceName& place : listed_) {
        const QString name = QString::fromStdString(place.name);
        const QString detail = placeDetailText(place);
        //: A place in a list: its name, then its kind and size
        add(detail.isEmpty() ? isolated(name) : tr("%1 — %2").arg(isolated(name), detail), name);
    }
    if (listed_.empty() && explain_ && !text.trimmed().isEmpty()) {
        for (const QString& line : explain_(text).split(QLatin1Char('\n'))) {
            add(line, {});
        }
    }
}

// Qt keeps a list of the field's width on the screen, but this one may be wider. Without popup(),
// which makes the list and comes here while it does.
bool NameCompleter::eventFilter(QObject* watched, QEvent* event)
{
    const bool is_placed = event->type() == QEvent::Show || event->type() == QEvent::Move ||
                           event->type() == QEvent::Resize;
    if (watched == list_ && is_placed) {
        const QRect screen = list_->screen()->availableGeometry();
        const int beyond = list_->geometry().right() - screen.right();
        if (beyond > 0 && list_->x() > screen.left()) {
            list_->move(std::max(screen.left(), list_->x() - beyond), list_->y());
        }
    }
    return QCompleter::eventFilter(watched, event);
}

void NameCompleter::explainNothing(std::function<QString(const QString&)> explain)
{
    explain_ = std::move(explain);
}

} // namespace marsview
