// A haptics program in the form that the examples of CHAI3D have: a device, a world with one
// object, a haptics loop that reads the position, computes the force and sends it. Replace Device
// by the class of your device.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <marsview/contact.h>
#include <vector>

using marsview::contact::Contact;
using marsview::contact::ContactModel;
using marsview::contact::Grid;
using marsview::contact::SampleType;
using marsview::contact::Surface;
using marsview::contact::Vector;

namespace {

// Draws a line through the crater, 2 mm below the highest plane of the rim, in two seconds.
class Device {
public:
    bool getPosition(Vector& position_m)
    {
        const double share = static_cast<double>(tick_) / kTicks;
        position_m = {-0.05 + 0.1 * share, 0.003, 0.002};
        return tick_++ < kTicks;
    }
    void setForce(const Vector& force_n)
    {
        largest_n_ = std::max(largest_n_, std::hypot(force_n.x, force_n.y, force_n.z));
        sum_x_n_ += force_n.x;
    }
    double largestForce() const { return largest_n_; }
    double meanSidewardForce() const { return sum_x_n_ / kTicks; }

private:
    static constexpr int kTicks = 2000; // one per millisecond
    int tick_ = 0;
    double largest_n_ = 0.0;
    double sum_x_n_ = 0.0;
};

// A round crater with a rim: 10 cm wide in the workspace of the device, elevations in meters.
std::vector<float> makeCrater(std::size_t side)
{
    std::vector<float> heights_m;
    for (std::size_t row = 0; row < side; ++row) {
        for (std::size_t column = 0; column < side; ++column) {
            const double middle = 0.5 * static_cast<double>(side - 1);
            const double from_middle = std::hypot(static_cast<double>(column) - middle,
                                                  static_cast<double>(row) - middle) /
                                       middle; // 1 at the border
            const double rim = std::exp(-std::pow((from_middle - 0.5) / 0.1, 2.0));
            const double bowl = from_middle < 0.5 ? 4.0 * from_middle * from_middle - 1.0 : 0.0;
            heights_m.push_back(static_cast<float>(0.004 * rim + 0.006 * bowl));
        }
    }
    return heights_m;
}

} // namespace

int main()
{
    constexpr std::size_t kSide = 201;
    const std::vector<float> heights_m = makeCrater(kSide);
    Grid grid;
    grid.samples = heights_m.data();
    grid.type = SampleType::Float32;
    grid.columns = kSide;
    grid.rows = kSide;
    grid.cell_x_m = 0.0005;
    grid.cell_y_m = -0.0005;
    grid.origin_x_m = -0.05;
    grid.origin_y_m = 0.05;
    const Surface crater = Surface::fromGrid(grid);
    ContactModel model(crater);

    constexpr double kStiffnessNPerM = 500.0;
    Device device;
    Vector position_m;
    int in_contact = 0;
    while (device.getPosition(position_m)) {
        const Contact contact = model.update(position_m);
        Vector force_n;
        if (contact.is_in_contact) {
            const double force = kStiffnessNPerM * contact.distance_m;
            force_n = {force * contact.force_direction.x, force * contact.force_direction.y,
                       force * contact.force_direction.z};
            ++in_contact;
        }
        device.setForce(force_n);
    }
    std::printf("MarsView %s: %d of 2000 updates in contact, at most %.3f N, sideward %.6f N\n",
                marsview::contact::version(), in_contact, device.largestForce(),
                device.meanSidewardForce());
    return 0;
}
