// A field for a coordinate reference system, with a search in PROJ's database.
#pragma once

#include "core/geo/crs_catalog.h"

#include <QLineEdit>
#include <QThreadPool>
#include <QTimer>

#include <memory>

class QAbstractItemView;
class QCompleter;
class QStandardItemModel;

namespace marsview {

/// Takes anything that Crs::fromText does. While the user types, systems whose name or code matches
/// are listed below the field; choosing one enters its code. GUI thread. The database is read once,
/// on another thread; the destructor waits for that, a tenth of a second at most.
class CrsField final : public QLineEdit {
    Q_OBJECT

public:
    explicit CrsField(QWidget* parent = nullptr);
    ~CrsField() override;

    /// Systems of that body come first; null for none.
    void setBody(const Body* body) { body_ = body; }
    /// Reads the database if that has not been done yet.
    void loadCatalogue();
    /// The database has been read.
    bool isLoaded() const noexcept { return catalogue_ != nullptr; }
    /// The systems that are listed now: codes, best first.
    QStringList matches() const;
    /// The list below the field.
    QAbstractItemView* matchList() const;

Q_SIGNALS:
    /// The user has stopped typing for a moment, or chose a system; matches() is of the text.
    void settled();

protected:
    void focusInEvent(QFocusEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

private:
    void search();
    void listMatches();

    std::shared_ptr<const CrsCatalog> catalogue_; // null until it was read
    const Body* body_ = nullptr;
    bool is_loading_ = false;
    QStandardItemModel* model_ = nullptr;
    QCompleter* completer_ = nullptr;
    QTimer timer_; // runs out when the user stops typing
    QThreadPool pool_;
};

} // namespace marsview
