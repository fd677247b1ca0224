// Checks every update of any contact model over a heightfield against the required properties.
#pragma once

#include "core/contact/contact.h"
#include "tests/core/contact/contact_truth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace marsview::test {

/// The properties that a model does not promise.
struct ModelTraits {
    bool may_float = false; // may leave the surface while it reports contact
    bool is_minimum = true; // ends where the goal pulls no further
    // Begins each update at a vertex, as in the paper: it may move although the goal does not, and
    // the distance may grow by more than the goal moves.
    bool begins_at_vertices = false;
    // Treats a point closer to a sample than 1e-12 of an edge as the sample itself, and tests only
    // the edges there. Between two nearly opposite edges of a thin face, the goal can pull many
    // times farther than along either edge.
    bool is_blunt_on_slivers = false;
};

/// Results over many updates. A share is relative to the rounding allowance; 1 is the limit.
struct Findings {
    long updates = 0;
    long contacts = 0;
    long casts = 0;
    long vertices = 0;
    long faces = 0;
    long far_edges = 0;
    long far_loops = 0;
    long growths = 0;     // grew by more than the goal moved; fails unless begins_at_vertices
    long far_growths = 0; // those in updates with far-edge steps
    long cut_short = 0;
    long not_minimal = 0;
    long rests = 0;              // updates with the same goal as the previous one
    long rest_moves = 0;         // rests in which the proxy moved by any amount
    long passages = 0;           // free paths checked
    long double height_m = 0.0L; // of the proxy, above or below the surface at its place
    long double height_share = 0.0L;
    long double place_m = 0.0L;    // between the proxy's coordinates and its place on the mesh
    long double foot_m = 0.0L;     // from the goal's foot on the face or edge of the proxy
    long double cosine = 0.0L;     // between the goal and the steepest remaining direction
    long double pull_share = 0.0L; // the same in meters
    long double growth_m = 0.0L;   // of the distance, beyond the goal's motion
    long double growth_share = 0.0L;
    long double distance_m = 0.0L; // difference between the distance in doubles and in long doubles
    long double rest_move_m = 0.0L;

    void add(const ContactCounters& counters, bool is_in_contact)
    {
        ++updates;
        contacts += is_in_contact ? 1 : 0;
        casts += counters.casts;
        vertices += counters.vertices;
        faces += counters.faces;
        far_edges += counters.far_edges;
        far_loops += counters.far_loops;
        cut_short += counters.cut_short;
    }
    void add(const Findings& o);
    /// Prints one line.
    void print(const std::string& name) const;
};

/// Not for goals with invalid coordinates. All its failures are fatal and name the update.
template <typename Model>
class Judge {
public:
    using Surface = std::remove_cvref_t<decltype(std::declval<const Model&>().surface())>;

    explicit Judge(const Surface& surface, const ModelTraits& traits = {})
        : Judge(surface, surface.terrain(), traits)
    {}
    /// For a surface whose heights are from now on those of `terrain`.
    Judge(const Surface& surface,
          std::shared_ptr<const FilledHeightfield> terrain,
          const ModelTraits& traits)
        : surface_(surface)
        , truth_(std::move(terrain), surface.frame(), surface.exaggeration())
        , traits_(traits)
    {}

    const HeightfieldTruth& truth() const { return truth_; }
    const Findings& findings() const { return findings_; }

    /// Checks model.update(goal).
    void check(Model& model, const ScenePoint& goal)
    {
        const std::optional<Last> last = last_;
        hold(model, goal, model.update(goal), last);
    }
    /// Checks model.place(goal); the path to it is not checked.
    void checkPlaced(Model& model, const ScenePoint& goal)
    {
        hold(model, goal, model.place(goal), std::nullopt);
    }

private:
    struct Last {
        ScenePoint goal;
        long double distance;
        long double error;
        ScenePoint proxy;
        bool is_in_contact;
        bool is_inside; // whether the goal is within the outermost samples
        int rests;      // number of repeated updates with that goal
    };

    void hold(const Model& model,
              const ScenePoint& goal,
              const ContactState& state,
              const std::optional<Last>& last)
    {
        judge(model, goal, state, last);
        if (testing::Test::HasFatalFailure()) {
            ADD_FAILURE() << describe(model, goal, last);
        }
    }

    // The rounding allowance at a place, as a length. The error of a foot grows with the distance
    // from the goal: by the smallest angle between directions that doubles can represent, which is
    // larger for thinner triangles, and by the angle by which rounded heights tilt the triangle.
    // Feet closer than 1e-12 of an edge to its end count as the end.
    static constexpr long double kEpsilon = 0x1p-52L;
    static constexpr long double kShare = 4e-12L;
    static constexpr long double kAngle = 4e-13L;

    void judge(const Model& model,
               const ScenePoint& goal,
               const ContactState& state,
               const std::optional<Last>& last)
    {
        findings_.add(state.counters, state.is_in_contact);
        ASSERT_EQ(state.counters.cut_short, 0U);
        ASSERT_EQ(state.is_in_contact, state.feature != ContactFeature::Free);
        const LongVec seen = truth_.goal(goal);
        const long double goal_error = truth_.goalError(goal);
        const LongVec proxy = longVec(state.proxy);
        // Straight below the coordinates. These are rounded, and a steep surface magnifies the
        // error.
        const long double cell_m = cellMeters();
        const long double coordinate_error = truth_.goalError(state.proxy);
        const long double height_tolerance = 16.0L * kEpsilon * truth_.highest() +
                                             4.0L * truth_.step() / cell_m * coordinate_error +
                                             coordinate_error;
        ASSERT_GE(proxy.z, truth_.height(proxy) - height_tolerance) << "below the surface";
        const bool is_inside = truth_.isInside(goal);
        if (last && !last->is_in_contact && last->is_inside && is_inside) {
            const long double depth_m = truth_.depth(longVec(last->proxy), seen);
            const long double granted =
                height_tolerance +
                8.0L * kEpsilon * std::max(std::abs(longVec(last->proxy).z), std::abs(seen.z));
            const ContactCounters& c = state.counters;
            const bool has_touched = state.is_in_contact || c.casts > 1 || c.vertices + c.faces > 0;
            ++findings_.passages;
            if (!has_touched) {
                ASSERT_LE(depth_m, granted) << "passed through the surface";
            }
            if (depth_m < -granted) {
                ASSERT_FALSE(has_touched) << "in contact, but in free space";
            }
        }
        long double distance_m = length(seen - proxy);
        long double error = 4.0L * (goal_error + coordinate_error);
        if (!state.is_in_contact) {
            ASSERT_FALSE(model.contact().has_value());
            if (is_inside) {
                ASSERT_EQ(state.proxy, goal) << "free, but not at the goal";
            }
            ASSERT_LE(distance_m, 4.0L * goal_error) << "free, but not at the goal";
        } else if (!traits_.may_float) {
            ASSERT_TRUE(model.contact().has_value());
            const auto place = meshPlace(surface_, *model.contact());
            ASSERT_TRUE(place.has_value()) << "invalid shares";
            const LongVec here = truth_.point(*place);
            const HeightfieldTruth::Rest rest = truth_.rest(*place, seen);
            ASSERT_GT(rest.faces, 0U) << "samples that are not connected";
            findings_.place_m =
                std::max(findings_.place_m, std::hypot(here.x - proxy.x, here.y - proxy.y));
            ASSERT_LE(std::hypot(here.x - proxy.x, here.y - proxy.y), 2.0L * coordinate_error);
            const long double off_m = std::abs(here.z - proxy.z);
            const long double off_share = off_m / (8.0L * kEpsilon * rest.highest_m + 1e-300L);
            findings_.height_m = std::max(findings_.height_m, off_m);
            findings_.height_share = std::max(findings_.height_share, off_share);
            ASSERT_LE(off_share, 1.0L) << "off the surface by " << off_m << " m";
            distance_m = length(seen - here);
            findings_.distance_m =
                std::max(findings_.distance_m,
                         std::abs(distance_m -
                                  static_cast<long double>(marsview::length(
                                      surface_.goalPoint(*surface_.goal(goal)) - state.proxy))));
            const long double lowest_m = rest.longest_m / rest.slenderness;
            error = 4.0L * goal_error + 16.0L * kEpsilon * rest.highest_m +
                    kShare * rest.longest_m +
                    (kAngle + 16.0L * kEpsilon * rest.slenderness +
                     4.0L * kEpsilon * rest.highest_m / lowest_m) *
                        distance_m;
            if (traits_.is_blunt_on_slivers) {
                error *= rest.slenderness;
            }
            if (traits_.is_minimum) {
                if (state.feature == ContactFeature::Face ||
                    state.feature == ContactFeature::Edge) {
                    findings_.foot_m = std::max(findings_.foot_m, rest.pull_m);
                }
                if (distance_m > error) {
                    findings_.cosine = std::max(findings_.cosine, rest.pull_m / distance_m);
                }
                findings_.pull_share = std::max(findings_.pull_share, rest.pull_m / error);
                findings_.not_minimal += rest.pull_m > error ? 1 : 0;
                ASSERT_LE(rest.pull_m, error)
                    << "not a minimum: the goal, " << distance_m << " m away, still pulls by "
                    << rest.pull_m << " m; longest edge " << rest.longest_m << " m, slenderness "
                    << rest.slenderness;
            }
        }
        if (last && last->goal == goal) {
            ++findings_.rests;
            const long double moved_m = length(proxy - longVec(last->proxy));
            findings_.rest_moves += moved_m > 0.0L ? 1 : 0;
            findings_.rest_move_m = std::max(findings_.rest_move_m, moved_m);
            if (!traits_.begins_at_vertices) {
                ASSERT_LE(moved_m, error + last->error) << "moved although the goal did not";
                if (last->rests > 0) {
                    ASSERT_EQ(state.proxy, last->proxy) << "moved although the goal still did not";
                }
            }
        }
        if (last && !traits_.may_float) {
            const long double growth_m =
                distance_m - last->distance - truth_.wayOfGoal(last->goal, goal);
            const long double granted = error + last->error;
            findings_.growth_m = std::max(findings_.growth_m, growth_m);
            findings_.growth_share = std::max(findings_.growth_share, growth_m / granted);
            if (growth_m > granted) {
                ++findings_.growths;
                findings_.far_growths += state.counters.far_edges > 0 ? 1 : 0;
                ASSERT_TRUE(traits_.begins_at_vertices)
                    << "the distance grew by " << growth_m << " m more than the goal moved"
                    << (state.counters.far_edges > 0 ? ", over a far edge" : "");
            }
        }
        last_ = Last{goal,
                     distance_m,
                     error,
                     state.proxy,
                     state.is_in_contact,
                     is_inside,
                     last && last->goal == goal ? last->rests + 1 : 0};
    }

    long double cellMeters() const
    {
        const SceneFrame& frame = truth_.frame();
        return std::min(std::hypot(frame.east_per_column, frame.north_per_column),
                        std::hypot(frame.east_per_row, frame.north_per_row));
    }

    std::string
    describe(const Model& model, const ScenePoint& goal, const std::optional<Last>& last) const
    {
        const auto text = [](const ScenePoint& p) {
            char buffer[100];
            std::snprintf(buffer, sizeof buffer, "{%.17g, %.17g, %.17g}", p.x, p.y, p.z);
            return std::string(buffer);
        };
        std::string result = "update " + std::to_string(findings_.updates) + ", goal " + text(goal);
        const GridPoint grid = truth_.frame().toGrid(goal);
        result += " at column " + std::to_string(grid.column) + ", row " + std::to_string(grid.row);
        if (last) {
            result += "; before: goal " + text(last->goal) + ", proxy " + text(last->proxy) +
                      (last->is_in_contact ? " in contact" : " free");
        }
        if (const auto contact = model.contact()) {
            const auto place = meshPlace(surface_, *contact);
            result += "; now on";
            for (std::size_t i = 0; place && i < place->count; ++i) {
                char buffer[80];
                std::snprintf(buffer, sizeof buffer, " (%d, %d) × %.17Lg", place->parts[i].column,
                              place->parts[i].row, place->parts[i].share);
                result += buffer;
            }
        }
        return result;
    }

    const Surface& surface_;
    HeightfieldTruth truth_;
    ModelTraits traits_;
    Findings findings_;
    std::optional<Last> last_;
};

} // namespace marsview::test
