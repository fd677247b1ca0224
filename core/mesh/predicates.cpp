// Notation as in Shewchuk's paper: an expansion is a sum of doubles that do not overlap, of
// increasing magnitude, so that its sign is that of the last one. Zeros are dropped.

#include "core/mesh/predicates.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace marsview {
namespace {

constexpr double kUnit = std::numeric_limits<double>::epsilon() / 2.0;

template <std::size_t N>
struct Expansion {
    std::array<double, N> terms;
    std::size_t count = 0;

    void push(double term) noexcept
    {
        if (term != 0.0) {
            terms[count++] = term;
        }
    }
    int sign() const noexcept { return count == 0 ? 0 : terms[count - 1] > 0.0 ? 1 : -1; }
};

struct Pair {
    double high;
    double low;
};

Pair twoSum(double a, double b) noexcept
{
    const double sum = a + b;
    const double b_virtual = sum - a;
    const double a_virtual = sum - b_virtual;
    return {sum, (a - a_virtual) + (b - b_virtual)};
}

Pair twoProduct(double a, double b) noexcept
{
    const double product = a * b;
    return {product, std::fma(a, b, -product)};
}

Expansion<2> difference(double a, double b) noexcept
{
    const Pair d = twoSum(a, -b);
    Expansion<2> e;
    e.push(d.low);
    e.push(d.high);
    return e;
}

template <std::size_t N, std::size_t M>
Expansion<N + M> sum(const Expansion<N>& e, const Expansion<M>& f, double sign_of_f = 1.0) noexcept
{
    Expansion<N + M> result;
    std::size_t i = 0;
    std::size_t j = 0;
    const auto next = [&] {
        if (j == f.count || (i < e.count && std::abs(e.terms[i]) < std::abs(f.terms[j]))) {
            return e.terms[i++];
        }
        return sign_of_f * f.terms[j++];
    };
    const std::size_t total = e.count + f.count;
    if (total == 0) {
        return result;
    }
    double q = next();
    for (std::size_t k = 1; k < total; ++k) {
        const Pair s = twoSum(q, next());
        result.push(s.low);
        q = s.high;
    }
    result.push(q);
    return result;
}

template <std::size_t N>
Expansion<2 * N> scaled(const Expansion<N>& e, double factor) noexcept
{
    Expansion<2 * N> result;
    double q = 0.0;
    for (std::size_t i = 0; i < e.count; ++i) {
        const Pair product = twoProduct(e.terms[i], factor);
        const Pair low = twoSum(q, product.low);
        result.push(low.low);
        const Pair high = twoSum(product.high, low.high);
        result.push(high.low);
        q = high.high;
    }
    result.push(q);
    return result;
}

template <std::size_t N, std::size_t M>
Expansion<2 * N * M> product(const Expansion<N>& e, const Expansion<M>& f) noexcept
{
    if constexpr (M == 1) {
        return f.count > 0 ? scaled(e, f.terms[0]) : Expansion<2 * N>{};
    } else {
        constexpr std::size_t kHalf = M / 2;
        Expansion<kHalf> low{};
        Expansion<M - kHalf> high{};
        for (std::size_t i = 0; i < f.count; ++i) {
            i < kHalf ? low.push(f.terms[i]) : high.push(f.terms[i]);
        }
        return sum(product(e, low), product(e, high));
    }
}

int signOf(double value) noexcept
{
    return value > 0.0 ? 1 : value < 0.0 ? -1 : 0;
}

// `difference` gives the coordinates of a corner, relative to the point.
template <typename Difference>
int exactSideOfPlane(const Vec3& a,
                     const Vec3& b,
                     const Vec3& c,
                     const Difference& difference_at) noexcept
{
    const auto minor = [](const auto& x1, const auto& y1, const auto& x2, const auto& y2) {
        return sum(product(x1, y2), product(y1, x2), -1.0);
    };
    const auto ax = difference_at(a, &Vec3::x);
    const auto ay = difference_at(a, &Vec3::y);
    const auto bx = difference_at(b, &Vec3::x);
    const auto by = difference_at(b, &Vec3::y);
    const auto cx = difference_at(c, &Vec3::x);
    const auto cy = difference_at(c, &Vec3::y);
    const auto from_a = product(minor(bx, by, cx, cy), difference_at(a, &Vec3::z));
    const auto from_b = product(minor(cx, cy, ax, ay), difference_at(b, &Vec3::z));
    const auto from_c = product(minor(ax, ay, bx, by), difference_at(c, &Vec3::z));
    return -sum(sum(from_a, from_b), from_c).sign();
}

// The side of the origin if doubles can decide it; otherwise 0.
int quickSideOfPlane(const Vec3& ap, const Vec3& bp, const Vec3& cp, double bound) noexcept
{
    const double bxcy = bp.x * cp.y;
    const double cxby = cp.x * bp.y;
    const double cxay = cp.x * ap.y;
    const double axcy = ap.x * cp.y;
    const double axby = ap.x * bp.y;
    const double bxay = bp.x * ap.y;
    const double determinant = ap.z * (bxcy - cxby) + bp.z * (cxay - axcy) + cp.z * (axby - bxay);
    const double magnitude = (std::abs(bxcy) + std::abs(cxby)) * std::abs(ap.z) +
                             (std::abs(cxay) + std::abs(axcy)) * std::abs(bp.z) +
                             (std::abs(axby) + std::abs(bxay)) * std::abs(cp.z);
    return std::abs(determinant) > bound * magnitude ? -signOf(determinant) : 0;
}

} // namespace

int sideOfPlane(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) noexcept
{
    constexpr double kBound = (7.0 + 56.0 * kUnit) * kUnit; // Shewchuk's o3derrboundA
    const int side = quickSideOfPlane(a - p, b - p, c - p, kBound);
    return side != 0 ? side : exactSideOfPlane(a, b, c, [&p](const Vec3& from, double Vec3::*axis) {
        return difference(from.*axis, p.*axis);
    });
}

int sideOfPlane(
    const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p, const Vec3& rest) noexcept
{
    return rest == Vec3{} ? sideOfPlane(a, b, c, p)
                          : exactSideOfPlane(a, b, c, [&](const Vec3& from, double Vec3::*axis) {
                                Expansion<1> minus;
                                minus.push(-(rest.*axis));
                                return sum(difference(from.*axis, p.*axis), minus);
                            });
}

int sideOfLine(double ax, double ay, double bx, double by, double px, double py) noexcept
{
    const double left = (ax - px) * (by - py);
    const double right = (ay - py) * (bx - px);
    const double determinant = left - right;
    constexpr double kBound = (3.0 + 16.0 * kUnit) * kUnit; // Shewchuk's ccwerrboundA
    if (std::abs(determinant) > kBound * (std::abs(left) + std::abs(right))) {
        return signOf(determinant);
    }
    return sum(product(difference(ax, px), difference(by, py)),
               product(difference(ay, py), difference(bx, px)), -1.0)
        .sign();
}

int signOfDeterminant(double a, double b, double c, double d) noexcept
{
    const double left = a * d;
    const double right = b * c;
    const double determinant = left - right;
    if (std::abs(determinant) > 4.0 * kUnit * (std::abs(left) + std::abs(right))) {
        return signOf(determinant);
    }
    const Pair exact_left = twoProduct(a, d);
    const Pair exact_right = twoProduct(b, c);
    Expansion<2> e;
    e.push(exact_left.low);
    e.push(exact_left.high);
    Expansion<2> f;
    f.push(exact_right.low);
    f.push(exact_right.high);
    return sum(e, f, -1.0).sign();
}

bool areCollinear(const Vec3& a, const Vec3& b, const Vec3& c) noexcept
{
    return sideOfLine(a.x, a.y, b.x, b.y, c.x, c.y) == 0 &&
           sideOfLine(a.y, a.z, b.y, b.z, c.y, c.z) == 0 &&
           sideOfLine(a.z, a.x, b.z, b.x, c.z, c.x) == 0;
}

} // namespace marsview
