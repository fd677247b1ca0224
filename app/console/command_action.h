// What a command of marsview-cli does.
#pragma once

#include "core/base/result.h"

#include <functional>

namespace marsview {

/// What the chosen command does once the arguments are parsed.
using CommandAction = std::function<Status()>;

} // namespace marsview
