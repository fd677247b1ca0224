#include "haptics/terrain/servo_map.h"

#include "core/contact/resident_heights.h"

#include <atomic>
#include <utility>

namespace marsview {
namespace {

std::uint64_t nextSerial()
{
    static std::atomic<std::uint64_t> last{0};
    return last.fetch_add(1, std::memory_order_relaxed) + 1;
}

std::shared_ptr<ServoMap> madeOf(const GoalFrame& frame,
                                 std::unique_ptr<MapContactModel> model,
                                 std::shared_ptr<ServoTerrain> terrain,
                                 const ServoMapOptions& options)
{
    return std::make_shared<ServoMap>(ServoMap{.frame = frame,
                                               .model = std::move(model),
                                               .terrain = std::move(terrain),
                                               .kind = options.kind,
                                               .radius_m = options.contact.radius_m,
                                               .map_id = options.map_id,
                                               .serial = nextSerial()});
}

} // namespace

std::shared_ptr<ServoMap> makeServoMap(const GoalFrame& frame,
                                       std::shared_ptr<const FilledHeightfield> filled,
                                       const ServoMapOptions& options)
{
    const HeightfieldSurface surface(std::move(filled), frame.frame(), frame.exaggeration());
    return madeOf(frame, makeContactModel(options.kind, surface, options.contact), nullptr,
                  options);
}

std::shared_ptr<ServoMap> makeServoMap(const GoalFrame& frame,
                                       std::shared_ptr<ServoTerrain> terrain,
                                       const ServoMapOptions& options)
{
    const TiledHeightfieldSurface surface(terrain->terrain(), frame.frame(), frame.exaggeration());
    auto model = makeContactModel(options.kind, surface, options.contact);
    return madeOf(frame, std::move(model), std::move(terrain), options);
}

} // namespace marsview
