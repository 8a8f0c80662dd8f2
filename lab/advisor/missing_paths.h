// What a method cannot see of a view: path classes that carry energy there and that it does not find.
//
// Told from what its integrator declares (a test holds it to that) and from the energy table. What no method finds is
// in no table: of that, only what the scene is made of speaks.
#pragma once
#include <string>
#include <vector>

#include "advisor/class_table.h"
#include "advisor/declared_paths.h"
#include "scene/forward.h"

namespace etendue::advisor {

struct MissingPathClass {
  std::string paths;
  ClassEnergy energy;
  double share = 0;     // of all energy
  bool points = false;  // only as far as it comes from lights without extent
  bool part = false;    // only some of these paths are not found: the energy is what is missing at most
};

struct MissingPaths {
  std::vector<MissingPathClass> classes;  // the largest first
  double share = 0;                       // of all energy, in what is missing
  double rms = 0;                         // what the lack adds to the RMSE of a picture, about
  bool uncertain = false;                 // the energies were found by few samples

  bool none() const { return classes.empty(); }
};

MissingPaths missing_paths(const Found& found, const ClassTable& table);

// What the document's own method misses, measured alone: nothing is rendered where it declares to find all that counts.
// `total` is filled in if something was.
struct MeasuredMissingPaths {
  MissingPaths spots;
  ClassEnergy total;
  double relative_square = 0;  // what the lack adds to relMSE, about
  int width = 0;               // of the pictures that it was measured on; 0 if there was no need
  bool finished = true;
};
MeasuredMissingPaths measured_missing_paths(render::Session& session, const render::Document& document,
                                            const TableOptions& options, const bench::Progress& watch);

// "misses 31 % of the light: EDD+L, EGD+L and 3 more"; "misses nothing that was found to carry light".
std::string sentence_of(const MissingPaths& spots);

// One sentence for each kind of light that this scene may hold and that no method of the registry finds, as far as
// that can be told from its lights and surfaces.
std::vector<std::string> beyond_all_methods(const scene::CompiledScene& scene);

}  // namespace etendue::advisor
