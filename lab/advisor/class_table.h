// Where a view's energy comes from: a table of path classes that part all paths that count.
//
// Walks go the same way whichever paths count (transport/class_shares.h), so small pictures of the classes of a
// partition by the same random numbers add up to that of all paths, pixel by pixel, up to rounding. The table begins
// with the coarsest classes and takes apart the one that carries most, for as long as it is worth it; classes that some
// method finds only in part are taken apart along that line first.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "advisor/class_energy.h"
#include "bench/progress.h"
#include "render/document.h"
#include "transport/path_expression/path_classes.h"

namespace etendue::advisor {

struct ClassRow {
  std::string paths;  // an expression that --paths takes
  ClassEnergy energy;
  // The part that comes from lights without extent (point, spot, directional).
  ClassEnergy from_points;
  double share = 0;  // of all paths that count
};

struct ClassTable {
  std::string paths;  // of all rows together; empty if every path counts
  int width = 0, height = 0;
  uint32_t samples = 0;
  ClassRow total;
  std::vector<ClassRow> rows;  // that carry energy; the largest first
  // Classes of which no sample found anything: what they carry, if anything, is too little or too hard to find.
  std::vector<std::string> unseen;
  bool point_lights = false;  // the scene has lights without extent
  bool finished = false;      // nothing is left to take apart, within the limits
  double seconds = 0;         // that it took to make
};

struct TableOptions {
  // Of larger pixels than the document's: each side divided by this, down to a smaller side of `least` pixels.
  int divisor = 8, least = 64;
  uint32_t samples = 16;  // per pixel, an even number
  size_t most_rows = 24;
  double least_share = 0.01;  // what carries less is not taken apart
  double seconds = 0;         // 0 is no limit; the coarsest classes are always made
  transport::Naming naming = transport::Naming::runs;
  // Sets of paths that rows should lie within or without, beside those that integrators declare.
  std::vector<transport::Automaton> apart;
};

// What the document's picture carries in all, on the table's terms; nothing if it was cut short.
std::optional<ClassEnergy> total_energy(render::Session& session, const render::Document& document,
                                        const TableOptions& options, const bench::Progress& watch);

// Each table is better than the one before; they are values that may be kept.
using TablePublisher = std::function<void(const ClassTable&)>;

// The table of the document's picture, by the trusted method, of the document's paths or, where given, those of
// `only` among them (it must accept a path). The session is used for rendering and left with one of the small pictures.
// `watch` may cut it short: the table is then what it was by then.
ClassTable class_table(render::Session& session, const render::Document& document, const TableOptions& options,
                       const bench::Progress& watch, const TablePublisher& publish = {});
ClassTable class_table(render::Session& session, const render::Document& document, const transport::Automaton& only,
                       const TableOptions& options, const bench::Progress& watch, const TablePublisher& publish = {});

}  // namespace etendue::advisor
