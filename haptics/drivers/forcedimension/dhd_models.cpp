#include "haptics/drivers/forcedimension/dhd_models.h"

namespace marsview {
namespace {

constexpr std::string_view kPit =
    "is not calibrated; put the end effector into its rest position, the calibration pole in its "
    "pit";
constexpr std::string_view kFalcon =
    "is not calibrated; pull the grip out and push it in all the way";

constexpr DhdModel kFalconModel{"Novint Falcon", 0.04, 8.0, 3000.0, kFalcon};
constexpr DhdModel kOmega3{"Force Dimension omega.3", 0.075, 12.0, 5000.0, kPit};
constexpr DhdModel kOmega6{"Force Dimension omega.6", 0.075, 12.0, 4000.0, kPit};
constexpr DhdModel kOmega7{"Force Dimension omega.7", 0.075, 12.0, 4000.0, kPit};
constexpr DhdModel kDelta3{"Force Dimension delta.3", 0.15, 20.0, 4000.0, kPit};
constexpr DhdModel kDelta6{"Force Dimension delta.6", 0.15, 20.0, 4000.0, kPit};
constexpr DhdModel kUnknown{"Force Dimension device", 0.075, 8.0, 1000.0, kPit};

} // namespace

const DhdModel& dhdModel(int type) noexcept
{
    switch (type) {
    case 60:
        return kFalconModel;
    case 32:
    case 33:
        return kOmega3;
    case 34:
    case 36:
        return kOmega6;
    case 35:
    case 37:
        return kOmega7;
    case 31:
    case 63:
        return kDelta3;
    case 61:
    case 62:
    case 64:
        return kDelta6;
    default:
        return kUnknown;
    }
}

} // namespace marsview
