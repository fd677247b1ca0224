#include "core/session/joined_maps.h"

#include <algorithm>
#include <numeric>

namespace marsview {
namespace {

// Some sample of the border of one map lies over the other. Of two areas that overlap, at least one
// has such a sample, unless their borders cross between samples only.
bool isBorderOver(const BodyTerrain& map, const BodyTerrain& other)
{
    const Georeference& georeference = map.map()->georeference();
    const auto is_over = [&](std::size_t column, std::size_t row) {
        const auto place =
            georeference.toGeographic({static_cast<double>(column), static_cast<double>(row)});
        return place && other.gridAt(*place);
    };
    const std::size_t last_column = georeference.columns() - 1;
    const std::size_t last_row = georeference.rows() - 1;
    for (std::size_t column = 0; column <= last_column; ++column) {
        if (is_over(column, 0) || is_over(column, last_row)) {
            return true;
        }
    }
    for (std::size_t row = 1; row < last_row; ++row) {
        if (is_over(0, row) || is_over(last_column, row)) {
            return true;
        }
    }
    return false;
}

} // namespace

bool doOverlap(const BodyTerrain& a, const BodyTerrain& b)
{
    return isBorderOver(a, b) || isBorderOver(b, a);
}

std::vector<std::vector<std::size_t>> pilesOf(const BodyScene& scene,
                                              const std::vector<std::size_t>& indexes)
{
    std::vector<std::size_t> piles(indexes.size()); // the pile of each
    std::iota(piles.begin(), piles.end(), std::size_t{0});
    for (std::size_t i = 0; i < indexes.size(); ++i) {
        for (std::size_t k = i + 1; k < indexes.size(); ++k) {
            if (piles[i] != piles[k] &&
                doOverlap(scene.maps()[indexes[i]], scene.maps()[indexes[k]])) {
                const auto [kept, other] = std::minmax({piles[i], piles[k]});
                std::replace(piles.begin(), piles.end(), other, kept);
            }
        }
    }
    std::vector<std::vector<std::size_t>> result;
    for (std::size_t pile = 0; pile < indexes.size(); ++pile) {
        std::vector<std::size_t> members;
        for (std::size_t i = 0; i < indexes.size(); ++i) {
            if (piles[i] == pile) {
                members.push_back(indexes[i]);
            }
        }
        if (members.size() > 1) {
            result.push_back(std::move(members));
        }
    }
    return result;
}

} // namespace marsview
