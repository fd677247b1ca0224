// The files opened last, and the menu that offers them.
#pragma once

#include <QObject>
#include <QStringList>

class QMenu;

namespace marsview {

/// Whether a name is an address (https://…), which is opened as it is.
bool isAddress(const QString& file);

/// The text of each file or address in a list: its name, and for names that occur more than once
/// as many of the last folders of its path as distinguish the files: "dem.tif — mars/".
QStringList namesFor(const QStringList& files);

/// Remembers ten files or addresses, the last opened first, for this and for later windows. Files
/// that are gone stay in the list, behind the others, and say so.
class RecentFiles final : public QObject {
    Q_OBJECT

public:
    enum class Memory { Settings, WindowOnly };

    /// Keeps `menu` filled whenever it opens. Lists of different kinds have different keys in the
    /// settings.
    RecentFiles(QMenu& menu,
                Memory memory,
                QObject* parent = nullptr,
                const QString& settings_key = QStringLiteral("files/recent"));

    void add(const QString& file);
    void clear();
    const QStringList& files() const noexcept { return files_; }

Q_SIGNALS:
    void chosen(const QString& file);

private:
    void fillMenu();
    void changed();

    QMenu& menu_;
    Memory memory_;
    QString settings_key_;
    QStringList files_; // the last opened first
};

} // namespace marsview
