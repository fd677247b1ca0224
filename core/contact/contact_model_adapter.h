// Adapts contact models to the interfaces of contact_model.h, for the files that create them.
#pragma once

#include "core/base/check.h"
#include "core/contact/contact_model.h"
#include "core/contact/continuous_walk.h"
#include "core/contact/god_object.h"
#include "core/contact/proxy_graph.h"
#include "core/contact/proxy_graph_2003.h"
#include "core/contact/surface_walk.h"
#include "core/contact/virtual_proxy.h"

#include <memory>
#include <utility>

namespace marsview {

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
    ContactState rehearse(const ScenePoint& goal) const noexcept override
    {
        return M(model_).update(goal);
    }
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
    void terrainChanged() noexcept override { this->model_.setSurface(this->model_.surface()); }
};

template <typename M>
using HeldOverMesh = Held<ContactModel, M>;

// `H<M>` holds a model M.
template <template <typename> typename H, typename Interface, typename S>
std::unique_ptr<Interface>
makeHeld(ContactModelKind kind, const S& surface, const ContactModelOptions& options)
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
    case ContactModelKind::ProxyGraph2003:
        return std::make_unique<H<ProxyGraph2003<S>>>(surface);
    }
    MARSVIEW_CHECK(false);
}

/// Over a surface S of the same terrain, which reads its samples faster than `surface`.
template <typename S, typename Surface>
std::unique_ptr<MapContactModel>
makeHeldOverMap(ContactModelKind kind, const Surface& surface, const ContactModelOptions& options)
{
    return makeHeld<HeldOverMap, MapContactModel>(
        kind, S(surface.terrain(), surface.frame(), surface.exaggeration()), options);
}

} // namespace marsview
