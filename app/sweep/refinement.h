#pragma once

#include <vector>

#include "app/sweep/sweep_folder.h"

namespace clatter {

/// The next points of a refinement, at most four: in the middle between two values of the first
/// axis. They are chosen by the error of a linear interpolation of the mean of the accuracy goal:
/// the curvature of the curve, plus the standard errors. The choice depends on the results only.
/// Points without this mean are omitted. Empty at the end of the budget, or if no interval can be
/// divided. Throws UserError if no result has such a mean.
std::vector<SweepPoint> refined_points(const SweepFolder& folder, const Sweep& sweep);

/// The points whose results lack the mean of the accuracy goal.
std::vector<SweepPoint> points_without_goal(const SweepFolder& folder, const Sweep& sweep);

}  // namespace clatter
