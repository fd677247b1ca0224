#include "tests/support/reference_surface.h"

namespace marsview::test {
namespace {

using Point = std::array<long double, 3>;

Point minus(const Point& a, const Point& b)
{
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

} // namespace

long double planeHeight(const CornerHeights& z, long double x, long double y)
{
    const Point a{0.0L, 0.0L, z[0]};
    const Point b{1.0L, 1.0L, z[3]};
    const bool is_right_of_diagonal = x > y;
    const Point c = is_right_of_diagonal ? Point{1.0L, 0.0L, z[1]} : Point{0.0L, 1.0L, z[2]};
    const Point ab = minus(b, a);
    const Point ac = minus(c, a);
    // Normal of the plane, and the height where normal · (p - a) = 0.
    const Point n{ab[1] * ac[2] - ab[2] * ac[1], ab[2] * ac[0] - ab[0] * ac[2],
                  ab[0] * ac[1] - ab[1] * ac[0]};
    return z[0] - (n[0] * x + n[1] * y) / n[2];
}

} // namespace marsview::test
