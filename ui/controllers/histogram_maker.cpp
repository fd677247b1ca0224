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
    pool_.waitForDone(); // what it posted goes with this object
}

std::shared_ptr<const HeightHistogram>
HistogramMaker::find(const std::shared_ptr<const Dataset>& dataset)
{
    if (const auto hit = entries_.find(dataset.get());
        hit != entries_.end() && !hit->second.dataset.expired()) {
        return hit->second.histogram;
    }
    std::erase_if(entries_, [](const auto& entry) { return entry.second.dataset.expired(); });
    entries_[dataset.get()] = {.dataset = dataset, .histogram = nullptr};
    pool_.start([this, dataset] {
        HistogramOptions options;
        options.monitor = &monitor_;
        auto histogram = std::make_shared<const HeightHistogram>(
            heightHistogram(dataset->heightfield(), options));
        QMetaObject::invokeMethod(
            this,
            [this, dataset, histogram = std::move(histogram)] {
                entries_[dataset.get()] = {.dataset = dataset, .histogram = histogram};
                Q_EMIT made(dataset);
            },
            Qt::QueuedConnection);
    });
    return nullptr;
}

} // namespace marsview
