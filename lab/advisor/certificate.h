// What a picture is worth: a statement that goes with it.
//
// Its error is told from its two halves (film/error.h, film/relative_error.h); what its method cannot find is measured
// on a small picture by the trusted method and added: the error of this very picture is noise and lack together. Of a
// method that has a bias of its own, nothing can be stated from above.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "advisor/missing_paths.h"
#include "film/relative_error.h"

namespace etendue::advisor {

// An estimate with the interval in which the truth lies in 95 of 100 cases; the upper end is infinite where it cannot
// be told.
struct Stated {
  double value = 0;
  film::Interval interval;
};

struct Certificate {
  // Nothing while a half has a pixel without samples.
  std::optional<Stated> rmse, relmse;
  integrator::Bias bias = integrator::Bias::unbiased;
  struct Missing {
    std::string paths;
    double share = 0;     // of the energy of all paths that count
    bool points = false;  // only from lights without extent
  };
  std::vector<Missing> missing;
  double missing_share = 0;
  std::vector<std::string> beyond_methods;  // what no method finds, as far as that can be told
  std::optional<double> khat;               // of the samples' tail (measure/tail.h)
  film::InvalidSamples rejected;
  std::vector<std::pair<std::string, std::string>> model;  // flag and value
};

struct Evidence {
  film::ErrorEstimate error;
  std::optional<film::RelativeError> relative;
  film::InvalidSamples rejected;
  transport::Model model;
  std::optional<double> khat;
};

// Of a document's rendering. The session may be the one that it was rendered in: its film is lost, its compiled scene
// used again. Where something may be missing, up to `seconds` are spent on finding out what, about.
Certificate certificate(render::Session& session, const render::Document& document, const Evidence& evidence,
                        double seconds, const bench::Progress& watch);

std::string certificate_json(const Certificate& certificate);
// `source` is for the message. What is not of this program is an input error.
Result<Certificate> certificate_from_json(const std::string& json, const std::string& source);

}  // namespace etendue::advisor
