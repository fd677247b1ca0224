// The common base of all contact models: placing, moving, refusing goals and reporting.
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_surface.h"

#include <utility>

namespace marsview {

/// The base of a contact model over a surface. `Model` derives from it, makes it a friend and has
///   placeAt(g, p)   the first update of a model: the goal is g, computed from p
///   moveTo(g, p)    every later update
///   feature()       the feature that the proxy rests on
///   position()      the proxy's position
///
/// A value, for one thread at a time. `update` and `place` allocate, lock and throw nothing and are
/// bounded: they are safe on the servo thread. A descent takes at most S::stepsMax() steps. The
/// continuous walk takes at most as many of its own, and one of these may end in a fall, which is a
/// descent.
template <typename Model, ContactSurface S>
class SurfaceProxy {
public:
    const S& surface() const noexcept { return surface_; }

    /// Puts the proxy at the goal if that is above the surface, else on the surface straight above
    /// the goal, and minimizes the distance from there. A goal that is not finite, or that S::goal
    /// refuses, changes nothing and is counted as refused.
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

    /// Moves the proxy towards the goal. The first update places it. Goals that place() refuses
    /// change nothing and are counted as refused: the proxy and its contact state are those of the
    /// last update.
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
