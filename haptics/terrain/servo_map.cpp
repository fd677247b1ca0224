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

template <typename Surface>
class HeightsOf final : public SurfaceHeights {
public:
    explicit HeightsOf(Surface surface)
        : surface_(std::move(surface))
    {}
    double height(const GridPoint& at) const noexcept override { return surface_.height(at); }

private:
    Surface surface_;
};

template <typename Surface>
std::shared_ptr<ServoMap> madeOf(const GoalFrame& frame,
                                 const Surface& surface,
                                 std::shared_ptr<ServoTerrain> terrain,
                                 const ServoMapOptions& options)
{
    return std::make_shared<ServoMap>(
        ServoMap{.frame = frame,
                 .model = makeContactModel(options.kind, surface, options.contact),
                 .heights = std::make_unique<HeightsOf<Surface>>(surface),
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
    return madeOf(frame, surface, nullptr, options);
}

std::shared_ptr<ServoMap> makeServoMap(const GoalFrame& frame,
                                       std::shared_ptr<ServoTerrain> terrain,
                                       const ServoMapOptions& options)
{
    const TiledHeightfieldSurface surface(terrain->terrain(), frame.frame(), frame.exaggeration());
    return madeOf(frame, surface, std::move(terrain), options);
}

} // namespace marsview
