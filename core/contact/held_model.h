// Adapts contact models to the interfaces of contact_model.h.
#pragma once

#include "core/contact/contact_model.h"

#include <type_traits>
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
    void terrainChanged() noexcept override { model_.setSurface(model_.surface()); }

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

template <typename Interface, typename M>
using HeldAs = std::
    conditional_t<std::is_same_v<Interface, MapContactModel>, HeldOverMap<M>, Held<Interface, M>>;

} // namespace marsview
