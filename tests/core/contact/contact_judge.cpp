#include "tests/core/contact/contact_judge.h"

#include <cstdio>

namespace marsview::test {

void Findings::add(const Findings& o)
{
    updates += o.updates;
    contacts += o.contacts;
    casts += o.casts;
    vertices += o.vertices;
    faces += o.faces;
    far_edges += o.far_edges;
    far_loops += o.far_loops;
    growths += o.growths;
    far_growths += o.far_growths;
    cut_short += o.cut_short;
    not_minimal += o.not_minimal;
    rests += o.rests;
    rest_moves += o.rest_moves;
    passages += o.passages;
    height_m = std::max(height_m, o.height_m);
    height_share = std::max(height_share, o.height_share);
    place_m = std::max(place_m, o.place_m);
    foot_m = std::max(foot_m, o.foot_m);
    cosine = std::max(cosine, o.cosine);
    pull_share = std::max(pull_share, o.pull_share);
    growth_m = std::max(growth_m, o.growth_m);
    growth_share = std::max(growth_share, o.growth_share);
    distance_m = std::max(distance_m, o.distance_m);
    rest_move_m = std::max(rest_move_m, o.rest_move_m);
}

void Findings::print(const std::string& name) const
{
    std::printf(
        "%-34s %ld updates, %ld in contact, %.2f faces, %.2f vertices, %.2f casts each; worst: "
        "height %.1Lg m (%.2Lf), place %.1Lg m, foot %.1Lg m, cosine %.1Lg (%.2Lf), growth %.1Lg m "
        "(%.2Lf, %ld times), distance %.1Lg m; far edges %ld, loops %ld, growths %ld; rests %ld, "
        "moved %ld (%.1Lg m); free ways %ld\n",
        name.c_str(), updates, contacts,
        static_cast<double>(faces) / static_cast<double>(std::max(contacts, 1L)),
        static_cast<double>(vertices) / static_cast<double>(std::max(contacts, 1L)),
        static_cast<double>(casts) / static_cast<double>(std::max(contacts, 1L)), height_m,
        height_share, place_m, foot_m, cosine, pull_share, growth_m, growth_share, growths,
        distance_m, far_edges, far_loops, far_growths, rests, rest_moves, rest_move_m, passages);
}

} // namespace marsview::test
