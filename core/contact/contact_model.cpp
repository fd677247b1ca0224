#include "core/contact/contact_model.h"

#include "core/base/check.h"
#include "core/contact/continuous_walk.h"
#include "core/contact/god_object.h"
#include "core/contact/proxy_graph.h"
#include "core/contact/surface_walk.h"
#include "core/contact/virtual_proxy.h"

#include <algorithm>
#include <iterator>

namespace marsview {
namespace {

constexpr std::array<std::string_view, kContactModelKinds.size()> kNames{
    "proxy-graph", "surface-walk",       "continuous-walk",
    "god-object",  "god-object-release", "virtual-proxy",
};

// `Base` is the interface, M the model.
template <typename Base, typename M>
class Held : public Base {
public:
    template <typename... Arguments>
    explicit Held(Arguments&&... arguments)
        : model_(std::forward<Arguments>(arguments)...)
    {}
    ContactState place(const ScenePoint& goal) noexcept override { return model_.place(goal); }
    ContactState update(const ScenePoint& goal) noexcept override { return model_.update(goal); }
    ContactState state() const noexcept override { return model_.state(); }

protected:
    M model_;
};

template <typename M>
class HeldOverMap final : public Held<MapContactModel, M> {
public:
    using Held<MapContactModel, M>::Held;

    void setExaggeration(double exaggeration) noexcept override
    {
        auto surface = this->model_.surface();
        this->model_.setSurface({surface.terrain(), surface.frame(), exaggeration});
    }
};

template <typename M>
using HeldOverMesh = Held<ContactModel, M>;

// `H<M>` holds a model M.
template <template <typename> typename H, typename Interface, typename S>
std::unique_ptr<Interface>
make(ContactModelKind kind, const S& surface, const ContactModelOptions& options)
{
    switch (kind) {
    case ContactModelKind::ProxyGraph:
        return std::make_unique<H<ProxyGraph<S>>>(surface);
    case ContactModelKind::SurfaceWalk:
        return std::make_unique<H<SurfaceWalk<S>>>(surface);
    case ContactModelKind::ContinuousWalk:
        return std::make_unique<H<ContinuousWalk<S>>>(surface);
    case ContactModelKind::GodObject:
        return std::make_unique<H<GodObject<S>>>(surface, GodObjectConstraints::Kept);
    case ContactModelKind::GodObjectRelease:
        return std::make_unique<H<GodObject<S>>>(surface, GodObjectConstraints::Released);
    case ContactModelKind::VirtualProxy:
        return std::make_unique<H<VirtualProxy<S>>>(surface, options.radius_m);
    }
    MARSVIEW_CHECK(false);
}

template <typename S>
std::unique_ptr<MapContactModel> makeOverMap(ContactModelKind kind,
                                             const HeightfieldSurface& surface,
                                             const ContactModelOptions& options)
{
    return make<HeldOverMap, MapContactModel>(
        kind, S(surface.terrain(), surface.frame(), surface.exaggeration()), options);
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
                                               const MeshSurface& surface,
                                               const ContactModelOptions& options)
{
    return make<HeldOverMesh, ContactModel>(kind, surface, options);
}

std::unique_ptr<MapContactModel> makeContactModel(ContactModelKind kind,
                                                  const HeightfieldSurface& surface,
                                                  const ContactModelOptions& options)
{
    if (PlainHeights<std::int16_t>::canRead(*surface.terrain())) {
        return makeOverMap<PlainHeightfieldSurface<std::int16_t>>(kind, surface, options);
    }
    if (PlainHeights<float>::canRead(*surface.terrain())) {
        return makeOverMap<PlainHeightfieldSurface<float>>(kind, surface, options);
    }
    return makeOverMap<HeightfieldSurface>(kind, surface, options);
}

} // namespace marsview
