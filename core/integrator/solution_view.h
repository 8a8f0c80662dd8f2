// A solution of the radiosity equation for display: the patches, and the work of the solver.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "base/vec.h"
#include "spectrum/rgb.h"

namespace etendue::integrator {

struct SolutionView {
  // A side of a patch. Sides that see no other one have no closure.
  struct Side {
    Rgb radiosity{0};     // reflected, lm/m^2
    Rgb unshot{0};        // residual of the radiosity equation, lm/m^2
    float closure = 0;    // sum of the form factors of the side, as they were estimated
    float asymmetry = 0;  // relative difference of both estimates of the exchanges of the side
    bool sees_others = false;
  };
  struct Patch {
    std::array<Vec3, 3> corners;
    Vec3 normal{0};  // on the side `front`
    float area = 0;  // m^2
    Side front, back;
  };
  // The largest residual of a colour component before the first sweep and after every sweep, relative to the largest
  // source, and the seconds that the solver had worked then.
  struct History {
    std::vector<double> residuals, seconds;
  };

  std::vector<Patch> patches;
  bool has_factors = false;  // closure and asymmetry are known
  bool is_complete = false;  // radiosity and unshot light are known
  std::array<History, 3> history;
  std::string solver;   // its label
  std::string problem;  // why the solution is not accurate; empty if it is
};

}  // namespace etendue::integrator
