#include "core/contact/contact_model.h"

#include "core/base/check.h"
#include "core/contact/continuous_walk.h"
#include "core/contact/proxy_graph.h"
#include "core/contact/surface_walk.h"

#include <algorithm>
#include <iterator>

namespace marsview {
namespace {

constexpr std::array<std::string_view, kContactModelKinds.size()> kNames{
    "proxy-graph", "surface-walk",       "continuous-walk",
    "god-object",  "god-object-release", "virtual-proxy",
};

template <typename M>
class Held final : public ContactModel {
public:
    template <typename... Arguments>
    explicit Held(Arguments&&... arguments)
        : model_(std::forward<Arguments>(arguments)...)
    {}
    ContactState place(const ScenePoint& goal) noexcept override { return model_.place(goal); }
    ContactState update(const ScenePoint& goal) noexcept override { return model_.update(goal); }

private:
    M model_;
};

template <typename S>
std::unique_ptr<ContactModel>
make(ContactModelKind kind, const S& surface, const ContactModelOptions& /*options*/)
{
    switch (kind) {
    case ContactModelKind::ProxyGraph:
        return std::make_unique<Held<ProxyGraph<S>>>(surface);
    case ContactModelKind::SurfaceWalk:
        return std::make_unique<Held<SurfaceWalk<S>>>(surface);
    case ContactModelKind::ContinuousWalk:
        return std::make_unique<Held<ContinuousWalk<S>>>(surface);
    default:
        break;
    }
    MARSVIEW_CHECK(false);
}

} // namespace

std::string_view contactModelName(ContactModelKind kind) noexcept
{
    return kNames[static_cast<std::size_t>(kind)];
}

std::optional<ContactModelKind> contactModelKind(std::string_view name) noexcept
{
    const auto at = std::find(kNames.begin(), kNames.end(), name);
    return at == kNames.end()
               ? std::nullopt
               : std::optional(kContactModelKinds[static_cast<std::size_t>(at - kNames.begin())]);
}

std::unique_ptr<ContactModel> makeContactModel(ContactModelKind kind,
                                               const HeightfieldSurface& surface,
                                               const ContactModelOptions& options)
{
    const auto terrain = surface.terrain();
    if (PlainHeights<std::int16_t>::canRead(*terrain)) {
        return make(
            kind,
            PlainHeightfieldSurface<std::int16_t>(terrain, surface.frame(), surface.exaggeration()),
            options);
    }
    if (PlainHeights<float>::canRead(*terrain)) {
        return make(
            kind, PlainHeightfieldSurface<float>(terrain, surface.frame(), surface.exaggeration()),
            options);
    }
    return make(kind, surface, options);
}

} // namespace marsview
