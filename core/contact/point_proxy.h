// What the contact models with a point for a proxy have in common.
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_surface.h"

#include <concepts>
#include <optional>
#include <utility>

namespace marsview {

/// The way from a place on the surface to a local minimum, one update long. `descend` is true where
/// it ended at the goal, in free space; otherwise the contact is the minimum.
template <typename D, typename S>
concept SurfaceDescent = requires(D descent,
                                  const S& surface,
                                  ContactCounters& counters,
                                  SurfaceContact<S>& contact,
                                  const typename S::Goal& goal)
{
    D(surface, counters);
    {
        descent.descend(contact, goal)
    }
    noexcept->std::same_as<bool>;
};

/// Holds a proxy that cannot pass through a surface. Each update moves it straight through free
/// space to the goal, and from where it meets the surface, or from where it was on it, by `Descent`
/// to a local minimum of the distance to the goal.
///
/// A value, for one thread at a time. `update` and `place` allocate, lock and throw nothing and are
/// bounded by S::stepsMax(): they are for the servo thread.
template <ContactSurface S, SurfaceDescent<S> Descent>
class PointProxy {
public:
    /// The proxy begins at S::initialContact(); the first update places it.
    explicit PointProxy(S surface) noexcept
        : surface_(std::move(surface))
        , contact_(surface_.initialContact())
    {}

    const S& surface() const noexcept { return surface_; }

    /// Another surface with the same mesh, such as another exaggeration. In contact, the proxy
    /// stays where it is on the mesh and moves with it. A free proxy keeps its scene coordinates;
    /// if it would be below the surface, it is put onto it, straight above.
    void setSurface(S surface) noexcept
    {
        surface_ = std::move(surface);
        if (free_) {
            free_ = surface_.goal(surface_.goalPoint(*free_));
            if (free_ && !surface_.isAbove(*free_)) {
                contact_ = surface_.contactAt(*free_);
                free_.reset();
            }
        }
    }

    /// Puts the proxy at the goal if that is above the surface, else on the surface straight above
    /// the goal, and minimises from there. A goal that is not finite changes nothing and is counted
    /// as refused.
    ContactState place(const ScenePoint& goal) noexcept
    {
        counters_ = {};
        if (const auto g = surface_.goal(goal)) {
            is_placed_ = true;
            free_.reset();
            if (surface_.isAbove(*g)) {
                free_ = g;
            } else {
                contact_ = surface_.contactAt(*g);
                descend(*g);
            }
        } else {
            counters_.refused = 1;
        }
        return state();
    }

    /// Moves the proxy towards the goal. A goal that is not finite changes nothing and is counted
    /// as refused: the proxy, and whether it is in contact, are those of the last update.
    ContactState update(const ScenePoint& goal) noexcept
    {
        if (!is_placed_) {
            return place(goal);
        }
        counters_ = {};
        if (const auto g = surface_.goal(goal)) {
            if (!free_) {
                descend(*g);
            } else {
                ++counters_.casts;
                const SurfaceCast<S> cast = surface_.castFree(*free_, *g);
                counters_.cells += cast.cells;
                free_ = g;
                if (cast.contact) {
                    contact_ = *cast.contact;
                    descend(*g);
                }
            }
        } else {
            counters_.refused = 1;
        }
        return state();
    }

    /// Where the proxy touches; nothing while it is free.
    std::optional<SurfaceContact<S>> contact() const noexcept
    {
        return free_ ? std::nullopt : std::optional(contact_);
    }

    /// Where the proxy is, with the counters of the last update.
    ContactState state() const noexcept
    {
        ContactState state;
        state.is_in_contact = !free_;
        state.feature = free_ ? ContactFeature::Free : contact_.feature;
        state.proxy = free_ ? surface_.goalPoint(*free_) : surface_.point(contact_);
        state.counters = counters_;
        return state;
    }

private:
    using Goal = typename S::Goal;

    void descend(const Goal& goal) noexcept
    {
        free_.reset();
        if (Descent(surface_, counters_).descend(contact_, goal)) {
            free_ = goal;
        }
    }

    S surface_;
    std::optional<Goal> free_;  // where the proxy is while free
    SurfaceContact<S> contact_; // where it is otherwise
    ContactCounters counters_;
    bool is_placed_ = false;
};

} // namespace marsview
