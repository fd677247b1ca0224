// Creates contact models over each kind of surface, for the files that include it.
#pragma once

#include "core/contact/contact_model.h"
#include "core/contact/continuous_walk.h"
#include "core/contact/god_object.h"
#include "core/contact/held_model.h"
#include "core/contact/proxy_graph.h"
#include "core/contact/surface_walk.h"

#include <memory>
#include <utility>

namespace marsview {

/// The paper's algorithm to the letter and the virtual proxy. Compiled apart (compared_models.h),
/// with the usual limits of inlining: the raised ones take twice the time to compile and gain
/// nothing.
template <typename Interface, typename S>
std::unique_ptr<Interface>
makeComparedModel(ContactModelKind kind, const S& surface, const ContactModelOptions& options);

template <typename Interface, typename S>
std::unique_ptr<Interface>
makeModel(ContactModelKind kind, const S& surface, const ContactModelOptions& options)
{
    switch (kind) {
    case ContactModelKind::ProxyGraph:
        return std::make_unique<HeldAs<Interface, ProxyGraph<S>>>(surface);
    case ContactModelKind::SurfaceWalk:
        return std::make_unique<HeldAs<Interface, SurfaceWalk<S>>>(surface);
    case ContactModelKind::ContinuousWalk:
        return std::make_unique<HeldAs<Interface, ContinuousWalk<S>>>(surface);
    case ContactModelKind::GodObject:
        return std::make_unique<HeldAs<Interface, GodObject<S>>>(surface,
                                                                 GodObjectConstraints::Kept);
    case ContactModelKind::GodObjectRelease:
        return std::make_unique<HeldAs<Interface, GodObject<S>>>(surface,
                                                                 GodObjectConstraints::Released);
    case ContactModelKind::VirtualProxy:
    case ContactModelKind::ProxyGraph2003:
        break;
    }
    return makeComparedModel<Interface>(kind, surface, options);
}

/// Over a surface S of the same terrain, which reads its samples faster than `surface`.
template <typename S, typename Surface>
std::unique_ptr<MapContactModel>
makeMapModel(ContactModelKind kind, const Surface& surface, const ContactModelOptions& options)
{
    return makeModel<MapContactModel>(
        kind, S(surface.terrain(), surface.frame(), surface.exaggeration()), options);
}

} // namespace marsview
