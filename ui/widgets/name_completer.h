// Names of places that complete what is typed.
#pragma once

#include "core/names/gazetteer.h"

#include <QCompleter>

#include <functional>
#include <memory>
#include <vector>

class QAbstractItemView;
class QLineEdit;
class QStandardItemModel;

namespace marsview {

/// Names on a map.
struct NamesOnMap {
    std::shared_ptr<const Gazetteer> names;               // null: none
    std::function<bool(const PlaceName&)> is_on_map = {}; // empty: all are

    /// The names that match a text and are on the map, the best first, at most `count_max`.
    std::vector<PlaceName> find(const QString& text, std::size_t count_max) const;
};

/// Why no name on a map matches a text, in one or two lines. `body` is null if unknown.
QString noMatchText(const QString& text, const NamesOnMap& names, const Body* body);

/// Lists the names that match the text of a field below it while the user types: with kind and
/// size, the best first. Names are found without diacritics. Owned by the field.
class NameCompleter final : public QCompleter {
    Q_OBJECT

public:
    explicit NameCompleter(QLineEdit& field);

    void setNames(NamesOnMap names);
    /// What to list, a line a row, where nothing matches the text. Empty by default: nothing.
    void explainNothing(std::function<QString(const QString&)> explain);
    const NamesOnMap& names() const noexcept { return names_; }
    bool eventFilter(QObject* watched, QEvent* event) override;

Q_SIGNALS:
    /// One of the list, with the mouse or the keyboard.
    void chosen(const PlaceName& place);

private:
    void fill(const QString& text);

    NamesOnMap names_;
    std::function<QString(const QString&)> explain_;
    std::vector<PlaceName> listed_;
    QStandardItemModel* model_ = nullptr;
    QAbstractItemView* list_ = nullptr; // popup(), once it exists
};

} // namespace marsview
