// A layer that cannot be shown on its body.
#pragma once

#include "core/session/map.h"

#include <QString>

#include <memory>

namespace marsview {

struct UnplacedLayer {
    std::shared_ptr<const Map> map;
    QString problem; // of the core: "has …"
};

} // namespace marsview
