// Histograms of the session's maps, counted away from the GUI thread.
#pragma once

#include "core/base/job_monitor.h"
#include "core/session/map.h"
#include "core/terrain/height_histogram.h"

#include <QObject>
#include <QThreadPool>

#include <map>
#include <memory>

namespace marsview {

/// Counts the histogram of each map once and drops it with the map. Lives in the GUI thread; the
/// destructor waits for the count that runs: some 10 ms, or as long as one tile takes to be read.
class HistogramMaker final : public QObject {
    Q_OBJECT

public:
    explicit HistogramMaker(QObject* parent = nullptr);
    ~HistogramMaker() override;

    /// Null while it is being counted; made() follows.
    std::shared_ptr<const HeightHistogram> find(const std::shared_ptr<const Map>& map);

Q_SIGNALS:
    void made(const std::shared_ptr<const Map>& map);

private:
    struct Entry {
        std::weak_ptr<const Map> map;
        std::shared_ptr<const HeightHistogram> histogram; // null while it is being counted
    };

    std::map<const Map*, Entry> entries_;
    JobMonitor monitor_; // canceled at the end
    QThreadPool pool_;
};

} // namespace marsview
