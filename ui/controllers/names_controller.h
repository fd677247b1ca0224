// The names of places that the window offers and shows.
#pragma once

#include "core/base/job_monitor.h"
#include "core/names/gazetteer.h"

#include <QObject>
#include <QString>
#include <QThreadPool>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace marsview {

/// The bundled names and those of the user's files, by body. Files are read on a thread of their
/// own. Lives in the GUI thread.
class NamesController final : public QObject {
    Q_OBJECT

public:
    explicit NamesController(QObject* parent = nullptr);
    /// Cancels the file that is being read.
    ~NamesController() override;

    /// All names on a body; null if there are none, or the body is unknown.
    std::shared_ptr<const Gazetteer> namesOn(const Body* body);

    /// Adds the names in a file; opened() or failed() follows. A file that states no body is on
    /// `body`, which is null if unknown.
    void open(const QString& file, const Body* body);

Q_SIGNALS:
    /// namesOn() returns other names for a body.
    void changed();
    void opened(const QString& file, const std::shared_ptr<const Gazetteer>& names);
    /// "FILE: WHY"
    void failed(const QString& problem);

private:
    void add(const QString& file, std::shared_ptr<const Gazetteer> names);

    struct OpenedList {
        QString file;
        std::shared_ptr<const Gazetteer> names;
    };
    std::vector<OpenedList> opened_;
    std::map<std::string, std::shared_ptr<const Gazetteer>, std::less<>> merged_; // by body
    JobMonitor monitor_; // canceled at the end
    QThreadPool pool_;
};

} // namespace marsview
