// What all contact models have in common: placing, moving, refusing and telling.
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_surface.h"

#include <utility>

namespace marsview {

/// The base of a contact model over a surface. `Model` derives from it, makes it a friend and has
///   placeAt(g, p)   the first update of a model: the goal is g, aimed at was p
///   moveTo(g, p)    every other
///   feature()       what the proxy rests on
///   position()      where it is
///
/// A value, for one thread at a time. `update` and `place` allocate, lock and throw nothing and are
/// bounded by S::stepsMax(): they are for the servo thread.
template <typename Model, ContactSurface S>
class SurfaceProxy {
public:
    const S& surface() const noexcept { return surface_; }

    /// Puts the proxy at the goal if that is above the surface, else on the surface straight above
    /// the goal, and minimises from there. A goal that is not finite, or that the surface cannot
    /// aim at (S::goal), changes nothing and is counted as refused.
    ContactState place(const ScenePoint& goal) noexcept
    {
        counters_ = {};
        if (const auto g = surface_.goal(goal)) {
            is_placed_ = true;
            model().placeAt(*g, goal);
        } else {
            counters_.refused = 1;
        }
        return state();
    }

    /// Moves the proxy towards the goal. The first update places it. What place() refuses
    /// changes nothing and is counted as refused: the proxy, and whether it is in contact, are
    /// those of the last update.
    ContactState update(const ScenePoint& goal) noexcept
    {
        if (!is_placed_) {
            return place(goal);
        }
        counters_ = {};
        if (const auto g = surface_.goal(goal)) {
            model().moveTo(*g, goal);
        } else {
            counters_.refused = 1;
        }
        return state();
    }

    /// Where the proxy is, with the counters of the last update.
    ContactState state() const noexcept
    {
        const auto& model = static_cast<const Model&>(*this);
        ContactState state;
        state.proxy = model.position();
        state.feature = model.feature();
        state.is_in_contact = state.feature != ContactFeature::Free;
        state.counters = counters_;
        return state;
    }

protected:
    explicit SurfaceProxy(S surface) noexcept
        : surface_(std::move(surface))
    {}

    bool isPlaced() const noexcept { return is_placed_; }

    S surface_;
    ContactCounters counters_;

private:
    Model& model() noexcept { return static_cast<Model&>(*this); }

    bool is_placed_ = false;
};

} // namespace marsview
