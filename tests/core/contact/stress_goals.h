// Goals that put a contact model under stress.
#pragma once

#include "tests/core/contact/contact_truth.h"
#include "tests/support/random.h"

#include <array>

namespace marsview::test {

/// An endless stream of valid goals over a heightfield: random walks with steps from a thousandth
/// of a cell to dozens of cells, shallow and deep; straight sweeps over the map and beyond its
/// border; jumps from anywhere to anywhere; points on samples, edges, diagonals and borders,
/// exactly on the surface or slightly off it; points whose foot is exactly a corner, on an edge or
/// inside a face; goals up to 1e12 m away; straight dives; and rests.
class StressGoals {
public:
    StressGoals(Random& random, const HeightfieldTruth& truth);

    ScenePoint next();

private:
    enum class Motion { Wander, Sweep, Jump, Lattice, Foot, Far, Dive, Rest };

    void begin();
    ScenePoint wandering();
    ScenePoint jumping();
    ScenePoint onLattice();
    ScenePoint overFoot();
    ScenePoint farAway();
    GridPoint anywhere(double beyond);
    GridPoint onLatticePoint();
    double surface(GridPoint grid) const;
    double length(double low_exponent, double high_exponent);

    Random& random_;
    const HeightfieldTruth& truth_;
    double columns_; // of the last sample
    double rows_;
    std::array<double, 4> lengths_m_; // of the terrain
    Motion motion_ = Motion::Jump;
    int left_ = 0;
    GridPoint at_;
    GridPoint velocity_;
    double step_ = 1.0;  // cells
    double depth_ = 1.0; // m
    double climb_ = 0.0; // m per update
    double z_ = 0.0;
    bool follows_ = true;
    ScenePoint goal_;
};

} // namespace marsview::test
