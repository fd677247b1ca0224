// The common base of contact models whose proxy is a point.
#pragma once

#include "core/contact/contact.h"
#include "core/contact/contact_surface.h"
#include "core/contact/surface_proxy.h"

#include <concepts>
#include <optional>
#include <utility>

namespace marsview {

/// The path from a position on the surface to a local minimum, within one update. `descend` returns
/// true if it ended at the goal, in free space; otherwise the contact is the minimum.
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

/// A proxy that cannot pass through a surface. Each update moves it straight through free space to
/// the goal. From where it meets the surface, or from its position on it, `Descent` moves it to a
/// local minimum of the distance to the goal.
template <ContactSurface S, SurfaceDescent<S> Descent>
class PointProxy : public SurfaceProxy<PointProxy<S, Descent>, S> {
    using Base = SurfaceProxy<PointProxy, S>;
    friend Base;

public:
    /// The proxy begins at S::initialContact(); the first update places it.
    explicit PointProxy(S surface) noexcept
        : Base(std::move(surface))
        , contact_(surface_.initialContact())
    {}

    /// Another surface with the same mesh, such as another exaggeration. In contact, the proxy
    /// stays where it is on the mesh and moves with it. A free proxy keeps its scene coordinates;
    /// if it would be below the surface, it is moved straight up onto it.
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

    /// Where the proxy touches; empty while it is free.
    std::optional<SurfaceContact<S>> contact() const noexcept
    {
        return free_ ? std::nullopt : std::optional(contact_);
    }

private:
    using Goal = typename S::Goal;
    using Base::counters_;
    using Base::surface_;

    void placeAt(const Goal& goal, const ScenePoint& /*aimed*/) noexcept
    {
        free_.reset();
        if (surface_.isAbove(goal)) {
            free_ = goal;
        } else {
            contact_ = surface_.contactAt(goal);
            descend(goal);
        }
    }

    void moveTo(const Goal& goal, const ScenePoint& /*aimed*/) noexcept
    {
        if (!free_) {
            descend(goal);
            return;
        }
        ++counters_.casts;
        const SurfaceCast<S> cast = surface_.castFree(*free_, goal);
        counters_.cells += cast.cells;
        free_ = goal;
        if (cast.contact) {
            contact_ = *cast.contact;
            descend(goal);
        }
    }

    ContactFeature feature() const noexcept
    {
        return free_ ? ContactFeature::Free : contact_.feature;
    }
    ScenePoint position() const noexcept
    {
        return free_ ? surface_.goalPoint(*free_) : surface_.point(contact_);
    }

    void descend(const Goal& goal) noexcept
    {
        free_.reset();
        if (Descent(surface_, counters_).descend(contact_, goal)) {
            free_ = goal;
        }
    }

    std::optional<Goal> free_;  // the proxy's position while free
    SurfaceContact<S> contact_; // the proxy's position otherwise
};

} // namespace marsview
