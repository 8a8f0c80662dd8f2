// A chart of the spectrum that a parameter of the document names, with points that the mouse moves, adds and removes.
//
// The points become the value of the parameter (spectrum/spectrum_points.h). A drag is one step of undo.
#pragma once
#include <string>

#include "viewer/widgets/spectrum_plot.h"

namespace etendue {
class EmissionSpectrum;
struct MediumDescription;
}  // namespace etendue

namespace etendue::viewer {

struct AppState;

struct SpectrumField {
  std::string parameter;   // its qualified name, such as "light.0.spectrum"
  const char* title;       // of the chart
  SpectrumFunction value;  // the spectrum if the parameter is not a list of points
  bool relative = true;    // only the shape counts: points that replace another spectrum are scaled to at most 1
};

// Scripts find the chart as PARAMETER.points, and the button that replaces another spectrum by points as
// PARAMETER.edit.
void spectrum_editor(AppState& state, const SpectrumField& field);

// The editor of the spectrum of an emitter; illuminant D65 stands for no spectrum, which gives the same light.
void emission_spectrum_editor(AppState& state, const std::string& parameter, const EmissionSpectrum* spectrum);

// The editors of the coefficients of a medium, in a section such as "atmosphere"; none for a clear medium.
void coefficient_editors(AppState& state, const std::string& section, const MediumDescription& medium);

}  // namespace etendue::viewer
