#include "ui/controllers/names_controller.h"

#include "core/names/names_file.h"

#include <utility>

namespace marsview {

NamesController::NamesController(QObject* parent)
    : QObject(parent)
{
    pool_.setMaxThreadCount(1);
}

NamesController::~NamesController()
{
    monitor_.cancel();
    pool_.clear();
    pool_.waitForDone(); // posted results are discarded with this object
}

std::shared_ptr<const Gazetteer> NamesController::namesOn(const Body* body)
{
    if (body == nullptr) {
        return nullptr;
    }
    const auto [entry, is_new] = merged_.try_emplace(std::string(body->name));
    if (is_new) {
        const auto bundled = bundledGazetteer(*body);
        std::vector<PlaceName> names;
        for (const OpenedList& list : opened_) {
            if (list.names->body() == body) {
                names.insert(names.end(), list.names->names().begin(), list.names->names().end());
            }
        }
        if (names.empty()) {
            entry->second = bundled;
        } else {
            if (bundled) {
                names.insert(names.end(), bundled->names().begin(), bundled->names().end());
            }
            entry->second = std::make_shared<const Gazetteer>(body, std::move(names));
        }
    }
    return entry->second;
}

void NamesController::open(const QString& file, const Body* body)
{
    pool_.start([this, file, body] {
        auto names = readGazetteer(file.toStdString(), body, monitor_);
        QMetaObject::invokeMethod(
            this,
            [this, file, names = std::move(names)] {
                if (names) {
                    add(file, *names);
                } else if (names.error().code != ErrorCode::Canceled) {
                    Q_EMIT failed(QString::fromStdString(names.error().message));
                }
            },
            Qt::QueuedConnection);
    });
}

// A file that is opened again replaces its names.
void NamesController::add(const QString& file, std::shared_ptr<const Gazetteer> names)
{
    std::erase_if(opened_, [&file](const OpenedList& list) { return list.file == file; });
    opened_.push_back({.file = file, .names = names});
    merged_.clear();
    Q_EMIT changed();
    Q_EMIT opened(file, names);
}

} // namespace marsview
