// The certificate of an image: its error, the bias of its method, and the paths that are missing, stored with the
// image.
//
// The error is estimated from the two half-buffers of the film (film/error.h, film/relative_error.h). The energy of
// paths that the method does not find is measured on a small image with the reference integrator and added. For methods
// with a bias of their own the error has no upper bound.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "advisor/missing_paths.h"
#include "film/relative_error.h"

namespace etendue::advisor {

// An estimate with its 95 % confidence interval; the upper end is infinite if it is unknown.
struct IntervalEstimate {
  double value = 0;
  film::Interval interval;
};

struct Certificate {
  // Unknown while a half-buffer has a pixel without samples.
  std::optional<IntervalEstimate> rmse, relmse;
  integrator::Bias bias = integrator::Bias::unbiased;
  struct Missing {
    std::string paths;
    double share = 0;                // of the energy of all requested paths
    bool from_point_lights = false;  // only from lights without extent
  };
  std::vector<Missing> missing;
  double missing_share = 0;
  std::vector<std::string> beyond_methods;  // light that no method finds, as far as the scene reveals it
  std::optional<double> khat;               // Pareto tail index of the samples (film/tail.h)
  film::InvalidSamples rejected;
  std::vector<std::pair<std::string, std::string>> model;  // flag and value
};

// The statistics of a rendering that a certificate is computed from.
struct RenderStatistics {
  film::ErrorEstimate error;
  std::optional<film::RelativeError> relative;
  film::InvalidSamples rejected;
  transport::Model model;
  std::optional<double> khat;
};

// The errors of the film are computed on this number of threads; 0: one per hardware thread.
RenderStatistics statistics_of(const film::Film& film, const render::Status& status, const transport::Model& model,
                               int threads);

// The certificate of the rendering of a document. `session` may be the one it was rendered in: its compiled scene is
// reused and its film is discarded. If the method may miss paths, about `seconds` are spent on measuring them.
Certificate certificate(render::Session& session, const render::Document& document, const RenderStatistics& statistics,
                        double seconds, const bench::Progress& progress);

std::string certificate_json(const Certificate& certificate);
// `source` is named in the error message. Text that is not a certificate is an input error.
Result<Certificate> certificate_from_json(const std::string& json, const std::string& source);

}  // namespace etendue::advisor
