#pragma once

#include <string>
#include <vector>

#include "app/sweep/sweep_plot.h"

namespace clatter {

/// A chart of a study, with its name without folder and suffix.
struct StudyChart {
  std::string name;
  SweepPlot plot;
};

/// A sweep that is part of the program, with the charts of its results.
struct Study {
  std::string sweep;  ///< text of the sweep file
  std::vector<StudyChart> charts;
};

/// Temperature of the gas between two driven walls, against 1/(epsilon psi), with the theories
/// (theory 7.10, 7.11, 7.14). Restitutions 0.5 to 0.999, and numbers and lengths that change psi.
Study temperature_study(int dimension);

/// Ratio of the temperatures of spin and translation in a driven gas of rough particles, against
/// the tangential restitution (theory 6.10).
Study rough_study(int dimension);

/// Ratio of the temperatures of two species of equal size against the ratio of their masses, in a
/// gas that cools and in a gas that is kicked (theory 12).
Study mixture_study(int dimension);

/// Temperature and viscosity of a steady shear flow against the restitution, in a dilute and in a
/// dense gas, with the theories of both (theory 14).
Study shear_study(int dimension);

/// Imbalance of two compartments over a driven floor against the restitution (theory 13).
Study demon_study(int dimension);

}  // namespace clatter
