#include "ui/controllers/histogram_maker.h"

#include <utility>

namespace marsview {

HistogramMaker::HistogramMaker(QObject* parent)
    : QObject(parent)
{
    pool_.setMaxThreadCount(1);
}

HistogramMaker::~HistogramMaker()
{
    monitor_.cancel();
    pool_.clear();
    pool_.waitForDone(); // posted results are discarded with this object
}

std::shared_ptr<const HeightHistogram> HistogramMaker::find(const std::shared_ptr<const Map>& map)
{
    if (const auto hit = entries_.find(map.get());
        hit != entries_.end() && !hit->second.map.expired()) {
        return hit->second.histogram;
    }
    std::erase_if(entries_, [](const auto& entry) { return entry.second.map.expired(); });
    entries_[map.get()] = {.map = map, .histogram = nullptr};
    pool_.start([this, map] {
        HistogramOptions options;
        options.monitor = &monitor_;
        auto histogram =
            std::make_shared<const HeightHistogram>(heightHistogram(map->heightfield(), options));
        QMetaObject::invokeMethod(
            this,
            [this, map, histogram = std::move(histogram)] {
                entries_[map.get()] = {.map = map, .histogram = histogram};
                Q_EMIT made(map);
            },
            Qt::QueuedConnection);
    });
    return nullptr;
}

} // namespace marsview
