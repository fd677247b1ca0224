// Creates the compared models of contact_model_adapter.h, for the files that instantiate them.
#pragma once

#include "core/base/check.h"
#include "core/contact/contact_model_adapter.h"
#include "core/contact/proxy_graph_2003.h"
#include "core/contact/virtual_proxy.h"

#include <memory>

namespace marsview {

template <typename Interface, typename S>
std::unique_ptr<Interface>
makeComparedModel(ContactModelKind kind, const S& surface, const ContactModelOptions& options)
{
    if (kind == ContactModelKind::VirtualProxy) {
        return std::make_unique<HeldAs<Interface, VirtualProxy<S>>>(surface, options.radius_m);
    }
    MARSVIEW_CHECK(kind == ContactModelKind::ProxyGraph2003);
    return std::make_unique<HeldAs<Interface, ProxyGraph2003<S>>>(surface);
}

} // namespace marsview
